"""What is told of the start stays of the start wherever it is told; who does the same goes the same way."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute
from scenewright.translate.offline import translate_offline

STORY = (
    "The ego drives west and turns right into the driveway. The hero drives east and turns left into the driveway. "
    "When the hero is 2.4 s and the ego 3.6 s from the conflict point, the hero accelerates. It passes the conflict "
    "point before the ego begins its turn. "
)
FOLLOWS = " As soon as the hero is 1 s behind the ego, it brakes at 3 m/s^2 to 15 km/h."
STOPS = (
    "The ego drives east, going straight. The hero is on the driveway and turns left. When the ego is 55 m from the "
    "conflict point and the hero 20 m from the stop line, the hero brakes and stops 2 m before the stop line. "
)


def formulas(text: str) -> set[str]:
    """Return the constraints of a text's program."""
    return {print_expression(each.formula) for each in translate_offline(text).program.constraints}


@pytest.mark.parametrize(
    "told",
    [
        "Its speed at the start of the test is 36 km/h.",
        "The hero's speed at the start of the test is 36 km/h.",
        "Its speed from the beginning is 36 km/h.",
        "Its starting speed: 36 km/h.",
        "The initial speeds are 54 km/h (ego) and 36 km/h (hero).",
        "Initially the speed of the ego is 54 km/h, and the hero's is 36 km/h.",
    ],
)
def test_a_speed_at_the_start_told_last(told: str) -> None:
    read = formulas(STORY + told)
    assert "A1v(t0) == 10" in read
    assert not any("A1v(t2)" in each for each in read)
    assert ("A0v(t0) == 15" in read) == ("54" in told)


@pytest.mark.parametrize("nobodys", ["9 m/s.", "Value for the run: 9 m/s."])
def test_a_speed_of_nobody_is_refused(nobodys: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(STORY + nobodys)


@pytest.mark.parametrize(
    "told",
    [
        "The ego drives east and turns left into the driveway, and so is the hero, which comes along behind it.",
        "The ego drives east and turns left into the driveway, as does the hero, which is behind it.",
        "The ego drives east and turns left into the driveway, and the hero does the same behind it.",
        "The ego drives east and turns left into the driveway. So will the hero. It is behind the ego.",
    ],
)
def test_who_does_the_same_goes_the_same_way(told: str) -> None:
    program = translate_offline(told + FOLLOWS).program
    assert [each.route.headings for each in program.actors if isinstance(each.route, HeadingsRoute)] == [
        ("E", "N"),
        ("E", "N"),
    ]


@pytest.mark.parametrize("sets_off", ["pulls away", "sets off", "drives on", "accelerates"])
def test_the_rate_of_setting_off_is_no_braking(sets_off: str) -> None:
    text = STOPS + f"Then it {sets_off} at 1.8 m/s^2 and passes the conflict point before the ego passes it."
    read = formulas(text)
    assert "A1a(acc) == 1.8" in read
    assert not any("A1a(dec)" in each for each in read)


@pytest.mark.parametrize(
    "ordered",
    [
        "It passes the conflict point, and only later than that does the ego begin its turn.",
        "By the time the ego begins to turn it has already passed the conflict point.",
        "It passes the conflict point, and somehow does the ego begin its turn.",
    ],
)
def test_an_order_is_read_or_refused(ordered: str) -> None:
    """Never dropped."""
    plain = "It passes the conflict point before the ego begins its turn."
    assert plain in STORY
    try:
        read = formulas(STORY.replace(plain, ordered))
    except TranslationError:
        assert "somehow" in ordered
        return
    assert read == formulas(STORY)


def test_who_stands_to_the_end_does_not_drive_on() -> None:
    after = "It stands there to the end of the test. Then it accelerates and passes the conflict point."
    with pytest.raises(TranslationError):
        translate_offline(STOPS + after)


def test_one_that_stands_at_the_start_may_speed_up_to_a_speed() -> None:
    text = (
        "The ego drives east, straight on. The hero is at a standstill at the stop line of the driveway and turns left "
        "onto the road. When the ego is 55 m from the conflict point, the hero accelerates at 1.8 m/s^2 to 15 km/h."
    )
    assert {"A1x(t0) == stop_line", "A1v(stop) == 0", "A1a(acc) == 1.8", "A1v(t2) == 25/6"} <= formulas(text)


def test_one_that_stands_at_the_start_has_no_speed() -> None:
    text = (
        "The ego drives east, straight on. The hero stands at the stop line of the driveway and turns left onto the "
        "road; it drives at 20 km/h. When the ego is 55 m from the conflict point, the hero accelerates and passes the "
        "conflict point before the ego passes it."
    )
    with pytest.raises(TranslationError):
        translate_offline(text)
