"""Plain sentences, combined from parts of known meaning: each combination is its own oracle, and every one is read."""

from __future__ import annotations

import random
from itertools import cycle, islice

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute, Program
from scenewright.translate.offline import translate_offline

WEST, EAST = ("W",), ("E",)
RIGHT_OUT, LEFT_OUT, LEFT_IN, RIGHT_IN = ("S", "W"), ("S", "E"), ("E", "N"), ("W", "N")

WAYS = {
    WEST: [
        "{} comes from the east and goes straight through.",
        "{} heads west along the road and passes the driveway.",
        "{} drives along the main road, from east to west, without turning.",
        "{} approaches on the road from the east; it does not turn.",
    ],
    EAST: [
        "{} comes from the west and goes straight through.",
        "{} heads east along the road and passes the driveway.",
        "{} follows the road east.",
    ],
    RIGHT_OUT: [
        "{} comes out of the driveway and turns right.",
        "{} exits the driveway and turns onto the westbound lane.",
    ],
    LEFT_OUT: [
        "{} leaves the driveway by a left turn onto the road.",
        "{} pulls out of the driveway, turning left, to head east.",
    ],
    LEFT_IN: [
        "{} comes from the west and turns left into the driveway.",
        "{} heads east and turns off into the driveway.",
        "{} drives east and means to turn off left, up the driveway.",
        "{} wants to enter the driveway from the west.",
    ],
    RIGHT_IN: [
        "{} comes from the east and turns right into the driveway.",
        "{} wants to enter the driveway from the east.",
        "{} approaches from the east and will turn into the driveway on its right.",
    ],
}
MEETING = [
    (WEST, LEFT_OUT), (WEST, LEFT_IN), (RIGHT_OUT, WEST), (LEFT_OUT, WEST), (LEFT_OUT, EAST), (EAST, LEFT_OUT),
    (LEFT_IN, WEST), (LEFT_IN, LEFT_OUT), (LEFT_IN, RIGHT_IN), (RIGHT_IN, LEFT_IN), (LEFT_OUT, LEFT_IN),
]  # fmt: skip
CALLED = [("the ego", "the hero"), ("the test car", "the van"), ("the AV", "the lorry"), ("our car", "the other car")]
EGOS = ["the ego", "the vehicle under test", "the automated shuttle", "the SUT", "the robotaxi"]
HEROES = ["the hero", "a van", "another car", "the other vehicle", "an elderly driver", "the POV", "a motorcyclist"]
TRIGGERS = [
    "When the ego is 12 m from the stop line and the hero is 34 m from the conflict point, ",
    "Once the hero has 34 m to go to the conflict point and the ego 12 m to the stop line, ",
    "With the hero 34 m from the conflict point and the ego 12 m from its stop line, ",
    "When the hero is 34 m and the ego 12 m away from the conflict point and the stop line, respectively, ",
]
MET = {"A0x(t1) == stop_line - 12", "A1x(t1) == conflict_point - 34"}
DEEDS = {
    "brakes and stops 7 m before the conflict point.": {"A1x(t2) == conflict_point - 7", "A1v(t2) == 0"},
    "yields: it brakes to a halt 7 m before the conflict point.": {"A1x(t2) == conflict_point - 7", "A1v(t2) == 0"},
    "decelerates at a constant rate of 3 m/s^2 to a standstill.": {"A1a(dec) == -3", "A1v(t2) == 0"},
    "speeds up so that it goes through the conflict point before the ego begins its turn.": {
        "A1x(t2) == conflict_point",
        "A0x(t2) == turn_start",
        "A1(t2) < A0(t2)",
    },
    "stops 7 m before the conflict point, remains stopped for 2 s, then sets off again and is through the conflict "
    "point "
    "before the ego begins its turn.": {
        "A1x(t2) == conflict_point - 7",
        "A1(t3) - A1(t2) == 2",
        "A1x(t4) == conflict_point",
        "A0x(t2) == turn_start",
        "A1(t4) < A0(t2)",
    },
    "stops 7 m before the conflict point. Only after the ego has completed its turn does the hero set off again.": {
        "A1x(t2) == conflict_point - 7",
        "A0x(t2) == turn_end",
        "A1(t3) > A0(t2)",
    },
}
# Follows from the others, and may stand there too.
IMPLIED = ("A0(t1) == A1(t1)", "A1v(stop) == 0", "A1v(t2) == 0", "A1x(t4) == conflict_point")
FIRST = {
    "The ego starts 40 m before the stop line.": {"A0x(t0) == stop_line - 40"},
    "The hero travels at 13 m/s at the beginning.": {"A1v(t0) == 13"},
    "Initially, the ego drives at 5 m/s and the hero at 13 m/s.": {"A0v(t0) == 5", "A1v(t0) == 13"},
    "Initially both drive at 10 m/s.": {"A0v(t0) == 10", "A1v(t0) == 10"},
    "The ego's time to arrival at the stop line is 6 s at first.": {"tta(A0, stop_line, t0) == 6"},
    "The hero begins 8 seconds before the conflict point.": {"tta(A1, conflict_point, t0) == 8"},
}
GAPS = {
    "When the ego is 18 m behind the hero, ": "gap(A0, A1, t1) == 18",
    "Once the gap between the two has shrunk to 18 m, ": "gap(A0, A1, t1) == 18",
    "When only 18 m separate the two, ": "gap(A0, A1, t1) == 18",
    "Once the time headway has dropped to 1.5 s, ": "headway(A0, A1, t1) == 1.5",
    "When the ego trails the hero by 1.5 s, ": "headway(A0, A1, t1) == 1.5",
    "Once the TTC between ego and hero falls to 4 s, ": "ttc(A0, A1, t1) == 4",
}
OUT_AND_BY = "The ego comes out of the driveway and turns left. The hero drives west on the road and goes straight. "


def ways_of(program: Program) -> list[tuple[str, ...]]:
    """Return the headings of both routes."""
    return [actor.route.headings for actor in program.actors if isinstance(actor.route, HeadingsRoute)]


def said(program: Program) -> set[str]:
    """Return a program's constraints as text, without those that follow from the others."""
    return {print_expression(constraint.formula) for constraint in program.constraints} - set(IMPLIED)


@pytest.mark.parametrize(("ego", "hero"), MEETING)
def test_ways(ego: tuple[str, ...], hero: tuple[str, ...]) -> None:
    """Each way to tell the one's route, beside some way to tell the other's."""
    generator = random.Random(7)
    several = max(len(WAYS[ego]), len(WAYS[hero]))
    for ego_way, hero_way in islice(zip(cycle(WAYS[ego]), cycle(reversed(WAYS[hero])), strict=False), several):
        first, second = generator.choice(CALLED)
        ego_place, hero_place = ("stop line" if way[0] == "S" else "conflict point" for way in (ego, hero))
        brought_in = second if second in ("the hero", "the other car") else second.replace("the ", "a ")
        ego_told = ego_way.format(first[0].upper() + first[1:])
        hero_told = hero_way.format(brought_in[0].upper() + brought_in[1:])
        text = (
            f"{ego_told} {hero_told} When {first} is 20 m from the {ego_place} and {second} is 25 m from the "
            f"{hero_place}, {second} brakes and stops 5 m before the {hero_place}."
        )
        assert ways_of(translate_offline(text).program) == [ego, hero], text


@pytest.mark.parametrize("ego", EGOS)
@pytest.mark.parametrize("hero", HEROES)
def test_names(ego: str, hero: str) -> None:
    again = "the other car" if hero == "another car" else f"the {hero.split(' ', 1)[1]}"
    text = (
        f"{ego[0].upper()}{ego[1:]} comes out of the driveway and turns left; at first it is 40 m from the stop line. "
        f"{hero[0].upper()}{hero[1:]} drives west on the road and goes straight. When {ego} is 12 m from the stop line "
        f"and {again} is 34 m from the conflict point, {again} brakes and stops 7 m before the conflict point."
    )
    program = translate_offline(text).program
    assert ways_of(program) == [LEFT_OUT, WEST]
    assert said(program) == {*MET, "A0x(t0) == stop_line - 40", "A1x(t2) == conflict_point - 7"}


@pytest.mark.parametrize("trigger", TRIGGERS)
def test_triggers_and_deeds(trigger: str) -> None:
    for deed, meaning in DEEDS.items():
        program = translate_offline(f"{OUT_AND_BY}{trigger}the hero {deed}").program
        assert said(program) == (MET | meaning) - set(IMPLIED), trigger + deed


@pytest.mark.parametrize("first", FIRST)
def test_first_states_wherever_they_are_told(first: str) -> None:
    story = f"{TRIGGERS[0]}the hero brakes and stops 7 m before the conflict point."
    program = translate_offline(f"{OUT_AND_BY}{first} {story}").program
    assert said(program) == {*MET, *FIRST[first], "A1x(t2) == conflict_point - 7"}


@pytest.mark.parametrize("first", FIRST)
def test_first_states_told_last_are_read_right_or_refused(first: str) -> None:
    text = f"{OUT_AND_BY}{TRIGGERS[0]}the hero brakes and stops 7 m before the conflict point. {first}"
    try:
        program = translate_offline(text).program
    except TranslationError:
        return
    assert said(program) == {*MET, *FIRST[first], "A1x(t2) == conflict_point - 7"}


@pytest.mark.parametrize("trigger", GAPS)
def test_gaps(trigger: str) -> None:
    along = "The ego and the hero drive west on the road, both straight on, the hero ahead. "
    program = translate_offline(f"{along}{trigger}the hero brakes at 3 m/s^2 to a standstill.").program
    assert said(program) == {GAPS[trigger], "A1a(dec) == -3"}


@pytest.mark.parametrize(
    "text",
    [
        "Ego and hero go straight westbound. The initial gap is 40 m. The initial speed is 20 m/s. When the ego is "
        "1.2 s "
        "behind the hero, the hero brakes at 3 m/s^2 to a standstill.",
        f"{OUT_AND_BY}When the ego is 12 m from the stop line and the hero 34 m from the conflict point, the hero "
        f"brakes at "
        "a rate of 3 m/s to a standstill.",
        f"{OUT_AND_BY}When one of the two is 30 m from the conflict point, the other brakes and stops 5 m before it.",
        f"{OUT_AND_BY}When the ego is 12 m from the stop line and the hero 34 m from the conflict point, the hero "
        f"brakes to "
        "a stop 6 m before the conflict point, harder than it did in the previous test.",
        "The ego is on the driveway and turns right. The hero drives west on the road at 45 km/h. When the ego is 17 m "
        "from the stop line and the hero 37 m from the conflict point, the hero decelerates to 60 km/h.",
        "Ego and hero go straight westbound. When the ego is 25 m behind the hero, the hero brakes at 3.5 m/s^2 to a "
        "standstill, but the ego must by then have overtaken it.",
    ],
)
def test_what_would_be_lost_is_refused(text: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(text)
