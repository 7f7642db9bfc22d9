"""Adds moments and places to a search where a motion that it found is no witness: never before one shows the need.

What enters: what is amiss with a motion. What leaves: more events, formulas that a plan owes, bounds in bends.
Everything added is true of every witness; what is also true of every legal motion is marked for proofs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise, product

import numpy as np

from scenewright.algebra.polynomials import ZERO, Formula, Named, compare, some
from scenewright.motion.laws import ANY, Law
from scenewright.motion.limits import ROOM, calm_mpss
from scenewright.program import expressions as ex
from scenewright.program.evaluate import moments_of_worst
from scenewright.program.manner import Manner
from scenewright.program.types import Actor, PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.conflicts import find_conflict
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.apart import clear
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.forms import asserted, free_actors
from scenewright.solve.proofs.lowering import RATE_LASTS_S, Lowering
from scenewright.solve.proofs.narrowing import Narrowing
from scenewright.solve.proofs.order import places_within
from scenewright.solve.proofs.soonest import past_bends
from scenewright.solve.proofs.witness import Array, Broken, Witness, bends
from scenewright.units import pin

SHARES = (0.985, 0.8, 0.6, 0.4, 0.2)
_SAFETY = 0.999  # rounding of places and speeds within a turn
_ROOM_M = Fraction(1, 20)
_STILL_M = Fraction(1, 1000)  # who moves no farther stands, and a search has somewhere to go
_ROLLS_ON = 10  # who still rolls may roll on: this many metres and m/s for each m/s of its speed bind nobody


@dataclass(slots=True)
class Refinement:
    """What was added to one search so far."""

    events: Events
    lowering: Lowering
    owed: list[Formula] = field(default_factory=list)
    narrowings: list[Narrowing] = field(default_factory=list)
    turning: set[tuple[int, int]] = field(default_factory=set)

    def lasting_rates(self) -> None:
        """Let every rate at a moment last for a moment."""
        events = self.events
        for (actor, instant), rate in list(self.lowering.rates.items()):
            knots = [events.knot(actor, name) for name in events.scene.program.actor(actor).sketch.knots]
            ends, now = instant == knots[-1], events.times[instant]
            lasts = events.moment(now - RATE_LASTS_S if ends else now + RATE_LASTS_S, "lasts")
            first, last = (lasts, instant) if ends else (instant, lasts)
            a, b = events.state(actor, first), events.state(actor, last)
            self.owed.append(compare("==", b.speed - a.speed, rate * RATE_LASTS_S))
            self.owed.append(compare("==", (b.place - a.place) * 2, (a.speed + b.speed) * RATE_LASTS_S))

    def manner(self) -> None:
        """Let pieces begin where they should, be plain throughout and over at their ends, and turns lie ahead."""
        for actor in self.events.scene.program.heroes:
            self._seen_pieces(actor)
        for each in self.events.scene.program.actors:
            marks = self.events.scene.landmarks_m[each.id]
            if "turn_end" in marks:  # whoever is past most of a turn shows no longer where it came from
                halfway = pin(0.5 * (marks["turn_start"] + marks["turn_end"]))
                self.owed.append(compare("<=", self.events.state(each.id, self.events.start).place, halfway))

    def _seen_pieces(self, actor: Actor) -> None:
        kept = self.events.scene.program.manner.stricter(ROOM)
        events, kinds = self.events, actor.sketch.pieces
        knots = [events.knot(actor.id, name) for name in actor.sketch.knots]
        for number, kind in enumerate(kinds):
            begins, ends = knots[number], knots[number + 1]
            if kind is PieceKind.STOP:
                self.owed.append(compare(">=", events.times[ends] - events.times[begins], kept.stands_s))
            if kind not in (PieceKind.DEC, PieceKind.ACC):
                continue
            plain = _pulling(kind, kept.begins_mpss)
            self.narrowings.append(Narrowing(actor.id, begins, ends, plain))
            if number and kinds[number - 1] is not PieceKind.STOP:
                shown = events.moment(events.times[begins] + kept.begins_s, "begins")
                settled = events.moment(events.times[begins] - kept.settled_s, "settled")
                for instant in (shown, settled):
                    events.state(actor.id, instant)
                calm = _not_pulling(kind, calm_mpss(events.scene.program.manner))
                self.narrowings.append(Narrowing(actor.id, begins, shown, plain))
                self.narrowings.append(Narrowing(actor.id, settled, begins, calm))
                self.owed.append(compare("<=", events.times[shown], events.times[ends]))
            if kinds[number + 1 : number + 2] in ((), (PieceKind.GO,)):
                self._over(actor.id, kind, ends, knots[number + 2 : number + 3], kept)

    def _over(self, actor: int, kind: PieceKind, ends: int, following: list[int], kept: Manner) -> None:
        """Let what was done in a piece be over for a while; who has come to a standstill stays there."""
        events = self.events
        lasts_s = kept.stands_s if kind is PieceKind.DEC else kept.begins_s
        over = events.moment(events.times[ends] + lasts_s, "over")
        now, then = events.state(actor, ends), events.state(actor, over)
        self.narrowings.append(Narrowing(actor, ends, over, _not_pulling(kind, ZERO)))
        self.owed += [compare("<=", events.times[over], events.times[knot]) for knot in following]
        if kind is PieceKind.DEC:
            self.owed.append(compare("<=", then.place - now.place, _STILL_M + now.speed * _ROLLS_ON))
            self.owed.append(compare("<=", then.speed, now.speed * _ROLLS_ON))

    def mend(self, broken: Sequence[Broken], witness: Witness) -> bool:
        """Add what each thing amiss asks for; False where nothing can be added."""
        world = PlanWorld(self.events.scene, witness.profiles, witness.parameters)
        program, added = self.events.scene.program, False
        for each in broken:
            match each.what:
                case "law":
                    continue  # rounding: nothing to add, another motion may be better
                case "turn":
                    self._slow_in_turn(each, witness)
                case "apart":
                    self._keep_apart(each, witness)
                case name:
                    moments = moments_of_worst(asserted(program.constraint(name).formula, program), world)
                    for node, time_s in moments:
                        self._look_at(node, time_s, witness)
                    if not moments:
                        continue
            added = True
        return added

    def _look_at(self, node: ex.Temporal, time_s: float, witness: Witness) -> None:
        """Add a moment between those that there are, at which all that a body speaks of have a state.

        Two that are compared keep to one rate between moments: what holds at two of them then hardly fails between.
        """
        actors, made = free_actors(node.body), self._between(time_s, witness)
        for actor in actors:
            self.events.state(actor, made)
            even = Narrowing(actor, *self.lowering.stretch_of(node), ANY, even=True)
            if len(actors) > 1 and even not in self.narrowings:
                self.narrowings.append(even)

    def _between(self, time_s: float, witness: Witness) -> int:
        """Return a new moment at the same share of the time between its neighbours in the motion found."""
        known = sorted(witness.times_s.items(), key=lambda item: item[1])
        before = max((item for item in known if item[1] <= time_s), key=lambda item: item[1], default=known[0])
        after = min((item for item in known if item[1] > time_s), key=lambda item: item[1], default=None)
        times = self.events.times
        if after is None:
            return self.events.moment(times[before[0]] + pin(max(0.0, time_s - before[1])), "between")
        share = Fraction(round(1000 * (time_s - before[1]) / (after[1] - before[1])), 1000)
        early, late = times[before[0]], times[after[0]]
        return self.events.moment(early + (late - early) * share, "between")

    def in_bend(self, actor: int, peak: int, *, planned: bool) -> Iterator[Named]:
        """Yield how fast each part of the bend around one place of a route may be driven, at each moment of an actor.

        For proofs the least bend of a part counts, so that every legal motion keeps to it; where it is `planned` a
        sharper one, so that what keeps to it is legal.
        """
        events, (places, sharpness) = self.events, bends(self.events.scene.routes[actor])
        most_mpss = self.events.limits[actor].lateral_max_mpss
        words = f"{events.scene.program.actor(actor).name} takes bends at {most_mpss:.3g} m/s^2 sideways at most"
        for sharper, share in pairwise((1.0, *SHARES)):
            counts = (sharper if planned else share) * float(sharpness[peak])
            if most_mpss >= counts * float(events.law_of(actor).speed_high) ** 2:
                break
            first_m, last_m = _ends(places, sharpness, peak, share)
            most = pin(math.sqrt(most_mpss / counts) * (_SAFETY if planned else 1 / _SAFETY))
            for state in (events.state(actor, instant) for instant in events.instants_of(actor)):
                elsewhere = [compare("<", state.place, first_m), compare(">", state.place, last_m)]
                yield Named(some([*elsewhere, compare("<=", state.speed, most)]), words)

    def bound_in_bend(self, actor: int, asked: Sequence[Formula]) -> None:
        """Say for proofs how fast the sharpest bend of a route can be driven, and how soon one can be past it.

        One who surely drives through it, by what is `asked`, has a moment there.
        """
        events, (places, sharpness) = self.events, bends(self.events.scene.routes[actor])
        peak = int(np.argmax(sharpness))
        within = {instant: ends for (owner, instant), ends in places_within(events, asked).items() if owner == actor}
        events.rules += past_bends(events, actor, within)
        if any(high < places[peak] < low for (_, high), (low, _) in product(within.values(), repeat=2)):
            events.at_place(actor, pin(float(places[peak])))
        events.rules += self.in_bend(actor, peak, planned=False)

    def _slow_in_turn(self, broken: Broken, witness: Witness) -> None:
        """Keep to a speed in a bend at all moments: one is where it is too fast, and one at either end."""
        places, sharpness = bends(self.events.scene.routes[broken.actor])
        here = int(np.searchsorted(places, witness.profiles[broken.actor].state(broken.time_s)[0]))
        peak = max(_around(sharpness, min(here, len(places) - 1), SHARES[-1]), key=sharpness.__getitem__)
        if (broken.actor, peak) not in self.turning:
            self.turning.add((broken.actor, peak))
            ends = (self.events.at_place(broken.actor, m) for m in _ends(places, sharpness, peak, SHARES[0]))
            self.events.order(*ends)
        self.events.state(broken.actor, self._between(broken.time_s, witness))

    # -- apart --------------------------------------------------------------------------------------------------------
    def _keep_apart(self, broken: Broken, witness: Witness) -> None:
        """Let two that touch be apart at that moment: one before the stretch that both need, or past it, or ahead."""
        events, scene, made = self.events, self.events.scene, self._between(broken.time_s, witness)
        clear_m = scene.program.manner.clear_m
        conflict = find_conflict(scene.routes[broken.other], scene.routes[broken.actor])
        if conflict is not None and conflict.kind == "crossing":
            theirs, mine = (events.state(actor, made).place for actor in (broken.other, broken.actor))
            zones = ((theirs, conflict.zone_a_m), (mine, conflict.zone_b_m))
            before = [compare("<=", place, pin(low) - clear_m) for place, (low, _) in zones]
            past = [compare(">=", place, pin(high) + clear_m) for place, (_, high) in zones]
            self.owed.append(some([*before, *past]))
        else:
            room_m = pin(VEHICLE_LENGTH_M) + clear_m + _ROOM_M
            self.owed += clear(events, broken.other, broken.actor, [made], room_m)


def _around(sharpness: Array, place: int, share: float) -> range:
    """Return the places around one at which a route bends by at least a share of what it does there."""
    softer = np.flatnonzero(sharpness < share * sharpness[place])
    begin, end = softer[softer < place].max(initial=-1) + 1, softer[softer > place].min(initial=len(sharpness))
    return range(int(begin), int(end))


def _ends(places: Array, sharpness: Array, peak: int, share: float) -> tuple[Fraction, Fraction]:
    around = _around(sharpness, peak, share)
    return pin(float(places[around[0]])), pin(float(places[around[-1]]))


def _pulling(kind: PieceKind, rate_mpss: Fraction) -> Law:
    """Return the law of who brakes or speeds up by at least a rate."""
    return replace(ANY, rate_high=-rate_mpss) if kind is PieceKind.DEC else replace(ANY, rate_low=rate_mpss)


def _not_pulling(kind: PieceKind, rate_mpss: Fraction) -> Law:
    """Return the law of who does not brake, or speed up, by more than a rate."""
    return _pulling(PieceKind.ACC if kind is PieceKind.DEC else PieceKind.DEC, -rate_mpss)
