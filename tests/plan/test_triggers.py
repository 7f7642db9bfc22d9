"""When a trigger may come: an ego that stands where it should be is there, and one in no haste is not waited for."""

from __future__ import annotations

import pytest
from scenewright.solve.situation import HeroState

from scenewright.motion.profile import Profile, chain
from scenewright.plan.prediction import ConstantAcceleration
from scenewright.plan.triggers import PlannedTrigger, TriggerTimes
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.solve.arrival import TIGHT_LENGTH_M, linear_conditions
from stories import BRAKES_GAP, HERO, YIELDS_DISTANCE, YIELDS_TIME

NOW_S = 5.0
HERO_MOTION = Profile(chain(0.0, 0.0, 8.0, [(60.0, 0.0, 0)]))


def times_of(text: str) -> TriggerTimes:
    scene = ground(parse_program(text), load_map("t_intersection"), {})
    structure = read_structure(scene.program)
    conditions = linear_conditions(scene, structure)
    return TriggerTimes(scene, structure, conditions, ConstantAcceleration(cruise_mps=13.9))


def times(text: str = YIELDS_DISTANCE) -> tuple[TriggerTimes, float]:
    """Return when the trigger of a hero that is to yield comes, and the ego's place (m) at it, at no speed."""
    found = times_of(text)
    side = found.ego_side(found.scene.program.heroes[0])
    assert side is not None
    return found, -side.constant / side.weights[EGO][0]


@pytest.mark.parametrize(("planned_s", "expected_s"), [(3.0, 6.0), (6.4, 6.4), (9.0, 7.0)])
@pytest.mark.parametrize("short", [0.0, 0.5, 0.8])
def test_the_trigger_may_come_while_the_ego_stands_there(planned_s: float, expected_s: float, short: float) -> None:
    found, place_m = times()
    stand_m = place_m - short * TIGHT_LENGTH_M
    ego = Profile(chain(NOW_S, stand_m - 1.0, 2.0, [(1.0, -2.0, 0), (1.0, 0.0, 0), (3.0, 1.0, 0)]))
    planned = PlannedTrigger(planned_s, HERO_MOTION)
    hero = found.scene.program.heroes[0]
    assert found.instants_s(hero, NOW_S, ego, {}, planned) == pytest.approx([expected_s])


def test_an_ego_that_passes_its_place_before_it_stands_is_there_when_it_passes() -> None:
    found, place_m = times()
    ego = Profile(chain(NOW_S, place_m - 0.8, 2.0, [(1.0, -2.0, 0), (1.0, 0.0, 0), (9.0, 1.0, 0)]))
    (instant_s,) = found.instants_s(found.scene.program.heroes[0], NOW_S, ego, {}, PlannedTrigger(6.4, HERO_MOTION))
    assert instant_s < 6.0
    assert ego.state(instant_s)[0] == pytest.approx(place_m)


@pytest.mark.parametrize("short_m", [0.6, 3.0])
def test_an_ego_that_stands_too_far_off_is_waited_for(short_m: float) -> None:
    found, place_m = times()
    ego = Profile(chain(NOW_S, place_m - short_m - 1.0, 2.0, [(1.0, -2.0, 0), (1.0, 0.0, 0), (9.0, 1.0, 0)]))
    (instant_s,) = found.instants_s(found.scene.program.heroes[0], NOW_S, ego, {}, PlannedTrigger(6.4, HERO_MOTION))
    assert ego.state(instant_s)[0] == pytest.approx(place_m)


@pytest.mark.parametrize(("speed_mps", "hasty"), [(1.0, True), (13.0, False)])
def test_only_one_that_is_slow_may_come_notably_sooner(speed_mps: float, hasty: bool) -> None:
    found, place_m = times()
    ego = Profile(chain(NOW_S, place_m - 4.0 * speed_mps, speed_mps, [(20.0, 0.0, 0)]))
    earliest = found.earliest_s(found.scene.program.heroes[0], NOW_S, ego, NOW_S + 4.0)
    assert bool(earliest) is hasty
    assert all(NOW_S <= begin_s <= arrival_s <= NOW_S + 4.0 for begin_s, arrival_s in earliest)


@pytest.mark.parametrize(("late_m", "due"), [(0.02, True), (0.05, True), (0.6, False)])
def test_a_time_that_was_met_between_two_ticks_is_not_waited_for_again(late_m: float, due: bool) -> None:
    """An ego that slows down later is as near in time once more, when it stops; the trigger was to come now."""
    found, place_m = times(YIELDS_TIME)
    hero = found.scene.program.heroes[0]
    side = found.ego_side(hero)
    assert side is not None
    lead_s = side.weights[EGO][1] / side.weights[EGO][0]
    began_m, way = place_m - lead_s * 4.0 + late_m, [(1.5, 0.0, 0), (4.0 / 1.5, -1.5, 0), (20.0, 0.0, 0)]
    ego = Profile(chain(NOW_S, began_m, 4.0, way))
    (instant_s,) = found.instants_s(hero, NOW_S, ego, {}, PlannedTrigger(NOW_S + 0.01, HERO_MOTION))
    assert (instant_s < NOW_S + 0.1) is due
    (later_s,) = found.instants_s(hero, NOW_S, ego, {}, PlannedTrigger(NOW_S + 3.0, HERO_MOTION))
    assert later_s > NOW_S + 1.5


@pytest.mark.parametrize(
    ("accel_mpss", "until_s", "waits_s"),
    [
        (-1.0, NOW_S, 0.5),  # it is to brake at its trigger, and has just done so
        (-1.0, NOW_S - 0.4, 0.2),
        (-1.0, NOW_S - 2.0, 0.2),
        (-0.3, NOW_S, 0.2),  # not to be seen
        (1.0, NOW_S, 0.2),  # nothing of what is to begin
    ],
)
def test_a_trigger_that_both_decide_waits_until_the_hero_is_settled(
    accel_mpss: float, until_s: float, waits_s: float
) -> None:
    found = times_of(BRAKES_GAP)
    hero = found.scene.program.heroes[0]
    condition = found.joint_condition(hero)
    assert condition is not None
    held_s, changes_s = until_s - 1.0, 1.0
    way = [(held_s, 0.0, 0), (changes_s, accel_mpss, 0), (NOW_S - until_s + 60.0, 0.0, 0)]
    history = Profile(chain(0.0, 100.0, 10.0, [move for move in way if move[0] > 0.0]))
    s_m, speed_mps, _ = history.state(NOW_S)
    state = HeroState(NOW_S, s_m, speed_mps, 0, {}, history)
    per_metre = condition.weights[EGO][0]
    due_m = -(condition.constant + condition.weights[HERO][0] * s_m) / per_metre  # where the ego would be due now
    ego = Profile(chain(NOW_S, due_m - 0.2, speed_mps + 1.0, [(60.0, 0.0, 0)]))  # 0.2 s before that
    coasting_s = found.coasting_s(hero, ego, state, PlannedTrigger(NOW_S + 1.0, history), NOW_S + 1.0)
    assert coasting_s == pytest.approx(NOW_S + waits_s, abs=0.02)
