"""Bounds over a stretch of time narrow the law of motion there, by the number that they say."""

from __future__ import annotations

from fractions import Fraction

import pytest
from planted import EGO, T, limits_of

from scenewright.motion.laws import ANY
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.events import Events, Narrowing
from scenewright.solve.proofs.forms import asserted
from scenewright.solve.proofs.lowering import Lowering

HEAD = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- W\n- [t0, go, t1, dec, t2]\n\nConstraints:\n"


def narrowed(text: str) -> tuple[Events, list[Narrowing]]:
    scene = ground(parse_program(HEAD + "A0(t1) == A1(t1)\n" + text + "\n"), T)
    events = Events(scene, limits_of(scene), EGO)
    formula = asserted(scene.program.constraints[-1].formula, scene.program)
    return events, list(Lowering(events).narrowings_of(formula))


@pytest.mark.parametrize(
    ("body", "low", "high"),
    [
        ("A1v <= 8", None, 8),
        ("8 >= A1v", None, 8),
        ("A1v > 3", 3, None),
        ("not (A1v < 3)", 3, None),
        ("A1v == 5", 5, 5),
    ],
)
def test_speeds(body: str, low: int | None, high: int | None) -> None:
    events, (found,) = narrowed(f"always[A1(t0), A1(t2)] ({body})")
    assert (found.first, found.last) == (events.start, events.knot(1, "t2"))
    assert found.law.speed_low == (ANY.speed_low if low is None else low)
    assert found.law.speed_high == (ANY.speed_high if high is None else high)
    assert found.proven == found.law


def test_never_above_is_always_below() -> None:
    _, (found,) = narrowed("never[A1(t0), A1(t2)] (A1v > 8)")
    assert (found.law.speed_low, found.law.speed_high) == (ANY.speed_low, 8)


def test_what_is_no_bound_narrows_nothing() -> None:
    for text in ("A1v <= A0v", "A1v <= 8 or A1v >= 9", "A1x <= 100", "not (A1v == 8)"):
        assert narrowed(f"always[A1(t0), A1(t2)] ({text})")[1] == []
    assert narrowed("eventually[A1(t0), A1(t2)] (A1v <= 8)")[1] == []


def test_what_was_over_before_the_start_narrows_nothing() -> None:
    assert narrowed("always[-5, -1] (A1v >= 100)")[1] == []
    assert len(narrowed("always[-5, 1] (A1v >= 3)")[1]) == 1


def test_each_part_counts() -> None:
    _, found = narrowed("always[A1(t0), A1(t2)] (A1v <= 8 and A1v >= 2)")
    assert [(each.law.speed_low, each.law.speed_high) for each in found] == [(ANY.speed_low, 8), (2, ANY.speed_high)]


def test_a_rate_of_a_piece_is_for_plans_alone_and_even() -> None:
    _, (even, rate) = narrowed("A1a(dec) == -3")
    assert even.even
    assert rate.proven is None
    assert abs(rate.law.rate_low + 3) <= Fraction(1, 500)
    assert abs(rate.law.rate_high + 3) <= Fraction(1, 500)


@pytest.mark.parametrize("place", ["100", "200 / 2", "stop_line - stop_line + 100"])
def test_from_a_place_on(place: str) -> None:
    events, (found,) = narrowed(f"always[A1(t0), A1(t2)] (A1x >= {place} implies A1v <= 8)")
    assert found.place == events.at_place(1, Fraction(100))
    assert found.begins() == (found.first, found.place)
    _, (before,) = narrowed("always[A1(t0), A1(t2)] (A1x <= 100 implies A1v <= 8)")
    assert before.ends() == (before.last, before.place)
