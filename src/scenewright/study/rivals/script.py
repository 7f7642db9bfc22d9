"""What a scenario author writes down once, before the run: an approach, a condition group, a manoeuvre.

What enters: the first plan, made against the ego's predicted approach. What leaves: a `Script` for each hero, in terms
of OpenSCENARIO: conditions on distances and times to arrival that start a sequence of speed actions. Nothing here
knows how the ego will really drive.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from scenewright.motion.profile import Profile, Segment, chain
from scenewright.program.structure import Structure
from scenewright.program.types import EGO, Actor
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.limits import Limits
from scenewright.solve.plan import Plan
from scenewright.solve.stretches import rate_is_given
from scenewright.solve.turns import TurnSpan

States = Mapping[int, tuple[float, float]]
# What an engine compares is a float; a car that is where the author put it counts as being there.
_ROUNDING = 1e-6
_NO_CHANGE_MPS = 1e-3
_NO_TIME_S = 1e-6
_SLOW_FOR_TURN_MPSS = 2.5


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
    """

    sides: tuple[tuple[LinearCondition, float], ...]
    at_s: float

    def holds(self, time_s: float, states: States) -> bool:
        """Whether all conditions hold, given ``(position, speed)`` of every actor."""
        if not self.sides:
            return time_s >= self.at_s - _ROUNDING
        return all(sign * condition.value(states) <= _ROUNDING for condition, sign in self.sides)


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

    def begun_at(self, s_m: float, speed_mps: float, turn: TurnSpan | None) -> Script:
        """Return the same script with another first state, held at constant speed."""
        past = dict.fromkeys(self.approach.knot_times_s, 0.0)
        approach = _slowed_for_turn([Segment(0.0, 0.0, s_m, speed_mps, 0.0)], self.own_place_m, self.limits, turn)
        return replace(self, approach=Profile(approach, past), trigger_speed_mps=speed_mps)


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
    actions = []
    for segment in profile.segments:
        if segment.piece < first or segment.duration_s < _NO_TIME_S:
            continue
        change = segment.end_speed_mps - segment.speed_mps
        if abs(change) < _NO_CHANGE_MPS:
            actions.append(SpeedAction(segment.piece, segment.end_speed_mps, duration_s=segment.duration_s))
            continue
        # One that is to stop somewhere stops over a distance, unless the text says at which rate.
        over = change < 0 and not rate_is_given(scene.program, hero, segment.piece)
        distance_m = segment.end_s_m - segment.s_m if over else None
        rate = abs(segment.accel_mpss)
        actions.append(SpeedAction(segment.piece, segment.end_speed_mps, rate, distance_m=distance_m))
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
