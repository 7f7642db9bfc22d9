"""What came of made motions, worked out by hand: who hit whom, when and how fast, or how near it came to that."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plays import AHEAD, BRAKES, CROSSING, NOT_YIELDING, YIELDS, Motion, Play, text

from scenewright.judge.aftermath import Aftermath, Collision
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT

# The hero stands at 103 m from 9.5 s on; the ego's front comes to its tail when the ego is at 98.5 m.
HIT = BRAKES.with_ego(pieces=[])
CROSSES = Play(
    text=text("[t0, go, t1, go, t2]", "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 20"),
    ego=Motion(0.0, 10.0, []),
    hero=Motion(0.0, 12.0, []),
    trigger_s=5.0,
    hero_line=CROSSING,
    duration_s=16.0,
)


def came_of(play: Play) -> Aftermath:
    return judge(play.case()).aftermath


def hit_in(play: Play) -> Collision:
    collision = came_of(play).collision
    assert collision is not None
    return collision


def test_the_ego_hits_a_standing_hero_and_it_happened_as_described() -> None:
    verdict = judge(HIT.case())
    assert verdict.holds_at(TIGHT)
    came = verdict.aftermath
    assert came.collision is not None
    assert came.collision.time_s == pytest.approx(9.85, abs=0.005)
    assert came.collision.actors == ("ego", "hero")
    assert came.collision.speeds_mps == pytest.approx((10.0, 0.0), abs=1e-9)
    assert came.collision.relative_speed_mps == pytest.approx(10.0)
    assert (came.closest_m, came.min_ttc_s, came.post_encroachment_s) == (0.0, 0.0, None)
    hit = "the ego hit the hero at 9.9 s, 10.0 m/s against 0.0 m/s"
    on = "the run goes on as if they had not touched, for what was still to come"
    assert came.in_words() == f"{hit}; until then the ego did not brake; {on}"


def test_a_run_that_ends_with_the_collision_does_not_go_on() -> None:
    assert came_of(replace(HIT, duration_s=9.92)).in_words().endswith("until then the ego did not brake")


def test_braking_before_the_trigger_is_not_told_as_an_answer_to_it() -> None:
    # 2 s at 10 m/s, 8.5 m of braking, and 12 m at 7 m/s to the place of the trigger, which it comes to at 4.7 s.
    early = CROSSES.with_ego(s_m=-5.0, pieces=[(2.0, 0.0), (1.0, -3.0)])
    early = replace(early, text=early.text.replace("conflict_point - 20", "conflict_point - 34.5"))
    came = came_of(early)
    assert came.ego_hardest_braking_time_s == pytest.approx(2.0, abs=0.03)
    assert "the ego braked with 3.0 m/s^2 at most, 2.7 s before the trigger" in came.in_words()
    assert "before the trigger" not in came_of(BRAKES).in_words()
    several = replace(came, several_triggers=True)
    assert "2.7 s before the first trigger" in several.in_words()


def test_who_drives_into_whom_comes_first() -> None:
    # The ego stands on the conflict point from 12 s on; the hero's front is at its side, 3.2 m short of it, at 14 s.
    stands = CROSSES.with_ego(pieces=[(2.0, 0.0), (10.0, -1.0)]).with_hero(s_m=96.8 - 12.0 * 14.0)
    hit = hit_in(stands)
    assert hit.time_s == pytest.approx(14.0, abs=0.005)
    assert hit.actors == ("hero", "ego")
    assert hit.speeds_mps == pytest.approx((12.0, 0.0), abs=1e-9)
    assert hit.in_words().startswith("the hero hit the ego at 14.0 s, 12.0 m/s against 0.0 m/s")
    assert came_of(stands).ego_hardest_braking_mps2 == pytest.approx(1.0)


def test_relative_speed_of_ways_that_cross_is_that_of_one_seen_from_the_other() -> None:
    hit = hit_in(CROSSES.with_hero(s_m=100.0 - 7.0 * 12.0))
    assert sorted(hit.speeds_mps) == pytest.approx([10.0, 12.0])
    assert hit.relative_speed_mps == pytest.approx(np.hypot(10.0, 12.0))


@settings(max_examples=30)
@given(ego_mps=st.floats(6, 20), slower_mps=st.floats(1, 5), gap_m=st.floats(6, 30))
def test_catching_up_takes_the_room_over_the_difference_of_speeds(
    ego_mps: float, slower_mps: float, gap_m: float
) -> None:
    play = replace(CROSSES, ego=Motion(0.0, ego_mps, []), hero=Motion(gap_m, ego_mps - slower_mps, []))
    caught_s = (gap_m - 4.5) / slower_mps
    came = came_of(replace(play, hero_line=AHEAD, duration_s=12.0))
    if caught_s < 11.9:
        assert came.collision is not None
        assert came.collision.time_s == pytest.approx(caught_s, abs=0.01)
        assert came.collision.relative_speed_mps == pytest.approx(slower_mps)
    elif caught_s > 12.1:
        assert came.collision is None
        assert came.closest_m == pytest.approx(gap_m - 4.5 - 11.98 * slower_mps, abs=1e-6)


def test_near_misses_are_measured() -> None:
    came = came_of(BRAKES)
    assert came.collision is None
    # The ego stops 100 / 4.4 m after 75 m, the hero at 103 m; between the centres lie 4.5 m of cars.
    assert came.closest_m == pytest.approx(103.0 - 75.0 - 100 / 4.4 - 4.5, abs=1e-3)
    assert came.ego_hardest_braking_mps2 == pytest.approx(2.2)
    assert came.min_ttc_s is not None
    assert 0.5 < came.min_ttc_s < 3.0


def test_one_passes_after_the_other() -> None:
    came = came_of(NOT_YIELDING.with_ego(pieces=[]))
    # Zone half-length 3.2 m: the hero leaves it at 103.2 m, the ego enters it at 66.8 m.
    enters_s = (66.8 - NOT_YIELDING.ego.s_m) / 8.0
    leaves_s = NOT_YIELDING.trigger_s + (-12.0 + np.sqrt(144.0 + 4 * 43.2)) / 2.0
    assert came.post_encroachment_s == pytest.approx(enters_s - leaves_s, abs=0.05)
    assert f"passed {enters_s - leaves_s:.1f} s apart, the ego did not brake" in came.in_words()
    assert came.in_words().startswith("no collision; closest ")


def test_who_follows_in_one_lane_passes_nobody() -> None:
    near = replace(CROSSES, hero=Motion(8.0, 10.0, []), hero_line=AHEAD)
    one_lane = {"ego": {"conflict_point": 70.0}, "hero": {"conflict_point": 70.0}}
    came = judge(replace(near.case(), landmarks=one_lane)).aftermath
    assert came.post_encroachment_s is None
    assert "ways cross" not in came.in_words(), "0.35 s behind, both are where the junction begins"


def test_a_hair_s_breadth_does_not_read_as_a_touch() -> None:
    came = came_of(replace(CROSSES, hero=Motion(4.504, 10.0, []), hero_line=AHEAD))
    assert came.collision is None
    assert came.in_words().startswith("no collision; closest 0.004 m, ")
    assert json.dumps(came.ego_hardest_braking_mps2) == "0.0"


def test_nor_do_hundredths_of_a_second_read_as_one() -> None:
    came = replace(came_of(CROSSES), collision=None, closest_m=0.02, min_ttc_s=0.031, post_encroachment_s=0.018)
    assert came.in_words().startswith(
        "no collision; closest 0.02 m, time to collision at least 0.03 s, passed 0.02 s apart, "
    )


def test_braking_after_a_collision_does_not_count() -> None:
    """Bodies drive through each other there: what a policy does then answers nothing that can be."""
    late = BRAKES.with_ego(pieces=[(9.9, 0.0), (1.0, -6.0)])
    assert came_of(late).ego_hardest_braking_mps2 == 0.0
    assert came_of(BRAKES.with_ego(pieces=[(9.0, 0.0), (0.2, -6.0)])).ego_hardest_braking_mps2 == pytest.approx(6.0)


def test_no_number_where_there_is_nothing_to_measure() -> None:
    """Far apart and never at the conflict point, nobody is on a collision course."""
    far = YIELDS.with_ego(pieces=[(3.0, 0.0), (9.0, -2.0)])
    came = came_of(replace(far, hero_line=(70.0, 900.0, np.pi / 2)))
    assert (came.collision, came.min_ttc_s, came.post_encroachment_s) == (None, None, None)
    assert "time to collision" not in came.in_words()
    assert "apart" not in came.in_words()


def test_verdict_has_it_as_plain_data_beside_conditions_and_facts() -> None:
    data = json.loads(json.dumps(judge(HIT.case()).as_dict(), allow_nan=False))
    assert data["success"]["tight"] is True
    assert data["facts"]["pairs"]["ego, hero"]["collision_time_s"] == data["aftermath"]["collision"]["time_s"]
    assert set(data["aftermath"]) == {
        "collision", "closest_m", "min_ttc_s", "post_encroachment_s", "ego_hardest_braking_mps2",
        "ego_hardest_braking_time_s", "text",
    }  # fmt: skip
    assert set(data["aftermath"]["collision"]) == {"time_s", "actors", "speeds_mps", "relative_speed_mps"}
    assert data["aftermath"]["text"] == judge(HIT.case()).aftermath.in_words()
    assert judge(BRAKES.case()).as_dict()["aftermath"]["collision"] is None
