"""Nodes of a program: walked in their order, named by where they stand, equal by meaning."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import pytest
from hypothesis import given, settings
from small_programs import formula as parsed

from scenewright.program.expressions import (
    Compare,
    Formula,
    Node,
    Number,
    PieceRef,
    State,
    at_each_moment,
    children,
    exchanged,
    node_ids,
    piece_of,
    walk,
)
from scenewright.program.printer import print_expression
from strategies import formulas


@settings(max_examples=60)
@given(formulas(["some_length_m"]))
def test_ids_of_nodes_are_unique_and_survive_printing(formula: Formula) -> None:
    ids = [node_id for node_id, _ in node_ids("c1", formula)]
    assert len(set(ids)) == len(ids)
    assert [node_id for node_id, _ in node_ids("c1", parsed(print_expression(formula)))] == ids


TREE = (
    "always[0, A1(t1)](A1x <= A0.stop_line - 3 and not tta(A0, conflict_point, A1(t0)) >= -some_length_m) "
    "implies gap(A0, A1, A1(t1)) == A1v(2)"
)


def test_a_walk_goes_through_everything_from_left_to_right() -> None:
    words = [print_expression(node) for node in walk(parsed(TREE)) if not children(node)]
    assert words == [
        "0", "A1(t1)", "A1x", "A0.stop_line", "3", "conflict_point", "A1(t0)", "some_length_m", "A1(t1)", "A1v(2)",
    ]  # fmt: skip


@settings(max_examples=40)
@given(formulas(["some_length_m"]))
def test_a_walk_is_each_node_and_then_its_children(formula: Formula) -> None:
    def recursive(node: Node) -> Iterator[Node]:
        yield node
        for child in children(node):
            yield from recursive(child)

    assert list(walk(formula)) == list(recursive(formula)) == [node for _, node in node_ids("c", formula)]


def test_nodes_are_equal_by_meaning_wherever_they_stood() -> None:
    (one, other) = (parsed("A1x(t1) == 3 km"), parsed("  A1x( t1 ) == 3000"))
    assert one == other
    assert hash(one) == hash(other)
    assert one.span != other.span


@pytest.mark.parametrize(
    ("formula", "piece"),
    [
        ("A1a(dec) == -3", "A1a(dec)"),
        ("3 <= A1v(go2) + 1", "A1v(go2)"),
        ("A1v(t1) == 3", None),
        ("A1a(dec) == -3 and A1v(t1) == 2", None),  # of a comparison alone
    ],
)
def test_the_state_that_is_asked_of_a_whole_piece(formula: str, piece: str | None) -> None:
    found = piece_of(parsed(formula))
    assert (found and print_expression(found)) == piece


def test_one_state_is_exchanged_wherever_it_stands_and_no_other() -> None:
    formula = parsed("A1v(dec) * 2 - A0v(t1) <= -A1v(dec)")
    assert isinstance(formula, Compare)
    changed = at_each_moment(formula, State(1, 1, PieceRef("dec")))
    assert print_expression(changed) == "A1v * 2 - A0v(t1) <= -A1v"
    assert at_each_moment(formula, State(1, 1, PieceRef("go"))) == formula


def test_the_very_term_is_exchanged_in_whatever_it_stands() -> None:
    formula = parsed("not (A1v(t1) == 3) and always[A1(t0), A1(t2)] (-A1x <= 3 - A0x)")
    numbers = [node for node in walk(formula) if isinstance(node, Number)]
    changed = [exchanged(formula, lambda node, old=old: node is old, Number(Fraction(5))) for old in numbers]
    assert [print_expression(each) for each in changed] == [
        "not A1v(t1) == 5 and always[A1(t0), A1(t2)](-A1x <= 3 - A0x)",
        "not A1v(t1) == 3 and always[A1(t0), A1(t2)](-A1x <= 5 - A0x)",
    ]
