"""The figures of the report's own measurements: precision grid, open against closed loop, times.

What enters: what those measured, and a theme. What leaves: matplotlib figures.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scenewright.study.report.counting import Rate, rate
from scenewright.study.report.loops import MODES, SCENES
from scenewright.study.report.measuring import Measured
from scenewright.study.report.precision import MET_M, Cell
from scenewright.study.report.records import OURS, grouped
from scenewright.study.report.style import Theme, method_colour, new_figure, percent_axis, say_empty
from scenewright.study.report.tables import Table
from scenewright.study.report.times import bin_of
from scenewright.study.store import CaseRecord

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage

_MODE_METHOD = {"open": "open-loop", "closed": OURS}


# -- precision ------------------------------------------------------------------------------------------------------
def draw_grid(cells: Sequence[Cell], theme: Theme) -> Figure:
    """Draw the error at the trigger over both distances, one panel a method."""
    from matplotlib.colors import LogNorm

    methods = list(dict.fromkeys(cell.method for cell in cells))
    wide = min(3, max(1, len(methods)))
    deep = -(-max(1, len(methods)) // wide)
    figure = new_figure(10.5 if wide > 1 else 5.6, 0.9 + 3.3 * deep, theme)
    panels = figure.subplots(deep, wide, sharex=True, sharey=True, squeeze=False)
    for axes in panels.flat[len(methods) :]:
        axes.set_axis_off()
    if not methods:
        say_empty(panels.flat[0], "nothing was measured", theme)
        return figure
    norm = LogNorm(0.01, 20.0)
    for place, method in enumerate(methods):
        axes = panels.flat[place]
        image = _panel(axes, [cell for cell in cells if cell.method == method], norm, theme)
        axes.set_title(method)
        if place % wide == 0:
            axes.set_ylabel("hero before the conflict\npoint at the trigger (m)")
        if place + wide >= len(methods):
            axes.set_xlabel("ego before the conflict point at the trigger (m)")
    bar = figure.colorbar(image, ax=panels, shrink=0.85, aspect=30, pad=0.015, extend="both")
    bar.set_label("error of the worse side at the trigger (m)")
    bar.set_ticks([0.01, 0.1, 0.5, 2.0, 20.0], labels=["0.01", "0.1", "0.5", "2", "20"])
    bar.outline.set_visible(False)
    _grid_legend(figure, any(cell.fault for cell in cells), theme)
    return figure


def _panel(axes: Axes, cells: Sequence[Cell], norm: Normalize, theme: Theme) -> AxesImage:
    egos, heroes = sorted({cell.ego_m for cell in cells}), sorted({cell.hero_m for cell in cells})
    errors = np.full((len(heroes), len(egos)), np.nan)
    for cell in cells:
        i, j = heroes.index(cell.hero_m), egos.index(cell.ego_m)
        if cell.infeasible:
            _mark_infeasible(axes, i, j, theme)
        elif cell.fault:
            axes.text(j, i, "?", ha="center", va="center", color=theme.soft)
        elif cell.ego_never_met:
            axes.plot(j, i, marker="o", color=theme.ink, markersize=6, fillstyle="none")
        elif not cell.met:
            axes.plot(j, i, marker="x", color=_cross_colour(cell, theme), markersize=6, markeredgewidth=1.6)
        if not cell.infeasible and cell.error_m is not None:
            errors[i, j] = max(cell.error_m, 1e-3)
    axes.set_facecolor(theme.empty)
    image = axes.imshow(errors, cmap="cividis", norm=norm, origin="lower", aspect="auto")
    axes.set_xticks(range(len(egos)), [f"{value:g}" for value in egos])
    axes.set_yticks(range(len(heroes)), [f"{value:g}" for value in heroes])
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)
    return image


def _mark_infeasible(axes: Axes, i: int, j: int, theme: Theme) -> None:
    from matplotlib.patches import Rectangle

    where = (j - 0.5, i - 0.5)
    axes.add_patch(Rectangle(where, 1, 1, facecolor=theme.line, edgecolor=theme.soft, hatch="////", linewidth=0))


def _cross_colour(cell: Cell, theme: Theme) -> str:
    # The top of the colour scale is bright in both themes; a cell without an error shows the ground.
    return theme.ink if cell.error_m is None else "#15191e"


def _grid_legend(figure: Figure, faults: bool, theme: Theme) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Line2D([], [], color=theme.ink, marker="x", linestyle="none", label=f"trigger not met within {MET_M:g} m"),
        Line2D([], [], color=theme.ink, marker="o", fillstyle="none", linestyle="none", label="ego never came there"),
        Patch(facecolor=theme.line, edgecolor=theme.soft, hatch="////", linewidth=0, label="proven infeasible"),
    ]
    if faults:
        handles.append(Line2D([], [], color=theme.soft, marker="$?$", linestyle="none", label="no run"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4)


# -- open against closed loop ---------------------------------------------------------------------------------------
def draw_loops(table: Table, records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw both modes over the four scenarios, and over the benchmark by interaction."""
    figure = new_figure(10.5, 3.9, theme)
    left, right = figure.subplots(1, 2, sharex=True, squeeze=False)[0]
    rates = {(row[0], row[1]): rate for row in table.rows if isinstance(rate := row[4], Rate)}
    four = {SCENES.get(str(scene), "all four"): scene for scene in dict.fromkeys(table.column("scene"))}
    _pairs(left, {label: {mode: rates[scene, mode] for mode in MODES} for label, scene in four.items()}, theme)
    left.set_title("Four scenarios, reactive egos")
    _pairs(right, _over_benchmark(records), theme)
    right.set_title("Benchmark, all egos of the experiment")
    for axes in (left, right):
        axes.set_xlabel("success at tight tolerance, first take (%)")
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=2)
    return figure


def _over_benchmark(records: Sequence[CaseRecord]) -> dict[str, dict[str, Rate]]:
    pairs = {}
    by = grouped(records, lambda record: (record.interaction, record.method))
    for interaction in [*dict.fromkeys(record.interaction for record in records), "all"]:
        pairs[interaction] = {
            mode: rate(
                [r for (kind, m), own in by.items() for r in own if m == method and interaction in (kind, "all")],
                "first",
            )
            for mode, method in _MODE_METHOD.items()
        }
    return pairs


def _pairs(axes: Axes, pairs: dict[str, dict[str, Rate]], theme: Theme) -> None:
    for place, rates in enumerate(pairs.values()):
        for mode, offset in zip(MODES, (-0.19, 0.19), strict=True):
            found = rates[mode]
            share = 0.0 if found.value is None else 100 * found.value
            label = f"{mode} loop" if place == 0 else None
            colour = method_colour(_MODE_METHOD[mode], theme)
            axes.barh(place + offset, share, 0.36, color=colour, label=label, linewidth=0)
            text = "not run" if found.value is None else f"{share:.0f}"
            end = share
            if found.interval is not None:
                low, end = (100 * bound for bound in found.interval)
                axes.plot([low, end], [place + offset] * 2, color=theme.ink, linewidth=0.9, alpha=0.55)
            axes.text(end + 1.5, place + offset, text, va="center", fontsize=8)
    axes.set_yticks(range(len(pairs)), list(pairs))
    axes.set_ylim(len(pairs) - 0.45, -0.55)
    percent_axis(axes)
    axes.set_xlim(0, 112)
    axes.tick_params(axis="y", length=0)


# -- times ----------------------------------------------------------------------------------------------------------
def draw_translations(records: Sequence[Measured], theme: Theme) -> Figure:
    """Draw the distribution of translation times, and time over length."""
    figure = new_figure(10.5, 3.2, theme)
    left, right = figure.subplots(1, 2, squeeze=False)[0]
    done = [record for record in records if "ms" in record]
    times = np.sort([ms for record in done for ms in record["ms"]])
    if not len(times):
        for axes in (left, right):
            say_empty(axes, "nothing was measured", theme)
        return figure
    left.step(times, 100.0 * np.arange(1, len(times) + 1) / len(times), where="post", color=method_colour(OURS, theme))
    for percent in (50, 99):
        value = float(np.percentile(times, percent))
        left.axvline(value, color=theme.soft, linewidth=0.9, linestyle=":")
        left.text(value, 3, f" p{percent} {value:.1f} ms", fontsize=8, color=theme.ink, ha="left")
    left.set_xlabel("time to translate one description (ms)")
    left.set_ylabel("share of translations (%)")
    left.set_xlim(0, 1.3 * float(times[-1]))
    percent_axis(left, "y")
    words = [record["words"] for record in done]
    middle = [float(np.median(record["ms"])) for record in done]
    right.plot(words, middle, linestyle="none", marker="o", markersize=3.5, alpha=0.6, color=method_colour(OURS, theme))
    right.set_xlabel("words in the description")
    right.set_ylabel("time (ms)")
    right.set_ylim(bottom=0)
    right.grid(True)
    return figure


def draw_solver(calls: Sequence[Measured], theme: Theme) -> Figure:
    """Draw the time of solver calls over the number of constraints, satisfiable and unsatisfiable apart."""
    figure = new_figure(10.5, 3.7, theme)
    panels = figure.subplots(1, 2, sharey=True, sharex=True, squeeze=False)[0]
    for axes, answer in zip(panels, ("sat", "unsat"), strict=True):
        own = [call for call in calls if call["answer"] == answer]
        for stage, colour in _stage_colours(theme).items():
            some = [call for call in own if call["stage"] == stage]
            x, y = [call["constraints"] for call in some], [call["ms"] for call in some]
            axes.plot(x, y, linestyle="none", marker=".", markersize=4, alpha=0.45, color=colour, label=stage)
        _percentile_lines(axes, [call for call in own if call["stage"] in ("re-solve", "first plan")], theme)
        axes.set_yscale("log")
        axes.set_title(f"{answer}: {len(own)} calls")
        axes.set_xlabel("constraints in the problem")
        axes.grid(True)
    panels[0].set_ylabel("time of one solver call (ms)")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=6, markerscale=2)
    return figure


def _stage_colours(theme: Theme) -> dict[str, str]:
    names = {"re-solve": OURS, "first plan": "trigger-action", "feasibility": "rejection", "hindsight": "synchronise"}
    return {stage: method_colour(method, theme) for stage, method in names.items()}


def _percentile_lines(axes: Axes, calls: Sequence[Measured], theme: Theme) -> None:
    bins: dict[int, list[float]] = {}
    for call in calls:
        bins.setdefault(bin_of(call["constraints"]), []).append(call["ms"])
    edges = sorted(edge for edge, times in bins.items() if len(times) >= 5)
    for percent, line in ((50, "-"), (99, "--")):
        heights = [float(np.percentile(bins[edge], percent)) for edge in edges]
        label = f"p{percent} of re-solves and plans"
        axes.plot([edge + 5 for edge in edges], heights, linestyle=line, color=theme.ink, linewidth=1.5, label=label)
