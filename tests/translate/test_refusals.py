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


def test_a_word_that_could_be_two_is_suggested() -> None:
    text = FILLED["DL"] + FILLED["W"] + "the hero stups to a stop 5 m before the conflict point."
    with pytest.raises(TranslationError) as caught:
        translate_offline(text)
    assert "stop" in str(caught.value.fix)
    assert caught.value.place is not None
    assert caught.value.place.span is not None
    assert caught.value.place.span.excerpt(text) == "stups"


@pytest.mark.parametrize(
    ("slip", "word"),
    [("braeks", "brakes"), ("brekes", "brakes"), ("intersecton", "intersection"), ("decelarates", "decelerates"),
     ("rigth", "right"), ("conflcit", "conflict")],
)  # fmt: skip
def test_a_slip_of_the_pen_is_corrected_and_said(slip: str, word: str) -> None:
    text = (
        "The ego is on the driveway at the intersection and wants to turn right. The hero travels west. When the ego "
        "is 12 m from the stop line, the hero brakes to a stop 5 m before the conflict point. Then it decelerates."
    ).replace(" Then it decelerates", "" if word != "decelerates" else " It decelerates at 3 m/s^2")
    program = translate_offline(text).program
    translation = translate_offline(text.replace(word, slip))
    assert f"'{slip}' is read as '{word}'" in translation.assumptions
    formulas = [constraint.formula for constraint in program.constraints]
    assert [constraint.formula for constraint in translation.program.constraints] == formulas


def test_a_short_word_is_not_guessed() -> None:
    text = FILLED["DL"] + FILLED["W"] + "the hero sings."
    with pytest.raises(TranslationError, match="sings"):
        translate_offline(text)
