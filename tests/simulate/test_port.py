"""The port of simulators: what it helps adapters with, whom it finds, and whole runs in others than the built-in."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

import toys
from scenewright.errors import InputError, SimulatorError
from scenewright.judge.files import judge_run_directory
from scenewright.motion.profile import Profile
from scenewright.orchestrate import orchestrate
from scenewright.program.types import EGO
from scenewright.request import EXIT_STATUS, Request, Result
from scenewright.simulate.port import GROUP, SIMULATORS, Capabilities, Snapshot, Start, at_pose, on_route
from scenewright.trace.files import read_trace
from stories import STORIES, Scripted, Stage

LOST_S = 3.0


class IsLost(toys.Bicycles):
    """The connection to it breaks off."""

    closed = 0

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        if self.time_s >= LOST_S:
            raise ConnectionResetError("nobody there")
        super().apply(heroes)

    def close(self) -> None:
        IsLost.closed += 1


class CannotStart(toys.Bicycles):
    def reset(self, start: Start, step_s: float) -> None:
        raise ConnectionRefusedError("nobody answers")


class Late(toys.Bicycles):
    """Shows something else than it should after a while."""

    def observe(self) -> Snapshot:
        now = super().observe()
        return now if now.time_s < LOST_S - 0.01 else self.show(now)

    def show(self, now: Snapshot) -> Snapshot:
        raise NotImplementedError


class LosesTheEgo(Late):
    def show(self, now: Snapshot) -> Snapshot:
        return Snapshot(now.time_s, {actor: state for actor, state in now.actors.items() if actor != EGO})


class IsNowhere(Late):
    def show(self, now: Snapshot) -> Snapshot:
        return Snapshot(now.time_s, {**now.actors, EGO: now.actors[EGO]._replace(speed_mps=float("nan"))})


class ShowsNothing(Late):
    def show(self, now: Snapshot) -> Snapshot:
        return None  # type: ignore[return-value]


class ShowsNumbers(Late):
    def show(self, now: Snapshot) -> Snapshot:
        return Snapshot(now.time_s, {actor: tuple(state) for actor, state in now.actors.items()})  # type: ignore[misc]


class StandsStill(Late):
    def show(self, now: Snapshot) -> Snapshot:
        return Snapshot(LOST_S - 0.02, now.actors)


class EndsTheProcess(Late):
    def show(self, now: Snapshot) -> Snapshot:
        raise SystemExit(5)


class IsNotClosed(toys.Bicycles):
    def close(self) -> None:
        raise ConnectionResetError("still there")


class StartsOnce(toys.Bicycles):
    """Starts for one take that misses, and never again."""

    capabilities = Capabilities(place_error_m=9.0, speed_error_mps=9.0)

    def reset(self, start: Start, step_s: float) -> None:
        if hasattr(self, "cars"):
            raise ConnectionRefusedError("only once")
        super().reset(start, step_s)

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        super().apply(heroes)
        self.motions = {}


LATE = (LosesTheEgo, IsNowhere, ShowsNothing, ShowsNumbers, StandsStill, EndsTheProcess)


@pytest.fixture(autouse=True)
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Somebody else's package, which offers the simulators of these tests."""
    about = tmp_path / "toys-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: toys\nVersion: 1.0\n")
    for each in (IsLost, CannotStart, IsNotClosed, StartsOnce, *LATE):
        monkeypatch.setattr(toys, each.__name__, each, raising=False)
    offered = {"bicycles": "Bicycles", "stack": "OwnStack", "lost": "IsLost", "away": "CannotStart"}
    offered |= {each.__name__.lower(): each.__name__ for each in (IsNotClosed, StartsOnce, *LATE)}
    lines = [f"[{GROUP}]", *(f"{name} = toys:{each}" for name, each in offered.items())]
    (about / "entry_points.txt").write_text("\n".join(lines))
    monkeypatch.syspath_prepend(tmp_path)


def run(simulator: str, out: Path, story: str = "yields, distance") -> Result:
    return orchestrate(Request(STORIES[story], simulator=simulator, takes=1, out=out, replan_hz=2.0))


def manifest(out: Path) -> dict[str, object]:
    return dict(json.loads((out / "manifest.json").read_text(encoding="utf-8")))


# -- the parts of the port --------------------------------------------------------------------------------------------
def test_a_pose_and_a_place_on_the_route_say_the_same() -> None:
    route = Stage(STORIES["yields, distance"], Scripted(lambda time_s, speed_mps: 0.0)).scene.routes[1]
    for s_m in np.linspace(1.0, route.landmarks["route_end"] - 1.0, 40):
        there = on_route(route, (float(s_m), 8.0, -1.0))
        found = at_pose(route, there[:3], 8.0, -1.0, near_s_m=float(s_m) + 2.0)
        assert found == pytest.approx(there, abs=1e-6)
        pose = (there.x_m - np.sin(there.heading_rad), there.y_m + np.cos(there.heading_rad), there.heading_rad)
        assert at_pose(route, pose, 8.0, -1.0, there.s_m).d_m == pytest.approx(1.0, abs=1e-6), "left is positive"


def test_capabilities_are_told_in_words() -> None:
    assert Capabilities().words() == "drives the policy of --ego, heroes exactly on their motion, repeatable"
    assert Capabilities(True, False, 0.2, 0.5).words() == (
        "drives the ego itself, heroes within 0.2 m and 0.5 m/s of their motion, not repeatable"
    )


def test_ours_is_registered_like_any_other() -> None:
    project = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["entry-points"][GROUP] == {"builtin": "scenewright.simulate.builtin:BuiltIn"}
    assert {"builtin", "bicycles", "stack"} <= set(SIMULATORS.known())


def test_one_that_is_not_there_is_refused_before_anything_is_done(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such simulator") as refused:
        run("carla", tmp_path / "run")
    assert "bicycles" in str(refused.value.expected)


# -- whole runs -------------------------------------------------------------------------------------------------------
def test_a_scenario_happens_in_an_inexact_one_and_is_judged(tmp_path: Path) -> None:
    out = tmp_path / "run"
    result = run("bicycles", out)
    assert result.status == "success"
    assert result.run is not None
    (astray,) = [each for each in result.run.findings if "heroes were up to" in each]
    assert manifest(out)["simulator"] == "bicycles"
    assert "bicycles" in (out / "index.html").read_text(encoding="utf-8")
    hero = read_trace(out / "trace.parquet").actors["hero"]
    assert 0.01 < np.max(np.abs(hero.d_m)) < 0.2, "what is judged is where it was, not where it was to be"
    assert float(astray.split("up to ")[1].split()[0]) <= toys.Bicycles.capabilities.place_error_m
    assert judge_run_directory(out).as_dict() == json.loads((out / "verdict.json").read_text(encoding="utf-8"))


def test_a_stack_that_drives_the_ego_itself_is_named(tmp_path: Path) -> None:
    result = run("stack", tmp_path / "run")
    assert result.run is not None
    assert result.run.status == "finished"
    assert any("drove the ego by itself" in each for each in result.run.findings)
    assert manifest(tmp_path / "run")["ego"] == {"name": "stack's own", "options": {}}
    assert np.all(result.run.trace.actors["ego"].speed_mps[-50:] == pytest.approx(9.0, abs=0.1))


def test_what_was_driven_until_the_connection_broke_is_kept(tmp_path: Path) -> None:
    out, closed = tmp_path / "run", IsLost.closed
    result = run("lost", out)
    assert (result.status, EXIT_STATUS[result.status]) == ("failed", 2)
    assert result.run is not None
    assert isinstance(result.run.fault, SimulatorError)
    assert IsLost.closed == closed + 1
    assert "the simulator IsLost failed" in str(manifest(out)["fault"])
    assert "ConnectionResetError: nobody there" in str(manifest(out)["fault"])
    assert read_trace(out / "trace.parquet").duration_s == pytest.approx(LOST_S - 0.02)
    judge_run_directory(out)


@pytest.mark.parametrize("late", LATE)
def test_what_it_shows_is_its_own_fault_where_nobody_can_drive_on_it(late: type[Late], tmp_path: Path) -> None:
    out = tmp_path / "run"
    result = run(late.__name__, out)
    assert result.status == "failed"
    assert f"the simulator {late.__name__} failed" in str(manifest(out)["fault"])
    assert read_trace(out / "trace.parquet").duration_s == pytest.approx(LOST_S - 0.02)


@pytest.mark.parametrize(("name", "words"), [("IsNotClosed", "still there"), ("StartsOnce", "only once")])
def test_what_was_driven_is_kept_where_it_does_not_close_or_start_again(name: str, words: str, tmp_path: Path) -> None:
    out = tmp_path / "run"
    result = orchestrate(Request(STORIES["yields, distance"], simulator=name, takes=2, out=out, replan_hz=2.0))
    assert (result.status, EXIT_STATUS[result.status]) == ("failed", 2)
    assert words in str(manifest(out)["fault"])
    judge_run_directory(out)


def test_one_that_cannot_start_is_told(tmp_path: Path) -> None:
    with pytest.raises(SimulatorError, match="CannotStart failed") as failed:
        run("away", tmp_path / "run")
    assert "nobody answers" in str(failed.value.found)
