"""What a program asks of heroes, lowered once for all plans of a run, by the code that proofs and witnesses rest on.

What enters: a scene. What leaves: values and slopes of all that is asked, over the states of actors at moments; of
alternatives the one that is nearest to holding.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.compiled import Compiled
from scenewright.algebra.polynomials import Atom, Polynomial, TooHigh
from scenewright.motion.limits import Limits, Signs
from scenewright.plan.preferences import preferences_of
from scenewright.plan.triggers import adapts_until, beside_others
from scenewright.program.expressions import ParameterRef, walk
from scenewright.program.structure import (
    Structure,
    actors_of,
    knots_of,
    speeds_told_at,
    stands_at_end,
)
from scenewright.program.types import EGO, Actor
from scenewright.roads.grounding import Scene
from scenewright.roads.model import RoadMap
from scenewright.roads.routes import Route
from scenewright.roads.turns import TurnSpan
from scenewright.solve.parameters import everyday_value
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.forms import free_actors, lasting_places
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.order import least_differences

Array = NDArray[np.float64]

TIGHT = {"time": 0.1, "place": 0.5, "speed": 0.25, "rate": 0.25, "other": 1.0}
_SPARE = 0.5  # of a tight tolerance; chosen
_AROUND_M, _STEP_M = 2.0, 0.5  # between two nodes of a plan a car goes a few metres
_OF_TOP, _OF_LATERAL = 0.99, 0.97  # between two nodes a speed may be a little higher than at both
_SETTLED = 1e9  # tight tolerances off: what no plan changes any more is chosen only where all is so
_LOOKS = 8  # at so many moments of what is left of it, something that has to last is looked at; chosen


@dataclass(frozen=True, slots=True)
class Row:
    """One comparison at some values: its level in tight tolerances (at most zero, or zero), and its slopes.

    `order` says that it compares nothing but times, one the ego's alone, of which one is to be the earlier. By `spare`
    it is to be more than met: which of two heroes comes first is no matter of rounding, nor is a distance that is kept.
    """

    level: float
    slope: Array
    equal: bool
    order: bool
    spare: float = 0.0


class Asked:
    """A scene's constraints on heroes over the unknowns of `events`."""

    def __init__(self, scene: Scene, structure: Structure, limits: Mapping[int, Limits]) -> None:
        self.scene, self.structure, self.limits = scene, structure, limits
        self.beside = frozenset(beside_others(scene.program, structure))
        self.wanted = preferences_of(scene.program.manner)
        self.events = Events(scene, limits, EgoBounds())
        # What is usual for parameters that are still open (SI), by number.
        self.everyday = {
            self.events.parameters[each.name].number: float(everyday_value(each)) for each in scene.open_parameters()
        }
        self.lowering = Lowering(self.events)
        self.looks, self.stretches = self._make_looks()
        at_triggers = {key for instant in structure.triggers.values() for key in instant}
        still_open = {each.name for each in scene.open_parameters()}
        constraints = tuple(  # of the ego alone: only what tells when a trigger comes, or an open parameter's value
            c
            for c in scene.program.constraints
            if actors_of(c.formula) != {EGO}
            or set(knots_of(c.formula)) & at_triggers
            or any(isinstance(node, ParameterRef) and node.name in still_open for node in walk(c.formula))
        )
        lowered = self.lowering.lower(constraints)
        self._formulas = Compiled([each.formula for each in (*lowered, *self.events.rules)], self.size)
        # How much later each instant is at least than another.
        self.least_s = least_differences(self.events, (each.formula for each in lowered))
        self.of_ego = {self.knot(EGO, name) for name in scene.program.ego.sketch.knots} - {self.events.start}
        self.adapts_until = adapts_until(scene.program, structure, self._after_ego())
        self.narrowings = tuple(self.lowering.narrowings)
        self.times = [number_of(time) for time in self.events.times]
        self._scale = np.array([*(TIGHT[unknown.kind] for unknown in self.events.unknowns), 0.0])
        instants = {number: instant for instant, number in enumerate(self.times) if number is not None}
        read = [self._read(atom, instants) for atom in self._formulas.atoms]
        self._orders, self._spares = [each[0] for each in read], [each[1] for each in read]
        self._given = np.array([each[2] for each in read], dtype=bool)
        self._quotients = list(self._quotients_of(self._formulas.atoms))
        self.caps = {
            hero.id: caps_of(scene.routes[hero.id], scene.road_map, limits[hero.id], self.wanted.lateral_mpss)
            for hero in scene.program.heroes
        }
        landmarks = {hero.id: scene.routes[hero.id].landmarks for hero in scene.program.heroes}
        self.not_begun_m = {  # beyond its turn nobody shows any longer where it came from
            hero: (
                marks["junction_start"],
                marks["junction_end" if TurnSpan.of(scene.routes[hero]) is None else "route_end"],
            )
            for hero, marks in landmarks.items()
            if "junction_start" in marks
        }
        self.speed_told = {  # heroes of whom the program says how fast they are where they begin to act
            hero
            for hero, name in self.adapts_until.items()
            if hero in speeds_told_at(scene.program, structure.triggers.get(hero, frozenset({(hero, name)})))
        }
        self.stand = {hero.id for hero in scene.program.heroes if stands_at_end(scene.program, hero.id)}
        self.zones_m = {}
        for hero in scene.program.heroes:
            conflict = scene.conflict(EGO, hero.id)
            if conflict is not None and conflict.kind != "following":
                self.zones_m[hero.id] = conflict.zone_b_m[0] - self.wanted.clear_of_zone_m

        self.second_to = {hero.id: knot for hero in scene.program.heroes if (knot := self._second_to(hero)) is not None}

    @property
    def size(self) -> int:
        """How many unknowns there are."""
        return len(self.events.unknowns)

    def _make_looks(self) -> tuple[list[int], set[tuple[int, int]]]:
        """Return moments between all others, and from and up to which something is asked for some time of places."""
        actors, stretches = set[int](), set[tuple[int, int]]()
        for node in lasting_places(self.scene.program):
            with suppress(TooHigh):  # told by the lowering
                stretches.add(self.lowering.stretch_of(node))
                actors |= free_actors(node.body)
        looks = [self.events.instant(f"look{number}") for number in range(_LOOKS if stretches else 0)]
        for actor, look in product(sorted(actors), looks):
            self.events.state(actor, look)
        return looks, stretches

    def _after_ego(self) -> dict[int, str]:
        """Return of each hero the first knot that surely does not come before one of the ego's but its first."""
        found = dict[int, str]()
        for hero in self.scene.program.heroes:
            for name in reversed(hero.sketch.knots[1:]):
                if any(self.least_s[earlier, self.knot(hero.id, name)] >= 0.0 for earlier in self.of_ego):
                    found[hero.id] = name
        return found

    def _second_to(self, hero: Actor) -> str | None:
        """Return the knot of the ego that what a hero does from its trigger on surely ends after; None for none."""
        name = self.structure.trigger_knot(hero.id)
        if name is None or name == hero.sketch.knots[-1]:
            return None
        after = hero.sketch.knots[hero.sketch.knot_index(name) + 1]
        begins, ends = self.knot(hero.id, name), self.knot(hero.id, after)
        for knot in self.scene.program.ego.sketch.knots[1:]:
            at = self.knot(EGO, knot)
            if self.least_s[at, ends] >= 0.0 > self.least_s[at, begins]:
                return knot
        return None

    def knot(self, actor: int, name: str) -> int:
        """Return the instant of a knot."""
        return self.events.knot(actor, name)

    def trigger(self, hero: int) -> int | None:
        """Return the instant of a hero's trigger, or of what hangs on others; None where it has none."""
        return None if hero in self.beside else self.until(hero)

    def until(self, hero: int) -> int | None:
        """Return the instant up to which a hero adapts; None where it does not."""
        name = self.adapts_until.get(hero)
        return None if name is None else self.knot(hero, name)

    def rows(self, point: Array, slopes: Array) -> Iterator[Row]:
        """Yield what is asked at a point.

        Parameters
        ----------
        point
            Values of all unknowns and a one behind them, shape (size + 1,).
        slopes
            Their derivatives by whatever they depend on, shape (size + 1, n).
        """
        values, gradients = self._formulas.values(point), self._formulas.gradients(point)
        norms = np.maximum(np.sqrt(((gradients * self._scale) ** 2).sum(axis=1)), 1e-9)
        for k, place, speed in self._quotients:
            # A time to arrival is off by its own tolerance, which is a shorter way the slower one is.
            speed_mps = max(float(point[speed]), self.wanted.moves_mps)
            norms[k] = TIGHT["time"] * speed_mps * max(abs(float(gradients[k, place])), 1e-9)
        levels, equal = values / norms, self._formulas.equal
        changes = self._formulas.along(point, slopes) / norms[:, None]
        missed = np.where(equal, np.abs(levels), levels)
        # An alternative that does not hold is none where nothing that is still to be planned changes it.
        settled = (missed > 1.0) & ~np.any(changes != 0.0, axis=1)
        errors = np.where(settled, _SETTLED, missed)
        chosen = self._formulas.chosen(np.where(self._given & (missed > 0.0), np.inf, errors))
        for k in chosen:
            order, spare = (self._orders[k], self._spares[k]) if not equal[k] else (False, 0.0)
            yield Row(float(levels[k]), changes[k], bool(equal[k]), order, spare)
        for k, _, speed in self._quotients:
            # Who stands where it is to be arrives at no time; nor is it there soon enough.
            if k in chosen and (equal[k] or gradients[k, speed] < 0.0) and np.any(slopes[speed]):
                short_mps = self.wanted.moves_mps - float(point[speed])
                yield Row(short_mps / TIGHT["speed"], -slopes[speed] / TIGHT["speed"], equal=False, order=False)

    def _read(self, atom: Atom, instants: Mapping[int, int]) -> tuple[bool, float, bool]:
        """Return whether a comparison is of times, the ego's among them, how much is to spare, and whether it is given.

        A moment that is "2 s later" by what it is defined as is not one that is to be earlier or later. That a look is
        outside of a stretch of time, or that there is nothing of one, is given: what is asked for some time is not done
        by ending it sooner.
        """
        keys, states, looks = [key for key in atom.left.terms if key], self.events.states, set(self.looks)
        found = {instants.get(key[0]) if len(key) == 1 else None for key in keys}
        given = None not in found and (not found.isdisjoint(looks) or any(found == set(e) for e in self.stretches))
        if found & {None, *self.events.defined, *looks}:
            whose = set[int]()
        else:  # the ego's where they are its alone
            whose = {max((actor for actor, at in states if at == instant), default=-1) for instant in found}
        early = len(whose) == len(atom.left.terms) == 2 and EGO not in whose
        looked_at = {number_of(state.place) for (_, at), state in states.items() if at in looks}
        kept = any(not looked_at.isdisjoint(key) for key in keys)
        return EGO in whose, _SPARE * (early or kept), given

    def _quotients_of(self, atoms: Sequence[Atom]) -> Iterator[tuple[int, int, int]]:
        """Yield atoms that compare times, a place over a speed: their numbers, those of the place and of the speed."""
        for number, atom in enumerate(atoms):
            kinds: dict[str, int] = {}
            for key in atom.left.terms:
                for unknown in key:
                    kinds.setdefault(self.events.unknowns[unknown].kind, unknown)
            if "place" in kinds and "speed" in kinds:
                yield number, kinds["place"], kinds["speed"]


def number_of(value: Polynomial) -> int | None:
    """Return which unknown a polynomial is; None for a number."""
    return None if value.constant is not None else next(iter(value.terms))[0]


@dataclass(frozen=True, slots=True)
class Caps:
    """How fast a route may be driven (m/s) at places (m): at most, and in comfort in its bends.

    By its signs also at most, and as is natural, on the way to each lane, which begin somewhere (m).
    """

    places: Array
    most: Array
    comfortable: Array
    begin_m: tuple[float, ...]
    signed: tuple[tuple[Array, Array], ...]

    def on_the_way_to(self, place_m: float) -> tuple[Array, Array]:
        """Return how fast it may be at most by signs, and as is natural, on the way to a place."""
        return self.signed[max(bisect_right(self.begin_m, place_m) - 1, 0)]

    def at(self, s_m: Array, speeds_mps: Array) -> tuple[Array, Array]:
        """Return one of them at places, and how it changes from there (1/s)."""
        before, here, after = np.interp(np.array([s_m - _STEP_M, s_m, s_m + _STEP_M]), self.places, speeds_mps)
        return here, after - before

    def above(self, speeds_mps: Array, s_m: Array, v: Array, d_s: Array, d_v: Array) -> tuple[Array, Array]:
        """Return by how much one is faster than one of them (m/s), and the slopes of that, from those of s_m and v."""
        here, slope = self.at(s_m, speeds_mps)
        return v - here, d_v - slope[:, None] * d_s


def caps_of(route: Route, road_map: RoadMap, limits: Limits, comfortable_mpss: float) -> Caps:
    """Return how fast a route may be driven, in comfort with so much sideways."""
    places = np.arange(0.0, route.path.length_m + _STEP_M, _STEP_M)
    bends = np.abs(route.path.curvatures(places))
    around = round(_AROUND_M / _STEP_M)
    padded = np.pad(bends, around, mode="edge")
    sharpest = np.maximum(np.max([padded[k : k + len(bends)] for k in range(2 * around + 1)], axis=0), 1e-6)
    top = _OF_TOP * limits.speed_max_mps
    most, comfortable = (
        np.minimum(np.sqrt(a / sharpest), top) for a in (_OF_LATERAL * limits.lateral_max_mpss, comfortable_mpss)
    )
    # Nobody is so fast before a bend that no braking is enough: its plan may end there.
    saved = 2.0 * _OF_LATERAL * limits.brake_max_mpss * places
    most = np.minimum(most, np.sqrt(np.minimum.accumulate((most**2 + saved)[::-1])[::-1] - saved))
    signs = Signs.of(route, road_map)
    posted = (signs.up_to(count).evenly_mps(places) for count in range(1, len(signs.starts_m) + 1))
    return Caps(places, most, comfortable, signs.starts_m, tuple(map(limits.before_trigger_mps, posted)))
