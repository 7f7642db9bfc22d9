"""What a program leaves to be understood: owners and partners of landmarks, frames of comparisons."""

from __future__ import annotations

import pytest

from scenewright.program import expressions as ex
from scenewright.program.printer import print_program
from scenewright.program.resolve import resolve
from scenewright.program.text import parse_program
from scenewright.program.types import Program

HEAD = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]
Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]
Actor 2 (other):
- S, W
- [t0, go, t1, dec, t2]
Constraints:
"""


def parsed(*constraints: str) -> Program:
    return parse_program(HEAD + "\n".join(constraints) + "\n")


def of(node_type: type[ex.Node], program: Program) -> list[ex.Node]:
    (first, *_) = program.constraints
    return [node for node in ex.walk(first.formula) if isinstance(node, node_type)]


@pytest.mark.parametrize(
    ("first", "rest", "actor", "other"),
    [
        ("A0x(t1) == stop_line - 3", "", 0, None),
        ("A0x(t1) == conflict_point - 3", "", 0, 1),
        ("A0x(t1) == conflict_point - 3", "A0(t1) == A2(t1)", 0, 1),
        ("A0x(t1) == conflict_point - 3", "A0(t2) == A2(t1)", 0, 1),
        ("A0x(t1) == conflict_point - 3", "A0(t1) == A2(t1)\nA1(t1) == A0(t1)", 0, 1),
        ("A0x(A2(t1)) == conflict_point - 3", "", 0, 1),
        ("A0x(t1) == conflict_point - 3 and A2v(t1) == 5", "", 0, 1),
        ("always[A2(t1), A2(t2)] (A0x <= conflict_point)", "A0(t1) == A1(t1)", 0, 1),
        ("tta(A0, A0.conflict_point(A2), t1) == 3", "A0(t1) == A1(t1)", 0, 2),
        ("A0x(t1) == A0.conflict_point(A1) - 3", "A0(t1) == A2(t1)", 0, 1),
        ("A0x(t1) == turn", "A0(t1) == A2(t1)", 0, 1),
        ("A0x(t1) == A0.intersection(A2)", "", 0, 2),
        ("A2x(t1) == conflict_point - 3", "A0(t1) == A1(t1)", 2, 0),
        ("A2x(t1) == A2.conflict_point(A1) - 3", "", 2, 1),
        ("A1v(t1) == 3 and A1x(t1) == turn_start", "", 1, None),
    ],
)
def test_every_landmark_has_its_actor_and_partner(first: str, rest: str, actor: int, other: int | None) -> None:
    (mark,) = of(ex.Landmark, resolve(parsed(first, rest)))
    assert isinstance(mark, ex.Landmark)
    assert (mark.actor, mark.other, mark.frame) == (actor, other, None)


@pytest.mark.parametrize(
    ("text", "frames"),
    [
        ("A1x(t1) == A0x(t1) + 20", {(1, None), (0, 1)}),
        ("A1x(t1) - A0x(t1) == 20", {(1, None), (0, 1)}),
        ("20 + A0x(t1) <= A1x(t1)", {(0, None), (1, 0)}),
        ("(A1x(t1) - A0x(t1)) / A0v(t1) == 2", {(1, None), (0, 1), (0, None)}),
        ("A1x(t1) == A0.stop_line - 5", {(1, None), (0, 1)}),
        ("tta(A1, A0.stop_line, t1) == 5", {(0, 1)}),
        ("A1x(t1) - A1.stop_line == A0x(t1) - A0.stop_line", {(1, None), (0, None)}),
        ("A0x(t1) - A0.stop_line == A1x(t1) - A2x(t1)", {(0, None), (1, None), (2, 1)}),
        ("A1x(t2) - A1x(t1) == 2 * (A0x(t2) - A0x(t1))", {(1, None), (0, None)}),
        ("A1v(t1) == A0v(t1)", {(1, None), (0, None)}),
    ],
)
def test_places_of_several_actors_are_compared_along_one_route(text: str, frames: set[tuple[int, int | None]]) -> None:
    program = resolve(parsed(text))
    nodes = [*of(ex.State, program), *of(ex.Landmark, program)]
    assert {(node.actor, node.frame) for node in nodes if isinstance(node, ex.State | ex.Landmark)} == frames


@pytest.mark.parametrize(
    "text",
    [
        "A0x(t1) == conflict_point - 3",
        "A1x(t1) == A0x(t1) + 20",
        "tta(A0, A0.turn, t1) < 3 or A1v(t1) == 0",
        "always[0, tta(A1, conflict_point, t1)] (A1v <= 5)",
    ],
)
def test_resolving_again_changes_nothing_and_what_is_printed_is_what_was_written(text: str) -> None:
    program = parsed(text, "A0(t1) == A2(t1)")
    resolved = resolve(program)
    assert resolve(resolved) == resolved != program
    assert print_program(resolved) == print_program(program)
