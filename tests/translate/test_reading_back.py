"""Reading back: every constraint is in the English, with its numbers and places, and nothing else is."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings

from scenewright.program.expressions import Number, ParameterRef, walk
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.study.benchmark import benchmark_rows
from scenewright.translate.reading_back import read_back
from scenewright.translate.wording import amount

# `strategies` is shared by several folders of tests; import mode `importlib` puts none on the path.
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from strategies import programs

MAP = load_map("t_intersection")
BODY = """Actor 0 (ego):
- E, N
- [t0, go, t1, go, t2]

Actor 1 (truck):
- W
- [t0, go, t1, dec, t2, stop, t3, acc, t4]

Constraints:
"""


def told(*constraints: str) -> str:
    program = parse_program(BODY + "\n".join(constraints) + "\n")
    return " ".join(read_back(program, ground(program, MAP)))


@pytest.mark.parametrize(
    ("constraint", "words"),
    [
        ("A0x(t0) == intersection - 40", "At the start the ego is 40 m before the intersection."),
        ("A0x(t0) == stop_line", "At the start the ego is at its stop line."),
        ("A0x(t0) <= stop_line - 40 ft", "the ego is at least 12.192 m before its stop line"),
        ("A0x(t0) >= stop_line - 40", "the ego is at most 40 m before its stop line"),
        ("A0x(t0) < turn_end + gap_m", "the ego is less than gap_m past the end of its turn"),
        ("A0x(t0) > stop_line", "the ego is past its stop line"),
        ("stop_line - 3 == A0x(t0)", "the ego is 3 m before its stop line"),
        ("A0x(t0) == just before stop_line - gap_m", "the ego is 5 m and gap_m before its stop line"),
        ("A0v(t0) == 30 mph", "the ego drives at 13.4112 m/s"),
        ("A0v(t0) == 0", "the ego stands still"),
        ("A0v(t0) >= 3", "the ego has a speed of at least 3 m/s"),
        ("A0v(t0) == 1/3", "the ego drives at about 0.3333 m/s"),
        ("A0v(t0) == A1v(t0)", "the ego drives at the speed of the truck"),
        ("tta(A0, stop_line, t0) == 4", "the ego is 4 s from its stop line (distance over speed)"),
        ("A1a(dec) == -3", "then slows down at 3 m/s^2"),
        ("A1a(dec) == -rate_mpss", "then slows down at rate_mpss"),
        ("A1a(dec) == 3", "slows down (the truck has an acceleration of 3 m/s^2 (A1a(dec) == 3))"),
        ("A1a(acc) <= 2", "speeds up (the truck has an acceleration of at most 2 m/s^2"),
        ("A1(t3) - A1(t2) == 3", "stands still for 3 s"),
        ("A1v(t2) == 0", "slows down until it stands still"),
        ("A1(t4) < A0(t2)", "The truck reaches its t4 before the ego reaches its t2."),
        ("A1(t3) > A0(t2)", "The truck begins to speed up only after the ego reaches its t2."),
        (
            "A0x(t2) == conflict_point or A0v(t2) >= 2",
            "either the ego is at the conflict point or the ego has a speed of",
        ),
        ("not A0v(t2) >= 2", "it is not so that the ego has a speed of at least 2 m/s"),
        ("A0v(t2) >= 2 implies A1v(t2) >= 2", "if the ego has a speed of at least 2 m/s, then the truck has"),
        (
            "always[A1(t1), A1(t2)](A1v <= 8)",
            "at every moment from the truck's t1 to the truck's t2 the truck has a speed",
        ),
        ("never[0, 3.5](A1v > 8)", "at no moment from 0 s to 3.5 s the truck has a speed of more than 8 m/s"),
        ("A1x(t2) * 2 == 30", "'A1x(t2) * 2 == 30' holds"),
    ],
)
def test_constraint_in_words(constraint: str, words: str) -> None:
    assert words in told(constraint)


def test_vehicles_behind_each_other() -> None:
    body = BODY.replace("- E, N", "- W")
    for constraint, words in {
        "gap(A0, A1, t1) == 20": "the truck is 20 m ahead of the ego",
        "gap(A1, A0, t1) <= 20": "the ego is at most 20 m ahead of the truck",
        "headway(A0, A1, t1) == 2": "the ego is 2 s behind the truck "
        "(what lies between the bodies, over its own speed)",
        "ttc(A0, A1, t1) == 2": "the time to collision of the ego with the truck is 2 s",
    }.items():
        program = parse_program(f"{body}A0(t1) == A1(t1)\n{constraint}\n")
        assert f"The moment that counts: {words}." in read_back(program)


def test_place_on_the_route_of_another() -> None:
    program = parse_program(BODY.replace("- E, N", "- W") + "A0x(t0) == A1.stop_line - 1\n")
    assert "the ego is 1 m before the truck's stop line" in " ".join(read_back(program, ground(program, MAP)))


def test_moment_a_while_after_another() -> None:
    text = told("A0x(t1) == stop_line", "A0(t2) - A0(t1) == 2", "A0(t2) == A1(t1)", "A1v(t2) == 0")
    assert "The moment that counts: 2 s after the ego is at its stop line." in text


def test_sides_of_the_trigger_script_and_order() -> None:
    text = told(
        "A0(t1) == A1(t1)",
        "A0x(t1) == stop_line - 12",
        "A1x(t1) == conflict_point - 20",
        "A1x(t2) == conflict_point - 5",
        "A1v(t2) == 0",
        "A1v(stop) == 0",
        "A1x(t4) == conflict_point",
        "A0x(t2) == turn_start",
        "A1(t4) < A0(t2)",
    )
    assert text == (
        "The ego drives along the road, headed east, and turns left into the driveway, headed north. "
        "The truck drives along the road, headed west, and goes straight on. "
        "The moment that counts: the ego is 12 m before its stop line and the truck is 20 m before the conflict point. "
        "From that moment on the truck slows down until it is 5 m before the conflict point and stands still, then "
        "stands still, then speeds up until it is at the conflict point. "
        "The truck is at the conflict point before the ego is at the start of its turn."
    )


def amounts_of(program: Program) -> set[str]:
    """Return the numbers and parameters that the English must hold, but zeros: those have words."""
    found = set()
    for constraint in program.constraints:
        for node in walk(constraint.formula):
            if isinstance(node, ParameterRef):
                found.add(node.name)
            elif isinstance(node, Number) and node.value:
                found.add(amount(abs(node.value), None).removeprefix("about "))
    return found


@pytest.mark.parametrize("row", benchmark_rows(), ids=lambda row: row.id)
def test_every_amount_of_the_benchmark_is_read_back_and_no_other(row: object) -> None:
    program: Program = row.program  # type: ignore[attr-defined]
    sentences = read_back(program, ground(program, MAP))
    assert not [each for each in sentences if each.startswith("Besides") or "'" in each.replace("('turn')", "")]
    text = " ".join(each for each in sentences if not each.startswith("Left open"))
    assert set(re.findall(r"\b\w+_(?:m|s|mps|mpss)\b|\d+(?:\.\d+)?", text)) == amounts_of(program)


@settings(max_examples=40)
@given(programs())
def test_any_program_is_read_back_whole(program: Program) -> None:
    text = " ".join(read_back(program))
    assert text.endswith(".")
    assert all(name in text for name in (parameter.name for parameter in program.parameters))
    for constraint in program.constraints:
        for node in walk(constraint.formula):
            if isinstance(node, ParameterRef):
                assert node.name in text
    assert read_back(program) == read_back(program)


def test_the_range_of_a_parameter_is_read_back() -> None:
    head = "parameters:\n- gap_m in [20, 30]\n- rate_mpss\n\n"
    program = parse_program(f"{head}{BODY}A0(t1) == A1(t1)\nA0x(t1) == stop_line - gap_m\nA1a(dec) == -rate_mpss\n")
    assert "Left open: gap_m from 20 m to 30 m and rate_mpss." in read_back(program)
