"""What a reply must be to hold: nothing left out, nothing made up, nothing that could hang or mislead us."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from talk import GOOD, PROGRAM, READINGS, TEXT, reply_to

from scenewright.errors import MapError, ProgramError, ScenewrightError, TranslationError
from scenewright.program.manner import USUAL
from scenewright.program.printer import print_program
from scenewright.roads.load import load_map
from scenewright.study.benchmark import BenchmarkRow, benchmark_rows
from scenewright.translate.model.reply import read_reply
from scenewright.translate.model.verify import Verified, locate, verify

MAP = load_map("t_intersection")


def verified(text: str = TEXT, **reply: Any) -> Verified:
    return verify(read_reply(json.dumps(reply_to(**reply))), text, "mine", MAP)


def test_name_map_description_and_manner_are_ours_to_say() -> None:
    head = 'scenario "evil"\nmap "/etc/passwd"\ndescription:\n"another"\nmanner:\n- settled_mpss = 3\n\n'
    program = verified(program=head + PROGRAM).program
    assert (program.name, program.map_name, program.description) == ("mine", "t_intersection", TEXT)
    assert program.manner == USUAL


def test_constraints_point_at_the_words_they_came_from() -> None:
    program = verified().program
    assert program.words_of(program.constraints[4]) == "the truck brakes to a stop 5 m before the conflict point"


def test_program_may_come_as_lines() -> None:
    assert verified(program=PROGRAM.splitlines()).program == verified().program


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        (("A1v(t2) == 0", "A1v(t2) = 0"), ProgramError, "not a program"),
        (("A1v(t2) == 0", "A2v(t2) == 0"), ProgramError, "no actor 2"),
        (("A1v(t2) == 0", "A1v(t2) == 3 s"), ProgramError, "different things"),
        (("- W", "- N"), MapError, "no route"),
        (("- W", "- E"), MapError, "conflict point"),
        (("conflict_point - 5 m", "pond - 5 m"), ProgramError, "neither a landmark nor a parameter"),
        (("conflict_point - 5 m", "turn_start - 5 m"), ProgramError, r"hero \(A1\) does not turn"),
        (("conflict_point - 20 m", "A1.turn_end - 20 m"), ProgramError, "does not turn"),
    ],
)
def test_program_is_parsed_checked_and_put_on_the_map(
    change: tuple[str, str], error: type[ScenewrightError], words: str
) -> None:
    with pytest.raises(error, match=words):
        verified(program=PROGRAM.replace(*change))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("stop_line - 12 m", "stop_line - 13 m"), "12 m"),
        (("stop_line - 12 m", "stop_line - 13 m"), "the number 13 of the program"),
        (("stop_line - 12 m", "stop_line - near_m"), "the parameter near_m of the program"),
        (("A1v(t2) == 0", "A1v(t2) == 0\nA1v(t0) == 9"), "the number 9"),
        (("A1v(t2) == 0", "A1v(t2) == 0\nA0v(t2) == A1v(t1)"), "where c6 comes from"),
    ],
)
def test_numbers_are_neither_lost_nor_made_up(change: tuple[str, str], words: str) -> None:
    with pytest.raises(TranslationError) as caught:
        verified(program=PROGRAM.replace(*change))
    assert words in str(caught.value)


def test_what_an_assumption_accounts_for_may_differ() -> None:
    program = PROGRAM.replace("A1v(t2) == 0", "A1v(t2) == 0\nA1v(t0) == 9")
    assert verified(program=program, assumptions=["The truck drives at 9 m/s at first (c6)."])


def test_units_words_and_parameters_are_recognised() -> None:
    text = (
        "Ego goes west at 30 mph. An oncoming car turns left into the driveway. When ego is twenty-five feet and the "
        "car {far_m} short of the conflict point, it brakes at 0.3 g to a stop."
    )
    program = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]

Constraints:
A0v(t0) == 30 mph
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 25 ft
A1x(t1) == conflict_point - far_m
A1a(dec) == -0.3 g
A1v(t2) == 0
"""
    sentences = text.split(". ")
    readings = [(sentences[0], ["c1"]), (sentences[1], []), (sentences[2], ["c2", "c3", "c4", "c5", "c6"])]
    assert verified(text, program=program, readings=readings).program.parameters[0].name == "far_m"
    for lost in ("30 mph", "0.3 g"):
        with pytest.raises(TranslationError, match=lost):
            verified(text, program=program.replace(lost, "7"), readings=readings)
    with pytest.raises(TranslationError, match="far_m of the description"):
        verified(text, program=program.replace("far_m", "25 ft"), readings=readings)


@pytest.mark.parametrize(
    ("words", "written"),
    [
        ("twelve metres", "12 m"),
        ("a hundred and twenty feet", "120 ft"),
        ("three point five metres", "3.5 m"),
        ("one and a half metres", "1.5 m"),
        ("half a kilometre", "0.5 km"),
        ("1/3 km", "1/3 km"),
        ("2½ m", "2.5 m"),
        ("¾ m", "0.75 m"),
        ("1,200 ft", "1200 ft"),
        ("1,5 m", "1.5 m"),
        ("a couple of metres", "2 m"),
    ],
)
def test_number_in_any_writing_is_no_invention(words: str, written: str) -> None:
    text = TEXT.replace("12 m", words)
    readings = [(sentence, ["c1", "c2", "c3", "c4", "c5"]) for sentence in text.split(". ")]
    program = PROGRAM.replace("12 m", written)
    assert verified(text, program=program, readings=readings)
    with pytest.raises(TranslationError, match="the number"):
        verified(text, program=PROGRAM.replace("12 m", "777 m"), readings=readings, assumptions=[words])


@pytest.mark.parametrize(
    ("readings", "words"),
    [
        (READINGS[1:], "no reading tells of 'The AV comes out"),
        ([*READINGS, ("a bus overtakes", [])], "not in the description: 'a bus overtakes'"),
        ([*READINGS[:3], (READINGS[3][0], ["c4", "c5", "c9"])], "names c9"),
        ([*READINGS[:3], (READINGS[3][0], ["c4"])], "where c5 comes from"),
    ],
)
def test_readings_go_through_the_whole_description(readings: list[Any], words: str) -> None:
    with pytest.raises(TranslationError) as caught:
        verified(readings=readings)
    assert words in str(caught.value)


def test_hero_of_whom_nothing_is_said_is_sent_back() -> None:
    idle = PROGRAM.replace("Constraints:", "Actor 2 (bus):\n- E\n- [t0, go, t1]\n\nConstraints:")
    with pytest.raises(TranslationError, match="nothing is said of bus"):
        verified(program=idle)


@pytest.mark.parametrize(
    "bad",
    [
        PROGRAM.replace("12 m", "1e999999999 m"),
        PROGRAM.replace("12 m", "9" * 400 + " m"),
        PROGRAM.replace("12 m", "(" * 3000 + "12" + ")" * 3000),
        PROGRAM.replace("12 m", "-" * 5000 + "12"),
        PROGRAM.replace("12 m", " + ".join(["1"] * 4000)),
        PROGRAM + "A1v(t2) == 0\n" * 1000,
        PROGRAM + "#" * 30_000,
    ],
    ids=["exponent", "digits", "parentheses", "signs", "sum", "lines", "comment"],
)
def test_program_made_to_take_for_ever_is_refused_at_once(bad: str) -> None:
    with pytest.raises(ScenewrightError):
        verified(program=bad)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "no",
        "{",
        "[]",
        "null",
        "{}",
        '{"program": 3}',
        '{"program": ""}',
        '{"program": null}',
        '{"program": "x", "refusal": {"reason": "y"}}',
        '{"program": "x", "questions": [{"question": "?", "alternatives": ["a"], "default": "a"}]}',
        '{"program": "x", "questions": [{"question": "?", "alternatives": ["a", "b"], "default": "c"}]}',
        '{"program": "x", "readings": {"a": 1}}',
        '{"program": "' + "x" * 30_000 + '"}',
        '{"program": ' + "[" * 100_000,
        '{"program": ' + "9" * 10_000 + "}",
        "x" * 200_000,
        '{"a": ' * 5000,
    ],
)
def test_reply_that_is_none(text: str) -> None:
    with pytest.raises(TranslationError) as caught:
        read_reply(text)
    assert len(str(caught.value)) < 2000


@given(st.text(max_size=300))
def test_any_text_is_a_reply_or_a_told_fault(text: str) -> None:
    for whole in (text, json.dumps({"program": text}), json.dumps(reply_to(program=PROGRAM + text))):
        try:
            verify(read_reply(whole), TEXT, "mine", MAP)
        except ScenewrightError:
            continue


def test_fence_and_greeting_around_a_reply_do_no_harm() -> None:
    assert read_reply(f"Here you are {{as asked}}:\n```json\n{GOOD}\n```\nAnything else?").program == PROGRAM


def test_what_a_model_says_cannot_steer_a_terminal() -> None:
    reply = read_reply(json.dumps(reply_to(assumptions=["fine\x1b]0;owned\x07\x1b[2J\r\n\u202e"])))
    assert reply.assumptions[0].isprintable()


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("the AV comes out", "The AV comes out"),
        ("comes  out\nof the driveway,", "comes out of the driveway"),
        ("The AV ... onto the road", "The AV comes out of the driveway and turns right onto the road"),
        ("12 m short", "12 m short"),
        ("2 m short", None),
        ("a bus", None),
        ("...", None),
        ("(.*", None),
    ],
)
def test_words_are_found_whatever_their_layout(words: str, found: str | None) -> None:
    span = locate(words, TEXT)
    assert (span.excerpt(TEXT) if span else None) == found


def test_sentence_that_stands_there_twice_is_read_in_order() -> None:
    text = (
        "Ego is on the road. It drives west. The car comes out of the driveway. It drives west. " + TEXT.split(". ")[2]
    )
    program = PROGRAM.replace("- S, W\n", "- W\n", 1).replace("- W\n- [t0, go, t1, dec", "- S, W\n- [t0, go, t1, dec")
    sentences = text.split(". ")
    ids = ["c1", "c2", "c3", "c4", "c5"]
    each = [*((sentence, []) for sentence in sentences[:4]), (sentences[4], ids)]
    places = [reading.span.start for reading in verified(text, program=program, readings=each).readings]
    assert places == sorted(set(places))
    once = [*each[:3], each[4]]
    assert verified(text, program=program, readings=once), "one reading tells of both"


@pytest.mark.parametrize("row", benchmark_rows(), ids=lambda row: row.id)
def test_faithful_replies_hold(row: BenchmarkRow) -> None:
    """No false alarm: the meaning of each description of the benchmark, read sentence by sentence, is let through."""
    program = print_program(row.program.with_parameters(()))
    ids = [constraint.id for constraint in row.program.constraints]
    sentences = [sentence for sentence in re.split(r"(?<=[.])\s+", row.description) if sentence]
    assert verified(row.description, program=program, readings=[(sentence, ids) for sentence in sentences])
