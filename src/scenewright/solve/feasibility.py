"""Asks whether a scenario can happen at all with any ego that keeps its promises; if not, why not and what would help.

What enters: a scene and bounds on everybody's motion. What leaves: a motion that shows that it can; or the clashing
constraints in the user's words, what the proof rests on, and the nearest values that would do; or that neither was
found.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal

from scenewright.motion.profile import Profile
from scenewright.program.printer import print_expression
from scenewright.program.structure import Structure
from scenewright.program.types import Program
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import Limits
from scenewright.solve.proofs.decide import Decision, Question, decide
from scenewright.solve.proofs.events import EgoBounds
from scenewright.solve.proofs.refuters import SOLVERS, Refuter
from scenewright.solve.proofs.witness import Broken, Witness
from scenewright.solve.suggestions import Suggestion, suggest
from scenewright.translate.lines import named
from scenewright.units import decimal_fraction

__all__ = ["Clash", "EgoBounds", "Feasibility", "Suggestion", "check_feasibility"]


@dataclass(frozen=True, slots=True)
class Clash:
    """One member of the core: a constraint (with the user's words) or a law of motion."""

    id: str
    formula: str | None
    words: str | None
    told: str = ""  # the constraint in plain English

    def __str__(self) -> str:
        if self.formula is None:
            return self.id
        return self.told + (f'  ("{self.words}")' if self.words else "")


@dataclass(frozen=True, slots=True)
class Feasibility:
    """Whether a scenario can happen.

    Attributes
    ----------
    answer
        ``feasible`` (there is a `witness`), ``infeasible`` (proven) or ``undecided``.
    parameters
        SI values of open parameters in the witness, where there is one.
    """

    answer: Literal["feasible", "infeasible", "undecided"]
    clashes: tuple[Clash, ...] = ()
    suggestions: tuple[Suggestion, ...] = ()
    reason: str = ""
    parameters: Mapping[str, Fraction] = field(default_factory=dict)
    witness: Witness | None = None

    def explain(self) -> str:
        """Return the proof for people: what clashes, and what would make it possible."""
        lines = ["This cannot happen. These clash:"]
        lines += [f"  - {clash}" for clash in self.clashes]
        if self.suggestions:
            lines += ["It would be possible with one of:", *(f"  - {item}" for item in self.suggestions)]
        return "\n".join(lines)

    def as_dict(self) -> dict[str, object]:
        """Return plain data, for ``--json``."""
        return {
            "answer": self.answer,
            "reason": self.reason,
            "clashes": [{"id": c.id, "told": c.told, "formula": c.formula, "words": c.words} for c in self.clashes],
            "suggestions": [
                {"what": s.what, "value": s.value, "nearest": s.nearest, "unit": s.unit} for s in self.suggestions
            ],
        }


def check_feasibility(
    scene: Scene,
    structure: Structure,
    limits: Mapping[int, Limits],
    ego: EgoBounds | None = None,
    explain: bool = True,
    drive: Profile | None = None,
    refuter: Refuter | None = None,
) -> Feasibility:
    """Decide whether any ego within `ego` and any heroes within `limits` can do what the program asks.

    Open parameters are free within their ranges. With `explain` an infeasible answer comes with clashes and
    suggestions. With `drive` the ego is not any, but drives just so: infeasible then means that no hero could have met
    all conditions against this drive. (Another hero might have made the ego drive differently.) What refutes is
    `refuter`, or z3 where none is given; one that is not exact proves nothing.
    """
    question = Question(
        scene, structure, limits, ego or EgoBounds(), drive=drive, refuter=refuter or SOLVERS.called("z3")
    )
    decision = decide(question, explain=explain)
    if decision.witness is not None:
        found = {each.name: decision.witness.parameters[each.name] for each in scene.open_parameters()}
        parameters = {name: decimal_fraction(f"{value:.9f}") for name, value in found.items()}
        return Feasibility("feasible", parameters=parameters, witness=decision.witness)
    if decision.answer == "undecided":
        return Feasibility("undecided", reason=_reason(scene.program, decision))
    if not explain:
        return Feasibility("infeasible")
    clashes = tuple(_clash(scene.program, origin) for origin in decision.core)
    suggestions = () if drive else tuple(suggest(question, set(decision.core)))
    return Feasibility("infeasible", clashes, suggestions)


def _reason(program: Program, decision: Decision) -> str:
    if decision.doubted_by:
        return f"{decision.doubted_by} finds it impossible, to within its numerical tolerance; that is no proof"
    if decision.left_out:
        told = "; ".join(f"{name}: {why}" for name, why in decision.left_out.items())
        return f"no plan can be made for {told}"
    if decision.amiss:
        still = _amiss_in_words(program, decision.amiss[0])
        return f"neither a motion nor a proof was found in time; in the best motion {still}"
    return "neither a motion nor a proof was found in time"


def _amiss_in_words(program: Program, broken: Broken) -> str:
    """Say what is amiss with a motion."""
    name, other = (program.actor(actor).name for actor in (broken.actor, broken.other))
    match broken.what:
        case "turn":
            return f"{name} takes its turn too fast"
        case "apart":
            return f"{other} and {name} touch"
        case "law":
            return f"{name} moves as nobody can"
    return f"this does not hold: {_clash(program, broken.what)}"


def _clash(program: Program, origin: str) -> Clash:
    try:
        constraint = program.constraint(origin)
    except KeyError:
        return Clash(origin, None, None)
    told = named(program, constraint)
    return Clash(origin, print_expression(constraint.formula), program.words_of(constraint), told)
