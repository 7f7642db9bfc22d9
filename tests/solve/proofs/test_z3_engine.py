"""z3 as the engine of proofs: answers, what clashes, and that another solver reads the same from the same text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import pytest
from planted import T, lowered
from posed import UNKNOWNS, X, Y, at_random, named, violation

from forms import FORMS
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.events import Unknown
from scenewright.solve.proofs.polynomials import Named, compare, some
from scenewright.solve.proofs.relaxation import relaxation
from scenewright.solve.proofs.smtlib import smtlib
from scenewright.solve.proofs.z3_engine import Z3


def second_opinion(unknowns: Sequence[Unknown], formulas: Sequence[Named]) -> str:
    """Return what cvc5 says; it need not answer in time."""
    cvc5 = pytest.importorskip("cvc5")
    solver = cvc5.Solver(cvc5.TermManager())
    parser = cvc5.InputParser(solver)
    text = f"(set-option :tlimit-per 2000)\n(set-logic QF_NRA)\n{smtlib(unknowns, formulas)}\n"
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, text, "question")
    while not (command := parser.nextCommand()).isNull():
        command.invoke(solver, parser.getSymbolManager())
    answer = solver.checkSat()
    return "refuted" if answer.isUnsat() else "met" if answer.isSat() else "unknown"


def test_values_meet_what_was_asked() -> None:
    answer = Z3().ask(UNKNOWNS, named(a=compare("==", X * X, 2), b=compare("<", Y, 0)), 5.0)
    assert answer.kind == "met"
    assert abs(answer.values[0] ** 2 - 2) < 1e-9
    assert answer.values[1] < 0


def test_refutations_name_what_clashes() -> None:
    formulas = named(
        low=compare("<=", X, 3),
        high=some([compare(">=", X, 4), compare(">=", X * Y, 16)]),
        else_where=compare("==", Y, 1),
    )
    assert Z3().ask(UNKNOWNS, formulas, 5.0).kind == "refuted"
    answer = Z3().ask(UNKNOWNS, formulas, 5.0, want_core=True)
    assert answer.kind == "refuted"
    assert {"low", "high"} <= set(answer.core)


def test_ranges_alone_may_refute() -> None:
    assert Z3().ask(UNKNOWNS, named(beyond=compare(">=", X, 11)), 5.0).kind == "refuted"


def test_a_limit_of_work_ends_in_unknown_and_in_no_error() -> None:
    hard = named(a=compare("==", X * X, 2), b=compare("<", Y * X, 0))
    assert Z3(1).ask(UNKNOWNS, hard, 5.0).kind == "unknown"
    assert Z3(1_000_000).ask(UNKNOWNS, hard, 5.0).kind == "met"


def test_another_solver_does_not_contradict_it() -> None:
    answers: Counter[tuple[str, str]] = Counter()
    for seed in range(25):
        unknowns, formulas = at_random(seed)
        first, second = Z3().ask(unknowns, formulas, 2.0), second_opinion(unknowns, formulas)
        answers[first.kind, second] += 1
        assert {first.kind, second} != {"met", "refuted"}, f"seed {seed}"
        assert all(violation(each.formula, first.values) < 1e-6 for each in formulas if first.values), f"seed {seed}"
    assert answers["refuted", "refuted"] > 5, "there was something to agree on"
    assert answers["met", "met"] > 5


@pytest.mark.parametrize("form", FORMS[::5], ids=lambda form: form.name)
def test_what_no_form_of_constraint_can_ask_for_another_refutes_too(form: object) -> None:
    scene = ground(parse_program(form.impossible_program()), T)  # type: ignore[attr-defined]
    events, lowering = lowered(scene)
    formulas = relaxation(events, lowering.narrowings, lowering.lower(scene.program.constraints))
    assert second_opinion(events.unknowns, formulas) == "refuted"
