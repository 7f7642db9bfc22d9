"""When a trigger comes, as the ego is foreseen: at its side of it, some time after a place, or wherever both agree.

What enters: a scene, what is foreseen of the ego, what is planned for a hero. What leaves: instants, and how far off a
motion is at one. It plans nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from scenewright.motion.profile import Profile, chain
from scenewright.program.structure import Structure
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.simulate.prediction import ConstantSpeed, Predictor
from scenewright.solve.arrival import TIGHT_LENGTH_M, LinearCondition, hero_side, tight_of
from scenewright.solve.clearance import Clearance
from scenewright.solve.lags import Lag
from scenewright.solve.limits import ROOM
from scenewright.solve.situation import SHORTEST_LEAD_S, HeroState

_LONGEST_SLACK_S = 1.0
_FAR_S = 40.0
# An ego that makes haste does so like this (m/s^2, from m/s), from these shares of the time left; how much sooner (s,
# and as a share of the time left) it has to be there to be worth it.
_HASTE_MPSS, _SETS_OFF_MPS, _HASTE_SHARES = 1.5, 0.4, (0.0, 0.25, 0.5, 0.75, 1.0)
_HASTE_HORIZON_S, _NOTABLY_EARLIER_S, _NOTABLE_SHARE = 25.0, 0.25, 0.15
_FIRST_TRIGGERS_S = (2.5, 3.5, 4.5, 6.0, 8.0, 10.0, 13.0, 16.0, 2.0, 1.5, 1.0, 20.0, 25.0)
# Whom the ego follows is answered: the sooner the trigger comes, the better it is foreseen.
_FIRST_TRIGGERS_WHEN_FOLLOWED_S = (1.5, 2.0, *_FIRST_TRIGGERS_S)
_RETRY_TRIGGERS_S = (0.0, 0.25, -0.25, 0.75, 1.5, 3.0, 6.0, 10.0)
# How near (in tight tolerances) and how soon before it is planned (s) a trigger that both decide may come at once.
_NEAR, _NEARLY_S = 0.5, 0.5
# What is so near (s) is waited for a while (s) beyond all patience: to move now would put it off again.
_NEARLY_THERE_S, _MOST_PATIENCE_S = 1.5, 4.0
# How soon a trigger was to come (s) that the ego may have met between two ticks; how late it would come again.
_DUE_S, _AGAIN_S, _STILL_GOOD = 0.12, 0.2, 0.8
# Who does not get nearer to its place than this before it stands is there.
_STANDS_MPS, _STANDS_THERE_M = 0.02, 0.9 * TIGHT_LENGTH_M
_ROUNDING_S = 1e-6


@dataclass(frozen=True, slots=True)
class PlannedTrigger:
    """A hero's trigger in the plan in force: when it comes, and the way to it, going on where it would begin."""

    time_s: float
    approach: Profile


@dataclass(slots=True)
class TriggerTimes:
    """Tells for one scene when triggers come.

    Attributes
    ----------
    cruise_mps
        How fast people drive where the ego does: one in haste gets there ever more gently.
    ego_began
        The ego's position (m) and speed (m/s) when the run began.
    leaders
        For each hero that the ego follows: on which side of it the hero is.
    """

    scene: Scene
    structure: Structure
    conditions: tuple[LinearCondition, ...]
    predictor: Predictor
    cruise_mps: float = math.inf
    ego_began: tuple[float, float] = (0.0, 0.0)
    leaders: dict[int, Clearance] = field(init=False, default_factory=dict)
    _lags: dict[int, Lag] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        for hero in self.scene.program.heroes:
            lag = Lag.of(self.scene, self.structure, hero.id)
            if lag is not None:
                self._lags[hero.id] = lag
            clearance = Clearance.of(self.scene, self.structure, self.conditions, hero)
            if clearance is not None and clearance.ahead and not isinstance(self.predictor, ConstantSpeed):
                self.leaders[hero.id] = clearance

    def ego_alone(self) -> list[LinearCondition]:
        """Conditions on the ego alone at knots that it passes by itself (not those it shares with a hero's trigger)."""
        shared = {key for instant in self.structure.triggers.values() for key in instant}
        first = (EGO, self.scene.program.ego.sketch.knots[0])
        return [
            c for c in self.conditions if set(c.weights) == {EGO} and not c.moments & shared and first not in c.moments
        ]

    def ego_side(self, hero: Actor) -> LinearCondition | None:
        """Return the condition on the ego alone that the hero's trigger waits for; None where both decide."""
        here = self._conditions_of(hero)
        known = _hero_place(hero, here)
        for condition in here:
            alone = condition.given(hero.id, *known) if hero.id in condition.weights and known else condition
            if set(alone.weights) == {EGO} and alone.weights[EGO][0]:
                return alone
        return None

    def instants_s(
        self,
        hero: Actor,
        time_s: float,
        prediction: Profile,
        ego_knots_s: Mapping[str, float],
        planned: PlannedTrigger | None,
    ) -> list[float]:
        """Return when a hero's trigger may come, best first: one instant where the ego alone decides.

        Parameters
        ----------
        planned
            The trigger of the plan in force; None where nothing is planned yet.
        """
        side = self.ego_side(hero)
        if side is not None:
            arrival_s = self._ego_arrival_s(side, time_s, prediction)
            stands = None if planned is None else _standing(side, time_s, prediction, arrival_s)
            if planned is not None and self._is_due(hero, time_s, prediction, planned.time_s, arrival_s):
                return [max(planned.time_s, time_s + SHORTEST_LEAD_S)]
            if planned is None or stands is None:
                return [arrival_s]
            return [min(max(planned.time_s, stands[0]), stands[1])]
        if hero.id in self._lags:
            return [self._lagged_s(self._lags[hero.id], time_s, prediction, ego_knots_s)]
        if planned is None:
            return list(_FIRST_TRIGGERS_WHEN_FOLLOWED_S if hero.id in self.leaders else _FIRST_TRIGGERS_S)
        return self._joint_instants(hero, time_s, prediction, planned)

    def _is_due(self, hero: Actor, time_s: float, prediction: Profile, planned_s: float, arrival_s: float) -> bool:
        """Whether a trigger may come as planned, now, though the ego was at its side a moment sooner than foreseen.

        A time to arrival that was met between two ticks may come again, much later, where the ego slows down.
        """
        due_s = max(planned_s, time_s + SHORTEST_LEAD_S)
        late = arrival_s > due_s + _AGAIN_S and planned_s < time_s + _DUE_S
        return late and self.ego_miss(hero, prediction, due_s) <= _STILL_GOOD

    def _ego_arrival_s(self, condition: LinearCondition, time_s: float, prediction: Profile) -> float:
        """Return when the ego will be at its side: at once where it is past it, late where that is not in sight."""
        arrival = condition.first_time({EGO: prediction}, time_s)
        if arrival is None and self._is_behind(condition, prediction.state(time_s)):
            arrival = time_s
        return time_s + _FAR_S if arrival is None else max(arrival, time_s + SHORTEST_LEAD_S)

    def _lagged_s(self, lag: Lag, time_s: float, prediction: Profile, ego_knots_s: Mapping[str, float]) -> float:
        """Return when a trigger comes that is told by the time since the start, or since the ego was somewhere."""
        since_s = 0.0 if lag.knot is None else ego_knots_s.get(lag.knot)
        if since_s is None:
            there = next((c for c in self.ego_alone() if (EGO, lag.knot) in c.moments), None)
            since_s = time_s + _FAR_S if there is None else self._ego_arrival_s(there, time_s, prediction)
        return max(since_s + lag.after_s, time_s + SHORTEST_LEAD_S)

    def _joint_instants(self, hero: Actor, time_s: float, prediction: Profile, planned: PlannedTrigger) -> list[float]:
        """Return instants to try where both decide: when the plan as it is meets the condition, then around it."""
        result: list[float] = []
        for condition in self._conditions_of(hero):
            crossing = condition.first_time({EGO: prediction, hero.id: planned.approach}, time_s)
            if crossing is not None and crossing < planned.time_s + 5.0:
                result.append(max(crossing, time_s + SHORTEST_LEAD_S))
        shifted = (planned.time_s + shift for shift in _RETRY_TRIGGERS_S)
        return [*result, *(instant for instant in shifted if instant > time_s + SHORTEST_LEAD_S)]

    def joint_condition(self, hero: Actor) -> LinearCondition | None:
        """Return the condition on both that alone decides when the hero's trigger comes; None where it is not so."""
        conditions = self._conditions_of(hero)
        both = len(conditions) == 1 and set(conditions[0].weights) == {EGO, hero.id}
        return conditions[0] if both and self.ego_side(hero) is None else None

    def coasting_s(
        self, hero: Actor, prediction: Profile, state: HeroState, planned: PlannedTrigger, latest_s: float
    ) -> float | None:
        """Return when a trigger that both decide comes if the hero just holds its speed; None where not by `latest_s`.

        An ego that follows the hero answers whatever that does: the less it does, the better the ego is foreseen.
        """
        both = self.joint_condition(hero)
        if both is None:
            return None
        time_s = state.time_s
        motion = Profile(chain(time_s, state.s_m, state.speed_mps, [(1.0, 0.0, state.piece)]))
        crossing = both.first_time({EGO: prediction, hero.id: motion}, time_s)
        soonest_s = max(time_s + SHORTEST_LEAD_S, self._settled_s(hero, state))
        soon_s = _NEARLY_THERE_S if time_s < latest_s + _MOST_PATIENCE_S else _NEARLY_S
        if crossing is not None and crossing < max(latest_s, time_s + soon_s):
            return max(crossing, soonest_s)
        # Between two ticks it may have come sooner than foreseen.
        near = self.joint_miss(hero, prediction, soonest_s, motion) <= _NEAR
        return soonest_s if near and planned.time_s < time_s + _NEARLY_S else None

    def _settled_s(self, hero: Actor, state: HeroState) -> float:
        """Return from when on a hero that holds its speed from now on has been settled for as long as can be seen."""
        knots = hero.sketch.knots
        begins = hero.sketch.pieces[knots.index(self.structure.trigger_knot(hero.id) or knots[0])]
        sense = 1.0 if begins is PieceKind.ACC else -1.0
        manner = self.scene.program.manner
        settled_mpss = float(manner.stricter(ROOM).settled_mpss)
        moved = [
            min(segment.end_s, state.time_s)
            for segment in state.history.segments
            if sense * segment.accel_mpss > settled_mpss and segment.start_s < state.time_s - _ROUNDING_S
        ]
        return moved[-1] + float(manner.settled_s) if moved else -math.inf

    def earliest_s(
        self, hero: Actor, time_s: float, prediction: Profile, expected_s: float
    ) -> tuple[tuple[float, float], ...]:
        """Return when the ego would be at its side if it made haste, from some instants on; empty where it cannot much.

        Who crawls or stands may speed up, and mostly does so all of a sudden.
        """
        side = self.ego_side(hero)
        if side is None or expected_s > time_s + _HASTE_HORIZON_S:
            return ()
        found: list[tuple[float, float]] = []
        for share in _HASTE_SHARES:
            begin_s = time_s + share * (expected_s - time_s)
            arrival = side.first_time({EGO: self.in_haste(prediction, begin_s)}, begin_s)
            found.append((begin_s, expected_s if arrival is None else min(expected_s, arrival)))
        notably_s = max(_NOTABLY_EARLIER_S, _NOTABLE_SHARE * (expected_s - time_s))
        return tuple(found) if expected_s - found[0][1] > notably_s else ()

    def in_haste(self, prediction: Profile, begin_s: float) -> Profile:
        """Return how an ego goes on that is as foreseen up to a moment, and then makes haste."""
        s_m, speed_mps, _ = prediction.state(begin_s)
        pull = _HASTE_MPSS * max(0.0, 1.0 - (speed_mps / self.cruise_mps) ** 4)
        return self.predictor.predict([(begin_s, s_m, max(speed_mps, _SETS_OFF_MPS), pull)])

    def hero_there_s(self, hero: Actor, time_s: float, planned: PlannedTrigger) -> float:
        """Return when the hero will be at its side, going on as planned; now where it was there already."""
        side, motion = hero_side(self.conditions, self.structure, hero.id), {hero.id: planned.approach}
        if side is None:
            return planned.time_s
        there_s = side.first_time(motion, time_s)
        if there_s is None:
            there_s = time_s if side.first_time(motion, planned.approach.start_s) is not None else planned.time_s
        return there_s

    def slack_s(self, hero: Actor, prediction: Profile, instant_s: float) -> float:
        """Return the time in which the ego gets one tight tolerance off its side of the trigger."""
        side, speed = self.ego_side(hero), prediction.state(instant_s)[1]
        per_metre, per_speed = side.weights[EGO] if side else (1.0, 0.0)
        tight, slack_s = tight_of(side, speed) if side else TIGHT_LENGTH_M, _LONGEST_SLACK_S
        for sign in (0.0, -1.0, 1.0):  # faster a moment before or after than at the instant itself
            speed, accel = prediction.state(instant_s + sign * slack_s)[1:]
            slack_s = min(slack_s, tight / max(abs(per_metre * speed + per_speed * accel), 1e-3))
        return slack_s

    def ego_miss(self, hero: Actor, prediction: Profile, instant_s: float) -> float:
        """Return how far the ego will be off its side of the trigger, in tight tolerances; 0 where both decide."""
        side = self.ego_side(hero)
        if side is None:
            return 0.0
        state = prediction.state(instant_s)
        return abs(side.value({EGO: state[:2]})) / tight_of(side, state[1])

    def joint_miss(self, hero: Actor, prediction: Profile, instant_s: float, motion: Profile) -> float:
        """Return by how much `motion` misses a condition on both, such as a gap, in tight tolerances."""
        states = {EGO: prediction.state(instant_s)[:2], hero.id: motion.state(instant_s)[:2]}
        both = [c for c in self._conditions_of(hero) if set(c.weights) == set(states)]
        return max((abs(c.value(states)) / tight_of(c, states[EGO][1]) for c in both), default=0.0)

    def ego_knots_s(
        self, time_s: float, prediction: Profile, past: Mapping[str, float], triggers_s: Mapping[int, float]
    ) -> dict[str, float]:
        """Return when the ego passes its knots: those behind it, its triggers, and those it is predicted to reach."""
        knots = dict(past)
        for hero, instant_s in triggers_s.items():
            for owner, name in self.structure.triggers[hero]:
                if owner == EGO:
                    knots[name] = instant_s
        latest = max([time_s, *knots.values()])
        for condition in self.ego_alone():
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
        return condition.value({EGO: self.ego_began}) * condition.value({EGO: state[:2]}) < 0.0

    def _conditions_of(self, hero: Actor) -> list[LinearCondition]:
        return [c for c in self.conditions if c.moments <= self.structure.triggers[hero.id]]


def _standing(side: LinearCondition, time_s: float, prediction: Profile, before_s: float) -> tuple[float, float] | None:
    """Return from when to when (s) the ego stands so near to its place that it is there; None where it does not."""
    per_metre, per_speed = side.weights[EGO]
    soonest_s = time_s + SHORTEST_LEAD_S
    for segment in prediction.segments:
        begin_s = max(segment.start_s, soonest_s)
        stands = segment.speed_mps < _STANDS_MPS and segment.accel_mpss <= 0.0 and segment.end_s > soonest_s
        if stands and begin_s <= before_s and not per_speed:
            off_m = abs(side.value({EGO: (segment.s_m, 0.0)}) / per_metre)
            return (begin_s, segment.end_s) if off_m <= _STANDS_THERE_M else None
    return None


def _hero_place(hero: Actor, conditions: list[LinearCondition]) -> tuple[float, float] | None:
    """Return position and speed of the hero at its trigger where the program fixes the position."""
    for condition in conditions:
        if set(condition.weights) == {hero.id} and condition.weights[hero.id][1] == 0.0:
            return -condition.constant / condition.weights[hero.id][0], 0.0
    return None
