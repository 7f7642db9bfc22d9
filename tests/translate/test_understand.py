"""The whole way of a text, on the map that it names or is given."""

from __future__ import annotations

import pytest

from scenewright.errors import MapError, TranslationError
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.translate.story import Question
from scenewright.translate.understand import understand

TEXT = (
    "The ego drives west and goes straight on. An oncoming hero turns left into the driveway. When the ego is 25 m "
    "before the conflict point and the hero is 15 m before the conflict point, the hero brakes to a stop 8 m before it."
)


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
