"""Sabotage: real runs that succeeded, their traces doctored by as little as matters, are refused each time."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from scenewright.cli.app import app
from scenewright.judge.files import judge_run_directory, read_case
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.roads.load import load_map
from scenewright.roads.path import Path as RoadPath
from scenewright.roads.routes import all_routes, find_route
from scenewright.study.benchmark import benchmark_row, criteria_hold, criteria_of
from scenewright.study.cases import BenchCase, run_bench_case
from scenewright.trace.files import read_trace, write_trace
from scenewright.trace.model import ActorTrace, FloatArray, Trace

# A hero that crosses the ego's way and yields, by distance and by time; one that goes first after it has stood; a lead
# vehicle that brakes. By row: the ego, and parameters that it can do well.
STAGED = {
    16: ("constant", {"initial_ego": 90.0, "ego": 30.0, "end_hero": 6.0, "hero": 18.0}),
    56: ("constant", {"initial_ego": 9.0, "ego": 4.0, "end_hero": 6.0, "hero": 2.5}),
    4: ("idm", {"initial_ego": 50.0, "ego": 14.0, "end_hero": 6.0, "hero": 22.0}),
    15: ("constant", {"initial_ego": 110.0, "hero_decel": 3.0, "ego": 22.0}),
}


class Run:
    """A run directory, with what its trace is doctored by."""

    def __init__(self, row: int, directory: Path) -> None:
        self.row, self.directory = row, directory
        manifest = json.loads((directory / "manifest.json").read_text(encoding="utf-8"))
        verdict = judge_run_directory(directory)
        self.trigger_s = float(verdict.facts["trigger_time_s"]["hero"])
        self.knots_s = verdict.facts["knot_times_s"]["hero"]
        self.ego_knots_s = verdict.facts["knot_times_s"]["ego"]
        self.map = load_map(manifest["map"]["name"])
        self.paths: dict[str, RoadPath] = {
            name: find_route(self.map, lanes=route["lanes"]).path for name, route in manifest["routes"].items()
        }
        self.trace = read_trace(directory / "trace.parquet")

    @property
    def hero(self) -> ActorTrace:
        return self.trace.actors["hero"]

    def driven(self, s_m: FloatArray, speed_mps: FloatArray, actor: str = "hero") -> ActorTrace:
        """Return the actor's trace had it driven so: everything in it agrees, down to the map coordinates."""
        old = self.trace.actors[actor]
        x_m, y_m, heading = self.paths[actor].poses(s_m).T[:3]
        accel = np.append(np.diff(speed_mps) / np.diff(old.time_s), 0.0)
        return ActorTrace(old.time_s, x_m, y_m, heading, speed_mps, accel, s_m, np.zeros_like(s_m))

    def stopping(self, since_s: float, from_m: float, speed_mps: float, at_m: float) -> tuple[FloatArray, FloatArray]:
        """Return position and speed from an instant on for even braking to a standstill at a place."""
        rate = speed_mps**2 / (2 * (at_m - from_m))
        after = np.minimum(np.maximum(self.hero.time_s - since_s, 0.0), speed_mps / rate)
        return from_m + speed_mps * after - 0.5 * rate * after**2, speed_mps - rate * after

    def judged(self, folder: Path, actor: str, doctored: ActorTrace) -> Verdict:
        shutil.copytree(self.directory, folder)
        write_trace(Trace({**self.trace.actors, actor: doctored}), folder / "trace.parquet")
        return judge_run_directory(folder)


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Run]:
    """Successful runs, made as the experiment makes them, read from their files."""
    folder = tmp_path_factory.mktemp("results")
    made = {}
    for number, (ego, wanted) in STAGED.items():
        names = [parameter.name for parameter in benchmark_row(number).program.parameters]
        values = tuple((name, next(v for start, v in wanted.items() if name.startswith(start))) for name in names)
        case = BenchCase(number, ego, 0, "scenewright", 1, values, 3, folder, keep=True)
        record = run_bench_case(case)
        assert record.best_tight, (number, record.cause, record.failed_conditions, record.message)
        assert record.directory is not None
        made[number] = Run(number, folder / record.directory)
    return made


def failed(verdict: Verdict) -> dict[str, str]:
    return {c.id: c.kind for c in verdict.conditions if not c.holds_at(TIGHT)}


@pytest.mark.parametrize("row", STAGED)
def test_untouched_runs_pass(runs: dict[int, Run], row: int, tmp_path: Path) -> None:
    run = runs[row]
    assert run.judged(tmp_path / "same", "hero", run.hero).holds_at(TIGHT)
    rebuilt = run.driven(run.hero.s_m, run.hero.speed_mps)  # nor does it come from how the tests rebuild a trace
    assert run.judged(tmp_path / "rebuilt", "hero", rebuilt).holds_at(TIGHT)


# -- what is done to a trace ----------------------------------------------------------------------------------------
def trigger_late(run: Run) -> ActorTrace:
    """At the trigger the hero is 1.2 m further than asked for (in time: 0.3 s); it still stops where it should."""
    hero, moment = run.hero, run.trigger_s
    further_m = 1.2 if run.row != 56 else 0.3 * hero.speed(moment)
    s_m, speed = hero.s_m + further_m, hero.speed_mps.copy()
    later = hero.time_s >= moment
    place, v, end = hero.position(moment) + further_m, hero.speed(moment), float(hero.s_m[-1])
    braked = run.stopping(moment, place, v, end)
    s_m[later], speed[later] = braked[0][later], braked[1][later]
    return run.driven(s_m, speed)


def braking_early(run: Run) -> ActorTrace:
    """The hero brakes 0.4 s before the trigger, evenly, to the place where it should stop."""
    hero, moment = run.hero, run.trigger_s - 0.4
    s_m, speed = hero.s_m.copy(), hero.speed_mps.copy()
    later = hero.time_s >= moment
    braked = run.stopping(moment, hero.position(moment), hero.speed(moment), float(hero.s_m[-1]))
    s_m[later], speed[later] = braked[0][later], braked[1][later]
    return run.driven(s_m, speed)


def never_stops(run: Run) -> ActorTrace:
    """The hero brakes as it should, but crawls on at 1.2 m/s instead of standing."""
    hero = run.hero
    slow = (hero.time_s > run.trigger_s) & (hero.speed_mps < 1.2)
    speed = np.where(slow, 1.2, hero.speed_mps)
    steps = np.diff(hero.time_s) * (speed[:-1] + speed[1:]) / 2
    s_m = hero.s_m[0] + np.concatenate(([0.0], np.cumsum(steps)))
    return run.driven(s_m, speed)


def speed_jump(run: Run) -> ActorTrace:
    """A second before the trigger the hero is 3 m/s faster from one sample to the next, for half a second."""
    hero = run.hero
    inside = (hero.time_s > run.trigger_s - 1.0) & (hero.time_s < run.trigger_s - 0.5)
    speed = np.where(inside, hero.speed_mps + 3.0, hero.speed_mps)
    gained = np.cumsum(np.where(inside, 3.0, 0.0)) * 0.02
    return run.driven(hero.s_m + gained - gained[np.searchsorted(hero.time_s, run.trigger_s)], speed)


def speed_lie(run: Run) -> ActorTrace:
    """The same jump in the speeds alone: positions go on as if nothing was."""
    jumped = speed_jump(run)
    return replace(run.hero, speed_mps=jumped.speed_mps)


def wrong_route(run: Run) -> ActorTrace:
    """The hero takes another way through the junction, while its arc lengths say that it took its own."""
    own = run.paths["hero"]
    other = next(
        route.path
        for route in all_routes(run.map)
        if _apart_m(route.path, own, 0.0) < 1.0 and _apart_m(route.path, own, own.length_m) > 20.0
    )
    x_m, y_m, heading = other.poses(np.minimum(run.hero.s_m, other.length_m)).T[:3]
    return replace(run.hero, x_m=x_m, y_m=y_m, heading_rad=heading)


def _apart_m(one: RoadPath, other: RoadPath, s_m: float) -> float:
    a, b = (path.pose(min(s_m, path.length_m)) for path in (one, other))
    return float(np.hypot(a[0] - b[0], a[1] - b[1]))


def too_late_to_be_first(run: Run) -> ActorTrace:
    """The hero stands as long as it takes the ego to go first, then goes as it did."""
    hero = run.hero
    goes_s = float(run.knots_s["t3"])
    wait_s = float(run.ego_knots_s["t2"]) - float(run.knots_s["t4"]) + 1.0
    assert wait_s > 0.0
    times = np.where(hero.time_s < goes_s, hero.time_s, np.maximum(hero.time_s - wait_s, goes_s))
    s_m = np.array([hero.position(float(time_s)) for time_s in times])
    speed = np.array([hero.speed(float(time_s)) for time_s in times])
    return run.driven(s_m, speed)


Sabotage = Callable[[Run], ActorTrace]
# By sabotage: rows it is tried on, a kind of condition that must tell, whether the row's own criteria must tell too.
CATALOGUE: list[tuple[Sabotage, tuple[int, ...], str, bool]] = [
    (trigger_late, (16, 56), "trigger", True),
    (braking_early, (16,), "interaction", True),
    (braking_early, (56,), "trigger", True),  # it is 2 s from its place, and brakes, at two moments
    (never_stops, (16, 56, 15), "interaction", True),
    (speed_jump, (16, 56, 4, 15), "safety", False),
    (speed_lie, (16, 56, 4, 15), "safety", False),
    (wrong_route, (4,), "route", True),
    (wrong_route, (16, 56), "route", False),  # a hero that stops before it has turned is within criteria's bounds
    (too_late_to_be_first, (4,), "outcome", True),
]


@pytest.mark.parametrize(
    ("sabotage", "row", "kind", "criteria"),
    [
        pytest.param(sabotage, row, kind, criteria, id=f"{sabotage.__name__}-{row}")
        for sabotage, rows, kind, criteria in CATALOGUE
        for row in rows
    ],
)
def test_sabotage_is_refused(
    runs: dict[int, Run], sabotage: Sabotage, row: int, kind: str, criteria: bool, tmp_path: Path
) -> None:
    run, folder = runs[row], tmp_path / "doctored"
    verdict = run.judged(folder, "hero", sabotage(run))
    told = failed(verdict)
    assert not verdict.holds_at(TIGHT)
    assert kind in told.values(), told
    assert CliRunner().invoke(app, ["judge", str(folder)]).exit_code == 1
    if criteria:
        case = read_case(folder)
        measured = criteria_of(benchmark_row(row), case.parameters, case.trace, run.map)
        assert not criteria_hold(measured, TIGHT)


@pytest.mark.parametrize("sabotage", [never_stops, speed_jump, wrong_route])
def test_coarse_sabotage_is_refused_even_loosely(runs: dict[int, Run], sabotage: Sabotage, tmp_path: Path) -> None:
    assert not runs[16].judged(tmp_path / "doctored", "hero", sabotage(runs[16])).holds_at(LOOSE)


def test_wrong_order_is_told_as_such(runs: dict[int, Run], tmp_path: Path) -> None:
    run = runs[4]
    verdict = run.judged(tmp_path / "doctored", "hero", too_late_to_be_first(run))
    (order,) = (c for c in verdict.conditions if c.kind == "outcome" and "(margin" in c.text)
    assert " before the ego " in order.text
    assert not order.holds_at(LOOSE)


@pytest.mark.parametrize("row", [16, 15])
def test_collision_before_the_trigger_is_refused(runs: dict[int, Run], row: int, tmp_path: Path) -> None:
    run = runs[row]
    ego, hero = run.trace.actors["ego"], run.hero
    before = (hero.time_s > run.trigger_s - 1.0) & (hero.time_s < run.trigger_s - 0.8)
    onto = replace(
        hero,
        x_m=np.where(before, ego.x_m + 1.0, hero.x_m),
        y_m=np.where(before, ego.y_m + 0.5, hero.y_m),
    )
    verdict = run.judged(tmp_path / "doctored", "hero", onto)
    assert not verdict.condition("no_collision").holds_at(LOOSE)


def test_an_ego_that_was_elsewhere_is_refused(runs: dict[int, Run], tmp_path: Path) -> None:
    run = runs[16]
    ego = run.trace.actors["ego"]
    verdict = run.judged(tmp_path / "doctored", "ego", run.driven(ego.s_m - 3.0, ego.speed_mps, "ego"))
    assert "trigger" in failed(verdict).values()


def test_what_other_files_claim_does_not_help(runs: dict[int, Run], tmp_path: Path) -> None:
    run, folder = runs[16], tmp_path / "doctored"
    verdict = run.judged(folder, "hero", trigger_late(run))
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    manifest["knots"]["hero"]["t1"] += 0.07
    manifest["findings"] = ["everything went well"]
    (folder / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    assert json.loads((folder / "verdict.json").read_text(encoding="utf-8"))["success"]["tight"]  # of the true trace
    assert judge_run_directory(folder).as_dict() == verdict.as_dict()
