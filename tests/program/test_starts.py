"""Whether a program says how near two begin: in time it always does, in metres only with a speed."""

from __future__ import annotations

import pytest

from scenewright.program.resolve import resolve
from scenewright.program.starts import HARD_MPSS, kept_m, says_how_near
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program

PROGRAM = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (lead):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0(t1) == A1(t1)
gap(A0, A1, t1) == 20
A0v(t1) == 10
{said}
"""


@pytest.mark.parametrize(
    ("said", "ego", "lead"),
    [
        ("A1v(t2) == 0", False, False),
        ("headway(A0, A1, t0) == 2", True, True),
        ("ttc(A1, A0, t0) == 2", True, True),
        ("headway(A0, A1, t0) <= 2", False, False),
        ("tta(A0, route_end, t0) == 20\ntta(A1, route_end, t0) == 19", True, True),
        ("tta(A0, route_end, t0) == 20", False, False),
        ("gap(A0, A1, t0) == 9\nA0v(t0) == 12", True, False),  # how fast the other is is open
        ("A0x(t0) == 100\nA1x(t0) == 109\nA1v(t0) == 12", False, True),
        ("A0x(t0) == 100\nA0v(t0) == 12", False, False),
    ],
)
def test_what_is_said_of_the_start(said: str, ego: bool, lead: bool) -> None:
    program = resolve(parse_program(PROGRAM.format(said=said)))
    structure = read_structure(program)
    assert (says_how_near(program, structure, 0, 1), says_how_near(program, structure, 1, 0)) == (ego, lead)


@pytest.mark.parametrize(("speed_mps", "closing_mps"), [(14.0, 0.0), (14.0, 5.0), (14.0, 14.0), (20.0, 8.0)])
def test_room_is_a_seconds_way_and_enough_to_brake_after_a_second(speed_mps: float, closing_mps: float) -> None:
    room_m = kept_m(speed_mps, closing_mps)
    assert room_m >= speed_mps
    left_m = room_m - closing_mps  # after a second
    assert closing_mps**2 <= 2.0 * HARD_MPSS * left_m + 1e-9
