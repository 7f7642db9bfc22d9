"""A trigger some time after the ego was somewhere: it comes then, whatever the ego did before and does after."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import Request, orchestrate
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.solve.lags import Lag

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


@pytest.mark.parametrize("lag", [SAYS, "lag_s == A0(t2) - A0(t1)", "A0(t1) + lag_s == A0(t2)"])
def test_the_time_since_a_knot_is_read_however_it_is_written(lag: str) -> None:
    program = parse_program(PROGRAM.replace("{lag}", lag))
    scene = ground(program, load_map("t_intersection"), {"lag_s": 1.5})
    assert Lag.of(scene, read_structure(program), 1) == Lag("t1", 1.5)


OTHERS = ("A0(t2) - 2 * A0(t1) == lag_s", "A0(t2) - A0(t1) >= lag_s", "A0(t3) - A0(t1) == lag_s")


@pytest.mark.parametrize("lag", OTHERS)
def test_what_does_not_tell_the_trigger_is_no_lag(lag: str) -> None:
    program = parse_program(PROGRAM.replace("{lag}", lag))
    scene = ground(program, load_map("t_intersection"), {"lag_s": 1.5})
    assert Lag.of(scene, read_structure(program), 1) is None


@pytest.mark.parametrize(("ego", "lag_s"), [("idm", 2.0), ("noisy", 1.0), ("dawdler", 3.5)])
def test_the_trigger_comes_so_long_after(ego: str, lag_s: float) -> None:
    result = orchestrate(Request(PROGRAM.replace("{lag}", SAYS), {"lag_s": lag_s}, ego=ego, seed=1, budget_s=2.0))
    assert result.status == "success"
    assert result.run is not None
    hero = result.run.last_plan.profiles[1]
    assert hero.knot_times_s["t1"] - result.run.ego_knots_s["t1"] == pytest.approx(lag_s, abs=0.1)
