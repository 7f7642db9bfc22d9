"""Every failure has one cause, with the numbers it rests on; what is called the ego's doing comes with proof."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from scenewright.explain.cause import _denied, _Miss, _planned_so, cause_of
from scenewright.judge.files import cause_told, write_verdict
from scenewright.judge.tolerance import TIGHT, Leaf
from scenewright.judge.verdict import Cause, Condition, bounded
from scenewright.orchestrate import orchestrate, set_up
from scenewright.program.text import parse_program
from scenewright.request import Mode, Request, Result, Stages
from stories import STOPS_AHEAD, STORIES, driven, program

# Story, ego, further settings, and what it is.
CASES = [
    ("yields, distance", "answering:Stops", {}, "ego"),
    ("stops and goes", "speeder", {}, "ego"),
    ("goes first, time", "answering:Shy:keep_mps=5", {}, "way"),
    ("goes first, distance", "speeder", {}, "order"),
    ("yields, distance", "staller", {"mode": "open"}, "prediction"),
    ("yields, time", "answering:Swings", {"mode": "open"}, "prediction"),
]


def missed(story: str, ego: str, mode: Mode = "closed") -> Result:
    """Return a run that missed; who waits for an ego that stands re-solves often for nothing."""
    result = driven(story, ego, mode=mode, takes=1, replan_hz=1.0)
    assert result.status == "failure", "what is asked about is a run that missed"
    return result


def cause(result: Result) -> Cause:
    assert result.verdict is not None
    assert result.verdict.cause is not None
    return result.verdict.cause


@pytest.mark.parametrize(("story", "ego", "settings", "kind"), CASES)
def test_cause_is_of_the_kind_that_the_evidence_shows(
    story: str, ego: str, settings: dict[str, Mode], kind: str
) -> None:
    found = cause(missed(story, ego, **settings))
    assert found.kind == kind
    assert found.evidence
    assert found.text[0].isupper()
    assert found.text.endswith(".")
    assert found.would_do == (), "nothing is tried unless it is asked for"
    assert found.way_out() == ""


@pytest.mark.parametrize(("story", "ego", "settings", "kind"), CASES)
def test_only_a_proof_makes_it_the_egos_doing(story: str, ego: str, settings: dict[str, Mode], kind: str) -> None:
    result = missed(story, ego, **settings)
    assert ("proof" in cause(result).evidence) == (kind == "ego")
    if result.hindsight is not None and kind == "ego":
        assert cause(result).evidence["proof"] == [str(clash) for clash in result.hindsight.clashes]


def test_success_has_no_cause() -> None:
    result = driven("yields, distance", "idm", takes=1)
    assert result.verdict is not None
    assert (result.status, result.verdict.cause) == ("success", None)
    assert result.verdict.as_dict()["cause"] is None


def test_nothing_is_asked_where_nobody_wants_to_know() -> None:
    result = orchestrate(
        Request(STORIES["goes first, distance"], ego="speeder", takes=1, explain="nothing", replan_hz=1.0)
    )
    assert result.verdict is not None
    assert (result.status, result.verdict.cause, result.hindsight) == ("failure", None, None)


def test_cause_is_written_and_read_back(tmp_path: Path) -> None:
    result = missed("goes first, distance", "speeder")
    assert result.verdict is not None
    write_verdict(result.verdict, tmp_path / "verdict.json")
    assert cause_told(tmp_path) == cause(result)
    told = json.loads((tmp_path / "verdict.json").read_text(encoding="utf-8"))["cause"]
    assert (told["kind"], told["text"], told["would_do"]) == ("order", cause(result).text, [])
    (tmp_path / "verdict.json").write_text("{}", encoding="utf-8")
    assert cause_told(tmp_path) is None
    assert cause_told(tmp_path / "elsewhere") is None


def test_what_an_ego_alone_is_asked_for_is_its_own_to_miss() -> None:
    text = STORIES["yields, distance"] + "afterwards: A0v(t2) == 11\nA0x(t2) == conflict_point + 20\n"
    found = cause(orchestrate(Request(text, ego="answering:Heedless:keep_mps=10.5", takes=1, replan_hz=1.0)))
    assert (found.kind, found.evidence["condition"]) == ("ego", "afterwards")
    assert "the ego alone decides" in found.text.lower()


@pytest.mark.parametrize(("ego", "condition"), [("Strays", "route_ego"), ("States", "kin_ego_map_drift")])
def test_what_an_ego_owes_in_any_run_is_its_own_to_miss_and_no_number_mends_it(ego: str, condition: str) -> None:
    request = Request(STORIES["yields, distance"], ego=f"answering:{ego}", takes=1, replan_hz=1.0, explain="ways out")
    result = orchestrate(request)
    assert result.verdict is not None
    missed = {each.id for each in result.verdict.conditions if not each.holds_at(TIGHT)}
    found = cause(result)
    assert (found.kind, found.evidence["condition"] in missed, condition in missed) == ("ego", True, True)
    assert "owes in any run" in found.text
    assert (found.would_do, found.tried) == ((), 0)


@pytest.mark.parametrize(("actor", "whose"), [("ego", True), ("hero", False)])
def test_what_is_owed_is_only_the_egos_where_it_owes_it_and_was_seen_to_miss_it(actor: str, whose: bool) -> None:
    story = parse_program(STORIES["yields, distance"])
    owed = bounded("x", "safety", "x", required=0.0, measured=1.0, error=1.0, dimension="speed", owed_by=actor)
    assert (_denied(story, [owed], [], None) is not None) is whose
    assert _denied(story, [replace(owed, miss=None)], [], None) is None


@pytest.mark.parametrize(("failed", "whose"), [(("ego",), True), (("ego", "hero"), False)])
def test_a_moment_of_both_that_both_miss_is_not_the_egos_to_miss(failed: tuple[str, ...], whose: bool) -> None:
    """It is judged where it is nearest to either side: the ego may well have been at its place, a moment sooner."""
    second = "A0(t2) == A1(t2)\nego: A0x(t2) == conflict_point - 20\nhero: A1x(t2) == stop_line - 5\n"
    first = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 70\nA1x(t1) == stop_line - 30\n"
    told = parse_program(program("E, N", "t0, go, t1, dec, t2, go, t3", f"{first}{second}"))
    conditions = [Condition(each, "outcome", each, 20.0, 18.6, -1.4, "m", Leaf(1.4, "length")) for each in failed]
    found = _denied(told, conditions, [told.constraint(each) for each in failed], None)
    assert (found is not None) is whose


def test_when_a_moment_of_both_comes_is_not_the_egos_alone() -> None:
    """How long after the ego was at a place a hero acts is said of moments of the ego: one is the hero's, too."""
    asked = "A0x(t1) == stop_line - 60\nlater: A0(t2) - A0(t1) == 1.96\nA0(t2) == A1(t1)\nA1v(t2) == 0\n"
    told = parse_program(program("E, N", "t0, go, t1, dec, t2", asked))
    missed = Condition("later", "outcome", "later", 1.96, 1.3, -0.66, "s", Leaf(0.66, "time"))
    assert _denied(told, [missed], [told.constraint("later")], None) is None


@pytest.mark.parametrize(("name", "told"), [("start", "brakes with 6.0 m/s^2 at once"), ("c1", "no first plan")])
def test_a_run_that_fails_by_its_beginning_is_told_what_its_first_plan_gave_up(name: str, told: str) -> None:
    request = Request(STORIES["yields, distance"], ego="constant", takes=1, replan_hz=1.0)
    result, world = orchestrate(request), set_up(request, Stages(None))[0]
    run, verdict = result.run, result.verdict
    assert run is not None
    assert verdict is not None
    kind = "safety" if name == "start" else "initial"
    begun = bounded(name, kind, "begins", required=3.4, measured=6.0, error=2.6, dimension="acceleration")
    held = tuple(each for each in verdict.conditions if each.id != name)
    found = cause_of(world, run, replace(verdict, conditions=(*held, begun)), TIGHT, None)
    assert (found.kind, found.evidence["misses"]) == ("plan", name)
    assert told in found.text.lower()


BETWEEN = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2, go, t3]

Actor 1 (hero):
- E, N
- [t0, go, t1, go, t2]

Actor 2 (other):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0(t1) == A1(t1)
A0x(t1) == A0.conflict_point(A1) - 20
A1x(t1) == A1.conflict_point(A0) - 12
A0(t2) == A2(t1)
A0x(t2) == A0.conflict_point(A1) + 40
gap(A0, A2, t2) == 25
A2v(t2) == 0
"""


def test_who_drives_into_a_hero_after_its_trigger_spoils_what_others_were_to_do() -> None:
    found = orchestrate(Request(BETWEEN, ego="constant", takes=1, replan_hz=1.0))
    assert found.status == "failure"
    told = cause(found)
    assert (told.kind, told.evidence["hero"]) == ("ego", "hero")
    assert told.evidence["trigger_s"] < told.evidence["time_s"]
    assert "the ego hit the hero" in told.text.lower()


def test_a_run_that_ends_with_the_road_of_the_ego_says_so() -> None:
    program = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- S, W
- [t0, stop, t1, acc, t2]

Constraints:
A0x(t0) == A0.conflict_point - 100
A1x(t0) == stop_line - 2
A1(t1) == 30 s
A0v(A1(t1)) >= 5
A1v(t2) == 6
"""
    found = cause(orchestrate(Request(program, ego="constant", takes=1, replan_hz=1.0)))
    assert (found.kind, found.evidence["at_the_end_of_its_road"]) == ("plan", True)
    assert found.text.startswith("The ego came to the end of its road at ")


@pytest.mark.usefixtures("searched_less")
def test_where_all_that_was_asked_was_done_what_else_was_missed_is_told() -> None:
    """The program puts the lead so near that an ego which holds its speed drives into it before the trigger."""
    found = cause(orchestrate(Request(STOPS_AHEAD, ego="constant", takes=1, replan_hz=1.0)))
    assert "the ego collides with nobody before the trigger" in found.text
    assert "no plan was found" not in found.text


def test_what_was_to_last_and_was_broken_is_not_mended_by_a_later_plan() -> None:
    """The hero may not change its speed, so it cannot make up for an ego that is late."""
    program = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, go, t2]

Constraints:
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 12
always[A1(t0), A1(t2)] (A1v == 15 km/h)
A1x(t2) == conflict_point + 8
"""
    result = orchestrate(Request(program, ego="answering:Early", takes=1, replan_hz=1.0))
    assert result.run is not None
    found = cause(result)
    assert found.kind == "prediction"
    broken = max(result.run.replans, key=lambda tick: tick.tolerance)
    assert found.evidence["planned_s"] < broken.time_s


TOO_NEAR = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0v(t0) == 14
A0x(t0) == 100
A1x(t0) == 115
A1v(t0) == 4
A1(t1) == 4
A1a(dec) == -2
A1v(t2) == 0
"""


@pytest.mark.usefixtures("searched_less")
def test_what_comes_after_a_crash_is_not_told_as_its_cause() -> None:
    """The hero, at full acceleration from the start, comes to its greatest speed seconds after it was hit."""
    result = orchestrate(Request(TOO_NEAR, ego="constant", takes=1, replan_hz=1.0))
    assert result.status == "failure"
    assert result.verdict is not None
    assert result.verdict.aftermath.collision is not None
    told = cause(result)
    assert (told.kind, told.evidence["misses"]) == ("plan", "no_collision")
    assert told.evidence["time_s"] <= result.verdict.aftermath.collision.time_s
    assert result.verdict.aftermath.collision.in_words() in told.text


@pytest.mark.parametrize(
    ("by", "told"),
    [
        (0.1, "does all that was asked of the hero, as far as it was foreseen; what came of it misses"),
        (0.8, "does all that was asked of the hero but for 0.8 tight tolerances, as far as it was foreseen; what"),
        (1.3, "within its limits: the last one, of 1.0 s, missed by 1.3 tight tolerances, and what came of it misses"),
    ],
)
def test_a_plan_within_the_tight_tolerance_is_one_that_does_what_was_asked(by: float, told: str) -> None:
    result = driven("yields, distance", "constant")
    run, verdict = result.run, result.verdict
    assert run is not None
    assert verdict is not None
    tick = replace(run.replans[0], time_s=1.0, tolerance=by, foreseen=run.last_plan.profiles[0])
    off = bounded("c2", "trigger", "it is there", required=6.0, measured=6.53, error=0.53, dimension="length")
    world, _ = set_up(Request(STORIES["yields, distance"]), Stages(None))
    found = _planned_so(_Miss(world, replace(run, replans=[tick]), verdict, [off], None), 2.0)
    assert told in found.text
    assert found.text.endswith('misses "it is there" by 0.53 m')
