"""What the documentation shows works: its commands, descriptions, programs and links."""

from __future__ import annotations

import json
import re
import shlex
import shutil
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest

from scenewright.cli.app import app
from scenewright.errors import TranslationError
from scenewright.plan.preferences import preferences_of
from scenewright.program.manner import USUAL
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.translate.understand import understand

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
Command = Callable[..., Any]


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def marked(mark: str) -> list[Any]:
    """Return the blocks that stand below a comment with `mark`, named by page and number."""
    pattern = re.compile(rf"^% {mark}\n```text\n(.*?)^```", flags=re.MULTILINE | re.DOTALL)
    return [
        pytest.param(text, id=f"{page.stem}{number}")
        for page in PAGES
        for number, text in enumerate(pattern.findall(page.read_text(encoding="utf-8")))
    ]


def commands_of(page: Path) -> list[tuple[list[str], int]]:
    """Return the words of every command that a page shows, and the exit status that it is said to have."""
    text = "".join(blocks(page, "sh"))
    found = []
    for line in re.findall(r"^scenewright (?:\"[^\"]*\"|[^\"\n])*", text, flags=re.MULTILINE):
        shown, _, comment = line.partition("    #")
        status = re.search(r"exit status (\d+)", comment)
        words = shlex.split(shown)
        words = words[: words.index(">")] if ">" in words else words
        found.append((words[1:], int(status[1]) if status else 0))
    return found


def test_every_tool_that_a_page_names_is_there() -> None:
    named = {tool for page in PAGES for tool in re.findall(r"\btools/\w+\.py\b", page.read_text(encoding="utf-8"))}
    assert len(named) > 5
    assert [tool for tool in sorted(named) if not (ROOT / tool).is_file()] == []


# What is proposed is in the proof below.
@pytest.mark.usefixtures("in_one_process", "nothing_proposed")
@pytest.mark.parametrize("page", [page for page in PAGES if commands_of(page)], ids=lambda page: page.stem)
def test_commands_run_in_order(command: Command, folder: Path, page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scenewright.explain.ways_out._TRIES", 1)  # each is a whole run
    monkeypatch.setattr("scenewright.takes.how_next", lambda *_: ())  # nothing is taken again
    monkeypatch.setattr("scenewright.simulate.hindsight.ego_left_no_room", lambda *_: None)  # longer than the run
    shutil.copytree(ROOT / "examples", folder / "examples")
    for words, status in commands_of(page):
        result = command(*words)
        # Another driver may well spoil a scenario: what counts here is that the command is right.
        expected = {status, 1} if words[0] == "run" and "--ego" in words else {status}
        assert result.exit_code in expected, f"{words}\n{result.stdout}{result.stderr}"


@pytest.mark.parametrize("text", marked("description"))
def test_descriptions_are_understood_and_happen(command: Command, text: str) -> None:
    assert command("run", text, "--quiet").exit_code == 0


@pytest.mark.parametrize("text", marked("refused"))
def test_refused_descriptions_are_refused_as_shown(text: str) -> None:
    with pytest.raises(TranslationError) as caught:
        understand(text)
    page = (ROOT / "docs" / "descriptions.md").read_text(encoding="utf-8")
    first = str(caught.value).splitlines()[0]
    assert f"error: {first}" in page


def outputs() -> list[Any]:
    """Return each command of which a page shows the output below a comment, and that output."""
    pattern = re.compile(r"^% output: ([^\n]*)\n```text\n(.*?)^```", flags=re.MULTILINE | re.DOTALL)
    return [
        pytest.param(shlex.split(words), shown, id=f"{page.stem}: {words}")
        for page in PAGES
        for words, shown in pattern.findall(page.read_text(encoding="utf-8"))
    ]


@pytest.mark.parametrize(("words", "shown"), outputs())
def test_output_is_what_the_page_shows(command: Command, folder: Path, words: list[str], shown: str) -> None:
    shutil.copytree(ROOT / "examples", folder / "examples")
    assert command(*words).stdout.split() == shown.split()


def test_proof_is_what_the_page_shows(command: Command, folder: Path) -> None:
    shutil.copytree(ROOT / "examples", folder / "examples")
    told = command("check", "examples/impossible.txt").stdout
    assert told[told.index("This cannot") :].strip() in (ROOT / "docs" / "infeasibility.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("text", marked("program"))
def test_programs_run(command: Command, text: str) -> None:
    assert print_program(parse_program(text))
    assert command("run", text, "--quiet").exit_code == 0


def test_example_policy_is_the_one_in_the_documentation() -> None:
    shown = blocks(ROOT / "docs" / "egos.md", "python")[0]
    step = shown[shown.index("        ego = ") :]
    assert step in (ROOT / "examples" / "timid.py").read_text(encoding="utf-8")


def test_example_simulator_keeps_the_contract() -> None:
    example, test = blocks(ROOT / "docs" / "simulators.md", "python")
    names: dict[str, Any] = {}
    exec(f"{example}\n{test}", names)
    names["test_it_keeps_the_contract"]()


@pytest.mark.usefixtures("in_one_process")
def test_what_is_run_in_python_runs(folder: Path) -> None:
    shutil.copytree(ROOT / "examples", folder / "examples")
    names: dict[str, Any] = {"__name__": "documentation"}
    for page in ("program", "development", "run-directory"):
        for shown in blocks(ROOT / "docs" / f"{page}.md", "python"):
            exec(shown.replace("runs/demo", "runs/dawdler"), names)
    assert names["hero"]
    assert names["run"]((20, "idm", 0)).status == "success"


def test_every_key_of_the_manifest_is_in_the_page(folder: Path, command: Command) -> None:
    assert command("run", str(ROOT / "examples" / "demo.txt"), "--quiet", "--takes", "1", "--out", "run").exit_code == 0
    page = (ROOT / "docs" / "run-directory.md").read_text(encoding="utf-8")
    assert [key for key in json.loads(Path("run/manifest.json").read_text()) if f"`{key}`" not in page] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_links_lead_somewhere(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_every_command_and_exit_status_is_in_the_reference() -> None:
    page = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
    for info in app.registered_commands:
        assert info.callback is not None
        assert f"`{info.callback.__name__}" in page


def test_every_preference_is_in_the_page_with_its_value() -> None:
    page = (ROOT / "docs" / "closed-loop.md").read_text(encoding="utf-8")
    section = page[page.index("## Preferences") :]
    rows = re.findall(r"^\| `(\w+)` \| ([\d.]+) \| [^|]+ \| [^|]+ \|$", section, flags=re.MULTILINE)
    assert {name: float(value) for name, value in rows} == pytest.approx(asdict(preferences_of(USUAL)))
