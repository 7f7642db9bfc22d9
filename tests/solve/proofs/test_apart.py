"""Who asks for a distance in one lane gets no contact: refuted where bodies would overlap, and nowhere else."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from posed import violation

from scenarios import limits_of
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.proofs.apart import APART, apart
from scenewright.solve.proofs.decide import Decision, Question, decide
from scenewright.solve.proofs.events import EgoBounds, Events

TEXT = """{manner}Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- {route}
- [t0, go, t1, dec, t2]
{others}
Constraints:
A0(t1) == A1(t1)
A1v(t2) == 2
"""
OTHER = """
Actor 2 (other):
- W
- [t0, go, t1, go, t2]
"""


def scene_of(constraints: str, route: str = "W", manner: str = "") -> Scene:
    others = OTHER if "A2" in constraints else ""
    program = parse_program(TEXT.format(route=route, manner=manner, others=others) + constraints)
    return ground(program, load_map(program.map_name), {})


def decided(constraints: str, route: str = "W", manner: str = "") -> Decision:
    scene = scene_of(constraints, route, manner)
    return decide(Question(scene, read_structure(scene.program), limits_of(scene)), 5.0)


@pytest.mark.parametrize(
    ("constraint", "answer"),
    [
        ("gap(A0, A1, t1) == 0", "infeasible"),
        ("gap(A0, A1, t1) == -4.3", "infeasible"),
        ("gap(A0, A1, t1) == 4.6", "feasible"),
        ("gap(A0, A1, t1) == -4.6", "feasible"),
        ("gap(A0, A1, A1(t1)) <= 3 and gap(A0, A1, t1) >= -3", "infeasible"),
        ("gap(A0, A1, t1) <= 3", "feasible"),  # the hero is behind
        ("gap(A0, A1, A1(t2)) == 0", "feasible"),  # after the trigger the ego may be hit
        ("A0(t1) == A2(t1)\ngap(A1, A2, t2) == 0", "infeasible"),  # heroes never may
        ("gap(A0, A1, t1) == 3\nA0x(t1) == 100\nA1x(t1) == 103", "feasible"),  # told where both are: contact asked for
    ],
)
def test_bodies_that_would_overlap_are_refuted(constraint: str, answer: str) -> None:
    decision = decided(constraint)
    if answer == "infeasible":
        assert decision.answer == answer
        assert {"the ego touches nobody before the trigger", APART} & set(decision.core)
    else:
        assert decision.answer != "infeasible"


def test_before_lanes_merge_nobody_is_in_anybody_s_way() -> None:
    """Both 40 m before the merge: no distance along the lane that they are to share, and a road of its own each."""
    assert decided("gap(A0, A1, t1) == 0\nA1x(t1) <= turn_start - 10", "S, W").answer == "feasible"
    past = decided("gap(A0, A1, t1) == 0\nA1x(t1) >= turn_end + 5", "S, W")
    assert past.answer == "infeasible"


def test_room_of_the_manner_is_asked_for_and_named() -> None:
    manner = "manner:\n- clear_m = 2\n\n"
    assert decided("gap(A0, A1, t1) == 6", manner=manner).core[-1].endswith("(clear_m is 2 m)")
    assert decided("gap(A0, A1, t1) == 6").answer == "feasible"
    assert decided("gap(A0, A1, t1) == 7", manner=manner).answer == "feasible"


@settings(max_examples=40)
@given(ego_m=st.floats(0.0, 500.0), hero_m=st.floats(0.0, 500.0))
def test_the_rule_is_true_of_whoever_is_apart_and_of_nobody_else(ego_m: float, hero_m: float) -> None:
    """In one lane all along: what is said is that the distance is a car's length, less a little, either way."""
    scene = scene_of("gap(A0, A1, t1) == 10")
    structure = read_structure(scene.program)
    events = Events(scene, limits_of(scene), EgoBounds())
    (rule,) = apart(events, structure, scene.program.constraints)
    instant = events.knot(0, "t1")
    point = [0.0] * len(events.unknowns)
    for actor, place_m in ((0, ego_m), (1, hero_m)):
        point[events.state(actor, instant).place.number] = place_m
    assert (violation(rule.formula, point) <= 1e-9) == (abs(ego_m - hero_m) >= 4.4 - 1e-9)
