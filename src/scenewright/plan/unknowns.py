"""The unknowns of a plan: the times of moments, where heroes begin, their accelerations; first values and bounds.

What enters: what is asked, and a `Situation`. What leaves: for values of all unknowns the motions that they stand for.
What these cost and miss is told elsewhere (see `problem`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.profile import Profile
from scenewright.plan.asked import Asked, number_of
from scenewright.plan.pairs import AFTER_S, LOOK_S, Meeting, Way, passes_s
from scenewright.plan.rows import CELL_S, SOONEST_S, Columns
from scenewright.plan.shooting import Leg, Quantity, Shot, Start, shoot
from scenewright.plan.situation import Situation
from scenewright.program.types import EGO, Actor, PieceKind

Array = NDArray[np.float64]

# Between two nodes, how many there are in a leg at most, and how far a plan looks beyond its last knot; chosen.
_MOST_CELLS, AFTER_LAST_S = 18, 3.0
LEAST_S = 0.05  # between two knots of one hero: shorter than any manner lets a piece be
_LEAST_APPROACH_S = 0.4  # before the settled end of an approach, for it to have a leg of its own; chosen
_LATEST_S, _FASTEST_MPS = 200.0, 60.0  # beyond what any run lasts (see `LONGEST_S`) and any law of motion lets drive
_BETWEEN_S = 2.0  # after one that goes first, where the other comes much later; chosen
# Of a time, a place, a speed, a rate and anything else: how far rows are good for that are taken to be linear; chosen.
_STEP_S, _STEP_M, _STEP_MPS, _STEP_MPSS, _STEP_OTHER = 0.6, 40.0, 5.0, 3.0, 4.0


@dataclass(frozen=True, slots=True)
class _Own:
    """The unknowns that one hero's motion and rows depend on; its start, its legs and all moments by these."""

    columns: Columns
    start: Start
    legs: list[Leg]
    moments: list[Quantity]


class Unknowns:
    """The unknowns of one plan: of each its first value, its bounds, and the longest step for a linear model of it."""

    def __init__(self, asked: Asked, now: Situation, meetings: Sequence[Meeting] = ()) -> None:
        self.asked, self.now = asked, now
        self._guess: list[float] = []
        self._low: list[float] = []
        self._high: list[float] = []
        self._step: list[float] = []
        self._starts: dict[int, Start] = {}
        self._legs: dict[int, list[Leg]] = {}
        self._nodes: dict[int, dict[int, int]] = {}  # by hero: which leg begins at an instant
        self.moments = [self._moment(instant) for instant in range(len(asked.times))]
        self._ego_moments = [self.moments[asked.knot(EGO, name)] for name in asked.scene.program.ego.sketch.knots]
        self._span: dict[int, range] = {}  # by hero: the unknowns that are its alone
        for hero in asked.scene.program.heroes:
            drive = now.heroes.get(hero.id)
            if drive is None or drive.piece < len(hero.sketch.pieces):  # else it only carries out what it drives
                first = len(self._guess)
                self._lay_out(hero)
                self._span[hero.id] = range(first, len(self._guess))
        self._others = self._rest()
        self._shot: tuple[Array, dict[int, Shot]] | None = None
        self._begins = [each.unknown for start in self._starts.values() for each in start if each.unknown is not None]
        self._moving = len(self._guess)  # of all unknowns that motions are by; moments between two come behind them
        self._own = {hero: self._owned(hero) for hero in self._legs}
        ends_s = [leg.last.value(self._guess) for legs in self._legs.values() for leg in legs]
        end_s = max([now.time_s, *ends_s])  # from there on everybody holds its speed: gaps change evenly
        looks = np.arange(np.ceil(now.time_s / LOOK_S), end_s / LOOK_S + 1.0) * LOOK_S
        self._looks = np.append(looks, end_s + AFTER_S)
        self._meetings = [each for meeting in meetings for each in self._open(meeting)]
        self._driven = {
            hero: Way(drive.motion).along(self._looks)
            for hero, drive in now.heroes.items()
            if self._meetings and hero not in self._legs
        }
        self.guess, self.low, self.high, self.step = map(np.array, (self._guess, self._low, self._high, self._step))

    @property
    def size(self) -> int:
        """How many unknowns there are."""
        return len(self._guess)

    # -- unknowns -----------------------------------------------------------------------------------------------------
    def _new(self, guess: float, low: float, high: float, step: float) -> int:
        self._guess.append(min(max(guess, low), high))
        self._low.append(low)
        self._high.append(high)
        self._step.append(step)
        return len(self._guess) - 1

    def _moment(self, instant: int) -> Quantity:
        constant = self.asked.events.times[instant].constant
        if constant is not None:
            return Quantity(float(constant))
        if instant in self.now.knots_s:
            return Quantity(self.now.knots_s[instant])
        guess = self.now.expected_s.get(instant, self.now.time_s + 5.0)
        soonest = [self.now.time_s + SOONEST_S if self.now.heroes else 0.0, float(self.asked.least_s[:, instant].max())]
        if any(self.asked.trigger(hero.id) == instant for hero in self.asked.scene.program.heroes):
            soonest.append(self.asked.wanted.settled_s)  # what was before the run is not seen
        return Quantity(0.0, self._new(guess, max(soonest), _LATEST_S, _STEP_S))

    def _owned(self, hero: int) -> _Own:
        """Return what a hero's motion and rows depend on: all but what is other heroes' alone."""
        asked, owners = self.asked, dict[int, set[int]]()
        for actor, instant in asked.events.states:
            owners.setdefault(instant, set()).add(actor)
        for narrowing in asked.narrowings:
            for instant in (*narrowing.begins(), *narrowing.ends()) if narrowing.actor == hero else ():
                owners.setdefault(instant, set()).add(hero)
        foreign = {unknown for other, span in self._span.items() if other != hero for unknown in span}
        foreign |= {
            moment.unknown
            for instant, moment in enumerate(self.moments)
            if moment.unknown is not None and not owners.get(instant, {EGO}) & {EGO, hero}
        }
        columns = [unknown for unknown in range(len(self._guess)) if unknown not in foreign]
        number: dict[int | None, int] = {unknown: k for k, unknown in enumerate(columns)}

        def own(each: Quantity) -> Quantity:
            return Quantity(each.constant, number.get(each.unknown))

        legs = [
            replace(leg, first=own(leg.first), last=own(leg.last), accels=tuple(number[a] for a in leg.accels))
            for leg in self._legs[hero]
        ]
        place, speed = map(own, self._starts[hero])
        return _Own(np.array(columns, dtype=np.intp), (place, speed), legs, [own(moment) for moment in self.moments])

    def _rest(self) -> dict[int, int]:
        """Make an unknown of every one that is neither a time nor a state nor a rate; return which is which."""
        asked = self.asked
        states = [value for state in asked.events.states.values() for value in (state.place, state.speed)]
        values = [*asked.events.times, *states, *asked.lowering.rates.values()]
        known, guesses = {number_of(value) for value in values}, asked.everyday | dict(self.now.others)
        return {
            number: self._new(guesses.get(number, 0.0), float(unknown.low), float(unknown.high), _STEP_OTHER)
            for number, unknown in enumerate(asked.events.unknowns)
            if number not in known
        }

    def _open(self, meeting: Meeting) -> Iterator[tuple[Meeting, int | None]]:
        """Yield a meeting, and the unknown moment between the two, if anybody is still planned for it."""
        if meeting.first not in self._legs and meeting.second not in self._legs:
            return
        first, moment = self._motion(meeting.first), None
        if meeting.zones_m is not None and first.state(self.now.time_s)[0] >= meeting.zones_m[0][1]:
            meeting = replace(meeting, zones_m=None)
        if meeting.zones_m is not None and first.state(self._looks[-1])[0] >= meeting.zones_m[0][1]:
            moment = self._new(self._between_s(meeting), self.now.time_s, _LATEST_S, _STEP_S)
        if meeting.zones_m is not None or meeting.lane_m is not None:
            yield meeting, moment

    def _between_s(self, meeting: Meeting) -> float:
        """Guess a moment midway between the first's leaving a stretch and the second's entering it."""
        assert meeting.zones_m is not None
        clear_m, first, second = self.asked.wanted.clear_m, self._motion(meeting.first), self._motion(meeting.second)
        left_s = min(passes_s(first, meeting.zones_m[0][1] + clear_m), float(self._looks[-1]))
        return 0.5 * (left_s + min(passes_s(second, meeting.zones_m[1][0] - clear_m), left_s + _BETWEEN_S))

    def _motion(self, hero: int) -> Profile:
        """Return what a hero drives or is first planned from."""
        drive = self.now.heroes.get(hero)
        return self.now.guesses[hero] if drive is None else drive.motion

    # -- legs ---------------------------------------------------------------------------------------------------------
    def _lay_out(self, hero: Actor) -> None:
        """Make a hero's legs from now on, with first guesses of what it does in them."""
        asked, pieces = self.asked, hero.sketch.pieces
        instants = [asked.knot(hero.id, name) for name in hero.sketch.knots]
        knots = [self.moments[instant] for instant in instants]
        drive = self.now.heroes.get(hero.id)
        piece, begin = (0, knots[0]) if drive is None else (drive.piece, Quantity(drive.begin_s))
        self._starts[hero.id] = self._start(hero)
        nodes, legs = self._nodes.setdefault(hero.id, {}), self._legs.setdefault(hero.id, [])
        for number in range(piece, len(pieces)):
            if drive is None or number > piece:
                nodes[instants[number]] = len(legs)
            self._add_piece(hero, number, begin if number == piece else knots[number], knots[number + 1])
        if piece < len(pieces):
            nodes[instants[-1]] = len(legs)
        last = knots[-1] if piece < len(pieces) else begin
        after = PieceKind.STOP if hero.id in asked.stand else PieceKind.GO
        self._add_leg(hero, len(pieces) - 1, after, last, Quantity(last.constant + AFTER_LAST_S, last.unknown))

    def _start(self, hero: Actor) -> Start:
        drive = self.now.heroes.get(hero.id)
        if drive is not None:
            place_m, speed_mps, _ = drive.motion.state(drive.begin_s)
            return Quantity(place_m), Quantity(speed_mps)
        place_m, speed_mps, _ = self.now.guesses[hero.id].state(0.0)
        end_m = self.asked.scene.routes[hero.id].landmarks["route_end"]
        place = self._new(place_m, 0.0, end_m, _STEP_M)
        return Quantity(0.0, place), Quantity(0.0, self._new(speed_mps, 0.0, _FASTEST_MPS, _STEP_MPS))

    def _add_piece(self, hero: Actor, number: int, first: Quantity, last: Quantity) -> None:
        """Add the legs of one piece: two where it is to be settled at its end."""
        kind, settled_s = hero.sketch.pieces[number], self.asked.wanted.settled_s
        at_trigger = self.asked.knot(hero.id, hero.sketch.knots[number + 1]) == self.asked.trigger(hero.id)
        lasts_s = last.value(self._guess) - first.value(self._guess)
        if kind is not PieceKind.GO or not at_trigger or lasts_s <= settled_s + _LEAST_APPROACH_S:
            self._add_leg(hero, number, kind, first, last)
            return
        between = Quantity(last.constant - settled_s, last.unknown)
        if last.unknown is not None and first.unknown is None:
            self._low[last.unknown] = max(self._low[last.unknown], first.constant + settled_s + LEAST_S)
        self._add_leg(hero, number, kind, first, between)
        self._add_leg(hero, number, kind, between, last, joined=True)

    def _add_leg(
        self, hero: Actor, piece: int, kind: PieceKind, first: Quantity, last: Quantity, *, joined: bool = False
    ) -> None:
        legs = self._legs[hero.id]
        if kind is PieceKind.STOP:
            legs.append(Leg(piece, kind, first, last, 1, ()))
            return
        limits, wanted = self.asked.limits[hero.id], self.asked.wanted
        low, high, guess = -limits.brake_max_mpss, limits.accel_max_mpss, 0.0
        if kind is PieceKind.DEC:
            high, guess = 0.0, -wanted.braking_mpss
        elif kind is PieceKind.ACC:
            low, guess = 0.0, wanted.speeding_up_mpss
        lasts_s = last.value(self._guess) - first.value(self._guess)
        cells = min(max(2, round(lasts_s / CELL_S)), _MOST_CELLS)
        accels = [legs[-1].accels[-1]] if joined else []
        before = self._as_planned(hero, piece, first, last)
        for k in range(len(accels), cells + 1):
            if before is not None:
                profile, begin_s, end_s = before
                inside_s = 1e-6 if k == 0 else -1e-6 if k == cells else 0.0
                guess = profile.state(begin_s + (end_s - begin_s) * k / cells + inside_s)[2]
            accels.append(self._new(guess, low, high, _STEP_MPSS))
        legs.append(Leg(piece, kind, first, last, cells, tuple(accels)))

    def _as_planned(
        self, hero: Actor, piece: int, first: Quantity, last: Quantity
    ) -> tuple[Profile, float, float] | None:
        """Return the motion in force, and when it does what a leg is to do: guesses keep to their places in pieces."""
        drive, profile = self.now.heroes.get(hero.id), self._motion(hero.id)
        if len(profile.knot_times_s) < 2:
            return None
        begin_s = 0.0 if drive is None else drive.begin_s
        old = [max(begin_s, profile.knot_times_s[name]) for name in hero.sketch.knots]
        now = [
            max(begin_s, self.moments[self.asked.knot(hero.id, name)].value(self._guess)) for name in hero.sketch.knots
        ]
        if first.value(self._guess) >= now[-1] - 1e-9:
            return (profile, old[-1], profile.end_s) if profile.end_s > old[-1] else None
        whole, lasted = now[piece + 1] - now[piece], old[piece + 1] - old[piece]
        ends = [
            old[piece] + (moment.value(self._guess) - now[piece]) / max(whole, 1e-9) * lasted
            for moment in (first, last)
        ]
        return (profile, ends[0], ends[1]) if ends[0] < ends[1] else None

    # -- values -------------------------------------------------------------------------------------------------------
    def keep_near(self, share: float) -> None:
        """Keep all unknowns within a share of their longest steps of their first values."""
        self.low = np.maximum(self.low, self.guess - share * self.step)
        self.high = np.minimum(self.high, self.guess + share * self.step)

    def others(self, z: Array) -> dict[int, float]:
        """Return the values of what is neither a time nor a state nor a rate, by its number."""
        return {number: float(z[unknown]) for number, unknown in self._others.items()}

    def parameters(self, z: Array) -> dict[str, float]:
        """Return the values of the program's parameters (SI), those that are still open among them."""
        numbers = {name: number_of(value) for name, value in self.asked.events.parameters.items()}
        known = self.asked.scene.parameters
        return {name: float(known[name]) if k is None else float(z[self._others[k]]) for name, k in numbers.items()}

    def ordered(self, z: Array) -> Array:
        """Return values within their bounds in which everybody's knots come one after another."""
        z = np.clip(z, self.low, self.high)
        for actor in self.asked.scene.program.actors:
            moments = [self.moments[self.asked.knot(actor.id, name)] for name in actor.sketch.knots]
            soonest, latest = -np.inf, np.inf
            for moment in moments:
                if moment.unknown is not None:
                    z[moment.unknown] = max(z[moment.unknown], soonest + LEAST_S - moment.constant)
                soonest = max(soonest, moment.value(z))
            for moment in reversed(moments):  # those that are known come when they do
                if moment.unknown is not None:
                    z[moment.unknown] = min(z[moment.unknown], latest - LEAST_S - moment.constant)
                latest = min(latest, moment.value(z))
        return z

    def shots(self, z: Array) -> dict[int, Shot]:
        """Return the motions of all that are still planned; slopes are by their own unknowns."""
        moved = z[: self._moving]
        if self._shot is None or not np.array_equal(self._shot[0], moved):  # they are often asked for twice
            shots = {hero: shoot(own.legs, own.start, z[own.columns]) for hero, own in self._own.items()}
            self._shot = moved.copy(), shots
        return self._shot[1]
