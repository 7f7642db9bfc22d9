"""SCIP as a cross-check: answers, values, and the time that it takes."""

from __future__ import annotations

from fractions import Fraction

import pytest

from posed import UNKNOWNS, X, Y, named, violation
from scenewright.algebra.polynomials import FALSE, compare, every, some, unknown

pytest.importorskip("pyscipopt", reason="the extra scip is not installed")

from scenewright.solve.proofs.scip_engine import Scip


def test_values_meet_what_was_asked() -> None:
    either = some([every([compare(">=", X, 9), compare("==", X * Y, 36)]), compare(">=", X * X, 200)])
    formulas = named(a=either, b=compare("<", Y, 4))
    answer = Scip().ask(UNKNOWNS, formulas, 5.0)
    assert answer.kind == "met"
    assert 9 - 1e-5 <= answer.values[0] <= 10
    assert max(violation(each.formula, answer.values) for each in formulas) < 1e-4


def test_what_nothing_meets_is_found_so() -> None:
    formulas = named(low=compare("<=", X, 3), high=some([compare(">=", X, 4), compare(">=", X * Y, 16)]))
    assert Scip().ask(UNKNOWNS, formulas, 5.0).kind == "refuted"
    assert Scip().ask(UNKNOWNS, named(no=FALSE), 5.0).kind == "refuted"
    assert Scip().ask(UNKNOWNS, named(beyond=compare(">=", X, 11)), 5.0).kind == "refuted"


def test_a_choice_within_a_choice_binds_only_where_it_is_taken() -> None:
    inner = every([some([compare("==", X, 7), compare("==", X, 8)]), compare("==", Y, 0)])
    formulas = named(a=some([inner, compare("==", X, Fraction(1, 2))]), b=compare(">=", Y, 1))
    answer = Scip().ask(UNKNOWNS, formulas, 5.0)
    assert answer.values[0] == pytest.approx(0.5, abs=1e-5)


def test_a_timeout_is_an_answer() -> None:
    # A dozen points a metre apart do not fit into ten, and may be tried in any order.
    apart = [unknown(i) - unknown(j) for i in range(12) for j in range(i)]
    formulas = named(**{f"f{k}": compare(">=", each * each, 1) for k, each in enumerate(apart)})
    assert Scip().ask([UNKNOWNS[0]] * 12, formulas, 0.05).kind == "timeout"
