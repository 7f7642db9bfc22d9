"""Plans: tries manners from natural to whole authority, then the tightest tolerance that admits a solution.

What enters: situations, one after another. What leaves: attempts, each a checked `Plan` or the reason why there is none. Every
model is evaluated against the program by `program.evaluate` before it is returned; the solver's word is not taken.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.motion.profile import Profile
from scenewright.program.evaluate import violation
from scenewright.program.expressions import Compare
from scenewright.program.structure import Role, Structure
from scenewright.program.types import EGO, Constraint
from scenewright.roads.grounding import Scene
from scenewright.solve.hero_problem import HeroProblem, Situation
from scenewright.solve.limits import FIRM, GENTLE, STEADY, URGENT, WHOLE, Limits, Manner
from scenewright.solve.lowering import TIGHT, compared_dimension
from scenewright.solve.plan import Plan, PlanWorld
from scenewright.solve.problem import Backend, Satisfiable, Unknown

FIRST_MANNERS: tuple[Manner, ...] = (STEADY, GENTLE, FIRM, WHOLE, URGENT)
MANNERS: tuple[Manner, ...] = (GENTLE, FIRM, WHOLE, URGENT)
_TOLERANCES = tuple(Fraction(n) for n in ("0.5", "1", "2", "4", "8", "16"))
_BISECTIONS = 2
# Pinning rounds by at most 5e-5 at each of a handful of numbers; a checked plan may be off by that, no more.
_CHECK_SLACK = 5e-3
DEFAULT_BUDGET_S = 0.25


@dataclass(frozen=True, slots=True)
class Attempt:
    """The result of one re-solve: a plan or the reason for none, and what it cost.

    `promises_outcome` says whether the plan, with the ego as predicted, leads to the outcome too (who goes first).
    """

    plan: Plan | None
    status: str
    reason: str
    wall_s: float
    tries: int
    promises_outcome: bool = True


class Planner:
    """Plans the heroes' motion again and again over one run.

    Parameters
    ----------
    scene, structure, limits
        What is orchestrated, and within which bounds.
    backend
        The solver.
    budget_s
        Wall-clock time that one re-solve may take; the search for a better manner or tolerance stops there.
    """

    def __init__(
        self,
        scene: Scene,
        structure: Structure,
        limits: Mapping[int, Limits],
        backend: Backend,
        budget_s: float = DEFAULT_BUDGET_S,
    ) -> None:
        self.scene = scene
        self.structure = structure
        self.limits = limits
        self.backend = backend
        self.budget_s = budget_s
        self._last_manner = 0

    def first_plan(self, situations: Sequence[Situation], budget_s: float = 10.0) -> Attempt:
        """Plan from the start, with the heroes' first states free; `situations` differ in the trigger's instant."""
        return self._search(situations, FIRST_MANNERS, budget_s)

    def replan(self, situations: Sequence[Situation]) -> Attempt:
        """Plan the rest; begins one manner gentler than what the last re-solve needed."""
        first = max(0, self._last_manner - 1)
        attempt = self._search(situations, MANNERS[first:], self.budget_s)
        names = [manner.name for manner in MANNERS]
        if attempt.plan is not None and attempt.plan.manner in names:
            self._last_manner = names.index(attempt.plan.manner)
        return attempt

    def _search(self, situations: Sequence[Situation], manners: Sequence[Manner], budget_s: float) -> Attempt:
        started = time.perf_counter()
        tries = 0
        reason = "no motion within the limits meets the trigger"
        outcomes = (True, False) if self._has_outcome() else (True,)
        for outcome in outcomes:
            for manner in manners:
                for situation in situations:
                    left_s = budget_s - (time.perf_counter() - started)
                    if left_s <= 0:
                        return Attempt(None, "timeout", "time budget", time.perf_counter() - started, tries)
                    tries += 1
                    found = self._solve(situation, replace(manner, outcome=outcome), Fraction(0), left_s)
                    if isinstance(found, Plan):
                        return Attempt(found, "sat", "", time.perf_counter() - started, tries, outcome)
                    reason = found
        plan, more = self._widest(situations[0], replace(manners[-1], outcome=False), budget_s, started)
        status = "relaxed" if plan else "unsat"
        return Attempt(plan, status, "" if plan else reason, time.perf_counter() - started, tries + more, False)

    def _has_outcome(self) -> bool:
        return Role.OUTCOME in self.structure.roles.values()

    def _widest(self, situation: Situation, manner: Manner, budget_s: float, started: float) -> tuple[Plan | None, int]:
        """Search the smallest tolerance that admits a plan: outwards by doubling, then back by halving."""
        best: Plan | None = None
        low = Fraction(0)
        tries = 0
        for tolerance in _TOLERANCES:
            left_s = budget_s - (time.perf_counter() - started)
            if left_s <= 0:
                return best, tries
            tries += 1
            found = self._solve(situation, manner, tolerance, left_s)
            if isinstance(found, Plan):
                best = found
                break
            low = tolerance
        for _ in range(_BISECTIONS if best else 0):
            assert best is not None
            middle = (low + Fraction(str(best.tolerance))) / 2
            left_s = budget_s - (time.perf_counter() - started)
            if left_s <= 0:
                break
            tries += 1
            found = self._solve(situation, manner, middle, left_s)
            if isinstance(found, Plan):
                best = found
            else:
                low = middle
        return best, tries

    def _solve(self, situation: Situation, manner: Manner, tolerance: Fraction, timeout_s: float) -> Plan | str:
        built = HeroProblem(self.scene, self.structure, self.limits, situation, manner, tolerance)
        result = self.backend.solve(built.problem, timeout_s)
        if isinstance(result, Unknown):
            return result.reason
        if not isinstance(result, Satisfiable):
            return f"{manner.name} motion cannot meet the trigger"
        profiles: dict[int, Profile] = dict(built.profiles(result.model))
        profiles[EGO] = Profile(situation.ego.segments, dict(situation.ego_knots_s))
        parameters = {name: float(value) for name, value in self.scene.parameters.items()}
        fault = check_profiles(self.scene, profiles, parameters, built.asserted, float(tolerance))
        if fault is not None:
            return f"the model fails its check: {fault}"
        return Plan(profiles, float(tolerance), manner.name, parameters)


def check_profiles(
    scene: Scene,
    profiles: Mapping[int, Profile],
    parameters: Mapping[str, float],
    constraints: Sequence[Constraint],
    tolerance: float,
) -> str | None:
    """Return what is wrong with motions that should meet `constraints`, or None; evaluated apart from any solver."""
    world = PlanWorld(scene, profiles, parameters)
    for constraint in constraints:
        formula = constraint.formula
        allowed = _CHECK_SLACK
        if isinstance(formula, Compare):
            if formula.operator == "==":
                allowed += tolerance * float(TIGHT[compared_dimension(formula)])
            try:
                off = violation(formula, world)
            except KeyError:
                continue
            if off != off or off > allowed:
                return f"{constraint.id} is off by {off:.4g}"
        elif violation(formula, world) > allowed:
            return f"{constraint.id} does not hold"
    return None
