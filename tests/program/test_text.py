"""The text form: the paper's blocks as they stand, every construct, and messages that say where and what."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest

from scenarios import EXAMPLE_TABLE, EXAMPLES, Example, example
from scenewright.errors import ProgramError, Span
from scenewright.program.expressions import (
    Arithmetic,
    Compare,
    Derived,
    Elapsed,
    Knot,
    Landmark,
    Number,
    ParameterRef,
    PieceRef,
    State,
)
from scenewright.program.printer import print_expression, print_program
from scenewright.program.text import parse_program
from scenewright.program.types import HeadingsRoute, IntentRoute, LanesRoute, Parameter, PieceKind

HEAD = "Actor 0:\n- W\n- [t0, go, t1]\nConstraints:\n"


def formula(text: str) -> object:
    (constraint,) = parse_program(f"{HEAD}{text}\n").constraints
    return constraint.formula


@pytest.mark.parametrize("case", EXAMPLE_TABLE, ids=lambda case: case.name)
def test_examples_print_and_parse_without_loss(case: Example) -> None:
    program = case.program()
    text = print_program(program)
    assert parse_program(text) == program
    assert print_program(parse_program(text)) == text


def test_the_papers_blocks_are_the_examples_word_for_word(shared_dir: Path) -> None:
    paper = (shared_dir / "paper" / "paper.tex").read_text(encoding="utf-8")
    blocks = [b.strip("\n") for b in re.findall(r"\\begin{verbatim}(.*?)\\end{verbatim}", paper, re.DOTALL)]
    programs = [block for block in blocks if block.startswith("Actor 0:")]
    files = [EXAMPLES / "lead_turns_into_driveway.scene", EXAMPLES / "hesitates_and_goes.scene"]
    assert len(programs) == len(files)
    for block, file in zip(programs, files, strict=True):
        assert block in file.read_text(encoding="utf-8")
        assert parse_program(block).constraints == parse_program(file.read_text(encoding="utf-8")).constraints


def test_what_the_papers_first_block_says() -> None:
    text = (EXAMPLES / "lead_turns_into_driveway.scene").read_text(encoding="utf-8")
    program = parse_program(text, "lead")
    ego, hero = program.actors
    assert (ego.id, ego.name, ego.route) == (0, "ego", HeadingsRoute(("W",)))
    assert (hero.id, hero.name, hero.route) == (1, "hero", HeadingsRoute(("W", "N")))
    assert hero.sketch.knots == ("t0", "t1", "t2")
    assert hero.sketch.pieces == (PieceKind.GO, PieceKind.DEC)
    assert program.name == "lead"
    assert [p.name for p in program.parameters] == [
        "ego_initial_speed_mps",
        "initial_speed_mps",
        "distance_ahead_of_ego_m",
    ]
    assert all(p.value is None for p in program.parameters)
    turn = Arithmetic("-", Landmark("turn"), Number(Fraction(100)))
    assert program.constraint("c2").formula == Compare("==", State(0, 0, Knot("t0")), turn)
    gap = Arithmetic("-", State(1, 0, Knot("t1")), State(0, 0, Knot("t1")))
    assert program.constraint("c4").formula == Compare("==", gap, ParameterRef("distance_ahead_of_ego_m"))
    assert program.constraint("c7").formula == Compare("==", Elapsed(0, "t1"), Elapsed(1, "t1"))


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("A0v(t0) == 36 km/h", "A0v(t0) == 10"),
        ("A0v(t0) == 30 mph", "A0v(t0) == 13.4112"),
        ("A0x(t0) == 100 ft", "A0x(t0) == 30.48"),
        ("A0(t1) == 2 min", "A0(t1) == 120"),
        ("A0a(go) == -1 g", "A0a(go) == -9.80665"),
        ("A0v(t0) == 1/3", "A0v(t0) == 1/3"),
        ("A0v(t0) == 2 * (1/3)", "A0v(t0) == 2 * (1/3)"),
        ("A0v(1/3 s) == 1e-2", "A0v(1/3) == 0.01"),
        ("A0x(t0) == just before stop_line", "A0x(t0) == stop_line - 5"),
        ("A0x(t0) == just before A1.turn_end", "A0x(t0) == A1.turn_end - 5"),
        ("A0x(t1) == A0.conflict_point(A2)", "A0x(t1) == A0.conflict_point(A2)"),
        ("1 < A0v(t0) <= 5", "1 < A0v(t0) and A0v(t0) <= 5"),
        ("not (A0v(t0) > 1 or A0v(t1) > 1)", "not (A0v(t0) > 1 or A0v(t1) > 1)"),
        ("A0v(t0) > 1 implies A0v(t1) > 1 implies A0v(1) > 1", "A0v(t0) > 1 implies (A0v(t1) > 1 implies A0v(1) > 1)"),
        ("A0x(A1(t1)) - 2 - 3 == 4", "A0x(A1(t1)) - 2 - 3 == 4"),
        ("A0x(t1) - (2 - 3) == 4", "A0x(t1) - (2 - 3) == 4"),
        ("A0x(t1) / 2 / 4 == 4", "A0x(t1) / 2 / 4 == 4"),
        ("-A0v(t1) * 2 == -(3)", "-A0v(t1) * 2 == -3"),
        ("tta(A1, A1.stop_line, A0(t1)) == 2", "tta(A1, A1.stop_line, A0(t1)) == 2"),
        ("eventually[A0(t0), 5](A0v < 1 and A0a < 0)", "eventually[A0(t0), 5](A0v < 1 and A0a < 0)"),
    ],
)
def test_constructs_and_their_one_form(text: str, printed: str) -> None:
    assert print_expression(formula(text)) == printed
    assert formula(printed) == formula(text)


def test_pieces_and_knots_are_told_apart_by_their_names() -> None:
    assert formula("A1a(dec2) == 0") == Compare("==", State(1, 2, PieceRef("dec2")), Number(Fraction(0)))
    assert formula("A1v(stop) == 0") == Compare("==", State(1, 1, PieceRef("stop")), Number(Fraction(0)))
    assert formula("A1v(rest) == 0") == Compare("==", State(1, 1, Knot("rest")), Number(Fraction(0)))


def test_derived_quantities() -> None:
    left = Derived("gap", 0, 1, Elapsed(1, "t1"))
    assert formula("gap(A0, A1, A1(t1)) == 12") == Compare("==", left, Number(Fraction(12)))


def test_headers_parameters_and_sources() -> None:
    text = (
        'scenario "a \\"b\\" \\\\ c"\nmap fabriksgatan\ndescription: "one\ntwo three"\n\nparameters:\n'
        "- a_m = 10 ft in [1 m, 20 m]\n- b_mps in [-1/3, 2]\n\n# a remark\n"
        "Actor 0 (av):\n- lanes 1.0.-1, 10.0.-1\n- [t0, go, t1]  # another\n\n"
        "Actor 1 (van):\n- from driveway headed S, left into road headed E\n- [t0, go, t1]\n\n"
        "Constraints:\nfirst: A0v(t0) == 5  @4..7\n\nA1v(t0) == 5\nA0x(t0) == a_m - c_m\n"
    )
    program = parse_program(text)
    assert (program.name, program.map_name, program.description) == ('a "b" \\ c', "fabriksgatan", "one\ntwo three")
    assert program.parameters == (
        Parameter("a_m", Fraction("3.048"), Fraction(1), Fraction(20)),
        Parameter("b_mps", None, Fraction(-1, 3), Fraction(2)),
        Parameter("c_m"),
    )
    assert program.ego.route == LanesRoute(("1.0.-1", "10.0.-1"))
    assert program.actor(1).route == IntentRoute("driveway", "left", "road", "S", "E")
    assert [c.id for c in program.constraints] == ["first", "c2", "c3"]
    first = program.constraint("first")
    assert first.source == Span(4, 7)
    assert program.words_of(first) == "two"
    assert parse_program(print_program(program)) == program


@pytest.mark.parametrize(
    ("route", "spec"),
    [
        ("from road, left", IntentRoute("road", "left")),
        ("from road headed W, right into driveway", IntentRoute("road", "right", "driveway", "W")),
        ("from driveway", IntentRoute("driveway")),
        ("from, straight headed E", IntentRoute(turn="straight", destination_heading="E")),
        ("from road, into driveway", IntentRoute("road", destination="driveway")),
    ],
)
def test_intents(route: str, spec: IntentRoute) -> None:
    program = parse_program(example("W", "t0, go, t1", "A0v(t0) == 1", ego_route=route))
    assert program.ego.route == spec
    assert parse_program(print_program(program)).ego.route == spec


def test_a_file_may_end_without_a_line_break_and_use_foreign_ones() -> None:
    text = example("W", "t0, go, t1", "A0v(t0) == 1")
    assert parse_program(text.rstrip("\n")) == parse_program(text)
    assert parse_program(text.replace("\n", "\r\n")) == parse_program(text)
    assert parse_program(text + "\n\n  # the end") == parse_program(text)


FAULTS = [
    ("A0v(t0) = 5", 5, 9, "'='", "one of == <= >= < >"),
    ("A0v(t0) == ", 5, 12, "the end of the line", "a number"),
    ("A0v(t0 == 5", 5, 8, "'=='", "')'"),
    ("A0v(t0) == 5 furlong", 5, 14, "'furlong'", "the end of the line"),
    ("A0v(t0) == 5 5", 5, 14, "'5'", "a unit"),
    ("gap(A0 A1, t1) == 5", 5, 8, "'A1'", "','"),
    ("always[A0(t0) A0(t1)](A0v < 5)", 5, 15, "'A0'", "','"),
    ("A0v(t0) == 5 and", 5, 17, "the end of the line", "a state such as A1x(t1)"),
    ("A0v(t0) == 5 @3", 5, 16, "the end of the line", "'..'"),
    ("A0v(t0) == 5 $", 5, 14, "'$'", None),
    ("A0x(t0) == stopline", 5, 12, "stopline", "a landmark (stop_line, "),
    ("A0x(t0) == A1.stopline", 5, 15, "stopline", "stop_line, conflict_point"),
    ("tta(A0, stopline_m, t1) == 3", 5, 9, "stopline_m", "an actor such as A1, or a landmark"),
    ("A0v(1/0) == 3", 5, 7, "1/0", None),
]


@pytest.mark.parametrize(("line", "row", "column", "found", "expected"), FAULTS, ids=[fault[0] for fault in FAULTS])
def test_a_fault_is_named_with_its_place(line: str, row: int, column: int, found: str, expected: str | None) -> None:
    with pytest.raises(ProgramError) as caught:
        parse_program(f"{HEAD}{line}\n", "fault.scene")
    error = caught.value
    assert str(error.place) == f"fault.scene:{row}:{column}"
    assert error.found == found
    assert "^" in str(error)
    if expected is not None:
        assert expected in (error.expected or "")


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        ("", "p", "empty"),
        ("  \n\n", "p", "empty"),
        ("Actor 0:\n- W\n", "p:2:4", "not a program"),
        ("Actor 0:\n- W\n- [t0, go]\n", "p:3:3", "begins and ends with a knot"),
        ("Actor 0:\n- W\n- [t0, fly, t1]\n", "p:3:8", "'fly' is not a piece"),
        ("Actor 0:\n- W\n- [t0, go, t0]\n", "p:3:3", "occurs twice"),
        ("Actor 0:\n- Q\n- [t0, go, t1]\n", "p:2:3", "not a program"),
        ("Parameters:\n- a_m = 3 s\nActor 0:\n- W\n- [t0, go, t1]\n", "p:2:3", "a_m is a length, its value is a time"),
        ("a description, not a program", "p:1:1", "not a program"),
        ('scenario "x"\n', "p:1:13", "not a program"),
    ],
)
def test_broken_frames(text: str, place: str, words: str) -> None:
    with pytest.raises(ProgramError) as caught:
        parse_program(text, "p")
    assert str(caught.value.place) == place
    assert words in caught.value.message


def test_what_could_have_stood_there_is_said_in_words() -> None:
    with pytest.raises(ProgramError) as caught:
        parse_program("a description")
    assert caught.value.expected == "'Actor 0:', 'parameters:', 'manner:', description, map, scenario"
    with pytest.raises(ProgramError) as caught:
        parse_program('scenario "x"\n')
    assert caught.value.found == "the end of the text"
