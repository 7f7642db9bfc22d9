"""Counting: too many in too short a time are refuted and named, what can be driven never is, nor asked contact."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from many_heroes import PROGRAMS, program_of

from scenarios import limits_of
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.proofs.apart import APART, crowded
from scenewright.solve.proofs.decide import Question, decide
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.refuters import Answer, Capabilities

BEFORE_M, BEHIND_M, SINCE_S = 280.0, 290.0, 5.0
FASTEST_MPS = 18.0  # a little less than anybody may be


def through(windows: list[tuple[float, float]]) -> str:
    """Return a program of cars in one lane, each before a stretch until one time and beyond it from another on."""
    rows = [
        f"A{k}(t1) >= {since_s:.6f} s\nA{k}x(t1) <= {BEFORE_M}\nA{k}(t2) <= {until_s:.6f} s\nA{k}x(t2) >= {BEHIND_M}"
        for k, (since_s, until_s) in enumerate(windows, 1)
    ]
    return program_of("t0, go, t1", [("W", "t0, go, t1, go, t2")] * len(windows), rows)


def scene_of(text: str) -> Scene:
    program = parse_program(text)
    return ground(program, load_map(program.map_name), {})


def clash_of(text: str) -> tuple[str, ...]:
    scene = scene_of(text)
    events = Events(scene, limits_of(scene), EgoBounds())
    return crowded(events, Lowering(events).lower(scene.program.constraints))


def heroes_of(clash: tuple[str, ...]) -> set[int]:
    """Return whom a clash names: each has four constraints, in order."""
    return {(int(each.removeprefix("c")) - 1) // 4 + 1 for each in clash if each != APART}


@pytest.mark.parametrize("count", [4, 8, 12])
def test_who_is_too_many_is_named_and_nobody_else(count: int) -> None:
    covers_s = count * VEHICLE_LENGTH_M / FASTEST_MPS
    clash = clash_of(through([(SINCE_S, SINCE_S + 0.9 * covers_s)] * count + [(SINCE_S, 60.0), (1.0, 90.0)]))
    assert clash[-1] == APART
    assert heroes_of(clash) == set(range(1, count + 1))


@settings(max_examples=40)
@given(
    cars=st.lists(st.tuples(st.floats(2.0, FASTEST_MPS), st.floats(0.0, 0.5)), min_size=2, max_size=8),
    room_s=st.floats(0.0, 0.3),
)
def test_what_can_be_driven_is_never_refuted(cars: list[tuple[float, float]], room_s: float) -> None:
    """One after another at even speeds, each when the one before has left the stretch by its own length."""
    windows, now_s = [], SINCE_S
    for speed_mps, waits_s in cars:
        behind_s = now_s + (BEHIND_M - BEFORE_M) / speed_mps
        windows.append((now_s - room_s, behind_s + room_s))
        now_s += waits_s + (VEHICLE_LENGTH_M + BEHIND_M - BEFORE_M) / speed_mps
    assert not clash_of(through(windows))


@pytest.mark.parametrize("name", PROGRAMS)
def test_what_was_driven_is_not_refuted(name: str) -> None:
    assert not clash_of(PROGRAMS[name](8))


def test_who_is_to_be_in_contact_is_not_counted() -> None:
    rows = ["A1(t1) == A2(t1)", *(f"A{k}x(t1) == stop_line + {at_m}" for k, at_m in ((1, 16.4), (2, 11.5)))]
    rows += [f"A{k}(t1) == 5 s" for k in (1, 2)]
    heroes = [("E, N", "t0, go, t1, go, t2"), ("S, E", "t0, go, t1, go, t2")]
    assert not clash_of(program_of("t0, go, t1", heroes, rows))


class Unasked:
    """A solver that nobody is to ask."""

    name, capabilities = "unasked", Capabilities(exact=True)

    def ask(self, *_: object, **__: object) -> Answer:
        raise AssertionError("counting was enough")


def test_it_is_refuted_without_a_solver_and_named() -> None:
    scene = scene_of(through([(SINCE_S, SINCE_S + 1.2)] * 8))
    decision = decide(Question(scene, read_structure(scene.program), limits_of(scene), refuter=Unasked()))
    assert decision.answer == "infeasible"
    assert APART in decision.core


def test_who_was_asked_into_contact_may_drive_on_in_it() -> None:
    """The judge lets the contact of a pair pass all along where a trigger asks for it."""
    rows = ["A0(t1) == A1(t1)", "A0(t1) == A2(t1)", "A0x(t1) == 60", "A1x(t1) == 100\nA2x(t1) == 103"]
    rows += [f"A{k}(t2) - A{k}(t1) == 4\nA{k}x(t2) >= 172.2" for k in (1, 2)]
    heroes = [("W", "t0, go, t1, go, t2")] * 2
    assert not clash_of(program_of("t0, go, t1, go, t2", heroes, rows))
