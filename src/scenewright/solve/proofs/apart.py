"""Bodies do not go through each other: of two between whom a distance is asked for, one is and stays a length ahead.

What enters: events and constraints. What leaves: rules that every motion keeps which a judge may accept: the ego
touches nobody before the last trigger, orchestrated actors never touch each other. Contact that a trigger asks for, by
saying where both are, is not its matter.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.program.manner import Manner
from scenewright.program.structure import KnotKey, Structure, placed_at
from scenewright.program.types import EGO, Constraint
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.conflicts import Stretch, shared_stretches
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.polynomials import Formula, Named, Polynomial, compare, every, some
from scenewright.units import format_fraction, pin

APART = "orchestrated actors keep clear of each other"
# Centres nearer than this along one lane: bodies overlap. A little less than a length, for lanes bend.
_OVERLAP_M = VEHICLE_LENGTH_M - 0.1
_SIDES = ((">=", 1), ("<=", -1))


def apart(events: Events, structure: Structure, constraints: Sequence[Constraint]) -> list[Named]:
    """Return that those are apart of whom a distance is asked for, at each knot at which it is, and as at the start."""
    program, triggers = events.scene.program, structure.triggers.values()
    room_m = pin(_OVERLAP_M) + program.manner.clear_m
    return [
        Named(rule, _words(a == EGO, program.manner))
        for a, b, key in dict.fromkeys(_asked(structure, constraints))
        if not any({a, b} <= placed_at(program, trigger) for trigger in triggers)
        for rule in (
            *clear(events, a, b, events.knot(*key), room_m),
            *_in_order(events, a, b, events.knot(*key), room_m),
        )
    ]


def _words(of_ego: bool, manner: Manner) -> str:
    """Say what a proof takes for granted; where there is a number of the manner in it, with that."""
    words = "the ego touches nobody before the trigger" if of_ego else APART
    return f"{words} (clear_m is {format_fraction(manner.clear_m)} m)" if manner.clear_m else words


def _asked(structure: Structure, constraints: Sequence[Constraint]) -> Iterator[tuple[int, int, KnotKey]]:
    """Yield pairs, lower number first, with the knots at which a distance between them is asked for."""
    triggers = structure.triggers.values()
    early = {*structure.starts.items()}.union(*triggers)  # no later than the last trigger
    moments = [{*structure.starts.items()}, *structure.instants]
    for constraint in constraints:
        for node in ex.walk(constraint.formula):
            match node:
                case ex.Derived(actor=actor, target=int(other), at=ex.Knot(name=knot)):
                    key = (actor, knot)
                case ex.Derived(actor=actor, target=int(other), at=ex.Elapsed(actor=owner, knot=knot)):
                    key = (owner, knot)
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


def clear(events: Events, a: int, b: int, instant: int, room_m: Fraction) -> Iterator[Formula]:
    """Yield for each stretch that two share that one of them is outside it, or ahead of the other by some room."""
    for stretch in _shared(events, a, b):
        ahead = _ahead(events, a, b, instant, stretch)
        outside = _outside(events, a, b, instant, stretch)
        yield some([compare(">=", ahead, room_m), compare("<=", ahead, -room_m), *outside])


def _in_order(events: Events, a: int, b: int, instant: int, room_m: Fraction) -> Iterator[Formula]:
    """Yield for each stretch that whoever is ahead in it at the start stays so: nobody leaves it and comes back."""
    start = events.start
    for stretch in _shared(events, a, b) if instant != start else ():
        ahead = [_ahead(events, a, b, at, stretch) for at in (start, instant)]
        outside = [each for at in (start, instant) for each in _outside(events, a, b, at, stretch)]
        before, behind = (every([compare(sign, each, side * room_m) for each in ahead]) for sign, side in _SIDES)
        yield some([before, behind, *outside])


def _shared(events: Events, a: int, b: int) -> Sequence[Stretch]:
    return shared_stretches(events.scene.routes[a], events.scene.routes[b])


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
