"""What is certain of the order of moments, by times and by places, and what ranges comparisons leave."""

from __future__ import annotations

from fractions import Fraction

import pytest
from test_events import events_of

from posed import UNKNOWNS, X, Y
from scenewright.algebra.polynomials import compare, every, some
from scenewright.solve.proofs.order import (
    closed,
    least_differences,
    tightened,
)


def test_what_is_certain_of_the_order() -> None:
    events = events_of()
    start, first, second = events.start, events.knot(1, "t1"), events.knot(1, "t2")
    least = least_differences(events)
    assert least[start, first] >= 0
    assert least[first, second] >= 0
    assert least[second, first] < 0
    time_1, time_2 = events.times[first], events.times[second]
    place_1, place_2 = events.state(1, first).place, events.state(1, second).place
    least = least_differences(
        events, [compare(">=", time_2 - time_1, 3), compare("==", place_1, 100), compare("==", place_2, 200)]
    )
    top = float(events.law_of(1).speed_high)
    assert least[first, second] == max(3.0, 100 / top)


def test_a_contradiction_is_not_believed() -> None:
    events = events_of()
    first, second = events.knot(1, "t1"), events.knot(1, "t2")
    told = [compare("<=", events.times[second] - events.times[first], -1)]
    assert least_differences(events, told)[second, first] < 0, "it is for a proof to find"


def test_when_a_place_is_passed_follows_from_where_somebody_is() -> None:
    events = events_of()
    first, second = events.knot(1, "t1"), events.knot(1, "t2")
    passed = events.at_place(1, Fraction(120))
    told = [compare("==", events.state(1, first).place, 100), compare("==", events.state(1, second).place, 140)]
    least, top = least_differences(events, told), float(events.law_of(1).speed_high)
    assert least[first, passed] == least[passed, second] == pytest.approx(20 / top)


def test_differences_add_up() -> None:
    least = least_differences(events_of())
    least[0, 1] = 2.0
    assert (closed(least)[:, None, :] + 1e-12 >= least[:, :, None] + least[None, :, :]).all()


def test_ranges_are_tightened_by_what_holds_in_every_case() -> None:
    formulas = [every([compare("<=", 2 * X, 6), some([compare(">=", Y, 4), compare("<=", Y, 1)])]), compare("==", Y, 2)]
    x, y = tightened(UNKNOWNS, formulas)
    assert (x.low, x.high) == (0, 3)
    assert (y.low, y.high) == (2, 2)
    x, y = tightened(UNKNOWNS, [compare("<=", X + Y, 1)])
    assert (x.high, y.high) == (6, 1)
