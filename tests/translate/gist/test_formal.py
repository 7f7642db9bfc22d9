"""Formal turns of phrase say the same as plain ones, and hide nothing; who has a headway is behind."""

from __future__ import annotations

import pytest
from tests.translate.gist.test_inverted import meaning

from scenewright.errors import TranslationError

EGO = "The ego is on the road, 80 m before the intersection at first, heads east and turns left into the driveway. "
HERO = "The hero comes out of the driveway and turns left onto the road, heading east. "
MOMENT = "When the ego is 28 m from the conflict point and the hero is 9 m from the stop line, "
STOPS = "the hero brakes and stops 2 m before the stop line."
GOES = "the hero accelerates and passes the conflict point before the ego begins to turn."


@pytest.mark.parametrize(
    "formal",
    [
        "The decisive instant is when the ego is 28 m from the conflict point and the hero is 9 m from the stop line. "
        f"From then on {STOPS}",
        "What makes the hero yield is that the ego is 28 m from the conflict point while the hero is 9 m from the stop "
        f"line; then {STOPS}",
        "The hero does not insist on going first. " + MOMENT + STOPS,
        "Priority is left to the ego. " + MOMENT + STOPS,
        MOMENT + "the hero begins to decelerate. Its stop is complete 2 m before the stop line.",
        MOMENT + "the hero relents: it brakes and stops 2 m before the stop line.",
        "When the ego is 28 m from the conflict point and the hero is 9 m from the stop line, the hero is braked until "
        "it does not move any more, 2 m before the stop line.",
    ],
)
def test_yielding(formal: str) -> None:
    assert meaning(EGO + HERO + formal) == meaning(EGO + HERO + MOMENT + STOPS)


@pytest.mark.parametrize(
    "formal",
    [
        "The priority of the ego is not respected. " + MOMENT + GOES,
        "The hero denies the ego the priority to which it is entitled. " + MOMENT + GOES,
        "The hero refuses priority to the ego. " + MOMENT + GOES,
        MOMENT
        + "the hero, contrary to its obligation to give way, accelerates and passes the conflict point before the "
        "ego begins to turn.",
        MOMENT + "the hero accelerates, and before the ego begins to turn the hero has passed the conflict point.",
        MOMENT + "the hero accelerates and passes the conflict point. The ego does not begin to turn until after that.",
    ],
)
def test_going_first(formal: str) -> None:
    assert meaning(EGO + HERO + formal) == meaning(EGO + HERO + MOMENT + GOES)


@pytest.mark.parametrize(
    "contradicted",
    [
        "The hero does not insist on going first. " + MOMENT + GOES,
        "Priority is left to the ego. " + MOMENT + GOES,
        "The hero denies the ego the priority to which it is entitled. " + MOMENT + STOPS,
        "Shortly before the ego is 28 m from the conflict point, with the hero 9 m from the stop line, " + STOPS,
        MOMENT.replace("28 m from", "nearly at") + STOPS,
        MOMENT + STOPS + " Standing there at a steady 2 m/s, it lets the ego turn, and then drives on.",
    ],
)
def test_nothing_is_hidden(contradicted: str) -> None:
    with pytest.raises(TranslationError):
        meaning(EGO + HERO + contradicted)


BOTH = "The ego and the hero drive east, straight on. "
BRAKES = " is 2 s, the hero brakes at 3 m/s^2 to a stop."


@pytest.mark.parametrize(
    "order",
    ["The ego is preceded by the hero.", "The hero is followed by the ego.", "The ego follows.", "The hero leads."],
)
@pytest.mark.parametrize("measure", ["the ego's headway to the hero", "the time gap of the ego to the hero"])
def test_who_has_a_headway_is_behind(order: str, measure: str) -> None:
    assert "headway(A0, A1, t1) == 2" in meaning(f"{BOTH}{order} When {measure}{BRAKES}")[1]


@pytest.mark.parametrize(
    "order", ["The hero is preceded by the ego.", "The ego is followed by the hero.", "The ego leads."]
)
@pytest.mark.parametrize("measure", ["the ego's headway to the hero", "the time gap of the ego to the hero"])
def test_who_is_in_front_has_no_headway_to_the_other(order: str, measure: str) -> None:
    with pytest.raises(TranslationError):
        meaning(f"{BOTH}{order} When {measure}{BRAKES}")


@pytest.mark.parametrize("whose", ["my lorry", "my tipper"])
def test_mine_is_the_hero_where_i_am(whose: str) -> None:
    """What is mine is the ego, but not where I drive the other one."""
    text = (
        f"We both come down the driveway and turn right to go west: I am the hero, in front, in {whose}, and the ego "
        "is behind me. When the ego is 9 m behind me, I brake at 3 m/s^2 to a stop."
    )
    assert "gap(A0, A1, t1) == 9" in meaning(text)[1]


def test_it_after_a_gap_may_be_either() -> None:
    text = f"{BOTH}The ego follows the hero. When the ego is 15 m behind the hero and it is 25 m from the stop line,"
    with pytest.raises(TranslationError):
        meaning(f"{text} the hero brakes at 3 m/s^2 to a stop.")


@pytest.mark.parametrize(
    "formal",
    [
        "When both vehicles are near the conflict point, namely the ego 28 m and the hero 12 m behind it, " + STOPS,
        "The ego reaching 28 m from the conflict point, with the hero 12 m from "
        "the conflict point, causes the hero to begin braking. It stops 2 m before the stop line.",
        "In the first phase, which begins when the ego is 28 m from the conflict point and the hero is 12 m from the "
        f"conflict point, {STOPS}",
        "When the ego is 28 m from the conflict point and the hero is 12 m from the conflict point, the hero begins to "
        "brake. At 2 m before the stop line it comes to a complete stop.",
        "Being 12 m from the conflict point when the ego is 28 m from the conflict point, the hero yields from that "
        "moment on. It stops 2 m before the stop line.",
    ],
)
def test_moments(formal: str) -> None:
    plain = "When the ego is 28 m from the conflict point and the hero is 12 m from the conflict point, "
    assert meaning(EGO + HERO + formal) == meaning(EGO + HERO + plain + STOPS)


@pytest.mark.parametrize(
    "way",
    [
        "Wanting to turn left into the driveway, the ego drives eastbound on the road and is at first 80 m before the "
        "intersection. ",
        "The ego, wanting to turn left into the driveway, drives eastbound on the road and is at first 80 m before the "
        "intersection. ",
        "The ego goes eastbound along the road until it turns left into the driveway, and at the start it is 80 m "
        "before the intersection. ",
    ],
)
def test_the_road_is_where_it_comes_from_where_it_turns_into_the_driveway(way: str) -> None:
    assert meaning(way + HERO + MOMENT + STOPS) == meaning(EGO + HERO + MOMENT + STOPS)


@pytest.mark.parametrize(
    "told",
    [
        f"{EGO}{HERO}At the trigger instant 28 m remain from the ego to the conflict point and 9 m from the "
        f"hero to the stop line. From then on {STOPS}",
        f"{EGO}{HERO}When 28 m and 9 m are the remaining distances of the ego to the conflict point and of the"
        f" hero to the stop line respectively, {STOPS}",
        f"{EGO}{HERO}The moment the two are 28 m from the conflict point (ego) and 9 m from the stop line "
        f"(hero), {STOPS}",
        f"{EGO}{HERO}28 m before the conflict point for the ego, and at the same time 9 m before the stop line"
        f" for the hero, {STOPS}",
        "The simulator shall place the ego eastbound on the road, 80 m before the intersection, and route it "
        f"left into the driveway. {HERO}{MOMENT}{STOPS}",
        "The ego's left turn from the eastbound road into the driveway is crossed by a hero which comes out "
        "of the driveway and turns left onto the road, heading east. Initially the ego is 80 m before the "
        f"intersection. {MOMENT}{STOPS}",
        "A left turn from the eastbound road into the driveway is assigned to the ego, at an initial distance"
        f" of 80 m from the intersection. {HERO}{MOMENT}{STOPS}",
        f"{EGO}The hero is not to enter the road yet: coming out of the driveway for a left turn, to go east, "
        f"it yields. {MOMENT}{STOPS}",
        f"{EGO}The hero is right now on the driveway and wants to turn left onto the road, heading east. "
        f"{MOMENT}{STOPS}",
        f"{EGO}{HERO}We seek evidence that normal giving way does not confuse the system. {MOMENT}{STOPS}",
    ],
)
def test_told_formally(told: str) -> None:
    assert meaning(told) == meaning(EGO + HERO + MOMENT + STOPS)


@pytest.mark.parametrize(
    "again",
    [
        "Then it accelerates, and completion of the hero's turn takes place before the ego begins to turn.",
        "Departure from this stop, with acceleration, follows; the hero is at the end of its turn before the "
        "ego begins to turn.",
        "After having stood there it accelerates and completes its turn before the ego begins to turn.",
    ],
)
def test_going_on_after_a_stop(again: str) -> None:
    plain = "Then it accelerates and completes its turn before the ego begins to turn."
    assert meaning(f"{EGO}{HERO}{MOMENT}{STOPS} {again}") == meaning(f"{EGO}{HERO}{MOMENT}{STOPS} {plain}")


def test_who_keeps_one_speed_to_the_end_does_not_brake() -> None:
    stops = STOPS.replace("hero", "hero, which keeps one and the same speed from the first moment to the last,")
    with pytest.raises(TranslationError):
        meaning(EGO + HERO + MOMENT + stops)
