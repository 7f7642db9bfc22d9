"""One motion as a function of unknowns: its derivatives are those of its values, and it is one that can be driven."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from scenewright.motion.profile import Segment
from scenewright.plan.shooting import Leg, Quantity, Shot, Start, profile_of, shoot
from scenewright.program.types import PieceKind

GO, STOP = PieceKind.GO, PieceKind.STOP
STEP = 1e-6


@st.composite
def shots(draw: st.DrawFn, stands: bool = True) -> tuple[list[Leg], Start, np.ndarray]:
    """Legs one after another, whose times may be known or not, with values of all unknowns."""
    z: list[float] = []

    def unknown(value: float) -> int:
        z.append(value)
        return len(z) - 1

    free = draw(st.booleans())
    place, speed = draw(st.floats(0.0, 100.0)), draw(st.floats(0.0, 15.0))
    start = tuple(Quantity(0.0, unknown(each)) if free else Quantity(each) for each in (place, speed))
    time_s, first, legs = 0.0, Quantity(0.0), []
    for piece in range(draw(st.integers(1, 4))):
        time_s += draw(st.floats(0.3, 5.0))
        shift_s = draw(st.floats(-0.2, 0.2))
        last = Quantity(shift_s, unknown(time_s - shift_s)) if draw(st.booleans()) else Quantity(time_s)
        cells = draw(st.integers(1, 4))
        if stands and draw(st.integers(0, 4)) == 0:
            legs.append(Leg(piece, STOP, first, last, cells, ()))
        else:
            joined = [legs[-1].accels[-1]] if legs and legs[-1].accels and draw(st.booleans()) else []
            new = [unknown(draw(st.floats(-5.0, 4.0))) for _ in range(len(joined), cells + 1)]
            legs.append(Leg(piece, GO, first, last, cells, (*joined, *new)))
        first = last
    assume(z)
    return legs, start, np.array(z)


def slopes_of(value, z: np.ndarray) -> np.ndarray:  # type: ignore[no-untyped-def]
    """Return central differences of an array of values by all unknowns."""
    found = []
    for k in range(len(z)):
        around = [z.copy(), z.copy()]
        around[0][k] -= STEP
        around[1][k] += STEP
        found.append((np.asarray(value(around[1])) - np.asarray(value(around[0]))) / (2.0 * STEP))
    return np.array(found).T.reshape(-1, len(z))


@settings(max_examples=60)
@given(drawn=shots())
def test_derivatives_at_nodes_are_those_of_the_values(drawn: tuple[list[Leg], Start, np.ndarray]) -> None:
    legs, start, z = drawn
    shot = shoot(legs, start, z)
    for name in ("time", "s", "v"):
        wanted = slopes_of(lambda at, name=name: getattr(shoot(legs, start, at), name), z)
        assert getattr(shot, f"d_{name}") == pytest.approx(wanted, rel=1e-5, abs=1e-5)


@settings(max_examples=60)
@given(drawn=shots(), share=st.floats(0.02, 1.2))
def test_derivatives_at_any_instant_are_those_of_the_values(
    drawn: tuple[list[Leg], Start, np.ndarray], share: float
) -> None:
    legs, start, z = drawn
    shot = shoot(legs, start, z)
    at_s = share * float(shot.time[-1])
    if np.min(np.abs(shot.time - at_s)) < 1e-3:
        return  # right at a node an acceleration may jump
    last = legs[-1].last

    def states(at: np.ndarray) -> tuple[float, float]:
        return shoot(legs, start, at).at(at_s + last.value(at) - last.value(z), np.zeros(len(z)))[:2]

    d_time = np.zeros(len(z))
    if last.unknown is not None:
        d_time[last.unknown] = 1.0
    _, _, d_s, d_v = shot.at(at_s, d_time)
    assert np.array([d_s, d_v]) == pytest.approx(slopes_of(states, z), rel=1e-4, abs=1e-4)


@settings(max_examples=40)
@given(drawn=shots(), share=st.floats(0.0, 1.0))
def test_rates_have_the_derivatives_by_the_accelerations_that_they_lie_between(
    drawn: tuple[list[Leg], Start, np.ndarray], share: float
) -> None:
    legs, start, z = drawn
    shot = shoot(legs, start, z)
    at_s = share * float(shot.time[-1])
    rate, slope = shot.rate_at(at_s, before=False)
    accels = {unknown for leg in legs for unknown in leg.accels}
    for k in range(len(z)):
        other = z.copy()
        other[k] += 1.0
        if k in accels:
            assert shoot(legs, start, other).rate_at(at_s, before=False)[0] - rate == pytest.approx(slope[k], abs=1e-9)
        else:
            assert slope[k] == 0.0


def test_the_rate_at_a_knot_is_that_which_begins_there_or_that_before_it() -> None:
    legs = [Leg(0, GO, Quantity(0.0), Quantity(2.0), 1, (0, 1)), Leg(1, GO, Quantity(2.0), Quantity(4.0), 1, (2, 3))]
    shot = shoot(legs, (Quantity(0.0), Quantity(10.0)), np.array([0.0, 1.0, -3.0, -1.0]))
    assert shot.rate_at(2.0, before=False)[0] == pytest.approx(-3.0)
    assert shot.rate_at(2.0, before=True)[0] == pytest.approx(1.0)
    assert shot.rate_at(3.0, before=True)[0] == pytest.approx(-2.0)
    assert shot.rate_at(9.0, before=False)[0] == 0.0


def fine(shot: Shot, until_s: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    times = np.linspace(0.0, until_s, 1501)
    states = np.array([shot.at(float(t), np.zeros(len(shot.z)))[:2] for t in times])
    return times, states[:, 0], states[:, 1]


@settings(max_examples=10)
@given(drawn=shots(stands=False))
def test_place_is_the_integral_of_speed_and_speed_that_of_the_rate(
    drawn: tuple[list[Leg], Start, np.ndarray],
) -> None:
    legs, start, z = drawn
    shot = shoot(legs, start, z)
    times, places, speeds = fine(shot, float(shot.time[-1]) + 1.0)
    step_s = times[1] - times[0]
    travelled = np.concatenate([[0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1]) * step_s)])
    assert places - places[0] == pytest.approx(travelled, abs=6.0 * step_s)
    rates = np.array([shot.rate_at(float(t), before=False)[0] for t in 0.5 * (times[1:] + times[:-1])])
    gained = np.concatenate([[0.0], np.cumsum(rates * step_s)])
    assert speeds - speeds[0] == pytest.approx(gained, abs=12.0 * step_s)


@settings(max_examples=60)
@given(drawn=shots())
def test_a_profile_never_reverses_and_is_the_shot_where_that_does_not(
    drawn: tuple[list[Leg], Start, np.ndarray],
) -> None:
    legs, start, z = drawn
    shot = shoot(legs, start, z)
    profile = profile_of(shot, {"t0": 0.0}, ())
    for before, after in itertools.pairwise(profile.segments):
        assert after.start_s == pytest.approx(before.end_s, abs=1e-9)
        assert after.s_m == pytest.approx(before.end_s_m, abs=1e-9)
        assert after.speed_mps == pytest.approx(before.end_speed_mps, abs=0.05), (
            "no speed jumps, though one is to stand"
        )
    for segment in profile.segments:
        inside = [segment.after(share * segment.duration_s)[1] for share in np.linspace(0.0, 1.0, 9)]
        assert min(inside) >= -1e-6
    if any(not leg.accels for leg in legs):
        return
    times, places, speeds = fine(shot, float(shot.time[-1]))
    if speeds.min() < 1e-6:
        return
    for k in range(0, len(times) - 1, 60):
        assert profile.state(float(times[k]))[:2] == pytest.approx((places[k], speeds[k]), abs=1e-6)


def test_who_stands_does_so_exactly_and_what_was_driven_stays() -> None:
    past = [Segment(0.0, 1.0, 0.0, 2.0, 0.0)]
    legs = [
        Leg(0, PieceKind.DEC, Quantity(1.0), Quantity(2.0), 1, (0, 1)),
        Leg(1, STOP, Quantity(2.0), Quantity(3.0), 1, ()),
        Leg(2, PieceKind.ACC, Quantity(3.0), Quantity(5.0), 1, (2, 3)),
    ]
    profile = profile_of(
        shoot(legs, (Quantity(2.0), Quantity(2.0)), np.array([-2.0, -1.999, 1.0, 1.0])), {"t1": 1.0}, past
    )
    assert profile.segments[0] is past[0]
    assert [segment.piece for segment in profile.segments] == [0, 0, 1, 2]
    stand_m, stand_mps, _ = profile.state(2.5)
    assert stand_mps == 0.0
    assert profile.state(2.99)[0] == pytest.approx(stand_m)
    assert profile.state(5.0)[1] == pytest.approx(2.0)
    assert profile.knot_times_s == {"t1": 1.0}


def test_where_rounding_would_have_it_roll_back_it_stands_instead() -> None:
    legs = [Leg(0, GO, Quantity(0.0), Quantity(3.0), 1, (0, 1))]
    profile = profile_of(shoot(legs, (Quantity(0.0), Quantity(1.0)), np.array([-2.0, 1.0])), {}, ())
    assert len(profile.segments) == 2
    stops_s = profile.segments[1].start_s
    assert 0.5 < stops_s < 1.0
    assert profile.state(stops_s + 1e-6)[1] == pytest.approx(0.0, abs=1e-4)
    assert profile.state(2.9)[:2] == pytest.approx(profile.state(stops_s)[:2], abs=1e-4)
