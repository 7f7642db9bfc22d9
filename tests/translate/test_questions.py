"""Questions, not guesses: as data, answered from a file, strict, and the same again with the same answers."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from scenewright.errors import InputError, TranslationError
from scenewright.translate.questions import OpenQuestionsError, as_data, defaults_of, read_answers
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Question, Story
from scenewright.translate.understand import understand

TEXT = "The ego has an open way. The hero is headed east and turns left. The hero brakes at 3 m/s^2."
PLAIN = (
    "The ego is headed west and goes straight on. The hero is headed east and turns left. The hero brakes to a stop."
)
UNKNOWN = "The ego is headed west and goes straight on. The hero turns left. The hero zonks and brakes to a stop."


def test_a_default_is_taken_and_told() -> None:
    read_once = understand(TEXT)
    (question,) = as_data(read_once.questions)
    assert question["default"] in question["alternatives"]
    assert question["words"] == "ego"
    assert read_once.all_answers == defaults_of(read_once.story) == {"way of ego": question["default"]}
    again = understand(TEXT, answers=read_once.all_answers)
    assert again.program == read_once.program
    assert not again.questions


def test_strict_refuses_what_is_open() -> None:
    with pytest.raises(TranslationError, match="leaves something open") as caught:
        understand(TEXT, strict=True)
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
        understand(TEXT, answers={"way of ego": "upwards"})


def test_an_answer_to_no_question_is_refused_with_the_questions_that_there_are() -> None:
    with pytest.raises(InputError, match="to no question") as caught:
        understand(TEXT, answers={"way of ergo": "is headed west and turns right"})
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
    assert understand(TEXT, answers=read_answers(path)).story.actors[0].way.turn == "right"
    for wrong in ("[1]", '{"a": 1}', "{"):
        path.write_text(wrong, encoding="utf-8")
        with pytest.raises(InputError):
            read_answers(path)
