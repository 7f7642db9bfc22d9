"""What is asked, as a search or a proof takes it: with more moments and places where a motion shows the need.

What enters: a question, and what is amiss with a motion. What leaves: a search, or what a refutation rests on. All
that a case adds is true of every witness; proofs are given only what is true of every legal motion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

import numpy as np

from scenewright.algebra.polynomials import ZERO, Formula, Named, Unknown, compare, some
from scenewright.motion.laws import ANY, Law
from scenewright.motion.limits import ROOM, Limits, calm_mpss
from scenewright.motion.profile import Profile
from scenewright.program import expressions as ex
from scenewright.program.evaluate import moments_of_worst
from scenewright.program.manner import Manner
from scenewright.program.structure import Structure, actors_of
from scenewright.program.types import EGO, Actor, Constraint, PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.conflicts import find_conflict
from scenewright.roads.grounding import Scene
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.apart import apart, clear
from scenewright.solve.proofs.bends import SHARES, around, bound_in_bend, ends_of_bend, in_bend
from scenewright.solve.proofs.events import EgoBounds, Events, Narrowing
from scenewright.solve.proofs.forms import asserted, free_actors
from scenewright.solve.proofs.lowering import RATE_LASTS_S, Lowering
from scenewright.solve.proofs.refuters import SOLVERS, Refuter
from scenewright.solve.proofs.relaxation import relaxation
from scenewright.solve.proofs.search import Search
from scenewright.solve.proofs.witness import Broken, Witness, bends
from scenewright.units import pin

_ROOM_M = Fraction(1, 20)
_STILL_M = Fraction(1, 1000)  # who moves no farther stands, and a search has somewhere to go
_ROLLS_ON = 10  # who still rolls may roll on: this many metres and m/s for each m/s of its speed bind nobody


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked: a scene, who is bounded how; what is freed, or how the ego drove, where that matters; of whom.

    Of those who are `bending` proofs take into account how fast their bends can be driven.
    """

    scene: Scene
    structure: Structure
    limits: Mapping[int, Limits]
    ego: EgoBounds = field(default_factory=EgoBounds)
    freed: Mapping[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    drive: Profile | None = None
    refuter: Refuter = field(default_factory=lambda: SOLVERS.called("z3"))
    bending: frozenset[int] = frozenset()

    def constraints(self) -> tuple[Constraint, ...]:
        """Return the constraints to be met; what the ego did alone is a fact, where its drive is given."""
        found = self.scene.program.constraints
        return tuple(c for c in found if self.drive is None or actors_of(c.formula) != {EGO})


class Case:
    """One scene's events and constraints, lowered, with what was added to them.

    A `plan` owes rates that last, and where it is asked for the `manner` of its program.
    """

    def __init__(self, question: Question, *, plan: bool = False, manner: bool = False) -> None:
        self.events = Events(question.scene, question.limits, question.ego, question.drive, question.freed)
        self.lowering = Lowering(self.events, Fraction(1) if question.drive else ZERO)
        self.constraints = question.constraints()
        self.owed, self.narrowings = list[Formula](), list[Narrowing]()
        self.turning = set[tuple[int, int]]()  # actors, and the places where the bends are that they take
        self._sizes = (0, 0)
        self.lower()
        self.events.rules += apart(self.events, question.structure, self.constraints)
        if plan:
            self._lasting_rates()
        for actor in question.bending:
            bound_in_bend(self.events, actor, [each.formula for each in self.lowered])
        if manner:
            self._manner()
        self.lower()

    def lower(self) -> None:
        """Lower the constraints over the moments that there are now, if there are more of them."""
        sizes = len(self.events.times), len(self.events.states)
        if sizes != self._sizes:
            self.lowered, self._sizes = self.lowering.lower(self.constraints), sizes

    def formulas(self) -> list[Formula]:
        """Return all that a plan owes."""
        bends = [each for bend in sorted(self.turning) for each in in_bend(self.events, *bend, planned=True)]
        return [*(each.formula for each in (*self.lowered, *self.events.rules, *bends)), *self.owed]

    def search(self) -> Search:
        """Return a search over what there is now."""
        return Search(self.events, self.formulas(), [*self.lowering.narrowings, *self.narrowings])

    def posed(self) -> tuple[list[Unknown], list[Named]]:
        """Return the unknowns, and what a refutation rests on."""
        return self.events.unknowns, relaxation(self.events, self.lowering.narrowings, self.lowered)

    # -- what a plan owes ---------------------------------------------------------------------------------------------
    def _lasting_rates(self) -> None:
        """Let every rate at a moment last for a moment."""
        events = self.events
        for (actor, instant), rate in list(self.lowering.rates.items()):
            knots = [events.knot(actor, name) for name in events.scene.program.actor(actor).sketch.knots]
            ends, now = instant == knots[-1], events.times[instant]
            lasts = events.moment(now - RATE_LASTS_S if ends else now + RATE_LASTS_S)
            first, last = (lasts, instant) if ends else (instant, lasts)
            a, b = events.state(actor, first), events.state(actor, last)
            self.owed.append(compare("==", b.speed - a.speed, rate * RATE_LASTS_S))
            self.owed.append(compare("==", (b.place - a.place) * 2, (a.speed + b.speed) * RATE_LASTS_S))

    def _manner(self) -> None:
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
                shown = events.moment(events.times[begins] + kept.begins_s)
                settled = events.moment(events.times[begins] - kept.settled_s)
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
        over = events.moment(events.times[ends] + lasts_s)
        now, then = events.state(actor, ends), events.state(actor, over)
        self.narrowings.append(Narrowing(actor, ends, over, _not_pulling(kind, ZERO)))
        self.owed += [compare("<=", events.times[over], events.times[knot]) for knot in following]
        if kind is PieceKind.DEC:
            self.owed.append(compare("<=", then.place - now.place, _STILL_M + now.speed * _ROLLS_ON))
            self.owed.append(compare("<=", then.speed, now.speed * _ROLLS_ON))

    # -- what a motion shows to be missing ----------------------------------------------------------------------------
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
        self.lower()
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
            return self.events.moment(times[before[0]] + pin(max(0.0, time_s - before[1])))
        share = Fraction(round(1000 * (time_s - before[1]) / (after[1] - before[1])), 1000)
        early, late = times[before[0]], times[after[0]]
        return self.events.moment(early + (late - early) * share)

    def _slow_in_turn(self, broken: Broken, witness: Witness) -> None:
        """Keep to a speed in a bend at all moments: one is where it is too fast, and one at either end."""
        events, actor = self.events, broken.actor
        places, sharpness = bends(events.scene.routes[actor])
        here = int(np.searchsorted(places, witness.profiles[actor].state(broken.time_s)[0]))
        peak = max(around(sharpness, min(here, len(places) - 1), SHARES[-1]), key=sharpness.__getitem__)
        if (actor, peak) not in self.turning:
            self.turning.add((actor, peak))
            events.order(*(events.at_place(actor, m) for m in ends_of_bend(events, actor, peak, SHARES[0])))
        events.state(actor, self._between(broken.time_s, witness))

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


def _pulling(kind: PieceKind, rate_mpss: Fraction) -> Law:
    """Return the law of who brakes or speeds up by at least a rate."""
    return replace(ANY, rate_high=-rate_mpss) if kind is PieceKind.DEC else replace(ANY, rate_low=rate_mpss)


def _not_pulling(kind: PieceKind, rate_mpss: Fraction) -> Law:
    """Return the law of who does not brake, or speed up, by more than a rate."""
    return _pulling(PieceKind.ACC if kind is PieceKind.DEC else PieceKind.DEC, -rate_mpss)
