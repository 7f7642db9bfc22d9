"""The scenario as data: names of pieces, ranges of parameters, look-ups that fail by name."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings

from scenewright.errors import Span
from scenewright.program.expressions import Compare, Knot, Number, State
from scenewright.program.types import (
    EGO,
    Actor,
    Constraint,
    HeadingsRoute,
    Parameter,
    PieceKind,
    Program,
    Sketch,
)
from strategies import programs, sketches

GO, DEC, STOP = PieceKind.GO, PieceKind.DEC, PieceKind.STOP
WAITS = Sketch(("t0", "t1", "t2", "t3", "t4"), (GO, DEC, STOP, GO))


def test_pieces_of_a_kind_that_comes_again_are_numbered() -> None:
    assert WAITS.piece_names() == ("go1", "dec", "stop", "go2")
    asked = ("go", "go1", "go2", "dec", "stop")
    assert [WAITS.piece_index(name) for name in asked] == [0, 0, 3, 1, 2]
    for name in ("acc", "go3", "dec1", "t1"):
        with pytest.raises(KeyError):
            WAITS.piece_index(name)


@given(sketch=sketches())
def test_every_piece_and_knot_has_a_name_of_its_own(sketch: Sketch) -> None:
    names = sketch.piece_names()
    assert [sketch.piece_index(name) for name in names] == list(range(len(sketch.pieces)))
    assert [sketch.knot_index(name) for name in sketch.knots] == list(range(len(sketch.knots)))
    with pytest.raises(KeyError):
        sketch.knot_index("".join(sketch.knots) + "x")


@pytest.mark.parametrize(("knots", "pieces"), [(("t0",), (GO,)), (("t0", "t1"), ()), (("t0", "t1", "t2"), (GO,))])
def test_a_sketch_has_one_knot_more_than_pieces(knots: tuple[str, ...], pieces: tuple[PieceKind, ...]) -> None:
    with pytest.raises(ValueError, match="one knot more"):
        Sketch(knots, pieces)


@pytest.mark.parametrize(
    ("parameter", "low", "high"),
    [
        (Parameter("gap_m"), 0, 1000),
        (Parameter("gap_ft"), 0, 1000 / Fraction("0.3048")),
        (Parameter("gap_m", low=Fraction(5)), 5, 1000),
        (Parameter("gap_m", low=Fraction(5), high=Fraction(9)), 5, 9),
    ],
)
def test_the_range_of_a_parameter_is_in_its_own_unit(parameter: Parameter, low: int, high: Fraction | int) -> None:
    assert parameter.bounds() == (low, high)


def test_a_parameter_without_a_unit_has_none() -> None:
    with pytest.raises(KeyError):
        _ = Parameter("speed").unit


@settings(max_examples=8)
@given(program=programs())
def test_what_is_looked_up_by_name_is_what_bears_it(program: Program) -> None:
    assert program.ego is program.actors[EGO]
    assert program.heroes == program.actors[1:]
    assert [program.actor(actor.id) for actor in program.actors] == list(program.actors)
    for constraint in program.constraints:
        assert program.constraint(constraint.id).id == constraint.id
    with pytest.raises(KeyError):
        program.actor(99)
    with pytest.raises(KeyError):
        program.constraint("no such name")


def test_words_are_those_that_a_constraint_points_at() -> None:
    formula = Compare("==", State(0, 1, Knot("t0")), Number(Fraction(1)))
    told, untold = Constraint("c1", formula, Span(4, 16)), Constraint("c2", formula)
    actors = (Actor(0, "ego", HeadingsRoute(("E",)), Sketch(("t0",), ())),)
    program = Program("p", actors, (told, untold), description="The hero\n  stops there")
    assert (program.words_of(told), program.words_of(untold)) == ("hero stops", None), "on one line"
    assert Program("p", actors, (told,)).words_of(told) is None
