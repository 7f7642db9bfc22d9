"""What the report shows, in order: sections with their figures and tables.

What enters: records, own measurements, where both come from. What leaves: sections as data. Nothing is drawn or written
here.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from scenewright.study.report.aims import aims_table
from scenewright.study.report.explanations import meaning_of, ordered_causes
from scenewright.study.report.extra_figures import draw_grid, draw_loops, draw_solver, draw_translations
from scenewright.study.report.failures_tables import (
    causes_table,
    disagreements_table,
    failures_table,
    proofs_table,
)
from scenewright.study.report.loops import loops_table
from scenewright.study.report.measuring import Measured
from scenewright.study.report.outcome_figures import draw_causes, draw_rows
from scenewright.study.report.precision import EGO, INITIAL_EGO_M, MET_M, STOP_M, Cell
from scenewright.study.report.precision_tables import grid_table, precision_table
from scenewright.study.report.provenance import Provenance
from scenewright.study.report.rates_figures import (
    draw_egos,
    draw_families,
    draw_takes,
    draw_tolerance,
    draw_trigger_errors,
)
from scenewright.study.report.rates_tables import (
    egos_table,
    families_table,
    methods_table,
    outcomes_table,
    rows_table,
    takes_table,
    tolerance_table,
)
from scenewright.study.report.records import OURS
from scenewright.study.report.style import Theme
from scenewright.study.report.tables import Table
from scenewright.study.report.times import solver_table, ticks_table, translations_table
from scenewright.study.rivals import METHODS
from scenewright.study.store import CaseRecord

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_TICK_MS = 100.0  # between two re-plans


@dataclass(frozen=True, slots=True)
class Plot:
    """A figure: its file's name, what it shows in words, how it is drawn, and over how many cases."""

    name: str
    caption: str
    draw: Callable[[Theme], Figure]
    cases: str
    source: Provenance


@dataclass(frozen=True, slots=True)
class Shown:
    """A table with where it comes from; long ones are folded, and only parts of others are for people to read."""

    table: Table
    source: Provenance
    folded: bool = False
    empty: str = "None."


@dataclass(frozen=True, slots=True)
class Section:
    """One section of the page."""

    id: str
    title: str
    text: str = ""
    notes: tuple[str, ...] = ()
    plots: tuple[Plot, ...] = ()
    tables: tuple[Shown, ...] = ()


@dataclass(frozen=True, slots=True)
class Extras:
    """What the report measured itself."""

    cells: tuple[Cell, ...] = ()
    loops: Sequence[Measured] = ()
    translations: Sequence[Measured] = ()
    solver_calls: Sequence[Measured] = ()


@dataclass(frozen=True, slots=True)
class Material:
    """All that sections are made from."""

    records: Sequence[CaseRecord]
    settings: dict[str, Any]
    folder: Path
    experiment: Provenance
    report: Provenance
    extras: Extras = field(default_factory=Extras)

    @property
    def own(self) -> list[CaseRecord]:
        """The cases of our method."""
        return [record for record in self.records if record.method == OURS]


def sections_of(material: Material) -> tuple[Section, ...]:
    """Return the sections in the order in which the page shows them."""
    return (
        _aims(material),
        _methods(material),
        _families(material),
        _egos(material),
        _rows(material),
        _tolerance(material),
        _takes(material),
        _failures(material),
        _precision(material),
        _loops(material),
        _times(material),
        _proofs(material),
    )


def _n(records: Sequence[CaseRecord]) -> str:
    return f"{len(records)} cases"


def _aims(material: Material) -> Section:
    table = aims_table(material.records, loops_table(material.extras.loops))
    return Section("aims", "Aims and what was measured", tables=(Shown(table, material.experiment),))


def _methods(material: Material) -> Section:
    records, source = material.records, material.experiment
    notes = tuple(f"{name}: {METHODS[name]}" for name in METHODS if any(r.method == name for r in records))
    caption = "Outcome of every case by cause; best of N takes. Grey and orange are left out of rates."
    plot = Plot("causes", caption, lambda theme: draw_causes(records, theme), _n(records), source)
    tables = (Shown(methods_table(records), source), Shown(causes_table(records), source, folded=True))
    text = "The same cases, egos, seeds and judge for all."
    return Section("methods", "Methods over the same cases", text, notes, (plot,), tables)


def _families(material: Material) -> Section:
    records, source = material.records, material.experiment
    caption = (
        "Success at tight tolerance by interaction and kind of trigger. Solid: first take; pale: best of N; line: "
        "first take at loose tolerance."
    )
    plot = Plot("families", caption, lambda theme: draw_families(records, theme), _n(records), source)
    table = Shown(families_table(records), source, folded=True)
    return Section("families", "By family and kind of trigger", plots=(plot,), tables=(table,))


def _egos(material: Material) -> Section:
    records, source = material.records, material.experiment
    caption = "Success at tight tolerance by ego and method, over the cases counted; a dash where none is."
    plot = Plot("egos", caption, lambda theme: draw_egos(records, theme), _n(records), source)
    return Section("egos", "By ego", plots=(plot,), tables=(Shown(egos_table(records), source, folded=True),))


def _rows(material: Material) -> Section:
    own, source = material.own, material.experiment
    caption = (
        "Every case of our method: rows of the benchmark across, egos down, one stripe a draw, colour the outcome."
    )
    plot = Plot("rows", caption, lambda theme: draw_rows(own, theme), _n(own), source)
    tables = (Shown(rows_table(own), source, folded=True), Shown(outcomes_table(own), source, folded=True))
    return Section("rows", "By row of the benchmark", plots=(plot,), tables=tables)


def _tolerance(material: Material) -> Section:
    records, source = material.records, material.experiment
    plots = (
        Plot(
            "tolerance",
            "Success over tolerance. At each level the judge's conditions and the row's criteria must all hold.",
            lambda theme: draw_tolerance(records, theme),
            _n(records),
            source,
        ),
        Plot(
            "trigger_errors",
            "How far off the worse side was at the trigger in the kept take: share of counted cases at "
            "most so far off. A curve ends below 100 % where the trigger could not be judged in the rest.",
            lambda theme: draw_trigger_errors(records, theme),
            _n(records),
            source,
        ),
    )
    table = Shown(tolerance_table(records), source, folded=True)
    return Section("tolerance", "Over tolerance", plots=plots, tables=(table,))


def _takes(material: Material) -> Section:
    own, source = material.own, material.experiment
    caption = "With which take our method first succeeded at tight tolerance, by ego."
    plot = Plot("takes", caption, lambda theme: draw_takes(own, theme), _n(own), source)
    return Section("takes", "By take", plots=(plot,), tables=(Shown(takes_table(own), source),))


def _failures(material: Material) -> Section:
    own, source = material.own, material.experiment
    failed = failures_table(own, material.folder)
    causes = ordered_causes({str(cause) for cause in failed.column("cause")})
    notes = tuple(f"{cause}: {meaning_of(cause)}" for cause in causes)
    tables = (
        Shown(failed, source, empty="Every case of our method succeeded or is proven infeasible."),
        Shown(disagreements_table(material.records), source, folded=True, empty="Judge and criteria agree in all."),
    )
    return Section("failures", "Every remaining failure of ours", "", notes, (), tables)


def _precision(material: Material) -> Section:
    cells, source = material.extras.cells, material.report
    text = (
        f"An oncoming hero that wants to turn into the driveway brakes to a stop {STOP_M:g} m before the conflict "
        f"point while the ego, {INITIAL_EGO_M:g} m before it at first, goes straight on. Both distances at the trigger"
        " are varied; one take each."
        f" The ego is {EGO}."
    )
    caption = (
        f"Error of the worse side at the trigger (m). Cross: not met within {MET_M:g} m. Ring: the ego never came "
        "there. Hatched: proven infeasible."
    )
    ours = [cell for cell in cells if cell.method == OURS]
    cases = f"{len(cells)} runs" + (f", {len(ours)} cells a method" if ours else "")
    plot = Plot("precision", caption, lambda theme: draw_grid(cells, theme), cases, source)
    tables = (Shown(precision_table(cells), source), Shown(grid_table(cells), source, folded=True))
    return Section("precision", "Precision grid", text, plots=(plot,), tables=tables)


def _loops(material: Material) -> Section:
    loops, records = material.extras.loops, material.records
    table = loops_table(loops)
    text = (
        "Four scenarios between an ego on the road and a hero that turns, with drawn parameters, once in each loop; "
        "and the benchmark's first takes. A case is left out where it is infeasible or the ego never met its side in "
        "both loops. Thin lines are 95 % intervals."
    )
    both = [record for record in records if record.method in (OURS, "open-loop")]
    caption = "Success at tight tolerance, first take, in open and in closed loop."
    cases = f"{len(loops)} runs left, {len(both)} right"
    plot = Plot("loops", caption, lambda theme: draw_loops(table, both, theme), cases, material.report)
    return Section("loops", "Open against closed loop", text, plots=(plot,), tables=(Shown(table, material.report),))


def _times(material: Material) -> Section:
    extras, source = material.extras, material.report
    ticks = [ms for record in material.own for ms in record.solve_ms]
    late = sum(ms > _TICK_MS for ms in ticks)
    readings = sum(len(record.get("ms", ())) for record in extras.translations)
    refused = sum("ms" not in record for record in extras.translations)
    plots = (
        Plot(
            "translation_times",
            "Time of the offline translator for one of the benchmark's descriptions that it understands; over length.",
            lambda theme: draw_translations(extras.translations, theme),
            f"{readings} translations of {len(extras.translations)} descriptions, {refused} refused",
            source,
        ),
        Plot(
            "solver_times",
            "Time of one solver call over the number of constraints. A call builds the text, solves and reads back.",
            lambda theme: draw_solver(extras.solver_calls, theme),
            f"{len(extras.solver_calls)} calls",
            source,
        ),
    )
    tables = (
        Shown(translations_table(extras.translations), source),
        Shown(solver_table(extras.solver_calls), source, folded=True),
        Shown(ticks_table(ticks, late), material.experiment),
    )
    text = "Times compare within one machine. Re-plans in the experiment ran beside other processes."
    return Section("times", "Times", text, plots=plots, tables=tables)


def _proofs(material: Material) -> Section:
    table = proofs_table(material.records)
    text = "Draws for which the solver proved that nobody can drive them; the same for every method, never counted."
    shown = Shown(table, material.experiment, folded=True, empty="No draw is proven infeasible.")
    return Section("infeasible", "Proven infeasible", text, tables=(shown,))
