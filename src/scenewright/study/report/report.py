"""Writes the report of an experiment: measurements of its own, tables, figures, and a page that shows them all.

What enters: the folder of an experiment's results. What leaves: a folder with `index.html`, `figures/` and `tables/`.
What the report measures itself is kept beside the results and not measured twice. Results are not changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from scenewright.errors import InputError, OutputError, Place
from scenewright.study.report import loops, precision, times
from scenewright.study.report.contents import Extras, Material, Section, sections_of
from scenewright.study.report.measuring import Bench, Progress
from scenewright.study.report.page import Drawn, render_page
from scenewright.study.report.provenance import of_experiment, of_report
from scenewright.study.report.records import methods_of
from scenewright.study.report.style import DARK, LIGHT, render_png, require_matplotlib
from scenewright.study.report.tables import write_table
from scenewright.study.store import Results, read_results

PAGE_FILE = "index.html"
FIGURES, TABLES = "figures", "tables"


@dataclass(frozen=True, slots=True)
class Sizes:
    """How much the report measures itself."""

    grid: precision.GridSize
    loops: loops.LoopsSize
    times: times.TimesSize


QUICK = Sizes(precision.QUICK, loops.QUICK, times.QUICK)
FULL = Sizes(precision.FULL, loops.FULL, times.FULL)


def write(results_dir: Path, out_dir: Path, sizes: Sizes, progress: Progress | None, workers: int) -> Path:
    """Write the report; see `scenewright.study.report.write_report`."""
    require_matplotlib()
    results = read_results(results_dir)
    if not results.cases.num_rows:
        raise InputError(
            "there are no cases in these results yet",
            place=Place(str(results_dir)),
            expected="at least one case",
            fix="go on with the experiment: the command is in settings.json",
        )
    records = sorted(results.records(), key=lambda r: (r.row, r.ego, r.draw, r.method))
    extras = measure_extras(Bench(results_dir, workers, progress), results, sizes)
    material = Material(
        records,
        results.settings,
        results_dir,
        of_experiment(results.settings),
        of_report(results_dir, results.settings),
        extras,
    )
    return compose(material, out_dir, progress)


def measure_extras(bench: Bench, results: Results, sizes: Sizes) -> Extras:
    """Measure what the experiment does not: precision grid, open against closed loop, times."""
    seed = int(results.settings.get("seed", 0))
    methods = methods_of(results.records())
    return Extras(
        precision.measure_grid(bench, methods, sizes.grid, seed),
        loops.measure_loops(bench, sizes.loops, seed),
        times.measure_translations(bench, sizes.times),
        times.measure_solver(bench, sizes.times, seed),
    )


def compose(material: Material, out_dir: Path, progress: Progress | None = None) -> Path:
    """Write tables, figures and the page, and return the page."""
    sections = sections_of(material)
    page = out_dir / PAGE_FILE
    try:
        for name in (FIGURES, TABLES):
            (out_dir / name).mkdir(parents=True, exist_ok=True)
        for section in sections:
            for shown in section.tables:
                write_table(shown.table, out_dir / TABLES, shown.source.as_dict())
        drawn = _draw(sections, out_dir / FIGURES, progress)
        page.write_text(render_page(material, sections, drawn), encoding="utf-8", newline="\n")
    except OSError as error:
        raise OutputError(
            "the report cannot be written",
            place=Place(str(error.filename or out_dir)),
            found=error.strerror or str(error),
            fix="make room, or choose another folder with --out DIR",
        ) from None
    return page


def _draw(sections: tuple[Section, ...], folder: Path, progress: Progress | None) -> dict[str, Drawn]:
    """Draw every figure in both themes; files hold the light one, the page shows the one that suits the reader."""
    plots = [plot for section in sections for plot in section.plots]
    drawn = {}
    for number, plot in enumerate(plots, start=1):
        source = plot.source
        about = {
            "Title": plot.name,
            "Description": f"{plot.caption} {plot.cases}, seed {source.seed}; {source.versions}; {source.machine}",
            "Comment": source.command,
        }
        light, dark = (render_png(plot.draw, theme, about) for theme in (LIGHT, DARK))
        (folder / f"{plot.name}.png").write_bytes(light)
        (folder / f"{plot.name}_dark.png").write_bytes(dark)
        drawn[plot.name] = Drawn(light, dark)
        if progress is not None:
            progress("figures", number, len(plots))
    return drawn
