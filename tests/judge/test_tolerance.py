"""Tolerances as the contract has them; errors keep their unit; logic over errors is logic over what holds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.judge.tolerance import (
    EXACT,
    LEVELS,
    LOOSE,
    TIGHT,
    Every,
    Leaf,
    Miss,
    Some,
    Sometime,
    Throughout,
    Tolerance,
    dimension_of,
    dimension_of_dividend,
    normalised,
    unit_symbol,
)
from scenewright.program.expressions import Compare
from scenewright.program.text import parse_program
from scenewright.units import Dimension

DIMENSIONS: tuple[Dimension, ...] = ("length", "time", "speed", "acceleration")


@pytest.mark.parametrize(
    ("dimension", "tight", "loose"),
    [("length", 0.5, 2.0), ("time", 0.1, 0.5), ("speed", 0.25, 1.0), ("acceleration", 0.25, 1.0), (None, EXACT, EXACT)],
)
def test_just_within_holds_and_just_beyond_does_not(dimension: Dimension | None, tight: float, loose: float) -> None:
    for tolerance, allowed in ((TIGHT, tight), (LOOSE, loose)):
        assert tolerance.of(dimension) == allowed
        assert normalised(Leaf(allowed, dimension), tolerance) <= 1.0
        assert normalised(Leaf(0.999 * allowed, dimension), tolerance) < 1.0
        assert normalised(Leaf(1.001 * allowed, dimension), tolerance) > 1.0


def test_levels_go_from_finest_to_coarsest() -> None:
    assert (LEVELS["tight"], LEVELS["loose"]) == (TIGHT, LOOSE)
    for dimension in DIMENSIONS:
        allowed = [level.of(dimension) for level in LEVELS.values()]
        assert allowed == sorted(set(allowed))


leaves = st.builds(Leaf, st.floats(0.0, 3.0) | st.sampled_from([0.0, np.inf]), st.sampled_from([*DIMENSIONS, None]))
many = st.builds(
    lambda errors, dimension: Leaf(np.array(errors), dimension),
    st.lists(st.floats(0.0, 3.0), min_size=1, max_size=4),
    st.sampled_from(DIMENSIONS),
)
misses: st.SearchStrategy[Miss] = st.recursive(
    leaves | st.builds(Throughout, many) | st.builds(Sometime, many),
    lambda inner: (
        st.builds(Every, st.lists(inner, min_size=1, max_size=3).map(tuple))
        | st.builds(Some, st.lists(inner, min_size=1, max_size=3).map(tuple))
    ),
    max_leaves=6,
)


def holds(miss: Miss, tolerance: Tolerance) -> bool:
    """Whether what was asked holds, by logic alone."""
    match miss:
        case Leaf(error=error, dimension=dimension):
            return bool(error <= tolerance.of(dimension))
        case Every(parts=parts):
            return all(holds(part, tolerance) for part in parts)
        case Some(parts=parts):
            return any(holds(part, tolerance) for part in parts)
        case Throughout(part=Leaf(error=error, dimension=dimension)):
            return all(one <= tolerance.of(dimension) for one in np.atleast_1d(error))
        case Sometime(part=Leaf(error=error, dimension=dimension)):
            return any(one <= tolerance.of(dimension) for one in np.atleast_1d(error))
    raise AssertionError(miss)


@given(miss=misses)
def test_an_error_of_one_tolerance_at_most_is_what_holds(miss: Miss) -> None:
    for tolerance in LEVELS.values():
        assert (normalised(miss, tolerance) <= 1.0) == holds(miss, tolerance)


def compare(formula: str) -> Compare:
    head = "parameters:\n- gap_m = 3\n- pace_kmph = 30\n\nActor 0 (ego):\n- E\n- [t0, go, t1]\n\n"
    head += "Actor 1 (hero):\n- E\n- [t0, dec, t1]\n\nConstraints:\n"
    parsed = parse_program(head + formula).constraints[0].formula
    assert isinstance(parsed, Compare)
    return parsed


@pytest.mark.parametrize(
    ("formula", "dimension", "symbol"),
    [
        ("A1x(t1) == 12", "length", "m"),
        ("A1v(t1) <= 12", "speed", "m/s"),
        ("12 >= A1v(t1)", "speed", "m/s"),
        ("A1a(dec) == -3", "acceleration", "m/s^2"),
        ("A1(t1) - A0(t1) == 2", "time", "s"),
        ("A0.stop_line == 3", "length", "m"),
        ("gap(A0, A1, t1) == gap_m", "length", "m"),
        ("ttc(A0, A1, t1) == 3", "time", "s"),
        ("tta(A0, stop_line, t1) == 3", "time", "s"),
        ("pace_kmph == A1v(t1)", "speed", "m/s"),
        ("-A1v(t1) == 3", "speed", "m/s"),
        ("A1x(t1) / A1v(t1) == 3", "time", "s"),
        ("A1v(t1) * 2 == 3", "speed", "m/s"),
        ("A1v(t1) * A1(t1) == 3", "length", "m"),
        ("A1v(t1) / A1(t1) == 3", "acceleration", "m/s^2"),
        ("A1v(t1) / A0v(t1) == 3", None, ""),
        ("A1v(t1) * A0v(t1) == 3", None, ""),
        ("3 == 3", None, ""),
    ],
)
def test_dimensions_are_those_of_the_quantities_compared(formula: str, dimension: str | None, symbol: str) -> None:
    found = dimension_of(compare(formula))
    assert (found, unit_symbol(found)) == (dimension, symbol)


@pytest.mark.parametrize(
    ("formula", "dimension"),
    [
        ("A1v(t1) / A0v(t1) <= 1.5", "speed"),
        ("2 >= A1x(t1) / gap_m", "length"),
        ("A1v(t1) <= 3", None),
        ("2 / 3 == A1v(t1) * 2", None),
    ],
)
def test_a_quotient_is_off_by_what_is_divided(formula: str, dimension: str | None) -> None:
    assert dimension_of_dividend(compare(formula)) == dimension
