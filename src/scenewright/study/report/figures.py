"""The figures of the experiment: rates by family, by ego and over tolerance; every case by row.

What enters: records. What leaves: matplotlib figures. The numbers are those of the tables beside them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from scenewright.study.cases import OURS
from scenewright.study.report.style import (
    CAUSE_COLOURS,
    EMPTY,
    GROUND,
    INK,
    LATER,
    SOFT,
    bare,
    cause_colour,
    method_colour,
    method_marker,
    new_figure,
    percent_axis,
    say_empty,
)
from scenewright.study.store import CaseRecord
from scenewright.study.summary import LEVEL_NAMES, TAKES, grouped, tally

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MARKS = {"Hero brakes": "B", "Hero yields": "Y", "Hero does not yield": "N", "Hero yields then goes": "G"}
_TRIGGERS = ("Distance", "Time")
_LEVELS = ("0.1 m\n0.02 s", "0.5 m\n0.1 s", "2 m\n0.5 s", "5 m\n1 s")
_DASHED = (0, (4, 2))


def _names(records: Sequence[CaseRecord], what: str) -> list[str]:
    return list(dict.fromkeys(getattr(record, what) for record in records))


# -- rates ----------------------------------------------------------------------------------------------------------
def draw_families(records: Sequence[CaseRecord]) -> Figure:
    """Draw success by interaction (columns) and trigger (rows); a bar a method."""
    methods = _names(records, "method")
    figure = new_figure(10.5, 1.3 + 0.56 * (len(methods) + 1))
    panels = figure.subplots(len(_TRIGGERS), len(_MARKS), sharex=True, sharey=True, squeeze=False)
    for line, trigger in enumerate(_TRIGGERS):
        for place, interaction in enumerate(_MARKS):
            axes: Axes = panels[line, place]
            _bars(axes, [r for r in records if (r.interaction, r.trigger) == (interaction, trigger)], methods)
            axes.set_title(f"{interaction.removeprefix('Hero ')}, {trigger.lower()}")
            if line == len(_TRIGGERS) - 1:
                axes.set_xlabel("success at tight tolerance (%)")
    _family_legend(figure)
    return figure


def _bars(axes: Axes, records: Sequence[CaseRecord], methods: Sequence[str]) -> None:
    by = grouped(records, lambda record: record.method)
    for place, method in enumerate(methods):
        found, colour = tally(by.get(method, [])), method_colour(method)
        first, best, loose = (found.rate(*what).value for what in (("first",), ("best",), ("first", "loose")))
        if first is None or best is None or loose is None:
            axes.text(2, place, "no case counted", va="center", fontsize=7.5, color=SOFT)
            continue
        axes.barh(place, 100 * best, 0.68, color=colour, alpha=0.35, linewidth=0)
        axes.barh(place, 100 * first, 0.68, color=colour, linewidth=0)
        axes.plot([100 * loose] * 2, [place - 0.4, place + 0.4], color=INK, linewidth=1.3)
        axes.text(103, place, f"{100 * first:.0f} / {100 * best:.0f}", va="center", fontsize=7.5)
    axes.set_yticks(range(len(methods)), methods)
    axes.set_ylim(len(methods) - 0.4, -0.6)
    percent_axis(axes)
    axes.set_xlim(0, 128)
    axes.spines["left"].set_visible(False)
    axes.tick_params(axis="y", length=0)


def _family_legend(figure: Figure) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Patch(facecolor=SOFT, label="first take"),
        Patch(facecolor=SOFT, alpha=0.35, label="best of N"),
        Line2D([], [], color=INK, marker="|", linestyle="none", markersize=10, label="first take, loose"),
        Line2D([], [], linestyle="none", label="numbers: first take / best of N (%)"),
    ]
    figure.legend(handles=handles, loc="outside upper right", ncols=len(handles))


def draw_egos(records: Sequence[CaseRecord]) -> Figure:
    """Draw a heat table of egos by methods, first take and best of N."""
    methods, egos = _names(records, "method"), _names(records, "ego")
    figure = new_figure(10.5, 1.5 + 0.36 * len(egos))
    panels = figure.subplots(1, 2, sharey=True, squeeze=False)[0]
    by = grouped(records, lambda record: (record.ego, record.method))
    for axes, which, title in zip(panels, TAKES, ("First take", "Best of N"), strict=True):
        rates = [[tally(by.get((ego, method), [])).rate(which).value for method in methods] for ego in egos]
        shares = np.array([[np.nan if value is None else 100 * value for value in line] for line in rates])
        axes.imshow(shares, cmap="cividis", vmin=0, vmax=100, aspect="auto")
        for (i, j), value in np.ndenumerate(shares):
            text, ink = ("-", SOFT) if np.isnan(value) else (f"{value:.0f}", GROUND if value < 55 else INK)
            axes.text(j, i, text, ha="center", va="center", color=ink)
        axes.set_facecolor(EMPTY)
        bare(axes)
        axes.set_title(f"{title}: success at tight tolerance (%)")
        axes.set_xticks(range(len(methods)), methods, rotation=25, ha="right", rotation_mode="anchor")
        axes.set_yticks(range(len(egos)), egos)
    return figure


def draw_tolerance(records: Sequence[CaseRecord]) -> Figure:
    """Draw success over the four levels of tolerance, a line a method: solid the first take, dashed the best of N."""
    figure = new_figure(10.5, 4.0)
    axes: Axes = figure.subplots()
    for position, (method, own) in enumerate(grouped(records, lambda record: record.method).items()):
        found, colour, marker = tally(own), method_colour(method), method_marker(position)
        for which, line in zip(TAKES, ("-", _DASHED), strict=True):
            shares = [found.rate(which, level).value for level in LEVEL_NAMES]
            heights = [np.nan if share is None else 100 * share for share in shares]
            label = method if which == "first" else None
            wide = 2.2 if method == OURS else 1.4
            axes.plot(range(4), heights, linestyle=line, marker=marker, color=colour, linewidth=wide, label=label, ms=5)
    axes.set_xticks(range(4), [f"{name}\n{text}" for name, text in zip(LEVEL_NAMES, _LEVELS, strict=True)])
    axes.set_xlabel("tolerance (position, time)")
    axes.set_ylabel("success (%)")
    percent_axis(axes, "y")
    axes.set_ylim(-2, 103)
    axes.plot([], [], color=SOFT, label="solid: first take")
    axes.plot([], [], color=SOFT, linestyle=_DASHED, label="dashed: best of N")
    figure.legend(loc="outside right center")
    return figure


# -- every case -----------------------------------------------------------------------------------------------------
def draw_rows(own: Sequence[CaseRecord]) -> Figure:
    """Draw every case of our method: rows of the benchmark across, egos down, one stripe a draw."""
    triggers = [trigger for trigger in _TRIGGERS if any(r.trigger == trigger for r in own)]
    egos, draws = _names(own, "ego"), sorted({record.draw for record in own})
    height = max(1, len(triggers)) * (0.75 + 0.085 * max(4, len(draws)) * max(1, len(egos))) + 0.9
    figure = new_figure(10.5, height)
    panels = figure.subplots(max(1, len(triggers)), 1, squeeze=False)[:, 0]
    if not own:
        say_empty(panels[0], "our method was not run")
        return figure
    present = {_shown(record) for record in own}
    shown = [cause for cause in CAUSE_COLOURS if cause in present] + sorted(present - set(CAUSE_COLOURS))
    for axes, trigger in zip(panels, triggers, strict=True):
        _stripes(axes, [record for record in own if record.trigger == trigger], egos, draws, shown)
        axes.set_title(f"Trigger by {trigger.lower()}: outcome of every case, ours")
    panels[-1].set_xlabel("row of the benchmark (B brakes, Y yields, N does not yield, G yields then goes)")
    _cause_legend(figure, shown)
    return figure


def _shown(record: CaseRecord) -> str:
    """Return the cause, with successes told apart by whether the first take was one."""
    return LATER if record.cause == "success" and not record.first_tight else record.cause


def _stripes(
    axes: Axes, records: Sequence[CaseRecord], egos: Sequence[str], draws: Sequence[int], causes: Sequence[str]
) -> None:
    from matplotlib.colors import ListedColormap

    marks = {record.row: _MARKS.get(record.interaction, "?") for record in sorted(records, key=lambda r: r.row)}
    rows = list(marks)
    codes = np.full((len(egos) * len(draws), len(rows)), np.nan)
    for record in records:
        line = egos.index(record.ego) * len(draws) + draws.index(record.draw)
        codes[line, rows.index(record.row)] = causes.index(_shown(record))
    colours = ListedColormap([cause_colour(cause) for cause in causes])
    axes.set_facecolor(EMPTY)
    axes.pcolormesh(codes, cmap=colours, vmin=-0.5, vmax=len(causes) - 0.5, edgecolors=GROUND, linewidth=0.4)
    for line in range(1, len(egos)):
        axes.axhline(line * len(draws), color=GROUND, linewidth=3)
    axes.set_yticks([(place + 0.5) * len(draws) for place in range(len(egos))], egos)
    axes.set_xticks(np.arange(len(rows)) + 0.5, [f"{marks[row]}\n{row}" for row in rows], fontsize=7)
    axes.invert_yaxis()
    bare(axes)


def _cause_legend(figure: Figure, causes: Sequence[str]) -> None:
    from matplotlib.patches import Patch

    handles = [Patch(facecolor=cause_colour(cause), label=cause) for cause in causes]
    figure.legend(handles=handles, loc="outside lower center", ncols=min(4, max(1, len(handles))))
