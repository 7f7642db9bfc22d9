"""Perfect performances pass with errors near nothing; each way of spoiling one fails exactly what it should."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plays import AHEAD, BRAKES, CROSSING, GOES_AFTER, NOT_YIELDING, PLAYS, YIELDS, Motion, Play, on_line, text

from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT, Tolerance
from scenewright.judge.verdict import Verdict
from scenewright.trace.model import ActorTrace


def failed(verdict: Verdict, tolerance: Tolerance) -> set[str]:
    return {condition.id for condition in verdict.conditions if not condition.holds_at(tolerance)}


@pytest.mark.parametrize("phase_s", [0.0, 0.003, 0.0137])
@pytest.mark.parametrize("name", PLAYS)
def test_perfect_performance_passes_with_errors_near_nothing(name: str, phase_s: float) -> None:
    play = replace(PLAYS[name], phase_s=phase_s)
    verdict = judge(play.case())
    assert not failed(verdict, TIGHT)
    assert verdict.as_dict()["success"] == {"tight": True, "loose": True}
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(play.trigger_s, abs=1e-3)
    checked = [c for c in verdict.conditions if c.kind in ("initial", "trigger", "interaction", "outcome")]
    assert all(abs(c.error) < 1e-3 for c in checked if c.error is not None), [(c.id, c.error) for c in checked]
    assert {c.kind for c in verdict.conditions} >= {"route", "trigger", "interaction", "safety"}


def test_every_constraint_of_the_program_has_a_condition_in_plain_words() -> None:
    for play in PLAYS.values():
        case = play.case()
        verdict = judge(case)
        assert {c.id for c in case.program.constraints} <= {c.id for c in verdict.conditions}
    told = judge(BRAKES.case()).condition("c3").text
    assert told == "the ego is gap_m behind the hero when the hero begins to brake"


def line_of(trace: ActorTrace) -> tuple[float, float, float]:
    heading = float(trace.heading_rad[0])
    x0 = float(trace.x_m[0] - trace.s_m[0] * np.cos(heading))
    y0 = float(trace.y_m[0] - trace.s_m[0] * np.sin(heading))
    return x0, y0, heading


def backing_up(trace: ActorTrace) -> ActorTrace:
    """Add a second of rolling backwards, ever faster, and a second of slowing down from it."""
    a = np.where((trace.time_s > 11.0) & (trace.time_s < 12.0), -0.5, 0.0)
    a += np.where((trace.time_s > 12.0) & (trace.time_s < 13.0), 0.5, 0.0)
    steps = np.diff(trace.time_s)
    v = np.concatenate(([0.0], np.cumsum(a[:-1] * steps)))
    s = np.concatenate(([0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * steps)))
    return on_line(trace.time_s, trace.s_m + s, trace.speed_mps + v, trace.accel_mps2 + a, line_of(trace))


def jumping(trace: ActorTrace) -> ActorTrace:
    v = trace.speed_mps.copy()
    v[100:125] += 1.2
    v[125:150] -= 1.2
    s = trace.s_m[0] + np.concatenate(([0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(trace.time_s))))
    return on_line(trace.time_s, s, v, trace.accel_mps2, line_of(trace))


T = YIELDS.trigger_s
STOP_28 = -(12.0**2) / 56.0
ELSEWHERE = (500.0, 100.0, -np.pi / 2)  # far from the ego, so that a late hero does not hit it as well
# Hero 1.5 m late at the trigger, yet it stops where it should. Half of the 1.5 m falls on each side, by their speeds.
OFF = Motion(YIELDS.hero.s_m - 1.5, 12.0, [(T, 0.0), (10.0, -(12.0**2) / (2 * 29.5))])
BACK_LATE = {"route_hero_progress", "kin_hero_reverse"}

SPOILED: dict[str, tuple[Play, Callable[[ActorTrace], ActorTrace] | None, set[str], set[str]]] = {
    "brakes 0.3 s late": (BRAKES.with_hero(pieces=[(7.8, 0.0), (5.0, -4.0)]), None, {"hero_onset"}, set()),
    "brakes 0.4 s early": (BRAKES.with_hero(pieces=[(7.1, 0.0), (5.0, -4.0)]), None, {"hero_onset"}, set()),
    "brakes 1 s early": (BRAKES.with_hero(pieces=[(6.5, 0.0), (5.0, -4.0)]), None, {"hero_onset"}, {"hero_onset"}),
    "brakes, lets go, brakes at the trigger": (
        BRAKES.with_hero(s_m=35.16, pieces=[(7.0, 0.0), (0.2, -2.0), (0.3, 0.0), (5.0, -4.0)]).with_ego(
            pieces=[(7.5, 0.0), (10.0, -2.2)]
        ),
        None,
        {"hero_settled"},
        {"hero_settled"},
    ),
    "rate 20 % off": (BRAKES.with_hero(pieces=[(7.5, 0.0), (5.0, -4.8)]), None, {"c4"}, set()),
    "rate 40 % off": (BRAKES.with_hero(pieces=[(7.5, 0.0), (5.0, -5.6)]), None, {"c4"}, {"c4"}),
    "gap 3 m off all the time": (
        replace(BRAKES, parameters={"gap_m": 40.0, "rate_mpss": 4.0}),
        None,
        {"c3", "hero_onset"},
        {"c3", "hero_onset"},
    ),
    "hero 1.5 m off": (replace(YIELDS, hero=OFF), None, {"c3", "c4"}, set()),
    "stops 1 m short": (
        YIELDS.with_hero(pieces=[(T, 0.0), (10.0, -(12.0**2) / 54.0)]),
        None,
        {"c5"},
        set(),
    ),
    "stops 3 m too far": (
        YIELDS.with_hero(pieces=[(T, 0.0), (10.0, -(12.0**2) / 62.0)]),
        None,
        {"c5"},
        {"c5"},
    ),
    "never stops": (
        YIELDS.with_hero(pieces=[(T, 0.0), (4.0, -2.2)]),
        None,
        {"c5", "c6", "hero_standstill"},
        {"c5", "c6", "hero_standstill"},
    ),
    "ego stops 10 m before its side of the trigger": (
        YIELDS.with_ego(pieces=[(1.752998, 0.0), (9.0, -4.0)]),
        None,
        {"c3"},
        {"c3"},
    ),
    "starts elsewhere": (
        replace(YIELDS, text=YIELDS.text.replace("intersection - 60.02", "intersection - 61.22")),
        None,
        {"c1"},
        set(),
    ),
    "goes after the ego": (
        replace(NOT_YIELDING, hero_line=ELSEWHERE).with_ego(pieces=[(T, 0.0), (4.0, 2.0)]),
        None,
        {"c6"},
        {"c6"},
    ),
    "does not speed up": (
        NOT_YIELDING.with_hero(pieces=[]).with_ego(pieces=[(T, 0.0), (1.0, -2.5)]),
        None,
        {"hero_onset"},
        {"hero_onset"},
    ),
    "never goes again": (
        GOES_AFTER.with_hero(pieces=[(T, 0.0), (56.0 / 12.0, STOP_28)]),
        None,
        {"c7", "c9", "hero_goes_again", "hero_acc"},
        {"c7", "c9", "hero_goes_again", "hero_acc"},
    ),
    "goes again too late": (
        replace(GOES_AFTER, hero_line=ELSEWHERE).with_hero(
            pieces=[(T, 0.0), (56.0 / 12.0, STOP_28), (14.5, 0.0), (4.0, 2.0)]
        ),
        None,
        {"c9"},
        {"c9"},
    ),
    "hesitates while speeding up": (
        NOT_YIELDING.with_hero(pieces=[(T, 0.0), (1.0, 2.0), (0.5, -1.2), (3.0, 2.0)]),
        None,
        {"hero_acc"},
        set(),
    ),
    "jumps in speed": (BRAKES, jumping, {"kin_hero_speed_jump"}, {"kin_hero_speed_jump"}),
    "backs up": (YIELDS, backing_up, BACK_LATE, {"route_hero_progress"}),
}


@pytest.mark.parametrize("name", SPOILED)
def test_spoiled_performance_fails_exactly_what_it_should(name: str) -> None:
    play, change, tight, loose = SPOILED[name]
    verdict = judge(play.case(change))
    table = [(c.id, c.required, c.measured, c.error) for c in verdict.conditions if not c.holds_at(TIGHT)]
    assert failed(verdict, TIGHT) == tight, table
    assert failed(verdict, LOOSE) == loose, table
    assert verdict.as_dict()["success"] == {"tight": not tight, "loose": not loose}


def test_errors_are_signed_and_in_units() -> None:
    early = judge(BRAKES.with_hero(pieces=[(6.5, 0.0), (5.0, -4.0)]).case()).condition("hero_onset")
    assert early.error is not None
    assert early.error < -0.5
    assert early.unit == "s"
    short = judge(YIELDS.with_hero(pieces=[(T, 0.0), (10.0, -(12.0**2) / 54.0)]).case()).condition("c5")
    assert (short.required, short.unit) == (12.0, "m")
    assert short.measured == pytest.approx(13.0, abs=1e-3)
    rate = judge(BRAKES.with_hero(pieces=[(7.5, 0.0), (5.0, -4.8)]).case()).condition("c4")
    assert rate.error == pytest.approx(-0.8, abs=1e-3)
    assert rate.holds_at(Tolerance(0.0, 0.0, 0.0, 0.81))
    assert not rate.holds_at(Tolerance(9.0, 9.0, 9.0, 0.79))
    assert rate.normalised_error(LOOSE) == pytest.approx(0.8, abs=1e-3)


def test_ego_that_never_comes_to_the_trigger_is_told_with_evidence() -> None:
    facts = judge(YIELDS.with_ego(pieces=[(1.752998, 0.0), (9.0, -4.0)]).case()).facts
    assert facts["ego_never_met_condition"]
    assert not facts["hero_never_met_condition"]
    ego = next(side for side in facts["closest"] if side["who"] == "ego")
    assert (ego["met"], ego["unit"]) == (False, "m")
    assert ego["error"] == pytest.approx(10.0, abs=0.01)
    assert not judge(YIELDS.case()).facts["ego_never_met_condition"]


def test_hero_that_never_comes_is_told_apart_from_the_ego() -> None:
    facts = judge(YIELDS.with_hero(s_m=-60.0).case()).facts
    assert facts["hero_never_met_condition"]
    assert not facts["ego_never_met_condition"]


def test_order_holds_where_the_hero_went_and_the_ego_never_did() -> None:
    verdict = judge(NOT_YIELDING.with_ego(pieces=[(T, 0.0), (10.0, -2.0)]).case())
    assert not failed(verdict, TIGHT)
    assert verdict.condition("c6").measured == np.inf
    assert verdict.as_dict()["conditions"][[c.id for c in verdict.conditions].index("c6")]["measured"] is None
    assert "never came to" in verdict.condition("c5").text


def test_ego_that_had_turned_before_the_trigger_is_not_taken_for_one_that_never_turns() -> None:
    # The stop line lies behind the turn here, so the ego has turned when the trigger comes.
    case = NOT_YIELDING.with_ego(pieces=[]).case()
    moved = replace(case, landmarks={**case.landmarks, "ego": {**case.landmarks["ego"], "turn_start": 40.0}})
    verdict = judge(moved)
    assert failed(verdict, LOOSE) == {"c6"}
    assert verdict.condition("c6").measured is not None
    assert verdict.condition("c6").measured < 0


def test_reversed_order_is_wrong_by_any_margin() -> None:
    slow = NOT_YIELDING
    for push in np.linspace(0.0, 1.5, 16):
        verdict = judge(slow.with_ego(pieces=[(T, 0.0), (4.0, push)]).case())
        condition = verdict.condition("c6")
        assert condition.measured is not None
        assert condition.holds_at(LOOSE) == (condition.measured >= 0) == condition.holds_at(TIGHT)


MEETS = Play(
    text=text(
        "[t0, go, t1, go, t2]", "A0(t1) == A1(t1)\nA0x(t1) == conflict_point\nA1x(t1) == conflict_point\nA1v(t1) == 12"
    ),
    ego=Motion(0.0, 10.0, []),
    hero=Motion(16.0, 12.0, []),
    trigger_s=7.0,
    hero_line=CROSSING,
    duration_s=9.0,
)


def test_contact_that_is_asked_for_is_no_failure() -> None:
    verdict = judge(MEETS.case())
    assert not failed(verdict, TIGHT)
    hit = verdict.facts["pairs"]["ego, hero"]["collision_time_s"]
    assert 6.0 < hit < 7.0, "it is a fact all the same"


@pytest.mark.parametrize("unsaid", ["A1x(t1) == conflict_point\n", "A0x(t1) == conflict_point\n"])
def test_contact_at_a_trigger_that_does_not_say_where_both_are_is_one(unsaid: str) -> None:
    assert unsaid in MEETS.text
    assert "no_collision" in failed(judge(replace(MEETS, text=MEETS.text.replace(unsaid, "")).case()), LOOSE)


def test_contact_that_is_over_before_the_trigger_is_one() -> None:
    """The hero crosses right before the ego's nose once, and is where it was asked to be only later."""
    later = replace(MEETS, text=MEETS.text.replace("A1x(t1) == conflict_point", "A1x(t1) == conflict_point + 8"))
    over = later.with_hero(s_m=24.0).with_ego(s_m=-0.0)
    through = replace(over, hero_line=(62.0, 100.0, -np.pi / 2))
    verdict = judge(through.case())
    assert "no_collision" in failed(verdict, LOOSE)


def test_collision_before_the_trigger_fails_and_later_is_a_fact() -> None:
    over_there = replace(YIELDS, hero_line=(YIELDS.ego.s_m + 16.0, YIELDS.hero.s_m + 24.0, -np.pi / 2))
    verdict = judge(over_there.case())
    assert failed(verdict, LOOSE) == {"no_collision"}
    assert verdict.facts["pairs"]["ego, hero"]["collision_time_s"] == pytest.approx(1.8, abs=0.3)
    later = judge(BRAKES.with_ego(pieces=[]).case())
    assert not failed(later, TIGHT)
    assert later.facts["pairs"]["ego, hero"]["collision_time_s"] == pytest.approx(9.5 + 3.5 / 10.0, abs=0.01)


def test_safety_facts_of_a_crossing() -> None:
    pair = judge(NOT_YIELDING.with_ego(pieces=[]).case()).facts["pairs"]["ego, hero"]
    # Zone half-length 3.2 m: the hero leaves it at 103.2 m, the ego enters it at 66.8 m.
    enters_s = (66.8 - NOT_YIELDING.ego.s_m) / 8.0
    leaves_s = T + (-12.0 + np.sqrt(144.0 + 4 * 43.2)) / 2.0
    assert pair["post_encroachment_time_s"] == pytest.approx(enters_s - leaves_s, abs=0.05)
    assert 0 < pair["min_distance_m"] < 10
    assert pair["collision_time_s"] is None
    following = judge(BRAKES.case()).facts["pairs"]["ego, hero"]
    # The ego stops 100 / 4.4 m after 75 m, the hero at 103 m; between the centres lie 4.5 m of cars.
    assert following["min_distance_m"] == pytest.approx(103.0 - 75.0 - 100 / 4.4 - 4.5, abs=1e-3)
    assert following["min_ttc_s"] is not None


@settings(max_examples=40)
@given(
    ego_mps=st.floats(3, 15),
    hero_mps=st.floats(3, 15),
    ego_mpss=st.floats(-0.5, 0.5),
    hero_mpss=st.floats(-0.3, 0.3),
    trigger_s=st.floats(1.0, 5.0),
    phase_s=st.floats(0.0, 0.0199),
)
def test_trigger_instant_is_found_between_samples(
    ego_mps: float, hero_mps: float, ego_mpss: float, hero_mpss: float, trigger_s: float, phase_s: float
) -> None:
    def start(v: float, a: float, place: float) -> Motion:
        return Motion(place - v * trigger_s - 0.5 * a * trigger_s**2, v, [(trigger_s + 3.0, a)])

    hero = start(hero_mps, hero_mpss, 60.0)
    brakes = replace(hero, pieces=[(trigger_s, hero_mpss), (9.0, -3.0)])
    play = replace(YIELDS, ego=start(ego_mps, ego_mpss, 42.0), hero=brakes, phase_s=phase_s, duration_s=trigger_s + 6)
    verdict = judge(play.case())
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(trigger_s, abs=1e-3)
    for side in ("c3", "c4"):
        error = verdict.condition(side).error
        assert error is not None
        assert abs(error) < 1e-3
    onset = verdict.condition("hero_onset").error
    assert onset is not None
    assert abs(onset) < 2e-3


def test_hero_that_follows_in_the_same_lane_is_measured_with_the_shared_offset() -> None:
    shifted = replace(BRAKES, offset_m=-200.0).with_hero(s_m=235.0)
    verdict = judge(replace(shifted, hero_line=(-200.0, *AHEAD[1:])).case())
    assert not failed(verdict, TIGHT)
    assert verdict.condition("c3").measured == pytest.approx(20.0, abs=1e-3)


def test_gap_without_a_shared_lane_fails_and_says_why() -> None:
    condition = judge(replace(BRAKES, offset_m=None).case()).condition("c3")
    assert not condition.holds_at(LOOSE)
    assert "share no lane" in condition.text


def test_ego_that_began_beyond_its_place_was_there_before_the_hero() -> None:
    # The place that the outcome speaks of lies at 64 m.
    late = judge(NOT_YIELDING.with_ego(s_m=70.0).case())
    order = late.condition("c6")
    assert not order.holds_at(LOOSE)
    assert late.condition("c5").measured is not None
