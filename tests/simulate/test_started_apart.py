"""What a program says of both vehicles at the start holds at the start, whatever the trigger is."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import Request

FOLLOWING = """
map "t_intersection"

Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
{initial}
A0(t1) == A1(t1)
{trigger}
A1a(dec) == -4
A1v(t2) == 0
"""


@pytest.mark.parametrize(
    ("initial", "trigger"),
    [
        ("gap(A0, A1, t0) == 40", "gap(A0, A1, t1) == 30"),
        ("gap(A0, A1, t0) == 40", "A1(t1) == 4"),
        ("gap(A0, A1, t0) == 40", "A1x(t1) == conflict_point - 30"),
        ("A1x(t0) - A0x(t0) == 40", "A1(t1) == 4"),
        ("A1v(t0) == A0v(t0)\ngap(A0, A1, t0) == 45", "A1(t1) == 3"),
        ("A1v(t0) == 12\ngap(A0, A1, t0) == 45", "A0(t1) - A0(t0) == 3"),
        ("A1v(t0) == 12\ngap(A0, A1, t0) == 45", "3 == A1(t1)"),
    ],
)
def test_both_at_the_start(initial: str, trigger: str) -> None:
    result = orchestrate(Request(FOLLOWING.format(initial=initial, trigger=trigger), {}, ego="idm", replan_hz=2.0))
    assert result.verdict is not None
    assert result.status == "success"
