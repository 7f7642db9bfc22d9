"""The closed loop's mind: holds the plan, and solves the rest of it again as the ego turns out to drive.

What enters: the ego's states, tick by tick. What leaves: the heroes' motions, and a record of every re-solve. History
is fixed; a hero freezes at its trigger, but for later pieces that react to the ego.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from dataclasses import InitVar, dataclass, field, replace
from functools import partial
from itertools import product

from scenewright.motion.profile import Profile, chain
from scenewright.plan.afterwards import goes_on
from scenewright.plan.asked import Asked
from scenewright.plan.foresight import Foresight, Motions
from scenewright.plan.guesses import even_motions, meet_later
from scenewright.plan.pairs import Meeting, in_order, meetings_of, needed
from scenewright.plan.prediction import EgoSample, Predictor
from scenewright.plan.problem import Missed, Problem
from scenewright.plan.shooting import profile_of
from scenewright.plan.situation import Drive, Situation
from scenewright.plan.solving import Solution, solve
from scenewright.plan.triggers import SHORTEST_LEAD_S, TriggerTimes
from scenewright.plan.unknowns import AFTER_LAST_S
from scenewright.program.structure import Role, Structure, knots_of
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition, linear_conditions
from scenewright.solve.limits import Limits
from scenewright.solve.plan import Plan

# Newton steps of a first plan and of a tick, and how many more a tick has for each second that a trigger has moved by:
# a step of several heroes counts for each of them, and the next tick goes on. Measured: fewer than four lose orders.
_FIRST_STEPS, _TICK_STEPS, _STEPS_A_SECOND, _MOST_STEPS_MORE = 40, 4, 12, 16
# First plans are solved for from these speeds (shares of the natural one) and, where both decide, triggers (s): Newton
# finds the nearest plan, not the best.
_PACES, _JOINT_S = (0.8, 0.45, 0.25), (3.5, 6.0)
# By how much a trigger of several heroes moves in a tick at most (s), unless it comes so soon (s) that it has to: steps
# from far off are slow. Measured: ticks with an ego that stops and goes take a third as long, and as many are met.
_MOVES_S, _SOON_S = 0.5, 1.0
# What a step has to gain in a tick, from which the next one goes on, and in any plan for each further hero. A tight
# tolerance that is missed costs hundreds. Measured: with 0.01 ticks take half as long, and 133 runs are met as often.
_ENOUGH_TICK, _ENOUGH_EACH = 0.01, 0.3
# How often a first plan is solved for again with an ego that follows a hero and answers what that does; chosen. It
# ends before where nothing is missed.
_AGAIN_LED = 16
# How many meetings of heroes are turned at most, and what is clear enough (m^2, summed over times: 14 cm once); chosen.
_MOST_TURNS, _CLEAR_ENOUGH = 6, 0.02
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
    """A plan, how and for what problem it was found, all its moments by instant, and its other unknowns, by number.

    And who goes first wherever heroes meet.
    """

    plan: Plan
    solution: Solution
    moments_s: Mapping[int, float]
    others: Mapping[int, float]
    problem: Problem
    meetings: tuple[Meeting, ...]


@dataclass(slots=True)
class Planner:
    """Plans and re-plans the heroes of one scene over one run.

    Attributes
    ----------
    limits
        Of every actor, by id.
    predictor
        Foresees the ego where it follows nobody.
    conditions
        The scene's linear conditions.
    plan
        The motion that is being carried out.
    ego_knots_s
        When the ego passed its knots.
    """

    scene: Scene
    structure: Structure
    limits: Mapping[int, Limits]
    predictor: InitVar[Predictor]
    conditions: tuple[LinearCondition, ...]
    plan: Plan = field(init=False)
    ego_knots_s: dict[str, float] = field(init=False, default_factory=dict)
    records: list[Replan] = field(init=False, default_factory=list)
    _asked: Asked = field(init=False)
    _times: TriggerTimes = field(init=False)
    _moments_s: Mapping[int, float] = field(init=False, default_factory=dict)  # as in _Found, of the plan
    _others: Mapping[int, float] = field(init=False, default_factory=dict)
    _ego: Foresight = field(init=False)
    _meetings: tuple[Meeting, ...] = field(init=False, default=())
    _steps: int = field(init=False, default=0)
    _joint_s: dict[int, float] = field(init=False, default_factory=dict)  # first planned, where both decide when

    def __post_init__(self, predictor: Predictor) -> None:
        self._asked = Asked(self.scene, self.structure, self.limits)
        self._times = TriggerTimes(self.scene, self.structure, self.conditions)
        cruise_mps = self.limits[EGO].natural_approach_speed_mps
        told = linear_conditions(self.scene, self.structure, with_bounds=True)
        self._ego = Foresight(self.scene, self.structure, told, predictor, cruise_mps)

    # -- the first plan -----------------------------------------------------------------------------------------------
    def begin(self, ego: EgoSample) -> Attempt:
        """Plan from the ego's first state; the plan is kept."""
        started = time.perf_counter()
        self._ego.samples, self._times.ego_began = [ego], ego[1:3]
        self.ego_knots_s = {self.scene.program.ego.sketch.knots[0]: 0.0}
        prediction = self._ego.predictor.predict([ego])
        joint = any(h.id in self.structure.triggers and not self._times.ego_decides(h) for h in self._heroes)
        even, tries = partial(even_motions, self._asked, self._times, prediction), list[_Found]()
        meetings = meetings_of(self.scene)
        placed = bool(meetings) and not meet_later(self.scene.program, self.structure) and even(0.0, 1.0)[1]
        # Who comes slowly can still do either; where nothing tells when, a slow guess would just stay slow.
        for joint_s, pace in product(_JOINT_S if joint else (0.0,), reversed(_PACES) if placed else _PACES):
            guesses, _ = even(joint_s, pace)
            if placed:
                self._meetings = in_order(meetings, self.scene, self.structure, guesses)
            tries.append(self._planned_first(prediction, joint_s, guesses))
            if meetings and tries[-1].solution.missed.by <= GOOD:
                break
        best = min(tries, key=lambda found: found.solution.cost)
        self._keep(best)
        if self._ego.take_sides(self.plan.profiles, self._asked.adapts_until):
            best = self._planned_first(best.plan.profiles[EGO], 0.0, best.plan.profiles)
            self._keep(best)
        if self._ego.leaders:
            best = self._led(best)
        if meetings and not placed:
            self._keep(best)
            self._meetings = in_order(meetings, self.scene, self.structure, best.plan.profiles)
        if not (self._ego.leaders or placed) or self._meetings != best.meetings:
            best = self._planned_first(best.plan.profiles[EGO], 0.0, best.plan.profiles)
        best = self._turned(best)
        self._keep(best)
        self._meetings = needed(best.meetings)
        self._joint_s = {h: self.plan.profiles[h].knot_times_s[self._name(h)] for h in self.structure.triggers}
        missed, wall_s = best.solution.missed, time.perf_counter() - started
        foreseen = self.plan.profiles[EGO]
        self.records = [Replan(0.0, _status(best.solution), "daqp", wall_s, missed.by, "", foreseen)]
        return Attempt(self.plan, missed, self._steps)

    def _keep(self, found: _Found) -> None:
        self.plan, self._moments_s, self._others = found.plan, found.moments_s, found.others
        self._meetings = found.meetings

    def _planned_first(self, prediction: Profile, joint_s: float, guesses: Motions, trusted: float = 1.0) -> _Found:
        """Return a first plan that is found from guesses: motions, or other plans with all their knots.

        Of a longest step `trusted` is the share by which it may be off from them: 1 is no limit, 0 leaves them as they
        are.
        """
        problem = Problem(self._asked, self._first_situation(prediction, joint_s, guesses), needed(self._meetings))
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
            trial = self._planned_first(best.plan.profiles[EGO], 0.0, best.plan.profiles)
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
            trial = self._answered(self._planned_first(best.plan.profiles[EGO], 0.0, best.plan.profiles, trusted))
            if trial.solution.cost < best.solution.cost:
                best = trial
            else:
                trusted *= 0.5
        return best

    def _answered(self, found: _Found) -> _Found:
        """Return a first plan, and what it costs, with the ego that answers it: it was made with one that did not."""
        self._keep(found)
        return self._planned_first(self._ego.foreseen(found.plan.profiles), 0.0, found.plan.profiles, trusted=0.0)

    def _first_situation(self, prediction: Profile, joint_s: float, guesses: Mapping[int, Profile]) -> Situation:
        triggers = {
            hero.id: self._times.instant_s(hero, 0.0, prediction, None)
            for hero in self._heroes
            if self._times.ego_decides(hero)
        }
        knots = {self._asked.knot(hero, self._name(hero)): at_s for hero, at_s in triggers.items()}
        knots |= self._ego_knots(0.0, prediction, triggers, knots)
        expected: dict[int, float] = {}
        planned: dict[int, float] = {}
        for hero in self._heroes:
            if hero.id not in triggers and (name := self.structure.trigger_knot(hero.id)) is not None:
                instant = self._asked.knot(hero.id, name)
                expected[instant] = planned[instant] = guesses[hero.id].knot_times_s.get(name, joint_s)
        for actor in self.scene.program.actors:
            now, told = 0.0, guesses[actor.id].knot_times_s if actor.id in guesses else {}
            for name in actor.sketch.knots:
                instant = self._asked.knot(actor.id, name)
                if instant not in knots:
                    soonest_s = [at_s + self._asked.least_s[known, instant] for known, at_s in knots.items()]
                    chained = self.structure.trigger_knot(actor.id) is None and actor.id in self._asked.adapts_until
                    usual_s = max([now + self._asked.wanted.lasts_s, *(soonest_s if chained else ())])
                    expected.setdefault(instant, told.get(name, usual_s))
                now = knots.get(instant, expected.get(instant, now))
        for instant, at_s in self._moments_s.items():
            if instant not in knots:
                expected.setdefault(instant, at_s)
        return Situation(
            0.0,
            self._ego.states(prediction),
            knots,
            expected,
            guesses=guesses,
            others=self._others,
            planned_s=planned,
            waits=frozenset(triggers),
            sure=self._ego.is_sure,
            lanes=self._ego.lanes(guesses, 0.0, prediction, first=True),
        )

    # -- one tick -----------------------------------------------------------------------------------------------------
    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step, and of the knots that it passed in it."""
        previous = self._ego.samples[-1]
        self._ego.samples.append(sample)
        for hero, instant in self.structure.triggers.items():
            planned = self.plan.profiles[hero].knot_times_s.get(self._name(hero))
            if planned is not None and planned <= sample[0]:
                for owner, name in instant:
                    if owner == EGO:
                        self.ego_knots_s.setdefault(name, planned)  # the moment is the same
        knots = self.scene.program.ego.sketch.knots
        for condition in self._times.ego_alone():
            knot = next(iter(condition.moments))[1]
            if knot in self.ego_knots_s or any(k not in self.ego_knots_s for k in knots[: knots.index(knot)]):
                continue
            before, after = (condition.value({EGO: state[1:3]}) for state in (previous, sample))
            if before != after and before * after <= 0:
                self.ego_knots_s[knot] = previous[0] + before / (before - after) * (sample[0] - previous[0])

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
            self._keep(self._made(problem, solution, prediction))
            foreseen = self.plan.profiles[EGO]
            record = Replan(time_s, _status(solution), "daqp", 0.0, solution.missed.by, "", foreseen)
        record = replace(record, wall_s=time.perf_counter() - started)
        self.records.append(record)
        return record

    def _go_on(self, time_s: float) -> None:
        """Let heroes whose plan is over brake for bends, and keep clear of those that go first."""
        profiles, done = dict(self.plan.profiles), False
        for hero in self._heroes:
            if max(profiles[hero.id].knot_times_s.values()) + AFTER_LAST_S <= time_s:
                caps, done = self._asked.caps[hero.id], True
                profiles[hero.id] = goes_on(hero.id, profiles, self._meetings, time_s, self._asked.wanted, caps)
        if done:
            self.plan = replace(self.plan, profiles=profiles)

    def _situation(self, time_s: float, prediction: Profile) -> tuple[Situation, float]:
        """Return what to plan from now, and by how much triggers have moved of which the ego decides (s)."""
        knots: dict[int, float] = {}
        expected: dict[int, float] = {}
        planned: dict[int, float] = {}
        drives: dict[int, Drive] = {}
        triggers: dict[int, float] = {}
        moved_s = 0.0
        for hero in self._heroes:
            profile, names = self.plan.profiles[hero.id], hero.sketch.knots
            piece = self._open_piece(hero, time_s)
            first = len(hero.sketch.pieces) if piece is None else piece
            begin_s = max(time_s, profile.knot_times_s.get(names[first], time_s))
            drives[hero.id] = Drive(begin_s, first, profile)
            for number, name in enumerate(names):
                (knots if number <= first else expected)[self._asked.knot(hero.id, name)] = profile.knot_times_s[name]
            trigger = self.structure.trigger_knot(hero.id)
            if trigger is None or (instant := self._asked.knot(hero.id, trigger)) in knots:
                continue
            if not self._times.ego_decides(hero):
                planned[instant] = self._joint_s[hero.id]
                sooner_s = self._comes_true_s(hero, time_s, prediction, profile.knot_times_s[trigger])
                if sooner_s is not None:
                    expected[instant] = planned[instant] = sooner_s
                continue
            before_s = profile.knot_times_s[trigger]
            then_s = self._times.instant_s(hero, time_s, prediction, before_s)
            if len(self.scene.program.heroes) > 1:
                most_s = max(_MOVES_S, abs(then_s - before_s) * _SOON_S / (then_s - time_s))
                then_s = min(max(then_s, before_s - most_s), before_s + most_s)
            triggers[hero.id] = knots[instant] = then_s
            moved_s = max(moved_s, abs(knots[instant] - before_s))
            for later in names[names.index(trigger) + 1 :]:  # what follows keeps its place in time after it
                expected[self._asked.knot(hero.id, later)] += knots[instant] - before_s
        knots |= self._ego_knots(time_s, prediction, triggers, knots)
        for instant, at_s in self._moments_s.items():  # places that were passed, and what happened, are history too
            if instant not in knots and instant not in expected:
                (knots if at_s <= time_s else expected)[instant] = at_s
        situation = Situation(
            time_s,
            self._ego.states(prediction),
            knots,
            expected,
            drives,
            others=self._others,
            planned_s=planned,
            waits=frozenset(triggers),
            sure=self._ego.is_sure,
            lanes=self._ego.lanes(self.plan.profiles, time_s, prediction, first=False),
        )
        return situation, moved_s

    def _comes_true_s(self, hero: Actor, time_s: float, prediction: Profile, planned_s: float) -> float | None:
        """Return when a condition on both comes true before it is planned to, if the hero goes on as it is.

        An ego that follows a hero answers whatever that does: the less it does, the better the ego is foreseen.
        """
        here = [c for c in self.conditions if c.moments <= self.structure.triggers[hero.id]]
        if len(here) != 1 or set(here[0].weights) != {EGO, hero.id}:
            return None
        s_m, speed_mps, _ = self.plan.profiles[hero.id].state(time_s)
        even = Profile(chain(time_s, s_m, speed_mps, [(1.0, 0.0, 0)]))
        found = here[0].first_time({EGO: prediction, hero.id: even}, time_s + SHORTEST_LEAD_S)
        return found if found is not None and found < planned_s else None

    def _made(self, problem: Problem, solution: Solution, prediction: Profile) -> _Found:
        """Return the plan that values stand for, with what was driven before it."""
        self._steps += solution.steps
        times = [moment.value(solution.z) for moment in problem.moments]
        profiles = {hero: drive.motion for hero, drive in problem.now.heroes.items()}
        for hero, shot in problem.shots(solution.z).items():
            sketch = self.scene.program.actor(hero).sketch
            drive = problem.now.heroes.get(hero)
            past = [] if drive is None else [
                segment if segment.end_s <= drive.begin_s else segment.part(segment.start_s, drive.begin_s)
                for segment in drive.motion.segments
                if segment.start_s < drive.begin_s - 1e-9
            ]  # fmt: skip
            profiles[hero] = profile_of(
                shot, {name: times[self._asked.knot(hero, name)] for name in sketch.knots}, past
            )
        names = self.scene.program.ego.sketch.knots
        profiles[EGO] = Profile(prediction.segments, {name: times[self._asked.knot(EGO, name)] for name in names})
        parameters = {name: float(value) for name, value in self.scene.parameters.items()}
        plan = Plan(profiles, solution.missed.by, parameters)
        return _Found(plan, solution, dict(enumerate(times)), problem.others(solution.z), problem, self._meetings)

    # -- what is known ------------------------------------------------------------------------------------------------
    @property
    def _heroes(self) -> Iterable[Actor]:
        return self.scene.program.heroes

    @property
    def _enough(self) -> float:
        return _ENOUGH_EACH * (len(self.scene.program.heroes) - 1)

    def _name(self, hero: int) -> str:
        return self.structure.trigger_knot(hero) or ""

    def _ego_knots(
        self, time_s: float, prediction: Profile, triggers: Mapping[int, float], known: Mapping[int, float]
    ) -> dict[int, float]:
        """Return when the ego passes its knots, by instant, as far as they are not known."""
        found = self._times.ego_knots_s(time_s, prediction, self.ego_knots_s, triggers)
        instants = {self._asked.knot(EGO, name): at_s for name, at_s in found.items()}
        return {instant: at_s for instant, at_s in instants.items() if instant not in known}

    def _open_piece(self, hero: Actor, time_s: float) -> int | None:
        """Return the piece from which on a hero is still solved for, or None once it only carries out.

        Before its trigger (or what hangs on another's) that is the piece it is in. After it, pieces from the first
        standing one on that a reactive constraint speaks of, up to the moment they have begun to move again.
        """
        times, sketch = self.plan.profiles[hero.id].knot_times_s, hero.sketch
        soon_s = time_s + SHORTEST_LEAD_S  # what comes sooner could only be put off
        current = sum(1 for knot in sketch.knots[1:] if times.get(knot, float("inf")) < soon_s)
        trigger = self._asked.adapts_until.get(hero.id)
        if trigger is None:
            return None
        if current < sketch.knot_index(trigger):
            return current
        reactive = self._reactive_piece(hero, sketch.knot_index(trigger))
        return reactive if reactive is not None and current <= reactive else None

    def _reactive_piece(self, hero: Actor, trigger: int) -> int | None:
        """Return the standing piece after the trigger whose end a constraint with the ego depends on."""
        knots = hero.sketch.knots
        for piece in range(trigger + 1, len(hero.sketch.pieces)):
            if hero.sketch.pieces[piece] is not PieceKind.STOP:
                continue
            later = {(hero.id, name) for name in knots[piece + 1 :]}
            for constraint in self.scene.program.constraints:
                keys = set(knots_of(constraint.formula))
                orders = self.structure.roles[constraint.id] is Role.OUTCOME
                if orders and keys & later and any(actor == EGO for actor, _ in keys):
                    return piece
        return None


def _status(solution: Solution) -> str:
    return "sat" if solution.missed.by <= GOOD else "relaxed"
