"""When motions meet a condition: the first instant, against a scan of every ten milliseconds."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st
from motions import Move, motion, tenths, wandering

import scenarios
from scenarios import BRAKES, NOT_YIELDING, ONE_SIDED, YIELDS, read_structure
from scenewright.motion.profile import Profile, chain
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.roads import load_map
from scenewright.roads.grounding import Scene, ground
from scenewright.solve.arrival import HORIZON_S, LinearCondition, knot_between_s, linear_conditions, of_ego
from stories import program

T = load_map("t_intersection")
HERE = frozenset({(0, "t1")})
_STEP_S = 0.01
weights = st.sampled_from([(1.0, 0.0), (1.0, 2.5), (1.0, -1.5), (0.0, 1.0), (-1.0, 0.5)])


def scanned(condition: LinearCondition, profiles: dict[int, Profile], after_s: float, until_s: float) -> float | None:
    """Return the first instant of a fine scan at which the condition's value has changed its sign or is nothing."""
    times = np.arange(after_s, until_s, _STEP_S)
    values = [condition.value({a: profiles[a].state(float(t))[:2] for a in condition.weights}) for t in times]
    if abs(values[0]) < 1e-9:
        return after_s
    changes = np.nonzero(np.diff(np.sign(values)) != 0)[0]
    return float(times[changes[0]]) if len(changes) else None


def profile_of(wander: tuple[Fraction, list[Move]]) -> Profile:
    return motion(*wander).profile({})


@settings(max_examples=60)
@given(
    wander=wandering(15, 3, 5),
    weight=weights,
    constant=tenths(-60, 20),
    after_s=st.sampled_from([0.0, 0.7, 2.0]),
)
def test_first_time_of_one_motion(
    wander: tuple[Fraction, list[Move]], weight: tuple[float, float], constant: Fraction, after_s: float
) -> None:
    condition = LinearCondition("c1", HERE, float(constant), {0: weight})
    check(condition, {0: profile_of(wander)}, after_s)


@example(
    first=(Fraction(0), [(Fraction(1, 2), Fraction(0))]),
    second=(Fraction(0), [(Fraction(1, 2), Fraction(3, 40)), (Fraction(9, 10), Fraction(0))]),
    weight=(0.0, 1.0),
    constant=Fraction(1, 10),
    after_s=0.0,
)
@settings(max_examples=60, phases=[Phase.explicit, Phase.generate])
@given(
    first=wandering(15, 3, 5),
    second=wandering(15, 3, 5),
    weight=weights,
    constant=tenths(-40, 40),
    after_s=st.sampled_from([0.0, 1.3]),
)
def test_first_time_of_two_motions(
    first: tuple[Fraction, list[Move]],
    second: tuple[Fraction, list[Move]],
    weight: tuple[float, float],
    constant: Fraction,
    after_s: float,
) -> None:
    condition = LinearCondition("c1", HERE, float(constant), {0: weight, 1: (-weight[0], 0.3)})
    check(condition, {0: profile_of(first), 1: profile_of(second)}, after_s)


def check(condition: LinearCondition, profiles: dict[int, Profile], after_s: float) -> None:
    found = condition.first_time(profiles, after_s)
    wanted = scanned(condition, profiles, after_s, after_s + 40.0)
    if found is not None:
        assert found >= after_s - 1e-9
        assert abs(condition.value({a: profiles[a].state(found)[:2] for a in condition.weights})) < 1e-5
    if wanted is not None:
        # It may touch zero between two instants of the scan and be earlier; it is never later.
        assert found is not None
        assert found <= wanted + _STEP_S + 1e-9


def test_nothing_is_met_after_the_horizon_or_before_the_time_asked_for() -> None:
    slow = Profile(chain(0.0, 0.0, 1.0, [(1.0, 0.0, 0)]))
    near = LinearCondition("c1", HERE, -10.0, {0: (1.0, 0.0)})
    assert near.first_time({0: slow}, 0.0) == pytest.approx(10.0)
    assert near.first_time({0: slow}, 10.5) is None
    far = LinearCondition("c1", HERE, -(HORIZON_S + 50.0), {0: (1.0, 0.0)})
    assert far.first_time({0: slow}, 0.0) is None


# -- which constraints are linear -----------------------------------------------------------------------------------
def scene_of(line: str, route: str = "W") -> Scene:
    return ground(
        parse_program(scenarios.example(route, "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\ntested: {line}")), T
    )


def conditions_of(line: str, route: str = "W") -> dict[str, LinearCondition]:
    scene = scene_of(line, route)
    return {c.constraint_id: c for c in linear_conditions(scene, read_structure(scene.program))}


@pytest.mark.parametrize(
    ("line", "constant", "weight"),
    [
        ("A0x(t1) == stop_line - 20", -280.0, {0: (1, 0)}),
        ("A0v(t1) == 8", -8.0, {0: (0, 1)}),
        ("tta(A0, stop_line, t1) == 3", 300.0, {0: (-1, -3)}),
        ("gap(A0, A1, t1) == 12", -12.0, {0: (-1, 0), 1: (1, 0)}),
        ("A1x(t1) - A0x(t1) == 12", -12.0, {0: (-1, 0), 1: (1, 0)}),
        ("headway(A0, A1, t1) == 2", -4.5, {0: (-1, -2), 1: (1, 0)}),
        ("2 * A0x(t1) + A1v(t1) == 12", -12.0, {0: (2, 0), 1: (0, 1)}),
    ],
)
def test_linear_constraints_and_their_weights(
    line: str, constant: float, weight: dict[int, tuple[float, float]]
) -> None:
    found = conditions_of(line)["tested"]
    assert set(found.weights) == set(weight)
    wanted = np.array([constant, *(each for actor in weight for each in weight[actor])])
    got = np.array([found.constant, *(each for actor in weight for each in found.weights[actor])])
    factor = got[np.argmax(np.abs(wanted))] / wanted[np.argmax(np.abs(wanted))]
    assert abs(factor) > 0.1
    assert got == pytest.approx(factor * wanted)


@pytest.mark.parametrize(
    "line",
    [
        "A0x(t1) <= stop_line",
        "A0v(t1) * A1v(t1) == 20",
        pytest.param(
            "tta(A0, stop_line, t1) == tta(A1, stop_line, t1)",
        ),
        "A1a(dec) == -3",
        "A1x(t2) - A1x(t1) == 30",
        "A0(t1) == 5",
        "A0x(t1) == stop_line - near_m",
        "A0v(t1) == 8 and A1v(t1) == 8",
    ],
)
def test_what_is_not_linear_at_one_moment_with_known_numbers_is_left_out(line: str) -> None:
    assert "tested" not in conditions_of(line)


def test_conditions_of_the_canonical_programs() -> None:
    wanted = {
        BRAKES.name: {"c1", "c3", "c5"},
        YIELDS.name: {"c1", "c3", "c4", "c5", "c6"},
        NOT_YIELDING.name: {"c2", "c3", "c4", "c5"},
        ONE_SIDED.name: {"c1", "c2", "c4"},
    }
    for case in (BRAKES, YIELDS, NOT_YIELDING, ONE_SIDED):
        scene = case.scene()
        found = linear_conditions(scene, read_structure(scene.program))
        assert {c.constraint_id for c in found} == wanted[case.name]


@pytest.mark.parametrize(
    ("line", "between_s"),
    [
        ("A1(t1) == 5", (5.0, 5.0)),
        ("A1(t1) <= 4", (0.0, 4.0)),
        ("A1(t2) == 9\nA1(t2) - A1(t1) >= 3", (0.0, 6.0)),
        ("A0v(t0) == 5", (0.0, 120.0)),
    ],
)
def test_when_the_ego_comes_to_its_knots(line: str, between_s: tuple[float, float]) -> None:
    told = program("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\ngap(A0, A1, t1) == 25\nA1v(t2) == 0\n{line}")
    low, high = knot_between_s(ground(parse_program(told), T), (EGO, "t1"))
    assert (low, high) == pytest.approx(between_s)


@pytest.mark.parametrize(
    ("lines", "places_m"),
    [
        ("gap(A0, A1, t1) == 25\nA1x(t1) == stop_line - 40", [235.0]),
        ("A1x(t1) == stop_line - 40\nA1x(t1) - A0x(t1) == 30", [230.0]),
        ("A1x(t2) == stop_line - 40\ngap(A0, A1, t1) == 25", []),
        ("A1x(t1) == stop_line - 40\nttc(A0, A1, t1) == 4", []),  # how fast the other is is not told
        ("A1x(t1) == stop_line - 40\nheadway(A0, A1, t1) == 2", [255.5 - 20.0]),
        ("A0x(A1(t1)) == stop_line - 50", [250.0]),
    ],
)
def test_where_the_other_is_placed_so_is_the_ego(lines: str, places_m: list[float]) -> None:
    scene = ground(parse_program(program("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{lines}")), T)
    structure = read_structure(scene.program)
    found = of_ego(linear_conditions(scene, structure), structure)
    assert [each.place_m(EGO, 10.0) for each in found] == pytest.approx(places_m)
