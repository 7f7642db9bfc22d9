"""Every figure is drawn from stores of every kind; files say where they come from."""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread
from report_store import made_up, write_store

from scenewright.errors import InputError, MissingExtraError
from scenewright.study.report import style
from scenewright.study.report.precision import Cell
from scenewright.study.report.report import Extras, Material, sections_of, write_report
from scenewright.study.report.style import render_png
from scenewright.study.store import CaseRecord

CELLS = tuple(
    Cell(
        method,
        ego_m,
        hero_m,
        error_m=0.02 * ego_m if method == "scenewright" else 0.2 * hero_m,
        infeasible=hero_m < 6.0,
        ego_never_met=ego_m == 60.0 and method == "follower",
        tight=method == "scenewright",
        proof="stop_place: ..." if hero_m < 6.0 else "",
        fault="died" if (ego_m, method) == (30.0, "rejection") else "",
    )
    for method in ("scenewright", "open-loop", "rejection", "follower")
    for ego_m in (5.0, 30.0, 60.0)
    for hero_m in (4.0, 20.0)
)
LOOPS = [
    {"scene": scene, "ego": "idm", "draw": draw, "mode": mode, "outcome": "success", "tight": mode == "closed",
     "loose": True}
    for scene in ("lead_turns_off", "oncoming_turns_across", "pulls_out_ahead", "pulls_out_across")
    for draw in range(3)
    for mode in ("open", "closed")
]  # fmt: skip
EXTRAS = Extras(CELLS, LOOPS)
SETTINGS: dict[str, Any] = {"schema_version": 1, "command": "scenewright bench run", "seed": 0, "version": "0.1.0"}


def material(records: Sequence[CaseRecord], extras: Extras = EXTRAS) -> Material:
    """Return what sections are made from, without a folder to read runs from."""
    return Material(records, SETTINGS, Path("results"), extras)


@cache
def stores() -> dict[str, Material]:
    small = made_up(rows=range(1, 6), draws=2)
    strange = [replace(r, method="follower:mine:Driver", ego="mine:Ego:speed=3", cause="odd") for r in small[:3]]
    return {
        "ordinary": material(small),
        "no failures": material(made_up(rows=range(38, 43), draws=1, only="success")),
        "ours missing": material([r for r in small if r.method != "scenewright"]),
        "ours alone": material([r for r in small if r.method == "scenewright"]),
        "all infeasible": material(made_up(rows=[1, 2], draws=1, only="proven infeasible")),
        "one case": material(small[:1]),
        "names unknown": material(strange),
        "nothing measured": material(small[:1], Extras()),
        "all cells infeasible": material(
            small[:1], Extras(tuple(replace(c, infeasible=True, error_m=None) for c in CELLS))
        ),
    }


@pytest.mark.parametrize("name", list(stores()))
def test_every_figure_is_drawn_from_every_store(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(style, "DPI", 50)
    measured, stored = name in ("nothing measured", "all cells infeasible"), name != "ordinary"
    for section in sections_of(stores()[name]):
        of_measurements = section.id in ("precision", "loops")  # these do not read the store
        if (of_measurements and stored and not measured) or (measured and not of_measurements):
            continue  # drawn alike of another store
        for plot in section.plots:
            png = render_png(plot.draw, {"Title": plot.name})
            assert png.startswith(b"\x89PNG")
            assert len(png) > 600, plot.name


def test_a_drawing_shows_something_on_white() -> None:
    plot = next(p for s in sections_of(stores()["ordinary"]) for p in s.plots if p.name == "families")
    picture = imread(io.BytesIO(render_png(plot.draw, {})), format="png")
    assert picture[0, 0, :3].tolist() == [1.0, 1.0, 1.0]
    assert np.std(picture) > 0.05


def test_a_drawing_is_the_same_each_time_and_says_where_it_comes_from() -> None:
    plot = next(p for s in sections_of(stores()["one case"]) for p in s.plots)
    about = {"Comment": "scenewright bench run --full", "Description": "8640 cases, ≤ 3 takes"}
    png = render_png(plot.draw, about)
    assert png == render_png(plot.draw, about)
    assert b"scenewright bench run --full" in png


def test_without_matplotlib_it_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = write_store(tmp_path / "results", made_up(rows=[1], draws=1))
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingExtraError, match="matplotlib") as caught:
        write_report(folder, quick=True)
    assert caught.value.fix == 'pip install "scenewright[plots]"'
    assert not (folder / "extras").exists()


def test_without_cases_there_is_no_report(tmp_path: Path) -> None:
    folder = write_store(tmp_path / "results", [])
    with pytest.raises(InputError, match="no cases"):
        write_report(folder, quick=True)
    with pytest.raises(InputError):
        write_report(tmp_path / "nowhere", quick=True)
