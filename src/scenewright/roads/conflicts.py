"""Where two routes meet: cross, merge or part, and over which stretches two vehicles could touch there.

What enters: two routes on one map. What leaves: every `Conflict` of theirs, and the one that counts where one is asked
for. Time and speed play no part here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from scenewright.roads.bodies import CAR, Body
from scenewright.roads.intersections import Place, intersections
from scenewright.roads.routes import Route
from scenewright.roads.zones import Zone, touching

Kind = Literal["crossing", "merging", "following"]

_APART_M = 0.5  # lines that never get further from each other between two places meet there once
_LOOK_M = 0.5


@dataclass(frozen=True, slots=True)
class Conflict:
    """A place where two routes meet.

    Attributes
    ----------
    kind
        ``"crossing"``: the centre lines intersect. ``"merging"``: they come from different lanes; the place is where
        the two become one. ``"following"``: they drive on one lane up to the place, where they part; for routes that
        never part it is where the junction begins (without a junction, where the shorter one ends).
    s_a_m, s_b_m
        Arc lengths of the place on each route.
    zone_a_m, zone_b_m
        Arc lengths ``(low, high)`` of a vehicle's centre between which it could touch some vehicle on the other route
        around this place. On a stretch that both share vehicles can touch everywhere: there the zone reaches one
        vehicle length beyond the place, after which one simply follows the other.
    """

    kind: Kind
    s_a_m: float
    s_b_m: float
    x_m: float
    y_m: float
    zone_a_m: Zone
    zone_b_m: Zone

    def swapped(self) -> Conflict:
        """Return the same conflict seen from the other route."""
        return Conflict(self.kind, self.s_b_m, self.s_a_m, self.x_m, self.y_m, self.zone_b_m, self.zone_a_m)


@dataclass(frozen=True, slots=True)
class Stretch:
    """Lanes in a row that two routes both take: where the stretch begins and ends, ``(s_a_m, s_b_m)``.

    `together` says that both routes begin with it; `goes_on` that both leave it before they end.
    """

    begin: Place
    end: Place
    together: bool
    goes_on: bool

    def beside(self, place: Place) -> Place:
        """Return the pair of arc lengths in the stretch, at one point of the map, that is nearest along the first."""
        along_m = min(max(place[0] - self.begin[0], 0.0), self.end[0] - self.begin[0])
        return self.begin[0] + along_m, self.begin[1] + along_m


@lru_cache(maxsize=1024)
def conflicts(route_a: Route, route_b: Route, body_a: Body = CAR, body_b: Body = CAR) -> tuple[Conflict, ...]:
    """Return every place where two routes meet, those first to which the two together have the shortest way.

    Examples
    --------
    >>> from scenewright.roads import load_map, find_route
    >>> t = load_map("t_intersection")
    >>> [each.kind for each in conflicts(find_route(t, headings=("S", "E")), find_route(t, headings=("W",)))]
    ['crossing']
    """
    if route_b.lanes < route_a.lanes:  # the same numbers seen from either, whatever the search rounds to
        return tuple(conflict.swapped() for conflict in conflicts(route_b, route_a, body_b, body_a))
    stretches = shared_stretches(route_a, route_b)
    places: list[tuple[Place, Kind]] = []
    for stretch in stretches:
        if not stretch.together:
            places.append((stretch.begin, "merging"))
        if stretch.together or stretch.goes_on:
            places.append((_followed_to(route_a, route_b, stretch), "following"))
    places += [(place, "crossing") for place in _crossings(route_a, route_b, stretches)]
    places.sort(key=lambda each: sum(each[0]))
    return tuple(_conflict(route_a, route_b, kind, place, (body_a, body_b)) for place, kind in places)


def find_conflict(route_a: Route, route_b: Route) -> Conflict | None:
    """Return the conflict that counts, None where two routes never meet.

    It is the first one in a junction that both pass, its beginning and end included; else the first of all.

    Examples
    --------
    >>> from scenewright.roads import load_map, find_route
    >>> t = load_map("t_intersection")
    >>> find_conflict(find_route(t, headings=("S", "E")), find_route(t, headings=("W",))).kind
    'crossing'
    """
    found = conflicts(route_a, route_b)
    inside = (each for each in found if _in_one_junction(route_a, route_b, each))
    return next(inside, found[0] if found else None)


def shared_offset_m(route_a: Route, route_b: Route) -> float | None:
    """Return what to add to an arc length on `route_b` to compare it with one on `route_a`, on lanes that both take.

    Returns
    -------
    float or None
        0 for routes with the same first lane; None where they share no lane. Where they share several stretches it is
        that of the first.
    """
    stretches = shared_stretches(route_a, route_b)
    return stretches[0].begin[0] - stretches[0].begin[1] if stretches else None


def shared_stretches(route_a: Route, route_b: Route) -> tuple[Stretch, ...]:
    """Return the stretches of lanes that both routes take, in the order of `conflicts`."""
    same = {(i, j) for i, name in enumerate(route_a.lanes) for j, other in enumerate(route_b.lanes) if name == other}
    found = []
    for i, j in same:
        if (i - 1, j - 1) not in same:
            count = 1
            while (i + count, j + count) in same:
                count += 1
            stretch = _stretch(route_a, route_b, i, j, count)
            if stretch is not None:
                found.append(stretch)
    return tuple(sorted(found, key=lambda stretch: sum(stretch.begin)))


def _stretch(route_a: Route, route_b: Route, i: int, j: int, count: int) -> Stretch | None:
    start_a, start_b = route_a.lane_starts_m[i], route_b.lane_starts_m[j]
    # On a closed road a route may begin and end within a lane: what it does not drive there is not shared.
    skipped_m = max(0.0, -start_a, -start_b)
    ends = [
        route.lane_starts_m[k] if k < len(route.lanes) else route.path.length_m
        for route, k in ((route_a, i + count), (route_b, j + count))
    ]
    excess_m = (ends[0] - start_a) - (ends[1] - start_b)
    if abs(excess_m) > _APART_M:
        ends = [ends[0] - max(0.0, excess_m), ends[1] + min(0.0, excess_m)]
    begin = (start_a + skipped_m, start_b + skipped_m)
    if ends[0] <= begin[0] or ends[1] <= begin[1]:
        return None
    goes_on = i + count < len(route_a.lanes) and j + count < len(route_b.lanes)
    return Stretch(begin, (ends[0], ends[1]), together=begin == (0.0, 0.0), goes_on=goes_on)


def _followed_to(route_a: Route, route_b: Route, stretch: Stretch) -> Place:
    if route_a.lanes != route_b.lanes:
        return stretch.end
    s_m = route_a.landmarks.get("junction_start", route_a.path.length_m)
    return s_m, s_m


def _crossings(route_a: Route, route_b: Route, stretches: tuple[Stretch, ...]) -> list[Place]:
    """Return the intersections of the lines that are not part of a shared stretch, nor of one another."""
    if route_a.lanes == route_b.lanes:
        return []
    kept: list[Place] = []
    for place in intersections(route_a.path, route_b.path):
        known = [*(stretch.beside(place) for stretch in stretches), *kept[-1:]]
        if not any(_one_meeting(route_a, route_b, place, other) for other in known):
            kept.append(place)
    return kept


def _one_meeting(route_a: Route, route_b: Route, one: Place, other: Place) -> bool:
    """Whether the lines stay beside each other all the way between two places where they meet."""
    along_m = max(abs(one[0] - other[0]), abs(one[1] - other[1]))
    if along_m <= _APART_M:
        return True
    share = np.linspace(0.0, 1.0, 2 + int(along_m / _LOOK_M))[:, None]
    for step in range(0, len(share), 64):  # most leave each other at once
        between = np.asarray(one) + share[step : step + 64] * (np.asarray(other) - np.asarray(one))
        gaps = route_a.path.poses(between[:, 0])[:, :2] - route_b.path.poses(between[:, 1])[:, :2]
        if np.max(np.hypot(gaps[:, 0], gaps[:, 1])) > _APART_M:
            return False
    return True


def _conflict(route_a: Route, route_b: Route, kind: Kind, place: Place, bodies: tuple[Body, Body]) -> Conflict:
    x_m, y_m, _ = route_a.path.pose(place[0])
    paths, length_m = (route_a.path, route_b.path), 0.5 * (bodies[0].length_m + bodies[1].length_m)
    back_m = length_m if kind == "following" else np.inf
    ahead_m = length_m if kind == "merging" or route_a.lanes == route_b.lanes else np.inf
    zone_a, zone_b = touching(paths, place, bodies, back_m=back_m, ahead_m=ahead_m)
    return Conflict(kind, *place, x_m, y_m, zone_a, zone_b)


def _in_one_junction(route_a: Route, route_b: Route, conflict: Conflict) -> bool:
    if route_a.junction_id is None or route_a.junction_id != route_b.junction_id:
        return False
    return all(
        route.landmarks["junction_start"] <= s_m <= route.landmarks["junction_end"]
        for route, s_m in ((route_a, conflict.s_a_m), (route_b, conflict.s_b_m))
    )
