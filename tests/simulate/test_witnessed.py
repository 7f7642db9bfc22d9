"""A witness as a run: everybody moves as it says, and the judge, who knows nothing of it, calls it a success."""

from __future__ import annotations

import numpy as np
import pytest

from scenarios import FEASIBLE, Example, limits_of
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.orchestrate import case_of
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.simulate.witnessed import run_of_witness
from scenewright.solve.feasibility import Question, check_feasibility


@pytest.mark.parametrize("case", FEASIBLE, ids=lambda case: case.name)
def test_moves_as_the_witness_says(case: Example) -> None:
    scene = case.scene()
    limits = limits_of(scene)
    witness = check_feasibility(Question(scene, read_structure(scene.program), limits)).witness
    assert witness is not None
    run = run_of_witness(scene, limits, witness)
    for actor in scene.program.actors:
        trace, profile = run.trace.actors[actor.name], witness.profiles[actor.id]
        middle = (trace.time_s[:-1] + trace.time_s[1:]) / 2
        middle = middle[middle <= witness.end_s]  # from then on it goes on as anybody does, slower in bends
        told = [profile.state(float(t))[0] for t in middle]
        assert np.allclose([trace.position(float(t)) for t in middle], told, atol=5e-3)
        assert run.trace.duration_s >= max(profile.knot_times_s.values()) - 1e-9
    missed = {each.id for each in judge(case_of(scene, run, limits)).conditions if not each.holds_at(TIGHT)}
    assert missed <= {"start"}, "a witness shows that it can happen, from whatever start"


def test_what_follows_ends_before_a_crash() -> None:
    text = (
        "Actor 0 (ego):\n- W\n- [t0, go, t1]\n\nActor 1 (hero):\n- W\n- [t0, dec, t1]\n\nConstraints:\n"
        "A0(t1) == 2 s\nA1v(t1) == 0\nA1(t1) == 2 s\ngap(A0, A1, t1) == 9\nA0v(t1) == 8\n"
    )
    scene = ground(parse_program(text), load_map("t_intersection"))
    limits = limits_of(scene)
    witness = check_feasibility(Question(scene, read_structure(scene.program), limits)).witness
    assert witness is not None
    run = run_of_witness(scene, limits, witness)
    assert witness.end_s - 1e-9 <= run.trace.duration_s < witness.end_s + 1.0
    verdict = judge(case_of(scene, run, limits))
    assert verdict.condition("no_collision").holds_at(TIGHT)
