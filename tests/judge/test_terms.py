"""Values of terms in a trace: worked out by hand, and as the evaluator of solutions has them, which shares no code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest
from plays import BRAKES, GOES_AFTER, YIELDS, YIELDS_AT_S, Play

from scenewright.judge.case import CannotJudge, Case, NotReached
from scenewright.judge.judgement import judge
from scenewright.judge.terms import Moments, divisor, mean_acceleration, piece_span, sides
from scenewright.judge.tolerance import TIGHT
from scenewright.program.evaluate import term_value
from scenewright.program.expressions import Compare, Order, PieceRef
from scenewright.program.resolve import resolve
from scenewright.program.text import parse_program
from scenewright.program.types import Program

# BRAKES: ego at 0 with 10 m/s, hero at 35 with 8 m/s; from 7.5 s on the hero brakes at 4, the ego at 2.2 m/s^2.
MOMENTS = Moments(
    {(0, "t0"): 0.0, (1, "t0"): 0.0, (0, "t1"): 7.5, (1, "t1"): 7.5, (1, "t2"): 9.5, (0, "t2"): np.inf},
    {(1, 0): (0.0, 7.5), (1, 1): (7.5, 9.5)},
)


def compared(play: Play, formula: str, moments: Moments = MOMENTS) -> tuple[Case, Compare, float, float]:
    program = resolve(parse_program(play.text + f"extra: {formula}\n"))
    found = program.constraint("extra").formula
    assert isinstance(found, Compare)
    case = play.case()
    left, right = sides(case, found, moments)
    return case, found, float(left), float(right)


@dataclass
class Motions:
    """The motions of a play themselves, as the evaluator of solutions asks for them."""

    play: Play
    case: Case
    parameters: Mapping[str, float]
    between_m: float = 4.5

    def state(self, actor: int, order: Order, time_s: float) -> float:
        motion = self.play.hero if actor else self.play.ego
        return float(motion.states(np.array([time_s]))[order][0])

    def knot_time_s(self, actor: int, knot: str) -> float:
        return float(MOMENTS.knots[actor, knot])

    def landmark_m(self, actor: int, name: str, other: int | None) -> float:
        return self.case.landmark_m(name, actor, other)

    @property
    def scene(self) -> Motions:
        return self

    @property
    def program(self) -> Program:
        return self.case.program

    def changes_s(self) -> Sequence[float]:
        return ()

    def offset_m(self, actor: int, other: int) -> float:
        return self.case.offset_m(actor, other) or 0.0


@pytest.mark.parametrize(
    ("term", "value"),
    [
        ("A1(t1)", 7.5),
        ("A1(t2) - A0(t1)", 2.0),
        ("A0x(t1)", 75.0),
        ("A1x(t1)", 95.0),
        ("A1x(t2)", 103.0),
        ("A1x(8.5)", 101.0),
        ("A1v(8.5)", 4.0),
        ("A0v(A1(t2))", 5.6),
        ("A1a(8.0)", -4.0),
        ("A1a(7.0)", 0.0),
        ("A0.stop_line - A0x(t1)", -15.0),
        ("gap(A0, A1, t1)", 20.0),
        ("gap(A1, A0, t1)", -20.0),
        ("freespace(A0, A1, t1)", 15.5),
        ("headway(A0, A1, t1)", 1.55),  # 20 m less two half cars of 2.25 m, at 10 m/s
        ("ttc(A0, A1, t1)", 7.75),  # the same, closed at 2 m/s
        ("ttc(A1, A0, t1)", 7.75),  # of the two, whoever is in front
        ("ttc(A0, A1, A1(t2))", (103.0 - 90.6 - 4.5) / 5.6),
        ("tta(A0, stop_line, 5.0)", 1.0),
        ("tta(A1, conflict_point, 8.5)", -0.25),  # past it
        ("gap_m * 2 - rate_mpss", 36.0),
        ("-A1v(t1) / 2", -4.0),
        ("A1x(t1) / A1v(t1)", 95.0 / 8.0),
    ],
)
def test_values_are_those_worked_out_and_those_of_the_other_evaluator(term: str, value: float) -> None:
    case, compare, left, _ = compared(BRAKES, f"{term} <= {term}")
    assert left == pytest.approx(value, abs=1e-3)
    assert term_value(compare.left, Motions(BRAKES, case, case.parameters)) == pytest.approx(value, abs=1e-3)


def test_places_of_two_actors_are_compared_along_one_route() -> None:
    """The hero's arc lengths count from 200 m further on: the lanes in common lie 200 m apart in them."""
    shifted = Play(**{**vars(BRAKES), "offset_m": -200.0}).with_hero(s_m=235.0)
    assert compared(shifted, "A1x(t1) == A0x(t1) + 20")[2:] == pytest.approx((295.0, 295.0), abs=1e-3)
    assert compared(shifted, "A0x(t1) == A1x(t1) - 20")[2:] == pytest.approx((75.0, 75.0), abs=1e-3)
    assert compared(shifted, "A1x(t1) == A0.stop_line")[3] == 260.0


def test_what_never_ends_is_longer_than_any_time() -> None:
    """Nobody closes in on who draws away, and who stands never arrives; who is there has arrived."""
    apart = BRAKES.with_ego(speed_mps=7.0)
    assert compared(apart, "ttc(A0, A1, 5.0) >= 3")[2] == np.inf
    assert compared(BRAKES, "headway(A1, A0, 5.0) <= 3")[2] < 0.0  # the other one is behind
    assert compared(BRAKES, "tta(A1, conflict_point, 12.0) >= 3")[2] == -np.inf  # stands beyond it
    assert compared(GOES_AFTER, "tta(A1, conflict_point, 9.0) >= 3")[2] == np.inf  # stands before it


def test_an_acceleration_at_a_knot_is_that_of_what_begins_and_at_the_last_one_of_what_ends() -> None:
    assert compared(BRAKES, "A1a(t1) == 0")[2] == pytest.approx(-4.0)
    assert compared(BRAKES, "A1a(t2) == 0")[2] == pytest.approx(-4.0)
    assert compared(BRAKES, "A1a(A0(t1)) == 0")[2] == pytest.approx(-4.0)


@pytest.mark.parametrize(
    ("pieces", "ramp_s", "rates"),
    [
        ([(7.5, 0.0), (5.0, -4.0)], 0.3, (-4.0, -4.0, -4.0)),
        ([(7.5, 0.0), (0.4, -6.0), (5.0, -3.5)], 0.3, (-13.0 / 3.0, -3.5, -4.0)),  # a third of the first part at 6
        ([(7.5, 0.0), (0.3, -6.0), (5.0, -62.0 / 17.0)], 0.3, (-62.0 / 17.0, -62.0 / 17.0, -4.0)),  # within its ramp
        ([(7.5, 0.0), (0.4, -6.0), (5.0, -3.5)], 0.7, (-4.0, -4.0, -4.0)),  # shorter than three ramps: its mean
    ],
)
def test_the_acceleration_of_a_piece_is_that_of_all_its_parts_and_its_mean(
    pieces: Sequence[tuple[float, float]], ramp_s: float, rates: tuple[float, float, float]
) -> None:
    """Those of the first and of the last part, ramps aside, and the mean."""
    manner = f"manner:\n- ramp_s = {ramp_s}\ndescription:"
    play = replace(BRAKES, text=BRAKES.text.replace("description:", manner, 1)).with_hero(pieces=pieces)
    formula = play.case().program.constraint("c4").formula
    assert isinstance(formula, Compare)
    left, _ = sides(play.case(), formula, MOMENTS)
    every = np.atleast_1d(left)
    assert (every[0], every[-2 if len(every) > 1 else 0], every[-1]) == pytest.approx(rates, abs=1e-6)


@pytest.mark.parametrize(
    ("formula", "holds"),
    [
        ("A1a(dec) <= A1v(go) / -2", True),  # -4 and 8 m/s
        ("A1a(dec) >= A1v(go) / -2.3", False),
        ("A1a(dec) == A1a(go) - 4", True),
        ("A1a(dec) == A1a(go) - 4.5", False),
        ("always[A1(t1), A1(t2)](A1a(dec) <= -3.9)", True),
    ],
)
def test_pieces_are_compared_with_each_other_all_through(formula: str, holds: bool) -> None:
    verdict = judge(replace(BRAKES, text=BRAKES.text + f"extra: {formula}\n").case())
    assert verdict.condition("extra").holds_at(TIGHT) == holds


def test_the_mean_acceleration_of_speeds() -> None:
    assert mean_acceleration(np.array([8.0, 3.0, 2.0]), 3.0) == -2.0
    assert mean_acceleration(np.array([8.0, 8.0]), 0.0) == 0.0


def test_many_instants_are_asked_for_at_once() -> None:
    times = np.array([1.0, 7.5, 8.5])
    case, compare, *_ = compared(BRAKES, "A1v(t1) == A0x(t1)")
    left, right = sides(case, compare, Moments({(1, "t1"): times, (0, "t1"): times}))
    assert np.asarray(left) == pytest.approx([8.0, 8.0, 4.0])
    assert np.asarray(right) == pytest.approx([10.0, 75.0, 85.0 - 1.1])


@pytest.mark.parametrize(
    ("formula", "reason"),
    [
        ("A0v(t2) == 3", "the ego never got so far"),
        ("A1v(A0(t2)) == 3", "the ego never got so far"),
        ("A1v(99.0) == 3", "the run ended before 99 s"),
        ("A0.route_end == 3", "the route of ego has no landmark route_end"),
        ("A1a(acc) == 3", "hero has no piece acc"),
    ],
)
def test_what_cannot_be_had_says_why(formula: str, reason: str) -> None:
    with pytest.raises(CannotJudge, match=reason):
        compared(BRAKES, formula)


def test_a_knot_that_nothing_shows_and_a_piece_that_never_came() -> None:
    with pytest.raises(CannotJudge, match="nothing in the trace says when hero's t2 was"):
        compared(BRAKES, "A1v(t2) == 3", Moments({}))
    with pytest.raises(CannotJudge, match="the hero never got so far"):
        piece_span(BRAKES.case(), Moments({}), 1, PieceRef("dec"))
    with pytest.raises(CannotJudge, match="share no lane"):
        compared(YIELDS, "gap(A0, A1, t1) == 3", Moments({(0, "t1"): YIELDS_AT_S}))
    with pytest.raises(NotReached) as caught:
        compared(BRAKES, "A0(t1) - A1x(A0(t2)) == 3")
    assert caught.value.actor_id == 0


def test_what_is_divided_by() -> None:
    case, compare, *_ = compared(BRAKES, "A0v(t1) / A1v(t1) <= 2")
    assert divisor(case, compare, MOMENTS) == pytest.approx(8.0)
    case, compare, *_ = compared(BRAKES, "A0v(t1) <= 2")
    assert divisor(case, compare, MOMENTS) is None
