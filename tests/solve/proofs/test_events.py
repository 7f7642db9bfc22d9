"""Moments and states: knots that are one, moments that depend on others, laws on stretches, orders that are certain."""

from __future__ import annotations

from fractions import Fraction

from planted import EGO, T, limits_of

from scenewright.algebra.polynomials import polynomial, unknown
from scenewright.program.text import parse_program
from scenewright.roads.grounding import Scene, ground
from scenewright.solve.proofs.events import EgoBounds, Events

TEXT = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2, stop, t3, go, t4]

Constraints:
A0(t1) == A1(t1)
"""


def events_of(text: str = TEXT, ego: EgoBounds = EGO) -> Events:
    scene: Scene = ground(parse_program(text), T)
    return Events(scene, limits_of(scene), ego)


def test_knots_that_are_one_moment_are_one_instant() -> None:
    events = events_of()
    assert events.knot(0, "t0") == events.knot(1, "t0") == events.start
    assert events.knot(0, "t1") == events.knot(1, "t1") != events.start
    assert events.knot(0, "t2") != events.knot(1, "t2")
    assert events.times[events.start].constant == 0


def test_a_moment_that_is_asked_for_twice_is_one() -> None:
    events = events_of()
    later = events.times[events.knot(1, "t1")] + Fraction(2)
    assert events.moment(later) == events.moment(later)
    assert events.moment(polynomial(3)) == events.moment(polynomial(3))
    assert events.moment(events.times[events.start] - 5) == events.start
    assert events.at_place(1, Fraction(100)) == events.at_place(1, Fraction(100)) != events.at_place(1, Fraction(101))


def test_laws_of_pieces() -> None:
    events = events_of()
    brakes, stands = events.pieces
    assert {each.actor for each in events.pieces} == {1}, "the ego moves freely"
    assert brakes.law.rate_high == 0 > brakes.law.rate_low
    assert stands.law.speed_high == 0
    assert brakes.last == stands.first
    held = events_of(ego=EgoBounds(holds_speed=True)).law_of(0)
    assert held.rate_low == held.rate_high == 0


def test_unknowns_have_ranges() -> None:
    events = events_of()
    end = events.scene.routes[1].landmarks["route_end"]
    place = events.unknowns[next(iter(events.state(1, events.start).place.terms))[0]]
    assert (place.kind, float(place.low)) == ("place", 0.0)
    assert abs(float(place.high) - end) < 1e-3
    assert events.new("mine", Fraction(1), Fraction(2), "other").terms == unknown(len(events.unknowns) - 1).terms
