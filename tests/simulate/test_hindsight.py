"""What an ego denied is told apart from what was missed, and of every moment at which it was at its side."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from scenewright.motion.profile import Profile, chain
from scenewright.program.types import EGO
from scenewright.simulate.hindsight import _ego_knots, _moments_at, drive_profile, ego_left_no_room
from scenewright.solve.arrival import TIGHT_TIME_S, LinearCondition, tight_of
from scenewright.solve.feasibility import Feasibility
from stories import HERO, STORIES, Scripted, Stage, driven

# It brakes to a stand 10 m before the place, stands for 3 s and sets off again.
STOPS = Profile(chain(0.0, 0.0, 10.0, [(4.0, 0.0, 0), (5.0, -2.0, 0), (3.0, 0.0, 0), (5.0, 1.5, 0)]))
PLACE_M = 75.0


def arrival_in(seconds: float) -> LinearCondition:
    return LinearCondition("c", frozenset({(EGO, "t1")}), PLACE_M, {EGO: (-1.0, -seconds)})


def at(place_m: float) -> LinearCondition:
    return LinearCondition("c", frozenset({(EGO, "t1")}), -place_m, {EGO: (1.0, 0.0)})


def test_time_to_arrival_that_is_met_again_after_a_stop_counts_again() -> None:
    moments = _moments_at(arrival_in(4.0), STOPS, 17.0)
    assert min(moments) < 9.0
    assert max(moments) > 12.0


def test_no_moment_within_tolerance_is_farther_than_the_proof_allows() -> None:
    for side in (arrival_in(4.0), arrival_in(3.0), at(40.0), at(65.0), at(64.8)):
        moments = np.asarray(_moments_at(side, STOPS, 17.0))
        for time_s in np.arange(0.0, 17.0, 0.01):
            s_m, speed, _ = STOPS.state(float(time_s))
            if abs(side.value({EGO: (s_m, speed)})) <= tight_of(side, speed):
                assert np.min(np.abs(moments - time_s)) <= TIGHT_TIME_S + 1e-9


def test_standing_within_tolerance_lasts_as_long_as_it_stands() -> None:
    moments = _moments_at(at(64.8), STOPS, 17.0)
    assert sum(9.0 <= moment <= 12.0 for moment in moments) >= 29


def test_never_there_gives_none() -> None:
    assert _moments_at(at(500.0), STOPS, 17.0) == []


def test_knots_before_the_trigger_are_sought_before_it() -> None:
    conditions = [replace(at(m), moments=frozenset({(EGO, name)})) for name, m in (("t1", 20.0), ("t3", 50.0))]
    knots = _ego_knots(conditions, STOPS, {"t0": 0.0, "t2": 4.0}, ["t0", "t1", "t2", "t3"], 17.0)
    assert knots["t1"] == pytest.approx(2.0)
    assert 4.0 < knots["t3"] < 9.0


def rushing(at_s: float) -> Scripted:
    return Scripted(lambda time_s, speed_mps: 7.0 if time_s > at_s and speed_mps < 20.0 else 0.0)


@cache
def proofs_of(text: str) -> tuple[Feasibility | None, Feasibility | None]:
    """Return what is proven of an ego that goes on at 3 m/s, and of one that rushes off as it comes to its trigger."""
    trigger_s, proofs = np.inf, list[Feasibility | None]()
    for _ in range(2):
        stage = Stage(text, rushing(trigger_s + 0.1))
        assert stage.begin(stage.scene.landmarks_m[0]["stop_line"] - 50.0, 3.0).is_good
        run = stage.run(tick_s=0.5)
        trigger_s = run.last_plan.profiles[HERO].knot_times_s["t1"]
        proofs.append(ego_left_no_room(stage.scene, stage.structure, stage.limits, run.trace))
    return proofs[0], proofs[1]


def test_ego_that_rushes_off_left_no_room() -> None:
    calm, rushed = proofs_of(STORIES["stops and goes"])
    assert calm is None, "the ego that goes on at 3 m/s leaves plenty"
    assert rushed is not None
    named = [str(clash) for clash in rushed.clashes]
    assert any("before the ego" in clash for clash in named)


def test_ego_that_never_comes_to_its_place_is_the_judges_finding() -> None:
    stage = Stage(STORIES["stops and goes"], Scripted(lambda time_s, speed_mps: -2.0 if time_s > 3.0 else 0.0))
    assert stage.begin(stage.scene.landmarks_m[0]["stop_line"] - 50.0, 6.0).is_good
    run = stage.run(tick_s=0.5)
    assert run.trace.actors["ego"].s_m[-1] < stage.scene.landmarks_m[0]["stop_line"] - 14.0
    assert ego_left_no_room(stage.scene, stage.structure, stage.limits, run.trace) is None


def test_hindsight_reaches_the_result_of_a_whole_run() -> None:
    result = driven("stops and goes", "speeder", takes=1, replan_hz=2.0)
    assert result.status == "failure"
    assert result.hindsight is not None
    assert result.hindsight.answer == "infeasible"
    assert result.verdict is not None
    assert result.verdict.cause is not None
    assert result.verdict.cause.kind == "ego"


def test_drive_is_read_back_from_its_trace() -> None:
    stage = Stage(STORIES["yields, distance"], Scripted(lambda time_s, speed_mps: np.sin(time_s)))
    assert stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 9.0).is_good
    ego = stage.run(tick_s=0.5).trace.actors["ego"]
    profile = drive_profile(ego)
    for index in range(0, len(ego.time_s) - 10, 7):
        s_m, speed_mps, _ = profile.state(float(ego.time_s[index]))
        assert s_m == pytest.approx(ego.s_m[index], abs=0.005)
        assert speed_mps == pytest.approx(ego.speed_mps[index], abs=0.02)


def test_nothing_is_claimed_where_a_later_moment_of_the_ego_hangs_on_the_hero() -> None:
    text = STORIES["stops and goes"]
    assert "A0x(t2) ==" in text
    hangs = "\n".join("A0(t2) == A1(t4)" if line.startswith("A0x(t2) ==") else line for line in text.splitlines())
    assert proofs_of(text)[1] is not None
    assert proofs_of(hangs)[1] is None
