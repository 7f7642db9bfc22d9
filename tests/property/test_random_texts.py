"""Whatever is typed, it is a program that prints and parses the same, or an error that is told."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from scenewright.errors import ScenewrightError
from scenewright.program.check import check_program, check_values
from scenewright.program.expressions import LANDMARKS
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from strategies import programs

WORDS = [
    *"()[]{}+-*/<>=,:.@#\"'\\\n\t ",
    *("==", "<=", ">=", "..", "and", "or", "not", "implies", "just before", "always", "never", "eventually"),
    *(
        "gap",
        "freespace",
        "tta",
        "ttc",
        "headway",
        "A0",
        "A1",
        "A1v",
        "A0x(t1)",
        "A1a(dec)",
        "A7",
        "t0",
        "t1",
        "go",
        "dec",
        "stop",
    ),
    *("Actor 0:", "Actor 1 (hero):", "- W", "- [t0, go, t1]", "Constraints:", "parameters:", "scenario", "map"),
    *("lanes", "1.0.-1", "from driveway, left", "N", "a_m", "b_mps", "= 3", "in [0, 5]", "km/h", "m/s^2", "s"),
    *("0", "1", "1e400", "1e-400", "9" * 60, "1/0", "2 - 2", "nan", "inf", "0.1", "1e9", "((((", "))))", "- -"),
    *("\x00", "\udcff", "é", "\u2028", "𝟙", "A" + "1" * 50, "x" * 200, *LANDMARKS),
]
words = st.sampled_from(WORDS)


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """Return the text of a program in which a few stretches are replaced, repeated or left out."""
    text = print_program(draw(programs()))
    for _ in range(draw(st.integers(0, 4))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.integers(0, 12)))
        between = draw(st.lists(words, max_size=3)) + [text[start:end]] * draw(st.sampled_from([0, 1, 2, 50]))
        text = text[:start] + " ".join(between) + text[end:]
    return text


def told_or_sound(text: str) -> None:
    try:
        program = parse_program(text)
        check_program(program, text)
        check_values(program, {p.name: Fraction(0) for p in program.parameters}, text)
    except ScenewrightError as error:
        str(error)  # telling it must not fail either
        return
    printed = print_program(program)
    again = parse_program(printed, program.name)
    assert again == program
    assert print_program(again) == printed


@settings(max_examples=30)
@given(spoilt())
def test_spoilt_programs(text: str) -> None:
    told_or_sound(text)


@settings(max_examples=60)
@given(st.lists(words, max_size=60).map(" ".join))
def test_words_in_any_order(text: str) -> None:
    told_or_sound(text)


@settings(max_examples=60)
@given(st.lists(words, max_size=12).map(" ".join))
def test_constraints_of_words_in_any_order(line: str) -> None:
    actors = "Actor 0:\n- W\n- [t0, go, t1]\nActor 1 (hero):\n- W\n- [t0, go, t1, dec, t2]\n"
    told_or_sound(f"{actors}Constraints:\nA1v(t1) == {line}\n")
