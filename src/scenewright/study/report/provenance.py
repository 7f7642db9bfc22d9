"""Where figures come from: command, seed, versions, machine.

What enters: the settings of a store, or this process. What leaves: a `Provenance` that captions print.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import scenewright
from scenewright.study.experiment import machine, revision

_PACKAGES = ("z3-solver", "numpy", "scipy", "matplotlib")


@dataclass(frozen=True, slots=True)
class Provenance:
    """What made a figure or a table."""

    command: str
    seed: str
    versions: str
    machine: str
    date: str = ""

    def as_dict(self) -> dict[str, str]:
        """Return the fields by name, for files."""
        return {
            "command": self.command,
            "seed": self.seed,
            "versions": self.versions,
            "machine": self.machine,
            "date": self.date,
        }


def of_experiment(settings: Mapping[str, Any]) -> Provenance:
    """Return where the cases of a store come from."""
    packages = {"scenewright": settings.get("version", "?"), **dict(settings.get("packages") or {})}
    return Provenance(
        str(settings.get("command", "")),
        str(settings.get("seed", "")),
        _versions(packages, settings.get("revision")),
        _machine(settings.get("machine")),
        str(settings.get("started", ""))[:16].replace("T", " "),
    )


def of_report(folder: Path, settings: Mapping[str, Any]) -> Provenance:
    """Return where what the report measures itself comes from; the folder is named as it was given."""
    packages = {"scenewright": scenewright.__version__}
    for name in _PACKAGES:
        try:
            packages[name] = version(name)
        except PackageNotFoundError:
            continue
    command = f"scenewright bench report {folder}"
    return Provenance(command, str(settings.get("seed", "")), _versions(packages, revision()), _machine(machine()))


def _versions(packages: Mapping[str, Any], made_from: object) -> str:
    named = ", ".join(f"{name} {number}" for name, number in packages.items())
    return f"{named}, revision {made_from}" if made_from else named


def _machine(facts: object) -> str:
    if not isinstance(facts, Mapping):
        return str(facts or "")
    parts = [str(facts[name]) for name in ("cpu", "system") if facts.get(name)]
    if facts.get("cores"):
        parts.insert(1, f"{facts['cores']} cores")
    if facts.get("python"):
        parts.append(f"Python {facts['python']}")
    return ", ".join(parts)
