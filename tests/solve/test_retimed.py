"""A trigger is moved towards where it was planned, never to before it can come."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from scenewright.motion.profile import Profile, chain
from scenewright.solve.limits import COUNTER, Wait
from scenewright.solve.planner import retimed
from scenewright.solve.situation import SHORTEST_LEAD_S, Situation
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


def test_moves_towards_when_the_hero_is_there_where_it_is_planned_for_now() -> None:
    """A plan that took a tolerance has the hero elsewhere at its trigger: both are to be a little off."""
    for planned_s, there_s, moved_s in ((5.4, 5.3, 5.3), (5.4, 5.6, 5.6), (5.35, 5.6, 5.35), (5.35, 5.2, 5.2)):
        here = replace(situation(planned_s), hero_there_s={HERO: there_s})
        assert abs(retimed(here, Fraction(1)).trigger_s[HERO] - moved_s) < 1e-9
        nearer = retimed(here, Fraction(1, 20)).trigger_s[HERO]
        assert abs(nearer - 5.4) <= 0.05 + 1e-9


def test_an_ego_past_its_side_is_not_waited_for() -> None:
    """Its trigger is due at once, at every tick anew: what is put off each time never comes."""
    due_s = situation(5.0).time_s + SHORTEST_LEAD_S
    here = replace(situation(due_s), trigger_s={HERO: due_s}, hero_there_s={HERO: 6.0})
    assert retimed(here, Fraction(1)).trigger_s[HERO] == due_s
