"""Sizes that stay sizes: what is too much is refused before it is worked out."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path

import pytest
from small_programs import FRAME

from scenewright.errors import ProgramError, TranslationError
from scenewright.program import limits
from scenewright.program.builder import Scenario
from scenewright.program.check import check_constraint, check_program
from scenewright.program.expressions import Compare, Knot, Logic, Negate, Number, State, Term
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.program.types import Constraint
from scenewright.units import DIGITS, LARGEST_EXPONENT, LARGEST_SI, SMALLEST_SI, decimal_fraction

HEAD = FRAME.split("Constraints:")[0]
DOCUMENTED = Path(__file__).resolve().parents[2] / "docs" / "program.md"


def refused(text: str) -> ProgramError:
    with pytest.raises(ProgramError) as caught:
        check_program(parse_program(text, "x.scene"), text, "x.scene")
    assert caught.value.expected
    return caught.value


@pytest.mark.parametrize(
    ("line", "words", "column"),
    [
        ("A1v(t1) / 0 == 3", "divided by zero", 18),
        ("A1v(t1) == 1 / (2 - 2)", "divided by zero", 23),
        ("A1v(t1) / (A0v(t0) - A0v(t0)) == 3", "divided by zero", 18),
        ("A1v(t1) / (0 * A0v(t0)) == 3", "divided by zero", 18),
        ("A1v(1/0) == 3", "divided by zero", 14),
        ("A1v(t1) == 1" + "0" * 5000, "too many digits", 19),
        ("A1v(t1) == 0." + "1" * 5000, "too many digits", 19),
        ("A1v(t1) == 1e400", "number of this size", 19),
        ("A1v(t1) == 1e999999999", "number of this size", 19),
        ("A1v(t1) == 1e-999999999", "number of this size", 19),
        ("A1v(t1) == 2e9", "number of this size", 19),
        ("A1x(t1) == 2e6 km", "number of this size", 19),
        ("A1v(t1) == 1e-25", "number of this size", 19),
        ("A1v(1e20) == 3", "number of this size", 12),
        ("A1v(t1) == 1 / " + " / ".join(["7"] * 60), "number of this size", 19),
        ("A1v(t1) == " + " * ".join(["1000000"] * 9), "larger than any quantity", 19),
        ("A1x(t1) == A0x(t1)" + " * 100000000" * 5, "larger than any quantity", 19),
        ("A1v(t1) == nan", "neither a landmark nor a parameter", 19),
        ("A1v(t1) == inf", "neither a landmark nor a parameter", 19),
        ("(" * 5000 + "A1v(t1)" + ")" * 5000 + " == 3", "nesting", None),
        ("(" * 5000, "nesting", None),
        ("not " * 5000 + "A1v(t1) == 3", "nesting", None),
        ("A1v(t1) == " + "-" * 5000 + "3", "nesting", None),
        ("A1x(t1) == " + "just before " * 5000 + "stop_line", "nesting", None),
        (" implies ".join(["A1v(t1) == 3"] * 120), "nesting", None),
        ("always[0, 5](" * 5000 + "A1v <= 3" + ")" * 5000, "nesting", None),
        ("always[0, 5](always[0, 5](A1v <= 3))", "one temporal operator stands inside another", 21),
        (" and ".join(["A1v(t1) <= 3"] * 5000), "words, numbers and signs", None),
        ("A1v(t1) == " + " + ".join(["1"] * 5000), "words, numbers and signs", None),
        ("A1v(t1) == " + " + ".join(["1"] * 150), "nesting", None),
        ("A1v(t1) == " + "a" * 10_000 + "_mps", "the name has too many characters", None),
        ("A1v(" + "t" * 10_000 + ") == 3", "the name has too many characters", None),
        ("A1v(t1) == 3 @1.." + "9" * 5000, "too many digits", None),
    ],
)
def test_what_is_no_number_or_too_much_for_one_constraint(line: str, words: str, column: int | None) -> None:
    error = refused(FRAME.format(line))
    assert words in error.message
    assert error.place is not None
    where = str(error.place).split(":")
    assert where[:2] == ["x.scene", "10"]
    assert column is None or where[2] == str(column)
    assert len(str(error)) < 6_000


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (HEAD + "Constraints:\n" + "A1v(t1) <= 20\n" * 20_000, "too many constraints"),
        ("parameters:\n" + "".join(f"- p{i}_m = 3\n" for i in range(20_000)) + HEAD, "too many parameters"),
        ("".join(f"Actor {i}:\n- W\n- [t0, go, t1]\n" for i in range(1000)), "too many actors"),
        ("Actor 0:\n- W\n- [" + ", go, ".join(f"t{i}" for i in range(10_000)) + "]\n", "too many words"),
        (
            HEAD.replace("[t0, go, t1, go", "[" + ", go, ".join(f"t{i}" for i in range(3, 120)) + ", go"),
            "too many knots",
        ),
        (HEAD.replace("Actor 1", "Actor " + "1" * 5000), "too many digits"),
        (HEAD.replace("- W", "- lanes " + ", ".join(["1.0.-1"] * 1000)), "too many words"),
        (HEAD + "#" * limits.TEXT_CHARACTERS, "the text has too many characters"),
        (HEAD + '"\\' * 100_000, "this is not a program"),
        ("[" * 100_000 + "\n" + HEAD, "nesting"),
        ("parameters:\n- a_m = 1/0\n" + HEAD, "divided by zero"),
        ("parameters:\n- a_m = 1e300\n" + HEAD, "number of this size"),
        ("parameters:\n- a_m in [0, 1e29]\n" + HEAD, "number of the size of a_m"),
        ("parameters:\n- a_m in [5, 3]\n" + HEAD, "range of a_m is empty"),
        (HEAD.replace("(hero)", "(\udcff)"), "not a character"),
    ],
)
def test_what_is_too_much_for_a_program(text: str, words: str) -> None:
    with pytest.raises(ProgramError, match=re.escape(words)):
        check_program(parse_program(text), text)


def test_what_people_write_is_far_below_the_limits() -> None:
    lines = ["A1v(t1) <= 20"] * 500 + [" or ".join(f"A1v(t1) == {i}" for i in range(100))]
    lines += ["(" * 40 + "A1v(t1)" + ")" * 40 + " <= 20", "A1x(t1) <= " + " + ".join(["1.5"] * 90)]
    lines += ["not A1v(t1) == 3", "A1x(t1) == just before conflict_point", "A1v(t1) / A0v(t1) <= 2"]
    text = HEAD + "Constraints:\n" + "\n".join(lines) + "\n"
    program = parse_program(text)
    check_program(program, text)
    assert parse_program(print_program(program), program.name).constraints == program.constraints


def test_programs_that_come_from_no_text_have_the_same_limits() -> None:
    """A translator's data is never scanned: the checker has to see it all by itself, and without recursion."""
    program = parse_program(FRAME.format("A1v(t0) == 5"))
    speed = State(1, 1, Knot("t1"))
    deep: Term = speed
    wide = Compare("==", speed, Number(Fraction(3)))
    for _ in range(5_000):
        deep = Negate(deep)
    for formula in (Compare("==", deep, Number(Fraction(3))), Compare("==", speed, Number(Fraction(10) ** 5_000))):
        with pytest.raises(ProgramError, match=r"nesting|number of this size"):
            check_constraint(program, Constraint("c1", formula))
    check_constraint(program, Constraint("c1", Logic("and", (wide,) * 500)))
    scene = Scenario("many")
    ego, hero = scene.ego("W"), scene.actor("hero", "E", sketch="t0 go t1")
    total = hero.x("t1")
    for _ in range(200):
        total = total + 1
    with pytest.raises(ProgramError, match="nesting"):
        scene.require(total == ego.x("t1"))
    for number in (1e300, 10**5_000, Fraction(10**5_000), Fraction(1, 10**5_000)):
        with pytest.raises(ProgramError, match="number of this size"):
            scene.require(hero.v("t1") <= number)


def test_an_exact_value_is_not_worked_out_where_it_would_fill_the_memory() -> None:
    for number in ("1e999999999", "1e-999999999", "1" * 5000, "0." + "1" * 5000, "1e" + "9" * 5000):
        with pytest.raises(ValueError, match="digits"):
            decimal_fraction(number)
    assert decimal_fraction("1e-12") == Fraction(1, 10**12)


def test_a_description_is_one_scenario() -> None:
    limits.check_description("the ego goes west " * 100, "d")
    for text in ("x " * limits.DESCRIPTION_CHARACTERS, "it drives " + "9" * 5000 + " m"):
        with pytest.raises(TranslationError, match="too many"):
            limits.check_description(text, "d")


def test_the_documentation_has_the_same_limits() -> None:
    page = DOCUMENTED.read_text(encoding="utf-8")
    table = dict(re.findall(r"^\| ([^|]+?) \| ([\d,]+)[^|]*\|$", page, flags=re.MULTILINE))
    assert {what: int(most.replace(",", "")) for what, most in table.items()} == {
        "characters of a program's text": limits.TEXT_CHARACTERS,
        "characters of a description": limits.DESCRIPTION_CHARACTERS,
        "actors": limits.ACTORS,
        "knots of an actor": limits.KNOTS,
        "parameters": limits.PARAMETERS,
        "lines of the manner": limits.MANNER_LINES,
        "constraints": limits.CONSTRAINTS,
        "words, numbers and signs of a line": limits.LINE_PARTS,
        "levels of nesting, and terms of a sum": limits.DEPTH,
        "characters of a name": limits.NAME_CHARACTERS,
        "digits of a number": DIGITS,
        "power of ten of a number": LARGEST_EXPONENT,
    }
    assert f"{float(SMALLEST_SI):g}" == "1e-09"
    assert f"{float(LARGEST_SI):g}" == "1e+09"
