"""What makes one plan better than another, and what it owes: comfort, limits, manner, the ego's way.

What enters: what is asked and wanted, a hero's motion as a function of unknowns. What leaves: residuals, of which the
squares are summed, and rows that are to be at most zero; both in units of cost, with their slopes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.laws import Law
from scenewright.plan.asked import TIGHT, Asked
from scenewright.plan.shooting import Leg, Quantity, Shot
from scenewright.plan.situation import Situation
from scenewright.program.starts import TAILGATES_S
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M

Array = NDArray[np.float64]
Columns = NDArray[np.intp]

SOONEST_S = 0.02  # how soon after now a knot may come
CELL_S = 0.6  # nodes are about so far apart
_ANY = float("inf")
_STILL_MPS = 0.1  # what is as bad as a tight tolerance for one that is to stand
FIRM = 20.0  # of a price: what no motion exceeds, and how everybody begins
_UNBOUNDED = 900  # bounds of laws beyond this are none
_ROUNDING_S = 1e-6
_SENSE = {PieceKind.DEC: -1.0, PieceKind.ACC: 1.0}


class Block(NamedTuple):
    """Rows by some unknowns, all where `columns` is None; from `most` on each costs evenly more, not its square."""

    values: Array
    slopes: Array
    most: Array
    columns: Columns | None


@dataclass
class Rows:
    """Rows as they are added, all before any is read. Slopes are by all unknowns, or by those that `by` says then."""

    blocks: list[Block] = field(default_factory=list)
    by: Columns | None = None

    @cached_property
    def values(self) -> Array:
        """The values of all rows."""
        return np.concatenate([np.zeros(0), *(block.values for block in self.blocks)])

    @cached_property
    def slopes(self) -> Array:
        """The slopes of all rows, where they are all by the same unknowns."""
        return np.concatenate([block.slopes for block in self.blocks])

    @cached_property
    def most(self) -> Array:
        """From where on the cost of each row grows evenly."""
        return np.concatenate([np.zeros(0), *(block.most for block in self.blocks)])

    def add(self, value: float, slope: Array, weight: float = 1.0, most: float = _ANY) -> None:
        """Add one row."""
        self.add_all(np.array([value]), slope[None], weight, most)

    def add_all(self, values: Array, slopes: Array, weights: Array | float = 1.0, most: Array | float = _ANY) -> None:
        """Add a row for each value, with its slopes in a row."""
        each = np.broadcast_to(most, values.shape)
        self.blocks.append(Block(weights * values, np.asarray(weights)[..., None] * slopes, each, self.by))

    def beyond(self, values: Array, slopes: Array, weight: float) -> None:
        """Add what is unpleasant only where it is greater than zero."""
        over = values > 0.0
        self.add_all(values[over], slopes[over], weight)


@dataclass(slots=True)
class HeroRows:
    """Adds one hero's rows; `moments` are the times of all instants, `nodes` tell which leg begins at one."""

    asked: Asked
    now: Situation
    hero: Actor
    shot: Shot
    moments: list[Quantity]
    nodes: Mapping[int, int]
    costs: Rows
    bounds: Rows
    _laws: list[tuple[Law, float, float]] = field(init=False)
    _usual_rates: list[float] = field(init=False)

    def __post_init__(self) -> None:
        self._laws = list(self._spans())
        self._usual_rates = [self._usual_rate(number) for number in range(len(self.shot.legs))]

    def add_all(self) -> None:
        """Add everything that the hero owes or prefers."""
        self._comfort()
        self._limits()
        self._pieces()
        self._at_trigger()
        self._before_trigger()
        for span in self._laws:
            self._narrowed(*span)

    def _units(self, unknowns: Sequence[int], value: float) -> Array:
        """Return slopes that are a value at one unknown each."""
        slopes = np.zeros((len(unknowns), len(self.shot.z)))
        for row, unknown in enumerate(unknowns):
            slopes[row, unknown] = value
        return slopes

    # -- comfort ------------------------------------------------------------------------------------------------------
    def _comfort(self) -> None:
        """Add what is unpleasant: jerk, and acceleration that nobody asked for."""
        wanted, shot = self.asked.wanted, self.shot
        drive, now = self.now.heroes.get(self.hero.id), shot.legs[0].accels[:1]
        if drive is not None and now and drive.begin_s <= self.now.time_s:  # it goes on from what it does now
            rate = shot.z[now[0]] - drive.motion.state(drive.begin_s)[2]
            self.costs.add(rate, self._units(now, 1.0)[0], wanted.change_weight)
        cells, first, second = shot.driven
        counts = [len(leg.accels[1:]) for leg in shot.legs]
        usual = np.repeat(self._usual_rates, counts)
        roots = np.maximum(np.diff(shot.time)[cells], 0.02) ** 0.5
        begin, end, (one, other) = shot.z[first], shot.z[second], np.eye(len(shot.z))[[first, second]]
        self.costs.add_all(end - begin, other - one, 1.0 / (roots * wanted.jerk_mpsss))
        self.costs.add_all(0.5 * (begin + end) - usual, 0.5 * (one + other), roots / wanted.accel_mpss)

    def _usual_rate(self, number: int) -> float:
        """Return the rate of a leg that is no unpleasantness: what is usual, or what the program asks for."""
        wanted, now, leg = self.asked.wanted, self.shot.z, self.shot.legs[number]
        kind = PieceKind.ACC if self._sets_off(number) else leg.kind
        usual = {PieceKind.DEC: -wanted.braking_mpss, PieceKind.ACC: wanted.speeding_up_mpss}.get(kind, 0.0)
        for law, begin_s, end_s in self._laws:
            if begin_s - _ROUNDING_S <= leg.first.value(now) and leg.last.value(now) <= end_s + _ROUNDING_S:
                usual = min(max(usual, float(law.rate_low)), float(law.rate_high))
        return usual

    def _faint(self, number: int) -> float:
        """Return how faintly a leg is begun, as a share of what is usual: one at 0.2 m/s^2 does not begin harder."""
        return min(1.0, abs(self._usual_rates[number]) / self.asked.wanted.beginning_mpss)

    # -- limits -------------------------------------------------------------------------------------------------------
    def _limits(self) -> None:
        """Add what no motion exceeds: nobody drives backwards, or faster than road and bends allow."""
        wanted, caps, limits = self.asked.wanted, self.asked.caps[self.hero.id], self.asked.limits[self.hero.id]
        number, shot = self._trigger_leg(), self.shot
        acts = len(shot.s) if number is None else shot.first_node[number]
        free = slice(1 if self.hero.id in self.now.heroes else 0, None)  # how fast it is now nothing changes
        onto = np.arange(len(shot.s))[free] > acts  # on its way to whatever road comes next
        # Who brakes into a bend is midway between two nodes faster than the second of them alone allows there.
        s, v, d_s, d_v = (0.5 * (each[1:] + each[:-1]) for each in (shot.s, shot.v, shot.d_s, shot.d_v))
        bends = caps.at(s, caps.most)[0] < caps.most.max()
        over, slopes = caps.above(caps.most, s, v, d_s, d_v)
        self.bounds.add_all(over[bends], slopes[bends], FIRM * wanted.price)
        s, v, d_s, d_v = (each[free] for each in (shot.s, shot.v, shot.d_s, shot.d_v))
        self.bounds.add_all(-v, -d_v, FIRM * wanted.price)
        # Its last knot is on its road, unless the program asks for one at its end.
        end_m = self.asked.scene.routes[self.hero.id].landmarks["route_end"] - VEHICLE_LENGTH_M
        s_m, _, d_s_m, _ = shot.at_node(shot.first_node[-2])
        self.bounds.add(s_m - end_m, d_s_m, wanted.price / TIGHT["place"], wanted.out_of_way_most)
        self.bounds.add_all(*caps.above(caps.most, s, v, d_s, d_v), FIRM * wanted.price)
        self.costs.beyond(*caps.above(caps.comfortable, s, v, d_s, d_v), wanted.lateral_weight)
        natural, slope = caps.at(s, caps.on_the_way_to(shot.s[min(acts, len(shot.s) - 1)])[1])
        natural, slope = np.where(onto, limits.natural_speed_mps, natural), np.where(onto, 0.0, slope)
        self.costs.beyond(v - natural, d_v - slope[:, None] * d_s, wanted.over_limit_weight)

    # -- manner -------------------------------------------------------------------------------------------------------
    def _pieces(self) -> None:
        """Add what makes pieces be seen for what they are, and how long they usually last."""
        legs, price = self.shot.legs, self.asked.wanted.price
        for number, leg in enumerate(legs):
            if leg.kind is PieceKind.STOP:
                _, v, _, d_v = self.shot.at_node(self.shot.first_node[number])
                self.costs.add(v, d_v, price / _STILL_MPS)
        for number, leg in enumerate(legs[:-1]):
            begins = 1.0 if self._sets_off(number) else _SENSE.get(leg.kind)
            if number and begins is not None:  # the first has begun already
                self._begins(number, begins)
            if sense := _SENSE.get(leg.kind):
                least_mpss = self._faint(number) * self.asked.wanted.least_rate_mpss
                short = least_mpss - sense * self.shot.z[list(leg.accels)]
                # Braking that pauses is seen to begin anew; who has sped up may well go on evenly.
                pauses = price if leg.kind is PieceKind.DEC else self.asked.wanted.least_rate_price
                self.bounds.add_all(short, self._units(leg.accels, -sense), pauses)
                self._not_before(number, sense)
            self._lasting(leg, stands_next=legs[number + 1].kind is PieceKind.STOP and number + 1 < len(legs) - 1)

    def _lasting(self, leg: Leg, *, stands_next: bool) -> None:
        asked, wanted, z = self.asked, self.asked.wanted, self.shot.z
        instants = [asked.knot(self.hero.id, self.hero.sketch.knots[leg.piece + k]) for k in (0, 1)]
        first, last = (self.moments[instant] for instant in instants)
        lasts = last.value(z) - first.value(z)
        slope = last.slope(len(z)) - first.slope(len(z))
        if not np.any(slope):
            return
        firm = FIRM * wanted.price
        stands = leg.kind is PieceKind.STOP
        self.bounds.add((wanted.least_stand_s if stands else wanted.least_s) - lasts, -slope, firm)
        self.bounds.add((wanted.shortest_stand_s if stands else wanted.shortest_s) - lasts, -slope, wanted.price)
        if leg.first.unknown is None and leg.last.unknown is not None:
            self.bounds.add(self.now.time_s + SOONEST_S - last.value(z), -slope, firm)
        comes_to_stand = stands_next and leg.kind is PieceKind.DEC  # how long that takes is in how hard it brakes
        if instants[1] != asked.until(self.hero.id) and not comes_to_stand:
            usual_s = wanted.stands_s if stands else wanted.lasts_s
            self.costs.add(lasts - usual_s, slope, wanted.stands_weight if stands else wanted.lasts_weight)

    def _at_trigger(self) -> None:
        """Add that a hero drives at its trigger, and is not slower than people do."""
        wanted, shot = self.asked.wanted, self.shot
        number = self._trigger_leg()
        if number is None or number >= len(shot.legs) - 1:
            return
        begins = shot.legs[number]
        node = shot.first_node[number]
        _, v, _, d_v = shot.at_node(node)
        if node and PieceKind.STOP not in (begins.kind, shot.legs[number - 1].kind):
            caps = self.asked.caps[self.hero.id]
            natural, slope = caps.at(shot.s[node : node + 1], caps.on_the_way_to(shot.s[node])[1])
            natural, slope = wanted.natural_share * natural[0], wanted.natural_share * slope[0]
            self.costs.add(v - natural, d_v - slope * shot.d_s[node], wanted.trigger_speed_weight)
            self.bounds.add(wanted.slowest_mps - v, -d_v, wanted.slowest_price)
            if self.hero.id not in self.asked.speed_told:
                self.bounds.add(wanted.moves_mps - v, -d_v, wanted.price / TIGHT["speed"])

    def _not_before(self, number: int, sense: float) -> None:
        """Add that what begins with a leg is not plainly done before it, and hardly at all just before it."""
        wanted, shot = self.asked.wanted, self.shot
        settled_s = shot.time[shot.first_node[number]] - wanted.settled_s - _ROUNDING_S
        for before in range(number - 1, -1, -1):
            leg = shot.legs[before]
            if leg.kind is not PieceKind.GO or self._sets_off(before):
                break
            late = shot.time[shot.first_node[before] :][: leg.cells + 1] > settled_s
            most = self._faint(number) * np.where(late, wanted.settled_mpss, wanted.early_mpss)
            prices = np.where(late, wanted.price / TIGHT["rate"], wanted.early_price)
            self.bounds.add_all(sense * shot.z[list(leg.accels)] - most, self._units(leg.accels, sense), prices)

    def _begins(self, number: int, sense: float) -> None:
        """Add that a leg is visibly begun: by speeding up (1) or slowing down (-1) from its first moment on."""
        wanted, shot, node = self.asked.wanted, self.shot, self.shot.first_node[number]
        lasts = max(float(shot.time[node + 1] - shot.time[node]), 1e-3)
        first = [accel for k, accel in enumerate(shot.legs[number].accels) if (k - 1) * lasts < wanted.beginning_s]
        short, slopes = self._faint(number) * wanted.beginning_mpss - sense * shot.z[first], self._units(first, -sense)
        self.bounds.add_all(short, slopes, wanted.price / TIGHT["rate"])

    def _sets_off(self, number: int) -> bool:
        """Whether somebody drives on from a standstill in a leg."""
        kinds = [leg.kind for leg in self.shot.legs[max(0, number - 1) : number + 1]]
        return kinds == [PieceKind.STOP, PieceKind.GO]

    def _trigger_leg(self) -> int | None:
        instant = self.asked.trigger(self.hero.id)
        return None if instant is None else self.nodes.get(instant)

    # -- the ego's way ------------------------------------------------------------------------------------------------
    def _before_trigger(self) -> None:
        """Add that until its trigger a hero is not in the ego's way, and can wait for it."""
        wanted, shot, hero = self.asked.wanted, self.shot, self.hero.id
        begins_m, ends_m = self.asked.not_begun_m.get(hero, (_ANY, _ANY))
        if hero not in self.now.heroes and begins_m < shot.s[0] < ends_m:
            # Nobody begins within a junction or beyond its turn, unless the program puts it there.
            self.bounds.add(shot.s[0] - begins_m, shot.d_s[0], wanted.out_of_way_price, wanted.out_of_way_most)
        number, first = self._trigger_leg(), 1 if hero in self.now.heroes else 0
        lane = self.now.on_lane.get(hero)
        if lane is not None:
            acts = len(shot.legs) - 1 if hero in self.asked.beside else 0 if number is None else number
            if acts:
                self._apart(slice(first, shot.first_node[acts] + 1))
            if lane.behind_all_along:  # nor does it run into the ego where it just drives on behind it
                for later, leg in enumerate(shot.legs[acts:], acts):
                    if leg.kind is PieceKind.GO:
                        self._apart(slice(shot.first_node[later] + 1, shot.first_node[later + 1] + 1))
        if number is None:
            return
        last = shot.first_node[number]
        place_m, v_there, d_place, d_v_there = shot.at_node(last)
        zone_m, until_s = self.asked.zones_m.get(hero), float(shot.time[last])
        run_up_m, d_run_up = v_there**2 / (2.0 * wanted.sets_off_mpss), v_there / wanted.sets_off_mpss * d_v_there
        s_m, v, d_s, d_v = (each[first : last + 1] for each in (shot.s, shot.v, shot.d_s, shot.d_v))
        # Who is to be ahead of the ego beyond that zone drives through it first: before an ego that gives way to it, a
        # hero that waited there would wait for ever.
        through = zone_m is not None and place_m > zone_m and lane is not None and lane.ahead
        if zone_m is not None and not through:
            clear_s = until_s
            if (second_to := self.asked.second_to.get(hero)) is not None:  # nor is who comes later in the way till then
                clear_s = max(until_s, self.moments[self.asked.knot(EGO, second_to)].value(shot.z))
            out = slice(first, int(np.searchsorted(shot.time, clear_s, side="right")))
            self.bounds.add_all(shot.s[out] - zone_m, shot.d_s[out], wanted.out_of_way_price, wanted.out_of_way_most)
        caps = self.asked.caps[hero]
        most, slope = caps.at(s_m, caps.on_the_way_to(place_m)[0])
        # By the time that each node stands for: else it is cheaper the later it is, and is put off for ever.
        lasts_s, d_lasts = shot.stands_for(slice(first, last + 1))
        share = np.sqrt(lasts_s / CELL_S)
        slopes = d_v - slope[:, None] * d_s + (0.5 * (v - most) / lasts_s)[:, None] * d_lasts
        weights = share * (wanted.price / TIGHT["speed"])
        self.bounds.add_all(v - most, slopes, weights, share * wanted.over_sign_most)
        if hero in self.now.triggers_s:
            waits = until_s - shot.time[first : last + 1] > v_there / wanted.sets_off_mpss + wanted.waits_s
            beyond_m = s_m + v**2 / (2.0 * wanted.waits_mpss) + run_up_m - place_m
            slopes = d_s + (v / wanted.waits_mpss)[:, None] * d_v + d_run_up - d_place
            self.bounds.add_all(beyond_m[waits], slopes[waits], wanted.waits_price)
        if lane is not None and lane.of_distance:
            self._plainly(last, lane.side)

    def _apart(self, nodes: slice) -> None:
        """Add that a hero on the ego's lane leaves room between the two."""
        lane, shot, wanted = self.now.on_lane[self.hero.id], self.shot, self.asked.wanted
        ego = np.array([self.now.ego(time_s)[:2] for time_s in shot.time[nodes].tolist()])
        room_m = lane.side * (shot.s[nodes] + lane.offset_m - ego[:, 0]) - VEHICLE_LENGTH_M - wanted.clear_of_ego_m
        slopes = -lane.side * (shot.d_s[nodes] - ego[:, 1:] * shot.d_time[nodes])
        if not lane.ahead and nodes.start == 0:  # whoever begins behind it does not tailgate
            room_m[0] -= TAILGATES_S * shot.v[0]
            slopes[0] += TAILGATES_S * shot.d_v[0]
        self.bounds.add_all(-room_m, slopes, wanted.price / TIGHT["place"], wanted.out_of_way_most)

    def _plainly(self, node: int, side: float) -> None:
        """Add that the distance changes plainly at the trigger: else it is as good as met for a long while."""
        s_m, v, _, d_v = self.shot.at_node(node)
        ego_m, ego_mps, ego_mpss = self.now.ego(float(self.shot.time[node]))
        before_m = side * (float(self.shot.s[0]) - self.now.ego(float(self.shot.time[0]))[0])
        opens = 1.0 if side * (s_m - ego_m) > before_m else -1.0
        rate, slope = side * (v - ego_mps), side * (d_v - ego_mpss * self.shot.d_time[node])
        self.bounds.add(self.asked.wanted.plain_mps - opens * rate, -opens * slope, self.asked.wanted.plain_price)

    # -- narrower laws ------------------------------------------------------------------------------------------------
    def _spans(self) -> Iterator[tuple[Law, float, float]]:
        """Yield the narrower laws that constraints make of stretches of time, each with its begin and end (s)."""
        for each in self.asked.narrowings:
            if each.actor == self.hero.id:
                begin_s = max(self.moments[k].value(self.shot.z) for k in each.begins())
                end_s = min(self.moments[k].value(self.shot.z) for k in each.ends())
                if each.place is None or begin_s < end_s:  # else the place was passed before, or never is
                    yield each.law, begin_s, end_s

    def _narrowed(self, law: Law, begin_s: float, end_s: float) -> None:
        """Add a narrower law."""
        within, shot = list(self._within(begin_s, end_s)), self.shot
        nodes, accels = [node for node, _ in within], [accel for _, accel in within if accel is not None]
        for values, slopes, low, high, tight in (
            (shot.v[nodes], shot.d_v[nodes], float(law.speed_low), float(law.speed_high), TIGHT["speed"]),
            (shot.z[accels], self._units(accels, 1.0), float(law.rate_low), float(law.rate_high), TIGHT["rate"]),
        ):
            weight = self.asked.wanted.price / tight
            if high < _UNBOUNDED:
                self.bounds.add_all(values - high, slopes, weight)
            if low > -_UNBOUNDED:
                self.bounds.add_all(low - values, -slopes, weight)

    def _within(self, begin_s: float, end_s: float) -> Iterator[tuple[int, int | None]]:
        """Yield nodes within a stretch of time, each with the unknown of a leg's rate there, if it is its own."""
        shot = self.shot
        for number, leg in enumerate(shot.legs):
            first, behind = shot.first_node[number], shot.first_node[number + 1]
            whole = begin_s - _ROUNDING_S <= shot.time[first] and shot.time[behind] <= end_s + _ROUNDING_S
            for k in range(leg.cells + 1):
                time_s = float(shot.time[first + k])
                if begin_s - _ROUNDING_S <= time_s <= end_s + _ROUNDING_S:
                    inside = whole or begin_s + _ROUNDING_S < time_s < end_s - _ROUNDING_S
                    yield first + k, leg.accels[k] if leg.accels and inside else None
