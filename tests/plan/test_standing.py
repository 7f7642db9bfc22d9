"""How a run stands: when a hero is still planned, and when triggers come by what was planned before."""

from __future__ import annotations

import numpy as np
import pytest
from many_heroes import PROGRAMS
from situations import HERO, driven_on, planner_of, scene_of

from stories import YIELDS_DISTANCE, program


def test_after_its_trigger_a_plan_stays_as_it_is() -> None:
    planner = planner_of(scene_of(YIELDS_DISTANCE))
    planner.begin((0.0, 200.0, 9.0, 0.0))
    trigger_s = planner.plan.profiles[HERO].knot_times_s["t1"]
    now_s = round(trigger_s + 0.1, 2)
    driven_on(planner, 0.0, now_s)
    kept = planner.plan
    assert planner.tick(now_s).status == "frozen"
    assert planner.plan is kept
    assert planner.ego_knots_s["t1"] == trigger_s


@pytest.mark.parametrize("soon_s", [0.001, 0.01, 0.019])
def test_a_trigger_that_is_due_is_not_put_off_by_a_tick(soon_s: float) -> None:
    """What begins within the next step cannot be answered any more: solved again it could only come later."""
    planner = planner_of(scene_of(YIELDS_DISTANCE))
    planner.begin((0.0, 200.0, 9.0, 0.0))
    trigger_s = planner.plan.profiles[HERO].knot_times_s["t1"]
    driven_on(planner, 0.0, round(trigger_s - soon_s, 2))
    assert planner.tick(trigger_s - soon_s).status == "frozen"
    assert planner.plan.profiles[HERO].knot_times_s["t1"] == trigger_s


@pytest.mark.parametrize("heroes", [1, 2])
def test_triggers_of_several_move_on_by_half_a_second_a_tick_until_they_come_soon(heroes: int) -> None:
    """Where an ego stops for long, plans from far off would take long; with one hero they do not."""
    planner = planner_of(scene_of(PROGRAMS["crossing"](heroes)))
    planner.begin((0.0, 150.0, 9.0, 0.0))
    s_m, before = 150.0, {hero: planner.plan.profiles[hero].knot_times_s["t1"] for hero in range(1, heroes + 1)}
    moved = []
    for step in range(1, 101):
        time_s, speed_mps = 0.02 * step, max(0.0, 9.0 - 0.16 * step)
        s_m += 0.02 * speed_mps
        planner.observe((time_s, s_m, speed_mps, -8.0 if speed_mps else 0.0))
        if step % 5 == 0:
            planner.tick(time_s)
            now = {hero: planner.plan.profiles[hero].knot_times_s["t1"] for hero in before}
            moved += [(now[hero] - then_s, then_s - time_s) for hero, then_s in before.items()]
            before = now
    assert max(by_s for by_s, _ in moved) > (1.0 if heroes == 1 else 0.4)
    if heroes > 1:
        assert all(by_s <= 0.5 + 1e-6 for by_s, left_s in moved if left_s > 2.0)


KEPT = "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 30\nA1v(t2) == 3\nalways[A0(t0), A0(t1)] (gap(A0, A1) >= 20)\n"
SYNC = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\nA1x(t1) == conflict_point - 20\nA1v(t2) == 0\nA1v(t4) == 4\n"


@pytest.mark.parametrize("stands_s", [3, 60])
def test_how_long_it_is_to_stand_later_is_no_reason_to_come_slowly(stands_s: float) -> None:
    """A first guess that has moments as far apart as they are told to be needs no steps to draw them apart."""
    text = program("E, N", "t0, go, t1, dec, t2, stop, t3, acc, t4", SYNC + f"A1(t3) - A1(t2) == {stands_s}")
    planner = planner_of(scene_of(text))
    planner.begin((0.0, 175.0, 13.9, 0.0))
    motion = planner.plan.profiles[HERO]
    assert motion.state(motion.knot_times_s["t1"])[1] > 6.0


def test_looks_at_what_has_to_last_are_from_now_to_where_it_ends() -> None:
    planner = planner_of(scene_of(program("W", "t0, go, t1, dec, t2", KEPT)))
    planner.begin((0.0, 100.0, 9.0, 0.0))
    for now_s in (0.0, 0.4):
        if now_s:
            driven_on(planner, 0.0, now_s)
            planner.tick(now_s)
        looks_s = [planner._moments_s[look] for look in planner._asked.looks]
        assert looks_s[-1] == pytest.approx(planner.plan.profiles[HERO].knot_times_s["t1"], abs=0.05)
        assert np.all(np.diff([now_s, *looks_s], n=2) > 0.0), "the sooner, the more often"


ORDERS = {
    "t0, go, t1, dec, t2, go, t3, acc, t4": {"A0(t2) == A1(t3)\nA0x(t2) == stop_line - 10": [2]},
    "t0, go, t1, dec, t2, acc, t3": {"A0(t2) == A1(t2)\nA0x(t2) == stop_line - 10": [1], "A1v(t3) == 9": []},
    "t0, go, t1, acc, t2, go, t3": {
        "always[A1(t2), A1(t3)] (headway(A1, A0) <= 2)": [2],
        "always[A1(t1), A1(t2)] (gap(A1, A0) >= 5)": [1],
        "always[A0(t0), A1(t3)] (gap(A1, A0) >= 5)": [],
        "gap(A1, A0, A1(t3)) == 12": [2],
        "gap(A0, A1, A1(t3)) == -12": [2],
    },
    "t0, go, t1, dec, t2, go, t3": {
        "A0x(t2) == stop_line\nA1(t3) - A0(t2) == 2": [2],
        "A0x(t2) == stop_line\nA1(t3) > A0(t2)": [],  # who is first is a matter of what it does, not of waiting
        "A1(t3) - A1(t1) == 9": [],
    },
    "t0, go, t1, dec, t2, stop, t3, acc, t4": {"A1(t3) > A0(t2)": [2], "A1v(t4) == 5": []},
}
TABLE = [(sketch, line, pieces) for sketch, lines in ORDERS.items() for line, pieces in lines.items()]


@pytest.mark.parametrize(("sketch", "line", "pieces"), TABLE)
def test_after_its_trigger_a_hero_answers_the_ego_in_what_it_is_to_do_with_it(
    sketch: str, line: str, pieces: list[int]
) -> None:
    planner = planner_of(scene_of(program("W", sketch, f"A0(t1) == A1(t1)\nA0x(t1) == stop_line - 60\n{line}")))
    assert planner._reactive == {HERO: pieces}


PAST = "A1x(t2) == stop_line\nA1v(stop) == 0\nA0(t1) == A1(t1)\nA0x(t1) == stop_line - 50\nA1x(t1) == stop_line - 20\n"


@pytest.mark.parametrize("past", ["A0x(A1(t3)) == junction_end", "A0x(t2) == junction_end\nA0(t2) == A1(t3)"])
def test_who_stands_until_the_ego_is_past_waits_for_it_however_that_is_written(past: str) -> None:
    """A place of the ego at a moment of a hero's is a condition on both: it ended with a fault."""
    planner = planner_of(scene_of(program("E, N", "t0, go, t1, dec, t2, stop, t3, acc, t4", PAST + past)))
    planner.begin((0.0, 200.0, 10.0, 0.0))
    planned_s = planner.plan.profiles[HERO].knot_times_s["t3"]
    s_m = 200.0
    for step in range(1, 601):  # slower than was foreseen from the trigger on
        s_m += 0.02 * (speed_mps := 10.0 if step <= 300 else 8.0)
        planner.observe((0.02 * step, s_m, speed_mps, 0.0))
        if step % 5 == 0:
            planner.tick(0.02 * step)
    ends_m = planner.scene.landmark_m(0, "junction_end", None)
    goes_s = planner.plan.profiles[HERO].knot_times_s["t3"]
    assert goes_s == pytest.approx(12.0 + (ends_m - s_m) / 8.0, abs=0.1)
    assert goes_s > planned_s + 0.5
