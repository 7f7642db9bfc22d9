"""The numbers that say what "begins", "settled" and "stands" mean: as data, as text, and where they make no sense."""

from __future__ import annotations

import re
from dataclasses import fields, replace
from fractions import Fraction
from pathlib import Path

import pytest

from scenewright.errors import ProgramError
from scenewright.program.builder import Scenario
from scenewright.program.check import check_program
from scenewright.program.limits import MANNER_LINES
from scenewright.program.manner import NUMBERS, USUAL, Manner
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.units import format_fraction, unit_of_name

DOCUMENTED = Path(__file__).resolve().parents[2] / "docs" / "program.md"
REST = "Actor 0:\n- W\n- [t0, go, t1]\nActor 1:\n- W\n- [t0, go, t1]\nConstraints:\nA0v(t0) == 5\n"


def read(*lines: str) -> Manner:
    return parse_program("\n".join(["manner:", *lines, REST])).manner


def test_a_program_without_a_manner_has_the_usual_one_and_prints_it_in_full() -> None:
    program = parse_program(REST)
    assert program.manner == USUAL
    printed = print_program(program)
    for each in fields(Manner):
        assert f"- {each.name} = {format_fraction(getattr(USUAL, each.name))}\n" in printed
    assert parse_program(printed) == program


def test_any_part_of_it_may_be_given_in_any_unit_of_its_kind() -> None:
    assert read("- stands_s = 1200 ms", "", "- stands_mps = 0.72 km/h") == replace(
        USUAL, stands_s=Fraction(6, 5), stands_mps=Fraction(1, 5)
    )
    assert read("settled_s = 2/3") == replace(USUAL, settled_s=Fraction(2, 3))


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("- stand_s = 1", "2:3: .*no number stand_s.*did you mean stands_s"),
        ("- stands_s = 1 m", "2:3: .*is a time, its value is a length"),
        ("- stands_s = 100", "2:3: .*out of range.*found: *100 s.*expected: *0.1 to 60 s.*usual 0.3 s"),
        ("- stands_s = -1", "2:3: .*out of range"),
        ("- stands_s = 1\n- stands_s = 1", "3:3: .*given twice.*remove one"),
        ("- stands_s in [1, 2]", "2:12: .*expected: *'='"),
    ],
)
def test_what_is_no_manner_is_refused_where_it_stands(line: str, says: str) -> None:
    with pytest.raises(ProgramError) as caught:
        read(line)
    assert re.search(says, str(caught.value), re.DOTALL), caught.value


def test_every_usual_number_is_in_its_range_and_has_a_unit() -> None:
    assert list(NUMBERS) == [each.name for each in fields(Manner)]
    USUAL.check()
    assert all(unit_of_name(name) is not None for name in NUMBERS)


@pytest.mark.parametrize("name", NUMBERS)
def test_a_number_beyond_its_range_is_refused_however_it_came_into_a_program(name: str) -> None:
    for value in (NUMBERS[name].low / 2 or Fraction(-1), NUMBERS[name].high * 2):
        program = replace(parse_program(REST), manner=replace(USUAL, **{name: value}))
        with pytest.raises(ProgramError, match=f"{name} of the manner is out of range"):
            check_program(program)


def test_stricter_is_on_the_safe_side_of_every_number() -> None:
    strict = USUAL.stricter(Fraction(1, 10))
    more = {name for name in NUMBERS if getattr(strict, name) > getattr(USUAL, name)}
    assert more == {"begins_mpss", "begins_s", "settled_s", "stands_s"}
    assert strict.stands_s == Fraction(33, 100)
    assert strict.settled_mpss == Fraction(45, 100)


def test_a_manner_is_built_as_it_is_written() -> None:
    scene = Scenario("built")
    scene.ego("W", sketch="t0 go t1")
    scene.actor("hero", "W", sketch="t0 go t1")
    scene.manner(stands_s=1.5)
    assert "- stands_s = 1.5\n" in scene.text()
    with pytest.raises(ProgramError, match="out of range"):
        scene.manner(settled_s=90)


def test_a_manner_of_too_many_lines_is_refused_and_a_label_is_no_manner() -> None:
    with pytest.raises(ProgramError, match="too many lines of the manner"):
        read(*["- stands_s = 1"] * (MANNER_LINES + 1))
    labelled = "\n".join(f"manner: A0v(t{number % 2}) <= 50" for number in range(MANNER_LINES + 1))
    assert len(parse_program(f"{REST}{labelled}\n").constraints) == MANNER_LINES + 2


def test_the_documentation_has_the_same_numbers() -> None:
    rows = re.findall(r"^\| `(\w+)` \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", DOCUMENTED.read_text("utf-8"), re.MULTILINE)
    expected = []
    for name, number in NUMBERS.items():
        unit = unit_of_name(name)
        assert unit is not None
        low, high, usual = map(format_fraction, (number.low, number.high, getattr(USUAL, name)))
        expected.append((name, f"{usual} {unit.symbol}", f"{low} to {high}", number.meaning))
    assert rows == expected
