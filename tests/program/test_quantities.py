"""Operators on Python objects give the terms that the text form has; a condition is no truth value."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_programs import pair, survives

from scenewright.program.builder import (
    Condition,
    always,
    conflict_point,
    eventually,
    never,
    si,
    stop_line,
)
from scenewright.program.expressions import Compare, Knot, Number, State

EXPRESSIONS = [
    (lambda e, h, p: e.x("t1") - h.x("t1") == 3, "A0x(t1) - A1x(t1) == 3"),
    (lambda e, h, p: 3 == h.v("t1"), "A1v(t1) == 3"),  # noqa: SIM300
    (lambda e, h, p: 3 < h.v("t1"), "A1v(t1) > 3"),  # noqa: SIM300
    (lambda e, h, p: e.x(3.4) <= 10 - p, "A0x(3.4) <= 10 - p_m"),
    (lambda e, h, p: e.x(h.time("t2")) >= -p, "A0x(A1(t2)) >= -p_m"),
    (lambda e, h, p: e.v("t0") * 2 == h.v("t0") / 3 + 1, "A0v(t0) * 2 == A1v(t0) / 3 + 1"),
    (lambda e, h, p: e.x("t0") == (p + 1) * 2 - (3 - p), "A0x(t0) == (p_m + 1) * 2 - (3 - p_m)"),
    (lambda e, h, p: 1 / (e.v("t0") * 2) < 3 / h.v("t0"), "1 / (A0v(t0) * 2) < 3 / A1v(t0)"),
    (lambda e, h, p: e.x("t0") == p * Fraction(1, 3), "A0x(t0) == p_m * (1/3)"),
    (lambda e, h, p: e.v("t0") == si(30, "mph"), "A0v(t0) == 13.4112"),
    (lambda e, h, p: e.v("t0") == Decimal("0.1"), "A0v(t0) == 0.1"),
    (lambda e, h, p: e.v("t0") == np.float64(0.1), "A0v(t0) == 0.1"),
    (lambda e, h, p: e.v("t0") == +h.v("t0"), "A0v(t0) == A1v(t0)"),
    (lambda e, h, p: e.x("t0") == conflict_point.of(h), "A0x(t0) == A1.conflict_point"),
    (lambda e, h, p: e.x("t0") == conflict_point.of(e, h), "A0x(t0) == A0.conflict_point(A1)"),
    (lambda e, h, p: stop_line + 3 < e.x("t0"), "stop_line + 3 < A0x(t0)"),
    (lambda e, h, p: stop_line - e.x("t0") < 3, "stop_line - A0x(t0) < 3"),
    (lambda e, h, p: e.gap_to(h, "t1") == p, "gap(A0, A1, t1) == p_m"),
    (lambda e, h, p: e.freespace(h, 2) >= 5, "freespace(A0, A1, 2) >= 5"),
    (lambda e, h, p: e.ttc(h, 2) < e.headway(h, h.time("t1")), "ttc(A0, A1, 2) < headway(A0, A1, A1(t1))"),
    (lambda e, h, p: h.tta(conflict_point.of(e), "t1") == 2, "tta(A1, A0.conflict_point, t1) == 2"),
    (
        lambda e, h, p: (e.v(1) > 2) & (e.v(2) > 2) & (h.v(1) > 2) | ~(h.v(2) > 1),
        "A0v(1) > 2 and A0v(2) > 2 and A1v(1) > 2 or not A1v(2) > 1",
    ),
    (lambda e, h, p: (e.v(1) > 2).implies(h.v(1) < 3), "A0v(1) > 2 implies A1v(1) < 3"),
    (
        lambda e, h, p: always(e.time("t0"), 5, (h.v() < 3) | (h.a() < 0)),
        "always[A0(t0), 5](A1v < 3 or A1a < 0)",
    ),
    (lambda e, h, p: never(0, h.time("t1"), e.gap_to(h) < p), "never[0, A1(t1)](gap(A0, A1) < p_m)"),
    (lambda e, h, p: eventually(0, 9, e.tta(stop_line.of(e)) < 1), "eventually[0, 9](tta(A0, A0.stop_line) < 1)"),
]


@pytest.mark.parametrize(("build", "printed"), EXPRESSIONS, ids=[printed for _, printed in EXPRESSIONS])
def test_operators(build: object, printed: str) -> None:
    scene, ego, hero = pair()
    condition = build(ego, hero, scene.parameter("p_m"))
    assert str(condition) == printed
    scene.require(condition)
    survives(scene.program())


@given(st.floats(1e-9, 1e6) | st.floats(-1e6, -1e-9) | st.just(0.0))
def test_floats_are_the_decimals_that_they_print_as(value: float) -> None:
    scene, ego, _ = pair()
    scene.require(ego.v("t0") == value)
    (constraint,) = scene.program().constraints
    assert constraint.formula == Compare("==", State(0, 1, Knot("t0")), Number(Fraction(str(value))))


NOT_TRUTH_VALUES = [
    lambda e, h: 1 < e.v("t0") < 5,
    lambda e, h: e.v("t0") > 1 and h.v("t0") > 1,
    lambda e, h: not e.v("t0") > 1,
    lambda e, h: bool(e.v("t0")),
    lambda e, h: 5 if e.x("t0") == 1 else 6,
    lambda e, h: e.v("t0") in [h.v("t0")],
]


@pytest.mark.parametrize("use", NOT_TRUTH_VALUES)
def test_conditions_are_no_truth_values(use: object) -> None:
    _, ego, hero = pair()
    with pytest.raises(TypeError, match=r"truth value|neither true nor false"):
        use(ego, hero)


def test_a_chained_comparison_is_told_how_to_be_written() -> None:
    _, ego, _ = pair()
    with pytest.raises(TypeError, match=r"\(a < b\) & \(b < c\)"):
        1 < ego.v("t0") < 5  # noqa: B015


def test_conditions_and_quantities_show_what_they_say() -> None:
    _, ego, _ = pair()
    condition = ego.x("t1") == stop_line
    assert isinstance(condition, Condition)
    assert f"{condition}" == "A0x(t1) == stop_line"
    assert f"{ego.x('t1') + 1}" == "A0x(t1) + 1"
