"""The closed loop's mind: holds the plan, and solves the rest of it again as the ego turns out to drive.

What enters: the ego's states, tick by tick. What leaves: the heroes' motions, and a record of every re-solve. History
is fixed; a hero freezes at its trigger, but for later pieces that react to the ego; when nothing can be solved the
last plan goes on.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from scenewright.motion.profile import Profile, chain
from scenewright.program.structure import Role, Structure, knots_of
from scenewright.program.types import EGO, Actor
from scenewright.roads.grounding import Scene
from scenewright.simulate.following import Leader, foresee_follower
from scenewright.simulate.prediction import ConstantSpeed, EgoSample, Predictor
from scenewright.solve.arrival import TIGHT_LENGTH_M, LinearCondition, tight_of
from scenewright.solve.clearance import Clearance
from scenewright.solve.lags import Lag
from scenewright.solve.plan import Plan
from scenewright.solve.planner import Attempt, Planner
from scenewright.solve.situation import HeroState, Situation

# While much time is left a late or early ego is nothing to act on; the dead band shrinks to almost nothing.
_DEAD_BAND_S = 0.003
_DEAD_BAND_SHARE = 0.02
# In the last half second of a trigger whose moment is free.
_DEAD_BAND_LAST_S = 0.03
_SETTLE_S = 0.5
_LATE_MISS, _EARLY_MISS = 0.5, 0.12
_LONGEST_SLACK_S = 1.0
_FAR_S = 40.0
# After so many failures in a row only every so many ticks are tried: the time of a hopeless run is better spent.
_PATIENT_FAILURES = 20
_RETRY_EVERY = 3
# By how much a trigger that both decide may come later than first planned (s), so that the hero can hold its speed.
_PATIENCE_S = 3.0
# An ego that makes haste does so like this (m/s^2, from m/s), from these shares of the time left; what is worth it.
_HASTE_MPSS, _SETS_OFF_MPS, _HASTE_SHARES = 1.5, 0.4, (0.0, 0.25, 0.5, 0.75, 1.0)
_HASTE_HORIZON_S, _NOTABLY_EARLIER_S = 12.0, 0.25
# How often a first plan is made again, for an ego that reacts to the one before.
_SECOND_THOUGHTS = 2
_SHORTEST_LEAD_S = 0.02
_FIRST_TRIGGERS_S = (2.5, 3.5, 4.5, 6.0, 8.0, 10.0, 13.0, 16.0, 2.0, 1.5, 1.0, 20.0, 25.0)
# Whom the ego follows is answered: the sooner the trigger comes, the better it is foreseen.
_FIRST_TRIGGERS_WHEN_FOLLOWED_S = (1.5, 2.0, *_FIRST_TRIGGERS_S)
_RETRY_TRIGGERS_S = (0.0, 0.25, -0.25, 0.75, 1.5, 3.0, 6.0, 10.0)


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
    _leaders: dict[int, Clearance] = field(init=False, default_factory=dict)
    _lags: dict[int, Lag] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        lags = {hero.id: Lag.of(self.scene, self.structure, hero.id) for hero in self.scene.program.heroes}
        self._lags = {hero_id: lag for hero_id, lag in lags.items() if lag is not None}
        if isinstance(self.predictor, ConstantSpeed):
            return  # whoever drives ahead
        for hero in self.scene.program.heroes:
            clearance = Clearance.of(self.scene, self.structure, self.conditions, hero)
            if clearance is not None and clearance.ahead:
                self._leaders[hero.id] = clearance

    # -- the first plan ---------------------------------------------------------------------------------------------
    def begin(self, ego: EgoSample) -> Attempt:
        """Plan from the ego's first state; the plan is kept if there is one."""
        self._samples = [ego]
        prediction = self.predictor.predict([ego])
        knots = {self.scene.program.ego.sketch.knots[0]: 0.0}
        attempt = self.planner.first_plan(self._situations(0.0, prediction, knots, {}))
        for _ in range(_SECOND_THOUGHTS if self._leaders else 0):
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
    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step, and of the knots that it passed in it."""
        previous = self._samples[-1]
        self._samples.append(sample)
        self._pass_shared_knots(sample[0])
        for condition in self._ego_alone():
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
        for hero_id, clearance in self._leaders.items():
            leader = Leader(self.plan.profiles[hero_id], clearance.offset_m)
            cruise_mps = self.planner.limits[EGO].natural_approach_speed_mps
            prediction = foresee_follower(prediction, self._samples, leader, cruise_mps)
        return prediction

    def _resolve(self, time_s: float) -> Replan:
        prediction = self._foresee()
        heroes = {hero.id: self._hero_state(hero, time_s) for hero in self.scene.program.heroes}
        situations = self._situations(time_s, prediction, self.ego_knots_s, heroes)
        if self._plan_still_fits(time_s, situations[0]):
            return Replan(time_s, "kept", "", 0.0, self.plan.tolerance, "the plan still fits the ego")
        if self._failures >= _PATIENT_FAILURES and len(self.records) % _RETRY_EVERY:
            return Replan(time_s, "unsat, last plan goes on", "", 0.0, self.plan.tolerance, "failed a moment ago")
        attempt = self.planner.replan(situations)
        self._failures = 0 if attempt.plan is not None else self._failures + 1
        if attempt.plan is not None:
            self.plan = self._continued(attempt.plan, time_s)
        else:
            self._wait_for_joint_triggers(time_s)
        return self._record(time_s, attempt)

    def _wait_for_joint_triggers(self, time_s: float) -> None:
        """Let heroes whose trigger both decide go on as they are: to begin at the old moment would be too early."""
        for hero in self.scene.program.heroes:
            profile, knot = self.plan.profiles[hero.id], self.structure.trigger_knot(hero.id)
            planned = profile.knot_times_s.get(knot or "", -1.0)
            if time_s < planned < time_s + _SETTLE_S and self._ego_side(hero) is None:
                later = {**self.plan.profiles, hero.id: profile.held(planned, _SETTLE_S)}
                self.plan = replace(self.plan, profiles=later)

    def _record(self, time_s: float, attempt: Attempt) -> Replan:
        tolerance = attempt.plan.tolerance if attempt.plan else self.plan.tolerance
        reason = attempt.reason or (attempt.plan.manner if attempt.plan else "")
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
        return Plan(profiles, plan.tolerance, plan.manner, plan.parameters)

    def ego_stood_s(self, time_s: float) -> float:
        """Return for how long the ego has not moved (s)."""
        for sample in reversed(self._samples):
            if sample[2] > 0.1:
                return time_s - sample[0]
        return time_s

    # -- what is known ----------------------------------------------------------------------------------------------
    def _ego_alone(self) -> list[LinearCondition]:
        """Conditions on the ego alone at knots that it passes by itself (not those it shares with a hero's trigger)."""
        shared = {key for instant in self.structure.triggers.values() for key in instant}
        first = (EGO, self.scene.program.ego.sketch.knots[0])
        return [
            c for c in self.conditions if set(c.weights) == {EGO} and not c.moments & shared and first not in c.moments
        ]

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
                choices[hero.id] = self._trigger_instants(hero, time_s, prediction, heroes)
        situations = []
        coasting = self._coasting(time_s, prediction, heroes, choices) if heroes else None
        if coasting is not None:
            knots = self._ego_knots(time_s, prediction, ego_past, coasting)
            planned = {hero: self._planned_trigger_s(self.scene.program.actor(hero)) for hero in coasting}
            situations.append(Situation(time_s, prediction, knots, heroes, coasting, planned, coasting=True))
        for k in range(max((len(instants) for instants in choices.values()), default=1)):
            triggers = {hero: instants[min(k, len(instants) - 1)] for hero, instants in choices.items()}
            knots = self._ego_knots(time_s, prediction, ego_past, triggers)
            planned = {
                hero: self._planned_trigger_s(self.scene.program.actor(hero)) for hero in triggers if hero in heroes
            }
            slack_s = min(
                (self._ego_slack_s(self.scene.program.actor(hero), prediction, triggers[hero]) for hero in planned),
                default=0.0,
            )
            earliest = {hero: self._earliest_s(hero, time_s, prediction, triggers[hero]) for hero in planned}
            hasty = {hero: arrivals for hero, arrivals in earliest.items() if arrivals}
            situations.append(Situation(time_s, prediction, knots, heroes, triggers, planned, slack_s, hasty))
        return situations

    def _planned_trigger_s(self, hero: Actor) -> float:
        return self.plan.profiles[hero.id].knot_times_s[self.structure.trigger_knot(hero.id) or ""]

    def _ego_side(self, hero: Actor) -> LinearCondition | None:
        """Return the condition on the ego alone that the hero's trigger waits for; None where both decide."""
        here = self._conditions_of(hero)
        known = self._hero_place(hero, here)
        for condition in here:
            alone = condition.given(hero.id, *known) if hero.id in condition.weights and known else condition
            if set(alone.weights) == {EGO} and alone.weights[EGO][0]:
                return alone
        return None

    def _earliest_s(
        self, hero_id: int, time_s: float, prediction: Profile, expected_s: float
    ) -> tuple[tuple[float, float], ...]:
        """Return when the ego would be at its side if it made haste, from some instants on; empty where it cannot much.

        Who crawls or stands may speed up, and mostly does so all of a sudden.
        """
        side = self._ego_side(self.scene.program.actor(hero_id))
        if side is None or expected_s > time_s + _HASTE_HORIZON_S:
            return ()
        found: list[tuple[float, float]] = []
        for share in _HASTE_SHARES:
            begin_s = time_s + share * (expected_s - time_s)
            s_m, speed_mps, _ = prediction.state(begin_s)
            motion = self.predictor.predict([(begin_s, s_m, max(speed_mps, _SETS_OFF_MPS), _HASTE_MPSS)])
            arrival = side.first_time({EGO: motion}, begin_s)
            found.append((begin_s, expected_s if arrival is None else min(expected_s, arrival)))
        return tuple(found) if expected_s - found[0][1] > _NOTABLY_EARLIER_S else ()

    def _ego_slack_s(self, hero: Actor, prediction: Profile, instant_s: float) -> float:
        """Return the time in which the ego gets one tight tolerance off its side of the trigger."""
        side, speed = self._ego_side(hero), prediction.state(instant_s)[1]
        per_metre, per_speed = side.weights[EGO] if side else (1.0, 0.0)
        tight, slack_s = tight_of(side, speed) if side else TIGHT_LENGTH_M, _LONGEST_SLACK_S
        for sign in (0.0, -1.0, 1.0):  # faster a moment before or after than at the instant itself
            speed, accel = prediction.state(instant_s + sign * slack_s)[1:]
            slack_s = min(slack_s, tight / max(abs(per_metre * speed + per_speed * accel), 1e-3))
        return slack_s

    def _ego_miss(self, hero: Actor, prediction: Profile, instant_s: float) -> float:
        """Return how far the ego will be off its side of the trigger, in tight tolerances; 0 where both decide."""
        side = self._ego_side(hero)
        if side is None:
            return 0.0
        state = prediction.state(instant_s)
        return abs(side.value({EGO: state[:2]})) / tight_of(side, state[1])

    def _at_trigger(self) -> list[LinearCondition]:
        instants = list(self.structure.triggers.values())
        return [c for c in self.conditions if any(c.moments <= instant for instant in instants)]

    def _trigger_instants(
        self, hero: Actor, time_s: float, prediction: Profile, heroes: Mapping[int, HeroState]
    ) -> list[float]:
        side = self._ego_side(hero)
        if side is not None:
            return [self._ego_arrival_s(side, time_s, prediction)]
        if hero.id in self._lags:
            return [self._lagged_s(self._lags[hero.id], time_s, prediction)]
        if hero.id not in heroes:
            return list(_FIRST_TRIGGERS_WHEN_FOLLOWED_S if hero.id in self._leaders else _FIRST_TRIGGERS_S)
        here = self._conditions_of(hero)
        return self._joint_instants(hero, here, time_s, prediction)

    def _ego_arrival_s(self, condition: LinearCondition, time_s: float, prediction: Profile) -> float:
        """Return when the ego will be at its side: at once where it is past it, late where that is not in sight."""
        arrival = condition.first_time({EGO: prediction}, time_s)
        if arrival is None and self._samples and self._is_behind(condition, self._samples[-1][1:4]):
            arrival = time_s
        return time_s + _FAR_S if arrival is None else max(arrival, time_s + _SHORTEST_LEAD_S)

    def _coasting(
        self,
        time_s: float,
        prediction: Profile,
        heroes: Mapping[int, HeroState],
        choices: Mapping[int, list[float]],
    ) -> dict[int, float] | None:
        """Return when a trigger that both decide comes if the hero just holds its speed; None where not soon.

        An ego that follows the hero answers whatever that does: the less it does, the better the ego is foreseen.
        """
        if len(choices) != 1:
            return None
        hero = self.scene.program.actor(next(iter(choices)))
        if self._ego_side(hero) is not None:
            return None
        state = heroes[hero.id]
        motion = Profile(chain(time_s, state.s_m, state.speed_mps, [(1.0, 0.0, state.piece)]))
        both = [c for c in self._at_trigger() if set(c.weights) == {EGO, hero.id}]
        crossings = [c.first_time({EGO: prediction, hero.id: motion}, time_s) for c in both]
        if len(both) != 1 or len(self._conditions_of(hero)) != 1:
            return None
        soonest_s = time_s + _SHORTEST_LEAD_S
        if crossings[0] is not None and crossings[0] < self._first_trigger_s + _PATIENCE_S:
            return {hero.id: max(crossings[0], soonest_s)}
        # Between two ticks it may have come sooner than foreseen.
        near = self._joint_miss(soonest_s, hero, prediction, motion) <= _LATE_MISS
        at_once = near and self._planned_trigger_s(hero) < time_s + _SETTLE_S
        return {hero.id: soonest_s} if at_once else None

    def _conditions_of(self, hero: Actor) -> list[LinearCondition]:
        return [c for c in self.conditions if c.moments <= self.structure.triggers[hero.id]]

    def _lagged_s(self, lag: Lag, time_s: float, prediction: Profile) -> float:
        """Return when a trigger comes that is told by the time since the ego was somewhere."""
        since_s = self.ego_knots_s.get(lag.knot)
        if since_s is None:
            there = next((c for c in self._ego_alone() if (EGO, lag.knot) in c.moments), None)
            since_s = time_s + _FAR_S if there is None else self._ego_arrival_s(there, time_s, prediction)
        return max(since_s + lag.after_s, time_s + _SHORTEST_LEAD_S)

    def _hero_place(self, hero: Actor, conditions: list[LinearCondition]) -> tuple[float, float] | None:
        """Return position and speed of the hero at its trigger where the program fixes the position."""
        for condition in conditions:
            if set(condition.weights) == {hero.id} and condition.weights[hero.id][1] == 0.0:
                return -condition.constant / condition.weights[hero.id][0], 0.0
        return None

    def _joint_instants(
        self, hero: Actor, conditions: list[LinearCondition], time_s: float, prediction: Profile
    ) -> list[float]:
        """Return instants to try where both decide: when the plan as it is meets the condition, then around it."""
        planned = self._planned_trigger_s(hero)
        motion = self._without_interaction(hero)
        result: list[float] = []
        for condition in conditions:
            crossing = condition.first_time({EGO: prediction, hero.id: motion}, time_s)
            if crossing is not None and crossing < planned + 5.0:
                result.append(max(crossing, time_s + _SHORTEST_LEAD_S))
        result += [planned + shift for shift in _RETRY_TRIGGERS_S if planned + shift > time_s + _SHORTEST_LEAD_S]
        return result

    def _without_interaction(self, hero: Actor) -> Profile:
        """Return the hero's planned approach, going on as it is where the interaction would begin."""
        profile = self.plan.profiles[hero.id]
        sketch = hero.sketch
        trigger = sketch.knots.index(self.structure.trigger_knot(hero.id) or sketch.knots[0])
        approach = tuple(segment for segment in profile.segments if segment.piece < trigger)
        return Profile(approach or profile.segments[:1])

    def _ego_knots(
        self, time_s: float, prediction: Profile, past: Mapping[str, float], triggers_s: Mapping[int, float]
    ) -> dict[str, float]:
        """Return when the ego passes its knots: those behind it, its triggers, and those it is predicted to reach."""
        knots = dict(past)
        for hero, instant_s in triggers_s.items():
            for owner, name in self.structure.triggers[hero]:
                if owner == EGO:
                    knots[name] = instant_s
        latest = max([time_s, *knots.values()])
        for condition in self._ego_alone():
            name = next(iter(condition.moments))[1]
            if name not in knots:
                arrival = condition.first_time({EGO: prediction}, max(time_s, latest))
                if arrival is None and self._is_behind(condition, prediction.state(latest)):
                    arrival = latest  # it is past that place before it may be: nothing can come before it any more
                if arrival is not None:
                    knots[name] = arrival
        return knots

    def _is_behind(self, condition: LinearCondition, state: tuple[float, float, float]) -> bool:
        """Whether the ego, in `state`, is past a place that lay ahead of it when the run began."""
        if not self._samples:
            return False
        return condition.value({EGO: self._samples[0][1:3]}) * condition.value({EGO: state[:2]}) < 0.0

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
        miss = self._joint_miss(planned, hero, situation.ego, self.plan.profiles[hero.id])
        settled = left_s <= _SETTLE_S and self.plan.tolerance <= _LATE_MISS
        if miss > (_LATE_MISS if settled else _EARLY_MISS * (1.0 + left_s)):
            return False
        if settled and self._ego_side(hero) is None:
            return off_s <= _DEAD_BAND_LAST_S
        if self._ego_side(hero) is not None:
            # Within the last half second the hero stays settled for as long as that is good enough.
            miss, tolerance = (_LATE_MISS, _LATE_MISS) if left_s <= _SETTLE_S else (_EARLY_MISS, 0.0)
            if self.plan.tolerance <= tolerance and self._ego_miss(hero, situation.ego, planned) <= miss:
                return True
        return self.plan.tolerance == 0.0 and off_s <= _DEAD_BAND_S + _DEAD_BAND_SHARE * left_s

    def _joint_miss(self, instant_s: float, hero: Actor, prediction: Profile, motion: Profile) -> float:
        """Return by how much `motion` misses a condition on both, such as a gap, in tight tolerances."""
        states = {EGO: prediction.state(instant_s)[:2], hero.id: motion.state(instant_s)[:2]}
        both = [c for c in self._at_trigger() if set(c.weights) == set(states)]
        return max((abs(c.value(states)) / tight_of(c, states[EGO][1]) for c in both), default=0.0)

    def _outcome_fits(self, hero: Actor, situation: Situation, times: Mapping[str, float]) -> bool:
        last_ego = max(situation.ego_knots_s.values(), default=0.0)
        last_own = max(times.values(), default=0.0)
        return last_ego <= situation.time_s or last_own + 0.5 < last_ego
