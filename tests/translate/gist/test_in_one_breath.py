"""Texts without marks, steps without full stops, and what people put in between."""

from __future__ import annotations

import pytest
from tests.translate.gist.test_inverted import meaning

from scenewright.errors import TranslationError

EGO = (
    "The ego drives west on the road, 80 m before the intersection at the start, and wants to turn right into the "
    "driveway."
)
HERO = "The hero comes the other way, so it drives east, and wants to turn left into the driveway."
MOMENT = "When the ego is 28 m from the conflict point and the hero is 24 m from the conflict point,"
DEED = "the hero brakes and comes to a stop 7 m before the conflict point."
PLAIN = f"{EGO} {HERO} {MOMENT} {DEED}"
SPEED = "The hero comes the other way, so it drives east, starting at 9 m/s, and wants to turn left into the driveway."


def in_one_breath(text: str) -> str:
    return text.replace(".", "").replace(",", "").lower().replace("at the start and", "at the start and it")


@pytest.mark.parametrize("joined", ["", "and then ", "so ", "okay now "])
def test_dictated(joined: str) -> None:
    assert meaning(in_one_breath(f"{EGO} {HERO} {joined}{MOMENT} {DEED}")) == meaning(PLAIN)


def test_a_speed_of_the_start_in_one_breath() -> None:
    told = meaning(in_one_breath(f"{EGO} {SPEED} {MOMENT} {DEED}"))
    assert told == meaning(f"{EGO} {SPEED} {MOMENT} {DEED}")
    assert "A1v(t0) == 9" in told[1]


@pytest.mark.parametrize("indent", ["", "  "])
@pytest.mark.parametrize("title", ["", "Scenario: the other one gives way\n"])
def test_steps(indent: str, title: str) -> None:
    steps = (
        "Given the ego drives west on the road, 80 m before the intersection, about to turn right into the driveway",
        "And the hero drives east on the road, about to turn left into the driveway",
        "When the ego is 28 m from the conflict point",
        "And the hero is 24 m from the conflict point",
        "Then the hero brakes",
        "And it stops 7 m before the conflict point",
    )
    assert meaning(title + "\n".join(indent + step for step in steps)) == meaning(PLAIN)


@pytest.mark.parametrize("moment", ["As soon as", "Once", "The moment", "At the very moment when"])
def test_steps_with_another_word_for_when(moment: str) -> None:
    """The second line of the moment was read as one of the start."""
    steps = (
        "Given the ego drives west on the road, 80 m before the intersection, about to turn right into the driveway",
        "And the hero drives east on the road, about to turn left into the driveway",
        f"{moment} the ego is 28 m from the conflict point",
        "And the hero is 24 m from the conflict point",
        "Then the hero brakes",
        "And it stops 7 m before the conflict point",
    )
    assert meaning("\n".join(steps)) == meaning(PLAIN)


@pytest.mark.parametrize(
    ("plain", "said"),
    [
        ("The ego drives", "You know when somebody in front takes ages? The ego drives"),
        ("The ego drives", "It shall be demonstrated that the ego does not panic. The ego drives"),
        ("The ego drives", "It is to be shown that the ego copes with a car that gives way. The ego drives"),
        ("The ego drives", "The ego's reaction to a car that stops is under test. The ego drives"),
        ("The ego drives", "We consider two vehicles whose ways merge. The ego drives"),
        ("before the conflict point.", "before the conflict point. TODO: ask about the antenna."),
        ("the hero brakes and comes", "the hero does what one would expect of a careful driver and brakes, and comes"),
        ("before the conflict point.", "before the conflict point, as it is obliged to."),
        ("before the conflict point.", "before the conflict point and that's it."),
        ("before the conflict point.", "before the conflict point. Does the ego cope?"),
        ("a stop 7 m", "a stop a mere 7 m"),
    ],
)
def test_asides(plain: str, said: str) -> None:
    assert plain in PLAIN
    assert meaning(PLAIN.replace(plain, said, 1)) == meaning(PLAIN)


@pytest.mark.parametrize(
    ("plain", "said"),
    [
        ("drives east,", "drives east at 9 m/s throughout,"),
        ("drives east,", "drives east at a constant 9 m/s the whole time,"),
        ("before the conflict point.", "before the conflict point. Does the hero stop there, or drive on?"),
        ("before the conflict point.", "before the conflict point as long as the ego needs."),
        ("the hero brakes", "instead of yielding, the hero brakes"),
        ("drives east,", "drives east at a constant hero_speed_mps throughout,"),
        ("The hero comes", "Like the ego, the hero starts 80 m before the intersection. It comes"),
        ("The ego drives", "It shall be shown that the ego copes with a hero that does not yield. The ego drives"),
        ("The ego drives", "The ego's reaction to a hero that accelerates is under test. The ego drives"),
        ("The ego drives", "It shall be shown that the ego copes with a car waiting in the driveway. The ego drives"),
        ("The ego drives", "Remember the hero that never brakes? The ego drives"),
        ("The ego drives", "We consider two vehicles whose ways meet 8 m before the intersection. The ego drives"),
        ("before the conflict point.", "before the conflict point. NB: the hero never brakes."),
    ],
)
def test_what_matters_is_not_set_aside(plain: str, said: str) -> None:
    assert plain in PLAIN
    with pytest.raises(TranslationError):
        meaning(PLAIN.replace(plain, said, 1))


def test_he_is_whoever_was_spoken_of_where_the_ego_is_a_person() -> None:
    told = meaning(
        "Our insured, whose car is the ego, was driving west and meant to go straight on; at the start he was 90 m "
        "from the intersection. The third party was driving east and wanted to turn left into the driveway. When our "
        "insured was 34 m and the third party 18 m from the conflict point, the third party braked to a stop 6 m "
        "before it."
    )
    assert told[0] == [("W",), ("E", "N")]
    assert "A0x(t0) == intersection - 90" in told[1]


def test_a_speed_within_the_condition_is_one_of_the_trigger() -> None:
    moment = "When the ego is 28 m from the conflict point and the hero has 24 m left to it and is doing 9 m/s,"
    assert "A1v(t1) == 9" in meaning(f"{EGO} {HERO} {moment} {DEED}")[1]
