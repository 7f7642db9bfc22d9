"""A trigger some time after the ego was somewhere: it comes then, whatever the ego did before and does after."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import Request

PROGRAM = """
parameters:
- lag_s

Actor 0 (ego):
- S, W
- [t0, go, t1, go, t2, go, t3]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0x(t0) == stop_line - 60
A0x(t1) == stop_line - 30
{lag}
A0(t2) == A1(t1)
A1x(t1) == conflict_point - 25
A1x(t2) == conflict_point - 6
A1v(t2) == 0
"""
SAYS = "A0(t2) - A0(t1) == lag_s"


@pytest.mark.parametrize(
    ("ego", "lag_s", "lag"),
    [
        ("idm", 2.0, SAYS),
        ("noisy", 1.0, SAYS),
        ("dawdler", 3.5, SAYS),
        ("idm", 1.5, "lag_s == A0(t2) - A0(t1)"),
        ("idm", 1.5, "A0(t1) + lag_s == A0(t2)"),
    ],
)
def test_the_trigger_comes_so_long_after(ego: str, lag_s: float, lag: str) -> None:
    result = orchestrate(Request(PROGRAM.replace("{lag}", lag), {"lag_s": lag_s}, ego=ego, seed=1, replan_hz=2.0))
    assert result.status == "success"
    assert result.run is not None
    hero = result.run.last_plan.profiles[1]
    assert hero.knot_times_s["t1"] - result.run.ego_knots_s["t1"] == pytest.approx(lag_s, abs=0.1)
