"""A run that ends while somebody has something left to do says what it waited for."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import Request, Result
from stories import program

WAITS = program(
    "W",
    "t0, go, t1, dec, t2, stop, t3, acc, t4",
    """
A0(t1) == A1(t1)
A0x(t1) == stop_line - {ego_m}
A1x(t1) == conflict_point - {hero_m}
A1v(t2) == 0
A1x(t2) == conflict_point - {stands_m}
A0x(t2) == conflict_point
A0(t2) < A1(t3)
A1v(t4) == 6
""",
    ego_route="S, W",
)


def waited_for(ego_m: float, hero_m: float, stands_m: float) -> Result:
    text = WAITS.format(ego_m=ego_m, hero_m=hero_m, stands_m=stands_m)
    return orchestrate(Request(text, takes=1, replan_hz=4.0))


@pytest.mark.parametrize(("ego_m", "hero_m", "stands_m"), [(15, 28, 9), (15, 28, 2), (8, 40, 2)])
def test_where_each_waits_for_the_other_it_is_told_who_stands_in_the_way(
    ego_m: float, hero_m: float, stands_m: float
) -> None:
    """The one on the road stands until the ego has passed, and that one gives way to it, or cannot pass it."""
    verdict = waited_for(ego_m, hero_m, stands_m).verdict
    assert verdict is not None
    assert verdict.cause is not None
    assert verdict.cause.kind == "plan"
    assert verdict.cause.evidence["in_its_way"] == ["hero"]
    assert verdict.cause.text.startswith("The ego stood from ")
    assert "before the hero, who stood in its way, and the run ended at" in verdict.cause.text


def test_who_stands_clear_of_its_way_does_not_hold_it_up() -> None:
    assert waited_for(15, 40, 16).status == "success"
