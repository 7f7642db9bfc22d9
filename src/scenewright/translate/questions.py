"""What a story leaves open: questions with alternatives and a default, their answers, and how they are kept.

What enters: stories with questions, and answers by slot. What leaves: data for a front end or a file, or the refusal of
what must be answered first. A text with its answers is reproducible: both readers take the answers and ask no more.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from scenewright.errors import InputError, Place, TranslationError
from scenewright.translate.story import Question, Story


def as_data(questions: Iterable[Question]) -> list[dict[str, Any]]:
    """Return questions as plain data, for ``--json`` and for a file to fill in."""
    return [
        {
            "slot": each.slot,
            "question": each.text,
            "words": each.quote.text if each.quote else None,
            "alternatives": list(each.alternatives),
            "default": None if each.default is None else each.alternatives[each.default],
        }
        for each in questions
    ]


def read_answers(path: Path) -> dict[str, str]:
    """Return the answers that a file holds: a JSON object, an alternative for each slot; raises `InputError`."""
    expected = '{"way of hero": "..."}'
    try:
        answers = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError("the answers cannot be read", found=str(error), expected=expected) from None
    if not isinstance(answers, dict) or not all(isinstance(each, str) for each in answers.values()):
        raise InputError("the answers are no object of texts", found=str(path), expected=expected)
    return answers


class OpenQuestionsError(TranslationError):
    """A text leaves open what must be said: the message holds the questions, and the file of answers to fill in."""

    def __init__(self, questions: Sequence[Question], place: Place | None = None) -> None:
        first = questions[0].quote
        place = replace(place, span=first.span) if place is not None and first is not None else place
        told = [f"{each.text}  {'  /  '.join(each.alternatives)}" for each in questions]
        example = {each.slot: each.alternatives[each.default or 0] for each in questions}
        super().__init__(
            "the text leaves something open",
            place=place,
            found=("\n" + " " * 12).join(told),
            expected="an answer to each",
            fix=f"say it in the text, or write what you mean to a file for --answers FILE: {json.dumps(example)}",
        )
        self.questions = tuple(questions)

    def as_dict(self) -> dict[str, object]:
        """Return the error as plain data, with the questions for a front end to ask."""
        return {**super().as_dict(), "questions": as_data(self.questions)}


def check_settled(
    story: Story, answers: Mapping[str, str], asked: Collection[str], strict: bool = False, place: Place | None = None
) -> None:
    """Raise where `story` may not be compiled: what is left open must have a default, which `strict` does not allow.

    Raises `OpenQuestionsError` where a question must be answered first, `InputError` where an answer is none to it, or
    is to none of the questions that were `asked`, by slot.
    """
    for slot in answers:
        if slot not in asked:
            expected = "; ".join(asked) or "no answers: the text leaves nothing open"
            raise InputError("an answer is to no question", found=slot, expected=expected, fix="correct its name")
    for each in story.questions:
        if each.slot in answers:  # else it would not be open
            expected = "; ".join(each.alternatives)
            raise InputError(f"this is no answer to '{each.text}'", found=answers[each.slot], expected=expected)
    waiting = [each for each in story.questions if strict or each.default is None]
    if waiting:
        raise OpenQuestionsError(waiting, place)


def defaults_of(story: Story) -> dict[str, str]:
    """Return the answers that were taken by default, by slot: what a run keeps beside its text."""
    return {each.slot: each.alternatives[each.default] for each in story.questions if each.default is not None}
