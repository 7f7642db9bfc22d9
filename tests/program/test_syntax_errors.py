"""What is no program is named with its place, what stood there and what could have, in words."""

from __future__ import annotations

import pytest
from small_programs import HEAD

from scenewright.errors import ProgramError
from scenewright.program.text import parse_program

FAULTS = [
    ("A0v(t0) = 5", 5, 9, "'='", "one of == <= >= < >"),
    ("A0v(t0) == ", 5, 12, "the end of the line", "a number"),
    ("A0v(t0 == 5", 5, 8, "'=='", "')'"),
    ("A0v(t0) == 5 furlong", 5, 14, "furlong", "km/h"),
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
    ("A0v(3.4 m) == 3", 5, 5, "m", "a unit of time, such as s"),
    ("a0v(t0) == 3", 5, 1, "a0v", "a state such as A1x(t1)"),
    ("A0v(t0)\u00a0== 3", 5, 8, "'\\xa0'", None),
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
        ('map "a"\nmap "b"\nActor 0:\n- W\n- [t0, go, t1]\n', "p:2:1", "said twice"),
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


def test_a_place_with_somebody_that_is_nobodys_is_told_how_it_is_written() -> None:
    with pytest.raises(ProgramError) as caught:
        parse_program(f"{HEAD}A0x(t0) == conflict_point(A0) - 30\n")
    assert "A1.conflict_point(A0)" in (caught.value.fix or "")


@pytest.mark.parametrize(
    ("line", "fix"),
    [
        ("A0v(t0) == 12 kmh", "did you mean km/h?"),
        ("A0v(t0) == 12 KM/H", "did you mean km/h?"),
        ("A0a(t0) == 2 m/s2", "write one of these units"),
        ("A0v(t0) <= −3", "write minus as '-'"),
        ("A0v(t0) ≤ 3", "write '<='"),
        ("A0v(t0) => 3", "write '>='"),
        ("A0v(t0) = 3", "write '=='"),
        ("A0v(t0) == 3 && A0v(t1) == 3", "write 'and'"),
        ("A0v(t0) == 3 -> A0v(t1) == 3", "write 'implies'"),
        ("A0v(t0) == 3,5", "decimal point"),
        ("A0v(t0) == .5", "both sides of a decimal point"),
        ("A0v(t0) == 3 // slow", "begin a comment with '#'"),
        ("A0V(t0) == 3", "did you mean A0v?"),
        ("Always[A0(t0), A0(t1)] (A0v <= 3)", "did you mean always?"),
        ("ego.v(t0) == 3", "call actors by their numbers: A0, A1"),
        ("A0x(t0) == Stop_Line - 5", "did you mean stop_line?"),
        ("A0v(t0) == 3 $", "scenewright translate --code"),
    ],
)
def test_what_people_write_instead_is_mended(line: str, fix: str) -> None:
    with pytest.raises(ProgramError) as caught:
        parse_program(f"{HEAD}{line}\n")
    assert fix in (caught.value.fix or "")
