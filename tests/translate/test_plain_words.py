"""Plain sentences, combined: whatever is read has to be what was said, and nearly everything is read.

Every part has a known meaning, so that each combination is its own oracle: ways, names, triggers, deeds, first states.
"""

from __future__ import annotations

import random
from itertools import product

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute, Program
from scenewright.translate.offline import translate_offline

WEST, EAST = ("W",), ("E",)
RIGHT_OUT, LEFT_OUT, LEFT_IN, RIGHT_IN = ("S", "W"), ("S", "E"), ("E", "N"), ("W", "N")
MOST_REFUSED = 0.15

WAYS = {
    WEST: [
        "{} comes from the east and goes straight through.",
        "{} heads west along the road and passes the driveway.",
        "{} drives along the main road, from east to west, without turning.",
        "{} is in the westbound lane and stays in it.",
        "{} approaches on the road from the east; it does not turn.",
        "{} carries on west past the mouth of the driveway.",
        "{} travels from the eastern arm to the western arm.",
    ],
    EAST: [
        "{} comes from the west and goes straight through.",
        "{} heads east along the road and passes the driveway.",
        "{} is in the eastbound lane and stays in it.",
        "{} follows the road east.",
        "{} carries on east past the mouth of the driveway.",
    ],
    RIGHT_OUT: [
        "{} comes out of the driveway and turns right.",
        "{} is on the driveway and wants to go west.",
        "{} exits the driveway and turns onto the westbound lane.",
        "{} is going from the driveway to the west.",
        "{} rolls down the driveway toward the stop line and will turn right there.",
    ],
    LEFT_OUT: [
        "{} leaves the driveway by a left turn onto the road.",
        "{} is on the driveway and wants to go east.",
        "{} pulls out of the driveway, turning left, to head east.",
        "{} is going from the driveway to the east.",
    ],
    LEFT_IN: [
        "{} comes from the west and turns left into the driveway.",
        "{} heads east and turns off into the driveway.",
        "{}, eastbound, has the driveway as its destination.",
        "{} drives east and means to turn off left, up the driveway.",
        "{} wants to enter the driveway from the west.",
        "{} crosses the westbound lane to get from the road into the driveway.",
    ],
    RIGHT_IN: [
        "{} comes from the east and turns right into the driveway.",
        "{}, westbound, has the driveway as its destination.",
        "{} wants to enter the driveway from the east.",
        "{} approaches from the east and will turn into the driveway on its right.",
    ],
}
MEETING = [
    (WEST, LEFT_OUT), (WEST, LEFT_IN), (RIGHT_OUT, WEST), (LEFT_OUT, WEST), (LEFT_OUT, EAST), (EAST, LEFT_OUT),
    (LEFT_IN, WEST), (LEFT_IN, LEFT_OUT), (LEFT_IN, RIGHT_IN), (RIGHT_IN, LEFT_IN), (LEFT_OUT, LEFT_IN),
]  # fmt: skip
CALLED = [("the ego", "the hero"), ("the test car", "the van"), ("the AV", "the lorry"), ("our car", "the other car")]
EGOS = [
    "the ego", "the vehicle under test", "the car we are testing", "the automated shuttle", "the SUT", "the car on "
    "trial",
    "the robotaxi", "the car with our software", "the ADS-equipped vehicle", "the vehicle we assess", "the assessed "
    "vehicle",
]  # fmt: skip
HEROES = [
    "the hero", "a van", "another car", "a lorry", "the other vehicle", "an elderly driver", "a school bus", "the POV",
    "a motorcyclist", "a neighbour", "a learner", "a hatchback",
]  # fmt: skip
TRIGGERS = [
    "When the ego is 12 m from the stop line and the hero is 34 m from the conflict point, ",
    "Once the hero has 34 m to go to the conflict point and the ego 12 m to the stop line, ",
    "With the hero 34 m from the conflict point and the ego 12 m from its stop line, ",
    "At the instant when 12 m separate the ego from the stop line and 34 m the hero from the conflict point, ",
    "When the hero is 34 m and the ego 12 m away from the conflict point and the stop line, respectively, ",
]
MET = {"A0x(t1) == stop_line - 12", "A1x(t1) == conflict_point - 34"}
DEEDS = {
    "brakes and stops 7 m before the conflict point.": {"A1x(t2) == conflict_point - 7", "A1v(t2) == 0"},
    "yields: it brakes to a halt 7 m before the conflict point.": {"A1x(t2) == conflict_point - 7", "A1v(t2) == 0"},
    "eases to a stop 7 m short of the conflict point.": {"A1x(t2) == conflict_point - 7", "A1v(t2) == 0"},
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
    "At the start, 40 m separate the ego from the stop line.": {"A0x(t0) == stop_line - 40"},
    "The hero travels at 13 m/s at the beginning.": {"A1v(t0) == 13"},
    "Initially, the ego drives at 5 m/s and the hero at 13 m/s.": {"A0v(t0) == 5", "A1v(t0) == 13"},
    "The initial speed of both is 10 m/s.": {"A0v(t0) == 10", "A1v(t0) == 10"},
    "Initially both drive at 10 m/s.": {"A0v(t0) == 10", "A1v(t0) == 10"},
    "The ego's time to arrival at the stop line is 6 s at first.": {"tta(A0, stop_line, t0) == 6"},
    "The hero begins 8 seconds before the conflict point.": {"tta(A1, conflict_point, t0) == 8"},
}
GAPS = {
    "When the ego is 18 m behind the hero, ": "gap(A0, A1, t1) == 18",
    "Once the gap between the two has shrunk to 18 m, ": "gap(A0, A1, t1) == 18",
    "Once the distance by which the ego trails the hero has shrunk to 18 m, ": "gap(A0, A1, t1) == 18",
    "When only 18 m separate the two, ": "gap(A0, A1, t1) == 18",
    "Once the time headway has dropped to 1.5 s, ": "headway(A0, A1, t1) == 1.5",
    "When the ego trails the hero by 1.5 s, ": "headway(A0, A1, t1) == 1.5",
    "Once the TTC between ego and hero falls to 4 s, ": "ttc(A0, A1, t1) == 4",
}
OUT_AND_BY = "The ego comes out of the driveway and turns left. The hero drives west on the road and goes straight. "


def program_of(text: str) -> Program | None:
    """Return what a text is read as, or None where it is refused."""
    try:
        return translate_offline(text).program
    except TranslationError:
        return None


def ways_of(program: Program) -> list[tuple[str, ...]]:
    """Return the headings of both routes."""
    return [actor.route.headings for actor in program.actors if isinstance(actor.route, HeadingsRoute)]


def said(program: Program) -> set[str]:
    """Return a program's constraints as text, without those that follow from the others."""
    return {print_expression(constraint.formula) for constraint in program.constraints} - set(IMPLIED)


def test_ways() -> None:
    generator = random.Random(7)
    refused, texts = [], 0
    for ego, hero in MEETING:
        for ego_way, hero_way in product(WAYS[ego], WAYS[hero]):
            first, second = generator.choice(CALLED)
            ego_place, hero_place = ("stop line" if way[0] == "S" else "conflict point" for way in (ego, hero))
            brought_in = second if second in ("the hero", "the other car") else second.replace("the ", "a ")
            ego_told = ego_way.format(first[0].upper() + first[1:])
            hero_told = hero_way.format(brought_in[0].upper() + brought_in[1:])
            text = (
                f"{ego_told} {hero_told} When {first} is 20 m from the {ego_place} and {second} is 25 m from the "
                f"{hero_place}, {second} brakes and stops 5 m before the {hero_place}."
            )
            texts += 1
            program = program_of(text)
            if program is None:
                refused.append(text)
            else:
                assert ways_of(program) == [ego, hero], text
    assert len(refused) <= MOST_REFUSED * texts, refused


@pytest.mark.parametrize("ego", EGOS)
def test_names(ego: str) -> None:
    refused = []
    for hero in HEROES:
        noun = hero.split(" ", 1)[1]
        again = "the other car" if hero == "another car" else f"the {noun}"
        text = (
            f"{ego[0].upper()}{ego[1:]} comes out of the driveway and turns left; at first it is 40 m from the stop "
            f"line. "
            f"{hero[0].upper()}{hero[1:]} drives west on the road and goes straight. When {ego} is 12 m from the "
            f"stop line "
            f"and {again} is 34 m from the conflict point, {again} brakes and stops 7 m before the conflict point."
        )
        program = program_of(text)
        if program is None:
            refused.append(text)
            continue
        assert ways_of(program) == [LEFT_OUT, WEST], text
        assert said(program) == {*MET, "A0x(t0) == stop_line - 40", "A1x(t2) == conflict_point - 7"}, text
    assert len(refused) <= MOST_REFUSED * len(HEROES), refused


@pytest.mark.parametrize("trigger", TRIGGERS)
def test_triggers_and_deeds(trigger: str) -> None:
    for deed, meaning in DEEDS.items():
        program = program_of(f"{OUT_AND_BY}{trigger}the hero {deed}")
        assert program is not None, trigger + deed
        assert said(program) == (MET | meaning) - set(IMPLIED), trigger + deed


@pytest.mark.parametrize("first", FIRST)
def test_first_states_wherever_they_are_told(first: str) -> None:
    story = f"{TRIGGERS[0]}the hero brakes and stops 7 m before the conflict point."
    for text in (f"{OUT_AND_BY}{first} {story}", f"{OUT_AND_BY}{story} {first}"):
        program = program_of(text)
        if program is not None:
            assert said(program) == {*MET, *FIRST[first], "A1x(t2) == conflict_point - 7"}, text
    assert program_of(f"{OUT_AND_BY}{first} {story}") is not None


@pytest.mark.parametrize("trigger", GAPS)
def test_gaps(trigger: str) -> None:
    along = "The ego and the hero drive west on the road, both straight on, the hero ahead. "
    program = program_of(f"{along}{trigger}the hero brakes at 3 m/s^2 to a standstill.")
    assert program is not None
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
        "The ego drives west on the road, straight on. The hero is 20 m behind the ego in the same lane, going "
        "straight too. When the ego is 30 m from the intersection, the hero accelerates and passes it before the ego.",
        "The ego is on the driveway and turns right. The hero drives west on the road at 45 km/h. When the ego is 17 m "
        "from the stop line and the hero 37 m from the conflict point, the hero decelerates to 60 km/h.",
        "Ego and hero go straight westbound. When the ego is 25 m behind the hero, the hero brakes at 3.5 m/s^2 to a "
        "standstill, but the ego must by then have overtaken it.",
    ],
)
def test_what_would_be_lost_is_refused(text: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(text)
