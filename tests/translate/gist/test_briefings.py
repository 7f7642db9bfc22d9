"""Briefings and test plans: "you" who drive the ego, questions with answers, who is placed where, drivers of "
"vehicles."""

from __future__ import annotations

import pytest
from tests.translate.gist.test_inverted import meaning

from scenewright.errors import TranslationError

EGO = "The ego is eastbound on the road, 70 m before the intersection at first, and turns left into the driveway."
HERO = "A van comes west on the road and goes straight on."
MOMENT = "When the ego is 24 m and the van is 30 m before the conflict point,"
STOPS = "the van brakes and stops 5 m before the conflict point."
GOES = "the van accelerates and passes the conflict point before the ego begins to turn."
PLAIN = f"{EGO} {HERO} {MOMENT} {STOPS}"
YOU = "You are eastbound on the road, 70 m before the intersection at first, and turn left into the driveway."
WHEN_YOU = "When you are 24 m and the van is 30 m before the conflict point,"


@pytest.mark.parametrize(
    "who", ["You are in the car under test.", "You are the ego.", "(You = the SUT.)", "You drive the car being tested."]
)
def test_you_drive_the_ego(who: str) -> None:
    assert meaning(f"{who} {YOU} {HERO} {WHEN_YOU} {STOPS}") == meaning(PLAIN)
    assert meaning(f"{who} {YOU} {HERO} {WHEN_YOU} it brakes and stops 5 m before the conflict point.") == meaning(
        PLAIN
    )


@pytest.mark.parametrize(
    "told",
    [
        f"Car A is under test and comes west. You are in car B. {YOU} {WHEN_YOU} brake and stop 5 m before the "
        f"conflict point.",
        f"You are the ego. {YOU} {HERO} {WHEN_YOU} you brake and stop 5 m before the conflict point.",
    ],
)
def test_you_are_not_just_anybody(told: str) -> None:
    with pytest.raises(TranslationError):
        meaning(told)


def test_questions_and_answers() -> None:
    told = (
        "Who is under test? The estate, eastbound, turning left into the driveway. Who is the opponent? A van, "
        "westbound, "
        "going straight on. Where is the estate at first? It is 70 m before the intersection. When does the van "
        "react? When "
        f"the estate is 24 m and the van is 30 m before the conflict point. What then? {STOPS}"
    )
    assert meaning(told) == meaning(PLAIN)


@pytest.mark.parametrize(
    ("plain", "said"),
    [
        ("The ego is eastbound", "The driver of the ego vehicle is eastbound"),
        ("A van comes", "The driver of the hero vehicle, a van, comes"),
        ("the van brakes and stops", "the van yields: it brakes and stops"),
        (
            f"{MOMENT} the van",
            "Let both drive until the ego is 24 m and the van is 30 m before the conflict point. Then it",
        ),
        (
            f"{MOMENT} the van",
            "The ego is 24 m and the van is 30 m before the conflict point: that's the trigger. Then the van",
        ),
        (
            f"{MOMENT} the van",
            "24 m before the conflict point for the ego, and at the same time 30 m before it for the van, the van",
        ),
    ],
)
def test_said_another_way(plain: str, said: str) -> None:
    assert plain in PLAIN
    assert meaning(PLAIN.replace(plain, said, 1)) == meaning(PLAIN)


def test_a_bracket_between_a_name_and_its_verb() -> None:
    told = f"{EGO} {HERO} {MOMENT} {GOES}"
    assert meaning(told.replace("the ego begins", "the ego (from the road, eastbound) begins")) == meaning(told)
    with pytest.raises(TranslationError):
        meaning(told.replace("the ego begins", "the ego (if it is not too slow) begins"))


def test_our_own_position_is_not_the_other_ones() -> None:
    told = meaning(
        "We are eastbound and go straight on. A van comes out of the driveway and turns left. It brakes when we are "
        "40 m "
        "from the conflict point and the van is 20 m from the stop line. It stops 3 m before the stop line, "
        "accelerates "
        "and passes the conflict point before we pass the conflict point. Our initial position is 80 m from the "
        "intersection."
    )
    assert "A0x(t0) == intersection - 80" in told[1]


def test_who_is_seen_is_the_one_that_goes_straight() -> None:
    told = meaning(
        "A minivan on the driveway, wanting to turn left, sees the AV coming along the road, westbound and going "
        "straight, "
        "and yields: it brakes when the AV is 40 m from the conflict point and it is 20 m from the stop line, and "
        "stops 1 m "
        "before the stop line."
    )
    assert told[0] == [("W",), ("S", "E")]


LINE = (
    "The ego goes straight on, eastbound, 80 m from the intersection at first. A van in the driveway is to turn left. "
    "It starts braking when the ego is 40 m from the conflict point and it is 20 m from the stop line, and it stops "
)


def test_a_stop_at_the_line_spoken_of() -> None:
    assert "A1x(t2) == stop_line" in meaning(f"{LINE}at that line.")[1]


@pytest.mark.parametrize("where", ["there", "right there", "here", "at that spot", "at this point"])
def test_there_is_no_place(where: str) -> None:
    with pytest.raises(TranslationError):
        meaning(f"{LINE}{where}.")
    assert "A1x(t2) == stop_line - 2" in meaning(f"{LINE}2 m before the stop line. It stops {where}.")[1]
