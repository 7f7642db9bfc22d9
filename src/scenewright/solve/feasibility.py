"""Asks whether a scenario can happen at all with any ego that keeps its promises; if not, why not and what would help.

What enters: a scene and bounds on everybody's motion. What leaves: a verdict with the clashing constraints in the
user's words and the nearest values that would do.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal

from scenewright.program.printer import print_expression
from scenewright.program.structure import Structure
from scenewright.program.types import EGO, Program
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import Limits
from scenewright.solve.outer_problem import EgoBounds, EgoDrive, OuterProblem
from scenewright.solve.problem import Backend, Satisfiable, Unsatisfiable
from scenewright.solve.suggestions import Suggestion, suggest

__all__ = ["Clash", "EgoBounds", "EgoDrive", "Feasibility", "Suggestion", "check_feasibility"]

_PROOF_TIMEOUT_S = 3.0


@dataclass(frozen=True, slots=True)
class Clash:
    """One member of the core: a constraint (with the user's words) or a limit of the world."""

    id: str
    formula: str | None
    words: str | None

    def __str__(self) -> str:
        if self.formula is None:
            return self.id
        return f"{self.id}: {self.formula}" + (f'  ("{self.words}")' if self.words else "")


@dataclass(frozen=True, slots=True)
class Feasibility:
    """Whether a scenario can happen.

    Attributes
    ----------
    answer
        ``feasible`` (as far as the outer bounds tell), ``infeasible`` (proven) or ``unknown``.
    parameters
        SI values of open parameters with which it is feasible, where it is.
    ego_start
        A first position (m) and speed (m/s) of the ego with which it is feasible, where it is.
    """

    answer: Literal["feasible", "infeasible", "unknown"]
    clashes: tuple[Clash, ...] = ()
    suggestions: tuple[Suggestion, ...] = ()
    reason: str = ""
    parameters: Mapping[str, Fraction] = field(default_factory=dict)
    ego_start: tuple[Fraction, Fraction] | None = None

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
            "clashes": [{"id": c.id, "formula": c.formula, "words": c.words} for c in self.clashes],
            "suggestions": [
                {"what": s.what, "value": s.value, "nearest": s.nearest, "unit": s.unit} for s in self.suggestions
            ],
        }


def check_feasibility(
    scene: Scene,
    structure: Structure,
    limits: Mapping[int, Limits],
    backend: Backend,
    ego: EgoBounds | None = None,
    explain: bool = True,
    drive: EgoDrive | None = None,
) -> Feasibility:
    """Decide whether any ego within `ego` and any heroes within `limits` can do what the program asks.

    Open parameters are free within their ranges. With `explain` an infeasible answer comes with clashes and
    suggestions. With `drive` the ego is not any, but drives just so: infeasible then means that no hero could have met
    all conditions against this drive. (Another hero might have made the ego drive differently.)
    """
    bounds = ego or EgoBounds()
    problem = OuterProblem(scene, structure, limits, bounds, drive=drive).problem
    result = backend.solve(problem, _PROOF_TIMEOUT_S)
    if isinstance(result, Satisfiable):
        names = (parameter.name for parameter in scene.open_parameters())
        start = (result.model[f"a{EGO}x0"], result.model[f"a{EGO}v0"]) if drive is None else None
        parameters = {name: result.model[f"p_{name}"] for name in names}
        return Feasibility("feasible", parameters=parameters, ego_start=start)
    if not isinstance(result, Unsatisfiable):
        return Feasibility("unknown", reason=result.reason)
    if not explain:
        return Feasibility("infeasible")
    proof = backend.solve(problem, _PROOF_TIMEOUT_S, want_core=True)
    core = proof.core if isinstance(proof, Unsatisfiable) else ()
    clashes = tuple(_clash(scene.program, origin) for origin in core)
    suggestions = () if drive else tuple(suggest(scene, structure, limits, bounds, backend, set(core)))
    return Feasibility("infeasible", clashes, suggestions)


def _clash(program: Program, origin: str) -> Clash:
    try:
        constraint = program.constraint(origin)
    except KeyError:
        return Clash(origin, None, None)
    return Clash(origin, print_expression(constraint.formula), program.words_of(constraint))
