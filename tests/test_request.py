"""What is asked for is looked at where it is asked: a word that nobody knows is not taken for another one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scenewright.errors import InputError
from scenewright.program.builder import Scenario
from scenewright.request import Request


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("mode", "opened", "'closed', 'open'"),
        ("tolerance", "exact", "'tight', 'loose'"),  # was judged as loose is
        ("aim", "best", "None, 'fine', 'tight', 'loose', 'coarse'"),
        ("explain", "all", "'nothing', 'cause', 'ways out'"),
        ("planner", "best", "'convex', 'smt'"),
        ("seed", -1, "a whole number from 0"),
        ("seed", "3", "a whole number from 0"),
        ("seed", 1.5, "a whole number from 0"),
        ("takes", 0, "a whole number from 1 to 20"),
        ("replan_hz", 0, "a number from 0.1 to 50"),
        ("replan_hz", float("nan"), "a number from 0.1 to 50"),
        ("ego", Path, "a text"),
        ("source", Scenario("one"), "scene.text()"),
    ],
)
def test_what_is_none_of_those_that_there_are_is_refused(name: str, value: object, expected: str) -> None:
    asked: dict[str, Any] = {"source": "a text", name: value}
    with pytest.raises(InputError) as caught:
        Request(**asked)
    assert name in caught.value.message
    assert expected in (caught.value.expected or "")


def test_paths_and_numbers_may_be_of_any_type() -> None:
    asked: dict[str, Any] = {"source": Path("a.scene"), "out": "runs/a", "seed": np.int64(3), "replan_hz": 20}
    request = Request(**asked)
    assert (request.source, request.out, request.replan_hz) == ("a.scene", Path("runs/a"), 20.0)
    assert type(request.seed) is int  # it is written down as JSON
