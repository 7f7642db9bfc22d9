"""The closed loop's mind: makes the first plan, and solves the rest of it again as the ego turns out to drive.

What enters: the ego's states, tick by tick. What leaves: the heroes' motions, and a record of every re-solve. What each
plan starts from is told elsewhere (see `standing`).
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial

from scenewright.motion.profile import Profile, chain
from scenewright.plan.afterwards import goes_on
from scenewright.plan.foresight import Motions
from scenewright.plan.guesses import even_motions, meet_later
from scenewright.plan.pairs import Meeting, behind_ego, in_order, meetings_of, needed
from scenewright.plan.prediction import EgoSample
from scenewright.plan.problem import Missed, Problem
from scenewright.plan.shooting import profile_of
from scenewright.plan.solving import Solution, solve
from scenewright.plan.standing import Standing
from scenewright.plan.unknowns import AFTER_LAST_S
from scenewright.program.types import EGO
from scenewright.solve.plan import Plan

# Newton steps of a first plan and of a tick, and how many more a tick has for each second that a trigger has moved by:
# a step of several heroes counts for each of them, and the next tick goes on. Measured: fewer than four lose orders.
_FIRST_STEPS, _TICK_STEPS, _STEPS_A_SECOND, _MOST_STEPS_MORE = 40, 4, 12, 16
# First plans are solved for from these speeds (shares of the natural one), for Newton finds the nearest plan, not the
# best: who comes slowly can still do either.
_PACES = 0.25, 0.8
# What a step has to gain in a tick, from which the next one goes on, and in any plan for each further hero. A tight
# tolerance that is missed costs hundreds. Measured: with 0.01 ticks take half as long, and 133 runs are met as often.
_ENOUGH_TICK, _ENOUGH_EACH = 0.01, 0.3
# How often a first plan is solved for again with an ego that follows a hero and answers what that does; chosen. It
# ends before where nothing is missed.
_AGAIN_LED = 16
# How many meetings of heroes are turned at most, and what is clear enough (m^2, summed over times: 14 cm once); chosen.
_MOST_TURNS, _CLEAR_ENOUGH = 6, 0.02
# By so much (m, m/s) the ego may be foreseen otherwise for a plan to be as good as it was: a fifth of what is tight.
_SAME_M, _SAME_MPS = 0.1, 0.05
# A plan that misses no more than this (tight tolerances) does what was asked.
GOOD = 0.2


@dataclass(frozen=True, slots=True)
class Replan:
    """What one tick's re-solve came to: what its plan misses, in tight tolerances, and how it foresees the ego."""

    time_s: float
    status: str
    backend: str
    wall_s: float
    tolerance: float
    reason: str
    foreseen: Profile | None = None


@dataclass(frozen=True, slots=True)
class Attempt:
    """What a first plan came to, and how many Newton steps it took in all."""

    plan: Plan
    missed: Missed
    steps: int

    @property
    def is_good(self) -> bool:
        """Whether it does what was asked of the heroes."""
        return self.missed.by <= GOOD

    @property
    def promises_outcome(self) -> bool:
        """Whether, with the ego as foreseen, it leads to the outcome too (who goes first)."""
        return self.missed.late_s <= 0.0


@dataclass(frozen=True, slots=True)
class _Found:
    """A plan, how and for what problem it was found, and who goes first wherever heroes meet."""

    plan: Plan
    solution: Solution
    problem: Problem
    meetings: tuple[Meeting, ...]

    @property
    def does_all(self) -> bool:
        """Whether it does what was asked, and who is to be first is it."""
        return self.solution.missed.by <= GOOD and self.solution.missed.late_s <= 0.0


@dataclass(slots=True)
class Planner(Standing):
    """Plans and re-plans the heroes of one scene over one run."""

    records: list[Replan] = field(init=False, default_factory=list)
    _meetings: tuple[Meeting, ...] = field(init=False, default=())
    _behind_ego: Mapping[int, tuple[Meeting, ...]] = field(init=False)
    _steps: int = field(init=False, default=0)

    # -- the first plan -----------------------------------------------------------------------------------------------
    def begin(self, ego: EgoSample) -> Attempt:
        """Plan from the ego's first state; the plan is kept."""
        started = time.perf_counter()
        self._ego.samples, self._times.ego_began = [ego], ego[1:3]
        self.ego_knots_s = {self.scene.program.ego.sketch.knots[0]: 0.0}
        prediction = self._ego.at_first()
        even, tries = partial(even_motions, self._asked, self._times, prediction, self.witness), list[_Found]()
        meetings = meetings_of(self.scene)
        self._behind_ego = {hero.id: behind_ego(self.scene, hero.id) for hero in self._heroes}
        placed = bool(meetings) and not meet_later(self.scene.program, self.structure) and even(1.0)[1]
        for pace in _PACES:
            guesses, _ = even(pace)
            if placed:
                self._meetings = in_order(meetings, self.scene, self.structure, guesses)
            tries.append(self._planned_first(prediction, guesses))
            if tries[-1].does_all:
                break
        best = min(tries, key=lambda found: found.solution.cost)
        self._keep(best)
        begin = {hero.id: hero.sketch.knots[0] for hero in self._heroes}
        if self._ego.take_sides(self.plan.profiles, {**begin, **self._asked.adapts_until}):
            best = self._planned_first(best.plan.profiles[EGO], best.plan.profiles)
            self._keep(best)
        led = bool(self._ego.leaders(self.plan.profiles))
        if led:
            best = self._led(best)
        if meetings and not placed:
            self._keep(best)
            self._meetings = in_order(meetings, self.scene, self.structure, best.plan.profiles)
        if not (led or placed) or self._meetings != best.meetings:
            again = self._planned_first(best.plan.profiles[EGO], best.plan.profiles)
            if self._meetings != best.meetings or again.solution.missed.by <= max(GOOD, best.solution.missed.by):
                best = again
        best = self._turned(best)
        self._keep(best)
        self._meetings = needed(best.meetings)
        triggers = {hero: self.structure.trigger_knot(hero) or "" for hero in self.structure.triggers}
        self._joint_s = {hero: self.plan.profiles[hero].knot_times_s[name] for hero, name in triggers.items()}
        missed, wall_s = best.solution.missed, time.perf_counter() - started
        foreseen = self.plan.profiles[EGO]
        self.records = [Replan(0.0, _status(missed.by), "daqp", wall_s, missed.by, "", foreseen)]
        return Attempt(self.plan, missed, self._steps)

    def _keep(self, found: _Found) -> None:
        self.plan, self._meetings, z = found.plan, found.meetings, found.solution.z
        self._moments_s = {instant: moment.value(z) for instant, moment in enumerate(found.problem.moments)}
        self._others = found.problem.others(z)

    def _planned_first(self, prediction: Profile, guesses: Motions, trusted: float = 1.0) -> _Found:
        """Return a first plan that is found from guesses: motions, or other plans with all their knots.

        Of a longest step `trusted` is the share by which it may be off from them: 1 is no limit, 0 leaves them as they
        are.
        """
        problem = Problem(self._asked, self._first_situation(prediction, guesses), needed(self._meetings))
        if 0.0 < trusted < 1.0:
            problem.keep_near(trusted)
        return self._made(
            problem, solve(problem, problem.guess, _FIRST_STEPS if trusted else 0, self._enough), prediction
        )

    def _turned(self, best: _Found) -> _Found:
        """Return a first plan in which the two heroes that are dearest are turned, as long as that makes it cheaper."""
        for _ in range(_MOST_TURNS):
            short, pair = best.problem.dearest(best.solution.z)
            if short < _CLEAR_ENOUGH:
                break
            self._keep(best)
            self._meetings = tuple(m.turned() if {m.first, m.second} == pair else m for m in best.meetings)
            trial = self._planned_first(best.plan.profiles[EGO], best.plan.profiles)
            if trial.solution.cost >= best.solution.cost:
                break
            best = trial
        return best

    def _led(self, best: _Found) -> _Found:
        """Return a first plan with an ego that answers it, from one without; where a step is too long it is halved."""
        best, trusted = self._answered(best), 1.0
        for _ in range(_AGAIN_LED):
            if best.solution.missed.by <= 0.5 * GOOD:
                break
            self._keep(best)
            trial = self._answered(self._planned_first(best.plan.profiles[EGO], best.plan.profiles, trusted))
            if trial.solution.cost < best.solution.cost:
                best = trial
            else:
                trusted *= 0.5
        return best

    def _answered(self, found: _Found) -> _Found:
        """Return a first plan, and what it costs, with the ego that answers it: it was made with one that did not."""
        self._keep(found)
        return self._planned_first(self._ego.foreseen(found.plan.profiles), found.plan.profiles, trusted=0.0)

    # -- one tick -----------------------------------------------------------------------------------------------------
    def tick(self, time_s: float) -> Replan:
        """Re-solve where that is needed, and return what came of it."""
        started = time.perf_counter()
        self._go_on(time_s)
        if all(self._open_piece(hero, time_s) is None for hero in self._heroes):
            record = Replan(time_s, "frozen", "", 0.0, self.plan.tolerance, "after its trigger the hero does not adapt")
        else:
            prediction = self._ego.foreseen(self.plan.profiles)
            situation, moved_s = self._situation(time_s, prediction)
            problem = Problem(self._asked, situation, self._meetings)
            more = min(_MOST_STEPS_MORE, int(_STEPS_A_SECOND * moved_s)) // len(self.scene.program.heroes)
            solution = solve(problem, problem.guess, _TICK_STEPS + more, _ENOUGH_TICK + self._enough)
            if solution.missed.by <= max(GOOD, self.plan.tolerance) or not self._is_as_foreseen(time_s, prediction):
                self._keep(self._made(problem, solution, prediction))
            foreseen, tolerance = self.plan.profiles[EGO], self.plan.tolerance
            record = Replan(time_s, _status(tolerance), "daqp", 0.0, tolerance, "", foreseen)
        record = replace(record, wall_s=time.perf_counter() - started)
        self.records.append(record)
        return record

    def _is_as_foreseen(self, time_s: float, prediction: Profile) -> bool:
        """Whether at all knots to come the ego is foreseen as the plan in force has it: that still does what it did."""
        then, knots = self.plan.profiles[EGO], (p.knot_times_s.values() for p in self.plan.profiles.values())
        for at_s in (at_s for times in knots for at_s in times if at_s > time_s):
            now, before = prediction.state(at_s), then.state(at_s)
            if abs(now[0] - before[0]) > _SAME_M or abs(now[1] - before[1]) > _SAME_MPS:
                return False
        return True

    def _go_on(self, time_s: float) -> None:
        """Let heroes whose plan is over brake for bends, and keep clear of those that go first, the ego too.

        Whoever is behind the ego does so from its last knot on.
        """
        profiles = dict(self.plan.profiles)
        lasts_s = {hero.id: 0.0 if self._ego.keeps_behind(hero.id) else AFTER_LAST_S for hero in self._heroes}
        over = [
            hero for hero, more_s in lasts_s.items() if max(profiles[hero].knot_times_s.values()) + more_s <= time_s
        ]
        if not over:
            return
        seen_s, ego_m, ego_mps, ego_mpss = self._ego.samples[-1]
        ego = {EGO: Profile(chain(seen_s, ego_m, ego_mps, [(1.0, ego_mpss, 0)]))}
        for hero in over:
            caps, s_m = self._asked.caps[hero], profiles[hero].state(time_s)[0]
            meetings = (*self._meetings, *(m for m in self._behind_ego[hero] if m.has_begun(ego_m, s_m)))
            profiles[hero] = goes_on(hero, profiles | ego, meetings, time_s, self._asked.wanted, caps)
        self.plan = replace(self.plan, profiles=profiles)

    def _made(self, problem: Problem, solution: Solution, prediction: Profile) -> _Found:
        """Return the plan that values stand for, with what was driven before it."""
        self._steps += solution.steps
        times = [moment.value(solution.z) for moment in problem.moments]
        profiles = {hero: drive.motion for hero, drive in problem.now.heroes.items()}
        knots_s = {
            actor.id: {name: times[self._asked.knot(actor.id, name)] for name in actor.sketch.knots}
            for actor in self.scene.program.actors
        }
        for hero, shot in problem.shots(solution.z).items():
            drive = problem.now.heroes.get(hero)
            past = [] if drive is None else drive.motion.until(drive.begin_s)
            profiles[hero] = profile_of(shot, knots_s[hero], past)
        profiles[EGO] = Profile(prediction.segments, knots_s[EGO])
        plan = Plan(profiles, solution.missed.by, problem.parameters(solution.z))
        return _Found(plan, solution, problem, self._meetings)

    @property
    def _enough(self) -> float:
        return _ENOUGH_EACH * (len(self.scene.program.heroes) - 1)


def _status(missed: float) -> str:
    return "sat" if missed <= GOOD else "relaxed"
