"""A plan as data: what is written of it suffices to drive it."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from scenarios import YIELDS
from scenewright.motion.profile import Profile, Segment, chain
from scenewright.program.text import parse_program
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.plan import Plan


@pytest.fixture(scope="module")
def scene() -> Scene:
    program = parse_program(YIELDS.text)
    return ground(program, load_map(program.map_name))


def smooth(s_m: float, speed_mps: float) -> list[Segment]:
    """Brakes ever harder and then ever less, until it stands."""
    first = Segment(0.0, 2.0, s_m, speed_mps, 0.0, 0, -1.5)
    second = Segment(2.0, 2.0, first.end_s_m, first.end_speed_mps, -3.0, 1, 1.5)
    return [first, second, Segment(4.0, 3.0, second.end_s_m, second.end_speed_mps, 0.0, 2)]


def state_after(segment: dict[str, Any]) -> tuple[float, float, float]:
    """Return when, where and how fast a written segment ends."""
    lasts, v, a, j = (segment[key] for key in ("duration_s", "speed_mps", "accel_mpss", "jerk_mpsss"))
    return (
        segment["start_s"] + lasts,
        segment["s_m"] + v * lasts + a * lasts**2 / 2 + j * lasts**3 / 6,
        v + a * lasts + j * lasts**2 / 2,
    )


def test_each_written_segment_leads_to_the_next(scene: Scene) -> None:
    ego, hero = Profile(chain(0.0, 50.0, 10.0, [(6.0, 0.0, 0)])), Profile(tuple(smooth(40.0, 6.0)), {"t0": 0.0})
    actors: Any = Plan({0: ego, 1: hero}).as_dict(scene)["actors"]
    segments = actors[scene.program.actor(1).name]["segments"]
    assert [segment["jerk_mpsss"] for segment in segments] == [-1.5, 1.5, 0.0]
    for one, other in pairwise(segments):
        assert state_after(one) == pytest.approx((other["start_s"], other["s_m"], other["speed_mps"]))
