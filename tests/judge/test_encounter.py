"""Who never met its side of a trigger, and how near it came: by how much it was missed, in its own unit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from plays import BRAKES, YIELDS, YIELDS_AT_S, Play

from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT


def test_ego_that_never_comes_to_the_trigger_is_told_with_evidence() -> None:
    facts = judge(YIELDS.with_ego(pieces=[(1.752998, 0.0), (9.0, -4.0)]).case()).facts
    assert facts["ego_never_met_condition"]
    assert not facts["hero_never_met_condition"]
    ego = next(side for side in facts["closest"] if side["who"] == "ego")
    assert (ego["met"], ego["unit"]) == (False, "m")
    assert ego["error"] == pytest.approx(10.0, abs=0.01)
    assert not judge(YIELDS.case()).facts["ego_never_met_condition"]


def test_hero_that_never_comes_is_told_apart_from_the_ego() -> None:
    facts = judge(YIELDS.with_hero(s_m=-60.0).case()).facts
    assert facts["hero_never_met_condition"]
    assert not facts["ego_never_met_condition"]


def side(play: Play, who: str) -> dict[str, object]:
    found = [each for each in judge(play.case()).facts["closest"] if each["who"] == who]
    assert found
    return found[0]


@pytest.mark.parametrize(("short_m", "met"), [(0.49, True), (0.51, False)])
def test_a_side_is_met_up_to_the_tight_tolerance(short_m: float, met: bool) -> None:
    """The ego stops so far before its side of the trigger, and never gets there."""
    stops = YIELDS.with_ego(pieces=[(0.0, 0.0), (30.0, -(8.0**2) / (2.0 * (42.0 - YIELDS.ego.s_m - short_m)))])
    ego = side(stops, "ego")
    assert (ego["met"], ego["unit"]) == (met, "m")
    assert ego["error"] == pytest.approx(short_m, abs=1e-3)
    assert judge(stops.case()).facts["ego_never_met_condition"] is not met


def test_a_side_of_both_is_nobody_s_alone() -> None:
    """The gap of 20 m never comes: it is 23 m at the least."""
    far = judge(BRAKES.with_ego(pieces=[(6.0, 0.0), (9.0, -8.0)]).case()).facts
    assert (far["ego_never_met_condition"], far["hero_never_met_condition"]) == (False, False)
    assert far["pair_never_met_condition"]
    assert far["closest"][0]["error"] == pytest.approx(3.0, abs=0.5)
    assert not judge(BRAKES.case()).facts["pair_never_met_condition"]


def test_sides_that_were_met_at_other_times_are_told_how_far_apart() -> None:
    (even, brakes) = ((YIELDS_AT_S + 2.0, 0.0), YIELDS.hero.pieces[1])  # 24 m at 12 m/s are 2 s
    late = judge(YIELDS.with_hero(s_m=YIELDS.hero.s_m - 24.0, pieces=[even, brakes]).case()).facts
    assert late["trigger_sides_apart_s"] == pytest.approx(2.0, abs=0.05)
    assert judge(YIELDS.case()).facts["trigger_sides_apart_s"] == pytest.approx(0.0, abs=1e-6)
    never = judge(YIELDS.with_hero(s_m=-60.0, pieces=[(1.0, 0.0), (9.0, -4.0)]).case()).facts
    assert never["trigger_sides_apart_s"] is None


def test_a_trigger_that_is_missed_by_far_never_came_though_some_instant_is_nearest() -> None:
    assert judge(YIELDS.case()).facts["trigger_came"] == {"hero": True}
    late = judge(YIELDS.with_hero(s_m=YIELDS.hero.s_m - 24.0).case())
    assert np.isfinite(late.facts["trigger_time_s"]["hero"])
    assert late.facts["trigger_came"] == {"hero": False}


def test_who_meets_each_part_of_its_side_and_never_all_at_once_never_met_it() -> None:
    """The ego is slow enough only after it was where the trigger waits for it."""
    slows = YIELDS.with_ego(pieces=[(6.0, 0.0), (2.0, -2.0)])
    facts = judge(replace(slows, text=slows.text + "slow: A0v(t1) <= 6\n").case()).facts
    assert facts["ego_never_met_condition"]
    *parts, whole = [each for each in facts["closest"] if each["who"] == "ego"]
    assert [each["met"] for each in parts] == [True, True]
    assert whole["side"] == " and ".join(each["side"] for each in parts)
    assert (whole["met"], whole["unit"]) == (False, "tight tolerances")
    assert 1.0 < whole["error"] <= 2.0 / 0.25
    assert not judge(replace(slows, text=slows.text + "slow: A0v(t1) <= 8\n").case()).facts["ego_never_met_condition"]


def test_what_is_to_last_after_a_trigger_says_nothing_of_whether_it_came() -> None:
    """The ego drives into a hero that brakes as it should: that is what came of it, 2.4 s after the trigger."""
    hits = BRAKES.with_ego(pieces=[])
    lasting = "never[A0(t1), A0(t1) + 5] (freespace(A0, A1) < 4)"
    verdict = judge(replace(hits, text=f"{hits.text}apart: {lasting}\n").case())
    assert not verdict.condition("apart").holds_at(LOOSE)
    assert verdict.condition("apart").kind == "outcome"
    assert verdict.facts["trigger_came"] == {"hero": True}
    assert verdict.condition("no_collision").holds_at(TIGHT)
