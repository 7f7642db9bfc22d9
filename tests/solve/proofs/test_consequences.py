"""What is divided out of products holds wherever they do, and says what it rests on."""

from __future__ import annotations

from fractions import Fraction

import pytest
from planted import limits_of

from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads import load_map
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.consequences import consequences
from scenewright.solve.proofs.decide import Decision, Question, decide
from scenewright.solve.proofs.events import EgoBounds, Unknown
from scenewright.solve.proofs.polynomials import compare, every, some, unknown
from scenewright.solve.proofs.relaxation import Named

PLACE, THEN, SPEED, AT, LATER = (unknown(number) for number in range(5))
RANGES = [
    Unknown(name, Fraction(0), Fraction(100), kind)
    for name, kind in (("x", "place"), ("y", "place"), ("v", "speed"), ("t", "time"), ("u", "time"))
]
NEAR = Named(every([compare("==", 300 - PLACE, SPEED * 4), compare(">", SPEED, 0)]), "near")
THERE = Named(compare("==", THEN, 300), "there")
EVEN = Named(compare("==", THEN - PLACE, SPEED * (LATER - AT)), "even")


def test_who_holds_its_speed_is_there_when_its_time_to_arrival_says() -> None:
    (made,) = consequences(RANGES, [NEAR, THERE, EVEN])
    for later in (3.0, 4.0, 5.0):
        point = [0.0, 300.0, 5.0, 0.0, later]
        held = compare("==", LATER - AT, 4)
        assert (made.formula.left.value(point) == 0.0) == (held.left.value(point) == 0.0)
    assert set(made.origins) == {"near", "there", "even"}


def test_nothing_is_divided_by_what_may_be_zero_or_is_said_in_one_case_alone() -> None:
    resting = Named(every([compare("==", 300 - PLACE, SPEED * 4), compare(">=", SPEED, 0)]), "near")
    assert consequences(RANGES, [resting, THERE, EVEN]) == []
    either = Named(some([EVEN.formula, compare(">=", LATER, 50)]), "even")
    assert consequences(RANGES, [NEAR, THERE, either]) == []


def test_an_inequality_keeps_its_direction() -> None:
    late = Named(compare("<=", SPEED * 7, SPEED * LATER), "late")
    (made,) = consequences(RANGES, [NEAR, late])
    assert made.formula == compare("<=", 7, LATER)


TEXT = """Actor 0 (ego):
- E
- [t0, go, t1, go, t2]

Actor 1 (hero):
- S, E
- [t0, go, t1, acc, t2]

Constraints:
tta(A0, intersection, t0) == 9
A0(t1) == A1(t1)
tta(A0, conflict_point, t1) == {ego_s}
tta(A1, stop_line, t1) == 2.4
A1x(t2) == turn_end
A0x(t2) == conflict_point
A1(t2) < A0(t2)
"""


def asked(ego_s: float, ego: EgoBounds) -> Decision:
    """Return what is decided of an ego that is so long (s) before the conflict point at the trigger."""
    scene = ground(parse_program(TEXT.format(ego_s=ego_s)), load_map("t_intersection"))
    return decide(Question(scene, read_structure(scene.program), limits_of(scene), ego), 10.0)


@pytest.mark.parametrize(("ego_s", "answer"), [(2.9, "infeasible"), (9.0, "feasible")])
def test_an_ego_that_holds_its_speed_leaves_as_much_time_as_it_says(ego_s: float, answer: str) -> None:
    decision = asked(ego_s, EgoBounds(60.0, 0.0, 0.0, holds_speed=True))
    assert decision.answer == answer
    if answer == "infeasible":
        assert "ego holds its speed, as its policy promises" in decision.core
