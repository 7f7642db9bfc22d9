"""What the report measures itself: done once, gone on with after a kill; grid, loops and times measure what is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from scenewright.judge.tolerance import TIGHT
from scenewright.orchestrate import orchestrate
from scenewright.program.check import check_program
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.study.causes import INFEASIBLE, NEVER_MET
from scenewright.study.report import loops, measuring, precision, times
from scenewright.study.report.extra_figures import draw_grid
from scenewright.study.report.measuring import Bench, Job, Measured
from scenewright.study.report.precision import Cell, grid_table, measure_grid, precision_table, scene_text


class Counting:
    """Doubles a number; refuses odd ones above 10; counts its calls."""

    def __init__(self) -> None:
        self.calls: list[int] = []

    def __call__(self, job: Job) -> Measured:
        self.calls.append(job["x"])
        if job["x"] == 13:
            raise ValueError("not this one")
        return {"twice": 2 * job["x"]}


def test_a_measurement_is_made_once(tmp_path: Path) -> None:
    work, bench = Counting(), Bench(tmp_path)
    jobs = [{"x": x} for x in (1, 2, 3)]
    first = bench.measure("some", work, jobs)
    assert first == [{"x": x, "twice": 2 * x} for x in (1, 2, 3)]
    assert Bench(tmp_path).measure("some", work, [*jobs, {"x": 4}])[:3] == first
    assert work.calls == [1, 2, 3, 4]


def test_what_a_kill_tore_is_measured_again(tmp_path: Path) -> None:
    work = Counting()
    Bench(tmp_path).measure("some", work, [{"x": 1}, {"x": 2}])
    file = tmp_path / "extras" / "some.jsonl"
    file.write_bytes(file.read_bytes()[:-7])
    again = Bench(tmp_path).measure("some", work, [{"x": 1}, {"x": 2}])
    assert [record["twice"] for record in again] == [2, 4]
    assert work.calls == [1, 2, 2]
    assert len(file.read_text(encoding="utf-8").splitlines()) == 2


def test_what_other_code_measured_is_forgotten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    work = Counting()
    Bench(tmp_path).measure("some", work, [{"x": 1}])
    monkeypatch.setattr(measuring, "code_digest", lambda: "other")
    Bench(tmp_path).measure("some", work, [{"x": 1}])
    assert work.calls == [1, 1]


def test_what_raises_is_told_and_tried_again(tmp_path: Path) -> None:
    work, told = Counting(), []
    bench = Bench(tmp_path, progress=lambda name, done, total: told.append((name, done, total)))
    assert "not this one" in bench.measure("some", work, [{"x": 13}, {"x": 2}])[0]["error"]
    bench.measure("some", work, [{"x": 13}, {"x": 2}])
    assert work.calls == [13, 2, 13]
    assert told[:3] == [("some", 0, 2), ("some", 1, 2), ("some", 2, 2)]


# -- precision grid -------------------------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def grid(tmp_path_factory: pytest.TempPathFactory) -> tuple[Cell, ...]:
    bench = Bench(tmp_path_factory.mktemp("grid"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("scenewright.solve.feasibility.suggest", lambda *_: ())  # no cell tells what would do
        return measure_grid(bench, ("scenewright", "open-loop"), ((30.0,), (4.0, 20.0)), seed=0)


def test_the_grid_marks_infeasible_cells_by_their_proofs(grid: tuple[Cell, ...]) -> None:
    # The hero is to stop 6 m before the conflict point: begun at 4 m before it, that is past.
    assert {cell.hero_m for cell in grid if cell.infeasible} == {4.0}
    assert sum(cell.infeasible for cell in grid) == 2
    for cell in grid:
        assert cell.infeasible == ("stop_place" in cell.proof and "hero_place" in cell.proof)
        assert not (cell.infeasible and (cell.met or cell.tight or cell.error_m is not None))
    figure = draw_grid(grid)
    hatched = [patch for axes in figure.axes for patch in axes.patches if patch.get_hatch()]
    assert len(hatched) == 2


def test_the_grid_measures_the_worse_side(grid: tuple[Cell, ...]) -> None:
    cell = next(c for c in grid if c.method == "scenewright" and (c.ego_m, c.hero_m) == (30.0, 20.0))
    parameters = {
        "initial_ego_distance_behind_intersection_m": precision.INITIAL_EGO_M,
        "ego_distance_behind_conflict_point_m": 30.0,
        "hero_distance_behind_conflict_point_m": 20.0,
        "end_hero_distance_behind_conflict_point_m": precision.STOP_M,
    }
    result = orchestrate(Request(scene_text("precision"), parameters, ego=precision.EGO, takes=1))
    assert result.verdict is not None
    sides = [abs(result.verdict.condition(name).error or 0.0) for name in ("ego_place", "hero_place")]
    assert cell.error_m == pytest.approx(max(sides), abs=0.02)  # wall time may decide between two plans
    assert cell.tight == result.verdict.holds_at(TIGHT)


def test_the_grids_tables_tell_every_cell(grid: tuple[Cell, ...]) -> None:
    lines = precision_table(grid).records()
    assert [line["cells"] for line in lines] == [2, 2]
    assert [line["proven_infeasible"] for line in lines] == [1, 1]
    assert [line["met_two_m_cases"] + line["ego_never_met"] for line in lines] == [1, 1]
    told = grid_table([*grid, Cell("x", 1.0, 1.0, error_m=3.0), Cell("x", 2.0, 1.0, fault="died")])
    assert told.column("outcome").count("proven infeasible") == 2
    assert told.column("outcome")[-2:] == ["trigger not met", "no run"]


def test_a_method_that_cannot_run_leaves_cells_that_say_so(tmp_path: Path) -> None:
    cells = measure_grid(Bench(tmp_path), ("no-such-method",), ((30.0,), (20.0,)), seed=0)
    assert "no such method" in cells[0].fault
    assert not cells[0].met
    assert precision_table(cells).records()[0]["no_run"] == 1


# -- open against closed loop ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["precision", *loops.SCENES])
def test_the_reports_scenarios_are_sound(name: str) -> None:
    text = scene_text(name)
    check_program(parse_program(text, name), text, name)


@pytest.mark.usefixtures("replanned_seldom")
def test_loops_run_the_same_cases_in_both_modes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scenewright.simulate.hindsight.ego_left_no_room", lambda *_: None)  # longer than a run
    records = loops.measure_loops(Bench(tmp_path), ("noisy",), 1, seed=3)
    assert len(records) == 8
    pairs = {mode: [(r["scene"], r["parameters"]) for r in records if r["mode"] == mode] for mode in loops.MODES}
    assert pairs["open"] == pairs["closed"]
    lines = loops.loops_table(records).records()
    assert [line["cases"] for line in lines] == [1] * 8 + [4, 4]


def loop_record(scene: str, mode: str, draw: int, outcome: str) -> dict[str, Any]:
    won = outcome == "success"
    return {
        "scene": scene, "mode": mode, "ego": "idm", "draw": draw, "outcome": outcome, "tight": won, "loose": won,
    }  # fmt: skip


def test_a_case_is_left_out_of_both_loops_or_of_none() -> None:
    scene = next(iter(loops.SCENES))
    records = [
        loop_record(scene, "open", 0, NEVER_MET), loop_record(scene, "closed", 0, "success"),
        loop_record(scene, "open", 1, INFEASIBLE), loop_record(scene, "closed", 1, INFEASIBLE),
        loop_record(scene, "open", 2, "success"), loop_record(scene, "closed", 2, NEVER_MET),
    ]  # fmt: skip
    lines = {(line["scene"], line["mode"]): line for line in loops.loops_table(records).records()}
    for mode in loops.MODES:
        assert lines[scene, mode]["counted"] == 2
        assert lines[scene, mode]["tight_successes"] == 1


# -- times ----------------------------------------------------------------------------------------------------------
def test_percentiles_of_nothing_are_nothing() -> None:
    line = times.ticks_table([]).records()[0]
    assert (line["ticks"], line["p50_ms"], line["late"]) == (0, None, 0)


def test_ticks_are_told_by_percentiles_and_late_ones_counted() -> None:
    line = times.ticks_table([float(ms) for ms in range(1, 101)] + [150.0]).records()[0]
    assert (line["ticks"], line["late"], line["max_ms"]) == (101, 1, 150.0)
    assert line["p50_ms"] <= line["p90_ms"] <= line["p99_ms"] <= line["max_ms"]
