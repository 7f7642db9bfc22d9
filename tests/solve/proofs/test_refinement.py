"""What a motion shows to be missing is added: moments in stretches of time, places in turns, room between two."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from planted import EGO, T, limits_of

from scenewright.program.manner import USUAL, Manner
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.decide import Question, decide
from scenewright.solve.proofs.witness import Witness

HEAD = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- {}\n- [t0, go, t1, {}, t2]\n\nConstraints:\n"


def answered(route: str, piece: str, *constraints: str, manner: Manner = USUAL) -> tuple[Question, Witness]:
    program = parse_program(HEAD.format(route, piece) + "\n".join(constraints) + "\n")
    scene = ground(replace(program, manner=manner), T)
    question = Question(scene, read_structure(scene.program), limits_of(scene), EGO)
    witness = decide(question).witness
    assert witness is not None
    return question, witness


def test_turns_are_taken_at_a_speed_that_they_admit() -> None:
    question, witness = answered(
        "E, N", "go", "A0(t1) == A1(t1)", "A1x(t1) == turn_start - 5", "A1x(t2) == turn_end + 5", "A1v(t1) >= 6"
    )
    profile = witness.profiles[1]
    states = [profile.state(t) for t in np.arange(0.0, profile.end_s, 0.02)]
    path = question.scene.routes[1].path
    assert max(v * v * abs(path.curvature(s)) for s, v, _ in states) <= question.limits[1].lateral_max_mpss + 1e-3


def test_what_holds_all_along_holds_between_moments() -> None:
    _, witness = answered(
        "W", "dec", "A0(t1) == A1(t1)", "A1x(t1) == A0x(t1) + 25", "always[A1(t0), A1(t2)] (A1v <= A0v - 1)"
    )
    ego, hero = (witness.profiles[a] for a in (0, 1))
    times = np.arange(0.0, hero.knot_times_s["t2"], 0.005)
    assert max(hero.state(t)[1] - ego.state(t)[1] for t in times) <= -1 + 5e-3


@pytest.mark.parametrize(
    "manner",
    [
        USUAL,
        replace(USUAL, settled_s=Fraction(3, 2), settled_mpss=Fraction(1, 5)),
        replace(USUAL, begins_mpss=Fraction(2), begins_s=Fraction(1), stands_s=Fraction(2), stands_mps=Fraction(1, 50)),
    ],
    ids=["usual", "long settled", "begins hard, stands long"],
)
def test_a_hero_is_settled_and_then_shows_what_begins_and_stands(manner: Manner) -> None:
    constraints = ("A0(t1) == A1(t1)", "A1x(t1) == conflict_point - 25", "A1v(t2) == 0")
    _, witness = answered("E, N", "dec", *constraints, manner=manner)
    hero = witness.profiles[1]
    trigger, stop = hero.knot_times_s["t1"], hero.knot_times_s["t2"]

    def during(first: float, last: float) -> list[tuple[float, float, float]]:
        return [hero.state(float(t)) for t in np.arange(first + 0.005, last - 0.004, 0.005)]

    assert min(rate for *_, rate in during(trigger - float(manner.settled_s), trigger)) >= -float(manner.settled_mpss)
    assert max(rate for *_, rate in during(trigger, trigger + float(manner.begins_s))) <= -float(manner.begins_mpss)
    assert max(speed for _, speed, _ in during(stop, stop + float(manner.stands_s))) <= float(manner.stands_mps)


def test_two_in_one_lane_do_not_touch_before_the_trigger() -> None:
    _, witness = answered(
        "W", "dec", "A0(t1) == A1(t1)", "A0x(t0) == A1x(t0) - 6", "gap(A0, A1, t1) == 40", "A1v(t2) == 0"
    )
    ego, hero = (witness.profiles[a] for a in (0, 1))
    times = np.arange(0.0, hero.knot_times_s["t1"], 0.01)
    assert min(hero.state(t)[0] - ego.state(t)[0] for t in times) >= 4.5 - 1e-3


def test_whoever_has_a_turn_ahead_starts_before_it() -> None:
    question, witness = answered("E, N", "acc", "A0(t1) == A1(t1)", "A1x(t1) == turn_end + 20")
    marks = question.scene.landmarks_m[1]
    assert witness.profiles[1].state(0.0)[0] <= 0.5 * (marks["turn_start"] + marks["turn_end"]) + 1e-3
