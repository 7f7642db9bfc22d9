"""Moments are found again by what is so at them, and what somebody waits for comes before it goes on."""

from __future__ import annotations

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.language.read.sentences import read

WAYS = "The ego turns left out of the driveway. The hero drives west along the road. "
STOPS = WAYS + "When the ego is 12 m before the stop line, the hero stops 5 m before the conflict point. "


def test_the_same_is_one_moment_and_a_deed_may_end_at_a_stop() -> None:
    twice = "When the ego is 12 m before the stop line, the truck brakes until it comes to a stop."
    story = read(f"{STOPS}{twice}")
    assert len({deed.begins for deed in story.deeds if deed.verb == "brake"}) == 1
    (stands,) = story.moments[story.deeds[-1].ends].conditions
    assert (stands.actor, stands.amount and stands.amount.value) == (2, 0)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    "text",
    [
        "It waits until the ego has passed the conflict point. Then it drives on.",
        "Once the ego has passed the conflict point, it drives on.",
    ],
)
def test_who_waits_goes_on_after_what_it_waits_for(text: str) -> None:
    story = read(STOPS + text)
    (order,) = story.orders
    assert (order.first, order.second) == (story.ego[-1], story.deeds[-1].begins)
    assert [deed.verb for deed in story.deeds] == ["drive on", "brake", "stand still", "drive on"]


@pytest.mark.parametrize(
    "text", ["When the hero turns left, the truck brakes.", "When the bus brakes, the hero stops."]
)
def test_what_is_no_condition_or_was_not_told_is_refused(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        read(WAYS + text)
