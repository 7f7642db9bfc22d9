"""Each invariant of motion is fed its violation, just within what is tolerated and just beyond."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
import pytest
from plays import YIELDS, failed

from scenewright.judge.case import Case, PathLike
from scenewright.judge.judgement import judge
from scenewright.judge.kinematics import Finding, kinematic_findings
from scenewright.judge.tolerance import TIGHT
from scenewright.program.types import EGO
from scenewright.trace.model import COLUMNS, ActorTrace, FloatArray, Trace


def teleporting(trace: ActorTrace) -> ActorTrace:
    step = np.where(trace.time_s > 12.0, 0.1, 0.0)
    return replace(trace, s_m=trace.s_m + step, y_m=trace.y_m - step)


def sliding_on_the_map(trace: ActorTrace) -> ActorTrace:
    return replace(trace, y_m=trace.y_m - np.where(trace.time_s > 12.0, 0.1, 0.0))


def swerving(trace: ActorTrace) -> ActorTrace:
    return replace(trace, heading_rad=trace.heading_rad + 0.3 * np.sin(2 * trace.time_s))


def unexplained(trace: ActorTrace) -> ActorTrace:
    return replace(trace, accel_mps2=np.where(np.arange(len(trace.time_s)) == 50, 6.0, trace.accel_mps2))


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


def with_ego(change: Callable[[ActorTrace], ActorTrace], paths: Mapping[str, PathLike] | None = None) -> Case:
    case = YIELDS.case()
    trace = Trace({**case.trace.actors, "ego": change(case.trace.actors["ego"])})
    return replace(case, trace=trace, paths=paths or {})


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (teleporting, {"kin_ego_position_drift", "kin_ego_map_drift"}),
        (sliding_on_the_map, {"kin_ego_map_drift"}),
        (lambda ego: replace(ego, speed_mps=ego.speed_mps + from_sample(ego, 600, 0.4)), {"kin_ego_speed_jump"}),
        (lambda ego: replace(ego, accel_mps2=0 * ego.accel_mps2), {"kin_ego_speed_jump"}),
        (lambda ego: replace(ego, accel_mps2=ego.accel_mps2 - 0.5), {"kin_ego_speed_jump"}),
        (lambda ego: replace(ego, speed_mps=2 * ego.speed_mps), {"kin_ego_position_drift", "kin_ego_map_drift"}),
        (lambda ego: replace(ego, speed_mps=0 * ego.speed_mps), {"kin_ego_position_drift", "kin_ego_map_drift"}),
    ],
)
def test_an_ego_that_is_not_where_its_speed_says_is_not_judged_by_what_it_states(
    change: Callable[[ActorTrace], ActorTrace], expected: set[str]
) -> None:
    verdict = judge(with_ego(change))
    assert expected <= failed(verdict, TIGHT)
    assert all(verdict.condition(each).kind == "safety" for each in expected)


class Bend:
    """A left turn with a radius of 20 m."""

    def poses(self, s_m: FloatArray, /) -> FloatArray:
        angle = s_m / 20.0
        return np.column_stack([20.0 * np.sin(angle), 20.0 - 20.0 * np.cos(angle), angle])


@pytest.mark.parametrize("beside_m", [0.9, -0.9, 0.0])
def test_beside_the_line_of_a_bend_the_way_is_not_as_long_as_the_line(beside_m: float) -> None:
    def round_the_bend(ego: ActorTrace) -> ActorTrace:
        turned = (ego.s_m - ego.s_m[0]) / (20.0 - beside_m)
        x_m, y_m = (20.0 - beside_m) * np.sin(turned), 20.0 - (20.0 - beside_m) * np.cos(turned)
        beside = np.full_like(turned, beside_m)
        return replace(ego, s_m=20.0 * turned, d_m=beside, x_m=x_m, y_m=y_m, heading_rad=turned)

    case = with_ego(round_the_bend, {"ego": Bend()})
    assert [each.measured for each in kinematic_findings(case, EGO)[:3]] == pytest.approx([0.0] * 3, abs=0.01)


VIOLATIONS: dict[str, tuple[Callable[[ActorTrace], ActorTrace], set[str]]] = {
    "teleporting": (teleporting, {"kin_hero_position_drift", "kin_hero_map_drift"}),
    "sliding on the map": (sliding_on_the_map, {"kin_hero_map_drift"}),
    "swerving": (swerving, {"kin_hero_lateral"}),
    "stating too much acceleration": (unexplained, {"kin_hero_acceleration"}),
}


@pytest.mark.parametrize("name", VIOLATIONS)
def test_violation_is_found_and_nothing_else(name: str) -> None:
    change, expected = VIOLATIONS[name]
    assert failed(judge(YIELDS.case(change)), TIGHT) == expected


def findings(change: Callable[[ActorTrace], ActorTrace]) -> dict[str, Finding]:
    return {finding.name: finding for finding in kinematic_findings(YIELDS.case(change), 1)}


def worst(change: Callable[[ActorTrace], ActorTrace]) -> dict[str, float]:
    return {name: finding.measured for name, finding in findings(change).items()}


def from_sample(trace: ActorTrace, number: int, by: float) -> FloatArray:
    return np.where(np.arange(len(trace.time_s)) >= number, by, 0.0)


@pytest.mark.parametrize("by", [0.2, 0.3, -0.2, -0.3])
def test_a_jump_of_speed_is_as_large_as_it_is(by: float) -> None:
    jump = worst(lambda trace: replace(trace, speed_mps=trace.speed_mps + from_sample(trace, 60, by)))["speed_jump"]
    assert jump == pytest.approx(abs(by), abs=1e-6)


def test_a_piece_that_ends_between_samples_is_no_jump() -> None:
    assert worst(lambda trace: trace)["speed_jump"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("by_m", [0.004, -0.006])
def test_a_step_of_place_is_a_speed_that_is_not_stated(by_m: float) -> None:
    """In 0.02 s; along the route and on the map apart."""
    along = worst(lambda trace: replace(trace, s_m=trace.s_m + from_sample(trace, 60, by_m)))
    assert along["position_drift"] == pytest.approx(abs(by_m) / 0.02, abs=1e-2)
    on_map = worst(lambda trace: replace(trace, y_m=trace.y_m - from_sample(trace, 60, by_m)))
    assert on_map["map_drift"] == pytest.approx(abs(by_m) / 0.02, abs=1e-2)
    assert on_map["position_drift"] < 0.01


def test_driving_backwards_is_found_by_its_speed() -> None:
    late = worst(lambda trace: replace(trace, speed_mps=trace.speed_mps - from_sample(trace, 600, 0.3)))
    assert late["reverse"] == pytest.approx(0.3, abs=1e-6)


@pytest.mark.parametrize("turning", [0.1, -0.25])
def test_lateral_acceleration_is_speed_by_rate_of_turning(turning: float) -> None:
    turned = worst(lambda trace: replace(trace, heading_rad=trace.heading_rad + turning * trace.time_s))
    assert turned["lateral"] == pytest.approx(12.0 * abs(turning), rel=1e-3)


def test_errors_count_from_the_limit_on() -> None:
    over = findings(lambda trace: replace(trace, speed_mps=trace.speed_mps + 9.0))["speed"]
    assert (over.required, over.error) == (20.0, pytest.approx(1.0))
    assert findings(lambda trace: trace)["speed"].error == 0.0


@pytest.mark.parametrize("samples", [1, 2, 3])
def test_a_trace_of_a_few_samples_has_findings_too(samples: int) -> None:
    case = YIELDS.case()
    cut = {
        name: ActorTrace(**{column: getattr(states, column)[:samples] for column in ("time_s", *COLUMNS)})
        for name, states in case.trace.actors.items()
    }
    short = kinematic_findings(replace(case, trace=Trace(cut)), 1)
    assert [finding.error for finding in short] == pytest.approx([0.0] * len(short), abs=1e-6)
