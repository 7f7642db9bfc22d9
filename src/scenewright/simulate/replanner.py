"""The closed loop's mind: holds the plan, and solves the rest of it again as the ego turns out to drive.

What enters: the ego's states, tick by tick. What leaves: the heroes' motions, and a record of every re-solve. History
is fixed; a hero freezes at its trigger, but for later pieces that react to the ego; when nothing can be solved the
last plan goes on.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from scenewright.motion.profile import Profile
from scenewright.program.structure import Role, Structure, knots_of
from scenewright.program.types import EGO, Actor
from scenewright.roads.grounding import Scene
from scenewright.simulate.following import Leader, foresee_follower
from scenewright.simulate.leading import ways_to_lead
from scenewright.simulate.prediction import EgoSample, Predictor, jumped, lately
from scenewright.simulate.triggers import PlannedTrigger, TriggerTimes
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.limits import URGENT, WHOLE
from scenewright.solve.plan import Plan
from scenewright.solve.planner import JUST_BEFORE_S, Attempt, Planner
from scenewright.solve.situation import HeroState, Situation

# While much time is left a late or early ego is nothing to act on; the dead band shrinks to almost nothing.
_DEAD_BAND_S = 0.003
_DEAD_BAND_SHARE = 0.02
# By how much (s) a hero may begin too soon or too late.
_ONSET_S = 0.05
# While one is to be settled for a trigger whose moment is free.
_DEAD_BAND_LAST_S = 0.03
# How long an ego must have driven evenly for a jump in its acceleration to be a change of mind.
_EVEN_S = 0.1
_LATE_MISS, _EARLY_MISS = 0.5, 0.12
# After so many failures in a row only every so many ticks are tried: the time of a hopeless run is better spent.
_PATIENT_FAILURES = 20
_RETRY_EVERY = 3
# By how much a trigger that both decide may come later than first planned (s), so that the hero can hold its speed.
_PATIENCE_S = 3.0
# How often a first plan is made again, for an ego that reacts to the one before.
_SECOND_THOUGHTS = 2
# How many ways in which a hero may lead the ego are asked for; in which styles it would rather not drive ahead of it.
_MOST_LED, _HARD = 3, (WHOLE.name, URGENT.name)


@dataclass(frozen=True, slots=True)
class Replan:
    """What one tick's re-solve came to."""

    time_s: float
    status: str
    backend: str
    wall_s: float
    tolerance: float
    reason: str


@dataclass(slots=True)
class Replanner:
    """Plans and re-plans the heroes of one scene over one run.

    Attributes
    ----------
    plan
        The motion that is being carried out.
    ego_knots_s
        When the ego passed its knots.
    """

    scene: Scene
    structure: Structure
    planner: Planner
    predictor: Predictor
    conditions: tuple[LinearCondition, ...]
    plan: Plan = field(init=False)
    ego_knots_s: dict[str, float] = field(init=False, default_factory=dict)
    records: list[Replan] = field(init=False, default_factory=list)
    _samples: list[EgoSample] = field(init=False, default_factory=list)
    _failures: int = field(init=False, default=0)
    _first_trigger_s: float = field(init=False, default=0.0)
    _times: TriggerTimes = field(init=False)
    _settled_s: float = field(init=False)  # for how long a hero is to be settled before its trigger

    def __post_init__(self) -> None:
        cruise_mps = self.planner.limits[EGO].natural_approach_speed_mps
        self._times = TriggerTimes(self.scene, self.structure, self.conditions, self.predictor, cruise_mps)
        self._settled_s = float(self.scene.program.manner.settled_s)

    # -- the first plan ---------------------------------------------------------------------------------------------
    def begin(self, ego: EgoSample) -> Attempt:
        """Plan from the ego's first state; the plan is kept if there is one."""
        self._samples = [ego]
        self._times.ego_began = ego[1:3]
        prediction = self.predictor.predict([ego])
        knots = {self.scene.program.ego.sketch.knots[0]: 0.0}
        attempt = self.planner.first_plan(self._situations(0.0, prediction, knots, {}))
        for _ in range(_SECOND_THOUGHTS if self._times.leaders else 0):
            if attempt.plan is None:
                break
            self.plan = attempt.plan
            followed = self.planner.first_plan(self._situations(0.0, self._foresee(), knots, {}))
            if followed.plan is None:
                break
            attempt = followed
        if attempt.plan is not None:
            self.plan = attempt.plan
            self.ego_knots_s = knots
            self.records = [self._record(0.0, attempt)]
            triggered = [hero for hero in self.scene.program.heroes if self.structure.trigger_knot(hero.id)]
            self._first_trigger_s = max(map(self._planned_trigger_s, triggered), default=0.0)
        return attempt

    # -- one tick ---------------------------------------------------------------------------------------------------
    @property
    def is_alarmed(self) -> bool:
        """Whether the ego has just changed its mind while a hero can still answer."""
        if not jumped(lately(self._samples, _EVEN_S)):
            return False
        return any(self._still_reacts(hero, self._samples[-1][0]) for hero in self.scene.program.heroes)

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step, and of the knots that it passed in it."""
        previous = self._samples[-1]
        self._samples.append(sample)
        self._pass_shared_knots(sample[0])
        for condition in self._times.ego_alone():
            knot = next(iter(condition.moments))[1]
            if knot in self.ego_knots_s or not self._is_next_ego_knot(knot):
                continue
            before = condition.value({EGO: (previous[1], previous[2])})
            after = condition.value({EGO: (sample[1], sample[2])})
            if before == after or before * after > 0:
                continue
            share = before / (before - after)
            self.ego_knots_s[knot] = previous[0] + share * (sample[0] - previous[0])

    def tick(self, time_s: float) -> Replan:
        """Re-solve where that is needed, and return what came of it."""
        started = time.perf_counter()
        reactive = [hero for hero in self.scene.program.heroes if self._still_reacts(hero, time_s)]
        if not reactive:
            record = Replan(time_s, "frozen", "", 0.0, self.plan.tolerance, "after its trigger the hero does not adapt")
        else:
            record = self._resolve(time_s)
        # Everything counts: foreseeing the ego, building, solving, reading back, checking.
        record = replace(record, wall_s=time.perf_counter() - started)
        self.records.append(record)
        return record

    def _foresee(self) -> Profile:
        """Return how the ego will go on, while the heroes do what is planned."""
        prediction = self.predictor.predict(self._samples)
        for hero_id, clearance in self._times.leaders.items():
            leader = Leader(self.plan.profiles[hero_id], clearance.offset_m)
            cruise_mps = self.planner.limits[EGO].natural_approach_speed_mps
            prediction = foresee_follower(prediction, self._samples, leader, cruise_mps)
        return prediction

    def _resolve(self, time_s: float) -> Replan:
        prediction = self._foresee()
        heroes = {hero.id: self._hero_state(hero, time_s) for hero in self.scene.program.heroes}
        situations = self._situations(time_s, prediction, self.ego_knots_s, heroes)
        if self._is_pressed(time_s, prediction, heroes):
            situations = [replace(situation, pressed=True) for situation in situations]
        elif self._plan_still_fits(time_s, situations[0]):
            return Replan(time_s, "kept", "", 0.0, self.plan.tolerance, "the plan still fits the ego")
        if self._failures >= _PATIENT_FAILURES and len(self.records) % _RETRY_EVERY:
            return Replan(time_s, "unsat, last plan goes on", "", 0.0, self.plan.tolerance, "failed a moment ago")
        attempt = self.planner.replan(situations)
        if _is_hard(attempt):
            led = self._led(time_s, heroes)
            other = self.planner.replan(led) if led else attempt
            attempt = other if other.plan is not None and (attempt.plan is None or not _is_hard(other)) else attempt
        self._failures = 0 if attempt.plan is not None else self._failures + 1
        if attempt.plan is not None:
            self.plan = self._continued(attempt.plan, time_s)
        else:
            self._wait_for_joint_triggers(time_s)
        return self._record(time_s, attempt)

    def _led(self, time_s: float, heroes: Mapping[int, HeroState]) -> list[Situation]:
        """Return situations that a hero brings about by driving faster or slower, and the ego by following it."""
        if len(self._times.leaders) != 1 or len(heroes) != 1:
            return []
        hero_id, clearance = next(iter(self._times.leaders.items()))
        hero = self.scene.program.actor(hero_id)
        condition = self._times.joint_condition(hero)
        if condition is None or self.structure.trigger_knot(hero_id) in heroes[hero_id].knots_s:
            return []
        led = ways_to_lead(
            hero_id,
            heroes[hero_id],
            condition,
            self.predictor.predict(self._samples),
            self._samples,
            offset_m=clearance.offset_m,
            top_mps=self.planner.limits[hero_id].approach_speed_max_mps,
            cruise_mps=self.planner.limits[EGO].natural_approach_speed_mps,
            settled_s=self._settled_s,
        )
        return [
            self._situation(time_s, way.ego, self.ego_knots_s, heroes, {hero_id: way.instant_s})
            for way in led[:_MOST_LED]
        ]

    def _is_pressed(self, time_s: float, prediction: Profile, heroes: Mapping[int, HeroState]) -> bool:
        """Whether a hero is about to do what decides who is first, and would come too late for an ego in haste."""
        knots_s = [knot_s for hero in heroes for knot_s in self.plan.profiles[hero].knot_times_s.values()]
        if not any(time_s < knot_s <= time_s + JUST_BEFORE_S for knot_s in knots_s):
            return False
        hasty = self._situations(time_s, self._times.in_haste(prediction, time_s), self.ego_knots_s, heroes)[0]
        return not hasty.trigger_s and not self._plan_still_fits(time_s, hasty)

    def _wait_for_joint_triggers(self, time_s: float) -> None:
        """Let heroes whose trigger both decide go on as they are: to begin at the old moment would be too early."""
        for hero in self.scene.program.heroes:
            profile, knot = self.plan.profiles[hero.id], self.structure.trigger_knot(hero.id)
            planned = profile.knot_times_s.get(knot or "", -1.0)
            if time_s < planned < time_s + self._settled_s and self._times.ego_side(hero) is None:
                later = {**self.plan.profiles, hero.id: profile.held(planned, self._settled_s)}
                self.plan = replace(self.plan, profiles=later)

    def _record(self, time_s: float, attempt: Attempt) -> Replan:
        tolerance = attempt.plan.tolerance if attempt.plan else self.plan.tolerance
        reason = attempt.reason or (attempt.plan.style if attempt.plan else "")
        status = attempt.status if attempt.plan else f"{attempt.status}, last plan goes on"
        return Replan(time_s, status, self.planner.backend.name, attempt.wall_s, tolerance, reason)

    def _continued(self, plan: Plan, time_s: float) -> Plan:
        """Return the new plan with what the old one did before, so that a profile tells a hero's whole motion."""
        profiles = dict(plan.profiles)
        for hero in self.scene.program.heroes:
            new, old = plan.profiles[hero.id], self.plan.profiles[hero.id]
            past = [segment for segment in old.segments if segment.start_s < new.start_s - 1e-9]
            if past:
                last = past[-1]
                if last.end_s > new.start_s:
                    past[-1] = type(last)(
                        last.start_s, new.start_s - last.start_s, last.s_m, last.speed_mps, last.accel_mpss, last.piece
                    )
            profiles[hero.id] = Profile((*past, *new.segments), new.knot_times_s)
        return Plan(profiles, plan.tolerance, plan.style, plan.parameters)

    def ego_stood_s(self, time_s: float) -> float:
        """Return for how long the ego has not moved (s)."""
        for sample in reversed(self._samples):
            if sample[2] > 0.1:
                return time_s - sample[0]
        return time_s

    # -- what is known ----------------------------------------------------------------------------------------------
    def _is_next_ego_knot(self, knot: str) -> bool:
        knots = self.scene.program.ego.sketch.knots
        return all(earlier in self.ego_knots_s for earlier in knots[: knots.index(knot)])

    def _pass_shared_knots(self, time_s: float) -> None:
        """Take a trigger that a hero carried out as the ego's knot too: the moment is the same."""
        for hero, instant in self.structure.triggers.items():
            knot = self.structure.trigger_knot(hero)
            planned = self.plan.profiles[hero].knot_times_s.get(knot or "")
            if planned is not None and planned <= time_s:
                for owner, name in instant:
                    if owner == EGO:
                        self.ego_knots_s.setdefault(name, planned)

    def _still_reacts(self, hero: Actor, time_s: float) -> bool:
        first = self._first_open_piece(hero, time_s)
        return first is not None

    def _first_open_piece(self, hero: Actor, time_s: float) -> int | None:
        """Return the piece from which on `hero` is still solved for, or None once it only carries out.

        Before its trigger that is the piece it is in. After it, pieces from the first standing one on that a reactive
        constraint speaks of, up to the moment they have begun to move again.
        """
        times = self.plan.profiles[hero.id].knot_times_s
        sketch = hero.sketch
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
                if self.structure.roles[constraint.id] is not Role.OUTCOME:
                    continue
                if any(a == hero.id and k in later for a, k in keys) and any(a == EGO for a, _ in keys):
                    return piece
        return None

    def _hero_state(self, hero: Actor, time_s: float) -> HeroState:
        """Return where `hero` can still be re-planned from: now, or where its frozen pieces end."""
        profile = self.plan.profiles[hero.id]
        piece = self._first_open_piece(hero, time_s)
        knots = hero.sketch.knots
        if piece is None:
            piece = len(hero.sketch.pieces)
        begin_s = max(time_s, profile.knot_times_s.get(knots[piece], time_s))
        past = {knot: profile.knot_times_s[knot] for knot in knots[: piece + 1] if knot in profile.knot_times_s}
        s_m, speed, _ = profile.state(begin_s)
        return HeroState(begin_s, s_m, speed, piece, past, profile)

    # -- when the trigger comes -------------------------------------------------------------------------------------
    def _situations(
        self, time_s: float, prediction: Profile, ego_past: Mapping[str, float], heroes: Mapping[int, HeroState]
    ) -> list[Situation]:
        """Return what to solve for: one situation where the ego alone decides when the trigger comes, else several."""
        choices: dict[int, list[float]] = {}
        for hero in self.scene.program.heroes:
            trigger = self.structure.trigger_knot(hero.id)
            if trigger is not None and (hero.id not in heroes or trigger not in heroes[hero.id].knots_s):
                planned = self._planned_trigger(hero) if hero.id in heroes else None
                choices[hero.id] = self._times.instants_s(hero, time_s, prediction, ego_past, planned)
        situations = []
        coasting = self._coasting(prediction, heroes, choices) if heroes else None
        if coasting is not None:
            knots = self._times.ego_knots_s(time_s, prediction, ego_past, coasting)
            in_force = {hero: self._planned_trigger_s(self.scene.program.actor(hero)) for hero in coasting}
            situations.append(Situation(time_s, prediction, knots, heroes, coasting, in_force, in_force, coasting=True))
        for k in range(max((len(instants) for instants in choices.values()), default=1)):
            triggers = {hero: instants[min(k, len(instants) - 1)] for hero, instants in choices.items()}
            situations.append(self._situation(time_s, prediction, ego_past, heroes, triggers))
        return situations

    def _situation(
        self,
        time_s: float,
        prediction: Profile,
        ego_past: Mapping[str, float],
        heroes: Mapping[int, HeroState],
        triggers_s: Mapping[int, float],
    ) -> Situation:
        """Return what to solve for where the triggers come at given instants."""
        times = self._times
        planning = [hero for hero in self.scene.program.heroes if hero.id in triggers_s and hero.id in heroes]
        in_force = {hero.id: self._planned_trigger_s(hero) for hero in planning}
        slack_s = min((times.slack_s(hero, prediction, triggers_s[hero.id]) for hero in planning), default=0.0)
        earliest = {hero.id: times.earliest_s(hero, time_s, prediction, triggers_s[hero.id]) for hero in planning}
        hasty = {hero: arrivals for hero, arrivals in earliest.items() if arrivals}
        there = {hero.id: times.hero_there_s(hero, time_s, self._planned_trigger(hero)) for hero in planning}
        knots = times.ego_knots_s(time_s, prediction, ego_past, triggers_s)
        return Situation(time_s, prediction, knots, heroes, triggers_s, in_force, there, slack_s, hasty)

    def _coasting(
        self, prediction: Profile, heroes: Mapping[int, HeroState], choices: Mapping[int, list[float]]
    ) -> dict[int, float] | None:
        """Return when the trigger comes if the one hero still on its way to it holds its speed, None where not soon."""
        if len(choices) != 1:
            return None
        hero = self.scene.program.actor(next(iter(choices)))
        latest_s = self._first_trigger_s + _PATIENCE_S
        planned = self._planned_trigger(hero)
        instant_s = self._times.coasting_s(hero, prediction, heroes[hero.id], planned, latest_s)
        return None if instant_s is None else {hero.id: instant_s}

    def _planned_trigger(self, hero: Actor) -> PlannedTrigger:
        return PlannedTrigger(self._planned_trigger_s(hero), self._without_interaction(hero))

    def _planned_trigger_s(self, hero: Actor) -> float:
        return self.plan.profiles[hero.id].knot_times_s[self.structure.trigger_knot(hero.id) or ""]

    def _without_interaction(self, hero: Actor) -> Profile:
        """Return the hero's planned approach, going on as it is where the interaction would begin."""
        profile = self.plan.profiles[hero.id]
        sketch = hero.sketch
        trigger = sketch.knots.index(self.structure.trigger_knot(hero.id) or sketch.knots[0])
        approach = tuple(segment for segment in profile.segments if segment.piece < trigger)
        return Profile(approach or profile.segments[:1])

    def _plan_still_fits(self, time_s: float, situation: Situation) -> bool:
        """Whether the plan, as it goes on, meets the trigger and the outcome under the new prediction."""
        for hero in self.scene.program.heroes:
            times = self.plan.profiles[hero.id].knot_times_s
            if hero.id in situation.trigger_s:
                if not self._trigger_fits(hero, time_s, situation):
                    return False
            elif self._reactive_piece(hero) is not None and not self._outcome_fits(hero, situation, times):
                return False
        return True

    def _trigger_fits(self, hero: Actor, time_s: float, situation: Situation) -> bool:
        """Whether the planned trigger is near enough to where it should come now, for the time that is left."""
        planned = self._planned_trigger_s(hero)
        off_s = abs(situation.trigger_s[hero.id] - planned)
        left_s = max(0.0, planned - time_s)
        miss = self._times.joint_miss(hero, situation.ego, planned, self.plan.profiles[hero.id])
        last = left_s <= self._settled_s
        settled = last and self.plan.tolerance <= _LATE_MISS
        if miss > (_LATE_MISS if settled else _EARLY_MISS * (1.0 + left_s)):
            return False
        if settled and self._times.ego_side(hero) is None:
            return off_s <= _DEAD_BAND_LAST_S
        if self._times.ego_side(hero) is not None:
            # While it is to be settled the hero stays so for as long as that is good enough.
            miss, tolerance = (_LATE_MISS, _LATE_MISS) if last else (_EARLY_MISS, 0.0)
            near = off_s <= _ONSET_S and self._times.ego_miss(hero, situation.ego, planned) <= miss
            if near and self.plan.tolerance <= tolerance:
                return True
        return self.plan.tolerance == 0.0 and off_s <= _DEAD_BAND_S + _DEAD_BAND_SHARE * left_s

    def _outcome_fits(self, hero: Actor, situation: Situation, times: Mapping[str, float]) -> bool:
        last_ego = max(situation.ego_knots_s.values(), default=0.0)
        last_own = max(times.values(), default=0.0)
        return last_ego <= situation.time_s or last_own + 0.5 < last_ego


def _is_hard(attempt: Attempt) -> bool:
    """Whether there is no plan, or only one that takes a hero's whole authority."""
    return attempt.plan is None or attempt.plan.style in _HARD
