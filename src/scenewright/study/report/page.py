"""The report's page: one self-contained HTML file that opens offline in any browser, without a script too.

What enters: sections and their figures as PNG. What leaves: HTML. The script only sorts and filters tables and copies
commands; the content security policy allows just it and the one style sheet, and images that are in the page.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING

from scenewright.study.report.counting import RULES, Rate, counted, percent, rate
from scenewright.study.report.explanations import CAUSES, colour_of
from scenewright.study.report.provenance import Provenance
from scenewright.study.report.tables import Column, Table, Value

if TYPE_CHECKING:
    from scenewright.study.report.contents import Material, Plot, Section, Shown

_FILTER_FROM = 12  # tables of at least so many lines get a field to filter by


@dataclass(frozen=True, slots=True)
class Drawn:
    """A figure as PNG, for a light and for a dark page."""

    light: bytes
    dark: bytes


def render_page(material: Material, sections: Sequence[Section], drawn: Mapping[str, Drawn]) -> str:
    """Return the page."""
    style, script = _asset("report.css"), _asset("report.js")
    policy = (
        f"default-src 'none'; img-src data:; style-src '{_hash(style)}'; script-src '{_hash(script)}'; base-uri 'none'"
    )
    tables = [shown.table for section in sections for shown in section.tables]
    return Template(_asset("report.html")).substitute(
        policy=policy,
        style=style,
        script=script,
        subtitle=_subtitle(material),
        source=_source(material.experiment),
        cards=_cards(material),
        rules="".join(f"<li>{_text(rule)}</li>" for rule in RULES),
        contents="".join(f'<li><a href="#{section.id}">{_text(section.title)}</a></li>' for section in sections),
        sections="\n".join(_section(section, drawn) for section in sections),
        files="".join(_files_of(table) for table in tables),
        data=_settings(material),
    )


def _subtitle(material: Material) -> str:
    settings = material.settings
    parts = [f"{len(material.records)} cases"]
    for name in ("rows", "egos", "methods"):
        if isinstance(settings.get(name), list):
            number = len(settings[name])
            parts.append(f"{number} {name if number != 1 else name[:-1]}")
    if "draws" in settings:
        parts.append(f"{settings['draws']} draw{'s' if settings['draws'] != 1 else ''}")
    if "takes" in settings:
        parts.append(f"up to {settings['takes']} takes")
    if "finished" not in settings:
        parts.append("not finished")
    return _text(" · ".join(parts))


def _settings(material: Material) -> str:
    """Return the settings as JSON inside the page, for whoever reads it by program; no text can close the element."""
    text = json.dumps(material.settings, default=str)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


# -- summary --------------------------------------------------------------------------------------------------------
def _cards(material: Material) -> str:
    own = material.own
    cards = [
        ("Tight, first take", rate(own, "first")),
        ("Tight, best of N", rate(own, "best")),
        ("Loose, first take", rate(own, "first", "loose")),
        ("Loose, best of N", rate(own, "best", "loose")),
    ]
    left_out = len(own) - len(counted(own))
    note = (
        f"Ours: {len(own)} cases, {len(own) - left_out} counted, {left_out} left out (proven infeasible, or the ego "
        "never met its side of the trigger)."
    )
    return f'<div class="cards">{"".join(_card(*card) for card in cards)}</div><p class="note">{_text(note)}</p>'


def _card(title: str, found: Rate) -> str:
    value = "–" if found.value is None else percent(found.value)
    interval = found.interval
    bounds = "" if interval is None else f", 95 %: {100 * interval[0]:.1f} to {100 * interval[1]:.1f} %"
    detail = f"{found.successes} of {found.total}{bounds}"
    return f'<div class="card"><span>{_text(title)}</span><strong>{value}</strong><small>{_text(detail)}</small></div>'


# -- sections -------------------------------------------------------------------------------------------------------
def _section(section: Section, drawn: Mapping[str, Drawn]) -> str:
    parts = [f'<section id="{section.id}"><h2>{_text(section.title)}</h2>']
    if section.text:
        parts.append(f"<p>{_text(section.text)}</p>")
    if section.notes:
        parts.append(f'<ul class="notes">{"".join(f"<li>{_text(note)}</li>" for note in section.notes)}</ul>')
    parts += [_figure(plot, drawn[plot.name]) for plot in section.plots]
    parts += [_shown(shown) for shown in section.tables]
    return "\n".join([*parts, "</section>"])


def _figure(plot: Plot, drawn: Drawn) -> str:
    light, dark = (base64.b64encode(png).decode("ascii") for png in (drawn.light, drawn.dark))
    return (
        f'<figure id="figure-{plot.name}"><picture>'
        f'<source media="(prefers-color-scheme: dark)" srcset="data:image/png;base64,{dark}">'
        f'<img src="data:image/png;base64,{light}" alt="{_text(plot.caption)}"></picture>'
        f"<figcaption><p>{_text(plot.caption)}</p>{_source(plot.source, plot.cases)}</figcaption></figure>"
    )


def _source(source: Provenance, cases: str = "") -> str:
    """Return the line that says where something comes from."""
    facts = [cases, f"seed {source.seed}", source.versions, source.machine, source.date]
    told = " · ".join(_text(fact) for fact in facts if fact)
    return f'<p class="source">{told} · <code>{_text(source.command)}</code></p>'


def _shown(shown: Shown) -> str:
    table = shown.table
    lines = f"{len(table.rows)} line{'s' if len(table.rows) != 1 else ''}"
    where = f"{_source(shown.source)}"
    body = _table(table) if table.rows else f'<p class="note">{_text(shown.empty)}</p>'
    links = f'<a href="tables/{table.name}.csv">CSV</a> <a href="tables/{table.name}.json">JSON</a>'
    if shown.folded and table.rows:
        return (
            f'<details class="table" id="table-{table.name}"><summary>{_text(table.title)} <small>{lines}</small>'
            f'</summary><p class="links">{links}</p>{body}{where}</details>'
        )
    return (
        f'<div class="table" id="table-{table.name}"><h3>{_text(table.title)} <small>{lines} {links}</small></h3>'
        f"{body}{where}</div>"
    )


# -- tables ---------------------------------------------------------------------------------------------------------
def _table(table: Table) -> str:
    head = "".join(
        f'<th scope="col" class="{column.kind}"><button type="button">{_text(column.heading)}</button></th>'
        for column in table.columns
        if column.shown
    )
    body = "\n".join(
        f"<tr>{''.join(_cell(*pair) for pair in zip(table.columns, row, strict=True) if pair[0].shown)}</tr>"
        for row in table.rows
    )
    field = ""
    if len(table.rows) >= _FILTER_FROM:
        field = (
            '<p class="filter"><label>Filter <input type="search" autocomplete="off" placeholder="any words"></label> '
            "<output></output></p>"
        )
    scroll = f'<div class="scroll" tabindex="0" role="region" aria-label="{_text(table.title)}">'
    return f"{field}{scroll}<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"


def _cell(column: Column, value: Value) -> str:
    if column.kind == "rate" and isinstance(value, Rate):
        share = -1.0 if value.value is None else value.value
        title = f"{value.successes} of {value.total}"
        bar = "" if value.value is None else f'<meter min="0" max="1" value="{value.value:.4f}"></meter>'
        return f'<td class="rate" data-sort="{share:.6f}" title="{title}">{value}{bar}<small>{title}</small></td>'
    if column.kind == "command" and value:
        text = _text(str(value))
        return f'<td class="command"><code>{text}</code><button type="button" class="copy">copy</button></td>'
    if isinstance(value, bool) or value is None:
        return f'<td class="{column.kind}">{"" if value is None else ("yes" if value else "no")}</td>'
    if isinstance(value, float):
        return f'<td class="{column.kind}" data-sort="{value!r}">{value:.{column.digits}f}</td>'
    if isinstance(value, int):
        return f'<td class="{column.kind}" data-sort="{value}">{value}</td>'
    if column.name == "evidence":
        return f'<td class="text evidence"><div>{_text(str(value))}</div></td>'
    return f'<td class="{column.kind}">{_cause_mark(column, str(value))}{_text(str(value))}</td>'


def _cause_mark(column: Column, value: str) -> str:
    """Return a spot in the colour that figures give a cause; in SVG, for the page allows no inline style."""
    if column.name != "cause" or value not in CAUSES:
        return ""
    spot = f'<rect width="10" height="10" rx="2" fill="{colour_of(value)}"/>'
    return f'<svg class="spot" viewBox="0 0 10 10" aria-hidden="true">{spot}</svg>'


def _files_of(table: Table) -> str:
    name = _text(table.name)
    return f'<li>{_text(table.title)}: <a href="tables/{name}.csv">CSV</a>, <a href="tables/{name}.json">JSON</a></li>'


def _text(text: str) -> str:
    return html.escape(text, quote=True)


def _asset(name: str) -> str:
    return files(__package__).joinpath("assets", name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode('utf-8')).digest()).decode('ascii')}"
