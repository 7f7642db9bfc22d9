"""The checker: each fault a program can have by itself, with the words and the place that its message must give."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from scenarios import EXAMPLE_TABLE, Example, example
from scenewright.errors import ProgramError
from scenewright.program.check import check_constraint, check_program, check_values
from scenewright.program.expressions import Compare, Knot, Number, ParameterRef, State
from scenewright.program.text import parse_program
from scenewright.program.types import Constraint, Parameter

# The constraint under test stands in line 10 of this program.
FRAME = example("E, N", "t0, go, t1, dec, t2, dec, t3", "fault: {}")
LINE = 10

# Constraint, column of the fault, words of the message, what was found, what is expected.
FAULTS = [
    ("A0v(t7) == 5", 8, "ego (A0) has no knot t7", "t7", "t0, t1, t2"),
    ("A1v(t4) == 5", 8, "hero (A1) has no knot t4", "t4", "t0, t1, t2, t3"),
    ("A0v(t0) == A1v(A0(t3))", 23, "ego (A0) has no knot t3", "t3", "t0, t1, t2"),
    ("A0(t1) == A1(tx)", 18, "hero (A1) has no knot tx", "tx", "t0, t1, t2, t3"),
    ("A1a(acc) == 2", 8, "hero (A1) has no piece acc", "acc", "go, dec1, dec2"),
    ("A1a(dec3) == 2", 8, "hero (A1) has no piece dec3", "dec3", "go, dec1, dec2"),
    ("A0a(dec) == 2", 8, "ego (A0) has no piece dec", "dec", "go1, go2"),
    ("A2v(t0) == 5", 8, "there is no actor 2", "A2", "A0 (ego), A1 (hero)"),
    ("gap(A0, A3, t1) == 5", 8, "there is no actor 3", "A3", "A0 (ego), A1 (hero)"),
    ("A0(t1) == A4(t1)", 18, "there is no actor 4", "A4", "A0 (ego), A1 (hero)"),
    ("A0x(t0) == A5.stop_line", 19, "there is no actor 5", "A5", "A0 (ego), A1 (hero)"),
    ("A0x(t0) == A0.conflict_point(A6)", 19, "there is no actor 6", "A6", "A0 (ego), A1 (hero)"),
    ("A0x(t0) == A0.conflict_point(A0)", 19, "of an actor with itself", "A0.conflict_point(A0)", "A0.conflict_point"),
    ("A0x(t0) == A0.stop_line(A1)", 19, "stop_line is shared with nobody", "A0.stop_line(A1)", "A0.stop_line"),
    ("A0x(t0) == A1v(t0)", 8, "two different things are compared", "A0x(t0) is a length (m)", "the same kind"),
    ("A0x(t0) == ego_speed_mps", 8, "two different things", "ego_speed_mps is a speed (m/s)", "the same kind"),
    ("A0(t1) < A0x(t1)", 8, "two different things", "A0(t1) is a time (s)", "the same kind"),
    ("tta(A0, stop_line, t1) == A0v(t1)", 8, "two different things", "is a time (s)", "the same kind"),
    ("headway(A0, A1, t1) == stop_line", 8, "two different things", "is a length (m)", "the same kind"),
    ("A1a(dec1) == limit_mps", 8, "two different things", "an acceleration (m/s^2)", "the same kind"),
    ("A0x(t0) * A0x(t1) == A0x(t2)", 8, "two different things", "is m^2 s^0", "the same kind"),
    ("A0x(t0) + A0v(t0) == 5", 8, "adds different things", "a length (m) and a speed (m/s)", "the same kind"),
    ("A0x(t0) == stop_line - wait_s", 19, "adds different things", "a length (m) and a time (s)", "the same kind"),
    ("A0v(t0) == 5 and A0v == 3", 25, "A0v has no moment", None, "A0v(t1) or A0v(3.4)"),
    ("gap(A0, A1) == 3", 8, "gap(A0, A1) has no moment", None, "gap(A0, A1, t1) or gap(A0, A1, 3.4)"),
    ("always[A0v, 5](A0v < 3)", 15, "A0v is a speed (m/s)", None, "a time (s)"),
    ("always[A0(t0), stop_line](A0v < 3)", 23, "stop_line is a length (m)", None, "a time (s)"),
    ("always[ttc(A0, A1), 5](A0v < 3)", 15, "ttc(A0, A1) has no moment", None, "ttc(A0, A1, t1)"),
    ("not A0x(t0) == A1v(t0)", 12, "two different things", None, "the same kind"),
    ("never[0, 3](A0v + A0x > 3)", 20, "adds different things", None, "the same kind"),
    ("A1x(t0) - A0x(t0) == stop_line", 29, "on whose route is stop_line?", "A1x(t0) - A0x(t0)", "A1.stop_line"),
    ("stop_line == conflict_point", 8, "on whose route is stop_line?", None, "A1.stop_line"),
    ("tta(A0, A1, t1) == 3", 8, "tta is measured to a place", "tta(A0, A1, t1)", "tta(A0, stop_line, t1)"),
    ("gap(A0, stop_line, t1) == 3", 8, "gap is measured to another actor", None, "gap(A0, A1, t1)"),
    ("ttc(A1, A1, t1) == 3", 8, "ttc of an actor to itself", None, "two different actors"),
]


@pytest.mark.parametrize(("line", "column", "words", "found", "expected"), FAULTS, ids=[fault[0] for fault in FAULTS])
def test_faults_of_constraints(line: str, column: int, words: str, found: str | None, expected: str) -> None:
    text = FRAME.format(line)
    with pytest.raises(ProgramError) as caught:
        check_program(parse_program(text, "x.scene"), text, "x.scene")
    error = caught.value
    assert words in error.message
    assert str(error.place) == f"x.scene:{LINE}:{column}"
    assert found is None or found in (error.found or "")
    assert expected in (error.expected or "")


# Text to replace, by what; place and words of the message.
FRAMES = [
    ("Actor 1 (hero)", "Actor 0 (hero)", "5:1", "two actors have the same number"),
    ("Actor 1 (hero)", "Actor 1 (ego)", "5:1", "two actors are called ego"),
    ("Actor 0 (ego)", "Actor 2 (ego)", None, "there is no ego"),
    ("[t0, go, t1, go, t2]", "[t0, go, t1, acc, t2]", "1:1", "is told what to do, and nobody controls it"),
    ("[t0, go, t1, go, t2]", "[t0, go, dec, go, t2]", "1:1", "a knot of ego (A0) is called like a piece"),
]


@pytest.mark.parametrize(("old", "new", "place", "words"), FRAMES, ids=[frame[3] for frame in FRAMES])
def test_faults_of_actors(old: str, new: str, place: str | None, words: str) -> None:
    text = FRAME.format("A1v(t0) == 5").replace(old, new)
    with pytest.raises(ProgramError) as caught:
        check_program(parse_program(text, "x.scene"), text, "x.scene")
    assert words in caught.value.message
    assert str(caught.value.place) == ("x.scene" if place is None else f"x.scene:{place}")


@pytest.mark.parametrize(
    ("lines", "place", "words"),
    [
        ("- length = 3", "2:3", "parameter length has no unit"),
        ("- a_m in [5, 3]", "2:3", "the range of a_m is empty"),
        ("- a_m = 50 in [10, 40]", "2:3", "parameter a_m is out of range"),
        ("- a_m = 3\n- a_m = 4", "3:3", "parameter a_m is declared twice"),
    ],
)
def test_faults_of_parameters(lines: str, place: str, words: str) -> None:
    text = f"parameters:\n{lines}\n" + FRAME.format("A1v(t0) == 5")
    with pytest.raises(ProgramError) as caught:
        check_program(parse_program(text, "x.scene"), text, "x.scene")
    assert words in caught.value.message
    assert str(caught.value.place) == f"x.scene:{place}"


def test_two_constraints_of_one_name() -> None:
    text = FRAME.format("A1v(t0) == 5\nfault: A1v(t1) == 5")
    with pytest.raises(ProgramError, match="two constraints are called fault") as caught:
        check_program(parse_program(text, "x.scene"), text, "x.scene")
    assert str(caught.value.place) == f"x.scene:{LINE + 1}:8"


@pytest.mark.parametrize("source", ["@3..2", "@2..2", "@0..6"])
def test_words_that_are_not_in_the_description(source: str) -> None:
    text = 'description: "brake"\n' + FRAME.format(f"A1v(t0) == 5 {source}")
    with pytest.raises(ProgramError, match="the words of fault are not in the description"):
        check_program(parse_program(text, "x.scene"), text, "x.scene")
    text = text.replace(source, "@0..5")
    check_program(parse_program(text, "x.scene"), text, "x.scene")


def test_nobody_but_the_ego() -> None:
    program = parse_program("Actor 0:\n- W\n- [t0, go, t1]\n")
    with pytest.raises(ProgramError, match="nobody but the ego"):
        check_program(program)


def test_a_near_miss_is_suggested() -> None:
    text = example("W", "start, go, trigger, dec, rest", "A1v(triger) == 5")
    with pytest.raises(ProgramError) as caught:
        check_program(parse_program(text), text)
    assert caught.value.fix == "did you mean trigger?"


def test_programs_from_elsewhere_are_checked_without_a_text() -> None:
    """A translator's data has no spans; what the parser adds or refuses by itself the checker must see too."""
    program = parse_program(FRAME.format("A1v(t0) == 5"))
    undeclared = Compare("==", State(0, 1, Knot("t0")), ParameterRef("gone_mps"))
    with pytest.raises(ProgramError, match="parameter gone_mps is not declared"):
        check_constraint(program, Constraint("c1", undeclared))
    declared = replace(program, parameters=(Parameter("gone_mps"),))
    check_constraint(declared, Constraint("c1", undeclared))
    empty = replace(program, parameters=(Parameter("a_m", None, Fraction(3), Fraction(1)),))
    with pytest.raises(ProgramError, match="range of a_m is empty"):
        check_program(empty)


@pytest.mark.parametrize("case", EXAMPLE_TABLE, ids=lambda case: case.name)
def test_examples_make_sense(case: Example) -> None:
    check_program(case.program(), case.text, case.name)


@pytest.mark.parametrize(
    "line",
    [
        "A0x(t0) == A1.stop_line - 5",
        "A0x(t0) - A0x(t1) == stop_line",
        "A1x(t1) - A0x(t1) == 12",
        "A0v(t0) / 2 == A1v(t0)",
        "A0x(t1) / A0v(t1) == 3 s",
        "A0v(t1) * A0(t1) == A0x(t1) - stop_line",
        "tta(A0, A1.conflict_point, t1) == tta(A1, conflict_point, A0(t1))",
        "always[0, A0(t1)](A0v <= 10 or gap(A0, A1) > 12)",
        "A1a(dec) == -2",
        "A0x(3.4) == stop_line",
    ],
)
def test_what_makes_sense_passes(line: str) -> None:
    text = FRAME.format(line)
    check_program(parse_program(text), text)


@pytest.mark.parametrize(
    ("line", "refused"),
    [
        ("A1a(dec) == 0", True),
        ("A1a(dec) == -0.09", True),
        ("-0.09 == A1a(dec)", True),
        ("A1a(dec) == -0.1", False),
        ("A1a(dec) >= -0.05", True),
        ("A1a(dec) > -0.05", True),
        ("-0.05 <= A1a(dec)", True),
        ("A1a(dec) <= -0.05", False),  # or harder
        ("A1a(dec) <= 0", False),
        ("A1a(acc) == 0.05", True),
        ("A1a(acc) <= 0.05", True),
        ("A1a(acc) >= 0", False),
        ("A1a(go) == 0", False),
        ("A1v(t1) == 3 and A1a(dec) == -1 / 20", True),
        ("A1v(t1) == 3 or A1a(dec) == 0", False),  # it need not be
        ("A1a(dec) == -rate_mpss", False),  # which is not known yet
    ],
)
def test_a_rate_that_the_manner_calls_none_is_no_rate_to_ask_for(line: str, refused: bool) -> None:
    text = f"parameters:\n- rate_mpss\n{example('W', 't0, go, t1, dec, t2, acc, t3', line)}"
    program = parse_program(text)
    if refused:
        with pytest.raises(ProgramError, match=r"m/s\^2 is no (braking|speeding up)"):
            check_program(program, text)
        finer = replace(program, manner=replace(program.manner, faint_mpss=Fraction(1, 100)))
        if line != "A1a(dec) == 0":
            check_program(finer, text)
    else:
        check_program(program, text)
        if "rate_mpss" in line:
            check_values(program, {"rate_mpss": Fraction(1)}, text)
            with pytest.raises(ProgramError, match=r"a rate of 0.05 m/s\^2 is no braking|a rate of -0.05 m/s"):
                check_values(program, {"rate_mpss": Fraction(1, 20)}, text)


@pytest.mark.parametrize(
    ("line", "fix"),
    [("A1a(dec) == 2", "-2"), ("2 <= A1a(dec)", "-2"), ("A1a(acc) == -1.5", "1.5"), ("A1a(dec) <= 2", "")],
)
def test_decelerations_are_signed(line: str, fix: str) -> None:
    text = example("W", "t0, go, t1, dec, t2, acc, t3", line)
    if not fix:
        check_program(parse_program(text), text)
        return
    with pytest.raises(ProgramError, match=r"is no (braking|speeding up)") as caught:
        check_program(parse_program(text), text)
    assert caught.value.fix == f"give it its sign: {fix}"


def test_a_number_goes_with_any_unit() -> None:
    for state in ("A0x(t0)", "A0v(t0)", "A0a(t0)", "A0(t1)"):
        check_program(parse_program(FRAME.format(f"{state} == 5")))
    assert parse_program(FRAME.format("A0v(t0) == 5")).constraints[0].formula == Compare(
        "==", State(0, 1, Knot("t0")), Number(Fraction(5))
    )
