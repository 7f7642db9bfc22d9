"""Help: every command says how it is used, and every example in it works as it stands."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import typer

from scenewright import __version__
from scenewright.cli.app import app

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = [info.callback.__name__ for info in app.registered_commands if info.callback]
Command = Callable[..., Any]


def examples_of(text: str) -> list[str]:
    """Return the commands below "Examples", each as it stands there, line breaks within quotes included."""
    lines = text.partition("Examples")[2].partition("Exit status")[0].strip("\n").split("\n")
    blocks = re.split(r"\n\s*(?=scenewright )", "\n" + "\n".join(lines))
    return [block.strip() for block in blocks if block.strip()]


@pytest.mark.parametrize("name", ["", *COMMANDS])
def test_examples_in_help_run_as_they_stand(command: Command, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    shown = command(*filter(None, [name]), "--help")
    assert shown.exit_code == 0
    examples = examples_of(shown.stdout)
    assert examples
    for example in examples:
        words = shlex.split(example)
        assert words[0] == "scenewright"
        result = command(*words[1:])
        assert result.exit_code == 0, f"{example}\n{result.stdout}{result.stderr}"


def test_examples_work_in_a_shell(command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    script = "\n".join(["set -e", "scenewright() {", f'{shlex.quote(sys.executable)} -m scenewright "$@"', "}"])
    script += "\n" + "\n".join(examples_of(command("tell", "--help").stdout))
    done = subprocess.run(["bash", "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "The hero is headed east and turns left." in done.stdout


def test_every_command_has_a_word_on_each_of_its_options() -> None:
    group = typer.main.get_command(app)
    for name, each in group.commands.items():  # type: ignore[attr-defined]
        assert each.help, name
        for parameter in each.params:
            assert getattr(parameter, "help", None), f"{name}: {parameter.name}"


def test_version(command: Command) -> None:
    assert command("--version").stdout == f"scenewright {__version__}\n"


EXAMPLES = [path for path in sorted((ROOT / "examples").glob("*.txt")) if path.stem != "impossible"]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_files_do_what_they_say(command: Command, path: Path) -> None:
    """The impossible one and the policy are run by the documentation."""
    result = command("run", path, "--quiet")
    assert result.exit_code == 0, result.stderr
