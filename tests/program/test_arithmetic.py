"""Terms made of terms: worth what arithmetic says, folded only where the text form folds too."""

from __future__ import annotations

from fractions import Fraction
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.program.arithmetic import combine, just_before, negate
from scenewright.program.expressions import Arithmetic, Landmark, Negate, Number, State, Term
from scenewright.program.linear import linear
from scenewright.program.printer import print_expression
from scenewright.program.text import parse_program
from strategies import fractions, terms

STOP_LINE = Landmark("stop_line", 1)


@given(left=fractions, right=fractions, operator=st.sampled_from("+-*/"))
def test_of_two_numbers_it_is_worth_what_they_come_to(
    left: Fraction, right: Fraction, operator: Literal["+", "-", "*", "/"]
) -> None:
    term = combine(operator, Number(left), Number(right))
    if operator == "/" and right == 0:
        assert term == Arithmetic("/", Number(left), Number(right)), "which is for the checker to refuse"
        return
    by_hand = {"+": left + right, "-": left - right, "*": left * right, "/": left / (right or 1)}
    assert linear(term).constant == by_hand[operator]
    assert isinstance(term, Number) == (operator == "/")


@given(term=terms([]))
def test_twice_negated_it_is_the_same_or_prints_so(term: Term) -> None:
    once = negate(term)
    assert isinstance(once, Number if isinstance(term, Number) else Negate)
    assert negate(once) == (term if isinstance(term, Number) else Negate(once))


def test_just_before_a_place_is_five_metres_before_it() -> None:
    assert just_before(STOP_LINE) == Arithmetic("-", STOP_LINE, Number(Fraction(5)))


@pytest.mark.parametrize(
    ("term", "text"),
    [
        (combine("/", Number(Fraction(1)), Number(Fraction(3))), "1/3"),
        (combine("*", combine("+", State(1, 1, None), Number(Fraction(2))), Number(Fraction(3))), "(A1v + 2) * 3"),
        (combine("-", State(1, 0, None), combine("-", STOP_LINE, Number(Fraction(3)))), "A1x - (A1.stop_line - 3)"),
        (negate(combine("+", State(1, 0, None), STOP_LINE)), "-(A1x + A1.stop_line)"),
    ],
)
def test_the_text_has_the_same_form(term: Term, text: str) -> None:
    assert print_expression(term) == text
    head = "Actor 0:\n- W\n- [t0, go, t1]\nActor 1 (hero):\n- W\n- [t0, go, t1]\nConstraints:\n"
    formula = parse_program(f"{head}always[0, 1]({text} == 0)\n").constraints[0].formula
    assert formula.body.left == term  # type: ignore[union-attr]
