"""Which collisions fail a run: of orchestrated actors always, of the ego before the trigger."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from plays import (
    BRAKES,
    CROSSING,
    NOT_YIELDING,
    YIELDS,
    YIELDS_AT_S,
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

PROGRAM = """
Actor 0 (ego):
- E
- [t0, go, t1, go, t2]

Actor 1 (first):
- E
- [t0, go, t1, go, t2]

Actor 2 (second):
- E
- [t0, go, t1, go, t2]

Constraints:
A0(t1) == A1(t1)
A0(t1) == A2(t1)
A0x(t1) == stop_line
"""


def judged(first: Motion, second: Motion, end_s: float = 12.0, program: str = PROGRAM) -> Verdict:
    """Judge an ego that is at its line at 6 s, ahead of it `first` and behind that `second`, on one line."""
    time_s = np.append(np.arange(0.0, end_s - 1e-9, 0.02), end_s)
    motions = {"ego": Motion(0.0, 10.0, []), "first": first, "second": second}
    traces = {name: actor_trace(motion, time_s, (0.0, 0.0, 0.0)) for name, motion in motions.items()}
    landmarks = {"ego": {"stop_line": 60.0}}
    return judge(Case(parse_program(program), {}, landmarks, {}, Trace(traces)))


def collisions(verdict: Verdict) -> set[str]:
    found = {c.id for c in verdict.conditions if not c.holds_at(LOOSE)}
    return found & {"no_collision", "heroes_apart"}


def test_clear_of_each_other_holds_and_says_so() -> None:
    verdict = judged(Motion(100.0, 10.0, []), Motion(80.0, 10.0, []))
    assert collisions(verdict) == set()
    assert verdict.condition("heroes_apart").holds_at(LOOSE)
    assert verdict.aftermath.collision is None


@pytest.mark.parametrize("at_s", [3.0, 9.0])
def test_orchestrated_actors_that_collide_fail_before_the_trigger_and_after(at_s: float) -> None:
    verdict = judged(Motion(104.5, 10.0, []), Motion(100.0 - 2.0 * at_s, 12.0, []))
    assert collisions(verdict) == {"heroes_apart"}
    assert verdict.condition("heroes_apart").measured == pytest.approx(at_s, abs=0.01)
    assert verdict.aftermath.collision is not None
    assert verdict.aftermath.collision.actors == ("second", "first")


def test_it_may_be_in_the_last_instant() -> None:
    verdict = judged(Motion(104.5, 10.0, []), Motion(100.0 - 2.0 * 8.999, 12.0, []), end_s=9.0)
    assert verdict.condition("heroes_apart").measured == 9.0
    assert collisions(verdict) == {"heroes_apart"}


def test_of_several_it_is_told_whom_the_ego_came_near() -> None:
    came = judged(Motion(20.0, 11.0, []), Motion(-9.0, 9.5, [])).aftermath
    assert came.in_words().startswith("no collision; closest 4.5 m (the car 'second'), ")
    assert "whom" not in came.as_dict()


@pytest.mark.parametrize(("at_s", "fails"), [(3.0, {"no_collision"}), (9.0, set())])
def test_the_ego_that_is_hit_fails_only_before_the_trigger(at_s: float, fails: set[str]) -> None:
    verdict = judged(Motion(104.5, 10.0, []), Motion(4.5 + 2.0 * at_s, 8.0, []))
    assert collisions(verdict) == fails
    assert verdict.aftermath.collision is not None
    assert verdict.aftermath.collision.actors == ("ego", "second")
    assert verdict.aftermath.collision.time_s == pytest.approx(at_s, abs=0.01)


def test_a_vehicle_without_a_trigger_does_not_put_off_that_of_the_others() -> None:
    program = PROGRAM.replace("A0(t1) == A2(t1)", "A2v(t0) == 8")
    assert program != PROGRAM
    hit_late = judged(Motion(104.5, 10.0, []), Motion(4.5 + 2.0 * 9.0, 8.0, []), program=program)
    assert hit_late.aftermath.collision is not None
    assert collisions(hit_late) == set()


def test_in_a_program_without_a_trigger_only_who_drives_into_the_ego_spoils_it() -> None:
    """A vehicle that stands in the ego's lane is there from the start: to hit it is what the test finds."""
    program = PROGRAM.replace("A0(t1) == A1(t1)\nA0(t1) == A2(t1)\n", "A1v(t0) == 0\n")
    ahead, behind = Motion(40.0, 0.0, []), Motion(-100.0, 5.0, [])
    hit = judged(ahead, behind, program=program)
    assert hit.aftermath.collision is not None
    assert hit.aftermath.collision.actors == ("ego", "first")
    assert collisions(hit) == set()
    assert collisions(judged(Motion(140.0, 10.0, []), Motion(-20.0, 14.0, []), program=program)) == {"no_collision"}


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


def test_who_asks_for_a_distance_does_not_ask_for_contact() -> None:
    """The hero brakes 3 m ahead of the ego, centre to centre: its tail is in the ego's nose by then."""
    near = replace(BRAKES, parameters={"gap_m": 3.0, "rate_mpss": 4.0}).with_hero(s_m=18.0)
    assert failed(judge(near.case()), LOOSE) == {"no_collision"}
    told = replace(near, text=near.text.replace("gap(A0, A1, t1) == gap_m", "A1x(t1) == A0x(t1) + gap_m"))
    assert failed(judge(told.case()), LOOSE) == {"no_collision"}, "it is a distance, however it is written"


@pytest.mark.parametrize(("brakes_s", "hit"), [(5.0, set()), (9.0, {"no_collision"})])
def test_who_brakes_by_the_clock_and_is_hit_then_is_not_hit_before_its_trigger(brakes_s: float, hit: set[str]) -> None:
    """The first stands at 8.3 s, and is hit from behind: after its moment, or before it."""
    program = PROGRAM.split("Constraints", maxsplit=1)[0].replace("t0, go, t1, go, t2", "t0, go, t1, dec, t2", 2)
    program = program.replace("t0, go, t1, dec, t2", "t0, go, t1, go, t2", 1)
    verdict = judged(
        Motion(20.0, 10.0, [(5.0, 0.0), (20.0, -3.0)]), Motion(-60.0, 10.0, []),
        program=f"{program}Constraints:\nA1(t1) == {brakes_s} s\n",
    )  # fmt: skip
    assert collisions(verdict) & {"no_collision"} == hit


@pytest.mark.parametrize(("clear_m", "holds"), [(0, True), (3.4, True), (3.6, False)])
def test_clear_of_is_as_far_as_the_manner_says(clear_m: float, holds: bool) -> None:
    """8 m between centres at the trigger are 3.5 m between bodies, and it was more before."""
    close = replace(BRAKES, parameters={"gap_m": 8.0, "rate_mpss": 4.0}).with_hero(s_m=23.0)
    manner = f"manner:\n- clear_m = {clear_m}\ndescription:"
    condition = judge(replace(close, text=close.text.replace("description:", manner, 1)).case()).condition(
        "no_collision"
    )
    assert condition.holds_at(TIGHT) == condition.holds_at(LOOSE) == holds
    if not holds:
        assert condition.measured == pytest.approx(7.45, abs=0.01)  # closing at 2 m/s


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
    leaves_s = YIELDS_AT_S + (-12.0 + np.sqrt(144.0 + 4 * 43.2)) / 2.0
    assert pair["post_encroachment_time_s"] == pytest.approx(enters_s - leaves_s, abs=0.05)
    assert 0 < pair["min_distance_m"] < 10
    assert pair["collision_time_s"] is None
    following = judge(BRAKES.case()).facts["pairs"]["ego, hero"]
    # The ego stops 100 / 4.4 m after 75 m, the hero at 103 m; between the centres lie 4.5 m of cars.
    assert following["min_distance_m"] == pytest.approx(103.0 - 75.0 - 100 / 4.4 - 4.5, abs=1e-3)
    assert following["min_ttc_s"] is not None


def test_where_the_trigger_never_came_all_of_the_run_is_before_it() -> None:
    """The ego is nearest to its line at the start, and passes it never; it is hit long after that."""
    program = PROGRAM.replace("A0x(t1) == stop_line", "A0x(t1) == stop_line - 75")
    verdict = judged(Motion(104.5, 10.0, []), Motion(4.5 + 2.0 * 9.0, 8.0, []), program=program)
    assert verdict.facts["trigger_time_s"]["first"] == 0.0
    assert collisions(verdict) == {"no_collision"}
