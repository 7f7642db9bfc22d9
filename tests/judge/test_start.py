"""How a run begins: who is put near to another and brakes hard at once fails it, but where the program says so."""

from __future__ import annotations

import numpy as np
import pytest
from plays import Motion, actor_trace

from scenewright.judge.case import Case
from scenewright.judge.judgement import judge
from scenewright.judge.start import start_condition
from scenewright.judge.tolerance import LOOSE
from scenewright.program.starts import HARD_MPSS
from scenewright.program.text import parse_program
from scenewright.trace.model import Trace

PROGRAM = """
Actor 0 (ego):
- E
- [t0, go, t1, go, t2]

Actor 1 (lead):
- E
- [t0, {first}, t1, dec, t2]

Constraints:
A0(t1) == A1(t1)
headway(A0, A1, t1) == 1.2 s
{asked}
"""
LINE = (0.0, 0.0, 0.0)
SAVED = [(0.5, -8.0), (3.0, 0.0)]  # braking at once, then even


def hardest(
    gap_m: float, *, ego: Motion | None = None, lead_mps: float = 10.0, asked: str = "", first: str = "go"
) -> float | None:
    """Return what the condition measured with the ego `gap_m` behind, centre to centre; None where it holds."""
    time_s = np.arange(0.0, 6.0, 0.02)
    motions = {"ego": ego or Motion(0.0, 12.0, SAVED), "lead": Motion(gap_m, lead_mps, [])}
    trace = Trace({name: actor_trace(motion, time_s, LINE) for name, motion in motions.items()})
    case = Case(parse_program(PROGRAM.format(asked=asked, first=first)), {}, {}, {("ego", "lead"): 0.0}, trace)
    condition = start_condition(case)
    return None if condition.holds_at(LOOSE) else condition.measured


def test_who_begins_too_near_and_brakes_hard_fails() -> None:
    assert hardest(7.0) == 8.0


@pytest.mark.parametrize("gap_m", [60.0, -7.0])
def test_who_brakes_for_nobody_has_its_own_reasons(gap_m: float) -> None:
    assert hardest(gap_m) is None


def test_far_away_is_too_near_for_who_has_to_brake_hard_not_to_meet_it() -> None:
    """45 m before one that stands it takes 20^2 / (2 * 42.75) m/s^2, though it is more than two seconds away."""
    fast = Motion(0.0, 20.0, [(4.0, -4.7)])
    assert hardest(47.25, ego=fast, lead_mps=0.0) == pytest.approx(4.7)
    assert hardest(47.25, ego=fast, lead_mps=12.0) is None
    # 30 m before it at 13.9 m/s, 3.2 m/s^2 would do for who brakes at once, and 6 for who takes a second.
    assert hardest(34.8, ego=Motion(0.0, 13.9, [(1.0, -8.0)]), lead_mps=0.0) == 8.0


def test_who_brakes_harder_than_it_has_to_was_not_put_there() -> None:
    """27.5 m behind at 13.9 m/s against 9.1, it takes 0.5 m/s^2 not to touch; but IDM brakes with 4."""
    assert hardest(27.5, ego=Motion(0.0, 13.9, [(1.0, -4.1)]), lead_mps=9.1) is None


@pytest.mark.parametrize("rate_mpss", [0.0, HARD_MPSS])
def test_near_is_no_fault_where_nobody_has_to_brake_hard(rate_mpss: float) -> None:
    assert hardest(7.0, ego=Motion(0.0, 12.0, [(1.0, -rate_mpss)])) is None


def test_a_hero_that_is_put_behind_another_is_judged_as_the_ego_is() -> None:
    chased = Motion(0.0, 8.0, [])
    assert hardest(-7.0, ego=chased, lead_mps=8.0) is None
    time_s = np.arange(0.0, 6.0, 0.02)
    traces = {"ego": actor_trace(chased, time_s, LINE), "lead": actor_trace(Motion(-7.0, 12.0, SAVED), time_s, LINE)}
    for first, held in (("go", False), ("dec", True)):  # who is told to brake does
        text = PROGRAM.format(asked="", first=first)
        condition = start_condition(Case(parse_program(text), {}, {}, {}, Trace(traces)))
        assert condition.holds_at(LOOSE) is held
        assert condition.text.endswith("; the car 'lead' does") is not held


@pytest.mark.parametrize(
    ("asked", "is_asked_for"),
    [
        ("headway(A0, A1, t0) == 0.2 s", True),
        ("ttc(A0, A1, t0) == 1.2 s", True),
        ("tta(A0, stop_line, t0) == 5 s\ntta(A1, stop_line, t0) == 4 s", True),
        ("tta(A0, stop_line, t0) == 5 s", False),
        ("gap(A0, A1, t0) == 7 m\nA0v(t0) == 12", True),
        ("A0x(t0) == 0\nA1x(t0) == 7\nA0v(t0) == 12", True),
        ("gap(A0, A1, t0) == 7 m", False),  # an ego that began more slowly would do
        ("A0v(t0) == 12", False),
        ("headway(A0, A1, t0) >= 0.2 s", False),
    ],
)
def test_what_the_program_says_of_the_start_is_no_fault(asked: str, is_asked_for: bool) -> None:
    assert (hardest(7.0, asked=asked) is None) is is_asked_for


def fallen(ego: Motion, asked: str = "", said: str = "ttc(A0, A1, t1) == 2.5 s") -> tuple[float, bool] | None:
    """Return the least time to collision before the trigger and whether that holds, behind one at an even 8 m/s."""
    time_s = np.arange(0.0, 12.0, 0.02)
    motions = {"ego": ego, "lead": Motion(40.0, 8.0, [])}
    trace = Trace({name: actor_trace(motion, time_s, LINE) for name, motion in motions.items()})
    text = PROGRAM.format(asked=asked, first="go").replace("headway(A0, A1, t1) == 1.2 s", said)
    verdict = judge(Case(parse_program(text), {}, {}, {("ego", "lead"): 0.0}, trace))
    found = [each for each in verdict.conditions if each.id.endswith("_falls")]
    return (found[0].measured, found[0].holds_at(LOOSE)) if found and found[0].measured is not None else None


def test_a_time_to_collision_is_met_as_it_falls() -> None:
    """35.5 m behind at 12 m/s it is 8.9 s, and 2.5 s after 6.4 s."""
    assert fallen(Motion(0.0, 12.0, [])) == (pytest.approx(2.5), True)
    assert fallen(Motion(0.0, 12.0, []), said="ttc(A0, A1, A1(t1)) == 2.5 s") == (pytest.approx(2.5), True)


def test_one_of_two_that_share_no_lane_is_not_judged_twice() -> None:
    time_s = np.arange(0.0, 12.0, 0.02)
    motions = {"ego": Motion(0.0, 12.0, []), "lead": Motion(40.0, 8.0, [])}
    trace = Trace({name: actor_trace(motion, time_s, LINE) for name, motion in motions.items()})
    text = PROGRAM.format(asked="A0x(t1) == 20", first="go").replace("headway", "ttc")
    verdict = judge(Case(parse_program(text), {}, {}, {("ego", "lead"): None}, trace))
    assert not [each for each in verdict.conditions if each.id.endswith("_falls")]
    assert [each.id for each in verdict.conditions if "share no lane" in each.text]


def test_one_that_is_met_as_it_grows_had_been_shorter() -> None:
    """6.5 m behind at 12 m/s it is 1.6 s and gets to be 1.25 s; the ego eases off at 1.5 m/s^2, and it is 2.5 s."""
    eases = Motion(29.0, 12.0, [(2.5, -1.5)])
    assert fallen(eases) == (pytest.approx(1.25, abs=0.02), False)
    assert fallen(eases, asked="ttc(A0, A1, t0) == 1.625 s") is None, "so it begins because it is said to"


def test_what_names_no_time_to_collision_to_be_met_has_no_direction() -> None:
    assert fallen(Motion(29.0, 12.0, [(2.5, -1.5)]), said="headway(A0, A1, t1) == 0.7 s") is None
    assert fallen(Motion(29.0, 12.0, [(2.5, -1.5)]), said="ttc(A0, A1, t1) <= 2.5 s") is None
