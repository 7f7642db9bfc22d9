"""Writes the report of an experiment: measurements of its own, tables, figures, and a page that shows them all.

What enters: the folder of an experiment's results. What leaves: its folder `report` with `index.html`, `figures/` and
`tables/`. Results are not changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from scenewright.errors import InputError, OutputError, Place
from scenewright.study.cases import OURS
from scenewright.study.report import extra_figures, figures, loops, outcomes, precision, times
from scenewright.study.report.measuring import Bench, Measured, Progress
from scenewright.study.report.page import Plot, Section, render_page
from scenewright.study.report.style import render_png, require_matplotlib
from scenewright.study.report.tables import write_table
from scenewright.study.rivals import METHODS
from scenewright.study.store import CaseRecord, Results, read_results

FOLDER = "report"


@dataclass(frozen=True, slots=True)
class Extras:
    """What the report measured itself: precision grid, open against closed loop."""

    cells: tuple[precision.Cell, ...] = ()
    loops: Sequence[Measured] = ()


@dataclass(frozen=True, slots=True)
class Material:
    """All that sections are made from."""

    records: Sequence[CaseRecord]
    settings: dict[str, Any]
    folder: Path
    extras: Extras

    @property
    def own(self) -> list[CaseRecord]:
        """The cases of our method."""
        return [record for record in self.records if record.method == OURS]


def write_report(results_dir: Path, *, quick: bool, progress: Progress | None = None, workers: int = 0) -> Path:
    """Write the report of the results in `results_dir`, and return its page.

    What the report measures itself is kept in the folder `extras` of the results, gone on with after a kill, and done
    again only when the code has changed.

    Parameters
    ----------
    quick
        Measure little: a grid of 4 by 4 cells, few egos and draws.
    progress
        Called with the name of a stage, how much of it is done, and how much there is.
    workers
        Processes for what the report runs itself; 0 for this one.

    Raises
    ------
    MissingExtraError
        Where matplotlib is not installed; nothing is measured then.
    InputError
        Where `results_dir` holds no results, or no case yet.
    OutputError
        Where something cannot be written.
    """
    require_matplotlib()
    results = read_results(results_dir)
    if not results.records:
        raise InputError(
            "there are no cases in these results yet",
            place=Place(str(results_dir)),
            expected="at least one case",
            fix="go on with the experiment: the command is in settings.json",
        )
    extras = measure_extras(Bench(results_dir, workers, progress), results, quick)
    return compose(Material(results.records, results.settings, results_dir, extras), results_dir / FOLDER, progress)


def measure_extras(bench: Bench, results: Results, quick: bool) -> Extras:
    """Measure what the experiment does not."""
    seed = int(results.settings.get("seed", 0))
    methods = tuple(dict.fromkeys(record.method for record in results.records))
    egos = ("idm", "dawdler", "noisy") if quick else loops.REACTIVE_EGOS
    return Extras(
        precision.measure_grid(bench, methods, precision.QUICK if quick else precision.FULL, seed),
        loops.measure_loops(bench, egos, 2 if quick else 6, seed),
    )


def compose(material: Material, out_dir: Path, progress: Progress | None = None) -> Path:
    """Write tables, figures and the page, and return the page."""
    sections, page = sections_of(material), out_dir / "index.html"
    plots = [plot for section in sections for plot in section.plots]
    about = {"Comment": str(material.settings.get("command", ""))}
    pngs = {}
    try:
        for name in ("figures", "tables"):
            (out_dir / name).mkdir(parents=True, exist_ok=True)
        for table in [table for section in sections for table in section.files]:
            write_table(table, out_dir / "tables")
        for number, plot in enumerate(plots, start=1):
            pngs[plot.name] = render_png(plot.draw, {"Title": plot.name, "Description": plot.caption, **about})
            (out_dir / "figures" / f"{plot.name}.png").write_bytes(pngs[plot.name])
            if progress is not None:
                progress("figures", number, len(plots))
        text = render_page(material.settings, len(material.records), sections, pngs)
        page.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise OutputError(
            "the report cannot be written",
            place=Place(str(error.filename or out_dir)),
            found=error.strerror or str(error),
            fix="make room, or remove what is in the way",
        ) from None
    return page


# -- sections -------------------------------------------------------------------------------------------------------
def sections_of(material: Material) -> tuple[Section, ...]:
    """Return the sections in the order in which the page shows them."""
    records, own, folder = material.records, material.own, material.folder
    aims = outcomes.aims_table(own, loops.loops_table(material.extras.loops))
    names = [name for name in METHODS if any(record.method.partition(":")[0] == name for record in records)]
    methods = "; ".join(f"{name}: {METHODS[name]}" for name in names)
    return (
        Section("aims", "Aims and what was measured", (aims,)),
        Section("methods", "By method, over the same cases", (outcomes.methods_table(records),), text=f"{methods}."),
        *_rates(records, own),
        Section("takes", "By take", (outcomes.takes_table(own),)),
        Section("failures", "Every remaining failure of ours", (outcomes.failures_table(own, folder),)),
        *_measured(material.extras, own),
        Section("infeasible", "Proven infeasible", (outcomes.proofs_table(records),)),
    )


def _rates(records: Sequence[CaseRecord], own: Sequence[CaseRecord]) -> tuple[Section, ...]:
    family = {"interaction": "interaction", "trigger": "trigger"}
    families = outcomes.rates_table("families", records, (*family, "method"))
    egos = outcomes.rates_table("egos", records, ("ego", "method"))
    rows = outcomes.rates_table("rows", own, ("row", *family))
    told = {
        "families": "Success at tight tolerance. Solid: first take; pale: best of N; line: first take, loose.",
        "egos": "Success at tight tolerance, over the cases counted; a dash where none is.",
        "rows": "Every case of our method: rows of the benchmark across, egos down, one stripe a draw.",
        "tolerance": "At each level the judge's conditions and the row's criteria must all hold.",
    }
    plots = (
        Plot("families", told["families"], lambda: figures.draw_families(records), families),
        Plot("egos", told["egos"], lambda: figures.draw_egos(records), egos),
        Plot("rows", told["rows"], lambda: figures.draw_rows(own), rows),
        Plot(
            "tolerance", told["tolerance"], lambda: figures.draw_tolerance(records), outcomes.tolerance_table(records)
        ),
    )
    titles = ("By family and kind of trigger", "By ego", "By row of the benchmark", "Over tolerance")
    return tuple(Section(plot.name, title, (), (plot,)) for title, plot in zip(titles, plots, strict=True))


def _measured(extras: Extras, own: Sequence[CaseRecord]) -> tuple[Section, ...]:
    both, cells = loops.loops_table(extras.loops), extras.cells
    grid = Plot(
        "precision",
        f"Error of the worse side at the trigger (m). Cross: not met within {precision.MET_M:g} m. Ring: the ego never "
        "came there. Hatched: proven infeasible.",
        lambda: extra_figures.draw_grid(cells),
        precision.grid_table(cells),
    )
    pairs = Plot(
        "loops",
        "Success at tight tolerance, first take; thin lines are 95 % intervals. A case is left out where it is "
        "infeasible or the ego never met its side in both loops.",
        lambda: extra_figures.draw_loops(both),
        both,
    )
    ticks = times.ticks_table([ms for record in own for ms in record.solve_ms])
    grid_text = (
        f"An oncoming hero that wants to turn into the driveway brakes to a stop {precision.STOP_M:g} m before the "
        f"conflict point while the ego ({precision.EGO}), {precision.INITIAL_EGO_M:g} m before it at first, goes "
        "straight on. Both distances at the trigger are varied; one take each."
    )
    loops_text = (
        "Four scenarios between an ego on the road and a hero that turns, with drawn parameters, once in each loop. "
        "Over the benchmark, open-loop above is the same."
    )
    times_text = "Times compare within one machine."
    return (
        Section("precision", "Precision grid", (precision.precision_table(cells),), (grid,), grid_text),
        Section("loops", "Open against closed loop", (), (pairs,), loops_text),
        Section("times", "Times", (ticks,), text=times_text),
    )
