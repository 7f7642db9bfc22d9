"""Each invariant of a route is fed its violation, just within its limit and just beyond, and nothing else complains."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from plays import YIELDS, Line

from scenewright.judge.judgement import judge
from scenewright.judge.route import BACK_M, MAX_ANGLE_RAD, MAX_LATERAL_M, route_conditions
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.trace.model import ActorTrace, FloatArray

HERO_LATE_S = 10.0  # the hero of this play stands from 8.7 s on


def beside(trace: ActorTrace) -> ActorTrace:
    shift = np.maximum(0.24 * (trace.time_s - 9.0), 0.0)  # slowly: who stands is not to be seen moving
    return replace(trace, d_m=trace.d_m + shift)


def askew(trace: ActorTrace) -> ActorTrace:
    return replace(trace, heading_rad=trace.heading_rad + 0.7)


def backwards(trace: ActorTrace) -> ActorTrace:
    return replace(trace, s_m=trace.s_m - np.where(trace.time_s > HERO_LATE_S, 1e-3 * (trace.time_s - 10.0) ** 4, 0.0))


VIOLATIONS: dict[str, tuple[Callable[[ActorTrace], ActorTrace], set[str]]] = {
    "beside its line": (beside, {"route_hero", "route_hero_map"}),
    "askew": (askew, {"route_hero_heading", "route_hero_directions"}),
    "back along its route": (backwards, {"route_hero_progress", "route_hero_map", "kin_hero_position_drift"}),
}


@pytest.mark.parametrize("name", VIOLATIONS)
def test_violation_is_found_and_nothing_else(name: str) -> None:
    change, expected = VIOLATIONS[name]
    verdict = judge(YIELDS.case(change))
    assert {c.id for c in verdict.conditions if not c.holds_at(TIGHT)} == expected


@pytest.mark.parametrize(("shift_m", "holds"), [(0.0, True), (0.19, True), (0.3, False)])
def test_map_and_route_coordinates_must_agree(shift_m: float, holds: bool) -> None:
    x_m, y_m, heading_rad = YIELDS.hero_line
    case = replace(YIELDS.case(), paths={"hero": Line(x_m + shift_m, y_m, heading_rad)})
    assert judge(case).condition("route_hero_map").holds_at(LOOSE) == holds


def test_without_its_path_a_route_is_not_judged_and_fails() -> None:
    found = {each.id: each for each in route_conditions(replace(YIELDS.case(), paths={}, unmapped={"ego": "no map"}))}
    assert not any(
        found[f"route_{name}_{what}"].holds_at(LOOSE) for name in ("ego", "hero") for what in ("map", "directions")
    )
    assert found["route_ego_map"].text == "the ego is on the map where its route coordinates say (not judged: no map)"
    assert "(not judged: the path of its route is not known)" in found["route_hero_map"].text


@pytest.mark.parametrize(
    ("headings", "holds"), [(("S",), True), (("S", "W"), True), (("N",), False), (("W", "S"), False)]
)
def test_directions_without_a_map(headings: tuple[str, ...], holds: bool) -> None:
    # The hero stops before its turn ends, so only the first direction can be seen.
    case = replace(YIELDS.case(), paths={}, expected_headings={"hero": headings})
    assert judge(case).condition("route_hero_directions").holds_at(TIGHT) == holds


@pytest.mark.parametrize(("bent_rad", "holds"), [(0.0, True), (0.45, True), (-0.55, False), (-2.0, False)])
def test_directions_are_those_of_the_line_where_it_is_known(bent_rad: float, holds: bool) -> None:
    """A road that is called eastbound where it begins may go north further on: who follows it is not to blame."""

    class Bent(Line):
        def poses(self, s_m: FloatArray, /) -> FloatArray:
            return super().poses(s_m) + np.array([0.0, 0.0, bent_rad])

    case = replace(YIELDS.case(), paths={"hero": Bent(*YIELDS.hero_line)}, expected_headings={"hero": ("E",)})
    assert judge(case).condition("route_hero_directions").holds_at(TIGHT) == holds


def test_directions_after_the_turn() -> None:
    case = replace(YIELDS.with_hero(pieces=[]).case(), paths={})
    for headings, holds in ((("S", "S"), True), (("S", "W"), False)):
        verdict = judge(replace(case, expected_headings={"hero": headings}))
        assert verdict.condition("route_hero_directions").holds_at(TIGHT) == holds


@pytest.mark.parametrize(
    ("condition", "limit", "by"),
    [
        ("route_hero", MAX_LATERAL_M, lambda trace, by: replace(trace, d_m=trace.d_m - by)),
        ("route_hero_heading", MAX_ANGLE_RAD, lambda trace, by: replace(trace, heading_rad=trace.heading_rad - by)),
        ("route_hero_progress", BACK_M, lambda trace, by: replace(trace, s_m=trace.s_m - after_stop(trace, by))),
    ],
)
def test_up_to_its_limit_a_route_is_kept(
    condition: str, limit: float, by: Callable[[ActorTrace, float], ActorTrace]
) -> None:
    for share, holds in ((0.98, True), (1.02, False)):
        case = YIELDS.case(lambda trace, share=share: by(trace, share * limit))
        (found,) = [each for each in route_conditions(case) if each.id == condition]
        assert found.measured == pytest.approx(share * limit, abs=1e-6)
        assert found.holds_at(LOOSE) == found.holds_at(TIGHT) == holds  # no tolerance but the limit itself


def after_stop(trace: ActorTrace, by_m: float) -> FloatArray:
    return np.where(trace.time_s > HERO_LATE_S, by_m, 0.0)


def test_who_creeps_may_point_anywhere() -> None:
    """Below half a metre a second the way between two samples says nothing of a direction."""
    case = YIELDS.with_hero(speed_mps=0.4, pieces=[]).case(askew)
    (found,) = [each for each in route_conditions(case) if each.id == "route_hero_heading"]
    assert found.measured == 0.0
