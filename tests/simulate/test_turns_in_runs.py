"""Who has its trigger within its turn is slow enough all through the turn, not only at the trigger."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import Request
from scenewright.study.benchmark import benchmark_row, draw_row


@pytest.mark.parametrize(
    ("row", "draw", "draws_seed", "ego"),
    [
        (67, 2, 0, "noisy"),
        (27, 1, 0, "idm"),
        (36, 0, 0, "staller"),
        (68, 1, 7, "noisy"),  # it was fast on its way, and its trigger comes later than planned, within its turn
        (28, 1, 34, "stop-and-go"),
        (14, 0, 10100, "constant"),  # it brakes hard into its turn: between two nodes of its plan it was too fast
    ],
)
def test_lateral_acceleration_stays_within_its_limit(row: int, draw: int, draws_seed: int, ego: str) -> None:
    found = benchmark_row(row)
    seed = draws_seed + 1000 * draw + row
    values = draw_row(found, draw, draws_seed)
    result = orchestrate(Request(found.program_text, values, ego=ego, seed=seed, takes=1, explain="nothing"))
    assert result.verdict is not None
    lateral = next(condition for condition in result.verdict.conditions if condition.id == "kin_hero_lateral")
    assert lateral.measured is not None
    assert lateral.measured <= 6.0 + 1e-6
