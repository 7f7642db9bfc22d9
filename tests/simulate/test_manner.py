"""A program's manner is kept to by what is driven: a run that would not do for it is not what is driven then."""

from __future__ import annotations

from dataclasses import replace

import pytest

from scenarios import YIELDS, limits_of
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.orchestrate import case_of, orchestrate
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.roads.grounding import Scene
from scenewright.simulate.loop import Run
from scenewright.simulate.witnessed import run_of_witness
from scenewright.solve.feasibility import Question, check_feasibility
from stories import STORIES, driven


def judged_in_manner(scene: Scene, run: Run, text: str) -> Verdict:
    """Judge a run by another manner than the one it was driven in."""
    other = replace(scene, program=replace(scene.program, manner=parse_program(text).manner))
    return judge(case_of(other, run, limits_of(other)))


@pytest.mark.parametrize(
    ("story", "ego", "numbers", "condition"),
    [
        ("stops and goes", "idm", "- stands_s = 2", "hero_standstill"),
        ("brakes at a rate", "noisy", "- settled_s = 4\n- settled_mpss = 0.1", "hero_settled"),
        ("goes first, distance", "stop-and-go", "- settled_s = 4\n- settled_mpss = 0.1", "hero_settled"),
    ],
)
def test_the_loop_keeps_to_the_manner_asked_for(story: str, ego: str, numbers: str, condition: str) -> None:
    text = f"manner:\n{numbers}\n{STORIES[story]}"
    usual = driven(story, ego, replan_hz=2.0)
    assert usual.scene is not None
    assert usual.run is not None
    assert not judged_in_manner(usual.scene, usual.run, text).condition(condition).holds_at(TIGHT)
    result = orchestrate(Request(text, ego=ego, replan_hz=2.0))
    assert result.verdict is not None
    assert [c.id for c in result.verdict.conditions if not c.holds_at(TIGHT)] == []


def test_a_witness_is_one_in_the_manner_asked_for() -> None:
    scene = YIELDS.scene()
    manner = parse_program(f"manner:\n- settled_s = 2\n- settled_mpss = 0.1\n- begins_s = 1\n{YIELDS.text}").manner
    for program in (scene.program, replace(scene.program, manner=manner)):
        asked = replace(scene, program=program)
        witness = check_feasibility(Question(asked, read_structure(program), limits_of(asked))).witness
        assert witness is not None
        assert judge(case_of(asked, run_of_witness(asked, limits_of(asked), witness), limits_of(asked))).holds_at(TIGHT)
