"""The report of an experiment: figures, tables, measurements of its own, and a page that shows them.

What enters: the folder of an experiment's results. What leaves: a folder with `index.html`, `figures/` and `tables/`.
Importing this package loads nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path


def write_report(
    results_dir: Path,
    out_dir: Path,
    *,
    quick: bool,
    progress: Callable[[str, int, int], None] | None = None,
    workers: int = 0,
) -> Path:
    """Write the report of the results in `results_dir` into `out_dir`.

    What the report measures itself (precision grid, open against closed loop, times) is kept in the folder `extras` of
    the results, gone on with after a kill, and done again only when the code has changed.

    Parameters
    ----------
    quick
        Measure little: a grid of 4 by 4 cells, few egos and draws.
    progress
        Called with the name of a stage, how much of it is done, and how much there is.
    workers
        Processes for what the report runs itself; 0 for this one. Times are always measured in this one.

    Returns
    -------
    Path
        The page.

    Raises
    ------
    MissingExtraError
        Where matplotlib is not installed; nothing is measured then.
    InputError
        Where `results_dir` holds no results, or no case yet.
    OutputError
        Where something cannot be written.
    """
    from scenewright.study.report.report import FULL, QUICK, write

    return write(results_dir, out_dir, QUICK if quick else FULL, progress, workers)
