"""The report's page: one self-contained HTML file that opens offline in any browser; there is no script in it.

What enters: sections and their figures as PNG. What leaves: HTML. The content security policy allows just the one style
sheet, and images that are in the page.
"""

from __future__ import annotations

import base64
import hashlib
import html
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Any

from scenewright.study.experiment import circumstances
from scenewright.study.report.style import cause_colour
from scenewright.study.report.tables import Table, Value
from scenewright.study.summary import Rate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LONG = 12  # tables of more lines are folded


@dataclass(frozen=True, slots=True)
class Plot:
    """A figure: its file's name, what it shows in words, how it is drawn, and the table of what it shows, if any."""

    name: str
    caption: str
    draw: Callable[[], Figure]
    data: Table | None = None


@dataclass(frozen=True, slots=True)
class Section:
    """One section of the page; what its figures show is in their tables' files alone."""

    id: str
    title: str
    tables: tuple[Table, ...] = ()
    plots: tuple[Plot, ...] = ()
    text: str = ""

    @property
    def files(self) -> tuple[Table, ...]:
        """Every table, shown or not."""
        return (*self.tables, *(plot.data for plot in self.plots if plot.data is not None))


def render_page(settings: Mapping[str, Any], cases: int, sections: Sequence[Section], pngs: Mapping[str, bytes]) -> str:
    """Return the page."""
    style = _asset("report.css")
    return Template(_asset("report.html")).substitute(
        policy=f"default-src 'none'; img-src data:; style-src 'sha256-{_digest(style)}'; base-uri 'none'",
        style=style,
        subtitle=_text(_subtitle(settings, cases)),
        source=_text(_source(settings)),
        measured=_text(_source(circumstances())),
        command=_text(str(settings.get("command", ""))),
        contents="".join(f'<li><a href="#{section.id}">{_text(section.title)}</a></li>' for section in sections),
        sections="\n".join(_section(section, pngs) for section in sections),
    )


def _subtitle(settings: Mapping[str, Any], cases: int) -> str:
    """Return what was run, in numbers."""
    counts = {"cases": cases}
    counts |= {name: len(settings[name]) for name in ("rows", "egos", "methods") if name in settings}
    counts |= {name: settings[name] for name in ("draws", "takes") if name in settings}
    parts = [f"{count} {name if count != 1 else name.removesuffix('s')}" for name, count in counts.items()]
    return " · ".join([*parts, *([] if "finished" in settings else ["not finished"])])


def _source(settings: Mapping[str, Any]) -> str:
    """Return where something comes from: seed, versions, machine, date."""
    packages = {"scenewright": settings.get("version", "?"), **(settings.get("packages") or {})}
    machine = settings.get("machine") or {}
    facts = [
        f"seed {settings['seed']}" if "seed" in settings else "",
        ", ".join(f"{name} {number}" for name, number in packages.items()),
        f"revision {settings['revision']}" if settings.get("revision") else "",
        f"{machine.get('cpu')}, {machine.get('cores')} cores, {machine.get('system')}" if machine else "",
        str(settings.get("started", ""))[:16].replace("T", " "),
    ]
    return " · ".join(filter(None, facts))


def _section(section: Section, pngs: Mapping[str, bytes]) -> str:
    parts = [f'<section id="{section.id}"><h2>{_text(section.title)}</h2>']
    if section.text:
        parts.append(f"<p>{_text(section.text)}</p>")
    parts += [_figure(plot, pngs[plot.name]) for plot in section.plots]
    parts += [_shown(table) for table in section.tables]
    return "\n".join([*parts, "</section>"])


def _figure(plot: Plot, png: bytes) -> str:
    image = base64.b64encode(png).decode("ascii")
    data = "" if plot.data is None else f" {_link(plot.data)}"
    return (
        f'<figure id="figure-{plot.name}"><img src="data:image/png;base64,{image}" alt="{_text(plot.caption)}">'
        f"<figcaption>{_text(plot.caption)}{data}</figcaption></figure>"
    )


def _shown(table: Table) -> str:
    name = f'id="table-{table.name}"'
    if not table.rows:
        return f"<p {name}>{_text(table.empty)}</p>"
    head = "".join(f'<th scope="col">{_text(heading)}</th>' for heading in table.columns.values())
    body = "\n".join(f"<tr>{''.join(map(_cell, table.columns, row))}</tr>" for row in table.rows)
    rows = f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
    shown = f'<div class="scroll" tabindex="0">{rows}</div><p class="note">{_text(table.title)} {_link(table)}</p>'
    if len(table.rows) <= _LONG:
        return f"<div {name}>{shown}</div>"
    return f"<details {name}><summary>{len(table.rows)} lines</summary>{shown}</details>"


def _cell(name: str, value: Value) -> str:
    if isinstance(value, Rate):
        return f'<td class="rate">{value}<small>{value.successes} of {value.total}</small></td>'
    if isinstance(value, float):
        return f'<td class="number">{value:.2f}</td>'
    if isinstance(value, int):
        return f'<td class="number">{value}</td>'
    text = _text(value or "")
    if name == "command":
        return f'<td class="command"><code>{text}</code></td>'
    mark = ""
    if name == "cause":  # in SVG, for the page allows no inline style
        spot = f'<rect width="10" height="10" rx="2" fill="{cause_colour(value or "")}"/>'
        mark = f'<svg class="spot" viewBox="0 0 10 10" aria-hidden="true">{spot}</svg>'
    return f'<td class="{name}">{mark}{text}</td>'


def _link(table: Table) -> str:
    return f'<a href="tables/{table.name}.csv">{table.name}.csv</a>'


def _text(text: str) -> str:
    return html.escape(text, quote=True)


def _asset(name: str) -> str:
    return files(__package__).joinpath("assets", name).read_text(encoding="utf-8")


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
