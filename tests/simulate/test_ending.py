"""A run ends when nothing that the program asks for can still come, and no sooner."""

from __future__ import annotations

from pathlib import Path

import pytest
from many_heroes import PROGRAMS, drive

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.orchestrate import orchestrate
from scenewright.request import Request, Result
from stories import STEP_S, STORIES, Scripted, Stage, program


def ends(source: str, ego: str) -> Result:
    """Return a run that re-solves as often as its end needs it."""
    return orchestrate(Request(source, ego=ego, takes=1, replan_hz=2.0))


def test_a_run_goes_on_while_anybody_may_still_do_what_is_asked() -> None:
    """One that only drives is at the end of its route long before the other brakes."""
    leaves = "Actor 2 (leaves):\n- E\n- [t0, go, t1]\n\nConstraints:"
    driven = drive(
        PROGRAMS["crossing"](1).replace("Constraints:", leaves) + "A2x(t0) == route_end - 40\n", "idm", replan_s=0.5
    )
    ends_m = driven.scene.routes[2].landmarks["route_end"]
    traces = driven.run.trace.actors
    left_s = traces["leaves"].time_s[traces["leaves"].s_m > ends_m][0]
    assert driven.verdict.facts["trigger_time_s"]["car1"] > left_s
    assert driven.met == 2


def test_an_ego_that_stands_for_good_is_not_waited_for() -> None:
    stage = Stage(STORIES["yields, distance"], Scripted(lambda time_s, speed_mps: -2.0))
    stage.begin(stage.scene.landmarks_m[0]["intersection"] - 90.0, 8.0)
    ego = stage.run(tick_s=0.5).trace.actors["ego"]
    assert ego.time_s[-1] - ego.time_s[ego.speed_mps > 0.1][-1] == pytest.approx(20.0, abs=2 * STEP_S)


def test_a_run_goes_on_until_what_is_told_by_the_clock(tmp_path: Path) -> None:
    """The hero stands long before, and so nothing else keeps the run going."""
    hero = "A1x(t1) == conflict_point - 25\nA1x(t2) == conflict_point - 5\nA1v(t2) == 0\nlate: A1v(25) == 0\n"
    trigger = "A0x(t0) == conflict_point - 120\nA0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\n"
    path = tmp_path / "late.scene"
    path.write_text(program("E, N", "t0, go, t1, dec, t2", trigger + hero))
    result = ends(str(path), "constant")
    assert result.run is not None
    assert result.run.trace.actors["hero"].time_s[-1] >= 25.0
    assert result.status == "success"


def test_a_run_goes_on_until_a_stretch_of_time_is_over_that_is_counted_from_a_moment() -> None:
    """The hero stands and the ego has passed long before: nothing else keeps the run going."""
    hero = "A1x(t1) == conflict_point - 25\nA1x(t2) == conflict_point - 5\nA1v(t2) == 0\n"
    trigger = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\nalways[A1(t2), A1(t2) + rests_s] (A1v <= 0.05)\n"
    text = program("E, N", "t0, go, t1, dec, t2, stop, t3", trigger + hero)
    result = orchestrate(Request(text, {"rests_s": 7}, ego="constant", takes=1, replan_hz=2.0))
    assert result.status == "success"
    assert result.run is not None
    trace = result.run.trace.actors["hero"]
    assert trace.time_s[trace.speed_mps <= 0.05][-1] - trace.time_s[trace.speed_mps > 0.05][-1] >= 6.9


@pytest.mark.parametrize("at_s", [40, 95])
def test_a_run_does_not_end_with_the_road_of_an_ego_that_nobody_waits_for(at_s: int) -> None:
    """What the clock tells comes as late as can be proven at all, wherever the ego is by then."""
    trigger = f"A1(t1) == {at_s} s\nA1x(t1) == stop_line - 15\nA1x(t2) == stop_line - 1\nA1v(t2) == 0\n"
    result = ends(program("S, W", "t0, go, t1, dec, t2", trigger), "constant")
    assert result.status == "success"
    assert result.run is not None
    ego = result.run.trace.actors["ego"]
    assert ego.s_m[ego.time_s < at_s][-1] > result.scene.landmarks_m[0]["route_end"]


def test_a_run_ends_no_sooner_than_a_hero_is_at_the_very_end_of_its_road() -> None:
    trigger = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 40\nA1x(t1) == conflict_point - 20\nA1x(t2) == route_end\n"
    result = ends(program("E, N", "t0, go, t1, acc, t2", trigger), "constant")
    assert result.status == "success"


def test_a_run_does_not_end_before_a_moving_ego_is_at_the_end_of_its_road() -> None:
    trigger = "A0(t1) == A1(t1)\nA0x(t1) == route_end\nA1x(t1) == conflict_point - 30\nA1v(t2) == 0\n"
    result = ends(program("E, N", "t0, go, t1, dec, t2", trigger), "idm")
    assert result.status == "success"


def test_a_run_goes_on_for_what_is_planned_though_the_ego_stands() -> None:
    """The hero stands for longer than an ego that stands is waited for, and drives on by itself."""
    hero = "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 30\nA1v(t2) == 0\nA1(t3) - A1(t2) == 25\nA1v(t4) == 8\n"
    result = ends(program("W", "t0, go, t1, dec, t2, stop, t3, acc, t4", hero), "idm")
    assert result.status == "success"
    assert result.run is not None
    ego = result.run.trace.actors["ego"]
    assert ego.speed_mps.min() < 0.1


@pytest.mark.parametrize(
    ("asked", "status"),
    [
        ("A0x(t2) == turn_end + 80\nA0v(t2) >= 5", "success"),
        ("A0x(t2) >= turn_end + 80\nA0v(t2) >= 5", "success"),
        ("A0x(t2) == turn_end + 80\nA0(t2) - A0(t1) <= 20", "success"),
        ("A0x(t2) == turn_end + 80\nalways[A0(t1), A0(t2)] (A0v >= 5)", "failure"),
        ("A0x(t2) == turn_end + 80\nnever[A0(t1), A0(t2)] (A0v <= 5)", "failure"),
    ],
)
def test_a_run_goes_on_until_the_ego_is_where_it_is_asked_to_be(asked: str, status: str) -> None:
    """The hero has done all long before; an ego that crawls at last is seen to."""
    trigger = "A0x(t0) == conflict_point - 120\nA0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\n"
    hero = f"A1x(t1) == conflict_point - 18\nA1x(t2) == conflict_point - 6\nA1v(t2) == 0\n{asked}\n"
    crawls = f"{__name__}:CrawlsAtLast" if status == "failure" else "constant"
    result = ends(program("E, N", "t0, go, t1, dec, t2", trigger + hero), crawls)
    assert result.status == status
    assert result.run is not None
    ego = result.run.trace.actors["ego"]
    assert ego.s_m[-1] >= result.scene.landmarks_m[0]["junction_end"] + 60.0
    if status == "failure":
        assert result.verdict is not None
        assert result.verdict.cause is not None
        assert result.verdict.cause.text.endswith(" m/s.")


class CrawlsAtLast:
    """An ego that holds its speed, and slows down to 4 m/s once it is well past the junction."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        return -3.0 if (observation.ego.s_m or 0.0) > 350.0 and observation.ego.speed_mps > 4.0 else 0.0


def test_a_run_does_not_end_a_hand_s_breadth_before_the_ego_is_at_its_place() -> None:
    """An ego that drives on is seen to be there; what is asked of it then was missed by centimetres."""
    text = "A0x(t0) == conflict_point - 90\nA0(t1) == A1(t1)\nA0x(t1) == conflict_point - 60\nA1v(t2) == 0\n"
    text += "A1x(t1) == conflict_point - 30\nA1x(t2) == conflict_point - 16\n"
    ego = ends(program("E, N", "t0, go, t1, dec, t2", text + "A0x(t2) == turn_end + 250\n"), "constant")
    assert ego.run is not None
    states, end_m = ego.run.trace.actors["ego"], ego.scene.landmarks_m[0]["turn_end"]
    at_m = float(states.s_m[states.s_m < end_m + 249.0][-1]) + 0.05 - end_m
    result = ends(
        program("E, N", "t0, go, t1, dec, t2", text + f"A0x(t2) == turn_end + {at_m:.4f}\nA0v(t2) >= 5\n"), "constant"
    )
    assert result.run is not None
    assert result.run.trace.actors["ego"].s_m[-1] >= end_m + at_m
    assert result.status == "success"


def test_a_run_does_not_wait_for_a_moment_of_both_once_the_hero_has_acted() -> None:
    """The ego comes to the headway within the tolerance, and never quite: such runs went on to the end of the road."""
    asked = "gap(A0, A1, A1(t0)) == 23\nA1v(t0) == 10\nA0(t1) == A1(t1)\nheadway(A0, A1, t1) == 1.5\nA1v(t2) == 3\n"
    result = ends(program("W", "t0, go, t1, dec, t2", asked), "idm")
    assert result.run is not None
    assert result.status == "success"
    assert result.run.trace.duration_s < result.run.last_plan.profiles[1].knot_times_s["t2"] + 15.0


def test_a_run_waits_for_the_ego_where_a_later_moment_of_both_is_at_its_own_place() -> None:
    """The hero just drives on then, and nobody can see when; an ego that stops and goes is late."""
    asked = "A0(t1) == A1(t1)\nA0x(t1) == intersection - 91\ngap(A0, A1, t1) == 16\nA1v(t2) == 3\n"
    asked += "A0(t2) == A1(t3)\nA0x(t2) == intersection + 72\nA0v(t2) >= 2\n"
    result = ends(program("W", "t0, go, t1, dec, t2, go, t3", asked), "stop-and-go")
    assert result.run is not None
    at_m = result.scene.landmarks_m[0]["intersection"] + 72.0
    assert result.run.trace.actors["ego"].s_m[-1] >= at_m - 0.1
