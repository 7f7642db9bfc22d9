"""What cannot happen is proven and not driven."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import EXIT_STATUS, Request
from stories import STORIES

TOO_FAST = STORIES["yields, distance"].replace(
    "A1x(t2) == conflict_point - 6", "fast: A1v(t1) == 14\nstops: A1x(t2) == conflict_point - 17"
)


@pytest.mark.usefixtures("nothing_proposed")
@pytest.mark.parametrize("ego", ["constant", "idm"])
def test_impossible_scenario_is_proven_and_not_driven(ego: str, tmp_path: Path) -> None:
    result = orchestrate(Request(TOO_FAST, ego=ego, out=tmp_path / "run"))
    assert (result.status, EXIT_STATUS[result.status]) == ("infeasible", 3)
    assert (result.attempt, result.run, result.verdict, result.run_directory) == (None, None, None, None)
    assert list((tmp_path / "run").iterdir()) == []
    assert result.feasibility is not None
    named = {clash.id for clash in result.feasibility.clashes}
    assert {"fast"} <= named, "14 m/s is more than the hero's turn admits"
    assert not named & {"c1"}, "where the ego starts has nothing to do with it"
    assert "A1v(t1) == 14" in {clash.formula for clash in result.feasibility.clashes}
