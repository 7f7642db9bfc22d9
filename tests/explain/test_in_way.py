"""Whether the ego slowed down for a hero: seen by how it drives without, and then never called the ego's doing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from scenewright.explain.in_way import InWay, hero_in_way
from scenewright.orchestrate import orchestrate, set_up
from scenewright.request import Request, Result, Stages
from stories import STORIES, driven, program

EXAMPLES = Path(__file__).parents[2] / "examples"


def looked_at(story: str, ego: str) -> tuple[InWay | None, Result]:
    result = driven(story, ego, takes=1, replan_hz=1.0)
    assert result.run is not None
    world, _ = set_up(Request(STORIES[story], ego=ego, takes=1), Stages(None))
    return hero_in_way(world, result.run), result


def test_who_stops_for_a_hero_is_not_to_blame() -> None:
    found, result = looked_at("goes first, time", "answering:Shy:keep_mps=5")
    assert found is not None
    assert found.hero == "hero"
    assert found.since_s <= found.time_s
    assert found.ego_mps < found.alone_mps
    assert found.apart_m <= 40.0
    assert result.status == "failure"
    assert result.verdict is not None
    assert result.verdict.cause is not None
    assert result.verdict.cause.kind == "way"
    assert "The ego slowed down for the hero before that was to be in its way" in result.verdict.cause.text


def test_until_the_ego_has_come_who_is_to_be_later_is_in_its_way() -> None:
    """After its trigger the hero creeps to where it is to pass 2 s after the ego, which brakes for it."""
    later = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 45\nA1x(t1) == conflict_point - 16\n"
    passes = "A0x(t2) == conflict_point\nA1x(t2) == conflict_point\nA1(t2) - A0(t2) == 2\n"
    result = orchestrate(
        Request(program("S, E", "t0, go, t1, go, t2", later + passes, "E"), ego="idm", takes=1, replan_hz=1.0)
    )
    assert result.status == "failure"
    assert result.verdict is not None
    assert result.verdict.cause is not None
    assert result.verdict.cause.kind == "way"


def test_who_is_kept_near_the_ego_is_where_it_is_to_be() -> None:
    """The ego follows a car that the program has 18 to 26 m ahead of it all the while: an answer to the test."""
    boxed_in = (EXAMPLES / "boxed_in.scene").read_text()
    request = Request(boxed_in, ego="stop-and-go", seed=1, takes=1, replan_hz=1.0)
    run, (world, _) = orchestrate(request).run, set_up(request, Stages(None))
    assert run is not None
    assert hero_in_way(world, run) is None
    # One that is to be no nearer than something may as well be further off.
    further = boxed_in.replace("gap(A0, A1) >= 18 and gap(A0, A1) <= 26", "gap(A0, A1) >= 18")
    world, _ = set_up(replace(request, source=further), Stages(None))
    found = hero_in_way(world, run)
    assert found is not None
    assert found.hero == "front"


def test_who_waits_for_one_that_acted_slowed_down_for_nobody_else() -> None:
    """The first hero stops where the ego has to stop for it, as it was told to; so the second's trigger never comes.

    One that is parked far down the road has no part in that.
    """
    text = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2, go, t3]

Actor 1 (turner):
- E, N
- [t0, go, t1, dec, t2]

Actor 2 (driveway):
- S, W
- [t0, go, t1, dec, t2]

Actor 3 (parked):
- W
- [t0, stop, t1]

Constraints:
A3x(t0) == route_end - 60
A3v(stop) == 0
A0(t1) == A1(t1)
A0x(t1) == A0.conflict_point(A1) - 34
A1x(t1) == A1.conflict_point(A0) - 8
A1v(t2) == 0
A1x(t2) == A1.conflict_point(A0) - 1
A0(t2) == A2(t1)
A0x(t2) == A0.conflict_point(A2) - 10
A2x(t1) == stop_line - 2
A2v(t2) == 0
"""
    result = orchestrate(Request(text, ego="delayed", takes=1, replan_hz=1.0))
    assert result.run is not None
    assert result.verdict is not None
    assert result.verdict.facts["trigger_came"] == {"turner": True, "driveway": False}
    assert result.verdict.cause is not None
    assert (result.verdict.cause.kind, result.verdict.cause.evidence["in_its_way"]) == ("plan", ["turner"])
    world, _ = set_up(Request(text, ego="delayed", takes=1), Stages(None))
    assert hero_in_way(world, result.run) is None


@pytest.mark.parametrize(
    ("story", "ego"),
    [
        ("yields, distance", "Early"),
        ("yields, time", "Shy"),
        ("stops and goes", "Early"),
        ("goes first, distance", "Shy"),
        ("goes first, time", "Early"),
        ("brakes at a rate", "Early"),
    ],
)
def test_no_answer_to_a_hero_is_ever_the_egos_doing(story: str, ego: str) -> None:
    found, result = looked_at(story, f"answering:{ego}")
    if result.status == "failure":
        assert result.verdict is not None
        assert result.verdict.cause is not None
        assert found is None or result.verdict.cause.kind != "ego"


@pytest.mark.parametrize(
    ("story", "ego"),
    [
        ("stops and goes", "Heedless"),
        ("stops and goes", "Stops"),
        ("yields, distance", "Creeps"),
        ("yields, distance", "Swings"),
    ],
)
def test_who_heeds_nobody_slowed_down_for_nobody(story: str, ego: str) -> None:
    assert looked_at(story, f"answering:{ego}")[0] is None


@pytest.mark.parametrize("seed", range(3))
def test_whims_are_nobodys_doing(seed: int) -> None:
    result = driven("yields, distance", "staller", seed, takes=1, replan_hz=1.0)
    assert result.run is not None
    world, _ = set_up(Request(STORIES["yields, distance"], ego="staller", seed=seed, takes=1), Stages(None))
    found = hero_in_way(world, result.run)
    ego = result.run.trace.actors["ego"]
    stood_s = ego.time_s[ego.speed_mps < 0.1]
    assert found is None or found.time_s not in stood_s or found.alone_mps > 1.0


def test_an_ego_that_stops_for_nobody_is_told_with_its_proof() -> None:
    found, result = looked_at("yields, distance", "answering:Stops")
    assert found is None
    assert result.verdict is not None
    assert result.verdict.cause is not None
    assert result.verdict.cause.kind == "ego"
    assert result.verdict.cause.evidence["off"] > 0.5


def test_nobody_slows_down_for_one_behind_where_another_is_ahead() -> None:
    """However near that one is: here it follows 12 m behind, the one that brakes is three times as far ahead."""
    text = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (behind):
- W
- [t0, go, t1]

Actor 2 (ahead):
- W
- [t0, dec, t1, acc, t2]

Constraints:
A0x(t0) == stop_line - 150
gap(A1, A0, t0) == 12
gap(A0, A2, t0) == 36
A0x(t1) == stop_line - 20
A0(t1) == A1(t1)
A0(t1) == A2(t1)
A2v(t1) == 3
A2v(t2) == 12
"""
    result = orchestrate(Request(text, ego="idm", takes=1, replan_hz=1.0))
    assert result.run is not None
    world, _ = set_up(Request(text, ego="idm", takes=1), Stages(None))
    found = hero_in_way(world, result.run)
    assert found is not None
    assert found.hero == "ahead"
