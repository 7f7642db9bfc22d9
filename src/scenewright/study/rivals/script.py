"""What a scenario author writes down once, before the run: an approach, a condition group, a manoeuvre.

What enters: the first plan, made against the ego's predicted approach. What leaves: a `Script` for each hero, in terms
of OpenSCENARIO: conditions on distances and times to arrival that start a sequence of speed actions. Nothing here
knows how the ego will really drive.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, Segment, chain
from scenewright.program.expressions import Compare, PieceRef, piece_of
from scenewright.program.structure import Structure
from scenewright.program.types import EGO, Actor, Program
from scenewright.roads.grounding import Scene
from scenewright.roads.turns import TurnSpan
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.plan import Plan

States = Mapping[int, tuple[float, float]]
# What an engine compares is a float; a car that is where the author put it counts as being there.
_ROUNDING = 1e-6
_NO_CHANGE_MPS = 1e-3
_NO_TIME_S = 1e-6
_SLOW_FOR_TURN_MPSS = 2.5
_FIRMLY_MPSS = 6.0
_LEAST_ROOM_M = 0.5


@dataclass(frozen=True, slots=True)
class ConditionGroup:
    """Conditions that must all hold: each quantity has come to its value from the side where the scenario begins.

    Attributes
    ----------
    sides
        A linear condition and the sign (1 or -1) of its left side at the beginning: a distance or a time to arrival
        begins above its value, and holds from the moment it is below.
    at_s
        Where nothing is compared: the time (s) at which the group holds, as a simulation-time condition.
    within_m
        A hero that is so near its own value counts as being there.
    """

    sides: tuple[tuple[LinearCondition, float], ...]
    at_s: float
    within_m: float = _ROUNDING

    def holds(self, time_s: float, states: States) -> bool:
        """Whether all conditions hold, given ``(position, speed)`` of every actor."""
        if not self.sides:
            return time_s >= self.at_s - _ROUNDING
        return all(
            sign * condition.value(states) <= (_ROUNDING if EGO in condition.weights else self.within_m)
            for condition, sign in self.sides
        )


@dataclass(frozen=True, slots=True)
class SpeedAction:
    """A change of speed at a rate or over a distance, or a speed held for a while; engines know all three.

    Attributes
    ----------
    piece
        Number of the sketch's piece that it belongs to.
    target_mps
        Speed at its end.
    rate_mpss
        Size of its acceleration; 0 holds the speed for `duration_s`.
    distance_m
        Where given, the change takes this distance instead, at the rate that this needs from the speed at its begin.
    """

    piece: int
    target_mps: float
    rate_mpss: float = 0.0
    duration_s: float = 0.0
    distance_m: float | None = None

    def move(self, speed_mps: float, limits: Limits) -> tuple[float, float]:
        """Return duration (s) and acceleration (m/s^2) from the speed that the hero really has, within its limits."""
        if self.rate_mpss == 0.0:
            return self.duration_s, 0.0
        change = self.target_mps - speed_mps
        if abs(change) < _ROUNDING:
            return 0.0, 0.0
        rate = self.rate_mpss
        if self.distance_m is not None:
            rate = abs(self.target_mps**2 - speed_mps**2) / (2.0 * self.distance_m)
        rate = max(_ROUNDING, min(rate, limits.accel_max_mpss if change > 0 else limits.brake_max_mpss))
        return abs(change) / rate, math.copysign(rate, change)


@dataclass(frozen=True, slots=True)
class Script:
    """What one hero is told before the run.

    Attributes
    ----------
    approach
        Its motion until the group holds; it goes on beyond the planned trigger.
    group
        What starts the manoeuvre.
    manoeuvre
        Speed actions, one after another; the last speed then holds.
    own_place_m, ego_place_m
        Where hero and ego are at the planned trigger, on their routes.
    trigger_s, trigger_speed_mps
        When, and how fast the hero is then.
    trigger_knot, turn
        What the program calls that moment; where the hero's route turns.
    """

    hero: Actor
    limits: Limits
    approach: Profile
    group: ConditionGroup
    manoeuvre: tuple[SpeedAction, ...]
    own_place_m: float
    ego_place_m: float
    trigger_s: float
    trigger_speed_mps: float
    trigger_knot: str
    turn: TurnSpan | None

    def carried_out(self, time_s: float, s_m: float, speed_mps: float) -> Profile:
        """Return the manoeuvre, begun at `time_s` from the hero's real state."""
        knots = dict(self.approach.knot_times_s) | {self.trigger_knot: time_s}
        names = self.hero.sketch.knots
        moves: list[tuple[float, float, int]] = []
        now, speed = time_s, speed_mps
        for action in self.manoeuvre:
            duration, accel = action.move(speed, self.limits)
            moves.append((duration, accel, action.piece))
            now += duration
            speed = max(0.0, speed + accel * duration)
            knots[names[action.piece + 1]] = now
        for name in names:
            knots.setdefault(name, now)
        return Profile(chain(time_s, s_m, speed_mps, moves or [(0.0, 0.0, 0)]), knots)

    def intended(self) -> Profile:
        """Return the whole motion as the author means it: the trigger comes when the hero is at its place."""
        reached_s = self.approach.time_at(self.own_place_m)
        time_s = self.trigger_s if reached_s is None else reached_s
        s_m, speed, _ = self.approach.state(time_s)
        then = self.carried_out(time_s, s_m, speed)
        before = [segment for segment in self.approach.segments if segment.start_s < time_s - _NO_TIME_S]
        # A stretch reaches to where the next begins, for speeds hold after a profile's last one.
        ends = [segment.start_s for segment in before[1:]] + [time_s]
        cut = [replace(s, duration_s=end - s.start_s) for s, end in zip(before, ends, strict=True)]
        return Profile((*cut, *then.segments), then.knot_times_s)

    def place_at_m(self, speed_mps: float) -> float:
        """Return where the hero meets its own condition at a constant speed: a time to arrival depends on that."""
        for condition, _ in self.group.sides:
            if set(condition.weights) == {self.hero.id} and condition.weights[self.hero.id][0]:
                per_metre, per_speed = condition.weights[self.hero.id]
                return -(condition.constant + per_speed * speed_mps) / per_metre
        return self.own_place_m

    def begun_at(self, s_m: float, speed_mps: float) -> Script:
        """Return the script for another first state, held at constant speed: one that stops does so where it did."""
        past = dict.fromkeys(self.approach.knot_times_s, 0.0)
        place_m = self.place_at_m(speed_mps)
        start = [Segment(0.0, 0.0, s_m, speed_mps, 0.0)]
        approach = Profile(_slowed_for_turn(start, place_m, self.limits, self.turn), past)
        actions = list(self.manoeuvre)
        if actions and actions[0].distance_m is not None:
            room_m = actions[0].distance_m + self.own_place_m - place_m
            actions[0] = replace(actions[0], distance_m=max(_LEAST_ROOM_M, room_m))
        return replace(
            self, approach=approach, manoeuvre=tuple(actions), own_place_m=place_m, trigger_speed_mps=speed_mps
        )


def top_speed_mps(limits: Limits, turn: TurnSpan | None, s_m: float) -> float:
    """Return how fast a hero may be at a place: slow enough for its turn, where that lies ahead or it is in it."""
    if turn is None or s_m >= turn.end_m:
        return limits.speed_max_mps
    way_m = max(0.0, turn.start_m - s_m)
    return min(limits.speed_max_mps, math.sqrt(limits.turn_speed_max_mps**2 + 2.0 * _FIRMLY_MPSS * way_m))


def write_scripts(
    scene: Scene,
    structure: Structure,
    limits: Mapping[int, Limits],
    conditions: tuple[LinearCondition, ...],
    plan: Plan,
) -> dict[int, Script]:
    """Return what an author writes for each hero, from one plan against the ego as foreseen."""
    return {
        hero.id: _script(scene, structure, limits[hero.id], conditions, plan, hero) for hero in scene.program.heroes
    }


def _script(
    scene: Scene,
    structure: Structure,
    limits: Limits,
    conditions: tuple[LinearCondition, ...],
    plan: Plan,
    hero: Actor,
) -> Script:
    profile, names = plan.profiles[hero.id], hero.sketch.knots
    # Without a trigger the whole motion is fixed in time from the first moment on.
    knot = structure.trigger_knot(hero.id) or names[0]
    first = names.index(knot)
    trigger_s = profile.knot_times_s[knot]
    place_m, speed, _ = profile.state(trigger_s)
    before = [s for s in profile.segments if s.piece < first] or [Segment(0.0, 0.0, *profile.state(0.0)[:2], 0.0)]
    past = {name: profile.knot_times_s[name] for name in names[:first]}
    turn = TurnSpan.of(scene.routes[hero.id])
    return Script(
        hero,
        limits,
        Profile(_slowed_for_turn(before, place_m, limits, turn), past),
        _group(structure, conditions, plan, hero, trigger_s),
        _manoeuvre(scene, hero, profile, first),
        place_m,
        plan.profiles[EGO].state(trigger_s)[0],
        trigger_s,
        speed,
        knot,
        turn,
    )


def _group(
    structure: Structure, conditions: tuple[LinearCondition, ...], plan: Plan, hero: Actor, trigger_s: float
) -> ConditionGroup:
    states = {actor: profile.state(0.0)[:2] for actor, profile in plan.profiles.items()}
    instant = structure.triggers.get(hero.id, frozenset())
    # Engines have conditions on places, gaps and times to arrival; a speed at the trigger is the approach's affair.
    compared = [c for c in conditions if c.moments <= instant and any(metre for metre, _ in c.weights.values())]
    sides = tuple((c, math.copysign(1.0, value)) for c in compared if abs(value := c.value(states)) > _ROUNDING)
    return ConditionGroup(sides, trigger_s)


def _manoeuvre(scene: Scene, hero: Actor, profile: Profile, first: int) -> tuple[SpeedAction, ...]:
    """Return one action for each piece: from the plan's speed at its begin to that at its end, over as much way."""
    actions = []
    for piece, ends in enumerate(pairwise(hero.sketch.knots)):
        begin_s, end_s = (profile.knot_times_s[name] for name in ends)
        if piece < first or end_s - begin_s < _NO_TIME_S:
            continue
        (begin_m, before_mps, _), (end_m, after_mps, _) = profile.state(begin_s), profile.state(end_s)
        change, way_m = after_mps - before_mps, end_m - begin_m
        if abs(change) < _NO_CHANGE_MPS:
            actions.append(SpeedAction(piece, after_mps, duration_s=end_s - begin_s))
            continue
        rate = abs(change) * (before_mps + after_mps) / (2.0 * way_m)
        # One that is to stop somewhere stops over a distance, unless the text says at which rate.
        over = change < 0 and not _rate_is_given(scene.program, hero, piece)
        actions.append(SpeedAction(piece, after_mps, rate, distance_m=way_m if over else None))
    return tuple(actions)


def _slowed_for_turn(
    approach: list[Segment], place_m: float, limits: Limits, turn: TurnSpan | None
) -> tuple[Segment, ...]:
    """Let a hero whose trigger has not come by its place slow down for its turn, where it can: it is still a car."""
    last = approach[-1]
    speed, top = last.end_speed_mps, limits.turn_speed_max_mps
    if turn is None or speed <= top or last.end_s_m >= turn.start_m:
        return tuple(approach)
    room_m = turn.start_m - max(last.end_s_m, min(place_m, turn.start_m - 0.1))
    rate = min(max(_SLOW_FOR_TURN_MPSS, (speed**2 - top**2) / (2.0 * room_m)), limits.brake_max_mpss)
    held_m = max(0.0, turn.start_m - (speed**2 - top**2) / (2.0 * rate) - last.end_s_m)
    moves = [(held_m / speed, 0.0, last.piece), ((speed - top) / rate, -rate, last.piece)]
    return (*approach, *chain(last.end_s, last.end_s_m, speed, moves))


def _rate_is_given(program: Program, hero: Actor, piece: int) -> bool:
    """Whether the program gives the acceleration of a piece of the hero's sketch."""
    for constraint in program.constraints:
        node = piece_of(constraint.formula) if isinstance(constraint.formula, Compare) else None
        if node is None or node.actor != hero.id or node.order != 2 or not isinstance(node.at, PieceRef):
            continue
        if constraint.formula.operator == "==" and hero.sketch.piece_index(node.at.name) == piece:
            return True
    return False
