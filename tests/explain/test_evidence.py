"""What a missed run shows is measured, not guessed: against the trace itself, and against closed forms."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from scenewright.explain.evidence import (
    came_too_late,
    ego_never_there,
    flat_out_s,
    foreseen_otherwise,
    last_good,
    limit_reached,
    orders_with_ego,
)
from scenewright.judge.verdict import Verdict
from scenewright.motion.profile import Profile
from scenewright.orchestrate import orchestrate, set_up
from scenewright.plan.planner import GOOD
from scenewright.program.text import parse_program
from scenewright.request import Request, Stages
from scenewright.simulate.loop import Run
from scenewright.simulate.world import World
from stories import HERO, STORIES


@cache
def driven(story: str, ego: str, **settings: str) -> tuple[World, Run, Verdict]:
    """Return a run, made once for all tests that look at it: whoever changes it changes a copy."""
    request = Request(STORIES.get(story, story), ego=ego, takes=1, replan_hz=2.0, **settings)
    result = orchestrate(request)
    assert result.run is not None
    assert result.verdict is not None
    return set_up(request, Stages(None))[0], result.run, result.verdict


def test_misprediction_is_what_the_trace_shows() -> None:
    world, run, verdict = driven("yields, distance", "staller", mode="open")
    trigger_s = verdict.facts["trigger_time_s"]["hero"]
    good = last_good(run, trigger_s)
    assert good is not None
    assert good.tolerance <= GOOD
    assert good.foreseen is not None
    found = foreseen_otherwise(world, run, good, trigger_s, world.scene.program.actor(HERO), at_trigger=True)
    assert found is not None
    seen, ego = found.evidence, run.trace.actors["ego"]
    assert seen["off_m"] == pytest.approx(ego.position(seen["time_s"]) - good.foreseen.state(seen["time_s"])[0])
    assert seen["planned_s"] <= seen["since_s"] <= seen["time_s"]
    for time_s in np.arange(seen["planned_s"], seen["since_s"] - 0.05, 0.1).tolist():
        assert abs(ego.position(time_s) - good.foreseen.state(time_s)[0]) <= 0.5


def test_when_a_hero_acted_is_told_as_such() -> None:
    """It is not when its trigger came: that is for the judge to say."""
    world, run, verdict = driven("yields, distance", "staller", mode="open")
    good = last_good(run, verdict.facts["trigger_time_s"]["hero"])
    assert good is not None
    assert good.foreseen is not None
    hero, planned_s, end_s = world.scene.program.actor(HERO), good.foreseen.knot_times_s["t1"], run.trace.duration_s
    told = {}
    for until_s in (planned_s + 1.0, planned_s - 1.0, end_s):
        found = foreseen_otherwise(world, run, good, until_s, hero, at_trigger=True)
        told[until_s] = found.text if found is not None else ""
    assert ", and the hero acted 1.0 s later;" in told[planned_s + 1.0]
    assert ", and the hero acted 1.0 s sooner;" in told[planned_s - 1.0]
    assert f", and the hero had yet to act {end_s - planned_s:.1f} s later, when the run ended;" in told[end_s]
    late = replace(good, foreseen=Profile(good.foreseen.segments, {"t0": 0.0, "t1": end_s + 3.0}))
    found = foreseen_otherwise(world, run, late, end_s, hero, at_trigger=True)
    assert found is not None
    assert ", and the run ended 3.0 s before the hero was to act;" in found.text


def test_a_trigger_without_the_ego_is_not_held_against_when_it_comes_to_one(monkeypatch: pytest.MonkeyPatch) -> None:
    world, run, verdict = driven("yields, distance", "staller", mode="open")
    trigger_s = verdict.facts["trigger_time_s"]["hero"]
    good = last_good(run, trigger_s)
    assert good is not None
    alone = replace(world.structure, triggers={HERO: frozenset({(HERO, "t1")})})
    monkeypatch.setattr(world, "structure", alone)
    found = foreseen_otherwise(world, run, good, trigger_s + 1.0, world.scene.program.actor(HERO), at_trigger=True)
    assert found is not None
    assert (found.evidence["off_s"], found.evidence["time_s"]) == (0.0, trigger_s + 1.0)


def test_no_misprediction_of_an_ego_that_holds_its_speed() -> None:
    world, run, verdict = driven("yields, distance", "constant")
    trigger_s = verdict.facts["trigger_time_s"]["hero"]
    good = last_good(run, trigger_s)
    assert good is not None
    assert foreseen_otherwise(world, run, good, trigger_s, world.scene.program.actor(HERO), at_trigger=True) is None
    assert ego_never_there(world, verdict) is None
    assert limit_reached(world, run, world.scene.program.actor(HERO), 0.0, trigger_s) is None


def test_limit_is_one_that_the_hero_was_at() -> None:
    world, run, _ = deepcopy(driven("yields, distance", "constant"))
    hero, states = world.scene.program.actor(HERO), run.trace.actors["hero"]
    hardest = float(-states.accel_mps2.min())
    limits = world.limits[HERO]
    assert limit_reached(world, run, hero, 0.0, 60.0) is None or hardest >= 0.9 * float(limits.brake_max_mpss)
    states.accel_mps2[100:130] = -float(limits.brake_max_mpss)
    found = limit_reached(world, run, hero, 1.9, 2.7)
    assert found is not None
    assert (found.evidence["limit"], found.evidence["hero"]) == ("braking", "hero")
    assert found.evidence["for_s"] == pytest.approx(0.6)
    assert limit_reached(world, run, hero, 0.0, 1.0) is None, "not before"
    assert limit_reached(world, run, hero, 1.0, 3.0) is None, "it could have done more for most of the time"


def test_a_limit_at_which_a_hero_was_for_a_moment_of_another_piece_does_not_count() -> None:
    """For most of the one piece it was at none, and of the other hardly any lies between the two instants."""
    world, run, _ = deepcopy(driven("yields, distance", "constant"))
    hero, states, limits = world.scene.program.actor(HERO), run.trace.actors["hero"], world.limits[HERO]
    knots_s = run.last_plan.profiles[HERO].knot_times_s
    lasts_s = knots_s["t2"] - knots_s["t1"]
    states.accel_mps2[(states.time_s > knots_s["t1"]) & (states.time_s < knots_s["t1"] + 0.4 * lasts_s)] = -float(
        limits.brake_max_mpss
    )
    states.accel_mps2[states.time_s >= knots_s["t2"]] = float(limits.accel_max_mpss)
    assert limit_reached(world, run, hero, knots_s["t1"], knots_s["t2"] + 0.05) is None


def test_ego_that_is_never_at_all_of_its_side_at_once() -> None:
    text = STORIES["yields, distance"] + "A0v(t1) == 14\n"
    world, _, verdict = driven(text, "dawdler")
    found = ego_never_there(world, verdict)
    assert found is not None
    assert found.evidence["proof"]
    assert "never came to its side of the trigger" in found.text


def test_latest_safe_moment_is_before_it_was_too_late() -> None:
    world, run, verdict = driven("goes first, distance", "speeder")
    (constraint,) = [each for each in world.scene.program.constraints if orders_with_ego(each)]
    found = came_too_late(world, run, verdict, constraint)
    assert found is not None
    told = found.evidence
    assert told["late_s"] == pytest.approx(told["hero_s"] - told["ego_s"])
    assert told["late_s"] > 0.0
    assert told["latest_safe_s"] < told["ego_s"]


@pytest.mark.parametrize("operator", ["<", "<=", ">", ">="])
def test_order_names_who_is_to_be_first(operator: str) -> None:
    formula = f"A1(t2) {operator} A0(t2)" if "<" in operator else f"A0(t2) {operator} A1(t2)"
    constraint = parse_program(STORIES["yields, distance"] + f"order: {formula}\n").constraint("order")
    order = orders_with_ego(constraint)
    assert order is not None
    assert [each.actor for each in order] == [HERO, 0]


def test_flat_out_is_the_textbook_on_a_straight_road() -> None:
    world, _, _ = driven("brakes at a rate", "constant")
    route, limits = world.scene.routes[HERO], world.limits[HERO]
    accel, most = float(limits.accel_max_mpss), float(limits.speed_max_mps)
    metres = 20.0
    reached = (5.0**2 + 2.0 * accel * metres) ** 0.5
    assert reached < most
    assert flat_out_s(route, limits, 10.0, 5.0, 10.0 + metres) == pytest.approx((reached - 5.0) / accel, rel=0.01)
    assert flat_out_s(route, limits, 10.0, most, 50.0) == pytest.approx(40.0 / most, rel=0.01)
    assert flat_out_s(route, limits, 50.0, 5.0, 50.0) == 0.0
