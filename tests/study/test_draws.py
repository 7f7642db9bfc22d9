"""Draws of parameters: repeatable by their seed, within ranges, and such that an ego starts before its trigger."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.program.types import Parameter
from scenewright.study.draws import draw_parameters

NAMES = [
    "ego_distance_behind_stop_line_m",
    "hero_distance_behind_conflict_point_m",
    "initial_ego_distance_behind_stop_line_m",
    "initial_hero_distance_behind_stop_line_m",
    "end_hero_distance_behind_conflict_point_m",
    "ego_tta_behind_stop_line_s",
    "initial_ego_tta_behind_intersection_s",
    "hero_tta_behind_stop_line_s",
    "target_speed_mps",
    "hero_deceleration_mpss",
]
seeds = st.tuples(st.integers(0, 10**6), st.integers(0, 100), st.integers(0, 100))


def drawn(names: list[str], seed: tuple[int, ...]) -> dict[str, float]:
    return draw_parameters([Parameter(name) for name in names], seed)


@given(seeds)
def test_same_seed_same_values(seed: tuple[int, ...]) -> None:
    values = drawn(NAMES, seed)
    assert values == drawn(NAMES, seed)
    assert list(values) == NAMES
    assert values != drawn(NAMES, (seed[0] + 1, *seed[1:]))


@given(seeds)
def test_everyday_values_are_everyday(seed: tuple[int, ...]) -> None:
    values = drawn(NAMES, seed)
    for name, (low, high) in {
        "ego_distance_behind_stop_line_m": (8, 30),
        "hero_distance_behind_conflict_point_m": (10, 35),
        "initial_ego_distance_behind_stop_line_m": (45, 90),
        "initial_hero_distance_behind_stop_line_m": (20, 35),
        "end_hero_distance_behind_conflict_point_m": (5.5, 8),
        "ego_tta_behind_stop_line_s": (3.5, 6.5),
        "initial_ego_tta_behind_intersection_s": (9, 13),
        "hero_tta_behind_stop_line_s": (1, 3),
        "target_speed_mps": (4, 10),
        "hero_deceleration_mpss": (1.5, 6),
    }.items():
        assert low - 0.005 <= values[name] <= high + 0.005, name


@given(seeds)
def test_a_range_of_the_program_is_what_is_drawn_from(seed: tuple[int, ...]) -> None:
    given = [
        Parameter("ego_gap_m", low=Fraction(20), high=Fraction(22)),
        Parameter("initial_ego_gap_m", low=Fraction(95), high=Fraction(96)),
        Parameter("hero_gap_ft", low=Fraction(200)),
        Parameter("hero_speed_kph", high=Fraction(12)),
        Parameter("hero_s", low=Fraction("1.501"), high=Fraction("1.504")),
    ]
    values = draw_parameters(given, seed)
    for each in given:
        assert float(each.low or 0) <= values[each.name] <= float(each.high or 1000), each.name


def test_all_of_a_range_is_drawn_from() -> None:
    given = [Parameter("ego_gap_m", low=Fraction(20), high=Fraction(22))]
    drawn = [draw_parameters(given, (seed,))["ego_gap_m"] for seed in range(50)]
    assert min(drawn) < 20.3
    assert max(drawn) > 21.7


@given(seeds)
def test_ego_starts_before_its_trigger(seed: tuple[int, ...]) -> None:
    values = drawn(NAMES, seed)
    assert values["initial_ego_distance_behind_stop_line_m"] >= values["ego_distance_behind_stop_line_m"] + 14.99
    assert values["initial_ego_tta_behind_intersection_s"] >= values["ego_tta_behind_stop_line_s"] + 2.49


@given(seeds)
def test_values_are_in_the_unit_of_the_name(seed: tuple[int, ...]) -> None:
    metres, feet = drawn(["hero_gap_m"], seed)["hero_gap_m"], drawn(["hero_gap_ft"], seed)["hero_gap_ft"]
    assert feet * 0.3048 == pytest.approx(metres, abs=0.01)
    assert drawn(["cruise_kph"], seed)["cruise_kph"] == pytest.approx(
        3.6 * drawn(["cruise_mps"], seed)["cruise_mps"], abs=0.03
    )


@given(seeds)
def test_values_have_two_decimals_as_they_are_typed(seed: tuple[int, ...]) -> None:
    for value in drawn(NAMES, seed).values():
        assert len(str(value).partition(".")[2]) <= 2
