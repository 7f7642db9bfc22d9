"""What a case answers for names: landmarks, lanes in common, defaults; what is no case is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from plays import AHEAD, BRAKES, YIELDS, failed

from scenewright.errors import InputError
from scenewright.judge.case import Box, CannotJudge, Limits
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.program.text import parse_program
from scenewright.roads.bodies import CAR
from scenewright.trace.model import ActorTrace, Trace


def test_hero_that_follows_in_the_same_lane_is_measured_with_the_shared_offset() -> None:
    shifted = replace(BRAKES, offset_m=-200.0).with_hero(s_m=235.0)
    verdict = judge(replace(shifted, hero_line=(-200.0, *AHEAD[1:])).case())
    assert not failed(verdict, TIGHT)
    assert verdict.condition("c3").measured == pytest.approx(20.0, abs=1e-3)


def test_trace_with_nan_or_unordered_times_is_refused() -> None:
    def holed(trace: ActorTrace) -> ActorTrace:
        return replace(trace, d_m=np.where(trace.time_s > 5, np.nan, trace.d_m))

    def unordered(trace: ActorTrace) -> ActorTrace:
        return replace(trace, time_s=trace.time_s[::-1].copy())

    for change, found in ((holed, "d_m nan at step "), (unordered, "time_s ")):
        with pytest.raises(InputError, match="the trace of hero cannot be judged") as caught:
            YIELDS.case(change)
        assert (caught.value.found or "").startswith(found)


def test_a_landmark_is_that_of_its_partner_or_of_the_usual_one() -> None:
    case = replace(
        YIELDS.case(),
        landmarks={
            "ego": {"stop_line": 60.0, "conflict_point": 70.0, "conflict_point(hero)": 71.0, "intersection": 72.0},
            "hero": {"conflict_point": 100.0},
        },
    )
    assert case.landmark_m("stop_line", 0) == 60.0
    assert case.landmark_m("conflict_point", 0) == 70.0
    assert case.landmark_m("conflict_point", 0, 1) == 71.0
    assert case.landmark_m("conflict_point", 1, 0) == 100.0
    assert case.landmark_m("turn", 0) == 72.0  # without one of its own
    for name, actor, other in (("stop_line", 1, None), ("turn", 1, None), ("conflict_point", 1, 1)):
        with pytest.raises(CannotJudge, match=f"the route of hero has no landmark {name}"):
            case.landmark_m(name, actor, other)


def test_lanes_in_common_are_told_either_way_round() -> None:
    case = replace(BRAKES.case(), shared_offset_m={("ego", "hero"): -200.0})
    assert (case.offset_m(0, 1), case.offset_m(1, 0), case.offset_m(0, 0)) == (-200.0, 200.0, 0.0)
    apart = replace(case, shared_offset_m={("ego", "hero"): None})
    assert (apart.offset_m(0, 1), apart.offset_m(1, 0)) == (None, None)
    assert replace(case, shared_offset_m={}).offset_m(1, 0) is None


def test_what_is_not_told_of_a_vehicle_is_that_of_a_car_and_of_no_limits_but_a_road_vehicle_s() -> None:
    case = replace(BRAKES.case(), vehicles={"hero": Box(8.0, 2.5)}, limits={})
    assert (case.box(0), case.box(1)) == (CAR, Box(8.0, 2.5))
    assert case.limits_of(1) == Limits()


def test_a_case_ends_where_its_trace_does() -> None:
    case = BRAKES.case()
    assert (case.start_s, case.end_s) == (0.0, case.trace.time_s[-1])


def test_what_was_left_to_be_understood_is_resolved() -> None:
    place = YIELDS.case().program.constraint("c4").formula.right.left  # type: ignore[union-attr]
    assert (place.actor, place.other) == (1, 0)


def test_a_trace_without_an_actor_and_a_parameter_without_a_value_are_refused() -> None:
    case = BRAKES.case()
    with pytest.raises(InputError, match="lacks an actor") as caught:
        replace(case, trace=Trace({"ego": case.trace.actors["ego"]}))
    assert (caught.value.expected, caught.value.found) == ("hero", "ego")
    declared = BRAKES.text.replace("description:", "parameters:\n- gap_m\n- rate_mpss\ndescription:", 1)
    with pytest.raises(InputError, match="has no value") as unset:
        replace(case, program=parse_program(declared), parameters={"gap_m": 20.0})
    assert unset.value.expected == "rate_mpss"
