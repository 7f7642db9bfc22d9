"""A run directory: all that its reader needs, whole or not at all, and the circumstances of the run."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scenewright import __version__
from scenewright.errors import OutputError
from scenewright.orchestrate import orchestrate
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.simulate.record import prepare_directory
from scenewright.trace.files import read_trace
from stories import STORIES

FILES = ("manifest.json", "params.json", "plan.json", "program.scene", "replans.parquet", "trace.parquet")


def test_what_is_written_is_what_was_asked_driven_and_planned(tmp_path: Path) -> None:
    out = tmp_path / "run"
    result = orchestrate(Request(STORIES["yields, distance"], ego="idm:headway_s=1.5", seed=3, out=out))
    assert result.run is not None
    assert {path.name for path in out.iterdir()} >= set(FILES)
    assert not [path for path in out.iterdir() if "part" in path.name or path.name.startswith(".")]
    manifest = json.loads((out / "manifest.json").read_text(encoding="utf-8"))
    assert (manifest["ego"]["name"], manifest["ego"]["options"]) == ("idm", {"headway_s": 1.5})
    assert (manifest["seed"], manifest["mode"], manifest["planner"]) == (3, "closed", "convex")
    assert manifest["scenewright_version"] == __version__
    kept, driven = read_trace(out / "trace.parquet"), result.run.trace
    for name, actor in driven.actors.items():
        assert kept.actors[name].s_m == pytest.approx(actor.s_m)
        assert kept.actors[name].speed_mps == pytest.approx(actor.speed_mps)
    assert result.scene is not None
    text = (out / "program.scene").read_text(encoding="utf-8")
    asked = {constraint.id for constraint in result.scene.program.constraints}
    assert {constraint.id for constraint in parse_program(text).constraints} == asked


def test_what_cannot_be_written_is_told_before_anything_is_driven(tmp_path: Path) -> None:
    taken = tmp_path / "file"
    taken.write_text("not a folder", encoding="utf-8")
    with pytest.raises(OutputError):
        prepare_directory(taken / "run")
    prepare_directory(tmp_path / "new" / "run")
    assert list((tmp_path / "new" / "run").iterdir()) == []
