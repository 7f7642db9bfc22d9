"""Piecewise cubics of a file against numpy's polynomials, and where none of them holds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.roads.opendrive_records import Cubic, evaluate_cubics

numbers = st.floats(-5.0, 5.0)
cubics = st.lists(st.tuples(numbers, numbers, numbers, numbers), min_size=1, max_size=4)


@given(coefficients=cubics, places=st.lists(st.floats(0.0, 39.0), min_size=1, max_size=6))
def test_each_piece_holds_from_where_it_starts_to_the_next(
    coefficients: list[tuple[float, float, float, float]], places: list[float]
) -> None:
    pieces = tuple(Cubic(10.0 * number, *values) for number, values in enumerate(coefficients))
    for place, value in zip(places, evaluate_cubics(pieces, np.array(places)), strict=True):
        number = min(int((place + 1e-9) // 10.0), len(pieces) - 1)
        wanted = np.polynomial.Polynomial(coefficients[number])(place - 10.0 * number)
        assert value == pytest.approx(wanted, rel=1e-9, abs=1e-6)


def test_before_the_first_piece_and_without_any_it_is_zero() -> None:
    later = (Cubic(5.0, 3.0, 1.0, 0.0, 0.0),)
    assert evaluate_cubics(later, np.array([0.0, 4.9, 5.0, 7.0])).tolist() == [0.0, 0.0, 3.0, 5.0]
    assert evaluate_cubics((), np.array([1.0, 2.0])).tolist() == [0.0, 0.0]
