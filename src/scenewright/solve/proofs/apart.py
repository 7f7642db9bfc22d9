"""Bodies do not go through each other: what follows for two, and for too many through one place in too short a time.

What enters: events and constraints. What leaves: rules that every motion keeps which a judge may accept; or, by
counting, what clashes: whoever passes a place covers it at its greatest speed for as long as it is itself, and two that
cover it at once touch. Contact that a trigger asks for, by saying where both are, is not its matter.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import Formula, Named, Polynomial, compare, every, needed, some
from scenewright.program import expressions as ex
from scenewright.program.structure import (
    KnotKey,
    Structure,
    actors_of,
    knots_of,
    placed_at,
    read_structure,
    synchronised,
)
from scenewright.program.types import EGO, Constraint, Program
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, Body
from scenewright.roads.conflicts import Stretch, conflicts, shared_stretches
from scenewright.roads.grounding import Scene
from scenewright.roads.zones import overlap
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.order import least_differences, places_within
from scenewright.units import format_fraction, pin

Array = NDArray[np.float64]
Meeting = tuple[Sequence[int], Collection[int]]  # who is told to be where at one trigger, and the moments that it is
Point = Mapping[int, float]  # one place of the map, as the arc length on the way of each hero that passes it

APART = "orchestrated actors keep clear of each other"
# Centres nearer than this along one lane: bodies overlap, and a car covers a place from half of it on. A little less
# than a length, for lanes bend.
_OVERLAP_M = VEHICLE_LENGTH_M - 0.1
_HALF_M = 0.5 * _OVERLAP_M
_SIDES = ((">=", 1), ("<=", -1))
_ROUNDING = 1e-6
_ROOMY = Body(VEHICLE_LENGTH_M + 0.5, VEHICLE_WIDTH_M + 0.5)  # a judge lets places be a little off


def apart(events: Events, structure: Structure, constraints: Sequence[Constraint]) -> list[Named]:
    """Return that those are apart of whom a distance is asked for, at each knot at which it is, and as at the start."""
    program, triggers = events.scene.program, structure.triggers.values()
    clear_m = program.manner.clear_m
    room_m = pin(_OVERLAP_M) + clear_m
    found = list[Named]()
    for a, b, key in dict.fromkeys(_asked(structure, constraints)):
        if not any({a, b} <= placed_at(program, trigger) for trigger in triggers):
            at, words = events.knot(*key), "the ego touches nobody before the trigger" if a == EGO else APART
            words += f" (clear_m is {format_fraction(clear_m)} m)" if clear_m else ""
            for instants in ([at], [events.start, at]) if at != events.start else ([at],):
                found += [Named(rule, words) for rule in clear(events, a, b, instants, room_m)]
    return found


def _asked(structure: Structure, constraints: Sequence[Constraint]) -> Iterator[tuple[int, int, KnotKey]]:
    """Yield pairs, lower number first, with the knots at which a distance between them is asked for."""
    triggers = structure.triggers.values()
    early = {*structure.starts.items()}.union(*triggers)  # no later than the last trigger
    moments = [{*structure.starts.items()}, *structure.instants]
    for constraint in constraints:
        for node in ex.walk(constraint.formula):
            match node:
                case ex.Derived(actor=actor, target=int(other)) if told := list(knots_of(node)):
                    key = told[0]
                case ex.Compare():
                    places = {(n.actor, n.at) for n in ex.walk(node) if isinstance(n, ex.State) and not n.order}
                    keys = sorted((actor, at.name) for actor, at in places if isinstance(at, ex.Knot))
                    if len(keys) != 2 or keys[0][0] == keys[1][0] or not any({*keys} <= each for each in moments):
                        continue
                    key, actor, other = keys[0], keys[0][0], keys[1][0]
                case _:
                    continue
            a, b = sorted((actor, other))
            yield from [(a, b, key)] if a != EGO or key in early else []


def clear(events: Events, a: int, b: int, instants: Sequence[int], room_m: Fraction) -> Iterator[Formula]:
    """Yield for each stretch that two share that one of them is outside it, or ahead of the other by some room.

    At more than one instant it is the same one who is ahead: nobody leaves a stretch and comes back.
    """
    for stretch in shared_stretches(events.scene.routes[a], events.scene.routes[b]):
        ahead = [_ahead(events, a, b, at, stretch) for at in instants]
        outside = [each for at in instants for each in _outside(events, a, b, at, stretch)]
        before, behind = (every([compare(sign, each, side * room_m) for each in ahead]) for sign, side in _SIDES)
        yield some([before, behind, *outside])


def _outside(events: Events, a: int, b: int, instant: int, stretch: Stretch) -> list[Formula]:
    """Return what it is for one of two to be outside a stretch."""
    found = list[Formula]()
    for actor, begin, end in zip((a, b), stretch.begin, stretch.end, strict=True):
        place = events.state(actor, instant).place
        if begin > 0.0:
            found.append(compare("<", place, pin(begin)))
        if end < events.scene.routes[actor].landmarks["route_end"]:
            found.append(compare(">", place, pin(end)))
    return found


def _ahead(events: Events, a: int, b: int, instant: int, stretch: Stretch) -> Polynomial:
    """Return by how much the second of two is ahead in a stretch."""
    one, other = events.state(a, instant).place, events.state(b, instant).place
    return (other - pin(stretch.begin[1])) - (one - pin(stretch.begin[0]))


# -- counting ---------------------------------------------------------------------------------------------------------
def crowded(events: Events, lowered: Sequence[Named]) -> tuple[str, ...]:
    """Return what clashes where too many must pass one place in too short a time; nothing where no such place is found.

    Heroes that the program wants in each other are not counted.
    """
    program = events.scene.program
    triggers = dict.fromkeys(read_structure(program).triggers.values())
    placed = {instant: placed_at(program, instant) - {EGO} for instant in triggers}
    meetings = [(sorted(heroes), {events.knot(*key) for key in at}) for at, heroes in placed.items() if len(heroes) > 1]
    facts = _Facts(events, lowered, meetings)
    crowds = ({hero: point[hero] for hero in facts.crowd(point)} for point in _points(events.scene, facts))
    if (there := next(filter(None, crowds), None)) is None:
        return ()
    kept = needed(lowered, lambda fewer: len(_Facts(events, fewer, meetings).crowd(there)) == len(there))
    told = [each.origin for each in kept]
    return (*dict.fromkeys([*told, *_ties(program, told, there)]), APART)


def _ties(program: Program, told: Collection[str], crowd: Collection[int]) -> list[str]:
    """Return the constraints that make one moment of two, where the crowd or what is told of it rests on that."""
    known = set(crowd).union(*(actors_of(program.constraint(name).formula) for name in told))
    groups = [group for group in read_structure(program).instants if known & {actor for actor, _ in group}]
    ties = [(each.id, key) for each in program.constraints for key, _ in synchronised(each.formula)]
    return [name for name, key in ties if any(key in group for group in groups)]


class _Facts:
    """What constraints say of single places, how much later moments are than others at least, who may touch whom."""

    def __init__(self, events: Events, lowered: Sequence[Named], meetings: Sequence[Meeting]) -> None:
        formulas = [each.formula for each in lowered]
        within = places_within(events, formulas).items()
        ends = {hero: events.scene.routes[hero].landmarks["route_end"] for hero in events.scene.routes}
        self.events, self.least = events, least_differences(events, formulas)
        self.most_m = {key: float(high) for key, (_, high) in within if high < pin(ends[key[0]])}
        self.least_m = {key: float(low) for key, (low, _) in within if low > 0}
        self.touching = set[int]().union(*(self._touching(*meeting) for meeting in meetings))

    def crowd(self, point: Point) -> tuple[int, ...]:
        """Return heroes that cannot all pass a point in the time that they have for it."""
        passing = {hero: self._window(hero, point[hero]) for hero in sorted(set(point) - self.touching)}
        windows = {hero: window for hero, window in passing.items() if window is not None}
        if len(windows) < 2:
            return ()
        early, late, lasts = map(np.array, zip(*windows.values(), strict=True))  # of (heroes, moments); of heroes
        for since in np.flatnonzero(np.min(late - early, axis=0) < lasts.sum()):  # times are counted from this moment
            begins, ends = early[:, since], late[:, since]
            inside = (begins[None, None] >= begins[:, None, None]) & (ends[None, None] <= ends[None, :, None])
            over = inside @ lasts - (ends[None] - begins[:, None])
            first, last = np.unravel_index(np.argmax(np.where(inside.sum(axis=2) > 1, over, -np.inf)), over.shape)
            if over[first, last] > _ROUNDING and inside[first, last].sum() > 1:
                return tuple(hero for hero, within in zip(windows, inside[first, last], strict=True) if within)
        return ()

    def _window(self, hero: int, place_m: float) -> tuple[Array, Array, float] | None:
        """Return from when and until when at the most, after each moment, and for how long at least it covers a place.

        None where it is not certain to pass it.
        """
        fastest = float(self.events.law_of(hero).speed_high)
        before = [
            self.least[:, k] + (place_m - _HALF_M - at_m) / fastest
            for (owner, k), at_m in self.most_m.items()
            if owner == hero and at_m <= place_m - _HALF_M
        ]
        after = [
            -self.least[k, :] - (at_m - place_m - _HALF_M) / fastest
            for (owner, k), at_m in self.least_m.items()
            if owner == hero and at_m >= place_m + _HALF_M
        ]
        if not before or not after:
            return None
        return np.max(before, axis=0), np.min(after, axis=0), 2.0 * _HALF_M / fastest

    def _touching(self, heroes: Sequence[int], moments: Collection[int]) -> set[int]:
        """Return who of a meeting is not told to be, at one of its moments, where it is clear of each other one."""
        clear = np.eye(len(heroes), dtype=bool)
        for k in moments:
            places = np.array([self.most_m.get((hero, k), np.nan) for hero in heroes])
            told = places == [self.least_m.get((hero, k), np.inf) for hero in heroes]
            paths = [self.events.scene.routes[hero].path for hero in heroes]
            poses = np.array([path.poses(np.array([at_m]))[0] for path, at_m in zip(paths, places, strict=True)])
            clear |= told[:, None] & told & ~overlap(poses[:, None], poses[None], _ROOMY, _ROOMY)
        return {hero for hero, each in zip(heroes, clear, strict=True) if not each.all()}


def _points(scene: Scene, facts: _Facts) -> Iterator[Point]:
    """Yield where several heroes pass: where ways cross, and just beyond and before where somebody is told to be."""
    heroes, seen = [hero.id for hero in scene.program.heroes], set[tuple[tuple[int, float], ...]]()
    for hero in heroes:
        places = [at_m + _HALF_M for (owner, _), at_m in facts.most_m.items() if owner == hero]
        places += [at_m - _HALF_M for (owner, _), at_m in facts.least_m.items() if owner == hero]
        places += [at_m for other in heroes if other != hero for at_m, _ in _crossings(scene, hero, other)]
        for place_m in dict.fromkeys(places):
            passed = {other: _passed_m(scene, hero, place_m, other) for other in heroes}
            point = {other: at_m for other, at_m in passed.items() if at_m is not None}
            key = tuple(sorted((other, round(at_m, 3)) for other, at_m in point.items()))
            if len(point) > 1 and key not in seen:
                seen.add(key)
                yield point


def _passed_m(scene: Scene, hero: int, place_m: float, other: int) -> float | None:
    """Return where on the way of another a place on a hero's is; None where it does not come there."""
    if other == hero:
        return place_m
    for stretch in shared_stretches(scene.routes[hero], scene.routes[other]):
        if stretch.begin[0] <= place_m <= stretch.end[0]:
            return stretch.beside((place_m, 0.0))[1]
    crossings = _crossings(scene, hero, other)
    return next((at_m for own_m, at_m in crossings if abs(own_m - place_m) < _ROUNDING), None)


def _crossings(scene: Scene, hero: int, other: int) -> list[tuple[float, float]]:
    found = conflicts(scene.routes[hero], scene.routes[other])
    return [(each.s_a_m, each.s_b_m) for each in found if each.kind != "following"]
