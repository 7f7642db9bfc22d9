"""Proof, witness or undecided: nothing that has happened is denied, what cannot be is proven, what is found moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import pytest
from planted import EGO, T, limits_of, plant

from scenewright.algebra.polynomials import Named, Unknown
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.decide import Decision, Question, decide
from scenewright.solve.proofs.events import EgoBounds
from scenewright.solve.proofs.refuters import Answer, Capabilities
from scenewright.solve.proofs.witness import broken

HEAD = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]

Constraints:
A0x(t0) == conflict_point - 120
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 25
A1v(t2) == 0
"""


def question(text: str, ego: EgoBounds = EGO) -> Question:
    scene = ground(parse_program(text), T)
    return Question(scene, read_structure(scene.program), limits_of(scene), ego)


@pytest.mark.parametrize("seed", range(35))  # five of each sketch
def test_what_has_happened_is_never_called_impossible(seed: int) -> None:
    planted = plant(seed)
    decision = decide(planted.question(), explain=False)
    assert decision.answer != "infeasible", planted.text
    if decision.witness is not None:
        asked = planted.question()
        assert broken(asked.scene, asked.structure, asked.limits, asked.ego, decision.witness) == []


@pytest.mark.parametrize(
    ("piece", "constraints", "core"),
    [
        ("go", "A1x(t2) == turn_start + 5\nA1v(t2) == 16", {"c1", "c2"}),
        ("go", "turn_start + 5 <= A1x(t2) <= turn_end - 5\nA1v(t2) >= 14", {"c1", "c2"}),
        ("go", "A1x(t1) <= turn_start\nA1x(t2) >= turn_end\nalways[A1(t1), A1(t2)] (A1v >= 12)", {"c1", "c2", "c3"}),
        ("acc", "A1x(t1) <= turn_start\nA1x(t2) >= turn_end\nA1v(t1) == 12", {"c1", "c2", "c3"}),
    ],
)
def test_a_bend_that_nobody_takes_so_fast_is_proven(piece: str, constraints: str, core: set[str]) -> None:
    head = HEAD[: HEAD.index("A0x")].replace("dec", piece)
    decision = decide(question(head + constraints.replace("turn_", "A1.turn_") + "\n"))
    assert decision.answer == "infeasible"
    assert set(decision.core) >= {*core, "hero takes bends at 6 m/s^2 sideways at most"}


@pytest.mark.parametrize("before", ["A1x <= 80", "A1x < 100"])
def test_what_is_bounded_up_to_a_place_is_free_past_it(before: str) -> None:
    head = HEAD[: HEAD.index("A0x")]
    text = f"{head}A1x(t0) == 100\nA1v(t0) == 10\nalways[A1(t0), A1(t1)] ({before} implies A1v <= 5)\n"
    assert decide(question(text)).answer == "feasible"


@pytest.mark.parametrize(
    ("constraint", "answer"),
    [
        ("always[-5, -2] (A1v <= 5)", "feasible"),
        ("eventually[-5, -2] (A1v >= 5)", "infeasible"),
        ("eventually[A1(t1) - 4, A1(t1) - 2] (A1v >= 5)", "infeasible"),
        ("always[A1(t0) - 4, A1(t0)] (A1v <= 5)", "infeasible"),
    ],
)
def test_nothing_holds_or_happens_before_the_start(constraint: str, answer: str) -> None:
    head = HEAD[: HEAD.index("A0x")]
    assert decide(question(f"{head}A1v(t0) == 10\nA1(t1) <= 1.5\n{constraint}\n"), explain=False).answer == answer


@pytest.mark.parametrize("end", ["tta(A1, conflict_point, t1)", "(A1x(t1) - 5) / A1v(t1)"])
def test_a_stretch_of_time_that_ends_at_a_quotient_is_refused_by_name(end: str) -> None:
    decision = decide(question(f"{HEAD}probe: always[0, {end}] (A1v <= 5)\n"))
    assert decision.answer == "undecided"
    assert set(decision.left_out) == {"probe"}


def test_nearly_everything_that_has_happened_is_shown_to_be_possible() -> None:
    answers = [decide(plant(seed).question(), explain=False).answer for seed in range(1000, 1021)]
    assert answers.count("feasible") >= 19, "two that touch or turn too fast in the planted motion may stay undecided"


@pytest.mark.parametrize(
    ("constraint", "core"),
    [
        ("A1v(t1) == 50", {"probe"}),
        ("A1v(2.0) == 500", {"probe"}),
        ("A1a(dec) <= -20", {"probe"}),
        ("A1(t2) - A1(t1) <= 0.3 and A1x(t2) >= conflict_point - 15", {"probe", "c4"}),
        ("A1(t1) == 0.5 s", {"probe", "c1", "c3"}),
        ("always[1, 2] (A1v >= 100)", {"probe"}),
        ("eventually[1, 3] (A1v >= 100)", {"probe"}),
        ("A1v(t1) == 50 or always[1, 2] (A1v >= 100)", {"probe"}),
        ("not (A1v(t1) <= 50)", {"probe"}),
        ("A0v(A1(t2)) == 500", {"probe"}),
        ("A1x(dec) >= conflict_point + 10", {"probe", "c4"}),
        ("A1x(t0) == stop_line - 900", {"probe", "where the routes begin and end"}),
        ("A1x(t0) == stop_line + 900", {"probe", "where the routes begin and end"}),
    ],
)
def test_what_cannot_be_is_proven_whatever_form_it_has(constraint: str, core: set[str]) -> None:
    decision = decide(question(f"{HEAD}probe: {constraint}\n"))
    assert decision.answer == "infeasible"
    assert core <= set(decision.core)
    assert all(" " in origin or origin in {"probe", "c1", "c2", "c3", "c4", "c5"} for origin in decision.core)


@pytest.mark.parametrize(
    "constraint",
    [
        "A1v(t1) == 5.5",
        "A1v(2.0) == 4",
        "A1a(2.0) == 1",
        "A1a(dec) == -3",
        "A1a(t1) <= -4",
        "A1v(dec) <= 5.5",
        "always[1, 2] (A1v <= 4)",
        "always[A1(t0), A1(t1)] (A1v <= A0v - 6)",
        "always[A1(t0), A1(t1)] (A1x >= conflict_point - 40 implies A1v <= 5.5)",
        "always[A1(t1), A1(t2)] (A1a <= -0.8 and A1a >= -5)",
        "never[1, A1(t1) + 1] (A1v > 9 or A1v < 1)",
        "eventually[1, 3] (A1v <= 3)",
        "not always[A1(t0), A1(t1)] (A1v >= 5.5)",
        "A1v(A0(t2)) == 0",
    ],
)
def test_every_form_is_kept_by_a_witness(constraint: str) -> None:
    asked = question(f"{HEAD}A0x(t2) == conflict_point\n{constraint}\n")
    decision = decide(asked)
    assert decision.witness is not None
    assert broken(asked.scene, asked.structure, asked.limits, asked.ego, decision.witness) == []


def test_braking_at_several_rates_is_no_contradiction() -> None:
    """Slow after 10 s of braking from 8 m/s: hard at first and then hardly, as a judge accepts it."""
    text = HEAD.replace("A1x(t1) == conflict_point - 25", "A1x(t1) == conflict_point - 25\nA1v(t1) == 8")
    decision = decide(question(f"{text}A1(t2) - A1(t1) == 10\nA1x(t2) == conflict_point - 5\n"))
    assert decision.answer == "feasible"


@pytest.mark.parametrize("always", ["A1a >= -1", "A1a >= -1 or A1v >= 30"])
def test_what_begins_where_a_stretch_of_time_ends_comes_after_it(always: str) -> None:
    asked = question(f"{HEAD}always[A1(t0), A1(t1)] ({always})\nA1a(t1) <= -4\n")
    assert decide(asked, explain=False).answer == "feasible"


def test_a_freed_number_is_found() -> None:
    asked = question(f"parameters:\n- p_mps\n\n{HEAD}A1v(t1) == p_mps\nA1a(dec) == -3\nA1(t2) - A1(t1) == 2 s\n")
    decision = decide(asked)
    assert decision.witness is not None
    assert decision.witness.parameters["p_mps"] == pytest.approx(6.0, abs=0.01)
    narrow = replace(asked, scene=replace(asked.scene, program=replace(asked.scene.program, parameters=())))
    assert decide(replace(narrow, freed={"p_mps": (Fraction(1), Fraction(5))})).answer != "feasible"


def test_a_decision_is_what_it_says() -> None:
    with pytest.raises(ValueError, match="witness"):
        Decision("feasible")


def test_the_same_question_has_the_same_answer_to_the_digit() -> None:
    first, second = (decide(plant(7).question()).witness for _ in range(2))
    assert first is not None
    assert second is not None
    assert [s for p in first.profiles.values() for s in p.segments] == [
        s for p in second.profiles.values() for s in p.segments
    ]


@dataclass
class Denies:
    """Refutes whatever it is asked."""

    capabilities: Capabilities
    name: str = "denier"

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        return Answer("refuted")


@pytest.mark.parametrize("exact", [True, False])
def test_only_what_an_exact_solver_refutes_is_proven(exact: bool) -> None:
    asked = question(f"{HEAD}probe: A1v(t1) == 50\n")
    denies = Denies(Capabilities(exact=exact))
    decision = decide(replace(asked, refuter=denies))
    assert decision.answer == ("infeasible" if exact else "undecided")
    assert decision.doubted_by == ("" if exact else "denier")


@pytest.mark.parametrize("last", ["A1v(130) >= 0", "always[0, 130] (A1v <= 15)"])
def test_a_time_later_than_everything_else_says_nothing_of_before(last: str) -> None:
    head = HEAD[: HEAD.index("A0x(t0)")].replace("dec", "go")
    text = f"{head}A1x(t0) == 50\nA1(t1) == 5 s\nA1x(t1) == 60\nA1x(8) == 66\n{last}\n"
    assert decide(question(text), explain=False).answer != "infeasible"


ALONE = """A0x(1.8) == 110
A0x(t0) == 100
A0v(t1) >= 11
A0(t1) <= 1 s
"""
TIED = """A0(t1) == A1(t1)
A0(t1) <= 4 s
A1(t1) >= 6 s
"""


@pytest.mark.parametrize("constraints", [ALONE, TIED], ids=["orders", "one moment"])
def test_what_a_core_names_clashes_by_itself(constraints: str) -> None:
    """Also where the order of moments, or who is who's moment, rests on another."""
    head = HEAD[: HEAD.index("A0x(t0)")].replace("dec", "go")
    asked = question(head + constraints, EgoBounds(18.0, 2.0, 6.0))
    decision = decide(asked, 10.0)
    assert decision.answer == "infeasible"
    program = asked.scene.program
    kept = tuple(each for each in program.constraints if each.id in decision.core)
    fewer = replace(asked.scene, program=replace(program, constraints=kept))
    assert decide(replace(asked, scene=fewer), 10.0, explain=False).answer == "infeasible"
