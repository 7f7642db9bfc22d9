"""z3 as the engine of proofs: answers, cores, ranges."""

from __future__ import annotations

from fractions import Fraction

from scenewright.solve.proofs.events import Unknown
from scenewright.solve.proofs.polynomials import Formula, compare, some, unknown
from scenewright.solve.proofs.relaxation import Named
from scenewright.solve.proofs.z3_engine import ask, core, tightened

X, Y = unknown(0), unknown(1)
UNKNOWNS = [Unknown("x", Fraction(0), Fraction(10), "other"), Unknown("y", Fraction(-5), Fraction(5), "other")]


def named(**formulas: Formula) -> list[Named]:
    return [Named(formula, name) for name, formula in formulas.items()]


def test_values_meet_what_was_asked() -> None:
    answer = ask(UNKNOWNS, named(a=compare("==", X * X, 2), b=compare("<", Y, 0)), 5.0)
    assert answer.kind == "met"
    assert abs(answer.values[0] ** 2 - 2) < 1e-9
    assert answer.values[1] < 0


def test_refutations_name_what_clashes_and_no_more() -> None:
    formulas = named(
        low=compare("<=", X, 3),
        high=some([compare(">=", X, 4), compare(">=", X * Y, 16)]),
        else_where=compare("==", Y, 1),
    )
    assert ask(UNKNOWNS, formulas, 5.0).kind == "refuted"
    assert set(core(UNKNOWNS, formulas, 5.0)) == {"low", "high"}, "x y is at most 15"


def test_ranges_alone_may_refute() -> None:
    formulas = named(beyond=compare(">=", X, 11))
    assert ask(UNKNOWNS, formulas, 5.0).kind == "refuted"
    assert core(UNKNOWNS, formulas, 5.0) == ("beyond",)


def test_ranges_are_tightened_by_what_stands_for_itself() -> None:
    formulas = named(
        a=compare(">=", 2 * X, 3),
        b=some([compare("<=", X, 2), compare("<=", Y, 0)]),
        c=compare("==", Y, Fraction(1, 2)),
    )
    x, y = tightened(UNKNOWNS, formulas)
    assert (x.low, x.high) == (Fraction(3, 2), 10), "an alternative tightens nothing"
    assert (y.low, y.high) == (Fraction(1, 2), Fraction(1, 2))
