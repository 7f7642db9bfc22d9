"""A sentence that is added to a good text, and that nothing can orchestrate, is never stepped over."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from scenewright.errors import TranslationError
from scenewright.study.translation import read_texts
from scenewright.translate.itineraries import default_map
from scenewright.translate.offline import translate_offline
from scenewright.translate.rules import read_by_rules

TEXTS = Path(__file__).parents[1] / "texts" / "prose.toml"
AMOUNT = re.compile(r"\b\d+(?:\.\d+)? ?(?:m|ft|yd|km/h|mph|metres|meters|yards|feet)\b(?!/)")
SENTENCE_END = re.compile(r"\. (?=[A-Z])")
ADDED = {
    "a cyclist": ". A cyclist crosses in front of it. ",
    "a chance": " in about half of the runs. ",
    "a condition": ", provided that nobody honks. ",
    "another condition": ", unless it rains. ",
    "an amount up to nothing": ", 7 m from the tree. ",
    "twice": ". It does this twice. ",
}
EVERY = 9  # of the texts
ACCEPTED = 0.03  # of such texts, by the learned reader; may only fall


@cache
def good_texts() -> list[tuple[str, str]]:
    texts = []
    for each in read_texts(TEXTS)[::EVERY]:
        try:
            read_by_rules(each.text, default_map(), each.id)
        except TranslationError:
            continue
        texts.append((each.id, each.text.strip()))
    return texts


def changed(text: str) -> Iterator[str]:
    for found in AMOUNT.finditer(text):
        yield f"{text[: found.end()]} or more{text[found.end() :]}"
        yield f"{text[: found.start()]}at least {text[found.start() :]}"


def read(text: str) -> bool:
    try:
        translate_offline(text)
    except TranslationError:
        return False
    return True


def test_there_are_texts_to_change() -> None:
    assert len(good_texts()) > 50


@pytest.mark.parametrize("added", ADDED.values(), ids=ADDED)
def test_an_addition_is_refused(added: str) -> None:
    """Where it follows the first sentence that names a vehicle, so that "it" is somebody."""
    missed = []
    for identifier, text in good_texts():
        ends = list(SENTENCE_END.finditer(text))[1:]
        missed += [
            (identifier, end.start()) for end in ends if read(f"{text[: end.start()]}{added}{text[end.end() :]}")
        ]
    assert missed == []


def test_a_third_vehicle_is_refused() -> None:
    """Told at the end, where the other two are known."""
    third = " A second van turns right out of the driveway then."
    assert [identifier for identifier, text in good_texts() if read(text + third)] == []


def test_a_bound_of_a_distance_or_a_speed_is_refused() -> None:
    missed = [(identifier, each) for identifier, text in good_texts() for each in changed(text) if read(each)]
    assert missed == []


@pytest.mark.parametrize("added", ADDED.values(), ids=ADDED)
def test_the_learned_reader_accepts_few_additions(added: str, with_the_learned_reader: None) -> None:
    tried, missed = 0, []
    for identifier, text in good_texts()[::3]:
        for end in list(SENTENCE_END.finditer(text))[1:3]:
            tried += 1
            missed += [identifier] if read(f"{text[: end.start()]}{added}{text[end.end() :]}") else []
    assert tried > 50
    assert len(missed) <= ACCEPTED * tried, missed
