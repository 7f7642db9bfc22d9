"""What a sketch asks of its hero; each number of the manner, and no other, says what its word means."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from plays import BRAKES, CROSSING, GOES_AFTER, YIELDS, Motion, Play, failed, text

from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.program.manner import NUMBERS


def judged(play: Play, *numbers: str) -> Verdict:
    manner = "".join(f"- {number}\n" for number in numbers)
    return judge(replace(play, text=play.text.replace("description:", f"manner:\n{manner}description:", 1)).case())


def braking(*pieces: tuple[float, float]) -> Play:
    return BRAKES.with_hero(pieces=pieces)


# The trigger is at 7.5 s. What the hero does around it, which condition changes, and the number that changes it from
# failed to held or back.
TOUCHES = GOES_AFTER.with_hero(pieces=[*GOES_AFTER.hero.pieces[:2], (0.5, 0.0), (4.0, 2.0)])
CLOSE = replace(BRAKES, parameters={"gap_m": 8.0, "rate_mpss": 4.0}).with_hero(s_m=23.0)
CASES: dict[str, tuple[Play, str, bool, str]] = {
    "stands half a second": (TOUCHES, "hero_standstill", True, "stands_s = 1"),
    "rolls on at 0.2 m/s": (
        BRAKES.with_hero(pieces=[(7.5, 0.0), (1.95, -4.0)]), "hero_standstill", False, "stands_mps = 0.3",
    ),
    "brakes at 2 m/s^2 for a moment before": (
        braking((7.0, 0.0), (0.2, -2.0), (0.3, 0.0), (5.0, -4.0)), "hero_settled", False, "settled_mpss = 2.5",
    ),
    "has let go again 0.3 s before": (
        braking((7.0, 0.0), (0.2, -2.0), (0.3, 0.0), (5.0, -4.0)), "hero_settled", False, "settled_s = 0.25",
    ),
    "brakes at 0.7 m/s^2 before": (
        braking((6.9, 0.0), (0.6, -0.7), (5.0, -4.0)), "hero_onset", False, "begins_mpss = 1",
    ),
    "brakes for 0.2 s, then lasting": (
        braking((7.5, 0.0), (0.2, -4.0), (0.5, 0.0), (5.0, -4.0)), "hero_onset", False, "begins_s = 0.15",
    ),
    "rolls out at 0.15 m/s^2, then brakes at 0.25": (
        braking((6.5, 0.0), (1.0, -0.15), (30.0, -0.25)), "hero_onset", False, "faint_mpss = 0.2",
    ),
    "brakes harder at first than later": (
        braking((7.5, 0.0), (0.4, -6.0), (5.0, -3.5)), "c4", False, "ramp_s = 0.7",
    ),
    "comes within 3.5 m before": (CLOSE, "no_collision", True, "clear_m = 3.6"),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_number_of_the_manner_changes_the_verdict(case: str) -> None:
    play, condition, usually, number = CASES[case]
    before, after = judged(play).condition(condition), judged(play, number).condition(condition)
    assert before.holds_at(TIGHT) is usually
    assert after.holds_at(TIGHT) is not usually


def test_every_number_changes_some_verdict() -> None:
    assert {number.partition(" ")[0] for *_, number in CASES.values()} == set(NUMBERS)


@pytest.mark.parametrize(
    ("play", "condition", "numbers"),
    [
        (BRAKES, "hero_onset", ["begins_mpss = 0.75", "begins_s = 0.45"]),
        (BRAKES, "hero_settled", ["settled_s = 0.75", "settled_mpss = 1.25"]),
        (TOUCHES, "hero_standstill", ["stands_s = 0.4", "stands_mps = 0.25"]),
        (GOES_AFTER, "hero_goes_again", ["stands_mps = 0.25"]),
        (BRAKES, "c4", ["ramp_s = 0.45"]),
        (CLOSE, "no_collision", ["clear_m = 1.25"]),
    ],
)
def test_a_condition_names_the_numbers_that_it_was_judged_by(
    play: Play, condition: str, numbers: Sequence[str]
) -> None:
    text = judged(play, *numbers).condition(condition).text
    assert {number.split(" = ")[1] for number in numbers} <= set(re.findall(r"\d+(?:\.\d+)?", text))


def test_what_the_run_was_too_short_to_show_is_not_shown() -> None:
    """The gap of 20 m comes 0.3 s after the start: that the hero was settled for half a second before nobody saw."""
    soon = BRAKES.with_hero(s_m=20.6, pieces=[(0.3, 0.0), (5.0, -4.0)])
    settled = judged(soon).condition("hero_settled")
    assert (settled.holds_at(TIGHT), settled.holds_at(LOOSE)) == (False, True)
    assert "0.20 s are not seen" in settled.text
    assert judged(soon, "settled_s = 0.3").condition("hero_settled").holds_at(TIGHT)


@pytest.mark.parametrize("last", ["stop", "dec"])
def test_one_that_is_to_stand_on_does_not_have_to_move_off(last: str) -> None:
    sketch = f"[t0, go, t1, dec, t2, stop, t3, {last}, t4]"
    stands = replace(YIELDS, text=YIELDS.text.replace("[t0, go, t1, dec, t2]", sketch))
    assert failed(judge(stands.case()), TIGHT) == set()
    goes = replace(YIELDS, text=YIELDS.text.replace("[t0, go, t1, dec, t2]", sketch.replace(last + ", t4", "go, t4")))
    assert "hero_goes_again" in failed(judge(goes.case()), TIGHT)


# The ego is 10 m before its line at 5 s; the hero is 40 m before its point then, and brakes at 3 m/s^2.
SAID = "A0(t1) == A1(t2)\nA0x(t1) == stop_line - 10\nA1x(t2) == conflict_point - 40"
AT_5_S = "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 10"


def before(kind: str, speed_mps: float, *pieces: tuple[float, float]) -> set[str]:
    """Return what does not hold of somebody who was to do something all the 5 s before its trigger."""
    way_m = Motion(0.0, speed_mps, pieces).states(np.array([5.0]))[0][0]
    hero = Motion(60.0 - way_m, speed_mps, [*pieces, (9.0, -3.0)])
    said = SAID.replace("t2", "t1")
    play = Play(text(f"[t0, {kind}, t1, dec, t2]", said), Motion(0.0, 10.0, []), hero, 5.0, CROSSING)
    return failed(judge(play.case()), LOOSE)


def test_what_is_done_before_a_trigger_is_judged_too() -> None:
    even, faster, slower = ((5.0, 0.0),), ((4.4, 1.0), (0.6, 0.0)), ((4.4, -1.0), (0.6, 0.0))
    assert before("go", 10.0, *even) == set()
    assert before("acc", 8.0, *faster) == set()
    assert "hero_acc_onset" in before("acc", 10.0, *even)
    assert "hero_acc_onset" in before("acc", 8.0, (3.0, 0.0), (1.4, 2.0), (0.6, 0.0))  # for three of the five seconds
    assert "hero_acc" in before("acc", 14.0, *slower)
    assert "hero_dec1" in before("dec", 8.0, *faster)
    assert "hero_stop" in before("stop", 10.0, *even)


@pytest.mark.parametrize(("pieces", "missed"), [([(5.0, 0.0), (3.0, 2.0)], False), ([(7.0, 0.0), (3.0, 2.0)], True)])
def test_who_is_to_set_off_at_its_trigger_does_so_then(pieces: list[tuple[float, float]], missed: bool) -> None:
    play = Play(text("[t0, stop, t1, go, t2]", AT_5_S), Motion(0.0, 10.0, []), Motion(60.0, 0.0, pieces), 5.0, CROSSING)
    assert ("hero_goes_again" in failed(judge(play.case()), LOOSE)) is missed


def test_braking_that_is_told_at_a_place_and_never_comes_is_missed() -> None:
    said = f"{AT_5_S}\nA1x(t2) == conflict_point"
    ego, drives = Motion(0.0, 10.0, []), Motion(10.0, 10.0, [(30.0, 0.0)])
    play = Play(text("[t0, go, t1, go, t2, dec, t3]", said), ego, drives, 5.0, CROSSING)
    assert failed(judge(play.case()), LOOSE) == {"hero_dec_onset", "hero_dec"}
    assert "not judged" in judge(play.case()).condition("hero_dec").text, "of no braking nothing holds while it brakes"
    brakes = replace(play, hero=Motion(10.0, 10.0, [(9.0, 0.0), (9.0, -2.0)]))
    assert failed(judge(brakes.case()), TIGHT) == set()
