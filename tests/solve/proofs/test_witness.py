"""What is called a witness is a motion: it is realised, and looked at by an evaluator that knows no formula of ours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from planted import plant

from scenewright.motion.profile import Profile, Segment
from scenewright.roads.bodies import CAR
from scenewright.roads.zones import overlap
from scenewright.solve.proofs.decide import Question, decide
from scenewright.solve.proofs.witness import Witness, broken


def witness_of(seed: int) -> tuple[Question, Witness]:
    asked = plant(seed).question()
    witness = decide(asked).witness
    assert witness is not None
    return asked, witness


@pytest.mark.parametrize("seed", range(1, 40, 4))
def test_motions_are_continuous_and_never_backwards(seed: int) -> None:
    _, witness = witness_of(seed)
    for profile in witness.profiles.values():
        for before, after in zip(profile.segments, profile.segments[1:], strict=False):
            assert after.start_s == pytest.approx(before.end_s, abs=1e-6)
            assert after.s_m == pytest.approx(before.end_s_m, abs=2e-3)
            assert after.speed_mps == pytest.approx(before.end_speed_mps, abs=2e-3)
        assert all(segment.speed_mps >= 0 and segment.end_speed_mps >= 0 for segment in profile.segments)


def shifted(profile: Profile, by_m: float) -> Profile:
    return Profile(tuple(replace(s, s_m=s.s_m + by_m) for s in profile.segments), profile.knot_times_s)


def test_a_motion_that_is_off_is_found_out() -> None:
    asked, witness = witness_of(1)
    off = replace(witness, profiles={**witness.profiles, 1: shifted(witness.profiles[1], 3.0)})
    assert broken(asked.scene, asked.structure, asked.limits, asked.ego, witness) == []
    assert broken(asked.scene, asked.structure, asked.limits, asked.ego, off)


def test_a_turn_that_is_taken_too_fast_is_found_out() -> None:
    asked, witness = witness_of(2)
    turning = 1
    assert asked.scene.routes[turning].turn != "straight"
    landmarks = asked.scene.routes[turning].landmarks
    fast = Profile(
        (Segment(0.0, 6.0, landmarks["turn_start"] - 20.0, 14.0, 0.0),), witness.profiles[turning].knot_times_s
    )
    found = broken(
        asked.scene,
        asked.structure,
        asked.limits,
        asked.ego,
        replace(witness, profiles={**witness.profiles, turning: fast}),
    )
    assert any(each.what == "turn" and each.actor == turning for each in found)


def test_a_motion_that_no_law_admits_is_found_out() -> None:
    asked, witness = witness_of(1)
    first, *rest = witness.profiles[1].segments
    for off in (replace(first, accel_mpss=5.0), replace(first, speed_mps=first.speed_mps + 1.0)):
        profile = Profile((off, *rest), witness.profiles[1].knot_times_s)
        changed = replace(witness, profiles={**witness.profiles, 1: profile})
        found = broken(asked.scene, asked.structure, asked.limits, asked.ego, changed)
        assert any(each.what == "law" and each.actor == 1 for each in found)


def test_boxes() -> None:
    first = np.array([[0.0, 0.0, 0.0]] * 4)
    second = np.array([[4.4, 0.0, 0.0], [4.6, 0.0, 0.0], [0.0, 1.8, 0.0], [3.3, 0.0, np.pi / 2]])
    assert overlap(first, second, CAR, CAR).tolist() == [True, False, True, False]
