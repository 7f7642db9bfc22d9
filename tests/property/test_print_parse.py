"""Whatever a program says, its text form says the same: printing and parsing lose nothing."""

from __future__ import annotations

from hypothesis import given, settings

from scenewright.program.expressions import Compare, Formula, Logic, Node, Temporal, walk
from scenewright.program.printer import print_expression, print_program
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from strategies import formulas, programs

HEAD = "Actor 0:\n- W\n- [t0, go, t1]\nConstraints:\n"


def parsed(text: str) -> Formula:
    (constraint,) = parse_program(f"{HEAD}{text}\n").constraints
    return constraint.formula


def parsed_alone(text: str, like: Node) -> Node:
    """Parse the text of one node; a term stands in a comparison to be read."""
    if isinstance(like, Compare | Logic | Temporal):
        return parsed(text)
    comparison = parsed(f"{text} == 0")
    assert isinstance(comparison, Compare)
    return comparison.left


@settings(max_examples=30)
@given(programs())
def test_a_program_is_what_its_text_says(program: Program) -> None:
    text = print_program(program)
    again = parse_program(text)
    assert again == program
    assert print_program(again) == text


@settings(max_examples=60)
@given(formulas(["some_length_m", "some_time_s"]))
def test_every_span_is_the_text_of_its_node(formula: Formula) -> None:
    text = HEAD + print_expression(formula) + "\n"
    (constraint,) = parse_program(text).constraints
    assert constraint.formula == formula
    for node in walk(constraint.formula):
        assert node.span is not None
        assert parsed_alone(node.span.excerpt(text), node) == node
