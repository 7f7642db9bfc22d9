"""The precision grid: one scenario, the ego's distance at the trigger times the hero's, every method.

What enters: distances, methods, an ego. What leaves: for each cell and method the errors at the trigger, whether it was
met, whether all conditions held, or the proof that the cell is infeasible. Drawing is done elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from scenewright.study.report.measuring import Bench, Job, Measured

# The threshold of the paper's grid: within it the trigger counts as met.
MET_M = 2.0
INITIAL_EGO_M = 80.0
STOP_M = 6.0
# Changes between crawling and going: the ego of ours whose arrival is hardest to foresee by its speed alone.
EGO = "stop-and-go"


@dataclass(frozen=True, slots=True)
class GridSize:
    """The distances (m) of both sides at the trigger."""

    ego_m: tuple[float, ...]
    hero_m: tuple[float, ...]


QUICK = GridSize((5.0, 15.0, 30.0, 60.0), (4.0, 12.0, 25.0, 60.0))
_FULL = (3.0, 7.0, 11.0, 16.0, 22.0, 29.0, 37.0, 47.0, 60.0)
FULL = GridSize(_FULL, _FULL)


@dataclass(frozen=True, slots=True)
class Cell:
    """One cell of a method's grid. Errors are the worse side's, in m; None where the trigger could not be judged."""

    method: str
    ego_m: float
    hero_m: float
    error_m: float | None = None
    infeasible: bool = False
    ego_never_met: bool = False
    tight: bool = False
    loose: bool = False
    proof: str = ""
    fault: str = ""

    @property
    def met(self) -> bool:
        """Whether the trigger was met within `MET_M`."""
        return self.error_m is not None and self.error_m <= MET_M


def measure_grid(bench: Bench, methods: Sequence[str], size: GridSize, seed: int, ego: str = EGO) -> tuple[Cell, ...]:
    """Run the scenario for every cell and method, first take only."""
    jobs = [
        {"method": method, "ego_m": x, "hero_m": y, "ego": ego, "seed": seed, "program": scene_text("precision")}
        for x in size.ego_m
        for y in size.hero_m
        for method in methods
    ]
    return tuple(_cell(record) for record in bench.measure("precision", run_cell, jobs))


@cache
def scene_text(name: str) -> str:
    """Return the text of a scenario that lies beside this module."""
    return files(__package__).joinpath("scenes", f"{name}.scene").read_text(encoding="utf-8")


def run_cell(job: Job) -> Measured:
    """Run one cell by one method."""
    from scenewright.judge.tolerance import LOOSE, TIGHT
    from scenewright.orchestrate import Request
    from scenewright.study.rivals import run_method

    parameters = {
        "initial_ego_distance_behind_intersection_m": INITIAL_EGO_M,
        "ego_distance_behind_conflict_point_m": job["ego_m"],
        "hero_distance_behind_conflict_point_m": job["hero_m"],
        "end_hero_distance_behind_conflict_point_m": STOP_M,
    }
    result = run_method(job["method"], Request(job["program"], parameters, ego=job["ego"], seed=job["seed"], takes=1))
    if result.status == "infeasible":
        clashes = result.feasibility.clashes if result.feasibility is not None else ()
        return {"infeasible": True, "proof": "; ".join(str(clash) for clash in clashes)}
    if not result.takes:
        return {"fault": result.attempt.reason if result.attempt is not None else result.status}
    verdict = result.takes[0].verdict
    sides = [c for c in verdict.conditions if c.kind == "trigger" and c.unit == "m"]
    errors = [abs(side.error) for side in sides if side.error is not None]
    return {
        "error_m": max(errors) if len(errors) == len(sides) and errors else None,
        "ego_never_met": bool(verdict.facts.get("ego_never_met_condition")),
        "tight": verdict.holds_at(TIGHT),
        "loose": verdict.holds_at(LOOSE),
    }


def _cell(record: Measured) -> Cell:
    known: dict[str, Any] = {name: record[name] for name in Cell.__dataclass_fields__ if name in record}
    return Cell(**{**known, "fault": str(record.get("error") or record.get("fault") or "")})
