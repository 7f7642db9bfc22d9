"""Bodies do not go through each other: of two between whom a distance is asked for, one is and stays a length ahead.

What enters: events and constraints. What leaves: rules that every motion keeps which a judge may accept: the ego
touches nobody before the last trigger, orchestrated actors never touch each other. Contact that a trigger asks for, by
saying where both are, is not its matter.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from scenewright.algebra.polynomials import Formula, Named, Polynomial, compare, every, some
from scenewright.program import expressions as ex
from scenewright.program.structure import KnotKey, Structure, placed_at
from scenewright.program.types import EGO, Constraint
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.conflicts import Stretch, shared_stretches
from scenewright.solve.proofs.events import Events
from scenewright.units import format_fraction, pin

APART = "orchestrated actors keep clear of each other"
# Centres nearer than this along one lane: bodies overlap. A little less than a length, for lanes bend.
_OVERLAP_M = VEHICLE_LENGTH_M - 0.1
_SIDES = ((">=", 1), ("<=", -1))


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
