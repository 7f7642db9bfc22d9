"""Who drives where: constructions that introduce vehicles, and what must not be stepped over."""

import pytest

from scenewright.errors import TranslationError
from scenewright.translate.offline import translate_offline

MEETS = " When the ego is 12 m from the conflict point, the hero brakes to a stop 5 m before the conflict point."
FOLLOWS = " When the gap is 12 m, the hero brakes at 3 m/s^2 to a stop."


def ways(text: str) -> list[tuple[str, ...]]:
    """Return the headings of both vehicles."""
    return [actor.route.headings for actor in translate_offline(text).program.actors]


@pytest.mark.parametrize(
    ("text", "ego", "hero"),
    [
        ("The ego comes out of the driveway by means of a right turn. A motorcycle rides west.", ("S", "W"), ("W",)),
        ("ego E->N, hero W->W.", ("E", "N"), ("W",)),
        ("Ego (eastbound, turns left into the driveway). Oncoming van, no turn.", ("E", "N"), ("W",)),
        ("The left-turner is the SUT, eastbound into the driveway. A van is oncoming.", ("E", "N"), ("W",)),
        ("The ego drives west. Somebody in a hatchback turns left out of the driveway.", ("W",), ("S", "E")),
        ("The ego goes west. A moped leaves the driveway with a left turn, so their paths cross.", ("W",), ("S", "E")),
        ("Left turn out of the driveway by the AV against a westbound bus.", ("S", "E"), ("W",)),
    ],
)
def test_ways_that_meet(text: str, ego: tuple[str, ...], hero: tuple[str, ...]) -> None:
    assert ways(text + MEETS) == [ego, hero]


@pytest.mark.parametrize(
    ("text", "ego", "hero"),
    [
        ("The ego follows a van west; neither of them turns.", ("W",), ("W",)),
        (
            "The ego is behind a truck in the driveway. The truck turns right and so does the ego.",
            ("S", "W"),
            ("S", "W"),
        ),
        ("A wagon and, behind it, the ego drive east. Both turn left into the driveway.", ("E", "N"), ("E", "N")),
        ("The ego leaves the driveway to the left. The front one turns right.", ("S", "E"), ("S", "W")),
    ],
)
def test_ways_behind_each_other(text: str, ego: tuple[str, ...], hero: tuple[str, ...]) -> None:
    assert ways(text + FOLLOWS) == [ego, hero]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("The ego drives east, no turn. The hero drives west. The ego turns left into the driveway.", "two things"),
        ("The ego drives west, the hero east, so their paths cross.", "do not"),
        ("Left turn test. The ego drives west. The hero turns right out of the driveway.", "neither vehicle does this"),
        ("A van that waits. The ego drives west. A van turns right out of the driveway.", "not told again"),
    ],
)
def test_what_does_not_hold_is_refused(text: str, message: str) -> None:
    tail = " When the ego is 12 m from the intersection, the hero accelerates at 2 m/s^2 to 12 m/s."
    with pytest.raises(TranslationError, match=message):
        translate_offline(text + tail)


def test_two_leaders_are_refused() -> None:
    text = "The ego is in front of the hero, both westbound. The hero is ahead of the ego."
    with pytest.raises(TranslationError, match="in front of the other"):
        translate_offline(text + FOLLOWS)
