"""The closed loop's mind: holds the plan, and solves the rest of it again as the ego turns out to drive.

What enters: the ego's states, tick by tick. What leaves: the heroes' motions, and a record of every re-solve. History
is fixed; a hero freezes at its trigger, but for later pieces that react to the ego.
"""

from __future__ import annotations

import time
from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from scenewright.motion.profile import Profile, chain
from scenewright.plan.preferences import PREFERENCES
from scenewright.plan.problem import Answer, Problem, Program, Situation
from scenewright.plan.shooting import profile_of
from scenewright.plan.solving import Solution, solve
from scenewright.program.structure import Role, Structure, knots_of
from scenewright.program.types import EGO, Actor
from scenewright.roads.grounding import Scene
from scenewright.simulate.following import Leader, foresee_follower
from scenewright.simulate.prediction import ConstantSpeed, EgoSample, Predictor, jumped, lately
from scenewright.simulate.replanner import Replan
from scenewright.simulate.triggers import PlannedTrigger, TriggerTimes
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.clearance import Clearance
from scenewright.solve.limits import Limits
from scenewright.solve.plan import Plan
from scenewright.solve.planner import Attempt

_EVEN_S = 0.1
_FIRST_STEPS, _TICK_STEPS = 40, 4
_SECOND_THOUGHTS = 3
_MOST_STEPS_MORE, _STEPS_A_SECOND, _LATEST_S = 16, 12, 12.0
_MUCH_LATER_S, _AS_GOOD = 1.0, 0.7
_PACES = (0.8, 0.45, 0.25)
_FIRST_JOINT_S = (3.5, 6.0)


@dataclass(slots=True)
class ConvexPlanner:
    """Plans and re-plans the heroes of one scene over one run; a `HeroDriver`."""

    scene: Scene
    structure: Structure
    limits: Mapping[int, Limits]
    predictor: Predictor
    conditions: tuple[LinearCondition, ...]
    plan: Plan = field(init=False)
    ego_knots_s: dict[str, float] = field(init=False, default_factory=dict)
    records: list[Replan] = field(init=False, default_factory=list)
    program: Program = field(init=False)
    _samples: list[EgoSample] = field(init=False, default_factory=list)
    _times: TriggerTimes = field(init=False)
    _clearances: dict[int, Clearance] = field(init=False, default_factory=dict)
    _joint_s: dict[int, float] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self.program = Program(self.scene, self.structure, self.limits)
        cruise_mps = self.limits[EGO].natural_approach_speed_mps
        self._times = TriggerTimes(self.scene, self.structure, self.conditions, self.predictor, cruise_mps)
        for hero in self.scene.program.heroes:
            clearance = Clearance.of(self.scene, self.structure, self.conditions, hero)
            if clearance is not None:
                self._clearances[hero.id] = clearance

    # -- the first plan -----------------------------------------------------------------------------------------------
    def begin(self, ego: EgoSample) -> Attempt:
        """Plan from the ego's first state; the plan is kept if there is one."""
        started = time.perf_counter()
        self._samples = [ego]
        self._times.ego_began = ego[1:3]
        self.ego_knots_s = {self.scene.program.ego.sketch.knots[0]: 0.0}
        prediction = self.predictor.predict([ego])
        best: tuple[Solution, Plan] | None = None
        joint = any(
            self.structure.trigger_knot(hero.id) and self._times.ego_side(hero) is None and hero.id not in self._times._lags
            for hero in self.scene.program.heroes
        )
        for joint_s in _FIRST_JOINT_S if joint else (0.0,):
            for pace in _PACES:
                found = self._first(prediction, joint_s, pace)
                if best is None or found[0].cost < best[0].cost:
                    best = found
        assert best is not None
        for _ in range(_SECOND_THOUGHTS if self._times.leaders else 1):
            # Its cells are laid for the times that it has now; and an ego that follows a hero answers what that does.
            self.plan = best[1]
            best = self._first(self._foresee(), self._joint_of(best[1]), 1.0, best[1])
        self.plan = best[1]
        for hero in self.scene.program.heroes:
            name = self.structure.trigger_knot(hero.id)
            if name is not None:
                self._joint_s[hero.id] = self.plan.profiles[hero.id].knot_times_s[name]
        wall_s = time.perf_counter() - started
        missed = best[0].missed
        status = "sat" if missed < 0.2 else "relaxed"
        attempt = Attempt(self.plan, status, "", wall_s, best[0].steps, promises_outcome=best[0].late_s <= 0.0)
        self.records = [Replan(0.0, status, "daqp", wall_s, missed, "")]
        return attempt

    def _first(
        self, prediction: Profile, joint_s: float, pace: float, before: Plan | None = None
    ) -> tuple[Solution, Plan]:
        """Return a first plan, from a guess of triggers and pace or from another plan."""
        situation = self._situation(0.0, prediction, joint_s)
        if before is not None:
            times = {
                self.program.knot(hero.id, name): time_s
                for hero in self.scene.program.heroes
                for name, time_s in before.profiles[hero.id].knot_times_s.items()
            }
            expected = {instant: times.get(instant, time_s) for instant, time_s in situation.expected_s.items()}
            situation = replace(situation, expected_s=expected, guesses=before.profiles)
        else:
            situation = replace(situation, guesses=self._even_motions(situation, pace))
        problem = Problem(self.program, situation)
        z = np.array(problem.guess)
        solution = solve(problem, z, _FIRST_STEPS)
        return solution, self._made(problem, solution, prediction)

    def _even_motions(self, situation: Situation, pace: float) -> dict[int, Profile]:
        """Return first guesses: everybody comes evenly to where a condition at its trigger wants it."""
        found = {}
        for hero in self.scene.program.heroes:
            speed_mps = pace * self.limits[hero.id].natural_approach_speed_mps
            instant = self.program.trigger(hero.id)
            trigger_s = situation.knots_s.get(instant, situation.expected_s.get(instant, 0.0)) if instant is not None else 0.0
            place_m = 50.0 + speed_mps * trigger_s
            for condition in self.conditions:
                others = {a: situation.ego(trigger_s)[:2] for a in condition.weights if a == EGO}
                known = set(condition.weights) == {*others, hero.id}
                if known and condition.moments <= self.structure.triggers.get(hero.id, frozenset()):
                    per_metre = condition.weights[hero.id][0]
                    if per_metre:
                        rest = condition.value({**others, hero.id: (0.0, speed_mps)})
                        place_m = -rest / per_metre
                        break
            first = place_m - speed_mps * trigger_s
            found[hero.id] = Profile(chain(0.0, first, speed_mps, [(trigger_s, 0.0, 0)]), {hero.sketch.knots[0]: 0.0})
        return found

    def _joint_of(self, plan: Plan) -> float:
        """Return when the first trigger comes in a plan (s)."""
        names = [(hero.id, self.structure.trigger_knot(hero.id)) for hero in self.scene.program.heroes]
        return min((plan.profiles[hero].knot_times_s[name] for hero, name in names if name), default=0.0)

    # -- one tick -----------------------------------------------------------------------------------------------------
    @property
    def is_alarmed(self) -> bool:
        """Whether the ego has just changed its mind while a hero can still answer."""
        if not jumped(lately(self._samples, _EVEN_S)):
            return False
        return any(self._open_piece(hero, self._samples[-1][0]) is not None for hero in self.scene.program.heroes)

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step, and of the knots that it passed in it."""
        previous = self._samples[-1]
        self._samples.append(sample)
        for hero, instant in self.structure.triggers.items():
            planned = self.plan.profiles[hero].knot_times_s.get(self.structure.trigger_knot(hero) or "")
            if planned is not None and planned <= sample[0]:
                for owner, name in instant:
                    if owner == EGO:
                        self.ego_knots_s.setdefault(name, planned)
        knots = self.scene.program.ego.sketch.knots
        for condition in self._times.ego_alone():
            knot = next(iter(condition.moments))[1]
            if knot in self.ego_knots_s or any(k not in self.ego_knots_s for k in knots[: knots.index(knot)]):
                continue
            before = condition.value({EGO: (previous[1], previous[2])})
            after = condition.value({EGO: (sample[1], sample[2])})
            if before == after or before * after > 0:
                continue
            self.ego_knots_s[knot] = previous[0] + before / (before - after) * (sample[0] - previous[0])

    def tick(self, time_s: float) -> Replan:
        """Re-solve where that is needed, and return what came of it."""
        started = time.perf_counter()
        if all(self._open_piece(hero, time_s) is None for hero in self.scene.program.heroes):
            record = Replan(time_s, "frozen", "", 0.0, self.plan.tolerance, "after its trigger the hero does not adapt")
        else:
            prediction = self._foresee()
            problem = Problem(self.program, self._situation(time_s, prediction, None))
            solution = solve(problem, np.array(problem.guess), _TICK_STEPS + self._more_steps(problem))
            self.plan = self._made(problem, solution, prediction)
            record = Replan(time_s, "sat", "daqp", 0.0, solution.missed, "")
        record = replace(record, wall_s=time.perf_counter() - started)
        self.records.append(record)
        return record

    def _more_steps(self, problem: Problem) -> int:
        """Return how many more steps a plan takes for which triggers come at other times than before."""
        moved_s = 0.0
        for hero in self.scene.program.heroes:
            name = self.structure.trigger_knot(hero.id)
            if name is not None:
                planned_s = self.plan.profiles[hero.id].knot_times_s[name]
                moved_s = max(moved_s, abs(problem.now.knots_s.get(self.program.knot(hero.id, name), planned_s) - planned_s))
        return min(_MOST_STEPS_MORE, int(_STEPS_A_SECOND * moved_s))

    def ego_stood_s(self, time_s: float) -> float:
        """Return for how long the ego has not moved (s)."""
        for sample in reversed(self._samples):
            if sample[2] > 0.1:
                return time_s - sample[0]
        return time_s

    # -- what is known ------------------------------------------------------------------------------------------------
    def _foresee(self) -> Profile:
        prediction = self.predictor.predict(self._samples)
        for hero_id, clearance in self._times.leaders.items():
            leader = Leader(self.plan.profiles[hero_id], clearance.offset_m)
            prediction = foresee_follower(prediction, self._samples, leader, self._times.cruise_mps)
        return prediction

    def _answers(self, time_s: float, prediction: Profile, first: bool) -> dict[int, Answer]:
        """Return how the ego answers heroes that it follows, from how it would answer one that is a metre further on."""
        if time_s >= 0.0 and not hasattr(self, "plan"):
            return {}
        found = {}
        for hero_id, clearance in self._times.leaders.items():
            name = self.structure.trigger_knot(hero_id)
            profile = self.plan.profiles[hero_id]
            trigger_s = profile.knot_times_s.get(name or "", time_s)
            if trigger_s <= time_s:
                continue
            further = _Further(profile, time_s, trigger_s, first)
            alone = self.predictor.predict(self._samples)
            other = foresee_follower(
                alone, self._samples, Leader(further, clearance.offset_m), self._times.cruise_mps
            ).state(trigger_s)
            base = prediction.state(trigger_s)
            found[hero_id] = Answer(profile, other[0] - base[0], other[1] - base[1])
        return found

    def _trigger_s(self, hero: Actor, time_s: float, prediction: Profile, planned: PlannedTrigger | None) -> float:
        """Return when a trigger comes of which the ego decides: where it is at its side, or as good as at it.

        A time to arrival that an ego hardly reaches before it slows down may be forecast for now or for much later.
        """
        found = self._times.instants_s(hero, time_s, prediction, self.ego_knots_s, planned)[0]
        # What is far off is not foreseen: it is enough to know that it is.
        found = found if planned is None else min(found, time_s + _LATEST_S)
        if planned is None or found < planned.time_s + _MUCH_LATER_S:
            return found
        soonest = max(time_s + 0.02, planned.time_s - _MUCH_LATER_S)
        tries = np.arange(soonest, planned.time_s + _MUCH_LATER_S, 0.05)
        misses = [self._times.ego_miss(hero, prediction, float(at_s)) for at_s in tries]
        best = int(np.argmin(misses)) if len(misses) else 0
        return float(tries[best]) if misses and 0.0 < misses[best] <= _AS_GOOD else found

    def _settled_s(self, joint: Mapping[int, float], time_s: float) -> dict[int, float]:
        """Return from when on heroes are settled for long enough, whose triggers both decide."""
        found = {}
        for hero in self.scene.program.heroes:
            name = self.structure.trigger_knot(hero.id)
            if name is None or (instant := self.program.knot(hero.id, name)) not in joint:
                continue
            begins = hero.sketch.pieces[hero.sketch.knots.index(name)]
            sense = 1.0 if begins == "acc" else -1.0
            profile = self.plan.profiles[hero.id]
            steps = [time_s - 0.05 * k for k in range(12) if time_s >= 0.05 * k]
            pulled = [at_s for at_s in steps if sense * profile.state(at_s - 1e-6)[2] > PREFERENCES.settled_mpss + 0.1]
            if pulled:
                found[instant] = pulled[0] + PREFERENCES.settled_s
        return found

    def _apart(self) -> dict[int, tuple[float, float]]:
        """Return for heroes on the ego's lane on which side they keep (1 ahead, -1 behind), and what to add to theirs."""
        return {hero: (1.0 if c.ahead else -1.0, c.offset_m) for hero, c in self._clearances.items()}

    def _situation(self, time_s: float, prediction: Profile, joint_s: float | None) -> Situation:
        """Return what to plan from; `joint_s` is a first guess of triggers that both decide."""
        first = joint_s is not None
        knots: dict[int, float] = {}
        expected: dict[int, float] = {}
        triggers: dict[int, float] = {}
        heroes: dict[int, tuple[float, int, Profile]] = {}
        joint: dict[int, float] = {}
        for hero in self.scene.program.heroes:
            name = self.structure.trigger_knot(hero.id)
            if not first:
                piece = self._open_piece(hero, time_s)
                profile = self.plan.profiles[hero.id]
                frozen = len(hero.sketch.pieces) if piece is None else piece
                begin_s = max(time_s, profile.knot_times_s.get(hero.sketch.knots[frozen], time_s))
                heroes[hero.id] = (begin_s, frozen, profile)
                for number, knot in enumerate(hero.sketch.knots):
                    instant = self.program.knot(hero.id, knot)
                    (knots if number <= frozen else expected)[instant] = profile.knot_times_s[knot]
                if piece is None:
                    knots[self.program.knot(hero.id, hero.sketch.knots[-1])] = profile.knot_times_s[hero.sketch.knots[-1]]
            if name is None or self.program.knot(hero.id, name) in knots:
                continue
            planned = None if first else self._planned(hero)
            side = self._times.ego_side(hero)
            if side is not None or hero.id in self._times._lags:
                triggers[hero.id] = self._trigger_s(hero, time_s, prediction, planned)
                knots[self.program.knot(hero.id, name)] = triggers[hero.id]
                if planned is not None:  # what follows keeps its place in time after it
                    for knot in hero.sketch.knots[hero.sketch.knots.index(name) + 1 :]:
                        instant = self.program.knot(hero.id, knot)
                        if instant in expected:
                            expected[instant] += triggers[hero.id] - planned.time_s
            elif first:
                expected[self.program.knot(hero.id, name)] = joint[self.program.knot(hero.id, name)] = joint_s or 0.0
            else:
                joint[self.program.knot(hero.id, name)] = self._joint_s[hero.id]
        if first:
            self._expect(expected, knots)
        for name, at_s in self._times.ego_knots_s(time_s, prediction, self.ego_knots_s, triggers).items():
            knots.setdefault(self.program.knot(EGO, name), at_s)
        return Situation(time_s, _EgoStates(self._samples, prediction), knots, expected, heroes, joint, isinstance(self.predictor, ConstantSpeed), self._answers(time_s, prediction, first), self._apart(), frozenset(triggers), {} if first else self._settled_s(joint, time_s))

    def _expect(self, expected: dict[int, float], knots: Mapping[int, float]) -> None:
        for actor in self.scene.program.actors:
            now = 0.0
            for name in actor.sketch.knots:
                instant = self.program.knot(actor.id, name)
                now = knots.get(instant, expected.setdefault(instant, now + 2.0) if instant not in knots else now)

    def _planned(self, hero: Actor) -> PlannedTrigger:
        profile = self.plan.profiles[hero.id]
        name = self.structure.trigger_knot(hero.id) or ""
        trigger = hero.sketch.knots.index(name)
        approach = tuple(segment for segment in profile.segments if segment.piece < trigger)
        return PlannedTrigger(profile.knot_times_s[name], Profile(approach or profile.segments[:1]))

    def _open_piece(self, hero: Actor, time_s: float) -> int | None:
        """Return the piece from which on `hero` is still solved for, or None once it only carries out."""
        times, sketch = self.plan.profiles[hero.id].knot_times_s, hero.sketch
        current = sum(1 for knot in sketch.knots[1:] if times.get(knot, float("inf")) <= time_s)
        trigger = self.structure.trigger_knot(hero.id)
        if trigger is None:
            return None
        if current < sketch.knots.index(trigger):
            return current
        reactive = self._reactive_piece(hero)
        return reactive if reactive is not None and current <= reactive else None

    def _reactive_piece(self, hero: Actor) -> int | None:
        """Return the standing piece after the trigger whose end a constraint with the ego depends on."""
        knots = hero.sketch.knots
        trigger = self.structure.trigger_knot(hero.id)
        begin = knots.index(trigger) if trigger else 0
        for piece in range(begin + 1, len(hero.sketch.pieces)):
            if hero.sketch.pieces[piece] != "stop":
                continue
            later = set(knots[piece + 1 :])
            for constraint in self.scene.program.constraints:
                keys = set(knots_of(constraint.formula))
                if self.structure.roles[constraint.id] is Role.OUTCOME and any(
                    a == hero.id and k in later for a, k in keys
                ) and any(a == EGO for a, _ in keys):
                    return piece
        return None

    def _made(self, problem: Problem, solution: Solution, prediction: Profile) -> Plan:
        """Return the plan that values stand for, with what was driven before it."""
        profiles: dict[int, Profile] = {}
        shots = problem.shots(solution.z)
        for hero in self.scene.program.heroes:
            knots_s = {}
            for name in hero.sketch.knots:
                knots_s[name] = problem._moments[self.program.knot(hero.id, name)].value(solution.z)
            past = []
            if hero.id in problem.now.heroes:
                begin_s, piece, profile = problem.now.heroes[hero.id]
                if piece >= len(hero.sketch.pieces):
                    profiles[hero.id] = profile
                    continue
                past = [s if s.end_s <= begin_s else s.part(s.start_s, begin_s) for s in profile.segments if s.start_s < begin_s - 1e-9]
            profiles[hero.id] = profile_of(shots[hero.id], knots_s, past)
        ego_knots = {
            name: problem._moments[self.program.knot(EGO, name)].value(solution.z)
            for name in self.scene.program.ego.sketch.knots
        }
        profiles[EGO] = Profile(prediction.segments, ego_knots)
        parameters = {name: float(value) for name, value in self.scene.parameters.items()}
        return Plan(profiles, solution.missed, "convex", parameters)


@dataclass(slots=True)
class _EgoStates:
    """The ego's past, as it was seen, and from now on as it is foreseen."""

    samples: list[EgoSample]
    prediction: Profile

    def __call__(self, time_s: float) -> tuple[float, float, float]:
        if time_s >= self.samples[-1][0]:
            return self.prediction.state(time_s)
        k = max(bisect_right(self.samples, time_s, key=lambda sample: sample[0]) - 1, 0)
        then_s, s_m, speed, accel = self.samples[k]
        since = time_s - then_s
        return s_m + (speed + 0.5 * accel * since) * since, speed + accel * since, accel


@dataclass(frozen=True, slots=True)
class _Further:
    """A motion that is a metre further on at an instant: ever more so from now on, or all along."""

    motion: Profile
    from_s: float
    at_s: float
    all_along: bool

    def state(self, time_s: float) -> tuple[float, float, float]:
        s_m, speed_mps, accel = self.motion.state(time_s)
        if self.all_along:
            return s_m + 1.0, speed_mps, accel
        lasts, since = max(self.at_s - self.from_s, 0.1), max(0.0, time_s - self.from_s)
        return s_m + (since / lasts) ** 2, speed_mps + 2.0 * since / lasts**2, accel + 2.0 / lasts**2
