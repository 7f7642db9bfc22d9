"""Moments that a text names: events, the order of two of them, and what holds from one until another."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.translate import story as st
from scenewright.translate.read.sentences import read

SCENE = "The ego turns left out of the driveway. The hero drives west along the road. "
BRAKES = f"{SCENE}When the ego is 12 m before the stop line, the hero brakes to a stop. "


def test_an_order_is_between_two_moments_with_its_margin() -> None:
    orders = read(f"{BRAKES}The ego passes the stop line at least 2 s after the hero begins to brake.").orders
    assert [(each.op, each.margin and each.margin.si) for each in orders] == [(">=", 2)]


@pytest.mark.parametrize(
    ("said", "fault", "found"),
    [
        (
            "It drives on and passes the conflict point before the ego, at 12 m/s.",
            "of whom this is",
            "ego, at 12 m/s",
        ),
        ("The hero begins to brake before the ego begins to turn, at 5 m/s.", "not one event", ""),
        ("The hero begins to brake before the hero begins to brake.", "before itself", ""),
        ("Always: the hero drives at 5 m/s.", "from which and until which", ""),
    ],
)
def test_what_names_no_moment_is_refused_in_its_own_words(said: str, fault: str, found: str) -> None:
    with pytest.raises(TranslationError, match=fault) as caught:
        read(BRAKES + said)
    assert found in str(caught.value.found)


def test_what_holds_from_one_moment_until_another_keeps_its_offsets() -> None:
    held = (
        "From 1 s after the start until 2 s before the hero begins to brake, never: the hero drives at 14 m/s or more."
    )
    (hold,) = read(BRAKES + held).holds
    assert (hold.how, hold.start.moment, hold.start.earlier, hold.end.earlier) == ("never", st.START, False, True)
    assert hold.start.offset is not None
    assert hold.start.offset.si == 1


def test_one_bound_that_is_two_conditions_is_held_as_one() -> None:
    told = "From the start until the hero begins to brake, always: the hero is at most 90 m before the conflict point."
    (hold,) = read(BRAKES + told).holds
    assert isinstance(hold.condition, st.Compound)
    assert hold.condition.joint == "and"


def test_the_egos_order_is_told_once() -> None:
    order = "In the ego's order: the hero begins to brake, then the ego passes the stop line."
    with pytest.raises(TranslationError, match="told twice"):
        read(f"{BRAKES}Later, the ego passes the stop line. {order} {order}")
