"""What somebody does: when it begins, where it ends, and which of the two another moment dates."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell

WAYS = "The ego turns left out of the driveway. The hero drives west. "
WHEN = WAYS + "When the ego is 12 m before the stop line, the hero "
TURNED = "When the hero completes its turn, the hero"
PASSES = WAYS + "2 s after the ego passes the stop line, the hero "


def does(text: str) -> list[str]:
    """Return what is told beside the ways, with all questions answered by default."""
    return [line for line in tell(read(text)) if "headed" not in line and "comes from" not in line]


STOPS = ["Then the hero stands still.", "Then the hero drives on until it passes the conflict point."]


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("brakes to a stop and passes the conflict point.", ["to brake until it stands.", *STOPS]),
        ("brakes to a stop in 4 s, then passes the conflict point.", ["to brake for 4 s until it stands.", *STOPS]),
        ("brakes for 3 s and passes the conflict point.", ["to brake for 3 s.", STOPS[1]]),
        ("brakes at 3 m/s^2, then passes the conflict point.", ["to brake at 3 m/s^2 for a while.", STOPS[1]]),
        ("brakes and passes the conflict point.", ["to brake until it passes the conflict point."]),
        ("speeds up, then passes the conflict point.", ["to speed up until it passes the conflict point."]),
    ],
)
def test_what_somebody_passes_ends_a_deed_only_where_that_has_no_end(said: str, told: list[str]) -> None:
    first, *others = told
    front = "When the ego is 12 m before the stop line, the hero begins "
    assert does(WHEN + said) == [front + first, *others]


def test_who_brakes_to_a_stop_passes_nothing_meanwhile() -> None:
    with pytest.raises(TranslationError, match="whether this is done then or meanwhile"):
        read(WHEN + "brakes to a stop, passing the stop line.")


@pytest.mark.parametrize(
    "said",
    ["brakes and passes the conflict point.", "brakes to pass the conflict point.",
     "brakes, passing the conflict point 1 s before the ego."],
)  # fmt: skip
def test_what_stands_in_front_of_a_deed_dates_its_beginning_whatever_it_passes(said: str) -> None:
    told = does(PASSES + said)
    assert "Then the hero brakes until it passes the conflict point." in told
    assert "The hero begins to brake 2 s after the ego passes the stop line." in told


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("turns left.", "The hero begins to turn 2 s after the ego passes the stop line."),
        ("turns left and brakes to a stop.", f"{TURNED} begins to brake until it stands."),
        ("keeps its speed.", "Meanwhile, the hero has an acceleration of 0 m/s^2."),
    ],
)
def test_what_is_done_some_time_after_a_moment_is_done_then(said: str, told: str) -> None:
    assert told in does(PASSES + said)


def test_who_does_not_stop_some_time_after_a_moment_may_have_stopped_before() -> None:
    assert sum("at least 1 m/s" in line for line in does(PASSES + "drives on without stopping.")) == 1


def test_who_turns_and_brakes_so_long_after_the_start_turns_first() -> None:
    first, then = does(WAYS + "5 s after the start, the hero turns left and brakes to a stop.")
    assert first.startswith("When it is 5 s after the start and the hero begins to turn, the hero begins to drive on")
    assert then == f"{TURNED} begins to brake until it stands."


@pytest.mark.parametrize(
    ("said", "named"),
    [
        ("Until the ego passes the stop line, the hero passes the conflict point.", "when this is so"),
        ("5 s after the start, the hero brakes to 5 m/s. 2 s later it speeds up when the ego begins to turn.",
         "at two times"),
    ],
)  # fmt: skip
def test_no_two_times_of_one_thing_are_told(said: str, named: str) -> None:
    with pytest.raises(TranslationError, match=named):
        read(WAYS + said)


@pytest.mark.parametrize(
    ("said", "at"),
    [("passes the stop line", "passes the stop line"), ("turns left", "completes its turn")],
)
def test_what_is_passed_before_something_is_done_is_no_part_of_the_moment(said: str, at: str) -> None:
    *_, drives, brakes = does(f"{WHEN}{said}, after which it brakes to a stop.")
    assert drives.endswith("the hero begins to drive on.")
    assert brakes == f"When the hero {at}, the hero begins to brake until it stands."


@pytest.mark.parametrize("said", ["brakes, turning left.", "brakes to 5 m/s. It turns left and stops."])
def test_when_somebody_turns_that_does_something_else_is_not_clear(said: str) -> None:
    with pytest.raises(TranslationError, match="when or where this is done"):
        read(WHEN + said)


@pytest.mark.parametrize(
    ("said", "named"),
    [
        ("brakes to a stop in 4 s, later drives on.", "'later' could not be understood"),
        ("brakes for 3 s. It brakes for 5 s.", "two amounts for one thing: 3 s and 5 s"),
        ("drives on until it drives on.", "over before it begins"),
    ],
)
def test_times_that_do_not_fit_are_refused(said: str, named: str) -> None:
    with pytest.raises(TranslationError, match=named):
        read(WHEN + said)


def test_who_passes_a_place_braking_and_then_stops_brakes_on() -> None:
    assert does(WHEN + "brakes, passes the stop line and stops 5 m before the conflict point.") == [
        "When the ego is 12 m before the stop line, the hero begins to brake until it passes the stop line.",
        "Then the hero brakes until it stands 5 m before the conflict point.",
    ]


TWO = "The ego turns left out of the driveway. A car drives west. A truck drives east. "
BOTH = TWO + "When the ego is 12 m before the stop line, the car and the truck "


@pytest.mark.parametrize(
    ("said", "verbs"),
    [
        ("brake to 5 m/s and speed up to 10 m/s.", ["brake", "speed up"]),
        ("brake to a stop, wait for 2 s and drive on.", ["brake", "stand still", "drive on"]),
        ("brake to a stop, then drive on.", ["brake", "stand still", "drive on"]),
        ("brake to a stop and 3 s later drive on.", ["brake", "stand still", "drive on"]),
    ],
)
def test_two_who_do_several_things_each_go_on_from_their_own(said: str, verbs: list[str]) -> None:
    story = read(BOTH + said)
    assert [[deed.verb for deed in story.deeds_of(actor)][1:] for actor in (1, 2)] == [verbs, verbs]
    assert story.deeds_of(1)[1].begins == story.deeds_of(2)[1].begins
    assert all(order.op == "==" for order in story.orders)


def test_what_stands_in_front_of_what_two_do_is_of_the_first_thing_that_each_does() -> None:
    story = read(
        TWO + "2 s after the ego passes the stop line, the car and the truck brake to a stop and wait for 3 s."
    )
    assert sorted(str(order.margin and order.margin.value) for order in story.orders) == ["2", "3", "3"]


def test_who_acts_again_in_one_sentence_goes_on_from_its_own_deed() -> None:
    story = read(TWO + "5 s after the start, the car brakes to a stop, the truck speeds up and the car drives on.")
    assert [deed.verb for deed in story.deeds_of(1)] == ["drive on", "brake", "stand still", "drive on"]
    assert story.deeds_of(1)[1].begins == story.deeds_of(2)[1].begins
    assert not story.orders


@pytest.mark.parametrize(
    "said",
    [
        "Until the ego passes the stop line, the car brakes and the truck speeds up.",
        "The car and the truck brake to a stop and wait for 2 s when the ego passes the stop line.",
        "5 s after the start, the car brakes to a stop and waits for 2 s, and the truck speeds up.",
        "5 s after the start, the car brakes to a stop, the ego is 5 m before the stop line and the truck speeds up.",
    ],
)
def test_who_of_several_does_something_when_is_told_or_refused(said: str) -> None:
    with pytest.raises(TranslationError, match="it is not clear"):
        read(TWO + said)


def test_what_comes_after_a_moment_at_which_nobody_acts_comes_after_it() -> None:
    passes = WAYS + "5 s after the start, the hero passes the conflict point. "
    assert does(passes + "Then it brakes.")[-1] == "The hero passes the conflict point before the hero begins to brake."
    with pytest.raises(TranslationError, match="when this is done"):
        read(passes + "It brakes for 3 s.")
