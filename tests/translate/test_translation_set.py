"""The translation set that the project ships: read right or refused, never read wrong without a word."""

from __future__ import annotations

import tomllib
from collections import Counter
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

from scenewright.errors import TranslationError
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.study.translation import Asking, measure, read_texts
from scenewright.translate.offline import translate_offline

FOLDER = files("scenewright.study") / "translation_set"
BAD = ("silently wrong", "wrongly accepted", "unanswered")


def rows(name: str) -> list[dict[str, Any]]:
    return list(tomllib.loads((FOLDER / name).read_text(encoding="utf-8"))["text"])


def meaning(program: Program) -> tuple[object, ...]:
    actors = tuple((actor.route, actor.sketch) for actor in program.actors)
    return actors, frozenset(constraint.formula for constraint in program.constraints)


def reading_of(text: str) -> Asking:
    return Asking(translate_offline(text).program)


def outcome(row: dict[str, Any]) -> str:
    try:
        program = translate_offline(row["text"]).program
    except TranslationError:
        return "refused"
    if "refuse" in row:
        return "accepted"
    return "right" if meaning(program) == meaning(parse_program(row["program"])) else "wrong"


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("voices.toml", 0.9),
        ("taxonomy.toml", 1.0),
        ("phrases.toml", 0.9),
        ("fresh_moments.toml", 0.8),
    ],
)
def test_texts_are_read_right_or_refused(name: str, least: float) -> None:
    outcomes = {row["id"]: outcome(row) for row in rows(name)}
    assert [identifier for identifier, what in outcomes.items() if what == "wrong"] == []
    assert Counter(outcomes.values())["right"] >= least * len(outcomes)


@pytest.mark.parametrize(
    ("name", "least"),
    [
        ("paper_kind.toml", 1.0),
        ("free_prose.toml", 0.8),
        ("free_notes.toml", 0.5),
        ("free_stories.toml", 0.2),
        ("traps.toml", 0.0),
    ],
)
def test_free_texts_mean_the_same_or_are_refused(name: str, least: float) -> None:
    """Written freely, one motion has many programs; and what looks suspicious may be sound: meaning decides."""
    texts = read_texts(Path(str(FOLDER / name)))
    outcomes = {each.text.id: each.outcome for each in measure(texts, reading_of, Z3Backend())}
    assert {identifier: each for identifier, each in outcomes.items() if each in BAD} == {}
    assert Counter(outcomes.values())["right"] >= least * len(outcomes)
    assert len(outcomes) >= 40


def test_what_cannot_be_meant_is_refused() -> None:
    refusals = rows("refusals.toml")
    assert [row["id"] for row in refusals if outcome(row) != "refused"] == []
    reasons = {row["refuse"] for row in refusals}
    assert {"contradictory", "impossible geometry", "off-topic", "foreign language"} <= reasons


def test_every_row_of_the_taxonomy_is_there() -> None:
    assert [row["id"] for row in rows("taxonomy.toml")] == [f"row-{number:02d}" for number in range(1, 81)]


def test_every_text_has_a_name_of_its_own() -> None:
    every = [row["id"] for each in FOLDER.iterdir() if each.name.endswith(".toml") for row in rows(each.name)]
    assert len(every) == len(set(every)) >= 1600


def test_actions_in_other_words_are_read_right() -> None:
    texts = rows("fresh_actions.toml")
    outcomes = {row["id"]: (outcome(row), "refused" if "refuse" in row else "right") for row in texts}
    assert {identifier: each for identifier, each in outcomes.items() if each[0] != each[1]} == {}
    assert len(outcomes) == len(texts)


@pytest.mark.parametrize("name", sorted(each.name for each in FOLDER.iterdir() if each.name.startswith("widened_")))
def test_constructions_and_what_is_close_to_them(name: str) -> None:
    texts = rows(name)
    outcomes = {row["id"]: (outcome(row), "refused" if "refuse" in row else "right") for row in texts}
    assert {identifier: each for identifier, each in outcomes.items() if each[0] != each[1]} == {}
    assert len(outcomes) == len(texts)
