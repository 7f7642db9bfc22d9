"""Terms as sums: agree with what the terms are worth, and refuse products of quantities."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.errors import ProgramError
from scenewright.program import expressions as ex
from scenewright.program.linear import linear
from scenewright.program.text import parse_program


def term(text: str) -> ex.Term:
    actors = "Actor 0 (ego):\n- W\n- [t0, go, t1]\nActor 1 (hero):\n- E\n- [t0, go, t1]\nConstraints:\n"
    formula = parse_program(f"{actors}A0v(t0) == {text}\n").constraints[0].formula
    assert isinstance(formula, ex.Compare)
    return formula.right


def test_sums_are_gathered_and_what_cancels_is_gone() -> None:
    speed = ex.State(1, 1, ex.Knot("t1"))
    form = linear(term("2 * (A1v(t1) - 3) - -(A0v(t1) - A1v(t1)) / 2 - A0v(t1) / 2"))
    assert form.atoms == {speed: Fraction(3, 2)}
    assert form.constant == -6
    assert form.minus(form).atoms == {}
    assert form.of(ex.State) == {speed: Fraction(3, 2)}
    assert form.of(ex.Landmark) == {}


@pytest.mark.parametrize("text", ["A1v(t1) * A0v(t1)", "3 / A1v(t1)", "A1v(t1) / (2 - 2)"])
def test_products_are_no_sums(text: str) -> None:
    with pytest.raises(ProgramError, match="is no sum"):
        linear(term(text))
