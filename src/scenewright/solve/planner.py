"""Plans: tries styles from natural to whole authority, then the tightest tolerance that admits a solution.

What enters: situations, one after another. What leaves: attempts, each a checked `Plan` or the reason why there is
none. Every model is evaluated against the program by `program.evaluate` before it is returned; the solver's word is
not taken.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain

from scenewright.motion.polynomial import bernstein_coefficients
from scenewright.motion.profile import Profile
from scenewright.program.evaluate import violation
from scenewright.program.expressions import Compare
from scenewright.program.structure import Role, Structure, actors_of
from scenewright.program.types import EGO, Constraint
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition, hero_side
from scenewright.solve.clearance import Clearance
from scenewright.solve.hero_problem import HeroProblem
from scenewright.solve.limits import HASTE, Limits, Style
from scenewright.solve.lowering import TIGHT, compared_dimension
from scenewright.solve.plan import Plan, PlanWorld
from scenewright.solve.problem import Backend, Satisfiable, Unknown
from scenewright.solve.reach import Prospects
from scenewright.solve.situation import SHORTEST_LEAD_S, Situation
from scenewright.solve.trials import COAST, EXACT, Trial, first_trials, hasty, kept_to, off, opening, relaxed, trials

_TRIES_A_TICK = 5
# How finely the best for an outcome in doubt is searched: one that is promised by no more than this (s). What comes
# after the trigger is asked again at every tick; only just before it begins (s) is it worth that.
_FINELY_S, _DOUBTFUL_S, JUST_BEFORE_S = 0.02, 0.1, 0.25
# By how much more than is promised (s) an ego that may make haste is looked for.
_MOST_HASTE_S = 0.6
# What arithmetic calls just out of reach may be rounding.
_HOPE_SLACK = 0.02
# By how much of what the ego may be off its side the trigger is moved: no more than it takes.
_SHIFTS = (Fraction(0), Fraction(1, 2), Fraction(1))
# Where it takes more than this (in tight tolerances), both are a little off rather than one of them too much.
_LITTLE_OFF = Fraction(1, 2)
# The largest miss that is searched for, in tight tolerances, and how often the search is halved.
_FARTHEST, _HALVINGS = 16.0, 7
# What one question may cost the solver in a re-solve (some 10 ms) and at the start, in its own measure: the answers do
# not depend on how busy the machine is, and what is hard to answer is seldom a good way.
_EFFORT, _FIRST_EFFORT = 24_000, 150_000
_TOO_HARD = "timeout"
# How often a re-solve asks whether a gentler way has become possible.
_EASE_EVERY = 3
# What is soon for a trigger whose moment is free (s).
_SOON_S = 8.0
# What is later than planned by more than this is put off (s).
_PUT_OFF_S = 0.05
# By how much a hero that the ego follows is faster at its trigger where it can be (m/s).
_OPENINGS_MPS = (2.0, 1.0, 0.5)
# How many of the instants to try are about the planned one.
_NEAR = 4
# Pinning rounds by at most 5e-5 at each of a handful of numbers; a checked plan may be off by that, no more.
_CHECK_SLACK = 5e-3
_LIMIT_SLACK = 5e-3
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
    conditions
        The scene's linear conditions (see `solve.arrival.linear_conditions`).
    budget_s
        Wall-clock time that one re-solve may take; the search for a better style or tolerance stops there.
    """

    def __init__(
        self,
        scene: Scene,
        structure: Structure,
        limits: Mapping[int, Limits],
        backend: Backend,
        conditions: tuple[LinearCondition, ...],
        budget_s: float = DEFAULT_BUDGET_S,
    ) -> None:
        self.conditions = conditions
        self.scene = scene
        self.structure = structure
        self.limits = limits
        self.backend = backend
        self.budget_s = budget_s
        self._outcome = Role.OUTCOME in structure.roles.values()
        clearances = [Clearance.of(scene, structure, conditions, hero) for hero in scene.program.heroes]
        self._leads = any(c is not None and c.ahead and not c.closing for c in clearances)
        self._prospects = Prospects(scene, structure, limits, conditions)
        self.trials = self._kept(trials(self._outcome))
        self._coast = self._kept(COAST)
        # One that is timed at its trigger is near it where it is slow, and has less to brake.
        sides = [(hero.id, hero_side(conditions, structure, hero.id)) for hero in scene.program.heroes]
        timed = any(side is not None and side.weights[hero][1] for hero, side in sides)
        self._hasty = self._kept(hasty(self._outcome and not timed))
        self._held = self.trials[0].style
        self._replans = 0
        self._position = 0
        self._searching = False

    def _kept(self, trials: Iterable[Trial]) -> tuple[Trial, ...]:
        """Return the same trials in the manner of the program."""
        return kept_to(self.scene.program.manner, trials)

    def first_plan(self, situations: Sequence[Situation], budget_s: float = 10.0) -> Attempt:
        """Plan from the start, with the heroes' first states free; `situations` differ in the trigger's instant."""
        first = self._kept(first_trials(self._outcome))
        exact = (*first, *self.trials)
        # Where both decide when: rather soon and less evenly than late, when the ego may have changed its pace.
        soon = [s for s in situations if min(s.trigger_s.values(), default=0.0) <= _SOON_S or len(situations) == 1]
        later = [s for s in situations if s not in soon]
        drawing_away = opening(first, _OPENINGS_MPS) if self._leads else ()
        groups = ((exact, soon), (exact, later), (self._kept(off()), situations))
        ways = [(trial, situation) for situation in soon for trial in drawing_away]
        ways += [(trial, situation) for trials_, some in groups for trial in trials_ for situation in some]
        attempt, found = self._search(ways, budget_s, 2 * len(ways))
        return attempt if found is None else self._soonest(attempt, found[1], found[2], _FIRST_EFFORT)

    def _soonest(self, attempt: Attempt, trial: Trial, situation: Situation, effort: int) -> Attempt:
        """Return the best that can be done for an outcome that the prediction puts in doubt, between two trials.

        From a step to the next it may be a second, and what is not needed here may be missing when the ego makes haste.
        """
        margin_s = trial.style.outcome_margin_s
        doubtful = trial.style.outcome and not trial.tolerance and (margin_s <= _DOUBTFUL_S or situation.pressed)
        if attempt.plan is None or not doubtful or trial not in self.trials:
            return attempt
        knots = [knot_s for profile in attempt.plan.profiles.values() for knot_s in profile.knot_times_s.values()]
        now_s = situation.time_s
        soon = situation.pressed or any(now_s < knot_s <= now_s + JUST_BEFORE_S for knot_s in knots)
        if not situation.trigger_s and not soon:
            return attempt
        low, high = self.trials[self.trials.index(trial) - 1].style.outcome_margin_s, margin_s
        if situation.pressed:
            low = margin_s + _MOST_HASTE_S
            trial = Trial(replace(HASTE, clear=False).kept_to(self.scene.program.manner))
        while low - high > _FINELY_S:
            middle = 0.5 * (low + high)
            style = replace(trial.style, outcome_margin_s=middle)
            timed = self._timed(Trial(style), situation)
            found = None if timed is None else self._solve(timed, style, Fraction(0), DEFAULT_BUDGET_S, effort)
            if isinstance(found, Plan):
                high, attempt = middle, replace(attempt, plan=found)
            else:
                low = middle
        return attempt

    def replan(self, situations: Sequence[Situation]) -> Attempt:
        """Plan the rest; begins with what the last re-solve needed, now and then one gentler, and makes a few tries."""
        self._replans += 1
        preferred, exact, others = self._ways(situations)
        first = self._position
        if not self._searching and len(situations) == 1:
            first = min(first, len(exact))  # how far off the trigger must be is asked anew at every tick
        if self._replans % _EASE_EVERY == 0 and not self._searching:
            gentler = (number for number in range(min(first, len(exact)) - 1, -1, -1) if self._timed(*exact[number]))
            first = next(gentler, first) if len(situations) == 1 else 0
        ways = chain(preferred, exact[first:], others(max(0, first - len(exact))))
        attempt, tried = self._search(ways, self.budget_s)
        # What was not reached in this tick is where the next one goes on; after the last hope it starts over midway.
        self._searching = attempt.plan is None
        if tried is None:
            self._position = len(exact) // 2
        elif tried[0] >= len(preferred):
            self._position = first + tried[0] - len(preferred)
        if attempt.plan is not None and tried is not None:
            self._held = tried[1].style
            attempt = self._soonest(attempt, tried[1], tried[2], _EFFORT)
        return attempt

    def _ways(
        self, situations: Sequence[Situation]
    ) -> tuple[
        list[tuple[Trial, Situation]],
        list[tuple[Trial, Situation]],
        Callable[[int], Iterator[tuple[Trial, Situation]]],
    ]:
        """Return what to try, in order: what is tried at every tick, what is exact, and, from some number on, the rest.

        Every style at the planned instant comes before any at a later one: who puts off its trigger to move a little
        more gently may put it off for ever.
        """
        preferred = [(trial, situation) for trial in self._coast for situation in situations if situation.coasting]
        preferred += [(trial, situation) for trial in self._hasty for situation in situations if situation.earliest_s]
        situations = [situation for situation in situations if not situation.coasting]
        near, far = situations[:_NEAR], situations[_NEAR:]
        in_time = [situation for situation in near if not _is_put_off(situation)]
        put_off = [situation for situation in near if _is_put_off(situation)]
        gentle, others = self.trials[: len(EXACT)], self.trials[len(EXACT) :]
        groups = ((gentle, in_time), (gentle, put_off), (gentle, far), (others, near))
        exact = [(trial, situation) for trials, some in groups for trial in trials for situation in some]

        def last(first: int) -> Iterator[tuple[Trial, Situation]]:
            trials = off()
            if len(situations) == 1:
                manner = self.scene.program.manner
                trials = relaxed(self._held, lambda style: self._least_tolerance(style.kept_to(manner), situations[0]))
            yield from [(trial, situation) for trial in self._kept(trials) for situation in near][first:]

        return preferred, exact, last

    def _least_tolerance(self, style: Style, situation: Situation) -> float:
        """Return the smallest tolerance with which there is hope, by arithmetic: a lower bound of what is needed."""
        low, high = 0.0, _FARTHEST
        if self._timed(Trial(style), situation) is not None:
            return low
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high) if low else 0.15 * high
            if self._timed(Trial(style, Fraction(middle)), situation) is None:
                low = middle
            else:
                high = middle
        return high

    def _timed(self, trial: Trial, situation: Situation) -> Situation | None:
        """Return `situation` with the trigger moved no further than is needed; None where arithmetic sees no hope."""
        allowed = float(trial.tolerance) + _HOPE_SLACK
        shifts = _SHIFTS if trial.tolerance <= _LITTLE_OFF else _SHIFTS[-1:]
        for share in shifts if trial.tolerance else (0,):
            timed = retimed(situation, trial.tolerance * share)
            if self._prospects.least_miss(timed, trial.style, allowed) <= allowed:
                return timed
        return None

    def _search(
        self, ways: Iterable[tuple[Trial, Situation]], budget_s: float, most_tries: int = _TRIES_A_TICK
    ) -> tuple[Attempt, tuple[int, Trial, Situation] | None]:
        """Return the first way that leads to a plan, and where the search ended; None for that after the last."""
        started = time.perf_counter()
        reason = "no motion within the limits meets the trigger"
        tries = 0
        for number, (trial, situation) in enumerate(ways):
            timed = self._timed(trial, situation)
            if timed is None:
                continue
            # To ask twice for each would leave no time for those further on.
            gently = tries == 0
            for style in self._prospects.versions(timed, trial.style, float(trial.tolerance), gently):
                wall_s = time.perf_counter() - started
                if wall_s >= budget_s:
                    return Attempt(None, "timeout", "time budget", wall_s, tries), (number, trial, situation)
                if tries == most_tries:
                    return Attempt(None, "unsat", reason, wall_s, tries), (number, trial, situation)
                tries += 1
                effort = _EFFORT if most_tries == _TRIES_A_TICK else _FIRST_EFFORT
                found = self._solve(timed, style, trial.tolerance, budget_s - wall_s, effort)
                if isinstance(found, Plan):
                    status = "sat" if trial.tolerance == 0 else "relaxed"
                    promises = trial.style.outcome and trial.style.outcome_margin_s > 0
                    wall_s = time.perf_counter() - started
                    return Attempt(found, status, "", wall_s, tries, promises), (number, trial, situation)
                reason = found
                if found == _TOO_HARD and effort == _EFFORT:
                    wall_s = time.perf_counter() - started  # one such question a tick is enough
                    return Attempt(None, "timeout", "too hard a question", wall_s, tries), (
                        number + 1,
                        trial,
                        situation,
                    )
        return Attempt(None, "unsat", reason, time.perf_counter() - started, tries), None

    def _broken_limit(self, profiles: Mapping[int, Profile], after_s: float) -> str | None:
        for hero in self.scene.program.heroes:
            fault = broken_limit(profiles[hero.id], self.limits[hero.id], after_s)
            if fault is not None:
                return f"{hero.name} would break its limits: {fault}"
        return None

    def _solve(
        self, situation: Situation, style: Style, tolerance: Fraction, timeout_s: float, effort: int = _FIRST_EFFORT
    ) -> Plan | str:
        built = HeroProblem(self.scene, self.structure, self.limits, situation, style, tolerance, self.conditions)
        result = self.backend.solve(built.problem, timeout_s, effort=effort)
        if isinstance(result, Unknown):
            return _TOO_HARD if result.reason == "timeout" else result.reason
        if not isinstance(result, Satisfiable):
            return f"{style.name} motion cannot meet the trigger"
        profiles: dict[int, Profile] = dict(built.profiles(result.model))
        profiles[EGO] = Profile(situation.ego.segments, dict(situation.ego_knots_s))
        parameters = {name: float(value) for name, value in self.scene.parameters.items()}
        fault = self._broken_limit(profiles, situation.time_s)
        fault = fault or check_profiles(self.scene, profiles, parameters, built.asserted, float(tolerance))
        if fault is not None:
            return f"the model fails its check: {fault}"
        if situation.time_s == 0.0 and (fault := self._left_out(profiles, parameters, built.asserted, tolerance)):
            return f"no plan is made for it: {fault}"
        return Plan(profiles, float(tolerance), style.name, parameters)

    def _left_out(
        self,
        profiles: Mapping[int, Profile],
        parameters: Mapping[str, float],
        asserted: Sequence[Constraint],
        tolerance: Fraction,
    ) -> str | None:
        """Return what a first plan breaks of that which was asked of heroes alone, and no problem could hold."""
        heroes = [c for c in self.scene.program.constraints if c not in asserted and EGO not in actors_of(c.formula)]
        return check_profiles(self.scene, profiles, parameters, heroes, float(tolerance))


def broken_limit(profile: Profile, limits: Limits, after_s: float = -math.inf) -> str | None:
    """Return which limit a motion breaks from `after_s` on, or None: at every instant, by Bernstein coefficients."""
    top, up, down = limits.speed_max_mps, limits.accel_max_mpss, limits.brake_max_mpss
    for segment in profile.segments:
        if segment.end_s <= after_s:
            continue
        if not -down - _LIMIT_SLACK <= segment.accel_mpss <= up + _LIMIT_SLACK:
            return f"acceleration {segment.accel_mpss:.3f} m/s^2"
        derivatives = [segment.s_m, segment.speed_mps, segment.accel_mpss]
        speeds = bernstein_coefficients(derivatives, segment.duration_s, order=1)
        if min(speeds) < -_LIMIT_SLACK or max(speeds) > top + _LIMIT_SLACK:
            return f"speed {min(speeds):.3f} to {max(speeds):.3f} m/s"
    return None


def _is_put_off(situation: Situation) -> bool:
    """Whether a trigger would come later than it is planned to."""
    planned = situation.planned_trigger_s
    return any(situation.trigger_s[hero] > planned_s + _PUT_OFF_S for hero, planned_s in planned.items())


def retimed(situation: Situation, tolerance: Fraction) -> Situation:
    """Return `situation` with the trigger moved towards the plan in force, as far as the ego may be off its side.

    A late ego is met half way: the hero a little off its place, the ego a little off its own. Where the plan has the
    trigger already when the ego is at its side, it is moved towards when the hero is.
    """
    if not tolerance or not situation.planned_trigger_s:
        return situation
    triggers = dict(situation.trigger_s)
    ego_knots = dict(situation.ego_knots_s)
    for hero, planned_s in situation.planned_trigger_s.items():
        now = triggers[hero]
        reach = float(tolerance) * situation.ego_slack_s
        soonest = min(now, situation.time_s + SHORTEST_LEAD_S)
        off_s, there_s = planned_s - now, situation.hero_there_s.get(hero, planned_s) - now
        # An ego that is past its side is not waited for: what is put off at every tick never comes.
        if off_s * there_s >= 0.0 and abs(there_s) > abs(off_s) and (there_s < 0.0 or now > soonest):
            off_s = there_s
        triggers[hero] = moved = max(soonest, now + max(-reach, min(reach, off_s)))
        ego_knots = {name: moved if time_s == now else time_s for name, time_s in ego_knots.items()}
    return replace(situation, trigger_s=triggers, ego_knots_s=ego_knots)


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
