"""What a teller or a report says in its own turns of phrase is what plain words say."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute
from scenewright.translate.offline import translate_offline

STORY = (
    "The ego drives east on the road and turns left into the driveway; it starts 60 m before the intersection. The "
    "hero "
    "drives west and goes straight on. When the ego is 20 m and the hero 48 m from the conflict point, the hero "
    "brakes and "
    "comes to a stop 14 m before the conflict point. Then it drives on and passes the conflict point before the ego "
    "begins "
    "its turn."
)


def meaning(text: str) -> tuple[list[tuple[str, ...]], set[str]]:
    """Return the routes of a text's program, and its constraints."""
    program = translate_offline(text).program
    routes = [actor.route.headings for actor in program.actors if isinstance(actor.route, HeadingsRoute)]
    return routes, {print_expression(each.formula) for each in program.constraints}


def assert_means_the_same(story: str, plain: str, other: str) -> None:
    """Fail unless `other` in the place of `plain` leaves the story's meaning as it is."""
    assert plain in story
    try:
        read = meaning(story.replace(plain, other, 1))
    except TranslationError:
        pytest.fail(f"refused: {other}")
    assert read == meaning(story)


@pytest.mark.parametrize(
    ("plain", "told"),
    [
        ("comes to a stop", "rolls to a stop"),
        ("comes to a stop", "eases to a complete stop"),
        ("The ego drives", "The tested vehicle, named ego, drives"),
        ("The ego drives", "The vehicle under test, referred to as the ego, drives"),
        ("When the ego", "Right when the ego"),
        ("the hero brakes and", "the hero begins to brake right then and"),
        ("; it starts 60 m before the intersection", ", starting the run 60 m before the intersection"),
        (
            "; it starts 60 m before the intersection",
            ". Sixty metres is the ego's initial distance from the intersection",
        ),
        ("; it starts 60 m before the intersection", "; its distance before the intersection is 60 m at the start"),
        ("; it starts 60 m before the intersection", ", and the scenario starts when it is 60 m from the intersection"),
        ("The hero drives west", "The hero comes from the eastern arm"),
        ("When the ego is 20 m and the hero 48 m from", "Let the ego come to 20 m, with the hero 48 m, from"),
        ("before the ego begins its turn", "before the beginning of the turn of the ego"),
        ("before the ego begins its turn", "prior to the start of the turn by the ego"),
        ("Then it drives on", "But not for good: it drives on"),
        ("Then it drives on", "It doesn't stay put, though: it drives on"),
        ("The ego drives", "To evaluate false-positive braking, we let the ego drive"),
        ("The ego drives", "Somebody wants to see this again, so: the ego drives"),
        ("The ego drives", "Ego (the car we are testing) drives"),
        ("The ego drives", "The vehicle evaluated (the ego) drives"),
        (
            "into the driveway; it starts 60 m before the intersection",
            "into the driveway. In the first frame we are 60 m from the intersection",
        ),
        ("the hero brakes and", "the hero, itself, brakes and"),
        ("the hero brakes and", "the hero kindly brakes and"),
        ("Then it drives on", "Then it has second thoughts, drives on"),
        (
            "the ego is 20 m and the hero 48 m from the conflict point",
            "the conflict point is 20 m ahead of the ego and 48 m ahead of the hero",
        ),
        (
            "the ego is 20 m and the hero 48 m from the conflict point",
            "there remain 20 m for the ego until the conflict point, and 48 m for the hero until the conflict point",
        ),
        (
            "comes to a stop 14 m before the conflict point",
            "stops, leaving fourteen metres (14 m) between itself and the conflict point",
        ),
        ("comes to a stop 14 m before the conflict point", "stops 14 m before reaching the conflict point"),
    ],
)
def test_told(plain: str, told: str) -> None:
    assert_means_the_same(STORY, plain, told)


GOES_FIRST = (
    "The AV is on the driveway and turns left; at first it is 6 s from the stop line. A cab drives west on the road "
    "and "
    "goes straight. When the AV is 2 s from the stop line and the cab 3.5 s from the conflict point, the cab "
    "accelerates "
    "and passes the conflict point before the AV begins its turn."
)


@pytest.mark.parametrize(
    ("plain", "reported"),
    [
        ("at first it is 6 s from the stop line", "initially, 6 s are left for it to the stop line"),
        ("The AV is on the driveway", "The AV is not on the road but on the driveway"),
        ("accelerates and passes", "commences an acceleration that lets it pass"),
        ("accelerates and passes", "begins to accelerate, which allows it to pass"),
        ("When the AV is", "At the instant that finds the AV"),
        (
            "passes the conflict point before the AV begins its turn",
            "is through the conflict point before the AV begins its turn",
        ),
        ("before the AV begins its turn", "before the AV starts its own turn"),
        ("When the AV is 2 s from the stop line", "When for the AV remain 2 s to the stop line"),
        (
            "When the AV is 2 s from the stop line and the cab 3.5 s from the conflict point",
            "The moment the AV's time to arrival at the stop line is 2 s and the cab's time to reach the conflict "
            "point is 3.5 s",
        ),
        ("the cab accelerates", "the cabbie steps on the gas"),
        ("A cab drives west", "A cab, in no mood to wait, drives west"),
        ("the cab accelerates", "the cab accelerates, disregarding the priority of the AV,"),
        ("the cab accelerates", "the cab fails to respect the right of way of the AV; it accelerates"),
        (
            "The AV is on the driveway and turns left; at first it is 6 s from the stop line",
            "The AV is on the driveway, with a left turn in mind; at first it is 6 s from the stop line",
        ),
        (
            "The AV is on the driveway and turns left; at first it is 6 s from the stop line",
            "The AV is on the driveway and "
            "turns left. It approaches the stop line, from which it is initially 6 s away",
        ),
    ],
)
def test_reported(plain: str, reported: str) -> None:
    assert_means_the_same(GOES_FIRST, plain, reported)


def test_before_it_begins_its_turn_somebody_has_passed() -> None:
    """Two moments in one clause: the order is that of the turn, not that of the conflict point."""
    passed = GOES_FIRST.replace(
        "and passes the conflict point before the AV begins its turn",
        "and before the AV begins its turn the conflict point has been passed by the cab",
    )
    assert meaning(passed) == meaning(GOES_FIRST)


@pytest.mark.parametrize(
    "named",
    [
        "My pupil drives the ego. She is on the driveway and turns left; at first she is 6 s from the stop line.",
        "The learner's car, our ego, is on the driveway and turns left; the learner is at first 6 s from the stop "
        "line.",
        "The pupil in our car (the ego) is on the driveway and turns left, at first 6 s from the stop line.",
    ],
)
def test_who_drives_the_ego_is_the_ego(named: str) -> None:
    text = (
        f"{named} The hero drives west on the road and goes straight. When the ego is 2 s from the stop line and "
        f"the hero "
        "3.5 s from the conflict point, the hero brakes and stops 8 m before the conflict point."
    )
    routes, formulas = meaning(text)
    assert routes == [("S", "E"), ("W",)]
    assert "tta(A0, stop_line, t0) == 6" in formulas


def test_a_shuttle_is_no_bus() -> None:
    text = (
        "The automated shuttle is on the driveway and turns left. A bus drives east on the road and goes straight. "
        "When the "
        "shuttle is 14 m from the stop line and the bus 45 m from the conflict point, the bus accelerates and "
        "passes the "
        "conflict point before the shuttle begins its turn."
    )
    routes, formulas = meaning(text)
    assert routes == [("S", "E"), ("E",)]
    assert {"A0x(t1) == stop_line - 14", "A1x(t1) == conflict_point - 45"} <= formulas


def test_another_learner_is_the_hero() -> None:
    text = (
        "The ego drives west on the road and goes straight. A learner driver comes out of the driveway and turns "
        "right. When "
        "the learner is 20 m from the stop line and the ego 65 m from the conflict point, the learner brakes and "
        "stops 2 m "
        "before the stop line."
    )
    routes, formulas = meaning(text)
    assert routes == [("W",), ("S", "W")]
    assert {"A0x(t1) == conflict_point - 65", "A1x(t1) == stop_line - 20", "A1x(t2) == stop_line - 2"} <= formulas


@pytest.mark.parametrize(
    ("plain", "contradicted"),
    [
        ("The ego drives", "To test a hero that never brakes, the ego drives"),
        ("The ego drives", "To evaluate a right turn, the ego drives"),
        ("Then it drives on", "Right of way is ignored: then it drives on"),
        ("The hero drives west", "The hero drives along the western side"),
        ("When the ego is", "The ego's mode changes when the hero is 70 m from the conflict point. When the ego is"),
    ],
)
def test_what_contradicts_the_rest_is_not_dropped(plain: str, contradicted: str) -> None:
    """It is refused, or said to be set aside."""
    assert plain in STORY
    try:
        read = translate_offline(STORY.replace(plain, contradicted, 1))
    except TranslationError:
        return
    assert any("set aside" in assumed for assumed in read.assumptions)
