"""A hero that is followed leads the ego to its trigger: it speeds up to get nearer in time, and away in metres."""

from __future__ import annotations

import pytest
from followers import CRUISE_MPS, idm

from scenewright.motion.profile import Profile, chain
from scenewright.program.types import EGO
from scenewright.simulate.following import Leader
from scenewright.simulate.leading import Led, ways_to_lead
from scenewright.simulate.prediction import ConstantAcceleration, EgoSample
from scenewright.solve.arrival import LinearCondition
from scenewright.solve.situation import HeroState

HERO, HERO_MPS, NOW_S, TOP_MPS = 1, 7.0, 8.0, 15.0
CHANGES_MPS = (0.7, 1.5, 2.5, 4.0, 6.0, -0.7, -1.5, -2.5, -4.0)
MOTION = Profile(chain(0.0, 30.0, HERO_MPS, [(NOW_S, 0.0, 0), (60.0, 0.0, 0)]))


def gap_of(gap_m: float) -> LinearCondition:
    """The hero is so far ahead of the ego."""
    return LinearCondition("c1", frozenset(), -gap_m, {EGO: (-1.0, 0.0), HERO: (1.0, 0.0)})


def headway_of(headway_s: float) -> LinearCondition:
    """The ego is at its speed so long behind the hero."""
    return LinearCondition("c1", frozenset(), 0.0, {EGO: (-1.0, -headway_s), HERO: (1.0, 0.0)})


def followed() -> list[EgoSample]:
    """The past of an ego that has come to rest behind the hero, as far as people who keep 1.5 s do."""
    drive = idm(round(NOW_S / 0.02) + 1, Leader(MOTION, 0.0), 8.0, HERO_MPS, 1.5)
    return [sample for sample in drive if sample[0] >= NOW_S - 1.5]


def led(condition: LinearCondition, top_mps: float = TOP_MPS) -> list[Led]:
    past = followed()
    state = HeroState(NOW_S, MOTION.state(NOW_S)[0], HERO_MPS, 0, {}, MOTION)
    alone = ConstantAcceleration(cruise_mps=CRUISE_MPS).predict(past)
    return ways_to_lead(
        HERO, state, condition, alone, past, offset_m=0.0, top_mps=top_mps, cruise_mps=CRUISE_MPS, settled_s=0.5
    )  # fmt: skip


def gap_now_m() -> float:
    return MOTION.state(NOW_S)[0] - followed()[-1][1]


def changed(by_mps: float) -> Profile:
    """The hero's motion, its speed changed at 1.5 m/s^2 from now on."""
    begins_m = MOTION.state(NOW_S)[0]
    accel_mpss = 1.5 if by_mps > 0.0 else -1.5
    after = chain(NOW_S, begins_m, HERO_MPS, [(abs(by_mps) / 1.5, accel_mpss, 0), (20.0, 0.0, 0)])
    return Profile((*MOTION.segments[:1], *after))


@pytest.mark.parametrize(("more_m", "faster"), [(2.5, True), (-2.5, False)])
def test_a_longer_gap_is_had_by_speeding_up(more_m: float, faster: bool) -> None:
    """Whoever goes on as it is would be left behind all the same; a follower keeps its distance in time."""
    way = led(gap_of(gap_now_m() + more_m))[0]
    place_m, speed_mps, _ = way.ego.state(way.instant_s)
    hero_m = place_m + gap_now_m() + more_m
    assert (hero_m - MOTION.state(way.instant_s)[0] > 0.0) is faster
    assert (speed_mps > followed()[-1][2]) is faster


@pytest.mark.parametrize(
    "condition", [headway_of(gap_now_m() / HERO_MPS + 0.2), gap_of(gap_now_m() + 2.5), gap_of(gap_now_m() - 2.0)]
)
def test_a_follower_that_knows_nothing_of_it_does_what_was_promised(condition: LinearCondition) -> None:
    ways = led(condition)
    assert ways
    assert [way.instant_s for way in ways] == sorted(way.instant_s for way in ways)
    drives = [(motion, idm(1100, Leader(motion, 0.0), 8.0, HERO_MPS, 1.5)) for motion in map(changed, CHANGES_MPS)]
    for way in ways:
        index = round(way.instant_s / 0.02)
        states = [{EGO: drive[index][1:3], HERO: motion.state(way.instant_s)[:2]} for motion, drive in drives]
        assert min(abs(condition.value(both)) for both in states) < 0.5, way.instant_s


def test_no_hero_is_to_be_faster_than_it_may_or_stand() -> None:
    assert not led(gap_of(gap_now_m() + 2.5), top_mps=HERO_MPS)
    assert not led(gap_of(gap_now_m() + 60.0))
