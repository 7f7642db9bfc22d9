"""The figures of rates: by family, ego and method, tolerance, take, and the errors at the trigger.

What enters: records and a theme. What leaves: matplotlib figures. The numbers are those of the tables beside them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scenewright.study.report.counting import Which, counted, rate
from scenewright.study.report.explanations import LATER_COLOUR, colour_of
from scenewright.study.report.records import (
    LEVEL_TEXT,
    OURS,
    egos_of,
    first_success,
    grouped,
    methods_of,
    trigger_error,
)
from scenewright.study.report.style import (
    Theme,
    method_colour,
    method_marker,
    new_figure,
    percent_axis,
    say_empty,
)
from scenewright.study.store import CaseRecord
from scenewright.study.summary import LEVEL_NAMES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_INTERACTIONS = ("Hero brakes", "Hero yields", "Hero does not yield", "Hero yields then goes")
_TRIGGERS = ("Distance", "Time")
_TAKES: tuple[Which, ...] = ("first", "best")


def draw_families(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw success by interaction (columns) and trigger (rows); a bar a method."""
    methods = methods_of(records)
    figure = new_figure(10.5, 1.3 + 0.56 * (len(methods) + 1), theme)
    panels = figure.subplots(len(_TRIGGERS), len(_INTERACTIONS), sharex=True, sharey=True, squeeze=False)
    for line, trigger in enumerate(_TRIGGERS):
        for place, interaction in enumerate(_INTERACTIONS):
            axes: Axes = panels[line, place]
            own = [r for r in records if r.interaction == interaction and r.trigger == trigger]
            _bars(axes, own, methods, theme)
            axes.set_title(f"{interaction.removeprefix('Hero ')}, {trigger.lower()}")
            if line == len(_TRIGGERS) - 1:
                axes.set_xlabel("success at tight tolerance (%)")
    _family_legend(figure, theme)
    return figure


def _bars(axes: Axes, records: Sequence[CaseRecord], methods: Sequence[str], theme: Theme) -> None:
    by = grouped(records, lambda record: record.method)
    for place, method in enumerate(methods):
        own = by.get(method, [])
        first, best, loose = (rate(own, "first"), rate(own, "best"), rate(own, "first", "loose"))
        colour = method_colour(method, theme)
        if first.value is None or best.value is None or loose.value is None:
            axes.text(2, place, "no case counted", va="center", fontsize=7.5, color=theme.soft)
            continue
        axes.barh(place, 100 * best.value, 0.68, color=colour, alpha=0.35, linewidth=0)
        axes.barh(place, 100 * first.value, 0.68, color=colour, linewidth=0)
        axes.plot([100 * loose.value] * 2, [place - 0.4, place + 0.4], color=theme.ink, linewidth=1.3)
        axes.text(103, place, f"{100 * first.value:.0f} / {100 * best.value:.0f}", va="center", fontsize=7.5)
    axes.set_yticks(range(len(methods)), methods)
    axes.set_ylim(len(methods) - 0.4, -0.6)
    percent_axis(axes)
    axes.set_xlim(0, 128)
    axes.spines["left"].set_visible(False)
    axes.tick_params(axis="y", length=0)


def _family_legend(figure: Figure, theme: Theme) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Patch(facecolor=theme.soft, label="first take"),
        Patch(facecolor=theme.soft, alpha=0.35, label="best of N"),
        Line2D([], [], color=theme.ink, marker="|", linestyle="none", markersize=10, label="first take, loose"),
        Line2D([], [], linestyle="none", label="numbers: first take / best of N (%)"),
    ]
    figure.legend(handles=handles, loc="outside upper right", ncols=len(handles))


def draw_egos(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw a heat table of egos by methods, first take and best of N."""
    methods, egos = methods_of(records), egos_of(records)
    figure = new_figure(10.5, 1.5 + 0.36 * len(egos), theme)
    panels = figure.subplots(1, 2, sharey=True, squeeze=False)[0]
    by = grouped(records, lambda record: (record.ego, record.method))
    for axes, which, title in zip(panels, _TAKES, ("First take", "Best of N"), strict=True):
        shares = np.full((len(egos), len(methods)), np.nan)
        for i, ego in enumerate(egos):
            for j, method in enumerate(methods):
                value = rate(by.get((ego, method), []), which).value
                shares[i, j] = np.nan if value is None else 100 * value
        _heat(axes, shares, theme)
        axes.set_title(f"{title}: success at tight tolerance (%)")
        axes.set_xticks(range(len(methods)), methods, rotation=25, ha="right", rotation_mode="anchor")
        axes.set_yticks(range(len(egos)), egos)
    return figure


def _heat(axes: Axes, shares: np.ndarray, theme: Theme) -> None:
    axes.imshow(shares, cmap="cividis", vmin=0, vmax=100, aspect="auto")
    for (i, j), value in np.ndenumerate(shares):
        if np.isnan(value):
            axes.text(j, i, "–", ha="center", va="center", color=theme.soft)
        else:
            ink = "#ffffff" if value < 55 else "#15191e"
            axes.text(j, i, f"{value:.0f}", ha="center", va="center", color=ink, fontsize=9)
    axes.set_facecolor(theme.empty)
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)


def draw_tolerance(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw success over the four levels of tolerance, a line a method: solid the first take, dashed the best of N."""
    figure = new_figure(10.5, 4.0, theme)
    axes: Axes = figure.subplots()
    by = grouped(records, lambda record: record.method)
    places = np.arange(len(LEVEL_NAMES))
    for position, method in enumerate(methods_of(records)):
        colour, marker = method_colour(method, theme), method_marker(position)
        for which, line in zip(_TAKES, ("-", (0, (4, 2))), strict=True):
            shares = [rate(by[method], which, level).value for level in LEVEL_NAMES]
            heights = [np.nan if share is None else 100 * share for share in shares]
            label = method if which == "first" else None
            wide = 2.2 if method == OURS else 1.4
            axes.plot(places, heights, linestyle=line, marker=marker, color=colour, linewidth=wide, label=label, ms=5)
    names = [f"{name}\n{text}" for name, text in zip(LEVEL_NAMES, LEVEL_TEXT, strict=True)]
    axes.set_xticks(places, names)
    axes.set_xlabel("tolerance (position, time)")
    axes.set_ylabel("success (%)")
    percent_axis(axes, "y")
    axes.set_ylim(-2, 103)
    axes.plot([], [], color=theme.soft, label="solid: first take")
    axes.plot([], [], color=theme.soft, linestyle=(0, (4, 2)), label="dashed: best of N")
    figure.legend(loc="outside right center")
    return figure


def draw_takes(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw for our method, by ego, with which take it first succeeded."""
    own = counted(record for record in records if record.method == OURS)
    egos = egos_of(own)
    figure = new_figure(10.5, 1.3 + 0.3 * max(1, len(egos)), theme)
    axes: Axes = figure.subplots()
    if not own:
        say_empty(axes, "no case of ours is counted", theme)
        return figure
    by = grouped(own, first_success)
    takes = sorted(take for take in by if take is not None)
    shades = {1: colour_of("success"), 2: LATER_COLOUR, 3: "#bfe3f8"}
    left = np.zeros(len(egos))
    for take in (*takes, None):
        counts = np.array([sum(r.ego == ego for r in by.get(take, [])) for ego in egos], dtype=float)
        totals = np.array([sum(r.ego == ego for r in own) for ego in egos], dtype=float)
        colour = colour_of("missed") if take is None else shades.get(take, "#dcf0fb")
        label = "no success" if take is None else f"success in take {take}"
        share = 100 * counts / totals
        axes.barh(range(len(egos)), share, 0.7, left=left, color=colour, label=label, edgecolor=theme.ground)
        left += share
    axes.set_yticks(range(len(egos)), egos)
    axes.invert_yaxis()
    axes.set_xlabel("share of counted cases (%)")
    percent_axis(axes)
    figure.legend(loc="outside upper center", ncols=4)
    return figure


def draw_trigger_errors(records: Sequence[CaseRecord], theme: Theme) -> Figure:
    """Draw which share of the counted cases was at most so far off at the trigger, by method and kind of trigger."""
    figure = new_figure(10.5, 3.6, theme)
    panels = figure.subplots(1, 2, sharey=True, squeeze=False)[0]
    limits = {"Distance": (0.5, 2.0, "m"), "Time": (0.1, 0.5, "s")}
    over = counted(records)
    for axes, (trigger, (tight, loose, unit)) in zip(panels, limits.items(), strict=True):
        for method in methods_of(records):
            own = [record for record in over if record.trigger == trigger and record.method == method]
            errors = sorted(max(1e-4, e) for e in map(trigger_error, own) if e is not None)
            heights = 100.0 * np.arange(1, len(errors) + 1) / max(1, len(own))
            wide = 2.2 if method == OURS else 1.4
            axes.step(errors, heights, where="post", color=method_colour(method, theme), linewidth=wide, label=method)
        for limit, name in ((tight, "tight"), (loose, "loose")):
            axes.axvline(limit, color=theme.soft, linewidth=0.9, linestyle=":")
            axes.text(limit, 101, name, ha="center", va="bottom", fontsize=8, color=theme.soft)
        axes.set_xscale("log")
        axes.set_xlim(1e-3, 50 if unit == "m" else 10)
        axes.set_xlabel(f"error of the worse side at the trigger, kept take ({unit})")
        axes.set_title(f"Trigger by {trigger.lower()}", pad=14)
        percent_axis(axes, "y")
        axes.set_ylim(0, 101)
    panels[0].set_ylabel("share of counted cases (%)")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside right center")
    return figure
