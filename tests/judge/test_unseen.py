"""Knots that a trace does not show may have been any moment at which all is as asked; what never was still fails."""

from __future__ import annotations

from dataclasses import replace

import pytest
from plays import AHEAD, CROSSING, YIELDS, Motion, Play, text

from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.judge.unseen import measured_at_best
from scenewright.judge.verdict import Verdict


def with_extra(play: Play, formula: str) -> Play:
    return replace(play, text=play.text + f"extra: {formula}\n")


def failing(verdict: Verdict) -> set[str]:
    return {condition.id for condition in verdict.conditions if not condition.holds_at(TIGHT)}


# YIELDS says nothing of the ego's t2. The ego has 8 m/s until its t1 at 4.003 s, and 0.5 m/s^2 from there on.
@pytest.mark.parametrize(
    ("formula", "holds"),
    [
        ("A0v(t2) == 10", True),
        ("A0v(t2) == 20", False),
        ("A0v(t2) >= 10 and A0(t2) <= 9", True),
        ("A0v(t2) >= 10 and A0(t2) <= 7", False),
        ("A0v(t2) == 9 and A0x(t2) >= stop_line + 10", False),
        ("A0(t2) <= A0(t1) + 0.2", True),
        ("A0(t2) <= A0(t1) - 0.2", False),
        ("always[A0(t1), A0(t2)](A0v <= 9) and A0(t2) - A0(t1) >= 1", True),
        ("always[A0(t1), A0(t2)](A0v <= 9) and A0(t2) - A0(t1) >= 3", False),
        ("A1x(A0(t2)) == conflict_point - 12 and A0v(t2) >= 9", True),
        ("A1x(A0(t2)) == conflict_point - 5", False),
    ],
)
def test_a_free_knot_is_where_what_is_said_of_it_holds(formula: str, holds: bool) -> None:
    assert failing(judge(with_extra(YIELDS, formula).case())) == (set() if holds else {"extra"})


def test_a_free_knot_lies_between_those_that_are_not() -> None:
    measured = measured_at_best(with_extra(YIELDS, "A0v(t2) == 10").case())
    assert measured.moments.knots[0, "t2"] == pytest.approx(8.003, abs=0.01)
    play = replace(YIELDS, text=YIELDS.text.replace("[t0, go, t1, go, t2]", "[t0, go, tx, go, t1, go, t2]"))
    assert failing(judge(with_extra(play, "A0x(tx) == A0x(t0) + 8").case())) == set()
    assert failing(judge(with_extra(play, "A0v(tx) == 10").case())) == {"extra"}


# The trigger comes a time after the ego passed a place; the hero is seen to brake for something else before.
DELAYED = Play(
    text=text(
        "[t0, go, t1, dec, t2]",
        "A0(t2) == A1(t1)\nA0x(t1) == stop_line - 30\nA0(t2) - A0(t1) == 2\nA1v(t2) == 0",
        ego_sketch="[t0, go, t1, go, t2, go, t3]",
    ),
    ego=Motion(6.0, 8.0, []),
    hero=Motion(0.0, 12.0, [(0.5, 0.0), (0.6, -2.0), (3.9, 0.0), (10.0, -2.5)]),
    trigger_s=5.0,
    hero_line=CROSSING,
    duration_s=15.0,
)


def test_a_trigger_that_is_told_by_a_delay_is_there() -> None:
    verdict = judge(DELAYED.case())
    assert failing(verdict) == set()
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(5.0, abs=0.02)
    late = DELAYED.with_hero(pieces=[(0.5, 0.0), (0.6, -2.0), (4.4, 0.0), (10.0, -2.5)])
    assert failing(judge(late.case())) != set()


# Nothing ties the hero's braking to the ego: it is told by the clock, and seen.
CLOCK = Play(
    text=text("[t0, go, t1, dec, t2]", "A1(t1) == 4 s\nA1v(t2) == 0"),
    ego=Motion(0.0, 2.0, []),
    hero=Motion(0.0, 12.0, [(4.0, 0.0), (10.0, -2.5)]),
    trigger_s=4.0,
    hero_line=CROSSING,
    duration_s=15.0,
)


@pytest.mark.parametrize(
    ("pieces", "holds"),
    [
        ([(4.0, 0.0), (10.0, -2.5)], True),
        ([(1.0, 0.0), (0.6, -2.0), (2.4, 0.0), (10.0, -2.5)], True),  # it brakes twice: the second time is meant
        ([(1.0, 0.0), (0.6, -2.0), (3.0, 0.0), (10.0, -2.5)], False),
        ([(4.6, 0.0), (10.0, -2.5)], False),
    ],
)
def test_what_is_seen_more_than_once_may_be_either(pieces: list[tuple[float, float]], holds: bool) -> None:
    assert failing(judge(CLOCK.with_hero(pieces=pieces).case())) == (set() if holds else {"hero_onset"})


# When braking begins is told, when it ends is seen from there on: what is seen first bounds nothing.
SECOND = replace(
    CLOCK,
    text=text("[t0, go, t1, go, t2, dec, t3]", "A1(t1) == 2 s\nA1(t2) - A1(t1) == 2 s\nA1a(dec) == -2"),
    trigger_s=2.0,
)


@pytest.mark.parametrize(
    ("pieces", "holds"),
    [
        ([(4.0, 0.0), (2.0, -2.0)], True),
        ([(2.5, 0.0), (0.6, -2.0), (0.9, 0.0), (2.0, -2.0)], True),
        ([(2.5, 0.0), (0.6, -2.0), (0.9, 0.0), (2.0, -1.0)], False),
        ([(2.5, 0.0), (0.6, -2.0), (1.5, 0.0), (2.0, -2.0)], False),
    ],
)
def test_what_follows_from_a_knot_does_not_bound_it(pieces: list[tuple[float, float]], holds: bool) -> None:
    assert (failing(judge(SECOND.with_hero(pieces=pieces).case())) == set()) is holds


# Whoever holds a speed of 9 m/s has it all the time, and the headway is from 1.5 to 2 s for 0.9 s: it may brake at any
# moment of those, and at no other.
RANGE = Play(
    text=text(
        "[t0, go, t1, dec, t2]",
        "A0(t1) == A1(t1)\nheadway(A0, A1, t1) >= 1.5\nheadway(A0, A1, t1) <= 2\nA1v(t1) == 9\nA1v(t2) == 0",
        heading="E",
    ),
    ego=Motion(0.0, 14.0, []),
    hero=Motion(52.5, 9.0, [(4.0, 0.0), (10.0, -2.5)]),  # the headway is 2 s at 4 s
    trigger_s=4.0,
    hero_line=AHEAD,
    duration_s=10.0,
    offset_m=0.0,
)


@pytest.mark.parametrize(("brakes_s", "holds"), [(4.0, True), (4.4, True), (4.85, True), (3.5, False), (6.2, False)])
def test_a_moment_of_a_stretch_is_where_it_was_acted_upon(brakes_s: float, holds: bool) -> None:
    verdict = judge(RANGE.with_hero(pieces=[(brakes_s, 0.0), (10.0, -2.5)]).case())
    assert (failing(verdict) == set()) is holds
    if holds:
        assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(brakes_s, abs=0.11)


# The headway falls to 1.5 s at 5.4 s, within tolerance for 0.3 s; it comes to that again at 7.7 s, for a slow ego.
AGAIN = replace(
    RANGE,
    text=text("[t0, go, t1, dec, t2]", "A0(t1) == A1(t1)\nheadway(A0, A1, t1) == 1.5\nA1v(t2) == 6", heading="E"),
    ego=Motion(0.0, 14.0, [(6.0, 0.0), (2.5, -4.0)]),
    trigger_s=5.4,
    duration_s=15.0,
)


@pytest.mark.parametrize(("brakes_s", "late"), [(5.45, False), (5.55, True)])
@pytest.mark.parametrize("ends_s", [7.0, 15.0])
def test_that_a_moment_comes_again_later_does_not_move_it(brakes_s: float, late: bool, ends_s: float) -> None:
    hero = Motion(52.5, 9.0, [(brakes_s, 0.0), (1.2, -2.5)])
    verdict = judge(replace(AGAIN, hero=hero, duration_s=ends_s).case())
    assert failing(verdict) == ({"hero_onset"} if late else set())
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(5.4, abs=0.01)
