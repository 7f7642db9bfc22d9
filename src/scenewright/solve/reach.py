"""How near to its side of the trigger a hero can come, by arithmetic alone: what a solver need not be asked.

What enters: a hero's state, the stretches before its trigger, what it may do in them. What leaves: the least miss of
its side, in tight tolerances, never more than any solution has; without end where it comes too late for the outcome.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from scenewright.motion.algebra import pin
from scenewright.program.structure import Structure
from scenewright.program.types import Actor, PieceKind, Program
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import TIGHT_LENGTH_M, TIGHT_TIME_S, LinearCondition, hero_side
from scenewright.solve.clearance import out_of_way_mps
from scenewright.solve.haste import Errand
from scenewright.solve.limits import ACCEL_MAX_MPSS, ROOM, WAIT_BRAKE_MPSS, Limits, Style, Wait
from scenewright.solve.situation import Situation
from scenewright.solve.stretches import (
    approach_rates,
    following_piece,
    rate_is_given,
    shortest_s,
    timed_approach,
    trigger_speed_mps,
)

_SLOWEST_MPS = 0.05
_WALKING_MPS = 1.5
# Nobody creeps more slowly than this for long, even less where the ego may make haste; how one that waits drives up and
# sets off, how fast it is then at its trigger if it may choose (to brake or to speed up), and with how much to spare.
_CREEPS_MPS, _CREEPS_WHEN_HASTY_MPS = 1.5, 4.0
_DRIVES_UP_MPS, _DRIVES_UP_MPSS = 5.0, 2.0
_SETS_OFF_MPS, _FLYING_MPS, _SETS_OFF_MPSS, _SETS_OFF_CALMLY_MPSS = 1.2, 3.5, 3.5, 2.0
_SOMEWHAT_FASTER, _JUST_FASTER = 1.1, 1.04
_LATE_SLACK_S = 0.01
_SHORTEST_GO_S = 0.1
_STANDS_MPS, _BRAKES_AT_MOST_MPSS = 0.2, 7.5
# How far beside its place one may wait: mostly, and at the last one.
_ROOM_M, _LEAST_ROOM_M = 0.3, 0.03
# How finely the authority needed is found, and how much more is given: the solver needs some room.
_HALVINGS, _AMPLE, _AT_LEAST = 6, 1.15, 0.04
# What is taken of the rest where one has to be ready, too.
_CALM_SHARE = 0.2


@dataclass(frozen=True, slots=True)
class Approach:
    """The way to a trigger, as the solver is given it.

    Attributes
    ----------
    stretches
        ``(duration_s, up_mpss, down_mpss)``, in order: how long, and how hard the hero may speed up and brake.
    top_mps, least_mps
        Its top speed, and the smallest speed that it may have at the trigger.
    """

    stretches: tuple[tuple[float, float, float], ...]
    top_mps: float
    least_mps: float

    def fastest(self, s_m: float, speed_mps: float) -> tuple[float, float]:
        """Return place (m) and speed (m/s) at the trigger of a hero that hurries all the way."""
        for duration_s, up, down in self.stretches:
            following = max(min(self.top_mps, speed_mps + up * duration_s), speed_mps - down * duration_s)
            s_m += 0.5 * (speed_mps + following) * duration_s
            speed_mps = following
        return s_m, speed_mps

    def slowest(self, s_m: float, speed_mps: float) -> tuple[float, float]:
        """Return place (m) and speed (m/s) at the trigger of a hero that holds back for as long as it can."""
        gain = sum(max(up, 0.0) * duration_s for duration_s, up, _ in self.stretches)
        for duration_s, up, down in self.stretches:
            gain -= max(up, 0.0) * duration_s
            following = max(speed_mps - down * duration_s, 0.0, self.least_mps - gain)
            following = min(following, speed_mps + up * duration_s)
            s_m += 0.5 * (speed_mps + following) * duration_s
            speed_mps = following
        return s_m, speed_mps

    def within(self, up_mpss: float, down_mpss: float) -> Approach:
        """Return the same way, driven no harder than this."""
        gentler = tuple((duration_s, min(up, up_mpss), min(down, down_mpss)) for duration_s, up, down in self.stretches)
        return Approach(gentler, self.top_mps, self.least_mps)

    def place_m(self, side: LinearCondition, hero: int) -> float:
        """Return about where (m) the hero is to be at its side."""
        per_metre, per_speed = side.weights[hero]
        return -(side.constant + per_speed * max(self.least_mps, _WALKING_MPS)) / per_metre


def least_miss(side: LinearCondition, hero: int, approach: Approach, s_m: float, speed_mps: float) -> float:
    """Return how far off its side the hero must be at the least, in tight tolerances; 0 where it can meet it."""
    per_metre, per_speed = side.weights[hero]
    if per_metre * per_speed < 0.0:
        return 0.0  # a place further on and a higher speed do not go together here: the solver knows
    ends = (approach.slowest(s_m, speed_mps), approach.fastest(s_m, speed_mps))
    misses = [(side.constant + per_metre * place + per_speed * speed, speed) for place, speed in ends]
    if misses[0][0] * misses[1][0] <= 0.0:
        return 0.0
    return min(
        abs(miss) / (TIGHT_TIME_S * max(speed, _SLOWEST_MPS) if per_speed else TIGHT_LENGTH_M * abs(per_metre))
        for miss, speed in misses
    )


@dataclass(frozen=True, slots=True)
class Task:
    """What a hero has to do at its trigger: its side of it, and where (m) it has to stop by braking there, if any."""

    side: LinearCondition
    hero: int
    piece: int
    knot: str
    following: PieceKind
    stop_m: float | None

    def least_mps(self, dec_mpss: tuple[float, float], shortest_s: float, tolerance: float) -> float:
        """Return the smallest speed at the trigger (m/s) from which it stops there within a range of rates (m/s^2).

        Who is slower would stop too soon even by the gentlest braking; one whose side is a time to arrival is the
        nearer to its stop the slower it is, and could not stop any more.

        Parameters
        ----------
        shortest_s
            For how long it brakes at least.
        tolerance
            By how much the trigger may be off, in tight tolerances.
        """
        if self.stop_m is None:
            return 0.0
        per_metre, per_speed = self.side.weights[self.hero]
        gentlest, hardest = dec_mpss
        rest_m = self.stop_m + self.side.constant / per_metre  # from where it would be at its side if it stood
        if not per_speed:
            return math.sqrt(2.0 * gentlest * max(0.0, rest_m - tolerance * TIGHT_LENGTH_M))
        away_s = per_speed / per_metre + tolerance * TIGHT_TIME_S
        slowest, _ = _speeds_that_stop(hardest, away_s, rest_m)
        if away_s > 0.5 * shortest_s:
            slowest = max(slowest, -rest_m / (away_s - 0.5 * shortest_s))
        low, high = _speeds_that_stop(gentlest, away_s, rest_m)
        return high if low < slowest < high else slowest


def _speeds_that_stop(rate_mpss: float, away_s: float, rest_m: float) -> tuple[float, float]:
    """Return the speeds (m/s) at which one brakes at just that rate who has `rest_m` and `away_s` at its speed to go.

    Between them it would have to brake less. Where there is none, both are 0.
    """
    half = rate_mpss * away_s
    square = half * half + 2.0 * rate_mpss * rest_m
    return (max(0.0, half - math.sqrt(square)), half + math.sqrt(square)) if square >= 0.0 else (0.0, 0.0)


# Its side, its id, its way to it, its place (m) and its speed (m/s).
_Way = tuple[LinearCondition, int, Approach, float, float]


class Prospects:
    """Tells of a way to try whether there is any hope in it, for the heroes of one scene.

    Parameters
    ----------
    scene, structure, limits, conditions
        As for a `Planner`.
    """

    def __init__(
        self,
        scene: Scene,
        structure: Structure,
        limits: Mapping[int, Limits],
        conditions: tuple[LinearCondition, ...],
    ) -> None:
        program = scene.program
        self._heroes = {hero.id: hero for hero in program.heroes}
        self._limits = limits
        self._settled_mpss = float(program.manner.stricter(ROOM).settled_mpss)
        self._out_of_way_mps = {hero.id: out_of_way_mps(scene, structure, conditions, hero) for hero in program.heroes}
        self._tasks: dict[int, Task] = {}
        errands = {hero.id: Errand.of(program, structure, conditions, hero) for hero in program.heroes}
        self._errands = {hero: errand for hero, errand in errands.items() if errand is not None}
        for hero in program.heroes:
            task = _task_of(program, hero, structure, conditions)
            if task is not None:
                self._tasks[hero.id] = task

    def least_miss(self, situation: Situation, style: Style, tolerance: float = 0.0) -> float:
        """Return how far off its side some hero must be at the least, in tight tolerances, when it moves so.

        Without end where it then comes too late for what is to come of it. `tolerance` is what it may be off.
        """
        if style.outcome and self._comes_too_late(situation, style):
            return math.inf
        return max((least_miss(*way) for way in self._ways(situation, style, tolerance)), default=0.0)

    def _comes_too_late(self, situation: Situation, style: Style) -> bool:
        """Whether no hero that moves so can be first where it is to be, with the margin that is asked for."""
        for hero, trigger_s in situation.trigger_s.items():
            errand = self._errands.get(hero)
            latest_s = situation.ego_knots_s.get(errand.ego_knot) if errand else None
            if errand is None or latest_s is None:
                continue
            soonest_s = trigger_s + errand.least_s(style, self._limits[hero]) + style.outcome_margin_s
            if soonest_s > latest_s + _LATE_SLACK_S:
                return True
        return False

    def versions(self, situation: Situation, style: Style, tolerance: float, gently: bool) -> tuple[Style, ...]:
        """Return how to carry out a style, best first: waiting where it has the time, gently, with all it allows."""
        waits = self.waiting(situation, style)
        if style.ready:
            return self._ready(situation, style, waits)
        gentled = self.gentled(situation, style, tolerance) if gently else style
        found = (gentled,) if gentled == style else (gentled, style)
        return found if waits is None else (waits, *found)

    def _ready(self, situation: Situation, style: Style, waits: Style | None) -> tuple[Style, ...]:
        """Return how a hero that is about to brake is ready for whatever the ego does; nothing for any other."""
        way = self._way_to_a_place(situation, style)
        if way is None or self._tasks[way[1]].following is not PieceKind.DEC:
            return ()
        _, _, _, s_m, speed_mps = way
        places = self._waiting_places(way, style, hasty=True)
        stops_m = s_m + speed_mps * speed_mps / (2.0 * _BRAKES_AT_MOST_MPSS)
        place_m, go_s, _ = next((place for place in places if place[0] >= stops_m), places[-1])
        ready = replace(style, waiting_place_m=place_m, sets_off_s=_SOMEWHAT_FASTER * go_s)
        found = (self._calmer(situation, ready), ready)
        return found if waits is None else (waits, *found)

    def _calmer(self, situation: Situation, style: Style) -> Style:
        """Return `style` with some of its authority: a little more than it takes where the ego comes as foreseen."""
        least = self.gentled(situation, style, 0.0)
        up, down = least.approach_accel_mpss, least.approach_brake_mpss
        return replace(
            style,
            approach_accel_mpss=up + _CALM_SHARE * (style.approach_accel_mpss - up),
            approach_brake_mpss=down + _CALM_SHARE * (style.approach_brake_mpss - down),
        )

    def gentled(self, situation: Situation, style: Style, tolerance: float) -> Style:
        """Return `style` with no more authority on the way to the trigger than it takes to come as near as that.

        What is left is a reserve for when the ego drives otherwise than foreseen.
        """
        settled = replace(style, counter_mpss=min(style.counter_mpss, self._settled_mpss))
        if settled != style and self.least_miss(situation, settled, tolerance) <= tolerance:
            style = settled
        ways = self._ways(situation, style, tolerance)
        up, down = style.approach_accel_mpss, style.approach_brake_mpss
        low, high = 0.0, 1.0
        for _ in range(_HALVINGS):
            share = 0.5 * (low + high)
            enough = all(
                least_miss(side, hero, approach.within(share * up, share * down), s_m, speed) <= tolerance
                for side, hero, approach, s_m, speed in ways
            )
            low, high = (low, share) if enough else (share, high)
        share = min(1.0, _AMPLE * high + _AT_LEAST)
        if not ways or share >= 1.0:
            return style
        return replace(style, approach_accel_mpss=share * up, approach_brake_mpss=share * down)

    def waiting(self, situation: Situation, style: Style) -> Style | None:
        """Return `style` with a wait on the way where it would only creep to the trigger; None where it would not.

        Who waits can still be early or late; who creeps ever nearer can only be early. One waits as near as it can and
        still be fast enough at its trigger, for the ego may make haste.
        """
        way = self._way_to_a_place(situation, style)
        if way is None or style.natural_speed:
            return None
        side, hero, approach, s_m, speed_mps = way
        rest_s = situation.trigger_s[hero] - situation.time_s
        creeps_mps = _CREEPS_WHEN_HASTY_MPS if situation.earliest_s else _CREEPS_MPS
        if approach.place_m(side, hero) - s_m > creeps_mps * rest_s:
            return None
        for place_m, go_s, room_m in self._waiting_places(way, style, bool(situation.earliest_s)):
            wait = _drive_up(s_m, speed_mps, place_m, room_m, _SOMEWHAT_FASTER * go_s)
            if wait is not None and wait.shortest_s < rest_s:
                return replace(style, wait=wait)
        return None

    def _waiting_places(self, way: _Way, style: Style, hasty: bool) -> list[tuple[float, float, float]]:
        """Return from where (m) a hero that stands can be at its side, how long (s) that takes, and the room (m) there.

        The best come first. The farther it is, the more it can make up for on its way; the nearer, the sooner it is
        there where the ego is in haste. The last is for one that can no longer stop before.
        """
        side, hero, approach, _, _ = way
        brakes = self._tasks[hero].following is PieceKind.DEC
        per_metre, per_speed = side.weights[hero]
        roomy_mps = max(_SETS_OFF_MPS if brakes else _FLYING_MPS, _SOMEWHAT_FASTER * approach.least_mps)
        found = [] if hasty or not brakes else [(roomy_mps, _SETS_OFF_CALMLY_MPSS, _ROOM_M)]
        found.append((roomy_mps, _SETS_OFF_MPSS, _ROOM_M))
        if brakes or not per_speed:
            found.append((_JUST_FASTER * approach.least_mps, ACCEL_MAX_MPSS, _LEAST_ROOM_M))
        places = []
        for speed, rate, room_m in found:
            go_s, run_m = speed / rate, speed * speed / (2.0 * rate)
            if speed and (not brakes or style.counter_mpss < _SETS_OFF_MPSS):
                go_s, run_m = go_s + style.settle_s, run_m + speed * style.settle_s
            place_m = -(side.constant + per_speed * speed) / per_metre - run_m
            places.append((place_m, max(go_s, _SHORTEST_GO_S), room_m))
        return places

    def _way_to_a_place(self, situation: Situation, style: Style) -> _Way | None:
        """Return the way of the only hero that is on one, where its side is a place and not a speed alone."""
        ways = self._ways(situation, style)
        return ways[0] if len(ways) == 1 and ways[0][0].weights[ways[0][1]][0] else None

    def _ways(self, situation: Situation, style: Style, tolerance: float = 0.0) -> list[_Way]:
        """Return, for every hero with a side of its own and a timed way to it, what `least_miss` takes."""
        found = []
        for hero_id, state in situation.heroes.items():
            task = self._tasks.get(hero_id)
            if task is not None and hero_id in situation.trigger_s and state.piece == task.piece:
                approach = self._approach(hero_id, task, situation, style, tolerance)
                if approach is not None:
                    found.append((task.side, hero_id, approach, state.s_m, state.speed_mps))
        return found

    def _approach(
        self, hero_id: int, task: Task, situation: Situation, style: Style, tolerance: float
    ) -> Approach | None:
        """Return the way to the trigger; None where no time is left."""
        rest_s = pin(situation.trigger_s[hero_id]) - pin(situation.time_s)
        stretches = []
        for stretch in timed_approach(style, task.piece, rest_s, task.knot, situation.heroes[hero_id].speed_mps):
            up, down = approach_rates(style, stretch, task.following)
            stretches.append((float(stretch.duration_s or 0), float(up), float(down)))
        if not stretches:
            return None
        timed = bool(task.side.weights[hero_id][1])
        least = trigger_speed_mps(style, self._heroes[hero_id], task.piece, timed, self._out_of_way_mps[hero_id])
        brakes_s = float(shortest_s(style, self._heroes[hero_id], task.piece + 1, task.knot, task.side))
        least = max(least, task.least_mps(style.dec_mpss, brakes_s, tolerance))
        return Approach(tuple(stretches), style.top_speeds_mps(self._limits[hero_id])[0], least)


def _drive_up(s_m: float, speed_mps: float, place_m: float, room_m: float, go_s: float) -> Wait | None:
    """Return how one comes to a stand at a place; None where it cannot, or stands too far on already."""
    rest_m = place_m - s_m
    if speed_mps < _STANDS_MPS and abs(rest_m) <= room_m:
        return Wait(0.0, 0.0, speed_mps / WAIT_BRAKE_MPSS, place_m, room_m, go_s)
    reach_m = rest_m + room_m
    if speed_mps * speed_mps > 2.0 * _BRAKES_AT_MOST_MPSS * reach_m:
        return None
    if speed_mps * speed_mps >= 2.0 * WAIT_BRAKE_MPSS * rest_m:
        return Wait(0.0, 0.0, 2.0 * max(rest_m, 0.5 * reach_m) / max(speed_mps, _SLOWEST_MPS), place_m, room_m, go_s)
    # Up to a peak, on at it, and down again.
    before_m = rest_m + speed_mps**2 / (2 * _DRIVES_UP_MPSS)
    peak = math.sqrt(before_m / (0.5 / _DRIVES_UP_MPSS + 0.5 / WAIT_BRAKE_MPSS))
    peak = max(speed_mps, min(peak, _DRIVES_UP_MPS))
    up_m = (peak * peak - speed_mps * speed_mps) / (2.0 * _DRIVES_UP_MPSS)
    hold_m = max(0.0, rest_m - up_m - peak * peak / (2.0 * WAIT_BRAKE_MPSS))
    return Wait((peak - speed_mps) / _DRIVES_UP_MPSS, hold_m / peak, peak / WAIT_BRAKE_MPSS, place_m, room_m, go_s)


def _task_of(
    program: Program, hero: Actor, structure: Structure, conditions: tuple[LinearCondition, ...]
) -> Task | None:
    """Return the task of a hero that drives straight on to a side of its own; None for any other."""
    knots = hero.sketch.knots
    knot = structure.trigger_knot(hero.id)
    alone = [c for c in conditions if set(c.weights) == {hero.id}]
    side = hero_side(conditions, structure, hero.id)
    if side is None or knot is None or knots.index(knot) == 0:
        return None
    piece = knots.index(knot) - 1
    if hero.sketch.pieces[piece] is not PieceKind.GO:
        return None
    following = following_piece(hero, piece)
    stop_m = None
    if following is PieceKind.DEC and not rate_is_given(program, hero, piece + 1):
        stop = next((c for c in alone if c.moments == {(hero.id, knots[piece + 2])} and c.weights[hero.id][0]), None)
        if stop is not None and not stop.weights[hero.id][1]:
            stop_m = -stop.constant / stop.weights[hero.id][0]
    return Task(side, hero.id, piece, knot, following, stop_m)
