"""The examples folder: every program parses, makes sense, finds its roads and can happen; those that should, do."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from scenarios import EXAMPLES, feasibility
from scenewright.orchestrate import orchestrate
from scenewright.program.builder import Scenario
from scenewright.program.check import check_program
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map

pytestmark = pytest.mark.usefixtures("replanned_seldom")
SCENES = sorted(EXAMPLES.glob("*.scene"))
SCRIPTS = sorted(path for path in EXAMPLES.glob("*.py") if "import Scenario" in path.read_text(encoding="utf-8"))
# The ego of this one would have to stand in the conflict point at the moment at which the hero stops before it.
NEEDS_A_TIMID_HERO = {"hesitates_and_goes.scene"}


def built(path: Path) -> Scenario:
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module.build()


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8") if path.suffix == ".scene" else built(path).text()


def test_there_are_examples_of_both_forms() -> None:
    assert len(SCENES) >= 4
    assert len(SCRIPTS) >= 3


@pytest.mark.parametrize("path", [*SCENES, *SCRIPTS], ids=lambda path: path.name)
def test_examples_can_happen_on_the_shipped_map(path: Path) -> None:
    text = text_of(path)
    program = parse_program(text, path.name)
    check_program(program, text, path.name)
    assert parse_program(print_program(program), path.name) == program
    scene = ground(program, load_map(program.map_name))
    assert feasibility(scene).answer == "feasible"


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_scripts_print_their_programs(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = compile(path.read_text(encoding="utf-8"), str(path), "exec")
    exec(source, {"__name__": "__main__"})
    shown = capsys.readouterr().out
    assert built(path).text().splitlines()[0].split('"')[0] in shown
    assert shown.count("Constraints:") >= 1


@pytest.mark.parametrize(
    "path", [p for p in (*SCENES, *SCRIPTS) if p.name not in NEEDS_A_TIMID_HERO], ids=lambda path: path.name
)
def test_examples_do_happen(path: Path) -> None:
    result = orchestrate(Request(text_of(path)))
    assert result.status == "success"
