"""The paper's descriptions, judged against facts written by hand from its taxonomy."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import pytest

from scenewright.program.printer import print_expression, print_program
from scenewright.program.text import parse_program
from scenewright.program.types import HeadingsRoute, Program
from scenewright.translate.offline import translate_offline

DESCRIPTIONS = Path(__file__).resolve().parents[2].parent / "shared" / "paper" / "descriptions-dev.json"

YIELDS = "A1x(t2) == conflict_point - end_hero_distance_behind_conflict_point_m"
STANDS = "A1v(t2) == 0"
BRAKES = ("A1a(dec) == -hero_deceleration_mpss", STANDS)
STANDS_THEN = ("A1v(stop) == 0",)
EGO_TURNS = "A0x(t2) == turn_start"
EGO_PASSES = "A0x(t2) == conflict_point"


@dataclass(frozen=True)
class Expected:
    """What a person reads in a description: routes, the hero's pieces, and every constraint."""

    ego: str
    hero: str
    pieces: str
    initial: tuple[str, ...]
    trigger: tuple[str, ...]
    then: tuple[str, ...]


def near(actor: int, landmark: str, parameter: str, knot: str = "t1") -> str:
    if parameter.endswith("_s"):
        return f"tta(A{actor}, {landmark}, {knot}) == {parameter}"
    return f"A{actor}x({knot}) == {landmark} - {parameter}"


EGO_LINE_M = near(0, "stop_line", "initial_ego_distance_behind_stop_line_m", "t0")
EGO_LINE_S = near(0, "stop_line", "initial_ego_tta_behind_stop_line_s", "t0")
EGO_CROSSING_M = near(0, "intersection", "initial_ego_distance_behind_intersection_m", "t0")
EGO_CROSSING_S = near(0, "intersection", "initial_ego_tta_behind_intersection_s", "t0")
AT_LINE_M = near(0, "stop_line", "ego_distance_behind_stop_line_m")
AT_POINT_M = near(0, "conflict_point", "ego_distance_behind_conflict_point_m")
AT_POINT_S = near(0, "conflict_point", "ego_tta_behind_conflict_point_s")
HERO_POINT_M = near(1, "conflict_point", "hero_distance_behind_conflict_point_m")
HERO_PLAIN_M = near(1, "conflict_point", "distance_behind_conflict_point_m")
HERO_PLAIN_S = near(1, "conflict_point", "tta_behind_conflict_point_s")
HERO_LINE_M = near(1, "stop_line", "hero_distance_behind_stop_line_m")
HERO_LINE_S = near(1, "stop_line", "hero_tta_behind_stop_line_s")
GAP = "gap(A0, A1, t1) == ego_distance_behind_hero_m"
LINE_STOP = "A1x(t2) == stop_line - 5"
PASSES = ("A1x(t2) == conflict_point",)
TURNS = ("A1x(t2) == turn_end",)
FIRST = "A1(t2) < A0(t2)"
LATER = "A1(t4) < A0(t2)"
STOP_GO = "go dec stop acc"

ORACLE = {
    4: Expected("SW", "W", STOP_GO, (EGO_LINE_M,), (AT_LINE_M, HERO_PLAIN_M),
                (YIELDS, STANDS, *STANDS_THEN, "A1x(t4) == conflict_point", EGO_TURNS, LATER)),
    5: Expected("SE", "SE", "go dec",
                (EGO_LINE_M, near(1, "stop_line", "initial_hero_distance_behind_stop_line_m", "t0")), (GAP,), BRAKES),
    7: Expected("SE", "W", "go acc", (EGO_LINE_M,), (AT_LINE_M, HERO_PLAIN_M), (*PASSES, EGO_TURNS, FIRST)),
    11: Expected("SE", "E", STOP_GO, (EGO_LINE_M,), (AT_LINE_M, HERO_PLAIN_M),
                 (YIELDS, STANDS, *STANDS_THEN, "A1x(t4) == conflict_point", EGO_TURNS, LATER)),
    16: Expected("W", "EN", "go dec", (EGO_CROSSING_M,), (AT_POINT_M, HERO_POINT_M), (YIELDS, STANDS)),
    19: Expected("W", "SW", "go dec", (EGO_CROSSING_M,), (AT_POINT_M, HERO_LINE_M), (LINE_STOP, STANDS)),
    20: Expected("W", "SW", "go acc", (EGO_CROSSING_M,), (AT_POINT_M, HERO_LINE_M), (*TURNS, EGO_PASSES, FIRST)),
    32: Expected("EN", "W", "go dec", (EGO_CROSSING_M,), (AT_POINT_M, HERO_POINT_M), (YIELDS, STANDS)),
    37: Expected("EN", "WN", STOP_GO, (EGO_CROSSING_M,), (AT_POINT_M, HERO_PLAIN_M),
                 (YIELDS, STANDS, *STANDS_THEN, "A1x(t4) == conflict_point", EGO_TURNS, LATER)),
    39: Expected("EN", "SE", "go acc", (EGO_CROSSING_M,), (AT_POINT_M, HERO_LINE_M), (*PASSES, EGO_PASSES, FIRST)),
    49: Expected("SE", "E", "go dec", (EGO_LINE_S,),
                 (near(0, "stop_line", "ego_tta_behind_stop_line_s"),
                  near(1, "conflict_point", "hero_tta_behind_conflict_point_s")), (YIELDS, STANDS)),
    55: Expected("W", "W", "go dec", (EGO_CROSSING_S,), (GAP,), BRAKES),
    59: Expected("W", "SW", "go dec", (EGO_CROSSING_S,), (AT_POINT_S, HERO_LINE_S), (LINE_STOP, STANDS)),
    60: Expected("W", "SW", "go acc", (EGO_CROSSING_S,), (AT_POINT_S, HERO_LINE_S), (*TURNS, EGO_PASSES, FIRST)),
    61: Expected("W", "SW", STOP_GO, (EGO_CROSSING_S,), (AT_POINT_S, HERO_LINE_S),
                 (LINE_STOP, STANDS, *STANDS_THEN, "A1x(t4) == turn_end", EGO_PASSES, LATER)),
    63: Expected("W", "SE", "go acc", (EGO_CROSSING_S,), (AT_POINT_S, HERO_LINE_S), (*TURNS, EGO_PASSES, FIRST)),
    73: Expected("EN", "W", "go acc", (EGO_CROSSING_S,), (AT_POINT_S, HERO_PLAIN_S), (*PASSES, EGO_TURNS, FIRST)),
    74: Expected("EN", "W", STOP_GO, (EGO_CROSSING_S,), (AT_POINT_S, HERO_PLAIN_S),
                 (YIELDS, STANDS, *STANDS_THEN, "A1x(t4) == conflict_point", EGO_TURNS, LATER)),
    75: Expected("EN", "WN", "go dec", (EGO_CROSSING_S,),
                 (AT_POINT_S, near(1, "conflict_point", "hero_tta_behind_conflict_point_s")), (YIELDS, STANDS)),
    80: Expected("EN", "SE", STOP_GO, (EGO_CROSSING_S,), (AT_POINT_S, HERO_LINE_S),
                 (LINE_STOP, STANDS, *STANDS_THEN, "A1x(t4) == conflict_point", EGO_PASSES, LATER)),
}  # fmt: skip

LEAD_TURN = (
    "Ego is lane-following straight along the road at {ego_initial_speed_mps}m/s. There is a driveway 100m in "
    "front of the ego that merges into the ego's lane. There is a lead vehicle that is initially driving at "
    "{initial_speed_mps}m/s. When the lead vehicle is {distance_ahead_of_ego_m}m ahead of the ego, it turns "
    "right into the driveway and gradually comes to a stop."
)
ONCOMING_TURN = (
    "Ego is lane-following straight along the road at {ego_initial_speed_mps}m/s. There is a driveway 100m in "
    "front of the ego that merges into the ego's lane. There is a car in the oncoming lane driving straight. "
    "When the time-to-collision between the ego and the car is {ttc_s}s, the car should arrive at the mouth of "
    "the driveway and turn left across the ego's path and into the driveway."
)
INTO_PATH = (
    "Ego is lane-following straight along the road at {ego_initial_speed_mps}m/s. There is a driveway 100m in "
    "front of the ego that merges into the ego's lane. There is a car on the driveway that turns right into the "
    "ego's lane when the ego is about {tta_s}s away from the driveway. After turning right, the car starts "
    "lane-following straight at {target_speed_mps}m/s."
)
ACROSS_PATH = (
    "Ego is lane-following straight along the road at {ego_initial_speed_mps}m/s. There is a driveway 100m in "
    "front of the ego that merges into the ego's lane. There is a car on the driveway that turns left across the "
    "ego's path onto the ego's oncoming lane when the ego is about {tta_s}s away from the driveway."
)
HESITATES = (
    "Ego is on the driveway. It is driving at {ego_initial_speed_mps}m/s. \nIt wants to make a right turn onto "
    "the road. \nThere is a car in the lane that the ego wants to turn into. \nThe car is initially driving at "
    "{initial_speed_mps}m/s. \nIt decelerates at a rate of {deceleration_mpss}m/s^2 to a complete stop,\nas if "
    "to yield, exactly {distance_to_driveway_m}m from the driveway.\nIt then re-accelerates back to "
    "{initial_speed_mps}m/s.\n"
)
EGO_100 = ("A0x(t0) == turn - 100", "A0v(t0) == ego_initial_speed_mps")

LONGER_TEXTS = [
    (LEAD_TURN, Expected("W", "WN", "go dec", (*EGO_100, "A1v(t0) == initial_speed_mps"),
                         ("gap(A0, A1, t1) == distance_ahead_of_ego_m",), ("A1x(t1) == turn", STANDS))),
    (ONCOMING_TURN, Expected("W", "EN", "go go", EGO_100, ("tta(A0, conflict_point, t1) == ttc_s",),
                             ("A1x(t1) == turn_start", "A1x(t2) == turn_end"))),
    (INTO_PATH, Expected("W", "SW", "go go acc go", EGO_100, ("tta(A0, turn, t1) == tta_s",),
                         ("A1x(t1) == turn_start", "A1x(t2) == turn_end", "A1v(t3) == target_speed_mps"))),
    (ACROSS_PATH, Expected("W", "SE", "go go", EGO_100, ("tta(A0, turn, t1) == tta_s",),
                           ("A1x(t1) == turn_start", "A1x(t2) == turn_end"))),
]  # fmt: skip


def formulas(program: Program) -> list[str]:
    return [print_expression(constraint.formula) for constraint in program.constraints]


def headings(program: Program, actor: int) -> str:
    route = program.actor(actor).route
    assert isinstance(route, HeadingsRoute)
    return "".join(route.headings)


def check(text: str, expected: Expected) -> None:
    program = translate_offline(text).program
    assert headings(program, 0) == expected.ego
    assert headings(program, 1) == expected.hero
    assert " ".join(map(str, program.actor(1).sketch.pieces)) == expected.pieces
    assert " ".join(map(str, program.ego.sketch.pieces)) == "go go"
    assert formulas(program) == [*expected.initial, "A0(t1) == A1(t1)", *expected.trigger, *expected.then]
    assert parse_program(print_program(program)) == program


@pytest.mark.parametrize("row", sorted(ORACLE))
def test_benchmark_description(row: int) -> None:
    if not DESCRIPTIONS.is_file():
        pytest.skip("the paper's descriptions are not beside the clone")
    texts = {entry["id"]: entry["text"] for entry in json.loads(DESCRIPTIONS.read_text(encoding="utf-8"))}
    check(texts[row], ORACLE[row])


@pytest.mark.parametrize(("text", "expected"), LONGER_TEXTS, ids=["lead", "oncoming", "into-path", "across-path"])
def test_open_and_closed_loop_description(text: str, expected: Expected) -> None:
    check(text, expected)


def test_hesitating_hero_stops_while_the_ego_is_before_its_stop_line() -> None:
    """The paper's pseudocode, but for the ego's place: at the conflict point itself (`turn`) the two would meet."""
    program = translate_offline(HESITATES).program
    assert (headings(program, 0), headings(program, 1)) == ("SW", "W")
    assert " ".join(map(str, program.actor(1).sketch.pieces)) == "dec stop acc"
    assert set(formulas(program)) == {
        "A0v(t0) == ego_initial_speed_mps",
        "A1v(t0) == initial_speed_mps",
        "A1a(dec) == -deceleration_mpss",
        "A1v(t1) == 0",
        "A1x(t1) == turn - distance_to_driveway_m",
        "A1v(stop) == 0",
        "A0x(t1) == stop_line - 5",
        "A0(t1) == A1(t1)",
        "A1(t2) > A0(t1)",
        "A1v(t3) == initial_speed_mps",
    }
