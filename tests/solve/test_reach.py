"""What arithmetic denies no motion does: it must never keep the solver from a plan that there is."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenarios import YIELDS, limits_of, read_structure
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import Request, orchestrate
from scenewright.program.types import PieceKind
from scenewright.solve.arrival import LinearCondition, linear_conditions
from scenewright.solve.limits import COUNTER, FIRM, GENTLE, URGENT, WHOLE, Style
from scenewright.solve.reach import Approach, Prospects, Task, least_miss
from scenewright.solve.situation import HeroState, Situation
from scenewright.solve.stretches import approach_rates, timed_approach

HERO = 1
TIMED = LinearCondition("c", frozenset({(HERO, "t1")}), -60.0, {HERO: (1.0, 2.0)})  # 2 s from a place at 60 m
PLACED = LinearCondition("c", frozenset({(HERO, "t1")}), -40.0, {HERO: (1.0, 0.0)})
stretches = st.lists(st.tuples(st.floats(0.1, 2.0), st.floats(0.0, 4.0), st.floats(0.0, 6.0)), min_size=1, max_size=5)


def yielding() -> tuple[Prospects, LinearCondition]:
    """Return the prospects of a hero that is to yield, and its side of the trigger."""
    scene = YIELDS.scene()
    structure = read_structure(scene.program)
    conditions = linear_conditions(scene, structure)
    side = next(c for c in conditions if set(c.weights) == {HERO} and (HERO, "t1") in c.moments)
    return Prospects(scene, structure, limits_of(scene), conditions), side


@given(
    ways=stretches,
    shares=st.lists(st.floats(0.0, 1.0), min_size=5, max_size=5),
    s_m=st.floats(0.0, 60.0),
    speed=st.floats(0.0, 12.0),
    side=st.sampled_from([TIMED, PLACED]),
)
def test_no_motion_comes_nearer_than_arithmetic_says(
    ways: list[tuple[float, float, float]], shares: list[float], s_m: float, speed: float, side: LinearCondition
) -> None:
    moves: list[tuple[float, float, int]] = []
    now = speed
    for (duration, up, down), share in zip(ways, shares, strict=False):
        accel = max(-down + share * (up + down), -now / duration)  # one acceleration all through a stretch
        moves.append((duration, accel, 0))
        now += accel * duration
    motion = Profile(chain(0.0, s_m, speed, moves))
    place, end_speed, _ = motion.state(sum(duration for duration, _, _ in ways))
    approach = Approach(tuple(ways), top_mps=60.0, least_mps=0.0)
    tight = 0.1 * max(end_speed, 0.05) if side is TIMED else 0.5
    miss = abs(side.value({HERO: (place, end_speed)})) / tight
    least = least_miss(side, HERO, approach, s_m, speed)
    # A miss in time depends on the speed there: the bound is zero or not, its size is a guide.
    assert least == 0.0 or miss > 0.0
    if side is PLACED:
        assert miss >= least - 1e-6


def test_who_hurries_and_who_holds_back_bound_the_place() -> None:
    approach = Approach(((1.0, 2.0, 3.0), (1.0, 0.25, 0.25)), top_mps=10.0, least_mps=1.0)
    assert approach.fastest(0.0, 6.0) == pytest.approx((7.0 + 8.125, 8.25))
    assert approach.slowest(0.0, 6.0) == pytest.approx((4.5 + 2.875, 2.75))
    assert approach.within(1.0, 1.0).fastest(0.0, 6.0) == pytest.approx((6.5 + 7.125, 7.25))


@pytest.mark.parametrize("style", [FIRM, WHOLE, COUNTER], ids=["firm", "whole", "counter"])
@pytest.mark.parametrize("rest_s", [Fraction(1, 10), Fraction(1, 2), Fraction(3, 5), Fraction(3)])
def test_the_last_half_second_is_settled_however_little_is_left(style: Style, rest_s: Fraction) -> None:
    left = rest_s
    for stretch in timed_approach(style, 0, rest_s, "t1"):
        up, down = approach_rates(style, stretch, PieceKind.DEC)
        left -= stretch.duration_s or 0
        if left < Fraction(1, 2) and stretch.end_knot:
            assert down <= Fraction(1, 4)
            assert up <= Fraction(9, 20) or style is COUNTER
    assert left == 0


@given(rest_s=st.fractions(Fraction(1), Fraction(30)), speed_mps=st.floats(0.0, 18.0))
def test_who_has_to_stop_can_do_it_within_the_first_step(rest_s: Fraction, speed_mps: float) -> None:
    way = timed_approach(WHOLE, 0, rest_s, "t1", speed_mps)
    assert sum(stretch.duration_s or 0 for stretch in way) == rest_s
    assert all(stretch.duration_s for stretch in way)
    if 2.0 < speed_mps < 11.0 and rest_s > 9:
        assert float(way[0].duration_s or 0) == pytest.approx(speed_mps / WHOLE.approach_brake_mpss, abs=1e-4)


def test_who_has_long_to_go_a_short_way_stands_and_waits() -> None:
    prospects, side = yielding()
    place = -(side.constant + side.weights[HERO][1] * 5.0) / side.weights[HERO][0]
    ego = Profile(chain(0.0, 0.0, 1.0, [(60.0, 0.0, 0)]))
    for ahead_m, trigger_s, waits in ((14.0, 12.0, True), (40.0, 6.0, False)):
        state = HeroState(0.0, place - ahead_m, 5.0, 0, {"t0": 0.0}, ego)
        situation = Situation(0.0, ego, {"t0": 0.0}, {HERO: state}, {HERO: trigger_s})
        found = prospects.waiting(situation, COUNTER)
        assert (found is not None) == waits
        assert prospects.waiting(situation, GENTLE) is None
        if found is not None:
            approach = timed_approach(found, 0, Fraction(12), "t1")
            standing = [k for k, stretch in enumerate(approach) if stretch.waiting]
            assert standing == [standing[0], standing[0] + 1]  # to a stand, and standing there
            assert standing[-1] < len(approach) - 1
            assert sum(stretch.duration_s or 0 for stretch in approach) == 12
            where = approach[standing[0]].place_m
            assert where is not None
            assert place - 14.0 < where[0] < where[1] < place


def test_takes_no_more_authority_than_it_needs() -> None:
    prospects, side = yielding()
    place = -(side.constant + side.weights[HERO][1] * 8.0) / side.weights[HERO][0]
    ego = Profile(chain(0.0, 0.0, 8.0, [(60.0, 0.0, 0)]))
    state = HeroState(0.0, place - 34.0, 8.0, 0, {"t0": 0.0}, ego)  # 2 m behind where it should be
    situation = Situation(0.0, ego, {"t0": 0.0}, {HERO: state}, {HERO: 4.5})
    gentled = prospects.gentled(situation, URGENT, 0.0)
    assert gentled.approach_accel_mpss < 0.5 * URGENT.approach_accel_mpss
    assert prospects.least_miss(situation, gentled) == 0.0


@pytest.mark.parametrize(
    ("away_s", "stops_m"), [(0.0, 3.0), (0.0, 8.0), (0.0, 40.0), (2.0, 3.0), (2.0, 8.0), (4.0, 3.0), (4.0, 20.0)]
)
def test_least_speed_is_the_slowest_from_which_it_stops_in_place(away_s: float, stops_m: float) -> None:
    side = LinearCondition("c", frozenset({(HERO, "t1")}), -60.0, {HERO: (1.0, away_s)})
    stop_m = 60.0 - stops_m if away_s else 60.0 + stops_m
    gentlest, hardest, shortest_s = 0.6, 8.0, 0.35
    task = Task(side, HERO, 0, "t1", PieceKind.DEC, stop_m)
    least = task.least_mps((gentlest, hardest), shortest_s, 0.0)

    def stops(speed_mps: float) -> bool:
        rest_m = stop_m - (60.0 - away_s * speed_mps)
        if rest_m <= 0.0:
            return False
        rate = speed_mps * speed_mps / (2.0 * rest_m)
        return gentlest <= rate <= hardest and 2.0 * rest_m / speed_mps >= shortest_s

    speeds = [0.01 * k for k in range(1, 4000)]
    assert least == pytest.approx(next(speed for speed in speeds if stops(speed)), abs=0.011)


def test_waits_where_it_can_still_be_fast_enough() -> None:
    prospects, side = yielding()
    ego = Profile(chain(0.0, 0.0, 1.0, [(60.0, 0.0, 0)]))
    place = -side.constant / side.weights[HERO][0]
    state = HeroState(0.0, place - 30.0, 5.0, 0, {"t0": 0.0}, ego)
    situation = Situation(0.0, ego, {"t0": 0.0}, {HERO: state}, {HERO: 25.0})
    found = prospects.waiting(situation, COUNTER)
    assert found is not None
    assert found.wait is not None
    # From a stand there it can be at its side within the time, and no faster than its limits let it be.
    per_metre, per_speed = side.weights[HERO]
    speeds = [0.05 * k for k in range(1, 200)]
    reached = [v for v in speeds if found.wait.place_m + v * v / 8.0 <= -(side.constant + per_speed * v) / per_metre]
    assert reached
    assert max(reached) >= 1.0


@pytest.mark.parametrize(
    ("first", "at_the_trigger", "sketch"),
    [
        ("gap(A0, A1, t0) == 20", "A1v(t1) == 8", "t0, go, t1, go, t2"),
        ("A0x(t0) == stop_line - 150", "headway(A0, A1, t1) == 1.5 and A1v(t1) == 8", "t0, go, t1, dec, t2"),
    ],
)
def test_a_side_that_is_a_speed_and_no_place_is_planned_for(first: str, at_the_trigger: str, sketch: str) -> None:
    """A hero that is only to be so fast at its trigger has no place to wait at."""
    head = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- W\n"
    text = (
        f"{head}- [{sketch}]\n\nConstraints:\n{first}\nA0(t1) == A1(t1)\nA0x(t1) == stop_line - 60\n{at_the_trigger}\n"
    )
    result = orchestrate(Request(text, ego="idm", takes=1))
    assert result.run is not None
    assert result.run.status == "finished"
