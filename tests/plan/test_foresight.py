"""How the ego is foreseen: alone, behind a hero, and what it makes of one that does otherwise."""

from __future__ import annotations

import pytest
from followers import SIGNS
from many_heroes import PROGRAMS
from situations import planner_of, scene_of

from scenewright.motion.profile import Profile, chain
from scenewright.plan.foresight import Foresight
from scenewright.plan.prediction import ConstantSpeed, Driver, Predictor
from scenewright.program.structure import read_structure
from scenewright.program.types import EGO
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.solve.arrival import linear_conditions
from stories import BRAKES_GAP, YIELDS_DISTANCE, program


def foresight(text: str, predictor: Predictor) -> Foresight:
    scene = scene_of(text)
    structure = read_structure(scene.program)
    found = Foresight(scene, structure, linear_conditions(scene, structure), predictor, predictor, SIGNS)
    found.samples.append((0.0, 150.0, 12.0, 0.0))
    return found


def leading(ahead_m: float, speed_mps: float) -> dict[int, Profile]:
    return {1: Profile(chain(0.0, 150.0 + ahead_m, speed_mps, [(8.0, 0.0, 0)]), {"t0": 0.0, "t1": 4.0})}


def test_an_ego_that_holds_its_speed_is_sure_and_follows_nobody() -> None:
    steady = foresight(BRAKES_GAP, ConstantSpeed())
    assert steady.is_sure
    assert steady.leaders(leading(12.0, 5.0)) == {}
    assert steady.foreseen(leading(12.0, 5.0)).state(3.0)[:2] == pytest.approx((186.0, 12.0))


def test_behind_a_slower_hero_the_ego_is_foreseen_to_slow_down_and_the_more_the_nearer_it_is() -> None:
    follower = foresight(BRAKES_GAP, Driver(SIGNS))
    assert list(follower.leaders(leading(15.0, 6.0))) == [1]
    near, far = (follower.foreseen(leading(ahead_m, 6.0)).state(3.0)[1] for ahead_m in (15.0, 60.0))
    assert near < far <= 12.5


def test_one_that_crosses_its_way_is_not_followed() -> None:
    assert foresight(YIELDS_DISTANCE, Driver(SIGNS)).leaders(leading(15.0, 6.0)) == {}


def test_one_that_merges_is_followed_from_where_it_is_on_the_lane() -> None:
    gap = "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 20\nA1x(t1) == turn_end + 20\nA1v(t2) == 3\n"
    ego = foresight(program("S, E", "t0, go, t1, dec, t2", gap, ego_route="E"), Driver(SIGNS))
    merges_m = ego.scene.landmarks_m[1]["turn_end"]
    for past_m, followed in ((-2.0, []), (2.0, [1])):
        motions = {1: Profile(chain(0.0, merges_m + past_m, 6.0, [(8.0, 0.0, 0)]), {"t0": 0.0, "t1": 4.0})}
        assert list(ego.leaders(motions)) == followed


@pytest.mark.parametrize(("told", "side"), [("", -1.0), ("A1x(t0) == 165\n", 1.0)])
def test_a_hero_of_which_it_is_told_where_it_begins_keeps_to_the_side_of_the_ego_on_which_that_is(
    told: str, side: float
) -> None:
    """Where it begins elsewhere it may begin so that it is on the right side where it acts."""
    ego = foresight(program("W", "t0, go, t1, dec, t2", f"{told}A0(t1) == A1(t1)\nA1v(t2) == 3\n"), ConstantSpeed())
    motions = leading(15.0, 6.0) | {EGO: ego.at_first()}  # passed by the ego after 2.5 s
    assert ego.take_sides(motions, {1: "t1"})
    assert ego.on_lane[1].side == side


@pytest.mark.parametrize("first", [True, False])
def test_how_a_hero_is_answered_is_what_is_foreseen_of_it_where_it_is_otherwise(first: bool) -> None:
    follower, motions = foresight(BRAKES_GAP, Driver(SIGNS)), leading(18.0, 10.0)
    prediction = follower.foreseen(motions)
    answer = follower.answers(motions, 0.0, prediction, first=first)[1]
    if first:
        moved = Profile(chain(0.0, 168.1, 10.0, [(8.0, 0.0, 0)]), motions[1].knot_times_s)
    else:
        moved = Profile(chain(0.0, 168.0, 10.0, [(8.0, 0.2 / 16.0, 0)]), motions[1].knot_times_s)
    then, before = follower.foreseen({1: moved}).state(4.0), prediction.state(4.0)
    assert answer.per_metre == pytest.approx((10.0 * (then[0] - before[0]), 10.0 * (then[1] - before[1])), abs=1e-6)
    assert answer.per_metre[0] > 0.0, "an ego whose leader is further on comes further"
    assert (answer.per_mps is None) is not first


@pytest.mark.parametrize("mps", [5.5, 6.3, 9.0])
def test_who_begins_to_brake_after_others_begins_ahead_of_the_ego_if_it_is_to_be_there(mps: float) -> None:
    """Nothing tells on which side of the ego the last of a chain begins: planned alone it drove through the ego."""
    scene = scene_of(PROGRAMS["chain"](8))
    planner = planner_of(scene)
    planner.begin((0.0, 100.0 - 8.0 * mps, mps, 0.0))
    motions = planner.plan.profiles
    for hero in scene.program.heroes:
        offset_m, until_s = scene.offset_m(EGO, hero.id), motions[hero.id].knot_times_s["t1"]
        for time_s in [0.1 * k for k in range(int(10.0 * until_s))]:
            apart_m = motions[hero.id].state(time_s)[0] + offset_m - motions[EGO].state(time_s)[0]
            assert apart_m > VEHICLE_LENGTH_M + 1.0, f"{hero.name} at {time_s:.1f} s"
