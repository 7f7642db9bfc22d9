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
        ("A1x(t0) == A0x(t0) - 15\nA1x(t1) == A0x(t1) + 10", "infeasible"),  # nobody swaps places in one lane
        ("A0x(t0) == 20\nA1x(t0) == 5\ngap(A0, A1, t1) == 20", "infeasible"),
        ("A1x(t0) == A0x(t0) + 15\nA1x(t1) == A0x(t1) + 10", "feasible"),
        ("A0(t1) == A2(t1)\nA1x(t0) == A2x(t0) + 20\nA1x(t1) == A2x(t1) - 20", "infeasible"),
        ("A1x(t0) == A0x(t0) - 15\ngap(A0, A1, A1(t2)) == 10", "feasible"),  # after the trigger the ego may be hit
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
@given(places_m=st.tuples(*[st.floats(0.0, 500.0)] * 4))
def test_the_rules_are_true_of_whoever_is_and_stays_apart_and_of_nobody_else(places_m: tuple[float, ...]) -> None:
    """In one lane all along: the distance is a car's length, less a little, and on the side of the start."""
    scene = scene_of("gap(A0, A1, t1) == 10")
    structure = read_structure(scene.program)
    events = Events(scene, limits_of(scene), EgoBounds())
    clear, in_order = apart(events, structure, scene.program.constraints)
    point = [0.0] * len(events.unknowns)
    moments = [(actor, instant) for instant in (events.start, events.knot(0, "t1")) for actor in (0, 1)]
    for (actor, instant), place_m in zip(moments, places_m, strict=True):
        point[events.state(actor, instant).place.number] = place_m
    at_start_m, then_m = places_m[1] - places_m[0], places_m[3] - places_m[2]
    assert (violation(clear.formula, point) <= 1e-9) == (abs(then_m) >= 4.4 - 1e-9)
    stays = min(abs(at_start_m), abs(then_m)) >= 4.4 - 1e-9 and at_start_m * then_m > 0.0
    assert (violation(in_order.formula, point) <= 1e-9) == stays
