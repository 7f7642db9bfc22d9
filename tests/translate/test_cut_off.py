"""A text that breaks off, or holds a part of another one, is read or refused: no reader fails in any other way."""

from __future__ import annotations

import random
import tomllib
from pathlib import Path

import pytest

from scenewright.errors import TranslationError
from scenewright.translate.offline import translate_offline

CASES = tomllib.loads(Path(__file__).with_name("paraphrases.toml").read_text(encoding="utf-8"))["case"]
TEXTS = [case["text"] for case in CASES]


def is_answered(text: str) -> bool:
    """Whether a text is translated or refused with a place and what was found; anything else is raised."""
    try:
        return bool(translate_offline(text).program.constraints)
    except TranslationError as error:
        return bool(error.message)


@pytest.mark.parametrize("number", range(0, len(TEXTS), len(TEXTS) // 12))
def test_broken_off_anywhere(number: int) -> None:
    words = TEXTS[number].split(" ")
    assert all(is_answered(" ".join(words[:end])) for end in range(1, len(words) + 1))


@pytest.mark.parametrize(
    "text", ["Ego", "Ego and hero", "The AV and the agent", "The VUT drives", "* ego 50 m before the", "When", "the"]
)
def test_hardly_anything(text: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(text)


@pytest.mark.parametrize("seed", range(60))
def test_words_lost_moved_or_put_in(seed: int) -> None:
    chosen = random.Random(seed)
    words, others = chosen.choice(TEXTS).split(" "), chosen.choice(TEXTS).split(" ")
    at, other = chosen.randrange(len(words)), chosen.randrange(len(others))
    words[at : at + chosen.randrange(3)] = others[other : other + chosen.randrange(5)]
    assert is_answered(" ".join(words) or "Ego")
