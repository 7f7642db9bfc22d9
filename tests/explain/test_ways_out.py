"""What is proposed has been tried, and does when it is done; the trying has an end."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from scenewright.explain.ways_out import ways_out
from scenewright.judge.tolerance import TIGHT, Leaf
from scenewright.judge.verdict import Cause, Condition, Verdict
from scenewright.orchestrate import orchestrate, set_up
from scenewright.program.types import Program
from scenewright.request import Request, Result, Stages
from scenewright.simulate.world import World
from stories import STORIES

WITH_NAME = STORIES["goes first, distance"].replace("conflict_point - 40", "conflict_point - ego_gap_m")


def missed(text: str, **settings: Any) -> Result:
    result = orchestrate(Request(text, ego="speeder", takes=1, replan_hz=1.0, **settings))
    assert result.status == "failure"
    assert result.verdict is not None
    return result


@cache
def verdict_to_mend() -> Verdict:
    """Return what is said of a run that missed, made once for all tests that only pretend to drive others."""
    verdict = missed(STORIES["goes first, distance"], explain="cause").verdict
    assert verdict is not None
    return verdict


def tried(
    happens: Callable[[Program, Mapping[str, float], Callable[[float], None]], bool],
) -> tuple[int, int, list[str]]:
    """Return how many were driven, how many are told to have been tried, and the values, where `happens` decides."""
    said, calls = list[str](), []

    def drive(program: Program, parameters: Mapping[str, float], progress: Callable[[float], None]) -> bool:
        calls.append((program, dict(parameters)))
        return happens(program, parameters, progress)

    world: World = set_up(Request(STORIES["goes first, distance"]), Stages(None))[0]
    _, count = ways_out(world.scene, verdict_to_mend(), TIGHT, drive, said.append)
    assert len(said) == len(set(said)) == len(calls), "each value is tried once, and told before"
    return len(calls), count, said


def test_written_number_that_is_proposed_would_do() -> None:
    said: list[str] = []
    request = Request(STORIES["goes first, distance"], ego="speeder", takes=1, replan_hz=1.0, explain="ways out")
    result = orchestrate(request, said.append)
    assert result.verdict is not None
    cause = result.verdict.cause
    assert cause is not None
    assert cause.would_do
    assert sum(each.startswith("trying ") for each in said) >= len(cause.would_do)
    for way in cause.would_do:
        number, formula = way.what.split(" in ")
        mended = request.source.replace(formula, re.sub(rf"{number}$", f"{way.value:g}", formula))
        assert mended != request.source
        assert orchestrate(Request(mended, ego="speeder")).status == "success"
        assert str(way) in cause.way_out()
        assert float(number) == way.instead_of


def test_parameter_that_is_proposed_would_do() -> None:
    result = missed(WITH_NAME, parameters={"ego_gap_m": 40}, explain="ways out")
    assert result.verdict is not None
    assert result.verdict.cause is not None
    named = [way for way in result.verdict.cause.would_do if way.parameter is not None]
    assert named
    for way in named:
        assert (way.parameter, way.instead_of, way.unit) == ("ego_gap_m", 40.0, "m")
        again = Request(WITH_NAME, {"ego_gap_m": way.value}, ego="speeder")
        assert orchestrate(again).status == "success"


def test_what_never_came_is_no_number_to_try() -> None:
    """A time that was asked for and never came is measured as endless."""
    world: World = set_up(Request(STORIES["goes first, distance"]), Stages(None))[0]
    verdict = verdict_to_mend()
    never = tuple(replace(each, required=40.0, measured=math.inf, miss=None) for each in verdict.conditions)
    endless = replace(verdict, conditions=never)
    said: list[str] = []
    ways_out(world.scene, endless, TIGHT, lambda *_: False, said.append)
    assert said
    assert not any("inf" in each for each in said)


@pytest.mark.parametrize("came", [True, False])
def test_what_was_measured_at_a_trigger_is_tried_where_it_came(came: bool) -> None:
    """To within the loose tolerance; the ego may never have been at all of its side."""
    text = STORIES["goes first, distance"] + "probe: A0v(t1) == 6\n"
    world: World = set_up(Request(text), Stages(None))[0]
    whole = verdict_to_mend()
    probe = Condition("probe", "trigger", "", 6.0, 6.6, 0.6, "m/s", Leaf(0.6, "speed"))
    facts = {**whole.facts, "trigger_came": {"hero": came}, "ego_never_met_condition": True}
    verdict = replace(whole, cause=Cause("ego", "", {}), conditions=(*whole.conditions, probe), facts=facts)
    said: list[str] = []
    ways_out(world.scene, verdict, TIGHT, lambda *_: False, said.append)
    assert any("6.6 m/s" in each for each in said) is came


def test_how_near_two_came_to_a_trigger_that_never_came_is_tried() -> None:
    """An ego that keeps a longer headway than is asked for comes no nearer, whatever the hero does."""
    world: World = set_up(Request(STORIES["goes first, distance"] + "probe: A0v(t1) - A1v(t1) == 2\n"), Stages(None))[0]
    whole = verdict_to_mend()
    probe = Condition("probe", "trigger", "", 2.0, 3.4, 1.4, "m/s", Leaf(1.4, "speed"))
    facts = {**whole.facts, "trigger_came": {"hero": False}}
    verdict = replace(whole, cause=Cause("plan", "", {}), conditions=(*whole.conditions, probe), facts=facts)
    said: list[str] = []
    ways_out(world.scene, verdict, TIGHT, lambda *_: False, said.append)
    assert "3.4 m/s" in said[0]


def test_what_was_off_by_tolerances_is_tried_in_the_unit_of_the_number() -> None:
    """Of what lasts, and of alternatives, a verdict knows no number that was measured."""
    text = STORIES["goes first, distance"] + "probe: always[A0(t0), A0(t1)] (A0v <= 6)\n"
    world: World = set_up(Request(text), Stages(None))[0]
    for off, first in ((8.0, "8 m/s"), (math.inf, "9 m/s")):
        cause, whole = Cause("ego", "", {"condition": "probe", "off_tolerances": off}), verdict_to_mend()
        probe = Condition("probe", "outcome", "", None, None, off, "", Leaf(0.25 * off, "speed"))
        verdict = replace(whole, cause=cause, conditions=(*whole.conditions, probe))
        said: list[str] = []
        ways_out(world.scene, verdict, TIGHT, lambda *_: False, said.append)
        assert first in said[0]


def test_trying_ends_after_some_and_says_how_many() -> None:
    driven, told, _ = tried(lambda *_: False)
    assert 1 < driven == told <= 6


def test_trying_ends_once_enough_do() -> None:
    driven, told, _ = tried(lambda *_: True)
    assert driven == told == 1


def test_trying_ends_with_the_simulated_time() -> None:
    def for_long(_: Program, __: Mapping[str, float], progress: Callable[[float], None]) -> bool:
        for tenth in range(1, 401):
            progress(0.1 * tenth)
        return False

    driven, told, _ = tried(for_long)
    assert (driven, told) == (4, 3), "the last is not driven to its end"


def test_one_that_takes_long_leaves_time_for_others() -> None:
    """It is not told to have been tried, for nobody knows what would have come of it."""
    calls: list[int] = []

    def first_for_long(_: Program, __: Mapping[str, float], progress: Callable[[float], None]) -> bool:
        calls.append(1)
        for tenth in range(1, 1201 if len(calls) == 1 else 101):
            progress(0.1 * tenth)
        return len(calls) > 1

    driven, told, _ = tried(first_for_long)
    assert (driven, told) == (2, 1)


def test_who_interrupts_wants_no_more() -> None:
    def interrupted(*_: object) -> bool:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tried(interrupted)


@pytest.mark.parametrize("count", [0, 3])
def test_none_that_would_do_is_said(count: int) -> None:
    told = Cause("order", "Late.", {}, (), count).way_out()
    assert told == ("Other numbers tried: 3; none would do." if count else "")
