"""Formulas as arrays: the same values as the polynomials have, their slopes, and of alternatives the nearest."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from posed import at_random, violation
from scenewright.algebra.compiled import Compiled
from scenewright.algebra.polynomials import Formula, atoms, compare, every, some, unknown

SEEDS = st.integers(0, 10_000)
X, Y = unknown(0), unknown(1)


def compiled(seed: int) -> tuple[Compiled, list[Formula], np.ndarray]:
    unknowns, named = at_random(seed)
    formulas = [each.formula for each in named]
    point = np.random.default_rng(seed).uniform(-6.0, 6.0, len(unknowns))
    return Compiled(formulas, len(unknowns)), formulas, np.append(point, 1.0)


@given(seed=SEEDS)
def test_values_are_those_of_the_polynomials(seed: int) -> None:
    found, formulas, point = compiled(seed)
    wanted = [atom for formula in formulas for atom in atoms(formula)]
    assert found.atoms == wanted
    assert found.values(point) == pytest.approx([atom.left.value(point) for atom in wanted])
    assert found.equal.tolist() == [atom.relation == "==" for atom in wanted]
    assert found.strict.tolist() == [atom.relation == "<" for atom in wanted]


@given(seed=SEEDS)
def test_changes_are_those_of_the_gradients(seed: int) -> None:
    found, _, point = compiled(seed)
    slopes = np.random.default_rng(seed).uniform(-2.0, 2.0, (len(point), 5))
    slopes[-1] = 0.0  # a one stays one
    assert found.along(point, slopes) == pytest.approx(found.gradients(point) @ slopes)


@given(seed=SEEDS)
def test_gradients_are_those_of_the_values(seed: int) -> None:
    found, _, point = compiled(seed)
    gradients = found.gradients(point)
    for k in range(len(point) - 1):
        before, after = point.copy(), point.copy()
        before[k] -= 1e-5
        after[k] += 1e-5
        assert gradients[:, k] == pytest.approx((found.values(after) - found.values(before)) / 2e-5, abs=1e-5)


@given(seed=SEEDS)
def test_what_is_chosen_holds_where_the_formula_does_and_is_amiss_by_as_much(seed: int) -> None:
    found, formulas, point = compiled(seed)
    assume(not any(np.isinf(violation(formula, point)) for formula in formulas))  # false whatever the values are
    values = found.values(point)
    errors = np.where(found.equal, np.abs(values), values)
    chosen = found.chosen(errors)
    assert len(chosen) == len(set(chosen))
    amiss = max((max(0.0, float(errors[k])) for k in chosen), default=0.0)
    assert amiss == pytest.approx(max((violation(formula, point) for formula in formulas), default=0.0))


def test_of_alternatives_the_one_that_is_nearest_to_holding_is_chosen() -> None:
    near = every([compare("<=", X, 1), compare("<=", Y, 2)])
    found = Compiled([compare("==", Y, 3), some([near, compare("<=", X, -9)])], 2)
    assert found.chosen(np.array([0.5, 4.0, 0.0, 5.0])) == [0, 1, 2]
    assert found.chosen(np.array([0.5, 6.0, 0.0, 5.0])) == [0, 3]


def test_a_constant_counts_at_any_point() -> None:
    found = Compiled([compare("<=", Fraction(1, 2) * X * X - 3 * Y + 4, 0)], 2)
    assert found.values(np.array([2.0, 1.0, 1.0])) == pytest.approx([3.0])
    assert found.gradients(np.array([2.0, 1.0, 1.0]))[0, :2] == pytest.approx([2.0, -3.0])


def test_nothing_at_all_is_no_comparison() -> None:
    found = Compiled([], 2)
    assert found.values(np.ones(3)).shape == (0,)
    assert found.gradients(np.ones(3)).shape == (0, 3)
    assert found.chosen(np.zeros(0)) == []
