"""Values for parameters that were left open."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from motions import tenths

from scenarios import YIELDS, example, feasibility, limits_of, read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import Parameter
from scenewright.roads import load_map
from scenewright.roads.grounding import ground
from scenewright.solve.feasibility import Question
from scenewright.solve.parameters import everyday, everyday_value, rounded, settle
from scenewright.units import pin

T = load_map("t_intersection")


@given(
    name=st.sampled_from(["gap_m", "initial_gap_m", "end_gap_m", "wait_s", "speed_mps", "rate_mpss", "speed_kmph"]),
    ends=st.none() | st.tuples(tenths(0, 50), tenths(0, 50)),
)
def test_everyday_values_lie_in_their_range(name: str, ends: tuple[Fraction, Fraction] | None) -> None:
    low, high = (None, None) if ends is None else (min(ends), max(ends))
    parameter = Parameter(name, None, low, high)
    least, most = parameter.bounds()
    assert least <= everyday_value(parameter) / parameter.unit.si_factor <= most


@given(found=st.floats(0.0, 60.0), digits=st.integers(0, 3))
def test_values_are_round_in_their_own_unit_and_stay_in_their_range(found: float, digits: int) -> None:
    program = parse_program("parameters:\n- slow_kmph in [20, 50.25]\n" + YIELDS.text + "A1v(t1) == slow_kmph\n")
    scene = ground(program, T, YIELDS.parameters)
    chosen = rounded(scene, {"slow_kmph": found}, digits)
    assert not chosen.open_parameters()
    kmph = chosen.parameters["slow_kmph"] * Fraction(18, 5)
    assert kmph in (20, Fraction("50.25")) or (kmph * 10**digits).denominator == 1
    assert abs(kmph - min(max(Fraction(found) * Fraction(18, 5), 20), Fraction("50.25"))) <= Fraction(1, 2 * 10**digits)
    given = {name: value for name, value in chosen.parameters.items() if name != "slow_kmph"}
    assert given == scene.parameters == {k: v for k, v in everyday(scene).parameters.items() if k in given}


@pytest.mark.parametrize("tight", [False, True])
def test_open_parameters_get_values_that_work(tight: bool) -> None:
    """Everyday ones where those will do; where they will not, such as a stop beyond its beginning, found ones."""
    text = example(
        "E, N",
        "t0, go, t1, dec, t2",
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - ego_m\nA1x(t1) == conflict_point - near_m\n"
        "A1x(t2) == conflict_point - end_m\nA1v(t2) == 0",
    )
    program = parse_program(("parameters:\n- end_m in [40, 60]\n" if tight else "") + text)
    scene = ground(program, T)
    chosen, answer = settle(Question(scene, read_structure(program), limits_of(scene)))
    assert answer.answer == "feasible"
    assert set(chosen.parameters) == {"ego_m", "near_m", "end_m"}
    assert not chosen.open_parameters()
    assert feasibility(chosen).answer == "feasible"
    if not tight:
        assert chosen.parameters == {p.name: everyday_value(p) for p in program.parameters}
    else:
        assert 40 <= chosen.parameters["end_m"] <= 60
        assert all((1000 * value).denominator == 1 for value in chosen.parameters.values()), "values to be read"


def test_what_no_value_makes_possible_is_proven_for_all() -> None:
    program = parse_program(YIELDS.text + "A1v(t1) == top_mps\ntop_mps >= 50\n")
    scene = ground(program, T)
    _, answer = settle(Question(scene, read_structure(program), limits_of(scene)), explain=False)
    assert (answer.answer, answer.clashes) == ("infeasible", ())


def test_a_value_at_the_edge_of_what_is_possible_is_possible() -> None:
    program = parse_program(YIELDS.text + "A1v(t1) == slow_mps\nslow_mps <= 5.5\n")
    scene = ground(program, T)
    chosen, answer = settle(Question(scene, read_structure(program), limits_of(scene)))
    assert answer.answer == feasibility(chosen).answer == "feasible"
    assert chosen.parameters["slow_mps"] <= Fraction("5.5")


def test_given_parameters_stay_as_they_are() -> None:
    scene = YIELDS.scene()
    assert settle(Question(scene, read_structure(scene.program), limits_of(scene)))[0] is scene
    assert pin(scene.parameters["end_distance_m"]) == Fraction(13, 2)
