"""z3 as the engine of proofs: answers."""

from __future__ import annotations

from posed import UNKNOWNS, X, Y, named
from scenewright.algebra.polynomials import compare
from scenewright.solve.proofs.z3_engine import Z3


def test_values_meet_what_was_asked() -> None:
    answer = Z3().ask(UNKNOWNS, named(a=compare("==", X * X, 2), b=compare("<", Y, 0)), 5.0)
    assert answer.kind == "met"
    assert abs(answer.values[0] ** 2 - 2) < 1e-9
    assert answer.values[1] < 0


def test_ranges_alone_may_refute() -> None:
    assert Z3().ask(UNKNOWNS, named(beyond=compare(">=", X, 11)), 5.0).kind == "refuted"


def test_a_limit_of_work_ends_in_unknown_and_in_no_error() -> None:
    hard = named(a=compare("==", X * X, 2), b=compare("<", Y * X, 0))
    assert Z3(1).ask(UNKNOWNS, hard, 5.0).kind == "unknown"
    assert Z3(1_000_000).ask(UNKNOWNS, hard, 5.0).kind == "met"
