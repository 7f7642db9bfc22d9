"""Evaluation: every case is named, repeatable by its command, and counted under the cause of what came of it."""

from __future__ import annotations

import json
import shlex
from collections import Counter
from functools import cache
from pathlib import Path

import pytest
from typer.testing import CliRunner

from scenewright.cli.app import app
from scenewright.cli.bench_tables import outcome_data, outcome_tallies
from scenewright.errors import InputError, PolicyError, ScenewrightError
from scenewright.plan import planner
from scenewright.study.causes import CAUSES, INFEASIBLE
from scenewright.study.evaluation import (
    Case,
    Description,
    Outcome,
    in_order,
    make_cases,
    read_descriptions,
    run_case,
    run_cases,
    write_outcomes,
)
from scenewright.study.summary import Rate

YIELDS = Description(
    "yields",
    "The ego drives westbound and is 90 m before the intersection. An oncoming hero turns left into the driveway. "
    "When the ego is ego_gap_m before the conflict point and the hero is hero_gap_m before the conflict point, the "
    "hero brakes to a stop 6 m before the conflict point.",
)
BRAKES = Description(
    "brakes",
    "The ego drives westbound and is 120 m before the intersection. A hero is in front of the ego. When the ego is "
    "ego_gap_m behind the hero, the hero decelerates at hero_deceleration_mpss to a complete stop.",
)
GOES = Description(
    "goes",
    "The ego is on the driveway, 50 m behind the stop line, and turns right onto the road. A hero drives westbound on "
    "the road. When the ego is 14 m behind the stop line and the hero is 22 m behind the conflict point, the hero "
    "brakes to a stop 6 m before the conflict point. Then the hero accelerates to pass the conflict point before the "
    "ego begins to turn.",
)
FINE = {"ego_gap_m": 30.0, "hero_gap_m": 18.0}


def counted(description: Description, ego: str, hero_gap_m: float = 18.0) -> Outcome:
    """Return a case that was run, once for all tests that look at it, however they ask for it."""
    return _counted(description, ego, hero_gap_m)


@cache
def _counted(description: Description, ego: str, hero_gap_m: float) -> Outcome:
    parameters = {} if description is GOES else {**FINE, "hero_gap_m": hero_gap_m}
    return run_case(Case(description, ego, 1, 4, parameters, takes=1))


def outcome(description: str, ego: str, cause: str) -> Outcome:
    return Outcome(description, ego, 0, cause, (), (), 0.0, "")


def test_cases_are_all_combinations_and_draws_are_shared_by_egos() -> None:
    cases = make_cases([YIELDS, BRAKES], ["constant", "idm"], draws=3, seed=5)
    assert Counter((c.description.id, c.ego) for c in cases) == {
        (d, e): 3 for d in ("yields", "brakes") for e in ("constant", "idm")
    }
    by_draw: dict[tuple[str, int], list[Case]] = {}
    for case in cases:
        by_draw.setdefault((case.description.id, case.draw), []).append(case)
    for same in by_draw.values():
        assert same[0].parameters == same[1].parameters
        assert same[0].seed == same[1].seed == 5 + same[0].draw
    assert len({tuple(group[0].parameters.values()) for group in by_draw.values()}) == 6
    assert set(cases[0].parameters) == {"ego_gap_m", "hero_gap_m"}


def test_an_ego_that_does_not_exist_is_refused_before_anything_is_run() -> None:
    with pytest.raises(PolicyError, match="no such ego policy"):
        make_cases([YIELDS], ["idm", "nobody"], 1, 0)


def test_a_description_that_cannot_be_read_is_named() -> None:
    with pytest.raises(ScenewrightError) as refused:
        make_cases([YIELDS, Description("wheels", "Two wheels turn.")], ["idm"], 1, 0)
    assert str(refused.value).startswith("wheels:1:1: ")


def test_cases_depend_on_their_seed_alone() -> None:
    first, again, other = (make_cases([YIELDS], ["idm"], 2, seed) for seed in (5, 5, 6))
    assert first == again
    assert [c.parameters for c in first] != [c.parameters for c in other]


@pytest.mark.parametrize("takes", [1, 3])
def test_command_says_all_that_makes_the_case(takes: int) -> None:
    text = "The hero's way: \"oncoming\", turns left; $HOME `ls` isn't a command."
    case = Case(Description("x", text), "my folder/own.py:Ego:keep=7", 2, 9, {"a_m": 12.5, "b_s": 3.0}, takes)
    words = shlex.split(case.command())
    assert words[:3] == ["scenewright", "run", text]
    options = list(zip(words[3::2], words[4::2], strict=True))
    assert [value for name, value in options if name == "-p"] == ["a_m=12.5", "b_s=3.0"]
    assert dict(options)["--ego"] == case.ego
    assert dict(options)["--seed"] == "9"
    assert dict(options)["--translator"] == "offline", "whatever model is configured: none was asked"
    assert dict(options).get("--takes", "3") == str(takes)


@pytest.mark.usefixtures("nothing_proposed")
@pytest.mark.parametrize(
    ("description", "ego", "hero_gap_m", "exit_code"),
    [(YIELDS, "noisy", 18.0, 0), (GOES, "speeder", 18.0, 1), (YIELDS, "idm", 5.0, 3)],
)
def test_command_runs_the_case_again(
    description: Description,
    ego: str,
    hero_gap_m: float,
    exit_code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    result = counted(description, ego, hero_gap_m)
    words = shlex.split(result.command)
    # What is proven afterwards is in the outcome; the command is asked for what was driven.
    monkeypatch.setattr("scenewright.simulate.hindsight.ego_left_no_room", lambda *_: None)
    again = CliRunner().invoke(app, [*words[1:], "--no-ways-out", "--json", "--out", str(tmp_path / "run")])
    assert again.exit_code == exit_code
    assert (result.cause == "success") == (exit_code == 0)
    assert (result.cause == "proven infeasible") == (exit_code == 3)
    data = json.loads(again.stdout)
    failed = [c["id"] for c in (data["verdict"] or {"conditions": []})["conditions"] if not c["tight"]]
    assert tuple(failed) == result.failed_conditions


@pytest.mark.usefixtures("replanned_seldom")
def test_success_carries_its_times() -> None:
    result = counted(YIELDS, "noisy")
    assert result.cause == "success"
    assert (result.description, result.ego, result.draw) == ("yields", "noisy", 1)
    assert result.failed_conditions == ()
    assert result.simulated_s > 5.0
    assert result.solve_seconds
    assert all(seconds >= 0.0 for seconds in result.solve_seconds)
    assert result.parameters == FINE


@pytest.mark.usefixtures("nothing_proposed")
def test_case_that_cannot_be_is_proven_infeasible() -> None:
    result = counted(YIELDS, "idm", 5.0)
    assert result.cause == "proven infeasible"
    assert result.simulated_s == 0.0


@pytest.mark.usefixtures("replanned_seldom")
def test_case_that_the_ego_denies() -> None:
    result = counted(GOES, "speeder")
    assert result.cause == "ego left no room"
    assert result.failed_conditions


@pytest.mark.usefixtures("replanned_seldom")
def test_ego_that_never_comes_to_its_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "halting_ego.py").write_text(
        "class Halts:\n    def reset(self, start): pass\n\n    def step(self, observation, dt_s):\n"
        "        return -3.0 if observation.others and observation.time_s > 1.0 else 0.0\n"
    )
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("scenewright.simulate.ending._STALLED_S", 4.0)
    result = run_case(Case(YIELDS, "halting_ego:Halts", 0, 0, FINE, takes=1))
    assert result.cause == "ego never met the condition"


def test_gave_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner, "_FIRST_STEPS", 0)  # its first guess is no plan
    assert run_case(Case(YIELDS, "idm", 0, 0, FINE)).cause == "gave up"


def test_faults_are_errors_with_their_message(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "faulty_ego.py").write_text(
        "class Raises:\n    def reset(self, start): pass\n\n    def step(self, observation, dt_s):\n"
        "        return 1 / 0 if observation.others and observation.time_s > 1.0 else 0.0\n"
    )
    monkeypatch.chdir(tmp_path)
    no_policy = run_case(Case(YIELDS, "nobody", 0, 0, FINE))
    no_value = run_case(Case(YIELDS, "idm", 0, 0, {"no_such_m": 3.0}))
    on_the_way = run_case(Case(YIELDS, "faulty_ego:Raises", 0, 0, FINE))
    assert {result.cause for result in (no_policy, no_value, on_the_way)} == {"error"}
    assert "no such ego policy" in no_policy.message
    assert no_value.message
    assert "raised an exception" in on_the_way.message
    assert on_the_way.simulated_s == pytest.approx(1.0, abs=0.05)


def test_processes_change_nothing() -> None:
    cases = make_cases([YIELDS], ["constant", "noisy"], 1, 0, takes=1)
    alone, together = (in_order(run_cases(cases, workers), cases) for workers in (0, 2))

    def told(outcomes: list[Outcome]) -> list[tuple[object, ...]]:
        return [(o.description, o.ego, o.draw, o.cause, o.simulated_s, o.command) for o in outcomes]

    assert told(alone) == told(together)
    assert [(o.ego, o.draw) for o in alone] == [(c.ego, c.draw) for c in cases]


def test_tables_count_by_what_is_asked_and_in_all() -> None:
    outcomes = [
        outcome("a", "idm", "success"),
        outcome("a", "noisy", "missed"),
        outcome("b", "idm", "proven infeasible"),
        outcome("b", "noisy", "success"),
        outcome("b", "noisy", "ego left no room"),
    ]
    tables = outcome_tallies(outcomes)
    by_ego = {each.name: each for each in tables["ego"]}
    assert list(by_ego) == ["idm", "noisy", "all"]
    assert by_ego["idm"].causes["best"] == {"success": 1, "proven infeasible": 1}
    assert by_ego["noisy"].cases == 3
    assert {each.name: each.cases for each in tables["description"]} == {"a": 2, "b": 3, "all": 5}
    assert by_ego["all"].rate_without() == Rate(2, 5)
    assert by_ego["all"].rate_without(INFEASIBLE) == Rate(2, 4)
    data = outcome_data(by_ego["all"])
    assert (data["name"], data["total"], data["success"], data["missed"]) == ("all", 5, 2, 1)
    assert (data["tight"], data["tight_where_ego_let_it"]) == (2 / 4, pytest.approx(2 / 3))


def test_share_of_nothing_is_none() -> None:
    (nothing,) = outcome_tallies([])["ego"]
    assert (nothing.cases, nothing.rate_without().value) == (0, None)
    infeasible = outcome_tallies([outcome("a", "idm", "proven infeasible")])["ego"][-1]
    assert infeasible.rate_without(INFEASIBLE).value is None


def test_causes_have_their_place_in_tables() -> None:
    assert len(set(CAUSES)) == len(CAUSES)
    assert CAUSES[0] == "success"


def test_outcomes_are_written_as_lines(tmp_path: Path) -> None:
    outcomes = [outcome("a", "idm", "success"), outcome("ü", "idm", "missed")]
    write_outcomes(outcomes, tmp_path / "outcomes.jsonl")
    rows = [json.loads(line) for line in (tmp_path / "outcomes.jsonl").read_text(encoding="utf-8").splitlines()]
    assert [(row["description"], row["cause"]) for row in rows] == [("a", "success"), ("ü", "missed")]


def test_descriptions_from_json_folder_and_file(tmp_path: Path) -> None:
    listed = tmp_path / "texts.json"
    listed.write_text(json.dumps([{"id": 7, "text": "one", "more": 1}, {"id": "b", "text": "two"}]), encoding="utf-8")
    assert read_descriptions(listed) == [Description("7", "one"), Description("b", "two")]
    folder = tmp_path / "folder"
    folder.mkdir()
    (folder / "z.txt").write_text("last", encoding="utf-8")
    (folder / "a.txt").write_text("first", encoding="utf-8")
    (folder / "notes.md").write_text("no description", encoding="utf-8")
    assert read_descriptions(folder) == [Description("a", "first"), Description("z", "last")]
    assert read_descriptions(folder / "z.txt") == [Description("z", "last")]


@pytest.mark.parametrize(
    "content",
    [
        "{",
        "[]",
        '[{"id": 1, "text": "x"}, {"id": "1", "text": "y"}]',
        '{"id": 1, "text": "x"}',
        '[{"id": 1}]',
        "[1, 2]",
        '"text"',
        "null",
        "3",
    ],
)
def test_what_holds_no_descriptions_is_told(tmp_path: Path, content: str) -> None:
    path = tmp_path / "texts.json"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputError) as raised:
        read_descriptions(path)
    assert "texts.json" in str(raised.value)


def test_missing_empty_and_unreadable_places_are_told(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    (tmp_path / "latin.txt").write_bytes("Gefährt".encode("latin-1"))
    for name in ("nowhere", "nowhere.json", "empty", "latin.txt"):
        with pytest.raises(InputError) as raised:
            read_descriptions(tmp_path / name)
        assert name in str(raised.value)
