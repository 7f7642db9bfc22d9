"""The figures of outcomes: every case by row and ego in the colour of its cause, and causes by method.

What enters: records and a theme. What leaves: matplotlib figures.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scenewright.study.report.explanations import LATER, colour_of, ordered_causes, shown_cause
from scenewright.study.report.records import OURS, egos_of, grouped, methods_of
from scenewright.study.report.style import Theme, new_figure, say_empty
from scenewright.study.store import CaseRecord

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_INTERACTION_MARKS = {"Hero brakes": "B", "Hero yields": "Y", "Hero does not yield": "N", "Hero yields then goes": "G"}


def draw_rows(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw every case of our method: rows of the benchmark across, egos down, one stripe a draw."""
    own = [record for record in records if record.method == OURS]
    triggers = [trigger for trigger in ("Distance", "Time") if any(r.trigger == trigger for r in own)]
    egos = egos_of(own)
    draws = sorted({record.draw for record in own})
    height = max(1, len(triggers)) * (0.75 + 0.085 * max(4, len(draws)) * max(1, len(egos))) + 0.9
    figure = new_figure(10.5, height, theme)
    panels = figure.subplots(max(1, len(triggers)), 1, squeeze=False)[:, 0]
    if not own:
        say_empty(panels[0], "our method was not run", theme)
        return figure
    shown = sorted({shown_cause(record) for record in own})
    for axes, trigger in zip(panels, triggers, strict=True):
        _stripes(axes, [record for record in own if record.trigger == trigger], egos, draws, shown, theme)
        axes.set_title(f"Trigger by {trigger.lower()}: outcome of every case, ours")
    panels[-1].set_xlabel("row of the benchmark (B brakes, Y yields, N does not yield, G yields then goes)")
    _cause_legend(figure, set(shown))
    return figure


def _stripes(
    axes: Axes,
    records: Sequence[CaseRecord],
    egos: Sequence[str],
    draws: Sequence[int],
    causes: Sequence[str],
    theme: Theme,
) -> None:
    from matplotlib.colors import ListedColormap

    rows = sorted({record.row for record in records})
    codes = np.full((len(egos) * len(draws), len(rows)), np.nan)
    for record in records:
        line = egos.index(record.ego) * len(draws) + draws.index(record.draw)
        codes[line, rows.index(record.row)] = causes.index(shown_cause(record))
    colours = ListedColormap([colour_of(cause) for cause in causes])
    axes.set_facecolor(theme.empty)
    axes.pcolormesh(codes, cmap=colours, vmin=-0.5, vmax=len(causes) - 0.5, edgecolors=theme.ground, linewidth=0.4)
    for line in range(1, len(egos)):
        axes.axhline(line * len(draws), color=theme.ground, linewidth=3)
    middles = [(place + 0.5) * len(draws) for place in range(len(egos))]
    marks = {record.row: _INTERACTION_MARKS.get(record.interaction, "?") for record in records}
    axes.set_yticks(middles, egos)
    axes.set_xticks(np.arange(len(rows)) + 0.5, [f"{marks[row]}\n{row}" for row in rows], fontsize=7)
    axes.invert_yaxis()
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)


def _cause_legend(figure: Figure, causes: set[str]) -> None:
    from matplotlib.patches import Patch

    order = ordered_causes(causes - {LATER})
    if LATER in causes:
        order.insert(1 if "success" in order else 0, LATER)
    handles = [Patch(facecolor=colour_of(cause), label=cause) for cause in order]
    figure.legend(handles=handles, loc="outside lower center", ncols=min(4, max(1, len(handles))))


def draw_causes(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw how the cases of each method fell under causes, best of N."""
    methods = methods_of(records)
    figure = new_figure(10.5, 1.6 + 0.38 * max(1, len(methods)), theme)
    axes: Axes = figure.subplots()
    if not methods:
        say_empty(axes, "there are no cases", theme)
        return figure
    by = grouped(records, lambda record: record.method)
    present = {shown_cause(record) for record in records}
    order = ordered_causes(present - {LATER})
    if LATER in present:
        order.insert(1 if "success" in order else 0, LATER)
    left = np.zeros(len(methods))
    for cause in order:
        counts = np.array([sum(shown_cause(r) == cause for r in by[method]) for method in methods], dtype=float)
        totals = np.array([len(by[method]) for method in methods], dtype=float)
        share = 100 * counts / totals
        axes.barh(range(len(methods)), share, 0.72, left=left, color=colour_of(cause), edgecolor=theme.ground)
        for place in np.flatnonzero(share >= 4):
            ink = "#ffffff" if cause in ("success", "missed", "gave up", "ego left no room") else "#15191e"
            middle = left[place] + share[place] / 2
            axes.text(middle, float(place), f"{counts[place]:.0f}", ha="center", va="center", fontsize=8, color=ink)
        left += share
    axes.set_yticks(range(len(methods)), methods)
    axes.invert_yaxis()
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of all cases (%); numbers are cases")
    axes.spines["left"].set_visible(False)
    axes.tick_params(axis="y", length=0)
    _cause_legend(figure, present)
    return figure
