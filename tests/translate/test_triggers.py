"""Moments, amounts and conditions: texts about them are read right or refused, and amounts stay with their vehicle."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.lexicon import alternatives
from scenewright.translate.offline import translate_offline

START = "The ego leaves the driveway and turns right. The hero drives west along the road. "
DEED = "the hero brakes to a stop 5 m before the conflict point."
DEALT = {"A0x(t1) == conflict_point - 12", "A1x(t1) == conflict_point - 30"}


def formulas(text: str) -> set[str]:
    return {print_expression(each.formula) for each in translate_offline(text).program.constraints}


@pytest.mark.parametrize(
    "when",
    [
        "With 12 m left for the ego and 30 m for the hero, each measured to the conflict point, ",
        "With 30 m left for the hero and 12 m for the ego, each measured to the conflict point, ",
        "At distances of 12 m (ego) and 30 m (hero) from the conflict point, ",
        "When the distances of the ego and the hero to the conflict point are 12 m and 30 m, ",
        "When the distances of the hero and the ego to the conflict point are 30 m and 12 m, ",
        "At a distance to the conflict point of 12 m for the ego and of 30 m for the hero, ",
        "When the conflict point is 30 m ahead of the hero and 12 m ahead of the ego, ",
        "The ego being 12 m and the hero 30 m from the conflict point, ",
    ],
)
def test_amounts_go_to_the_vehicle_they_are_dealt_to(when: str) -> None:
    assert formulas(START + when + DEED) >= DEALT


@pytest.mark.parametrize(
    "when",
    [
        "With 12 m left for the ego and 30 m for the ego, each measured to the conflict point, ",
        "With 12 m left for the ego and 30 m for the hero, each measured to its stop line, ",
        "At 2 s for the ego and 30 m for the hero, both to the conflict point, ",
        "When the distances to the conflict point are 12 m and 30 m, ",
        "When the ego is 12 m from its stop line and 30 m from the conflict point, ",
    ],
)
def test_amounts_that_are_nobodys_are_refused(when: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(START + when + DEED)


def test_alternatives_in_the_lexicon() -> None:
    assert alternatives("no choice") == ["no choice"]
    assert alternatives("(a|b|) c (d|e)") == ["a c d", "a c e", "b c d", "b c e", "c d", "c e"]
