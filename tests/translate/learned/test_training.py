"""What the training makes of good texts: the same meaning in other words, or something that has to be refused."""

from __future__ import annotations

import random
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from scenewright.program.text import parse_program
from scenewright.translate.learned.network import load_network
from scenewright.translate.learned.pieces import cut

TOOL = Path(__file__).parents[3] / "tools" / "train_reader"
TEXTS = Path(__file__).parents[1] / "texts" / "paper_kind.toml"
NETWORK = load_network()
PIECES = {number: piece for piece, number in NETWORK.vocabulary.items()}


@pytest.fixture(scope="module")
def lesson(training: tuple[ModuleType, ModuleType]) -> Any:
    lessons, _ = training
    stories = [(story["sketch"], *story["constraints"]) for story in NETWORK.meanings["stories"]]
    examples = []
    for row in tomllib.loads(TEXTS.read_text(encoding="utf-8"))["text"][:120]:
        rest, amounts = lessons.amounts_in(row["text"], row["id"])
        pieces = cut(rest, amounts, NETWORK.vocabulary)
        example = lessons.Example(row["id"], list(pieces.numbers), list(pieces.marks))
        told = [lessons.value_of(each) for each in amounts]
        meant = lessons.meant_by(parse_program(row["program"]), told)
        lessons.answer(example, meant, told, stories, NETWORK.meanings["parts"])
        examples.append(example)
    return lessons.Lesson(examples, list(NETWORK.vocabulary), [], stories, NETWORK.meanings["parts"])


@pytest.fixture
def changer(training: tuple[ModuleType, ModuleType], lesson: Any) -> Any:
    _, changes = training
    told = tomllib.loads((TOOL / "changes.toml").read_text(encoding="utf-8"))
    return changes.Changer(told, lesson, random.Random(4))


def words(example: Any) -> list[str]:
    return [PIECES[number] for number in example.numbers]


def test_nearly_all_texts_can_be_taught(lesson: Any) -> None:
    assert sum(example.sayable for example in lesson.examples) > 0.9 * len(lesson.examples)


def test_a_better_text_has_its_amounts_where_they_are(lesson: Any, changer: Any) -> None:
    changed = 0
    for example in lesson.examples * 8:
        better = changer.better(example)
        changed += better.numbers != example.numbers
        assert [words(better)[mark] for mark in better.marks] == [words(example)[mark] for mark in example.marks]
        assert (better.sayable, better.parts, better.story) == (example.sayable, example.parts, example.story)
    assert changed > 50


def test_a_worse_text_is_another_one_and_has_to_be_refused(lesson: Any, changer: Any) -> None:
    spoilt = [(example, worse) for example in lesson.examples * 4 if (worse := changer.worse(example)) is not None]
    assert len(spoilt) > 200
    for example, worse in spoilt:
        assert not worse.sayable
        assert worse.numbers != example.numbers
        assert (worse.numbers[0], worse.numbers[-1]) == (example.numbers[0], example.numbers[-1])


def test_claims_fit_or_contradict(lesson: Any, changer: Any) -> None:
    for example in lesson.examples:
        right, wrong = changer._claims(example)
        assert not set(right) & set(wrong)
