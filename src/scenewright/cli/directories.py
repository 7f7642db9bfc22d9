"""Chooses the folder that a run is written to, and never takes one that holds something else.

What enters: ``--out``, or nothing. What leaves: a folder that is there and is ours. No run is written here.
"""

from __future__ import annotations

import json
import re
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from scenewright.errors import OutputError, Place

RUNS = Path("runs")
_SLUG_LENGTH = 30


@dataclass(slots=True)
class Claim:
    """A folder for one run, and what had to be made for it."""

    path: Path
    _made: list[Path] = field(default_factory=list)

    def give_back(self) -> None:
        """Remove the folders that were made for the run, where nothing was put into them."""
        for folder in reversed(self._made):
            with suppress(OSError):
                folder.rmdir()


def claim(out: Path | None, source: str) -> Claim:
    """Return a folder for a run: `out`, or the next free number under ``runs``.

    Raises
    ------
    OutputError
        Where it cannot be made, a file is in the way, or `out` holds something that no run left.
    """
    if out is not None:
        _refuse_what_is_not_ours(out)
        return Claim(out, _make(out))
    return next_free(RUNS, slug(source))


def next_free(parent: Path, name: str) -> Claim:
    """Return a new folder NUMBER-NAME in `parent`, which is made where it is missing."""
    made = [] if parent.is_dir() else _make(parent)
    try:
        number = 1 + max((_number(path) for path in parent.iterdir()), default=0)
    except OSError as error:
        raise _cannot_write(parent, error) from None
    while True:
        path = parent / f"{number:03d}-{name}"
        try:
            path.mkdir()
        except FileExistsError:  # another one was quicker
            number += 1
            continue
        except OSError as error:
            raise _cannot_write(path, error) from None
        return Claim(path, [*made, path])


def is_run_directory(path: Path) -> bool:
    """Whether a run was written to this folder."""
    return {"schema_version", "scenewright_version"} <= _manifest(path).keys()


def run_status(path: Path) -> str:
    """Return whether a run was finished, interrupted or failed, as its manifest says."""
    return str(_manifest(path).get("status", "finished"))


def _manifest(path: Path) -> dict[str, object]:
    try:
        manifest = json.loads((path / "manifest.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return manifest if isinstance(manifest, dict) else {}


def slug(source: str) -> str:
    """Return a short name for a run: the file's, or the first words of the text."""
    stem = Path(source).stem if source.endswith((".txt", ".scene")) and "\n" not in source else source
    words = re.findall(r"[a-z0-9]+", stem.lower()[:200])
    while len("-".join(words)) > _SLUG_LENGTH and len(words) > 1:
        words.pop()
    return "-".join(words)[:_SLUG_LENGTH] or "run"


def _number(path: Path) -> int:
    match = re.match(r"(\d{1,9})-", path.name)
    return int(match[1]) if match else 0


def _refuse_what_is_not_ours(out: Path) -> None:
    fix = "choose another folder with --out DIR"
    try:
        if out.exists() and not out.is_dir():
            raise OutputError("a file is in the way of the output folder", place=Place(str(out)), fix=fix)
        if out.is_dir() and not is_run_directory(out) and (first := next(out.iterdir(), None)) is not None:
            raise OutputError(
                "the output folder holds something that is not a run",
                place=Place(str(out)),
                found=first.name,
                expected="a new or empty folder, or that of an earlier run",
                fix=fix,
            )
    except OSError as error:
        raise _cannot_write(out, error) from None


def _make(folder: Path) -> list[Path]:
    """Make `folder` and what is missing above it; return what was made, outermost first."""
    missing = [path for path in (*reversed(folder.parents), folder) if not path.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _cannot_write(folder, error) from None
    return missing


def _cannot_write(path: Path, error: OSError) -> OutputError:
    return OutputError(
        "the output folder cannot be made",
        place=Place(str(path)),
        found=error.strerror or str(error),
        fix="choose another folder with --out DIR",
    )
