"""The way of a text: read, put on a map, asked about, compiled; and its questions and answers as data.

What enters: a text or whatever else makes a story of one, a map, answers and somebody to ask. What leaves: an
`Understanding`: story and program, what was answered and what is open. A text with its answers is reproducible.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from scenewright.errors import InputError, Place, Span, TranslationError
from scenewright.program.limits import check_description
from scenewright.program.types import DEFAULT_MAP, Program
from scenewright.roads.load import load_map
from scenewright.roads.model import RoadMap
from scenewright.translate.compile import compile_story
from scenewright.translate.lines import Line, lines_of_program, lines_of_story
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Question, Story
from scenewright.translate.ways import put_on_map

OFFLINE = "offline"
Answers = Mapping[str, str]
Ask = Callable[[Question], str]  # returns one of the alternatives


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


@dataclass(frozen=True, slots=True)
class Understanding:
    """What was understood of a text."""

    text: str
    story: Story
    program: Program
    translator: str = OFFLINE  # who read it: "offline", "openai:NAME", "files:DIR"
    answers: Answers = field(default_factory=dict)  # that were given, by slot
    notes: tuple[str, ...] = ()  # what else is to be known of the reading: what a model took, its doubts

    @property
    def questions(self) -> tuple[Question, ...]:
        """What is open still; the default of each was taken."""
        return self.story.questions

    @property
    def all_answers(self) -> dict[str, str]:
        """The answers that were given or taken by default: with them the text gives the same program again."""
        return {**self.answers, **defaults_of(self.story)}

    @property
    def lines(self) -> tuple[Line, ...]:
        """The story in plain English beside the words it came from; its program where the story has no words."""
        try:
            return lines_of_story(self.story, self.text)
        except TranslationError:
            return lines_of_program(self.program)

    @property
    def remarks(self) -> tuple[tuple[str, str], ...]:
        """What is open, assumed, set aside as saying nothing of the test, and noted: each with which of these it is."""
        return (
            *(("open", each.with_default()) for each in self.questions),
            *(("assumed", each) for each in self.story.assumptions),
            *(("set aside", f'"{each.text}"') for each in self.story.asides),
            *(("note", each) for each in self.notes),
        )

    def as_data(self) -> dict[str, Any]:
        """Return all of it but the program as plain data."""
        return {
            "translator": self.translator,
            "understood": [{"sentence": each.sentence, "words": each.words} for each in self.lines],
            "questions": as_data(self.questions),
            "answers": self.all_answers,
            "assumptions": list(self.story.assumptions),
            "set_aside": [each.text for each in self.story.asides],
            "notes": list(self.notes),
        }


def understand(
    text: str,
    road_map: RoadMap | None = None,
    answers: Answers | None = None,
    strict: bool = False,
    name: str = "description",
    ask: Ask | None = None,
    read_with: Callable[[Answers], Story] | None = None,
) -> Understanding:
    """Return what `text`, called `name` in messages, says on a map: the one that it names itself where it does.

    `answers` are those that are known already, by slot; `ask` is asked about one open question after another. Before
    and after every answer `read_with` makes the story with those that are given: the offline reader where it is None.
    `strict` refuses what is left open even where there is a default.

    Raises `TranslationError` where it cannot be read, fits no way on the map, or leaves open what has no default;
    `InputError` where an answer is none to its question, or to no question that the text asks.

    Examples
    --------
    >>> text = "The ego drives west. The hero is oncoming. The hero brakes to a stop at its stop line."
    >>> [line.sentence for line in understand(text).lines][0]
    'The ego is headed west and goes straight on.'
    """
    check_description(text, name)
    known, given, asked = answers or {}, dict[str, str](), dict[str, Question]()
    while True:
        story = read(text, given, name) if read_with is None else read_with(given)
        on = load_map(story.map_name) if road_map is None else road_map
        if story.map_name == DEFAULT_MAP:
            story = replace(story, map_name=on.name)
        try:
            story = put_on_map(story, on, given)
        except TranslationError:
            if all(each.default is not None for each in story.questions):
                raise  # else that is asked about first
        asked |= {each.slot: each for each in story.questions}
        waiting = [each for each in story.questions if each.slot not in given]
        found = {each.slot: known[each.slot] for each in waiting if each.slot in known}
        if not found and (ask is None or not waiting):
            break
        given |= found or ({waiting[0].slot: ask(waiting[0])} if ask else {})
    check_settled(story, {**known, **given}, asked, strict, Place(name, text))
    try:
        return Understanding(text, story, compile_story(story, text), answers=given)
    except TranslationError as error:  # of something that no program says yet, in the words that say it
        if error.place is None and error.found and (at := text.find(error.found)) >= 0:
            error.place = Place(name, text, Span(at, at + len(error.found)))
        raise


# -- questions and answers ------------------------------------------------------------------------------------------
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


def defaults_of(story: Story) -> dict[str, str]:
    """Return the answers that were taken by default, by slot: what a run keeps beside its text."""
    return {each.slot: each.alternatives[each.default] for each in story.questions if each.default is not None}


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
