"""The evaluator: by how much a formula is violated on given motions, apart from any solver."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import pytest

from scenewright.program.evaluate import violation
from scenewright.program.expressions import Formula, Order
from scenewright.program.resolve import resolve
from scenewright.program.text import parse_program
from scenewright.program.types import Program

HEAD = "Actor 0:\n- W\n- [t0, go, t1]\nActor 1:\n- W\n- [t0, go, t1]\nConstraints:\n"


def formula(text: str) -> Formula:
    (constraint,) = resolve(parse_program(f"{HEAD}{text}\n")).constraints
    return constraint.formula


@dataclass
class Straight:
    """Ego: 10 m/s from 0. Actor 1: 20 m ahead at 6 m/s, braking at 1 m/s^2. Its arc lengths are 100 m greater."""

    offset: float = -100.0
    motions: dict[int, tuple[Callable[[float], float], ...]] = field(
        default_factory=lambda: {
            0: (lambda t: 10 * t, lambda t: 10.0, lambda t: 0.0),
            1: (lambda t: 120 + 6 * t - 0.5 * t * t, lambda t: 6 - t, lambda t: -1.0),
        }
    )
    program: Program = field(default_factory=lambda: parse_program(f"{HEAD}A0(t0) == 0\n"))
    parameters: Mapping[str, float] = field(default_factory=lambda: {"p_m": 7.0})
    between_m: float = 4.0

    def state(self, actor: int, order: Order, time_s: float) -> float:
        return self.motions[actor][order](time_s)

    def changes_s(self) -> tuple[float, ...]:
        return ()

    @property
    def scene(self) -> Straight:
        return self

    def knot_time_s(self, actor: int, knot: str) -> float:
        return {"t0": 0.0, "t1": 2.0 + actor}.get(knot, math.inf)

    def landmark_m(self, actor: int, name: str, other: int | None) -> float:
        return {0: 50.0, 1: 150.0}[actor]

    def offset_m(self, actor: int, other: int) -> float:
        return self.offset if (actor, other) == (0, 1) else -self.offset


@pytest.mark.parametrize(
    ("text", "off"),
    [
        ("A0x(t1) == 20", 0.0),
        ("A0x(t1) == 23", 3.0),
        ("A0x(t1) <= 23", -3.0),
        ("A0x(t1) >= 23", 3.0),
        ("A0x(t1) < p_m", 13.0),
        ("A0x(t1) == stop_line - 30", 0.0),
        ("A0x(t1) == A1.stop_line - 30", 0.0),
        ("A1v(A0(t1)) == 4", 0.0),
        ("A1v(1.5) == 4.5", 0.0),
        ("A1a(go) == -1", 0.0),
        ("A1(t1) == A0(t1) + 1", 0.0),
        ("A1x(0) - A0x(0) == 20", 0.0),
        ("A0x(0) - A1x(0) == -20", 0.0),
        ("A1x(0) == A0x(0) + 20", 0.0),
        ("A1x(0) - 15 >= A0x(0)", -5.0),
        ("A1x(0) - 15 - A0x(0) <= 6", -1.0),
        ("(A1x(0) - A0x(0)) / A0v(0) == 2", 0.0),
        ("A1x(0) - A1.stop_line == A0x(0) - A0.stop_line + 20", 0.0),
        ("gap(A0, A1, 0) == 20", 0.0),
        ("gap(A1, A0, 0) == -20", 0.0),
        ("headway(A0, A1, 0) == 1.6", 0.0),
        ("freespace(A0, A1, 0) == gap(A0, A1, 0) - 4", 0.0),
        ("ttc(A0, A1, 0) == 4", 0.0),
        ("tta(A0, stop_line, t1) == 3", 0.0),
        ("tta(A0, A1.stop_line, t1) == 3", 0.0),
        ("ttc(A1, A0, 0) == 4", 0.0),
        ("-A0v(0) * 2 / 4 == -5", 0.0),
        ("A0v(0) + A1v(0) - 1 == 15", 0.0),
        ("A0v(0) / 0 == 1", math.inf),
        ("A0v(0) == 10 and A1v(0) == 5", 1.0),
        ("A0v(0) == 12 or A1v(0) == 5", 1.0),
        ("not A0v(0) < 12", 2.0),
        ("A0v(0) > 12 implies A1v(0) == 1", -2.0),
        ("A0v(0) > 8 implies A1v(0) == 1", 2.0),
        ("always[0, 4](A1v >= 3)", 1.0),
        ("always[0, 3](A1v >= 3)", 0.0),
        ("never[0, 4](A1v <= 3)", 1.0),
        ("eventually[0, 4](A1v <= 3)", -1.0),
        ("always[A0(t0), A0(t1)](gap(A0, A1) >= 9)", -1.0),
        ("eventually[2, 1](A1v <= 4)", math.inf),
    ],
)
def test_violations(text: str, off: float) -> None:
    assert violation(formula(text), Straight()) == pytest.approx(off, abs=1e-6)


@pytest.mark.parametrize(("operator", "holds"), [("always", True), ("never", False), ("eventually", True)])
def test_the_pieces_around_an_interval_are_not_part_of_it(operator: str, holds: bool) -> None:
    """A car that brakes from 2 s to 4 s brakes all through that time, though at 4 s it has stopped braking."""
    world = Straight()
    world.motions[1] = (lambda t: 0.0, lambda t: 0.0, lambda t: -2.0 if 2.0 <= t < 4.0 else 0.0)
    assert (violation(formula(f"{operator}[2, 4](A1a <= -1)"), world) <= 0) is holds
    assert (violation(formula(f"{operator}[2, 4](A1a >= -1)"), world) <= 0) is (operator == "never")


def test_a_knot_that_never_comes_is_no_match() -> None:
    assert violation(formula("A0(t9) == 3"), Straight()) == math.inf
    assert violation(formula("A0(t9) <= 3"), Straight()) == math.inf
    assert violation(formula("A0(t1) < A1(t9)"), Straight()) == -math.inf
    assert violation(formula("always[0, A0(t9)](A0v > 0)"), Straight()) == math.inf


def test_a_landmark_that_belongs_to_nobody_and_a_state_without_a_moment_are_refused() -> None:
    with pytest.raises(ValueError, match="belongs to no one"):
        violation(formula("stop_line == 3"), Straight())
    with pytest.raises(ValueError, match="only inside always"):
        violation(formula("A0v == 3"), Straight())
