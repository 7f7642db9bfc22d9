"""Of alternatives that last the one that holds in a motion is planned; what speaks of moments stays open."""

from __future__ import annotations

import pytest
from situations import scene_of

from scenewright.motion.limits import limits_on
from scenewright.plan.alternatives import decided, planned_for
from scenewright.program import expressions as ex
from scenewright.program.evaluate import violation
from scenewright.program.printer import print_expression
from scenewright.program.structure import read_structure
from scenewright.roads.grounding import Scene
from scenewright.solve.feasibility import Question, check_feasibility
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.witness import Witness
from stories import program

SYNC = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\nA1x(t1) == conflict_point - 25\nA1v(t2) == 0\n"
SLOWLY = "always[A1(t0), A1(t1)] (A1v <= 5.5)"


def found(line: str) -> tuple[Scene, Witness]:
    scene = scene_of(program("E, N", "t0, go, t1, dec, t2", f"{SYNC}tested: {line}"))
    limits = {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}
    witness = check_feasibility(Question(scene, read_structure(scene.program), limits)).witness
    assert witness is not None
    return scene, witness


@pytest.mark.parametrize(
    ("line", "left"),
    [
        (f"A1v(t1) == 50 or {SLOWLY}", SLOWLY),
        (f"A1v(t1) <= 50 implies {SLOWLY}", SLOWLY),
        (f"A1v(t1) >= 0 and (A1v(t1) == 50 or {SLOWLY})", f"A1v(t1) >= 0 and {SLOWLY}"),
        ("not (A1v(t1) <= 50 and eventually[A1(t0), A1(t1)] (A1v > 5.5))", SLOWLY),
        ("A1v(t1) == 50 or A1a(dec) == -4", "A1a(dec) == -4"),
        ("A1v(t1) == 50 or A1v(dec) <= 5", "always[A1(t1), A1(t2)] (A1v <= 5)"),
    ],
)
def test_what_lasts_is_decided_as_a_motion_has_it(line: str, left: str) -> None:
    scene, witness = found(line)
    formula = decided(scene, witness).program.constraint("tested").formula
    assert print_expression(formula).replace(" ", "") == left.replace(" ", "")
    assert violation(formula, PlanWorld(scene, witness.profiles, witness.parameters)) <= 1e-2


@pytest.mark.parametrize("line", ["A1v(t1) == 6 or A1v(t1) == 8", "A1(t2) < A0(t2) or A0(t2) < A1(t2)", SLOWLY])
def test_what_speaks_of_moments_stays_as_it_is(line: str) -> None:
    scene, witness = found(line)
    assert decided(scene, witness) == scene


def test_all_other_constraints_stay_as_they_are() -> None:
    scene, witness = found(f"A1v(t1) == 50 or {SLOWLY}")
    before, after = ({c.id: c.formula for c in each.program.constraints} for each in (scene, decided(scene, witness)))
    assert [name for name, formula in before.items() if formula != after[name]] == ["tested"]
    assert not any(isinstance(node, ex.Logic) for node in ex.walk(after["tested"]))


BESIDE = "A0x(t1) == stop_line - 10\nalways[A0(t0), A0(t1)] (gap(A1, A0) <= 20)\n"


@pytest.mark.parametrize(
    ("more", "over"),
    [
        ("", "A1(t1) - A0(t1) == 0"),
        ("A1x(t1) == stop_line", "A1(t1) - A0(t1) >= 0"),
        (
            "always[0 s, 9 s] (gap(A1, A0) >= 5)",
            "A1(t1) - A0(t1) == 0 and A1(t1) - 9 >= 0 or A1(t1) - A0(t1) >= 0 and A1(t1) - 9 == 0",
        ),
    ],
)
def test_who_has_to_be_beside_the_ego_is_done_when_that_is_over(more: str, over: str) -> None:
    scene = scene_of(program("W", "t0, go, t1", f"{BESIDE}{more}\n"))
    *same, last = planned_for(scene, None).program.constraints
    assert tuple(same) == scene.program.constraints
    assert print_expression(last.formula) == over


def test_who_has_a_trigger_is_done_when_it_is() -> None:
    scene = scene_of(program("W", "t0, go, t1", f"{BESIDE}A0(t1) == A1(t1)\n"))
    assert planned_for(scene, None) == scene
