"""The whole way of a text, on the map that it names or is given; questions, not guesses, and answers that last."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from scenewright.errors import InputError, MapError, TranslationError
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Question, Story
from scenewright.translate.understand import OpenQuestionsError, as_data, defaults_of, read_answers, understand

TEXT = (
    "The ego drives west and goes straight on. An oncoming hero turns left into the driveway. When the ego is 25 m "
    "before the conflict point and the hero is 15 m before the conflict point, the hero brakes to a stop 8 m before it."
)
OPEN = "The ego has an open way. The hero is headed east and turns left. The hero brakes at 3 m/s^2."
PLAIN = (
    "The ego is headed west and goes straight on. The hero is headed east and turns left. The hero brakes to a stop."
)
UNKNOWN = "The ego is headed west and goes straight on. The hero turns left. The hero zonks and brakes to a stop."


def test_a_text_becomes_a_program_that_fits_its_map() -> None:
    program = understand(TEXT).program
    assert ground(program, load_map(program.map_name)).routes[1].headings == ("E", "N")
    assert program.description == TEXT
    assert program.words_of(program.constraints[1]) == "the ego is 25 m before the conflict point"


def test_a_map_that_is_named_and_a_text_that_is_too_long() -> None:
    assert understand(f"Map: t_intersection\n{TEXT}").story.map_name == "t_intersection"
    with pytest.raises(MapError):
        understand(f"Map: nowhere\n{TEXT}")
    with pytest.raises(TranslationError, match="too many characters"):
        understand("The ego stands. " * 1000)


@pytest.mark.parametrize("vague", ["about 30 m", "roughly 30 m"])
def test_a_vague_amount_is_asked_about_and_not_taken_for_an_exact_one(vague: str) -> None:
    text = (
        "The ego is headed west and goes straight on. The hero is headed east and turns left. "
        f"When the ego is {vague} before the conflict point, the hero brakes to a stop."
    )
    (question,) = understand(text).questions
    assert question.alternatives[question.default or 0] == "exactly 30 m"
    with pytest.raises(TranslationError, match="leaves something open"):
        understand(text, strict=True)
    at_least = understand(text, answers={question.slot: "at least 30 m"})
    assert "at least 30 m before" in at_least.lines[-1].sentence


def test_one_question_after_another_until_none_is_open() -> None:
    asked: list[str] = []

    def last(question: Question) -> str:
        asked.append(question.slot)
        return question.alternatives[-1]

    text = "The ego has an open way. The van has an open way. The van zonks and brakes to a stop."
    found = understand(text, ask=last, strict=True)
    assert len(asked) == len(set(asked)) == 3
    assert not found.questions
    assert understand(text, answers=found.all_answers, strict=True).program == found.program


def test_lines_stand_beside_the_words_they_came_from() -> None:
    found = understand(TEXT)
    assert [(line.sentence, line.words) for line in found.lines][1:] == [
        ("The hero is headed east and turns left.", "An oncoming hero turns left into the driveway"),
        (
            "When the ego is 25 m before the conflict point and the hero is 15 m before the conflict point, the hero "
            "begins to brake until it stands 8 m before the conflict point.",
            TEXT[TEXT.index("When") : -1],
        ),
    ]
    assert found.as_data()["understood"][0]["sentence"] == "The ego is headed west and goes straight on."


@pytest.mark.parametrize(
    ("does", "name"),
    [
        ("changes lanes", "change lanes"),
        ("cuts in", "cut in"),
        ("swerves", "swerve"),
        ("backs up", "back up"),
        ("overtakes", "overtake"),
    ],
)
def test_a_deed_that_no_program_says_yet_is_refused_in_the_words_of_the_text(does: str, name: str) -> None:
    text = TEXT.replace("brakes to a stop 8 m before it", does)
    with pytest.raises(TranslationError, match=f"'{name}' cannot be said in a program yet") as caught:
        understand(text)
    assert does in (caught.value.found or "")
    assert caught.value.place is not None
    assert "brake" in (caught.value.fix or ""), "what comes nearest is named, and nothing is to be left out"


def test_a_default_is_taken_and_told() -> None:
    read_once = understand(OPEN)
    (question,) = as_data(read_once.questions)
    assert question["default"] in question["alternatives"]
    assert question["words"] == "ego"
    assert read_once.all_answers == defaults_of(read_once.story) == {"way of ego": question["default"]}
    again = understand(OPEN, answers=read_once.all_answers)
    assert again.program == read_once.program
    assert not again.questions


def test_strict_refuses_what_is_open() -> None:
    with pytest.raises(TranslationError, match="leaves something open") as caught:
        understand(OPEN, strict=True)
    assert "Which way does the ego go?" in (caught.value.found or "")


def test_a_word_that_nobody_knows_must_be_answered() -> None:
    with pytest.raises(TranslationError, match="leaves something open") as caught:
        understand(UNKNOWN)
    assert "What is 'zonks'?" in (caught.value.found or "")
    story = read(UNKNOWN, {"word zonks": "set it aside"})
    assert (len(story.questions), len(story.deeds)) == (0, 1)


def test_what_must_be_answered_comes_with_the_file_of_answers_to_fill_in() -> None:
    with pytest.raises(OpenQuestionsError) as caught:
        understand(UNKNOWN)
    assert "What is 'zonks'?" in (caught.value.found or "")
    example = json.loads((caught.value.fix or "").partition("--answers FILE: ")[2])
    assert example.keys() == {"word zonks"}
    (question,) = caught.value.as_dict()["questions"]  # type: ignore[misc]
    assert question["slot"] == "word zonks"
    assert str(caught.value.place) == f"description:1:{UNKNOWN.index('zonks') + 1}"


def test_a_typing_error_is_asked_about_with_the_word_it_may_be() -> None:
    text = "The ego comes from the raod and turns left. The hero brakes to a stop."
    (question,) = read(text).questions
    assert ("it means 'road'" in question.alternatives, question.default) == (True, None)
    assert read(text, {question.slot: "it means 'road'"}).actors[0].way.origin == "road"


def test_who_it_is_may_be_asked() -> None:
    text = "The ego has an open way. When the truck is 20 m behind the van, it begins to brake until it stands."
    (question,) = read(text).questions
    assert question.alternatives == ("truck", "van")
    truck, van = (read(text, {question.slot: who}) for who in question.alternatives)
    assert [truck.deeds[-1].actor, van.deeds[-1].actor] == [1, 2]


def test_an_answer_that_is_none_is_refused() -> None:
    with pytest.raises(InputError, match="this is no answer"):
        understand(OPEN, answers={"way of ego": "upwards"})


def test_an_answer_to_no_question_is_refused_with_the_questions_that_there_are() -> None:
    with pytest.raises(InputError, match="to no question") as caught:
        understand(OPEN, answers={"way of ergo": "is headed west and turns right"})
    assert (caught.value.found, caught.value.expected) == ("way of ergo", "way of ego")


@pytest.mark.parametrize(
    ("open_by", "answers"),
    [
        ({(): ("one", "two")}, {"one": "yes", "two": "yes"}),  # the first closes the second as well
        ({(): ("one",), ("one",): ("two",)}, {"two": "yes", "one": "yes"}),  # the first opens the second
    ],
)
def test_answers_that_open_and_close_other_questions_are_all_to_something(
    open_by: dict[tuple[str, ...], tuple[str, ...]], answers: dict[str, str]
) -> None:
    def read_with(given: Mapping[str, str]) -> Story:
        open_ones = (Question(slot, "Is it so?", ("no", "yes")) for slot in open_by.get(tuple(given), ()))
        return replace(read(PLAIN), questions=tuple(open_ones))

    assert understand(PLAIN, answers=answers, strict=True, read_with=read_with).answers == answers
    with pytest.raises(InputError, match="to no question"):
        understand(PLAIN, answers={**answers, "three": "yes"}, read_with=read_with)


def test_answers_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "answers.json"
    path.write_text(json.dumps({"way of ego": "is headed west and turns right"}), encoding="utf-8")
    assert understand(OPEN, answers=read_answers(path)).story.actors[0].way.turn == "right"
    for wrong in ("[1]", '{"a": 1}', "{"):
        path.write_text(wrong, encoding="utf-8")
        with pytest.raises(InputError):
            read_answers(path)


def test_who_drives_alone_is_told_so_in_plain_words() -> None:
    with pytest.raises(TranslationError, match="nobody but the ego") as caught:
        understand("The ego drives west.")
    assert "Actor" not in str(caught.value)


@pytest.mark.parametrize("who", ["hero 2", "car B", "car 'Red One'", "van 'Blue-2'"])
def test_what_a_text_calls_somebody_can_be_written_as_a_program_and_read(who: str) -> None:
    said = f"The ego is headed west and goes straight on. The {who} is headed east and turns left. When the ego is "
    program = understand(f"{said}25 m before the conflict point, the {who} brakes to a stop.").program
    assert parse_program(print_program(program)) == program
