"""A plan as data, and what the program's terms are on it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from scenarios import YIELDS
from scenewright.motion.profile import Profile, Segment, chain
from scenewright.solve.plan import Plan, PlanWorld

# The hero drives, brakes ever harder and stands.
BRAKES = (Segment(0.0, 2.0, 250.0, 9.0, 0.0), Segment(2.0, 3.0, 268.0, 9.0, -1.0, 1, -4.0 / 3.0))
KNOTS = {"t0": 0.0, "t1": 2.0, "t2": 5.0}
PLAN = Plan(
    {0: Profile(chain(0.0, 200.0, 8.0, [(9.0, 0.0, 0)]), {"t0": 0.0, "t1": 2.0}), 1: Profile(BRAKES, KNOTS)},
    0.1,
    "",
    {"ego_distance_m": 25.0},
)


def read_back(actor: dict[str, Any]) -> Profile:
    """Return the motion that data tell of: each segment by itself."""
    keys = ("start_s", "duration_s", "s_m", "speed_mps", "accel_mpss")
    return Profile(
        tuple(Segment(*(each[key] for key in keys), jerk_mpsss=each["jerk_mpsss"]) for each in actor["segments"])
    )


def test_as_data_it_is_the_motion_that_was_planned() -> None:
    data: dict[str, Any] = PLAN.as_dict(YIELDS.scene())
    assert (data["schema_version"], data["tolerance"]) == (1, 0.1)
    hero = data["actors"]["hero"]
    assert [knot["name"] for knot in hero["knots"]] == ["t0", "t1", "t2"]
    assert [segment["piece"] for segment in hero["segments"]] == ["go", "dec"]
    for name, actor in (("ego", 0), ("hero", 1)):
        motion = read_back(data["actors"][name])
        for time_s in np.linspace(0.0, 4.9, 30):
            assert motion.state(float(time_s)) == pytest.approx(PLAN.profiles[actor].state(float(time_s)))


def test_terms_are_what_the_motions_say() -> None:
    world = PlanWorld(YIELDS.scene(), PLAN.profiles, PLAN.parameters)
    assert world.knot_time_s(1, "t1") == 2.0
    assert world.knot_time_s(0, "t2") == math.inf, "nobody knows yet"
    assert world.piece_span_s(1, "dec") == (2.0, 5.0)
    assert world.state(1, 1, 1.0) == 9.0
    assert world.state(1, 2, 2.0) == pytest.approx(-1.0), "what begins at a knot"
    assert world.state(1, 2, 5.0) == pytest.approx(-5.0, abs=1e-4), "at the last knot what ends there"
    assert world.parameter("ego_distance_m") == 25.0
    assert set(world.changes_s()) == {0.0, 2.0}
    assert BRAKES[1].end_speed_mps == pytest.approx(0.0)
