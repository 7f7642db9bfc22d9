"""Texts in many voices: none is read wrong, what cannot be taken is refused or asked about, and nothing breaks."""

from __future__ import annotations

import random

import pytest
from readings import FILLED, all_texts, is_right, paraphrases, reading_of, to_refuse

from scenewright.translate.read.chunks import corrected
from scenewright.translate.understand import understand

CASES = paraphrases()
RIGHT = 65  # of 110, of which 1 with a question that has a default; a working set, which says nothing of other texts
BESIDE_NAMES = (
    ", which is on its way,", ", whose driver is attentive,", ", still under way,", ", by now,", ", unaware of this,",
    " (still under way)", ", which goes straight on,", ", which is not braking,", " (no turn)",
)  # fmt: skip


def test_none_is_read_wrong_and_no_fewer_are_right_than_were() -> None:
    readings = [(text, reading_of(text), expected) for text, expected in CASES]
    wrong = [text for text, reading, expected in readings if reading.program and not is_right(reading, expected)]
    assert wrong == []
    assert sum(reading.program is not None for _, reading, _ in readings) >= RIGHT


@pytest.mark.parametrize("text", to_refuse(), ids=lambda text: text[-40:].strip() or "blank")
def test_what_must_not_be_taken(text: str) -> None:
    reading = reading_of(text)
    assert reading.kind in ("refused", "asked")
    assert reading.told[0]


@pytest.mark.parametrize(
    ("slip", "word"),
    [
        ("drivway", "driveway"),
        ("intersecton", "intersection"),
        ("decelarates", "decelerates"),
        ("conflcit", "conflict"),
    ],
)
def test_a_slip_of_a_long_word_is_corrected_and_told(slip: str, word: str) -> None:
    text = "The ego turns right out of the driveway at the intersection. The hero drives west along the road. When the "
    text += "ego is 12 m from the stop line, the hero decelerates to a stop 5 m before the conflict point."
    changed, plain = reading_of(text.replace(word, slip, 1)), reading_of(text)
    assert changed.meaning == plain.meaning
    told = understand(text.replace(word, slip, 1)).story.assumptions
    assert any(slip in each and "is read with" in each for each in told)


@pytest.mark.parametrize("word", ["incoming", "interaction", "declaration", "serving", "opponents"])
def test_a_real_word_is_never_taken_for_a_slip(word: str) -> None:
    assert corrected(word) is None


def test_a_short_word_is_never_corrected() -> None:
    text = FILLED["DL"] + FILLED["W"] + "the hero {} to a stop 5 m before the conflict point."
    for word in ("breaks", "stups", "sings"):
        assert reading_of(text.format(word)).kind in ("asked", "refused")


def test_a_text_that_breaks_off_or_holds_words_of_another_is_answered() -> None:
    chance, texts = random.Random(20), all_texts()
    for text in chance.sample(texts, 12):
        words = text.split(" ")
        for end in range(1, len(words) + 1):
            reading_of(" ".join(words[:end]))
    for _ in range(300):
        words, others = chance.choice(texts).split(" "), chance.choice(texts).split(" ")
        at, other = chance.randrange(len(words)), chance.randrange(len(others))
        words[at : at + chance.randrange(3)] = others[other : other + chance.randrange(5)]
        reading_of(" ".join(words) or "Ego")


@pytest.mark.parametrize("added", BESIDE_NAMES)
def test_what_is_put_in_beside_a_name_changes_nothing_or_is_noticed(added: str) -> None:
    text = FILLED["DL"] + FILLED["W"] + "the hero brakes to a stop 5 m before the conflict point."
    base = reading_of(text)
    for name in ("The ego", "The hero", "the ego", "the hero"):
        changed = reading_of(text.replace(name, name + added, 1))
        assert changed.program is None or changed.meaning == base.meaning, (name, changed)
