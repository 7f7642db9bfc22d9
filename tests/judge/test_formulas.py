"""Any form of constraint is judged, on whatever moments it speaks of; what cannot be judged fails with a reason."""

from __future__ import annotations

from dataclasses import replace

import pytest
from plays import BRAKES, GOES_AFTER, YIELDS, Play

from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Condition


def judged(play: Play, formula: str) -> Condition:
    """Judge one more constraint on a play that passes."""
    return judge(replace(play, text=play.text + f"extra: {formula}\n").case()).condition("extra")


# YIELDS: trigger at 4.003 s, hero at 12 m/s until then, at rest from 8.67 s at 88 m; ego 8 m/s, then +0.5 m/s^2.
@pytest.mark.parametrize(
    ("formula", "tight", "loose"),
    [
        ("A1v(t1) >= 11", True, True),
        ("A1v(t1) >= 12.6", False, True),
        ("A1v(t1) >= 13.6", False, False),
        ("A1v(2.5) == 12", True, True),
        ("A1x(2.5) == 42", True, True),
        ("A1a(6.0) == -2.571", True, True),
        ("A1a(6.0) == -3", False, True),
        ("A1a(t1) == -2.571", True, True),
        ("A1a(t2) == -2.571", True, True),  # of the piece that ends there
        ("A1v(t1) / A0v(t1) <= 1.52", True, True),
        ("A1v(t1) / A0v(t1) <= 1.48", True, True),  # 12 by 8 is 1.5: off by 0.16 m/s
        ("A1v(t1) / A0v(t1) <= 1.4", False, True),
        ("1.3 >= A1v(t1) / A0v(t1)", False, False),
        ("A1v(A0(t1)) == 12", True, True),
        ("A1(t2) - A1(t1) == 4.667", True, True),
        ("A1(t2) == A1(t1) + 5", False, True),
        ("A0v(t1) * 2 == 16", True, True),
        ("A1v(t1) / 2 <= 6", True, True),
        ("A1v(go) == 12", True, True),
        ("A1v(go) <= 11.5", False, True),
        ("A1v(dec) <= 12", True, True),
        ("A0v(t1) < A1v(t1)", True, True),
        ("A0x(t1) - A0.stop_line == A1x(t1) - A1.conflict_point + 22", True, True),
        ("headway(A0, A1, t1) >= 0 s or A1v(t1) >= 11", True, True),
        ("A1v(t1) >= 13.6 or A1v(t2) == 0", True, True),
        ("A1v(t1) >= 12.6 or A1v(t1) >= 13.6", False, True),
        ("A1v(t1) >= 11 and A1v(t1) >= 13.6", False, False),
        ("not A1v(t1) >= 13.6", True, True),
        ("not A1v(t1) >= 11.5", False, True),
        ("not (A1v(t1) <= 11 or A1v(t1) >= 13)", True, True),
        ("A1v(t1) >= 11 implies A1v(t2) == 0", True, True),
        ("A1v(t1) >= 10 implies A1v(t2) == 3", False, False),
        ("A1v(t1) <= 5 implies A1v(t2) == 3", True, True),
        ("always[0, A1(t1)](A1v == 12)", True, True),
        ("always[0, A1(t2)](A1v >= 0.5)", False, True),
        ("always[A1(t1), A1(t2)](A1a <= -2.5)", True, True),
        ("eventually[0, 8](A1v <= 2)", True, True),
        ("always[A1(t2), A1(t1)](A1v == 99)", True, True),  # at no instant
        ("eventually[A1(t2), A1(t1)](A1v <= 99)", False, False),
        ("always[-5, -2](A1v == 99)", True, True),  # over before the start
        ("eventually[-5, -2](A1v <= 99)", False, False),
        ("eventually[0, 4](A1v <= 2)", False, False),
        ("never[0, A1(t1)](A1v < 11)", True, True),
        ("never[0, A1(t2)](A1v < 3)", False, False),
        ("not eventually[0, 4](A1v <= 10)", True, True),
        ("not always[0, A1(t2)](A1v >= 6)", True, True),
        ("not never[0, A1(t2)](A1v <= 6)", True, True),
        ("always[0, A1(t1)](A1v >= 11 and A0v >= 7)", True, True),
        ("always[0, A1(t2)](A1v >= 11 or A1x >= 59)", True, True),
    ],
)
def test_formula(formula: str, tight: bool, loose: bool) -> None:
    condition = judged(YIELDS, formula)
    assert (condition.holds_at(TIGHT), condition.holds_at(LOOSE)) == (tight, loose), condition


@pytest.mark.parametrize(
    ("formula", "reason"),
    [
        ("gap(A0, A1, t1) == 12", "share no lane"),
        ("A0x(t1) - A1x(t1) == 12", "share no lane"),
        ("A1x(t1) == turn_start", "no landmark turn_start"),
        ("A1v(30.0) == 3", "ended before"),
        ("A1a(acc) == 3", "no piece acc"),
        ("always[0, 5](eventually[0, 3](A1v >= 3))", "inside another"),
        ("always[40, 50](A1v >= 3)", "ended before"),
        ("always[9, 50](A1v <= 0.1)", "before the stretch of time did"),  # nobody saw whether it did stand so long
    ],
)
def test_what_cannot_be_judged_fails_and_says_why(formula: str, reason: str) -> None:
    condition = judged(YIELDS, formula)
    assert not condition.holds_at(LOOSE)
    assert reason in condition.text
    assert condition.as_dict()["error"] is None


def test_worst_instant_between_samples_is_found() -> None:
    condition = judged(YIELDS, "always[0, A1(t1)](A1x <= 59.9)")
    assert condition.error == pytest.approx(0.1, abs=1e-3)  # at 4.003 s itself, which is no sample


def test_temporal_bound_is_tight_at_a_peak() -> None:
    # The ego's speed peaks between two samples, at 5.011 s with 12.022 m/s.
    play = YIELDS.with_ego(s_m=42.0 - 8.0 * 4.003, pieces=[(4.003, 0.0), (1.008, 3.0), (3.0, -3.0)])
    condition = judged(play, "always[0, 10](A0v <= 11.0)")
    assert condition.error == pytest.approx(8.0 + 3.0 * 1.008 - 11.0, rel=2e-3)


def test_positions_in_one_lane_are_compared_as_the_paper_writes_them() -> None:
    assert judged(BRAKES, "A1x(t1) - A0x(t1) == 20").holds_at(TIGHT)
    assert judged(BRAKES, "A1x(t1) == A0x(t1) + 20").holds_at(TIGHT)
    assert judged(BRAKES, "always[0, 7](A0x <= A1x - 20)").holds_at(TIGHT)
    assert not judged(BRAKES, "headway(A0, A1, t1) == 3 s").holds_at(LOOSE)
    assert judged(BRAKES, "headway(A0, A1, t1) == 1.55 s").error == pytest.approx(0.0, abs=1e-3)
    assert judged(BRAKES, "ttc(A0, A1, t1) == 7.75 s").error == pytest.approx(0.0, abs=2e-3)


def test_standing_for_a_while_is_measured_and_not_assumed() -> None:
    assert judged(GOES_AFTER, "A1(t3) == A1(t2) + 1.5").error == pytest.approx(0.0, abs=1e-3)
    assert not judged(GOES_AFTER, "A1(t3) == A1(t2) + 3").holds_at(LOOSE)


@pytest.mark.parametrize(("begins_s", "holds"), [("7.5", True), ("7.5000000001", True), ("7.51", False)])
def test_a_stretch_that_ends_where_it_begins_to_within_rounding_is_that_moment(begins_s: str, holds: bool) -> None:
    assert judged(BRAKES, f"eventually[{begins_s}, 7.5](A1v >= 7.9)").holds_at(LOOSE) == holds
