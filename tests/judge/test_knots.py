"""Moments are found where they were, between samples, and of several the one that was acted upon."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plays import (
    AHEAD,
    BRAKES,
    CROSSING,
    GOES_AFTER,
    NOT_YIELDING,
    YIELDS,
    Line,
    Motion,
    Play,
    actor_trace,
    failed,
    text,
)

from scenewright.judge.case import Case
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.program.text import parse_program
from scenewright.trace.model import Trace


@pytest.mark.parametrize(("least_s", "met"), [(3.0, True), (3.0 + 1e-6, True), (3.3, True), (4.0, False)])
def test_a_time_that_falls_no_further_was_met_where_it_was_least(least_s: float, met: bool) -> None:
    """Who begins to brake has the least time to its place just then: whether that is reached is no matter of digits."""
    begins_s, mps = 4.0, 10.0
    told = "A0x(t1) == stop_line - 18\nA1v(t1) == 10\ntta(A1, stop_line, t1) == 3\nA1v(t2) == 0"
    hero = Motion(90.0 - mps * (least_s + begins_s), mps, [(begins_s, 0.0), (9.0, -5.0)])
    play = replace(YIELDS, text=text("[t0, go, t1, dec, t2]", told), hero=hero)
    found = judge(play.case())
    if met:
        assert found.facts["knot_times_s"]["hero"]["t1"] == pytest.approx(begins_s, abs=1e-3)
    assert found.condition("c3").holds_at(LOOSE) is met
    assert found.condition("c3").holds_at(TIGHT) is (least_s < 3.1)


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


def test_trigger_by_inequalities_is_the_first_instant_at_which_they_hold() -> None:
    play = replace(
        NOT_YIELDING, text=NOT_YIELDING.text.replace("A0x(t1) == stop_line - 18", "A0x(t1) >= stop_line - 18")
    )
    play = replace(play, text=play.text.replace("A1x(t1) == conflict", "A1x(t1) >= conflict"))
    assert judge(play.case()).facts["trigger_time_s"]["hero"] == pytest.approx(play.trigger_s, abs=1e-3)


def test_of_several_good_instants_the_one_acted_upon_is_the_trigger() -> None:
    # The gap of 20 m comes twice: the hero draws away, then the ego catches up. The hero acts at the second time.
    ego = Motion(0.0, 6.0, [(4.0, 0.0), (4.0, 1.5), (20.0, 0.0)])
    hero = Motion(14.0003, 8.0, [(9.875, 0.0), (5.0, -4.0)])
    play = replace(BRAKES, ego=ego, hero=hero, trigger_s=9.875)
    times = np.arange(0, 12, 0.001)
    gap = hero.states(times)[0] - ego.states(times)[0]
    assert np.count_nonzero(np.diff(np.sign(gap - 20.0))) == 2
    second = float(times[np.flatnonzero(np.diff(np.sign(gap - 20.0)))[1]])
    acted = play.with_hero(pieces=[(second, 0.0), (5.0, -4.0)])
    verdict = judge(acted.case())
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(second, abs=2e-3)
    assert verdict.condition("hero_onset").holds_at(TIGHT)


def test_hesitate_and_go_of_the_paper() -> None:
    program = text(
        "[t0, dec, t1, stop, t2, acc, t3]",
        "A0v(t0) == 8\nA1v(t0) == 12\nA1a(dec) == -3\nA1v(t1) == 0\nA1x(t1) == turn - 20\nA1v(stop) == 0\n"
        "A1a(stop) == 0\nA0x(t1) == turn\nA0(t1) == A1(t1)\nA1(t2) > A0(t1)\nA1v(t3) == 12",
    )
    play = Play(
        text=program,
        ego=Motion(70.0 - 32.0, 8.0, []),
        hero=Motion(80.0 - 24.0, 12.0, [(4.0, -3.0), (2.0, 0.0), (6.0, 2.0)]),
        trigger_s=4.0,
        hero_line=(500.0, 0.0, 0.0),
    )
    verdict = judge(play.case())
    assert verdict.holds_at(TIGHT), [c for c in verdict.conditions if not c.holds_at(TIGHT)]
    assert verdict.facts["knot_times_s"]["hero"] == pytest.approx(
        {"t0": 0.0, "t1": 4.0, "t2": 6.0, "t3": 12.0}, abs=0.02
    )
    spoiled = judge(play.with_hero(pieces=[(4.0, -3.0), (2.0, 0.0), (4.0, 2.0)]).case())
    assert {c.id for c in spoiled.conditions if not c.holds_at(LOOSE)} == {"c11"}


def test_turn_as_the_interaction_itself() -> None:
    program = text(
        "[t0, go, t1, dec, t2]",
        "A0v(t0) == 10\nA1v(t0) == 8\ngap(A0, A1, t1) == 20\nA1x(t1) == turn\nA1v(t2) == 0\nA0(t1) == A1(t1)",
        heading="E",
    )
    play = replace(BRAKES, text=program).with_hero(s_m=40.0).with_ego(s_m=5.0)
    verdict = judge(play.case())
    assert verdict.holds_at(TIGHT), [c for c in verdict.conditions if not c.holds_at(TIGHT)]
    late = judge(play.with_ego(s_m=13.0).case())
    assert {c.id for c in late.conditions if not c.holds_at(LOOSE)} >= {"c3", "c4"}


SCENE_OF_THREE = """
Actor 0 (ego):
- E
- [t0, go, t1, go, t2, go, t3]

Actor 1 (first):
- S
- [t0, go, t1, dec, t2]

Actor 2 (second):
- N
- [t0, go, t1, acc, t2]

Constraints:
A0(t1) == A1(t1)
A0x(t1) == stop_line - 18
A1x(t1) == conflict_point - 40
A1v(t2) == 0
A0(t2) == A2(t1)
A0x(t2) == stop_line
A2x(t1) == conflict_point(A0) - 30
A2x(t2) == A2.conflict_point(A0)
A0x(t3) == A0.conflict_point(A2)
A2(t2) < A0(t3)
"""


def three(second: Motion) -> Verdict:
    time_s = np.arange(0.0, 14.0, 0.02)
    motions = {"ego": Motion(42.0 - 24.0, 8.0, []), "first": Motion(60.0 - 36.0, 12.0, [(3.0, 0.0), (9.0, -4.0)])}
    lines = {"ego": (0.0, 0.0, 0.0), "first": (500.0, 0.0, -np.pi / 2), "second": (900.0, 0.0, np.pi / 2)}
    traces = {name: actor_trace(m, time_s, lines[name]) for name, m in {**motions, "second": second}.items()}
    landmarks = {
        "ego": {"stop_line": 60.0, "conflict_point(first)": 70.0, "conflict_point(second)": 90.0},
        "first": {"conflict_point": 100.0},
        "second": {"conflict_point": 120.0},
    }
    program = parse_program(SCENE_OF_THREE.replace("conflict_point(A0) - 30", "A2.conflict_point(A0) - 30"))
    return judge(Case(program, {}, landmarks, {}, Trace(traces), paths={n: Line(*line) for n, line in lines.items()}))


def test_two_heroes_have_a_trigger_each() -> None:
    # The ego is 18 m short of its line at 3 s and on it at 5.25 s.
    good = three(Motion(90.0 - 52.5, 10.0, [(5.25, 0.0), (2.0, 1.0)]))
    assert good.holds_at(TIGHT), [c for c in good.conditions if not c.holds_at(TIGHT)]
    assert good.facts["trigger_time_s"] == pytest.approx({"first": 3.0, "second": 5.25}, abs=1e-3)
    late = three(Motion(90.0 - 52.5, 10.0, [(6.25, 0.0), (2.0, 1.0)]))
    assert {c.id for c in late.conditions if not c.holds_at(LOOSE)} == {"second_onset"}
    after = three(Motion(90.0 - 52.5, 4.0, [(5.25, 0.0), (2.0, 1.0)]))
    assert "c10" in {c.id for c in after.conditions if not c.holds_at(LOOSE)}


def test_two_pieces_of_one_kind_in_a_row_give_way_where_what_they_say_changes() -> None:
    said = (
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 20\nA1x(t1) == conflict_point - 50\nA1a(dec1) == -1\nA1a(dec2) == -3"
    )
    timed = "\nA1(t2) == A1(t1) + 2\nA1(t3) == A1(t2) + 1"
    play = Play(
        text=text("[t0, go, t1, dec, t2, dec, t3]", said + timed),
        ego=Motion(10.0, 10.0, []),
        hero=Motion(20.0, 10.0, [(3.0, 0.0), (2.0, -1.0), (1.0, -3.0)]),
        trigger_s=3.0,
        hero_line=(500.0, 0.0, 0.0),
    )
    for each in (play, replace(play, text=text("[t0, go, t1, dec, t2, dec, t3]", said))):
        verdict = judge(each.case())
        assert failed(verdict, TIGHT) == set()
        assert verdict.facts["knot_times_s"]["hero"]["t2"] == pytest.approx(5.0, abs=0.3)
        early = judge(each.with_hero(pieces=[(3.0, 0.0), (0.8, -1.0), (2.2, -3.0)]).case())
        assert bool(failed(early, LOOSE)) == (timed in each.text), (
            "when the second begins is asked only where it is told"
        )
        even = judge(each.with_hero(pieces=[(3.0, 0.0), (3.0, -2.0)]).case())
        assert {"c4", "c5"} & failed(even, TIGHT)


ENDS_BY_GAP = Play(
    text=text(
        "[t0, go, t1, acc, t2]",
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 10\nA1v(t0) == 8\nA0(t2) == A1(t2)\ngap(A0, A1, t2) == 25",
        heading="E",
    ),
    ego=Motion(0.0, 10.0, []),
    hero=Motion(30.0, 8.0, [(5.0, 0.0), (4.0, 2.0)]),
    trigger_s=5.0,
    hero_line=AHEAD,
    offset_m=0.0,
)


def test_a_moment_is_looked_for_after_those_that_come_before_it() -> None:
    # The gap is 25 m at 2.5 s, before the hero speeds up, and again at about 8.4 s.
    verdict = judge(ENDS_BY_GAP.case())
    assert failed(verdict, TIGHT) == set()
    assert verdict.facts["knot_times_s"]["hero"]["t2"] == pytest.approx(6.0 + 6.0**0.5, abs=1e-3)
    only_before = judge(ENDS_BY_GAP.with_hero(pieces=[(5.0, 0.0), (0.9, 2.0)]).case())
    assert "c5" in failed(only_before, LOOSE)


def test_what_a_sketch_has_later_may_not_have_come_before() -> None:
    said = "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 10\nA1x(t1) == conflict_point - 40\nA0x(t2) == stop_line - 30"
    play = Play(
        text=text("[t0, go, t1, dec, t2]", said),
        ego=Motion(0.0, 10.0, []),
        hero=Motion(10.0, 10.0, [(5.0, 0.0), (4.0, -2.0)]),
        trigger_s=5.0,
        hero_line=CROSSING,
    )
    verdict = judge(play.case())
    assert failed(verdict, LOOSE) == {"order_of_moments"}
    assert verdict.condition("order_of_moments").measured == pytest.approx(2.0, abs=1e-6)


@pytest.mark.parametrize("swapped", [False, True])
def test_a_place_of_its_own_tells_a_moment_before_how_far_another_is(swapped: bool) -> None:
    """The gap is never so small: in whatever order the two lines are, the hero was where it was."""
    lines = ["gap(A0, A1, A1(t2)) == 5", "A1x(t2) == conflict_point - 30"]
    play = replace(
        ENDS_BY_GAP,
        text=text(
            "[t0, go, t1, acc, t2]",
            "\n".join(["A0(t1) == A1(t1)", "gap(A0, A1, t1) == 20", *(reversed(lines) if swapped else lines)]),
            heading="E",
        ),
    )
    verdict = judge(play.case())
    assert failed(verdict, LOOSE) == {"c3" if not swapped else "c4"}
    assert verdict.facts["knot_times_s"]["hero"]["t2"] == pytest.approx(5.0, abs=0.05)


@pytest.mark.parametrize(
    ("after", "pieces", "holds"),
    [
        ("go", [(20.0, 0.0)], True),
        ("stop", [(20.0, 0.0)], False),  # it does not begin to stand
        ("stop", [(2.0, 0.0), (2.0, 2.0), (2.5, -1.6)], True),
        ("stop", [(2.0, 0.0), (2.0, 2.0), (2.0, -2.0)], False),
    ],
)
def test_who_waits_before_may_be_told_to_stand(after: str, pieces: list[tuple[float, float]], holds: bool) -> None:
    """The ego is 10 m before its line at 5 s; 1.5 s after that the hero stands, or begins to."""
    said = "A0x(t1) == stop_line - 10\nA1(t1) - A0(t1) == 1.5\nA1v(t1) == 0"
    play = Play(
        text=text(f"[t0, go, t1, {after}, t2]", said),
        ego=Motion(0.0, 10.0, []),
        hero=Motion(20.0, 0.0, pieces),
        trigger_s=6.5,
        hero_line=CROSSING,
    )
    verdict = judge(play.case())
    assert ("c2" not in failed(verdict, LOOSE)) == holds
    assert "c3" not in failed(verdict, TIGHT)


def test_a_speed_that_is_not_quite_met_is_not_looked_for_in_a_later_piece() -> None:
    """It brakes to 3.01 m/s, speeds up to 8 m/s and brakes to a stand: 3 m/s are had only while it brakes then."""
    said = (
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 20\nA1x(t1) == conflict_point - 50\nA1v(t2) == 3\nA1v(t3) == 8\n"
        "A1v(t4) == 0"
    )
    play = Play(
        text=text("[t0, go, t1, dec, t2, acc, t3, dec, t4]", said),
        ego=Motion(10.0, 10.0, []),
        hero=Motion(20.0, 10.0, [(3.0, 0.0), (2.33, -3.0), (2.5, 2.0), (4.0, -2.0)]),
        trigger_s=3.0,
        hero_line=CROSSING,
    )
    verdict = judge(play.case())
    assert failed(verdict, TIGHT) == set()
    assert verdict.facts["knot_times_s"]["hero"]["t2"] == pytest.approx(5.33, abs=0.03)


@pytest.mark.parametrize(("before_m", "holds"), [(11.8, True), (12.2, True), (12.8, False)])
def test_who_stands_from_a_place_on_may_stop_a_little_before_or_behind_it(before_m: float, holds: bool) -> None:
    """The moment is when it has come to stand, whether or not the program says besides that its speed is zero then."""
    told = GOES_AFTER.text.replace("A1x(t2) == conflict_point - 12", f"A1x(t2) == conflict_point - {before_m}")
    for said in (told, told.replace("A1v(t2) == 0\nA1v(stop) == 0\n", "")):
        verdict = judge(replace(GOES_AFTER, text=said).case())
        assert failed(verdict, TIGHT) == (set() if holds else {"c4"})


@pytest.mark.parametrize("tie", ["A0(t0) == A1(t0)", "A1(t0) == A0(t0)\nA0v(t0) == 8"])
def test_what_is_one_moment_with_the_start_is_the_start(tie: str) -> None:
    """All begin together, so to say so moves nothing: the ego comes to be 40 m from there only later."""
    told = re.sub(r"A0x\(t0\) == .*", f"A0x(t0) == intersection - 40\n{tie}", YIELDS.text)
    verdict = judge(replace(YIELDS, text=told).case())
    assert failed(verdict, TIGHT) == {"c1"}
    assert verdict.facts["knot_times_s"]["ego"]["t0"] == verdict.facts["knot_times_s"]["hero"]["t0"] == 0.0
