"""One size of vehicles for everybody."""

from __future__ import annotations

import pytest

from scenewright.judge.case import Box
from scenewright.roads.bodies import CAR, VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, Body


def test_the_reach_of_a_body_is_to_its_corners() -> None:
    assert Body(8.0, 6.0).reach_m() == 5.0
    assert CAR.reach_m() == pytest.approx(((4.5 / 2) ** 2 + (1.9 / 2) ** 2) ** 0.5)


def test_the_judge_has_the_same_car_as_the_roads() -> None:
    assert Box() == CAR == Body(VEHICLE_LENGTH_M, VEHICLE_WIDTH_M)
