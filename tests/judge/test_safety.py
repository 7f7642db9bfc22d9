"""Which collisions fail a run: of orchestrated actors always, of the ego before the trigger."""

from __future__ import annotations

import numpy as np
import pytest
from plays import Motion, actor_trace

from scenewright.judge.case import Case
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE
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
