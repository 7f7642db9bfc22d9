"""Every kind of wrong input ends in status 2 and a message to act on: on stderr, with --json on stdout too."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from sentences import OPEN_SENTENCE, SENTENCE

Command = Callable[..., Any]

CASES: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "empty text": (("run", ""), ("empty", "for example")),
    "blank text": (("run", "  \n "), ("empty",)),
    "nonsense": (("run", "nonsense"), ("who is under test",)),
    "something else": (("run", "I would like a pizza with cheese."), ("who is under test",)),
    "unknown parameter": (("run", OPEN_SENTENCE, "-p", "egogap_m=3"), ("did you mean ego_gap_m?",)),
    "parameter where there is none": (("run", SENTENCE, "-p", "x_m=3"), ("no parameter x_m",)),
    "not a number": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=abc"), ("abc", "-p ego_gap_m=12.5")),
    "nan": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=nan"), ("a finite number",)),
    "infinite": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=inf"), ("a finite number",)),
    "endless": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=1e-999999999"), ("no scenario", "at most 40 digits")),
    "5,000 digits": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=" + "9" * 5000), ("no scenario", "at most 40 digits")),
    "divided by zero": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=1/0"), ("divided by zero",)),
    "no characters": (("run", "the ego \udcff goes"), ("not a character", "UTF-8")),
    "a whole book": (("run", "The ego drives on. " * 1000), ("too many characters", "at most 5,000")),
    "no value": (("run", OPEN_SENTENCE, "-p", "ego_gap_m"), ("without a value", "-p ego_gap_m=12.5")),
    "empty value": (("run", OPEN_SENTENCE, "-p", "ego_gap_m="), ("without a value",)),
    "no name": (("run", OPEN_SENTENCE, "-p", "=3"), ("without a parameter",)),
    "twice": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=3", "-p", "ego_gap_m=4"), ("given twice", "3 and 4")),
    "out of range": (("run", OPEN_SENTENCE, "-p", "ego_gap_m=5000"), ("out of range", "0 to 1000 m")),
    "no such file": (("run", "nope.scene"), ("no such file",)),
    "broken program": (("run", "Actor 0:\n- W\n- [t0, go\n"), ("description:3", "expected")),
    "no such map": (("run", SENTENCE, "--map", "t_intersectoin"), ("did you mean 't_intersection'?",)),
    "broken map": (("run", SENTENCE, "--map", "broken.xodr"), ("broken.xodr",)),
    "no such policy": (("run", SENTENCE, "--ego", "idn"), ("did you mean 'idm'?",)),
    "no such option of a policy": (("run", SENTENCE, "--ego", "constant:speed=3"), ("speed_mps",)),
    "no such module": (("run", SENTENCE, "--ego", "nowhere:Own"), ("no module 'nowhere'",)),
    "no such translator": (("run", SENTENCE, "--translator", "oracle"), ("offline",)),
    "file in the way": (("run", SENTENCE, "--out", "afile"), ("afile", "in the way", "--out DIR")),
    "file in the way above": (("run", SENTENCE, "--out", "afile/run"), ("afile/run", "--out DIR")),
    "folder that nobody may write": (("run", SENTENCE, "--out", "/proc/scenewright"), ("/proc/scenewright",)),
    "check: no value": (("check", OPEN_SENTENCE, "-p", "ego_gap_m"), ("without a value",)),
    "solve: file that nobody may write": (("solve", SENTENCE, "--out", "/proc/plan.json"), ("/proc/plan.json",)),
    "translate: empty": (("translate", ""), ("empty",)),
    "judge: no folder": (("judge", "nowhere"), ("nowhere", "no run directory")),
    "judge: another folder": (("judge", "."), ("manifest.json",)),
    "maps: no map": (("maps", "afile"), ("OpenDRIVE",)),
}


@pytest.fixture(autouse=True)
def things_in_the_way(folder: Path) -> None:
    (folder / "afile").write_text("mine", encoding="utf-8")
    (folder / "broken.xodr").write_text("<OpenDRIVE><road", encoding="utf-8")


@pytest.mark.parametrize("name", CASES)
def test_message_and_status(command: Command, folder: Path, name: str) -> None:
    words, expected = CASES[name]
    before = sorted(path.name for path in folder.iterdir())
    result = command(*words)
    assert result.exit_code == 2
    assert result.stdout == ""
    for part in expected:
        assert part in result.stderr
    assert "Traceback" not in result.stderr
    assert sorted(path.name for path in folder.iterdir()) == before, "a mistake leaves no folder behind"


@pytest.mark.parametrize("name", CASES)
def test_error_as_json(command: Command, name: str) -> None:
    result = command(*CASES[name][0], "--json")
    data = json.loads(result.stdout)
    assert (data["status"], data["exit_status"], result.exit_code) == ("error", 2, 2)
    assert data["error"]["message"]
    assert data["error"]["message"] in result.stderr


def test_view_names_what_is_missing(command: Command) -> None:
    for where in ("nowhere", "."):
        result = command("view", where, "--no-browser")
        assert result.exit_code == 2
        assert "scenewright run" in result.stderr


@pytest.mark.parametrize(
    "words",
    [
        ("run",), ("run", SENTENCE, "--mode", "sideways"), ("run", SENTENCE, "--tolerance", "none"),
        ("run", SENTENCE, "--replan-hz", "0"), ("run", SENTENCE, "--replan-hz", "nan"),
        ("run", SENTENCE, "--seed", "x"),
        ("run", SENTENCE, "--budget-ms", "50"), ("frobnicate",), ("run", SENTENCE, "--frobnicate"),
    ],
)  # fmt: skip
def test_words_that_no_command_takes(command: Command, words: tuple[str, ...]) -> None:
    result = command(*words)
    assert result.exit_code == 2
    assert "--help" in result.stderr


def test_a_full_disk_is_not_called_our_fault(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise OSError(28, "No space left on device", "somewhere")

    monkeypatch.setattr("scenewright.cli.listing.describe", refuse)
    result = command("maps")
    assert result.exit_code == 2
    assert "No space left on device: somewhere" in result.stderr


def test_a_fault_of_ours_is_one_line_and_status_seventy(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scenewright.cli.listing.describe", lambda _: 1 // 0)
    result = command("maps")
    assert result.exit_code == 70
    assert "ZeroDivisionError" in result.stderr
    assert "--debug" in result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert "Traceback" in command("--debug", "maps").stderr
    data = json.loads(command("maps", "--json").stdout)
    assert (data["status"], data["exit_status"]) == ("error", 70)


@pytest.mark.parametrize("words", [("maps",), ("run",), ("check",), ("solve",)])
def test_what_was_mended_on_a_map_is_told(command: Command, folder: Path, words: tuple[str, ...]) -> None:
    """A road of the map was cut away: it loads, and whoever uses it hears of it in one line."""
    from scenewright.roads import load_map

    text = load_map("t_intersection").source.read_text(encoding="utf-8")
    cut = text.replace('incomingRoad="2"', 'incomingRoad="77"', 1)
    assert cut != text
    (folder / "cut.xodr").write_text(cut, encoding="utf-8")
    where = ("cut.xodr",) if words == ("maps",) else (SENTENCE, "--map", "cut.xodr")
    result = command(*words, *where)
    assert result.exit_code in (0, 1), result.stderr
    told = " ".join((result.stdout + result.stderr).split())
    assert told.count("connections of junctions with roads that are not in the file are left out: 77 to") == 1
    data = json.loads(command(*words, *where, "--json").stdout)
    assert any("77 to" in note for note in data["notes"])
