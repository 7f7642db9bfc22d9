"""Who has its trigger within its turn is slow enough all through the turn, not only at the trigger."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import Request, orchestrate
from scenewright.study.benchmark import benchmark_row, draw_row


@pytest.mark.parametrize(("row", "draw", "ego"), [(67, 2, "noisy"), (27, 1, "idm"), (36, 0, "staller")])
def test_lateral_acceleration_stays_within_its_limit(row: int, draw: int, ego: str) -> None:
    found = benchmark_row(row)
    result = orchestrate(
        Request(found.program_text, draw_row(found, draw, 0), ego=ego, seed=1000 * draw + row, takes=1)
    )
    assert result.verdict is not None
    lateral = next(condition for condition in result.verdict.conditions if condition.id == "kin_hero_lateral")
    assert lateral.measured is not None
    assert lateral.measured <= 6.0 + 1e-6
