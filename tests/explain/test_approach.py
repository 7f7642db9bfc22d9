"""How heroes drive up to their triggers, seen in drives of which the answer is plain."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from scenewright.explain.approach import Approach, approach_of
from scenewright.orchestrate import orchestrate
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.roads import load_map
from scenewright.roads.grounding import ground
from scenewright.trace.model import ActorTrace, Trace
from stories import STORIES

SCENE = ground(parse_program(STORIES["yields, distance"]), load_map("t_intersection"))
PROGRAM = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [{sketch}]

Constraints:
A0(t1) == A1(t3)
A0x(t1) == conflict_point - 30
A1v(t4) == 0
"""
STEP_S, TRIGGER_S, END_S = 0.02, 6.0, 9.0


def driven(*moves: tuple[float, float], speed_mps: float = 10.0) -> Trace:
    """Return a hero that does one acceleration (m/s^2) after another, each until a time (s); the ego stands."""
    times = np.arange(0.0, END_S + STEP_S / 2, STEP_S)
    ends, rates = zip(*moves, (math.inf, 0.0), strict=True)
    accels = np.array([rates[int(np.searchsorted(ends, time, side="right"))] for time in times])
    speeds = np.maximum(0.0, speed_mps + np.concatenate(([0.0], np.cumsum(accels[:-1]) * STEP_S)))
    places = 100.0 + np.concatenate(([0.0], np.cumsum((speeds[:-1] + speeds[1:]) / 2) * STEP_S))
    zeros = np.zeros_like(times)
    hero = ActorTrace(times, places, zeros, zeros, speeds, accels, places, zeros)
    ego = ActorTrace(times, zeros, zeros, zeros, zeros, zeros, zeros, zeros)
    return Trace({"ego": ego, "hero": hero})


def seen(trace: Trace, trigger_s: float | None = TRIGGER_S) -> Approach:
    facts: dict[str, Any] = {
        "trigger_time_s": {"hero": trigger_s},
        "knot_times_s": {"hero": {"t0": 0.0, "t1": trigger_s, "t2": 8.0}},
    }
    return approach_of(SCENE, trace, facts)


@pytest.mark.parametrize(
    ("moves", "reverses"),
    [
        (((3.0, 1.5), (5.0, -1.5)), True),
        (((3.0, 1.5), (4.4, 0.0), (5.5, -1.5)), True),
        (((2.0, 1.5), (4.0, 0.0), (5.5, -1.5)), False),
        (((3.0, 0.9), (5.0, -1.5)), False),
        (((6.5, 0.0), (7.0, 2.0), (8.0, -2.0)), False),
    ],
    ids=["at once", "within 1.4 s", "after 2 s", "hardly", "after the trigger"],
)
def test_reversals_are_harsh_both_ways_and_soon(moves: tuple[tuple[float, float], ...], reverses: bool) -> None:
    assert seen(driven(*moves)).reverses is reverses


@pytest.mark.parametrize(("stops_for_s", "stands"), [(0.8, True), (0.2, False)])
def test_standing_is_half_a_second(stops_for_s: float, stands: bool) -> None:
    moves = ((2.0, -5.0), (2.0 + stops_for_s, 0.0), (6.0, 2.0))
    assert seen(driven(*moves)).stands is stands


def test_whoever_is_told_to_stop_on_the_way_may_stand() -> None:
    sketch = "t0, dec, t1, stop, t2, go, t3, dec, t4"
    program = parse_program(PROGRAM.replace("{sketch}", sketch))
    facts = {
        "trigger_time_s": {"hero": TRIGGER_S},
        "knot_times_s": {"hero": {"t0": 0.0, "t1": 4.0, "t2": 4.8, "t3": TRIGGER_S, "t4": 8.0}},
    }
    stands = driven((2.0, 0.0), (4.0, -5.0), (4.8, 0.0), (6.0, 2.0))
    scene = ground(program, load_map("t_intersection"))
    assert not approach_of(scene, stands, facts).stands
    assert seen(stands).stands, "a program that says nothing of it"


@pytest.mark.parametrize(("line", "found"), [("A1v(t1) == 0", False), ("A1v(t1) == 2", True), ("A1v(t2) == 0", True)])
def test_who_is_to_be_at_a_standstill_may_stand(line: str, found: bool) -> None:
    text = PROGRAM.replace("{sketch}", "t0, go, t1, acc, t2").replace("A1(t3)", "A1(t1)").replace("A1v(t4) == 0", line)
    program = parse_program(text)
    facts = {"trigger_time_s": {"hero": TRIGGER_S}, "knot_times_s": {"hero": {"t0": 0.0, "t1": TRIGGER_S, "t2": 9.0}}}
    stands = driven((2.0, 0.0), (4.0, -5.0), (END_S, 0.0))
    assert approach_of(ground(program, load_map("t_intersection")), stands, facts).stands is found


def test_sizes_are_those_of_the_motion() -> None:
    ramp = tuple((round(0.1 * k, 1), -0.2 * k) for k in range(1, 11))  # 2 m/s^3
    approach = seen(driven(*ramp, (6.0, -2.0)))
    assert max(approach.accels_mpss) == pytest.approx(2.0, abs=0.01)
    assert np.percentile(approach.jerks_mpsss, 95) == pytest.approx(2.0, abs=0.2)


def test_pace_is_of_what_road_and_following_leave() -> None:
    free = seen(driven((6.5, 0.0), (END_S, 6.0), speed_mps=6.0))
    assert free.pace == pytest.approx(6.0 / 13.89, abs=0.01)
    # It holds its speed for the 12 m to its next knot; it could have come faster, and braked.
    even = seen(driven((END_S, 0.0), speed_mps=6.0))
    assert even.pace == pytest.approx(6.0 / (36 + 2 * 3.0 * 12.0) ** 0.5, abs=0.01)
    braking = seen(driven((TRIGGER_S, 0.0), (8.0, -3.0), speed_mps=6.0))
    assert braking.pace == pytest.approx(1.0, abs=0.02)


def test_nothing_is_told_of_a_hero_without_a_trigger() -> None:
    assert seen(driven((END_S, 0.0)), None) == Approach()


def test_what_people_would_not_do_is_told() -> None:
    assert seen(driven((END_S, 0.0))).unnatural == []
    (stood,) = seen(driven((2.0, -5.0), (4.0, 0.0), (END_S, 0.5))).unnatural
    assert stood.startswith("Before its trigger the hero stood")
    (reversed_,) = seen(driven((3.0, 1.5), (5.0, -1.5))).unnatural
    assert "harshly" in reversed_


def test_a_real_run_approaches_calmly() -> None:
    result = orchestrate(Request(STORIES["yields, distance"], ego="idm"))
    assert result.verdict is not None
    assert result.run is not None
    approach = approach_of(result.scene, result.run.trace, result.verdict.facts)
    assert not approach.stands
    assert approach.pace is not None
    assert len(approach.accels_mpss) > 10
    assert max(approach.accels_mpss) < 8.0
