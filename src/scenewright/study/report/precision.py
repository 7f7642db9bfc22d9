"""The precision grid: one scenario, the ego's distance at the trigger times the hero's, every method.

What enters: distances, methods. What leaves: for each cell and method the errors at the trigger, whether it was met,
whether all conditions held, or the proof that the cell is infeasible; and tables of them. Drawing is done elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from statistics import median
from typing import Any

from scenewright.study.causes import INFEASIBLE
from scenewright.study.report.measuring import Bench, Job, Measured
from scenewright.study.report.tables import Table, Value
from scenewright.study.summary import Rate

# The threshold of the paper's grid: within it the trigger counts as met.
MET_M = 2.0
_TIGHT_M = 0.5
INITIAL_EGO_M = 80.0
STOP_M = 6.0
# Changes between crawling and going: the ego of ours whose arrival is hardest to foresee by its speed alone.
EGO = "stop-and-go"


# The distances of ego and hero at the trigger.
Grid = tuple[tuple[float, ...], tuple[float, ...]]
QUICK: Grid = ((5.0, 15.0, 30.0, 60.0), (4.0, 12.0, 25.0, 60.0))
FULL: Grid = ((3.0, 7.0, 11.0, 16.0, 22.0, 29.0, 37.0, 47.0, 60.0),) * 2


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
        return self.within(MET_M)

    @property
    def outcome(self) -> str:
        """What came of it, in words."""
        if self.infeasible:
            return INFEASIBLE
        if self.ego_never_met:
            return "ego never came there"
        if self.fault:
            return "no run"
        if self.tight:
            return "success"
        return "trigger met" if self.met else "trigger not met"

    def within(self, error_m: float) -> bool:
        """Whether both sides of the trigger were met within so much."""
        return self.error_m is not None and self.error_m <= error_m


def measure_grid(bench: Bench, methods: Sequence[str], grid_m: Grid, seed: int) -> tuple[Cell, ...]:
    """Run the scenario for every cell and method, first take only."""
    jobs = [
        {"method": method, "ego_m": x, "hero_m": y, "ego": EGO, "seed": seed, "program": scene_text("precision")}
        for x in grid_m[0]
        for y in grid_m[1]
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
    from scenewright.request import Request
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
        return {"fault": "; ".join(map(str, result.not_held)) or result.status}
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


def precision_table(cells: Sequence[Cell]) -> Table:
    """Return one line a method, over the cells that are neither infeasible nor ones that the ego never came to."""
    rows: list[tuple[Value, ...]] = []
    for method in dict.fromkeys(cell.method for cell in cells):
        own = [cell for cell in cells if cell.method == method]
        told = [cell.outcome for cell in own]
        over = [cell for cell in own if not cell.infeasible and not cell.ego_never_met]
        errors = [cell.error_m for cell in over if cell.error_m is not None]
        counts = [told.count(outcome) for outcome in (INFEASIBLE, "ego never came there")]
        hits = [(c.within(_TIGHT_M), c.met, c.tight, c.loose) for c in over]
        rates = [Rate(sum(each[i] for each in hits), len(over)) for i in range(4)]
        faults = sum(bool(cell.fault) for cell in own)
        rows.append((method, len(own), *counts, faults, *rates, median(errors) if errors else None))
    columns = {
        "method": "method",
        "cells": "cells",
        "proven_infeasible": "proven infeasible",
        "ego_never_met": "ego never came there",
        "no_run": "no run",
        "met_half_m": f"trigger within {_TIGHT_M:g} m",
        "met_two_m": f"trigger within {MET_M:g} m",
        "tight": "all conditions, tight",
        "loose": "all conditions, loose",
        "error_p50_m": "error at the trigger, p50 (m)",
    }
    return Table("precision", "Precision grid by method", columns, tuple(rows))


def grid_table(cells: Sequence[Cell]) -> Table:
    """Return one line a cell and method."""
    rows = tuple((c.method, c.ego_m, c.hero_m, c.outcome, c.error_m, c.proof or c.fault) for c in cells)
    columns = {
        "method": "method",
        "ego_m": "ego before the conflict point (m)",
        "hero_m": "hero before the conflict point (m)",
        "outcome": "outcome",
        "error_m": "error of the worse side (m)",
        "why": "what clashes, or the fault",
    }
    return Table("precision_cells", "Precision grid cell by cell", columns, rows)
