"""Bodies do not go through each other: of two between whom a distance is asked for, one is ahead by its length.

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
from scenewright.roads.conflicts import shared_stretches
from scenewright.solve.proofs.events import Events
from scenewright.solve.proofs.polynomials import Formula, Named, compare, some
from scenewright.units import format_fraction, pin

APART = "orchestrated actors keep clear of each other"
# Centres nearer than this along one lane: bodies overlap. A little less than a length, for lanes bend.
_OVERLAP_M = VEHICLE_LENGTH_M - 0.1


def apart(events: Events, structure: Structure, constraints: Sequence[Constraint]) -> list[Named]:
    """Return that those are apart of whom a distance is asked for, at each knot at which it is."""
    program, triggers = events.scene.program, structure.triggers.values()
    room_m = pin(_OVERLAP_M) + program.manner.clear_m
    return [
        Named(rule, _words(a == EGO, program.manner))
        for a, b, key in dict.fromkeys(_asked(structure, constraints))
        if not any({a, b} <= placed_at(program, trigger) for trigger in triggers)
        for rule in clear(events, a, b, events.knot(*key), room_m)
    ]


def _words(of_ego: bool, manner: Manner) -> str:
    """Say what a proof takes for granted; where there is a number of the manner in it, with that."""
    words = "the ego touches nobody before the trigger" if of_ego else APART
    return f"{words} (clear_m is {format_fraction(manner.clear_m)} m)" if manner.clear_m else words


def _asked(structure: Structure, constraints: Sequence[Constraint]) -> Iterator[tuple[int, int, KnotKey]]:
    """Yield pairs, lower number first, with the knots at which a distance between them is asked for."""
    triggers = structure.triggers.values()
    early = {*structure.starts.items()}.union(*triggers)  # no later than the last trigger
    for constraint in constraints:
        for node in ex.walk(constraint.formula):
            if not (isinstance(node, ex.Derived) and isinstance(node.target, int)):
                continue
            a, b = sorted((node.actor, node.target))
            match node.at:
                case ex.Knot(name=knot):
                    key = (node.actor, knot)
                case ex.Elapsed(actor=owner, knot=knot):
                    key = (owner, knot)
                case _:
                    continue
            yield from [(a, b, key)] if a != EGO or key in early else []


def clear(events: Events, a: int, b: int, instant: int, room_m: Fraction) -> Iterator[Formula]:
    """Yield for each stretch that two share that one of them is outside it, or ahead of the other by some room."""
    routes = events.scene.routes
    one, other = events.state(a, instant).place, events.state(b, instant).place
    for stretch in shared_stretches(routes[a], routes[b]):
        outside = []
        for actor, place, begin, end in zip((a, b), (one, other), stretch.begin, stretch.end, strict=True):
            if begin > 0.0:
                outside.append(compare("<", place, pin(begin)))
            if end < routes[actor].landmarks["route_end"]:
                outside.append(compare(">", place, pin(end)))
        ahead = (other - pin(stretch.begin[1])) - (one - pin(stretch.begin[0]))
        yield some([compare(">=", ahead, room_m), compare("<=", ahead, -room_m), *outside])
