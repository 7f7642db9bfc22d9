"""The tables of the precision grid: by method, and cell by cell.

What enters: cells. What leaves: tables.
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median

from scenewright.study.report.counting import Rate
from scenewright.study.report.precision import MET_M, Cell
from scenewright.study.report.tables import Column, Table, Value

_TIGHT_M = 0.5


def precision_table(cells: Sequence[Cell]) -> Table:
    """Return one line a method, over the cells that are neither infeasible nor ones that the ego never came to."""
    rows: list[tuple[Value, ...]] = []
    for method in dict.fromkeys(cell.method for cell in cells):
        own = [cell for cell in cells if cell.method == method]
        over = [cell for cell in own if not cell.infeasible and not cell.ego_never_met]
        errors = [cell.error_m for cell in over if cell.error_m is not None]
        close = sum(error <= _TIGHT_M for error in errors)
        rows.append(
            (
                method,
                len(own),
                sum(cell.infeasible for cell in own),
                sum(cell.ego_never_met and not cell.infeasible for cell in own),
                sum(bool(cell.fault) for cell in own),
                Rate(close, len(over)),
                Rate(sum(cell.met for cell in over), len(over)),
                Rate(sum(cell.tight for cell in over), len(over)),
                Rate(sum(cell.loose for cell in over), len(over)),
                median(errors) if errors else None,
            )
        )
    columns = (
        Column("method", "method"),
        Column("cells", "cells", "count"),
        Column("proven_infeasible", "proven infeasible", "count"),
        Column("ego_never_met", "ego never came there", "count"),
        Column("no_run", "no run", "count"),
        Column("met_half_m", f"trigger within {_TIGHT_M:g} m", "rate"),
        Column("met_two_m", f"trigger within {MET_M:g} m", "rate"),
        Column("tight", "all conditions, tight", "rate"),
        Column("loose", "all conditions, loose", "rate"),
        Column("error_p50_m", "error at the trigger, p50 (m)", "number"),
    )
    return Table("precision", "Precision grid by method", columns, tuple(rows))


def grid_table(cells: Sequence[Cell]) -> Table:
    """Return one line a cell and method."""
    rows = tuple(
        (
            cell.method,
            cell.ego_m,
            cell.hero_m,
            _outcome(cell),
            cell.error_m,
            cell.proof or cell.fault,
        )
        for cell in cells
    )
    columns = (
        Column("method", "method"),
        Column("ego_m", "ego before the conflict point (m)", "number", 0),
        Column("hero_m", "hero before the conflict point (m)", "number", 0),
        Column("outcome", "outcome"),
        Column("error_m", "error of the worse side (m)", "number", 3),
        Column("why", "what clashes, or the fault"),
    )
    return Table("precision_cells", "Precision grid cell by cell", columns, rows)


def _outcome(cell: Cell) -> str:
    if cell.infeasible:
        return "proven infeasible"
    if cell.ego_never_met:
        return "ego never came there"
    if cell.fault:
        return "no run"
    if cell.tight:
        return "success"
    return "trigger met" if cell.met else "trigger not met"
