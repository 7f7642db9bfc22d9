"""Each invariant of routes and kinematics is fed its violation, and nothing else complains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from plays import PLAYS, YIELDS

from scenewright.errors import InputError
from scenewright.judge.boxes import MovingBox, closest_m, distances_m, overlapping, times_to_collision_s
from scenewright.judge.case import Box
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.program.text import parse_program
from scenewright.trace.model import COLUMNS, ActorTrace, FloatArray, Trace

PARAMETERS = {"gap_m": 20.0, "rate_mpss": 4.0}
HERO_LATE_S = 10.0  # the hero of this play stands from 8.7 s on


def beside(trace: ActorTrace) -> ActorTrace:
    shift = np.where(trace.time_s < HERO_LATE_S, 0.0, np.minimum(0.5 * (trace.time_s - HERO_LATE_S), 1.5))
    return replace(trace, d_m=trace.d_m + shift)


def askew(trace: ActorTrace) -> ActorTrace:
    return replace(trace, heading_rad=trace.heading_rad + 0.7)


def backwards(trace: ActorTrace) -> ActorTrace:
    return replace(trace, s_m=trace.s_m - np.where(trace.time_s > HERO_LATE_S, 1e-3 * (trace.time_s - 10.0) ** 4, 0.0))


def teleporting(trace: ActorTrace) -> ActorTrace:
    step = np.where(trace.time_s > 12.0, 0.1, 0.0)
    return replace(trace, s_m=trace.s_m + step, y_m=trace.y_m - step)


def sliding_on_the_map(trace: ActorTrace) -> ActorTrace:
    return replace(trace, y_m=trace.y_m - np.where(trace.time_s > 12.0, 0.1, 0.0))


def swerving(trace: ActorTrace) -> ActorTrace:
    return replace(trace, heading_rad=trace.heading_rad + 0.3 * np.sin(2 * trace.time_s))


def unexplained(trace: ActorTrace) -> ActorTrace:
    return replace(trace, accel_mps2=np.where(np.arange(len(trace.time_s)) == 50, 6.0, trace.accel_mps2))


VIOLATIONS: dict[str, tuple[Callable[[ActorTrace], ActorTrace], set[str]]] = {
    "beside its line": (beside, {"route_hero"}),
    "askew": (askew, {"route_hero_heading"}),
    "back along its route": (backwards, {"route_hero_progress", "kin_hero_position_drift"}),
    "teleporting": (teleporting, {"kin_hero_position_drift", "kin_hero_map_drift"}),
    "sliding on the map": (sliding_on_the_map, {"kin_hero_map_drift"}),
    "swerving": (swerving, {"kin_hero_lateral"}),
    "stating too much acceleration": (unexplained, {"kin_hero_acceleration"}),
}


@pytest.mark.parametrize("name", VIOLATIONS)
def test_violation_is_found_and_nothing_else(name: str) -> None:
    change, expected = VIOLATIONS[name]
    verdict = judge(YIELDS.case(change))
    assert {c.id for c in verdict.conditions if not c.holds_at(TIGHT)} == expected


@pytest.mark.parametrize(
    ("limit", "value", "expected"),
    [
        ("speed_max_mps", 11.0, "kin_hero_speed"),
        ("accel_min_mpss", -2.0, "kin_hero_deceleration"),
        ("accel_max_mpss", -0.5, "kin_hero_acceleration"),
    ],
)
def test_limit_is_applied(limit: str, value: float, expected: str) -> None:
    case = YIELDS.case()
    narrowed = replace(case, limits={"hero": replace(case.limits["hero"], **{limit: value})})
    assert {c.id for c in judge(narrowed).conditions if not c.holds_at(TIGHT)} == {expected}


def test_kinematics_of_the_ego_are_facts() -> None:
    case = YIELDS.case()
    ego = case.trace.actors["ego"]
    tampered = replace(case, trace=replace(case.trace, actors={**case.trace.actors, "ego": unexplained(ego)}))
    verdict = judge(tampered)
    assert verdict.holds_at(TIGHT)
    assert verdict.facts["kinematics"]["ego"]["acceleration"] == 6.0


def test_trace_with_nan_or_unordered_times_is_refused() -> None:
    def holed(trace: ActorTrace) -> ActorTrace:
        return replace(trace, d_m=np.where(trace.time_s > 5, np.nan, trace.d_m))

    def unordered(trace: ActorTrace) -> ActorTrace:
        return replace(trace, time_s=trace.time_s[::-1].copy())

    for change in (holed, unordered):
        with pytest.raises(InputError, match="no numbers"):
            YIELDS.case(change)


@pytest.mark.parametrize("samples", [1, 2, 3, 150, 250])
def test_run_that_ended_early_fails_without_a_fault(samples: int) -> None:
    case = YIELDS.case()
    columns = ("time_s", *COLUMNS)
    cut = {
        name: ActorTrace(**{column: getattr(states, column)[:samples] for column in columns})
        for name, states in case.trace.actors.items()
    }
    for program in PLAYS.values():
        verdict = judge(replace(case, program=parse_program(program.text), parameters=PARAMETERS, trace=Trace(cut)))
        assert not verdict.holds_at(LOOSE)
        assert verdict.as_dict()["success"] == {"tight": False, "loose": False}


class Line:
    def __init__(self, shift_m: float) -> None:
        self.shift_m = shift_m

    def poses(self, s_m: FloatArray, /) -> FloatArray:
        x0, y0, heading = YIELDS.hero_line
        return np.column_stack([np.full_like(s_m, x0 + self.shift_m), y0 - s_m, np.full_like(s_m, heading)])


@pytest.mark.parametrize(("shift_m", "holds"), [(0.0, True), (0.19, True), (0.3, False)])
def test_map_and_route_coordinates_must_agree(shift_m: float, holds: bool) -> None:
    case = replace(YIELDS.case(), paths={"hero": Line(shift_m)})
    assert judge(case).condition("route_hero_map").holds_at(LOOSE) == holds


@pytest.mark.parametrize(
    ("headings", "holds"), [(("S",), True), (("S", "W"), True), (("N",), False), (("W", "S"), False)]
)
def test_directions(headings: tuple[str, ...], holds: bool) -> None:
    # The hero stops before its turn ends, so only the first direction can be seen.
    case = replace(YIELDS.case(), expected_headings={"hero": headings})
    assert judge(case).condition("route_hero_directions").holds_at(TIGHT) == holds


@pytest.mark.parametrize(("bent_rad", "holds"), [(0.0, True), (1.0, True), (1.1, False), (-2.0, False)])
def test_directions_are_those_of_the_line_where_it_is_known(bent_rad: float, holds: bool) -> None:
    """A road that is called eastbound where it begins may go north further on: who follows it is not to blame."""

    class Bent(Line):
        def poses(self, s_m: FloatArray, /) -> FloatArray:
            return super().poses(s_m) + np.array([0.0, 0.0, bent_rad])

    case = replace(YIELDS.case(), paths={"hero": Bent(0.0)}, expected_headings={"hero": ("E",)})
    assert judge(case).condition("route_hero_directions").holds_at(TIGHT) == holds


def test_directions_after_the_turn() -> None:
    case = YIELDS.with_hero(pieces=[]).case()
    for headings, holds in ((("S", "S"), True), (("S", "W"), False)):
        verdict = judge(replace(case, expected_headings={"hero": headings}))
        assert verdict.condition("route_hero_directions").holds_at(TIGHT) == holds


def boxes_at(*poses: tuple[float, float, float]) -> MovingBox:
    x, y, heading = np.array(poses, dtype=float).T
    return MovingBox(Box(4.0, 2.0), x, y, heading, np.full(len(poses), 10.0))


def test_boxes_overlap_and_distance() -> None:
    a = boxes_at((0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0))
    b = boxes_at((4.5, 0, 0), (3.9, 0, 0), (3.1, 0, np.pi / 2), (0, 3.0, np.pi / 4))
    assert overlapping(a, b).tolist() == [False, True, False, True]
    distances = distances_m(a, b)
    assert distances[:3] == pytest.approx([0.5, 0.0, 0.1])
    assert closest_m(boxes_at((0, 0, 0)), boxes_at((10, 5, 0)))[0] == pytest.approx(np.hypot(6, 3))
    rotated = distances_m(boxes_at((0, 0, 0)), boxes_at((0, 3.5, np.pi / 4)))
    assert rotated == pytest.approx([3.5 - 1.0 - 3.0 * np.sqrt(0.5)])


def test_time_to_collision_of_boxes() -> None:
    standing = replace(boxes_at((24.0, 0, 0)), speed_mps=np.zeros(1))
    assert times_to_collision_s(boxes_at((0, 0, 0)), standing) == pytest.approx([2.0], abs=0.11)
    assert times_to_collision_s(boxes_at((0, 10, 0)), standing) == [np.inf]
