"""cvc5 as a second opinion: answers, and that it is stopped."""

from __future__ import annotations

import time

import pytest

from posed import UNKNOWNS, X, Y, asked, named
from scenewright.algebra.polynomials import compare, some
from scenewright.errors import SolverError
from scenewright.solve.proofs import cvc5_engine
from scenewright.solve.proofs.cvc5_engine import Cvc5


def test_it_answers() -> None:
    pytest.importorskip("cvc5", reason="the extra cvc5 is not installed")
    fits = compare("==", X * X, 2)
    assert Cvc5().ask(UNKNOWNS, named(fits=fits), 5.0).kind == "met"
    formulas = named(low=compare("<=", X, 3), high=some([compare(">=", X, 4), compare(">=", X * Y, 16)]), fits=fits)
    assert Cvc5().ask(UNKNOWNS, formulas, 5.0).kind == "refuted"


def test_one_that_does_not_keep_its_time_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cvc5_engine, "_ASKS", "while True: pass")
    monkeypatch.setattr(cvc5_engine, "_START_S", 0.1)
    began = time.monotonic()
    assert asked(Cvc5(), 0.1).kind == "timeout"
    assert time.monotonic() - began < 30, "it was stopped, and not waited for"


def test_one_that_fails_is_a_fault_and_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cvc5_engine, "_ASKS", "raise ValueError('no such option')")
    with pytest.raises(SolverError, match="cvc5 failed") as caught:
        asked(Cvc5(), 5.0)
    assert caught.value.found == "ValueError: no such option"
