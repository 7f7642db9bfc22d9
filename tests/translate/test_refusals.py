"""What is not understood is refused, with its place and its words; nothing is dropped and nothing is guessed."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from scenewright.errors import TranslationError
from scenewright.translate.offline import translate_offline

CASES = tomllib.loads(Path(__file__).with_name("refusals.toml").read_text(encoding="utf-8"))["case"]
FILLED = {
    "DL": "The ego is on the driveway and wants to turn left. The hero travels west along the road. ",
    "W": "When the ego is 12 m behind the stop line and the hero is 20 m behind the conflict point, ",
}


@pytest.mark.parametrize("case", CASES, ids=[case["text"][-45:].strip() or "blank" for case in CASES])
def test_refusal_names_the_words(case: dict[str, Any]) -> None:
    text = case["text"].format(**FILLED)
    with pytest.raises(TranslationError) as caught:
        translate_offline(text, name="mine")
    error = caught.value
    said = " ".join(filter(None, (error.message, error.found, error.expected)))
    for words in case["named"]:
        assert words in said
    assert error.exit_status == 2
    assert error.place is not None
    assert error.place.name == "mine"
    if text.strip():
        assert error.place.span is not None
        assert 0 <= error.place.span.start <= error.place.span.end <= len(text)
        assert error.found
        assert error.expected or error.fix


def test_there_are_many_refusals() -> None:
    assert len(CASES) >= 30


def test_a_misspelt_word_is_suggested() -> None:
    text = FILLED["DL"] + FILLED["W"] + "the hero brekes to a stop 5 m before the conflict point."
    with pytest.raises(TranslationError) as caught:
        translate_offline(text)
    assert "brakes" in str(caught.value.fix)
    assert caught.value.place is not None
    assert caught.value.place.span is not None
    assert caught.value.place.span.excerpt(text) == "brekes"
