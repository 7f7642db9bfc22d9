"""A run that ends while somebody has something left to do says what it waited for."""

from __future__ import annotations

from dataclasses import replace

import pytest

from scenewright.explain.cause import cause_of
from scenewright.explain.cut_short import ego_stood
from scenewright.judge.aftermath import Collision
from scenewright.judge.tolerance import TIGHT, Leaf
from scenewright.judge.verdict import Condition
from scenewright.orchestrate import orchestrate, set_up
from scenewright.request import Request, Result, Stages
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
    return orchestrate(Request(text, takes=1, replan_hz=1.0))


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


STANDS = """
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 40
A1x(t1) == conflict_point - 10
A1v(t2) == 0
A0x(t2) == conflict_point
"""


def test_an_ego_that_stands_before_a_hero_did_not_decide_on_that_alone() -> None:
    """The hero stops where the ego is to pass: that it does not pass, and how fast, is not the ego's doing."""
    text = program("E, N", "t0, go, t1, dec, t2", STANDS + "A1x(t2) == conflict_point - 1\nA0v(t2) >= 8\n")
    request = Request(text, takes=1, replan_hz=1.0)
    result = orchestrate(request)
    verdict = result.verdict
    assert verdict is not None
    assert verdict.cause is not None
    assert verdict.cause.kind == "plan"
    assert verdict.cause.evidence["in_its_way"] == ["hero"]
    assert verdict.cause.text.endswith(
        's on, before the hero, who stood in its way: "the ego drives at a speed of at least 8 m/s when it passes the '
        'conflict point" never came.'
    )
    # Nor is it where something else was missed, too.
    assert result.run is not None
    other = Condition("other", "interaction", "another", 1.0, 2.0, 1.0, "m", Leaf(1.0, "length"))
    more = replace(verdict, conditions=(*verdict.conditions, other))
    world, _ = set_up(request, Stages(None))
    assert cause_of(world, result.run, more, TIGHT, None).kind != "ego"
    # Who stands where it has hit somebody waits for nobody.
    missed = [each for each in verdict.conditions if not each.holds_at(TIGHT)]
    assert ego_stood(world, result.run, verdict, missed, None) is not None
    hit = replace(verdict.aftermath, collision=Collision(1.0, ("ego", "hero"), (8.0, 0.0), 8.0))
    assert ego_stood(world, result.run, replace(verdict, aftermath=hit), missed, None) is None


def test_an_ego_that_stands_for_nobody_is_the_cause() -> None:
    """Here it does after its trigger, and what it is to come to first never comes."""
    text = program("E, N", "t0, go, t1, dec, t2", STANDS + "A0x(t0) == conflict_point - 60\nA0(t2) < A1(t2)\n")
    verdict = orchestrate(Request(text, ego="answering:Stops", takes=1, replan_hz=1.0)).verdict
    assert verdict is not None
    assert verdict.cause is not None
    assert verdict.cause.kind == "ego"
    assert verdict.cause.evidence["in_its_way"] == []
    assert "s on, as it does alone on its road" in verdict.cause.text
