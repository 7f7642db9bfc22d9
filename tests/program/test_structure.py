"""What constraints are for: instants, triggers and roles on the canonical programs."""

from __future__ import annotations

import pytest

from scenarios import EXAMPLE_TABLE, YIELDS_THEN_GOES, Example, example
from scenewright.program.structure import Role, placed_at, read_structure, stands_at_end, with_ego
from scenewright.program.text import parse_program

THREE = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2, go, t3]
Actor 1 (lead):
- W
- [t0, go, t1, dec, t2]
Actor 2 (oncoming):
- E, N
- [t0, go, t1, dec, t2]
Constraints:
A0(t1) == A1(t1)
gap(A0, A1, t1) == 30
A0(t2) == A2(t1)
A2x(t1) == conflict_point - 30
A1v(t2) == 0
A2v(t2) == 0
A1(t2) < A2(t2)
"""


@pytest.mark.parametrize("case", EXAMPLE_TABLE, ids=lambda case: case.name)
def test_roles_and_triggers_of_the_examples(case: Example) -> None:
    program = case.program()
    structure = read_structure(program)
    assert tuple(structure.roles[c.id] for c in program.constraints) == case.roles
    assert structure.triggers == {1: case.trigger}


def test_knots_of_one_moment() -> None:
    structure = read_structure(YIELDS_THEN_GOES.program())
    assert structure.instants == (frozenset({(0, "t1"), (1, "t1")}),)
    assert structure.starts == {0: "t0", 1: "t0"}
    assert structure.trigger_knot(0) == structure.trigger_knot(1) == "t1"


def test_each_hero_has_a_trigger_of_its_own() -> None:
    program = parse_program(THREE)
    structure = read_structure(program)
    assert structure.triggers == {1: frozenset({(0, "t1"), (1, "t1")}), 2: frozenset({(0, "t2"), (2, "t1")})}
    assert structure.trigger_knot(2) == "t1"
    assert structure.trigger_knot(1) == "t1"
    assert structure.trigger_knot(0) == "t1"
    roles = [structure.roles[c.id] for c in program.constraints]
    assert roles == [*(Role.TRIGGER,) * 4, *(Role.INTERACTION,) * 3]


@pytest.mark.parametrize(
    ("line", "role"),
    [
        ("A0v(t1) <= 9", Role.TRIGGER),
        ("always[A0(t1), A0(t1) + 3 s] (gap(A0, A1) >= 4)", Role.OUTCOME),
        ("eventually[A1(t1), A1(t1) + 3 s] (A1v <= 4)", Role.INTERACTION),
    ],
)
def test_what_lasts_from_a_trigger_on_is_not_asked_of_its_moment(line: str, role: Role) -> None:
    program = parse_program(example("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{line}"))
    assert read_structure(program).roles[program.constraints[-1].id] is role


@pytest.mark.parametrize(
    ("line", "trigger"),
    [("A1(t1) == 5 s", {(1, "t1")}), ("5 s == A1(t2)", {(1, "t2")}), ("A1(t1) <= 5 s", None), ("A1v(t1) == 5", None)],
)
def test_a_moment_of_a_hero_by_the_clock_is_its_trigger(line: str, trigger: set[tuple[int, str]] | None) -> None:
    program = parse_program(example("W", "t0, go, t1, dec, t2", line))
    assert read_structure(program).triggers == ({1: trigger} if trigger else {})


def test_moments_are_joined_across_constraints_and_within_a_conjunction() -> None:
    text = example("W", "t0, go, t1, dec, t2", "A0(t1) == A1(t1) and A0(t0) == A1(t0)\nA1(t1) == A0(t2)")
    structure = read_structure(parse_program(text))
    assert set(structure.instants) == {
        frozenset({(0, "t1"), (1, "t1"), (0, "t2")}),
        frozenset({(0, "t0"), (1, "t0")}),
    }


@pytest.mark.parametrize(
    "line", ["A0(t1) == A1(t1) + 1", "A0(t1) <= A1(t1)", "A0(t1) == A1(t1) or A0v(t1) == 5", "not A0(t1) == A1(t1)"]
)
def test_what_does_not_say_that_two_knots_are_one_moment(line: str) -> None:
    structure = read_structure(parse_program(example("W", "t0, go, t1, dec, t2", line)))
    assert structure.instants == ()
    assert structure.triggers == {}
    assert structure.trigger_knot(1) is None


@pytest.mark.parametrize(
    ("line", "placed"),
    [
        ("A0x(t1) == stop_line - 5\nA1x(t1) == stop_line", {0, 1}),
        ("A1x(t1) == A0x(t1) + 3", set()),  # a distance, however it is written
        ("A0x(t1) <= stop_line\nA1x(t1) == stop_line", {1}),  # somewhere before is no place
        ("A1x(t2) == stop_line", set()),  # at another moment
        ("gap(A0, A1, t1) == 3", set()),  # a distance is no place
        ("A1v(t1) == 3", set()),
    ],
)
def test_who_is_told_where_to_be_at_an_instant(line: str, placed: set[int]) -> None:
    program = parse_program(example("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{line}"))
    assert placed_at(program, frozenset({(0, "t1"), (1, "t1")})) == placed


@pytest.mark.parametrize(
    ("sketch", "line", "stands"),
    [
        ("[t0, go, t1, dec, t2]", "A1v(t2) == 0", True),
        ("[t0, go, t1, dec, t2]", "A1v(t2) == 2", False),
        ("[t0, go, t1, dec, t2]", "A1v(t1) == 0", False),
        ("[t0, go, t1, dec, t2, stop, t3]", "A1v(t1) == 9", True),
        ("[t0, go, t1, dec, t2, stop, t3, go, t4]", "A1v(t2) == 0", False),
    ],
)
def test_who_stands_at_the_end(sketch: str, line: str, stands: bool) -> None:
    text = f"Actor 0 (ego):\n- W\n- [t0, go, t1]\n\nActor 1 (hero):\n- E, N\n- {sketch}\n\nConstraints:\n{line}\n"
    assert stands_at_end(parse_program(text), 1) is stands


@pytest.mark.parametrize(
    ("line", "knot", "moment"),
    [
        ("A0(t2) == A1(t3)", "t3", {(0, "t2"), (1, "t3")}),
        ("gap(A0, A1, A1(t3)) == 12", "t3", {(1, "t3")}),
        ("headway(A1, A0, t2) == 1", "t2", {(1, "t2")}),
        ("gap(A1, A0, A1(t3)) == 12", "t3", {(1, "t3")}),
        ("A1(t3) == 9", "t3", None),
        ("A1(t3) > A0(t2)", "t3", None),
    ],
)
def test_moments_with_the_ego_after_the_trigger(line: str, knot: str, moment: set[tuple[int, str]] | None) -> None:
    sketches = "Actor 0:\n- W\n- [t0, go, t1, go, t2]\nActor 1:\n- W\n- [t0, go, t1, dec, t2, go, t3]\n"
    program = parse_program(f"{sketches}Constraints:\nA0(t1) == A1(t1)\n{line}\n")
    found = with_ego(program, read_structure(program).instants, 1, knot)
    assert found == (None if moment is None else frozenset(moment))
    assert read_structure(program).triggers == {1: frozenset({(0, "t1"), (1, "t1")})}
