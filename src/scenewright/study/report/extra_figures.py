"""The figures of the report's own measurements: precision grid, open against closed loop.

What enters: what those measured. What leaves: matplotlib figures.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scenewright.study.cases import OURS
from scenewright.study.report.loops import MODES, SCENES
from scenewright.study.report.precision import MET_M, Cell
from scenewright.study.report.style import (
    EMPTY,
    INK,
    LINE,
    SOFT,
    bare,
    method_colour,
    new_figure,
    percent_axis,
    say_empty,
)
from scenewright.study.report.tables import Table
from scenewright.study.summary import Rate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage


# -- precision ------------------------------------------------------------------------------------------------------
def draw_grid(cells: Sequence[Cell]) -> Figure:
    """Draw the error at the trigger over both distances, one panel a method."""
    from matplotlib.colors import LogNorm

    methods = list(dict.fromkeys(cell.method for cell in cells))
    wide = min(3, max(1, len(methods)))
    deep = -(-max(1, len(methods)) // wide)
    figure = new_figure(10.5 if wide > 1 else 5.6, 0.9 + 3.3 * deep)
    panels = figure.subplots(deep, wide, sharex=True, sharey=True, squeeze=False)
    for axes in panels.flat[len(methods) :]:
        axes.set_axis_off()
    if not methods:
        say_empty(panels.flat[0], "nothing was measured")
        return figure
    norm = LogNorm(0.01, 20.0)
    for place, method in enumerate(methods):
        axes = panels.flat[place]
        image = _panel(axes, [cell for cell in cells if cell.method == method], norm)
        axes.set_title(method)
        if place % wide == 0:
            axes.set_ylabel("hero before the conflict\npoint at the trigger (m)")
        if place + wide >= len(methods):
            axes.set_xlabel("ego before the conflict point at the trigger (m)")
    bar = figure.colorbar(image, ax=panels, shrink=0.85, aspect=30, pad=0.015, extend="both")
    bar.set_label("error of the worse side at the trigger (m)")
    bar.set_ticks([0.01, 0.1, 0.5, 2.0, 20.0], labels=["0.01", "0.1", "0.5", "2", "20"])
    bar.outline.set_visible(False)
    _grid_legend(figure, any(cell.fault for cell in cells))
    return figure


def _panel(axes: Axes, cells: Sequence[Cell], norm: Normalize) -> AxesImage:
    egos, heroes = sorted({cell.ego_m for cell in cells}), sorted({cell.hero_m for cell in cells})
    errors = np.full((len(heroes), len(egos)), np.nan)
    for cell in cells:
        i, j = heroes.index(cell.hero_m), egos.index(cell.ego_m)
        if cell.infeasible:
            _mark_infeasible(axes, i, j)
        elif cell.fault:
            axes.text(j, i, "?", ha="center", va="center", color=SOFT)
        elif cell.ego_never_met:
            axes.plot(j, i, marker="o", color=INK, markersize=6, fillstyle="none")
        elif not cell.met:
            axes.plot(j, i, marker="x", color=INK, markersize=6, markeredgewidth=1.6)
        if not cell.infeasible and cell.error_m is not None:
            errors[i, j] = max(cell.error_m, 1e-3)
    axes.set_facecolor(EMPTY)
    image = axes.imshow(errors, cmap="cividis", norm=norm, origin="lower", aspect="auto")
    axes.set_xticks(range(len(egos)), [f"{value:g}" for value in egos])
    axes.set_yticks(range(len(heroes)), [f"{value:g}" for value in heroes])
    bare(axes)
    return image


def _mark_infeasible(axes: Axes, i: int, j: int) -> None:
    from matplotlib.patches import Rectangle

    where = (j - 0.5, i - 0.5)
    axes.add_patch(Rectangle(where, 1, 1, facecolor=LINE, edgecolor=SOFT, hatch="////", linewidth=0))


def _grid_legend(figure: Figure, faults: bool) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Line2D([], [], color=INK, marker="x", linestyle="none", label=f"trigger not met within {MET_M:g} m"),
        Line2D([], [], color=INK, marker="o", fillstyle="none", linestyle="none", label="ego never came there"),
        Patch(facecolor=LINE, edgecolor=SOFT, hatch="////", linewidth=0, label="proven infeasible"),
    ]
    if faults:
        handles.append(Line2D([], [], color=SOFT, marker="$?$", linestyle="none", label="no run"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)


# -- open against closed loop ---------------------------------------------------------------------------------------
def draw_loops(table: Table) -> Figure:
    """Draw both modes over the four scenarios, with intervals."""
    figure = new_figure(10.5, 3.6)
    axes: Axes = figure.subplots()
    rates = {(row[0], row[1]): rate for row in table.rows if isinstance(rate := row[4], Rate)}
    scenes = {SCENES.get(str(scene), "all four"): scene for scene in dict.fromkeys(table.column("scene"))}
    for mode, offset in zip(MODES, (-0.19, 0.19), strict=True):
        colour = method_colour("open-loop" if mode == "open" else OURS)
        for place, scene in enumerate(scenes.values()):
            found, label = rates[scene, mode], f"{mode} loop" if place == 0 else None
            low, end = found.interval or (0.0, 0.0)
            share = 100 * (found.value or 0.0)
            axes.barh(place + offset, share, 0.36, color=colour, label=label, linewidth=0)
            axes.plot([100 * low, 100 * end], [place + offset] * 2, color=INK, linewidth=0.9, alpha=0.55)
            text = "not run" if found.value is None else f"{share:.0f}"
            axes.text(100 * end + 1.5, place + offset, text, va="center", fontsize=8)
    axes.set_yticks(range(len(scenes)), list(scenes))
    axes.set_ylim(len(scenes) - 0.45, -0.55)
    percent_axis(axes)
    axes.set_xlim(0, 108)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("success at tight tolerance, first take (%)")
    figure.legend(loc="outside upper right", ncols=2)
    return figure
