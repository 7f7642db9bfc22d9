"""The shortest time of what comes after a trigger: no motion is faster, and the fastest motion is hardly slower."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenarios import NOT_YIELDING, YIELDS, YIELDS_THEN_GOES, Example, limits_of, read_structure
from scenewright.program.types import PieceKind
from scenewright.solve.arrival import linear_conditions
from scenewright.solve.haste import Errand
from scenewright.solve.limits import COUNTER_QUICK, FIRM_QUICK, WHOLE, Style

DEC, STOP, ACC, GO = PieceKind.DEC, PieceKind.STOP, PieceKind.ACC, PieceKind.GO
LIMITS = limits_of(YIELDS.scene())[1]
HERO = 1


def errand_of(case: Example) -> Errand | None:
    scene = case.scene()
    structure = read_structure(scene.program)
    return Errand.of(scene.program, structure, linear_conditions(scene, structure), scene.program.heroes[0])


def test_errands_are_read_off_programs() -> None:
    assert errand_of(YIELDS) is None  # nobody is to be first
    first = errand_of(NOT_YIELDING)
    assert first is not None
    assert first.pieces == ((ACC, pytest.approx(18.0)),)
    goes = errand_of(YIELDS_THEN_GOES)
    assert goes is not None
    assert [kind for kind, _ in goes.pieces] == [DEC, STOP, ACC]
    assert all(way is not None and way >= 0.0 for _, way in goes.pieces)


@given(
    brake_m=st.floats(1.0, 40.0),
    go_m=st.floats(1.0, 60.0),
    shares=st.tuples(*[st.floats(0.0, 1.0)] * 3),
    style=st.sampled_from([WHOLE, FIRM_QUICK, COUNTER_QUICK]),
)
def test_no_motion_is_faster(brake_m: float, go_m: float, shares: tuple[float, ...], style: Style) -> None:
    low, high = style.dec_mpss
    brake = low + shares[0] * (high - low)
    speed = math.sqrt(2.0 * brake * brake_m)
    if speed > style.top_speeds_mps(LIMITS)[0]:
        return
    accel = style.acc_mpss[0] + shares[1] * (style.acc_mpss[1] - style.acc_mpss[0])
    top = min(style.top_speeds_mps(LIMITS))
    stand_s = style.stop_s[0] + shares[2]
    go_s = math.sqrt(2.0 * go_m / accel)
    if accel * go_s > top:
        go_s = top / accel + (go_m - top * top / (2.0 * accel)) / top
    takes_s = 2.0 * brake_m / speed + stand_s + go_s
    errand = Errand(((DEC, brake_m), (STOP, 0.0), (ACC, go_m)), "t2")
    assert errand.least_s(style, LIMITS) <= takes_s + 1e-9


def test_the_fastest_motion_is_hardly_slower() -> None:
    errand = Errand(((DEC, 4.0), (STOP, 0.0), (ACC, 6.0)), "t2")
    # 8 m/s^2 from 8 m/s, half a second, 4 m/s^2 over 6 m.
    assert errand.least_s(WHOLE, LIMITS) == pytest.approx(1.0 + 0.5 + math.sqrt(3.0))
    assert Errand(((GO, 30.0), (ACC, None)), "t2").least_s(WHOLE, LIMITS) == pytest.approx(30.0 / LIMITS.speed_max_mps)
