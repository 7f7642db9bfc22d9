"""Programs as small as can be: an ego, or one and a hero, with a line of a test's own."""

from __future__ import annotations

from scenarios import example
from scenewright.program.builder import Scenario, Vehicle
from scenewright.program.expressions import Formula
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.program.types import Program

HEAD = "Actor 0:\n- W\n- [t0, go, t1]\nConstraints:\n"
# The constraint under test stands in line 10 of this program.
FRAME = example("E, N", "t0, go, t1, dec, t2", "fault: {}")


def formula(text: str) -> Formula:
    """Return what a line of constraints says."""
    (constraint,) = parse_program(f"{HEAD}{text}\n").constraints
    return constraint.formula


DESCRIPTION = "When the ego is close, the car brakes."


def pair() -> tuple[Scenario, Vehicle, Vehicle]:
    scene = Scenario("oncoming left turner yields", map="t_intersection", description=DESCRIPTION)
    ego = scene.ego("W", sketch="t0 go t1 go t2")
    hero = scene.actor("hero", "E", "N", sketch="t0 go t1 dec t2")
    return scene, ego, hero


def survives(program: Program) -> None:
    text = print_program(program)
    assert parse_program(text) == program
    assert print_program(parse_program(text)) == text
