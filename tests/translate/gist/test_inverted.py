"""A deed or a way that is told first, as a noun or in the passive, is that of whoever is named after."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute
from scenewright.translate.offline import translate_offline

WAY = "The ego, 35 m from the stop line at first, comes out of the driveway and turns left. "
PLACE = "The ego is on the driveway, at first 35 m from the stop line."
HERO = "The hero drives west on the road and goes straight. "
DEED = (
    "When the ego is 12 m from the stop line and the hero 45 m from the conflict point, the hero begins to decelerate "
    "and comes to a complete stop 8 m before the conflict point."
)


def meaning(text: str) -> tuple[list[tuple[str, ...]], set[str]]:
    """Return the routes of a text's program, and its constraints."""
    program = translate_offline(text).program
    routes = [actor.route.headings for actor in program.actors if isinstance(actor.route, HeadingsRoute)]
    return routes, {print_expression(each.formula) for each in program.constraints}


@pytest.mark.parametrize(
    "way",
    [
        f"{PLACE} A left turn onto the road is planned for it. ",
        f"{PLACE} A left turn onto the road is the goal of the ego. ",
        f"{PLACE} The goal of the ego is a left turn onto the road. ",
        f"{PLACE} The turn of the ego is a left one. ",
        "The ego approaches the stop line of the driveway, from which it is initially 35 m away, and turns left. ",
        "The ego, 35 m from the stop line at first, is in the driveway and has a left turn before it. ",
    ],
)
def test_ways(way: str) -> None:
    assert meaning(way + HERO + DEED) == meaning(WAY + HERO + DEED)


@pytest.mark.parametrize(
    ("plain", "inverted"),
    [
        ("the hero begins to decelerate and comes", "deceleration is begun by the hero and takes it"),
        ("comes to a complete stop 8 m", "comes to a complete stop, which is to be 8 m"),
        ("comes to a complete stop 8 m", "a complete stop is made by it 8 m"),
        (
            "When the ego is 12 m from the stop line and the hero 45 m from the conflict point",
            "Once the two are, "
            "respectively, 12 m from the stop line (the ego) and 45 m from the conflict point (the hero)",
        ),
        ("the hero begins to decelerate", "the matter is decided by the hero, which begins to decelerate"),
        (
            "When the ego is 12 m from the stop line and the hero 45 m from the conflict point, the hero begins",
            "When it is 45 m from the conflict point and the ego is 12 m from the stop line, it begins",
        ),
    ],
)
def test_deeds(plain: str, inverted: str) -> None:
    assert plain in DEED
    assert meaning(WAY + HERO + DEED.replace(plain, inverted)) == meaning(WAY + HERO + DEED)


@pytest.mark.parametrize(
    "contradicted",
    [
        WAY + HERO + DEED + " It is still doing 10 km/h there.",
        WAY + HERO + DEED.replace("point.", "point (where it is still doing 10 km/h)."),
        "The ego stands at the stop line of the driveway, wishing to turn left. " + HERO + DEED,
        WAY
        + HERO
        + "The ego's time to arrival at the stop line is 6 s at first. At the time when it has become 2 s, the "
        "hero being 3.8 s from the conflict point, the hero accelerates and passes it before the ego begins to turn.",
    ],
)
def test_refused(contradicted: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(contradicted)


def test_what_sums_up_does_not_say_up_to_where() -> None:
    """The ego is let go: up to the end of its turn, as the last sentence says."""
    text = (
        f"The hero lets the ego go here. {WAY}{HERO}{DEED} It lets the ego complete its turn; only then it drives on."
    )
    assert "A0x(t2) == turn_end" in meaning(text)[1]


GOES_FIRST = "the hero accelerates and passes the conflict point before the ego begins to turn."
WHEN = "When the ego is 12 m from the stop line and the hero 45 m from the conflict point, "


@pytest.mark.parametrize(
    "contradicted",
    [
        WAY + HERO + WHEN + "the hero, claiming the road for itself, brakes and stops 8 m before the conflict point.",
        WAY + HERO.replace("straight.", "straight, and wants it sooner.") + DEED,
        WAY + HERO + "You would expect the ego to wait. It doesn't. " + WHEN + GOES_FIRST,
        WAY + HERO + WHEN + "the hero is in no giving mood: it brakes and stops 8 m before that point.",
        WAY + HERO + WHEN + "the hero brakes. When 2 s have passed since the start of its braking, it stops.",
        "The ego is on the driveway, 40 m from the stop line, and so is the hero, which leads it. Both turn left. "
        "When the ego is 12 m behind the hero, the hero brakes at 3 m/s^2 to a stop.",
    ],
)
def test_no_turn_of_phrase_hides_what_is_said(contradicted: str) -> None:
    """An attitude that the deed contradicts, whose it is, or what is shared: all of it is kept, and so refused."""
    with pytest.raises(TranslationError):
        translate_offline(contradicted)
