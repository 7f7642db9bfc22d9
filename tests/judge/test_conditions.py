"""Required, measured and error of each constraint, as people would state them; orders have no tolerance."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from plays import BRAKES, NOT_YIELDING, YIELDS, YIELDS_AT_S, Play, failed

from scenewright.judge.conditions import Judged, program_conditions
from scenewright.judge.judgement import judge
from scenewright.judge.knots import best_instants, measure
from scenewright.judge.tolerance import LOOSE, TIGHT, Tolerance
from scenewright.judge.verdict import Condition


def test_errors_are_signed_and_in_units() -> None:
    early = judge(BRAKES.with_hero(pieces=[(6.5, 0.0), (5.0, -4.0)]).case()).condition("hero_onset")
    assert early.error is not None
    assert early.error < -0.5
    assert early.unit == "s"
    short = judge(YIELDS.with_hero(pieces=[(YIELDS_AT_S, 0.0), (10.0, -(12.0**2) / 54.0)]).case()).condition("c5")
    assert (short.required, short.unit) == (12.0, "m")
    assert short.measured == pytest.approx(13.0, abs=1e-3)
    rate = judge(BRAKES.with_hero(pieces=[(7.5, 0.0), (5.0, -4.8)]).case()).condition("c4")
    assert rate.error == pytest.approx(-0.8, abs=1e-3)
    assert rate.holds_at(Tolerance(0.0, 0.0, 0.0, 0.81))
    assert not rate.holds_at(Tolerance(9.0, 9.0, 9.0, 0.79))
    assert rate.normalised_error(LOOSE) == pytest.approx(0.8, abs=1e-3)


def test_order_holds_where_the_hero_went_and_the_ego_never_did() -> None:
    verdict = judge(NOT_YIELDING.with_ego(pieces=[(YIELDS_AT_S, 0.0), (10.0, -2.0)]).case())
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
        verdict = judge(slow.with_ego(pieces=[(YIELDS_AT_S, 0.0), (4.0, push)]).case())
        condition = verdict.condition("c6")
        assert condition.measured is not None
        assert condition.holds_at(LOOSE) == (condition.measured >= 0) == condition.holds_at(TIGHT)


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


def told(play: Play, formula: str) -> Condition:
    """Judge one more constraint on a play that passes."""
    return judge(replace(play, text=play.text + f"extra: {formula}\n").case()).condition("extra")


# YIELDS: at 2.503 s the hero has 12 m/s at 42 m, 58 m short of its point; it stands at 88 m from 8.67 s on.
@pytest.mark.parametrize(
    ("formula", "required", "measured", "error", "unit"),
    [
        ("A1v(2.5) == 11.5", 11.5, 12.0, 0.5, "m/s"),
        ("11.5 == A1v(2.5)", 11.5, 12.0, 0.5, "m/s"),  # what is measured is so on either side
        ("A1v(2.5) <= 11.5", 11.5, 12.0, 0.5, "m/s"),
        ("A1v(2.5) >= 11.5", 11.5, 12.0, 0.0, "m/s"),
        ("A1x(2.503) == conflict_point - 57", 57.0, 58.0, 1.0, "m"),  # a distance to a place is told as such
        ("A1x(2.503) <= conflict_point - 59", 59.0, 58.0, 1.0, "m"),  # a bound on it, too
        ("conflict_point - 57 == A1x(2.503)", 57.0, 58.0, 1.0, "m"),
        ("A1x(2.503) == just before conflict_point - 52 m", 57.0, 58.0, 1.0, "m"),
        ("A1v(2.5) / A0v(2.5) <= 1.4", 1.4, 1.5, 0.1, ""),
        ("A1v(go) == 11", 11.0, 12.0, 1.0, "m/s"),  # all through a piece: its worst instant
        ("A1(t2) - A1(t1) == 5", 5.0, 14.0 / 3.0, -1.0 / 3.0, "s"),
        ("A1x(t2) == conflict_point + 3", 3.0, -12.0, -15.0, "m"),
    ],
)
def test_what_was_required_and_measured(
    formula: str, required: float, measured: float, error: float, unit: str
) -> None:
    condition = told(YIELDS, formula)
    assert condition.unit == unit
    assert (condition.required, condition.measured) == pytest.approx((required, measured), abs=2e-3)
    assert condition.error == pytest.approx(error, abs=2e-3)


@pytest.mark.parametrize(("rate", "read"), [("-2.5714", -2.5714), ("2.5714", 2.5714), ("0", 0.0), ("-rate_mpss", -4.0)])
def test_a_rate_of_slowing_down_has_its_sign(rate: str, read: float) -> None:
    condition = told(replace(YIELDS, parameters={"rate_mpss": 4.0}), f"A1a(dec) == {rate}")
    assert condition.required == pytest.approx(read)
    assert condition.measured == pytest.approx(-144.0 / 56.0, abs=1e-3)
    assert condition.holds_at(LOOSE) == (rate == "-2.5714")


def test_a_place_that_was_never_reached_is_missed_by_how_near_one_came() -> None:
    """By the end of the run; who stands 12 m short of where it was to stand is 12 m off as well."""
    condition = told(YIELDS, "A1x(t2) == conflict_point")
    assert abs(condition.error or 0.0) == pytest.approx(12.0, abs=1e-2)
    short = judge(NOT_YIELDING.with_hero(pieces=[(YIELDS_AT_S, 0.0), (9.0, -3.0)]).case()).condition("c4")
    assert "never got so far; this is the end of the run" in short.text
    assert abs(short.error or 0.0) == pytest.approx(100.0 - 60.0 - 24.0, abs=1e-2)  # it stops 24 m behind its trigger


def test_an_order_is_told_with_its_margin() -> None:
    condition = told(YIELDS, "A1(t1) < A1(t2)")
    assert (condition.required, condition.unit) == (0.0, "s")
    assert condition.measured == pytest.approx(14.0 / 3.0, abs=1e-3)
    assert condition.text.endswith("(margin; at least 0)")


def test_what_is_no_comparison_is_off_in_its_unit_where_that_is_one() -> None:
    condition = told(YIELDS, "A1v(t1) >= 12.5 or A1v(t1) >= 13")
    assert (condition.required, condition.measured, condition.unit) == (None, None, "m/s")
    assert (condition.error, condition.off_by) == (pytest.approx(0.5), "0.50 m/s")
    several = told(YIELDS, "A1v(t1) >= 12.5 or A1x(t1) <= 0")
    assert (several.error, several.off_by) == (pytest.approx(0.5 / 0.25), "2.00 tight tolerances")
    assert several.text.endswith("(error in tight tolerances)")


@pytest.mark.parametrize(
    ("formula", "required", "measured", "error"),
    [
        ("always[A1(t1), A1(t2)] (A1v <= 10)", 10.0, 12.0, 2.0),
        ("always[A1(t1), A1(t2)] (A1v >= 4)", 4.0, 0.0, 4.0),
        ("never[A1(t1), A1(t2)] (A1v > 13)", 13.0, 12.0, 0.0),
        ("eventually[A1(t1), A1(t2)] (A1v >= 14)", 14.0, 12.0, 2.0),
        ("eventually[A1(t1), A1(t2)] (A1v <= 3)", 3.0, 0.0, 0.0),
        ("not (eventually[A1(t1), A1(t2)] (A1v >= 11))", None, None, 1.0),
    ],
)
def test_what_lasts_is_told_with_the_value_that_decides(
    formula: str, required: float | None, measured: float | None, error: float
) -> None:
    condition = told(YIELDS, formula)
    assert condition.unit == "m/s"
    assert condition.error == pytest.approx(error, abs=2e-3)
    if required is None or measured is None:
        assert (condition.required, condition.measured) == (None, None)
    else:
        assert (condition.required, condition.measured) == pytest.approx((required, measured), abs=2e-3)


def test_only_what_speaks_of_a_moved_knot_is_judged_again() -> None:
    case, judged = BRAKES.case(), Judged()
    measured = measure(case, best_instants(case)[0])
    first = program_conditions(case, measured, judged)
    moved = replace(measured.moments, knots={**measured.moments.knots, (1, "t2"): 9.0})
    again = program_conditions(case, replace(measured, moments=moved), judged)
    assert [new.id for old, new in zip(first, again, strict=True) if new is not old] == ["c5"]  # A1v(t2) == 0
    anew = program_conditions(case, replace(measured, moments=moved))
    assert [each.as_dict() for each in again] == [each.as_dict() for each in anew]
    shorter = replace(moved, spans={**moved.spans, (1, 1): (7.5, 8.0)})
    assert program_conditions(case, replace(measured, moments=shorter), judged)[3] is not first[3]  # A1a(dec)
