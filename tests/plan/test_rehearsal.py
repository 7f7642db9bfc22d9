"""Takes: a later one foresees the ego from how it drove, and no take is judged otherwise than the first."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.judge.tolerance import TIGHT
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import orchestrate
from scenewright.plan.prediction import ConstantSpeed, Rehearsed
from scenewright.request import Request
from stories import STORIES

DRIVE = Profile(chain(0.0, 0.0, 10.0, [(4.0, 0.0, 0), (5.0, -2.0, 0), (3.0, 0.0, 0), (4.0, 1.5, 0)]))


@pytest.mark.parametrize("now_s", [0.0, 1.3, 4.0, 6.5, 8.2])
def test_goes_on_as_it_did_whenever_it_comes_by(now_s: float) -> None:
    s_m, speed, accel = DRIVE.state(now_s)
    late_s = 20.0
    foreseen = Rehearsed(DRIVE, ConstantSpeed()).predict([(now_s + late_s, s_m, speed, accel)])
    for ahead_s in (0.0, 0.5, 2.0, 5.0):
        then, was = foreseen.state(now_s + late_s + ahead_s), DRIVE.state(now_s + ahead_s)
        assert then[0] == pytest.approx(was[0], abs=1e-6 if ahead_s < 4.0 else 0.05)
        assert then[1] == pytest.approx(was[1], abs=1e-6 if ahead_s < 4.0 else 0.3)


def test_standing_ego_is_as_long_at_its_place_as_it_has_been() -> None:
    came_s = 30.0
    stood = [(came_s - 0.1, 64.9, 0.5, -2.0), *((came_s + 0.1 * k, 65.0, 0.0, 0.0) for k in range(16))]
    foreseen = Rehearsed(DRIVE, ConstantSpeed()).predict(stood)
    sets_off_s = foreseen.time_at(65.2)
    assert sets_off_s is not None
    assert DRIVE.state(9.0)[1] == pytest.approx(0.0, abs=1e-9)
    # It stood for 3 s in the drive, and has stood for 1.5 s now.
    assert sets_off_s == pytest.approx(came_s + 3.0 + (2 * 0.2 / 1.5) ** 0.5, abs=0.4)


@pytest.mark.parametrize(("s_m", "speed"), [(20.0, 13.0), (500.0, 10.0)])
def test_another_speed_or_place_is_left_to_the_base(s_m: float, speed: float) -> None:
    history = [(3.0, s_m, speed, 0.0)]
    foreseen = Rehearsed(DRIVE, ConstantSpeed()).predict(history)
    assert foreseen.state(8.0) == ConstantSpeed().predict(history).state(8.0)


class Rushes:
    """An ego that holds its speed, but where it is not alone not for one second before the trigger."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        return 4.0 if observation.others and 4.0 < observation.time_s < 5.0 else 0.0


def test_a_later_take_succeeds_where_the_first_missed_and_is_named(tmp_path: Path) -> None:
    again = orchestrate(Request(STORIES["goes first, distance"], ego=f"{__name__}:Rushes", out=tmp_path / "run"))
    assert again.status == "success"
    assert again.take in (2, 3)
    assert not again.takes[0].verdict.holds_at(TIGHT)
    assert again.verdict is not None
    assert again.verdict.holds_at(TIGHT)
    assert json.loads((tmp_path / "run" / "manifest.json").read_text(encoding="utf-8"))["take"] == again.take


def test_a_success_is_not_taken_again() -> None:
    result = orchestrate(Request(STORIES["stops and goes"], ego="constant", takes=3, replan_hz=2.0))
    assert result.status == "success"
    assert result.take == 1


@pytest.mark.parametrize(("off_mps", "alike"), [(0.0, True), (0.5, True), (1.5, False)])
def test_a_drive_that_repeats_is_as_fast_all_along(off_mps: float, alike: bool) -> None:
    again = Profile(chain(0.0, 0.0, 10.0, [(4.0, 0.0, 0), (1.0, off_mps, 0), (4.0, -2.0, 0), (1.0, -2.0 - off_mps, 0)]))
    drive = Profile(chain(0.0, 0.0, 10.0, [(4.0, 0.0, 0), (1.0, 0.0, 0), (4.0, -2.0, 0), (1.0, -2.0, 0)]))
    assert Rehearsed(drive, ConstantSpeed()).repeats(again) is alike
