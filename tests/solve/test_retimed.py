"""A trigger is moved towards where it was planned, never to before it can come."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from scenewright.motion.profile import Profile, chain
from scenewright.solve.limits import COUNTER, Wait
from scenewright.solve.planner import retimed
from scenewright.solve.situation import Situation
from scenewright.solve.stretches import timed_approach

HERO = 1
EGO = Profile(chain(0.0, 0.0, 10.0, [(60.0, 0.0, 0)]))


def situation(planned_s: float) -> Situation:
    return Situation(5.0, EGO, {"t0": 0.0, "t1": 5.4}, {}, {HERO: 5.4}, {HERO: planned_s}, ego_slack_s=1.0)


def test_moves_towards_the_planned_instant() -> None:
    assert retimed(situation(5.3), Fraction(1)).trigger_s == {HERO: 5.3}
    moved = retimed(situation(5.3), Fraction(1, 20))
    assert abs(moved.trigger_s[HERO] - 5.35) < 1e-9
    assert moved.ego_knots_s["t1"] == moved.trigger_s[HERO]


def test_never_moves_it_into_the_past() -> None:
    for planned_s in (4.0, 5.0, 5.005):
        assert retimed(situation(planned_s), Fraction(1)).trigger_s[HERO] > 5.0


def test_a_wait_that_takes_all_the_time_leaves_a_way_to_the_trigger() -> None:
    wait = Wait(0.5, 0.0, 0.5, 40.0, 0.3, 1.0)
    for rest_s in (Fraction(3), Fraction(2001, 1000), Fraction(2), Fraction(3, 2)):
        way = timed_approach(replace(COUNTER, wait=wait), 0, rest_s, "t1")
        assert sum(stretch.duration_s or 0 for stretch in way) == rest_s
        assert way[-1].end_knot == "t1"
