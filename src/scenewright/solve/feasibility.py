"""Asks whether a scenario can happen at all with any ego that keeps its promises; if not, why not and what would help.

What enters: a question. What leaves: a motion that shows that it can; or what clashes, in the user's words, and the
nearest values that would do; or that neither was found.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from fractions import Fraction
from typing import Literal

from scenewright.program.printer import print_expression
from scenewright.program.types import Program
from scenewright.solve.proofs.decide import Decision, Question, decide
from scenewright.solve.proofs.events import EgoBounds
from scenewright.solve.proofs.witness import Broken, Witness
from scenewright.solve.suggestions import Suggestion, suggest
from scenewright.translate.lines import named
from scenewright.units import decimal_fraction

__all__ = ["Clash", "EgoBounds", "Feasibility", "Question", "Suggestion", "check_feasibility"]


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
    """Whether a scenario can happen: ``feasible`` (there is a `witness`), ``infeasible`` (proven) or ``undecided``.

    `parameters` are SI values of open parameters in the witness.
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
            "clashes": [asdict(each) for each in self.clashes],
            "suggestions": [asdict(each) for each in self.suggestions],
        }


def check_feasibility(question: Question, explain: bool = True) -> Feasibility:
    """Decide whether any ego and any heroes within the bounds of a question can do what its program asks.

    Open parameters are free within their ranges. With `explain` an infeasible answer comes with clashes and
    suggestions. Where the question is of one drive of the ego, infeasible means that no hero could have met all
    conditions against that. (Another hero might have made the ego drive differently.)
    """
    scene = question.scene
    decision = decide(question, explain=explain)
    if decision.witness is not None:
        found = ((each.name, decision.witness.parameters[each.name]) for each in scene.open_parameters())
        parameters = {name: decimal_fraction(f"{value:.9f}") for name, value in found}
        return Feasibility("feasible", parameters=parameters, witness=decision.witness)
    if decision.answer == "undecided":
        return Feasibility("undecided", reason=_reason(scene.program, decision))
    if not explain:
        return Feasibility("infeasible")
    clashes = tuple(clash(scene.program, origin) for origin in decision.core)
    suggestions = () if question.drive else tuple(suggest(question, set(decision.core)))
    return Feasibility("infeasible", clashes, suggestions)


def _reason(program: Program, decision: Decision) -> str:
    if decision.doubted_by:
        return f"{decision.doubted_by} finds it impossible, to within its numerical tolerance; that is no proof"
    if decision.left_out:
        return "no plan can be made for " + "; ".join(f"{name}: {why}" for name, why in decision.left_out.items())
    still = f"; in the best motion {_amiss_in_words(program, decision.amiss[0])}" if decision.amiss else ""
    return f"neither a motion nor a proof was found in time{still}"


def _amiss_in_words(program: Program, broken: Broken) -> str:
    """Say what is amiss with a motion."""
    name, other = (program.actor(actor).name for actor in (broken.actor, broken.other))
    told = {"turn": f"{name} takes its turn too fast", "apart": f"{other} and {name} touch"}
    told |= {"law": f"{name} moves as nobody can"}
    return told.get(broken.what) or f"this does not hold: {clash(program, broken.what)}"


def clash(program: Program, origin: str) -> Clash:
    """Return a constraint, by id, or a law as the user knows it."""
    try:
        constraint = program.constraint(origin)
    except KeyError:
        return Clash(origin, None, None)
    told = named(program, constraint)
    return Clash(origin, print_expression(constraint.formula), program.words_of(constraint), told)
