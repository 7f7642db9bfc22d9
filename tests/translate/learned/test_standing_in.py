"""The network stands in where rules do not know the words, and against them where it is sure of something else."""

from __future__ import annotations

import random
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from scenewright.errors import TranslationError, UnknownWordsError
from scenewright.program.printer import print_expression
from scenewright.program.text import parse_program
from scenewright.study.meaning import differences
from scenewright.translate import offline
from scenewright.translate.itineraries import default_map
from scenewright.translate.learned.reader import Likely, read_likely
from scenewright.translate.model.settings import TranslatorSettings
from scenewright.translate.offline import translate_offline
from scenewright.translate.rules import read_by_rules
from scenewright.translate.sources import read_scenario
from scenewright.translate.translation import refuse_two_ways

KNOWN = (
    "Ego is on the driveway exit, 30 m behind the stop line, and wants to turn left onto the road travelling "
    "eastbound. "
    "The hero vehicle is on the road and goes straight on, westbound. When the ego is 12 m behind the stop line and "
    "the hero vehicle is 25 m behind the conflict point, the hero vehicle begins to decelerate to a complete stop at "
    "6 m behind the conflict point."
)
FREE = (
    "My uncle drives a lorry, and he is a patient man. He is on the main road now, heading west, with no turn to make. "
    "Out of the driveway comes the ego, which is to turn left and go off eastward. When the ego is 1.9 seconds from "
    "the stop line, and my uncle's lorry 4.2 seconds from the conflict point, he starts to brake, and he brings the "
    "lorry to a complete stop twelve metres before the conflict point."
)
STRANGE = KNOWN.replace("begins to decelerate to a complete stop", "sheds its momentum until it has ceased to roll")


OTHER = """
Actor 0:
- S, E
- [t0, go, t1, go, t2]
Actor 1:
- E
- [t0, go, t1, dec, t2]
Constraints:
A1v(t2) == 0
"""


def sure(likely: Likely | None, probability: float = 1.0, sayable: float = 1.0) -> Likely:
    assert likely is not None
    return replace(likely, probability=probability, sayable=sayable)


def pretend(monkeypatch: pytest.MonkeyPatch, likely: Likely | None) -> None:
    monkeypatch.setattr(offline, "read_likely", lambda *_: likely)


def test_rules_do_not_know_the_strange_words() -> None:
    with pytest.raises(UnknownWordsError):
        read_by_rules(STRANGE, default_map(), "strange")


def test_strange_words_are_read_by_likeness_and_this_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(STRANGE, "strange", default_map()), 0.97))
    read = translate_offline(STRANGE)
    assert differences(translate_offline(KNOWN).program, read.program) == []
    (assumed,) = read.assumptions
    assert "97 %" in assumed.replace("97%", "97 %")
    assert "ceased" in assumed or "momentum" in assumed  # what was not understood is named
    assert {reading.confidence for reading in read.readings} == {0.4}


def test_who_is_not_sure_does_not_stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(STRANGE, "strange", default_map()), offline.SURE_ENOUGH_TO_READ - 0.01))
    with pytest.raises(UnknownWordsError):
        translate_offline(STRANGE)


def test_nobody_stands_in_for_what_is_known_to_be_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(KNOWN, "known", default_map())))
    with pytest.raises(TranslationError, match="cannot be orchestrated"):
        translate_offline(f"{KNOWN} It does this twice.")


def test_strict_refuses_what_is_read_by_likeness(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(STRANGE, "strange", default_map())))
    read_scenario(STRANGE)
    with pytest.raises(TranslationError, match="leaves something open"):
        read_scenario(STRANGE, settings=TranslatorSettings(strict=True))


def test_another_meaning_that_is_sure_is_two_meanings(monkeypatch: pytest.MonkeyPatch) -> None:
    likely = sure(read_likely(FREE, "free", default_map()))
    other = parse_program(OTHER)
    pretend(monkeypatch, replace(likely, program=other))
    with pytest.raises(TranslationError, match="two ways"):
        translate_offline(FREE)
    assert translate_offline(KNOWN).program.actor(1).route != other.actor(1).route  # every word of it is accounted for
    pretend(monkeypatch, replace(likely, program=other, probability=0.5))
    assert translate_offline(FREE).program.actor(1).route == likely.program.actor(1).route


def test_another_amount_that_is_sure_is_two_meanings(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(FREE.replace("twelve", "thirteen"), "other", default_map())))
    with pytest.raises(TranslationError, match="two ways") as refused:
        translate_offline(FREE)
    assert refused.value.found == "A1x(t2) == conflict_point - 12"


def test_what_surely_cannot_be_said_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(KNOWN, "known", default_map()), 0.0, 0.001))
    with pytest.raises(TranslationError, match="no program can say"):
        translate_offline(FREE)
    assert translate_offline(KNOWN).program == read_by_rules(KNOWN, default_map(), "description").program


def test_what_is_the_same_is_no_doubt(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, sure(read_likely(FREE, "free", default_map())))
    read = translate_offline(FREE)
    assert [print_expression(each.formula) for each in read.program.constraints][-1] == "A1v(t2) == 0"
    assert read.assumptions == read_by_rules(FREE, default_map(), "free").assumptions


def test_places_that_the_routes_do_not_have_are_refused() -> None:
    text = KNOWN.replace(
        "turn left onto the road travelling eastbound", "turn right onto the road travelling westbound"
    )
    with pytest.raises(TranslationError, match="no conflict point"):
        translate_offline(text.replace("straight on, westbound", "straight on, eastbound"))


def test_one_meaning_is_never_two() -> None:
    """Where both mean the same, they also write it in the same way: no text is refused for how it is written."""
    rows = tomllib.loads((Path(__file__).parents[1] / "texts" / "prose.toml").read_text(encoding="utf-8"))["text"]
    compared, refused = 0, []
    for row in random.Random(8).sample(rows, 80):
        try:
            read = read_by_rules(row["text"], default_map(), row["id"]).program
        except TranslationError:
            continue
        likely = read_likely(row["text"], row["id"], default_map())
        if likely is None or differences(read, likely.program):
            continue
        compared += 1
        try:
            refuse_two_ways(read, likely.program, row["text"], row["id"], "one meaning")
        except TranslationError as error:
            refused.append((row["id"], error.found))
    assert compared > 40
    assert refused == []
