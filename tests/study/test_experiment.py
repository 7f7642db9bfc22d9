"""The experiment: all cases, each once, the same whatever runs them; gone on with after an end that came too soon."""

from __future__ import annotations

import json
import shlex
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

import scenewright
from scenewright.cli.app import app
from scenewright.errors import InputError, OutputError, PolicyError
from scenewright.judge.files import judge_run_directory
from scenewright.judge.tolerance import TIGHT
from scenewright.study.cases import BenchCase, run_bench_case
from scenewright.study.experiment import FULL_EGOS, Experiment, Plan, Progress, preset
from scenewright.study.rejudge import differences, kept_runs
from scenewright.study.store import CaseRecord, read_results

PACKAGE = Path(scenewright.__file__).parent
SMALL = Plan(rows=(17, 16), egos=("constant", "noisy"), draws=1, methods=("scenewright",), takes=2)
FEW = replace(SMALL, egos=("noisy",))
TIMES = ("wall_s", "solve_ms", "command")


def told(record: CaseRecord) -> CaseRecord:
    """Return a record without what two runs never have in common."""
    return replace(record, wall_s=0.0, solve_ms=[], command="")


def told_of(plan: Plan, records: list[CaseRecord]) -> list[CaseRecord]:
    """Return the records of a plan's egos, without what two runs never have in common."""
    return [told(record) for record in records if record.ego in plan.egos]


def run(plan: Plan, folder: Path, workers: int = 0, after: int | None = None) -> bool:
    """Run an experiment; stop it `after` so many new cases."""
    made = Experiment(plan, folder, "scenewright bench ...")
    seen: list[Progress] = []
    return made.run(workers, seen.append, lambda: after is not None and made.progress.new >= after)


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("small") / "results"
    assert run(SMALL, folder)
    return folder


def test_every_combination_is_there_once_with_its_facts(small: Path) -> None:
    results = read_results(small)
    records = results.records
    assert [(r.row, r.ego) for r in records] == [(n, ego) for n in (17, 16) for ego in ("constant", "noisy")]
    assert {(r.row, r.interaction) for r in records} == {(17, "Hero does not yield"), (16, "Hero yields")}
    by_row = {r.row: (r.parameters, r.seed) for r in records}
    assert all((r.parameters, r.seed) == by_row[r.row] for r in records), "a draw is the same for all egos"
    assert all(r.cause == "success" or r.failed_conditions or r.proof for r in records)
    assert {"seed", "rows", "egos", "takes", "machine", "version", "started", "finished"} <= results.settings.keys()
    assert {"cpu", "cores", "system", "python"} == results.settings["machine"].keys()


def test_number_of_processes_changes_nothing(small: Path, tmp_path: Path) -> None:
    assert run(FEW, tmp_path / "two", workers=2)
    first, second = (read_results(folder).records for folder in (small, tmp_path / "two"))
    assert len(second) == 2
    assert told_of(FEW, first) == told_of(FEW, second)
    for record in second:
        if record.directory is not None:
            name = f"{record.directory}/trace.parquet"
            assert (small / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_stopped_experiment_goes_on_and_counts_nothing_twice(small: Path, tmp_path: Path) -> None:
    folder = tmp_path / "stopped"
    assert not run(FEW, folder, after=1)
    kept = read_results(folder).records
    assert len(kept) == 1
    assert "finished" not in read_results(folder).settings
    assert run(FEW, folder)
    records = read_results(folder).records
    assert kept[0] in records, "what was done is not done again: even its times are the same"
    assert told_of(FEW, records) == told_of(FEW, read_results(small).records)
    assert run(FEW, folder), "all is done: nothing is run"
    assert read_results(folder).records == records


@pytest.mark.parametrize("change", [{"seed": 1}, {"rows": (17,)}, {"takes": 1}, {"egos": ("noisy",)}])
def test_other_settings_do_not_go_on(small: Path, change: dict[str, object]) -> None:
    before = read_results(small).records
    with pytest.raises(InputError, match=f"other {next(iter(change))}") as caught:
        run(replace(SMALL, **change), small)  # type: ignore[arg-type]
    assert "--out" in str(caught.value)
    assert read_results(small).records == before


def test_folder_of_something_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years of work", encoding="utf-8")
    with pytest.raises(OutputError, match="no experiment"):
        run(SMALL, tmp_path)
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match="cannot be made"):
        run(SMALL, tmp_path / "file")


@pytest.mark.parametrize(
    ("change", "error", "named"),
    [
        ({"rows": (1, 81)}, InputError, "no row 81"),
        ({"egos": ("idm", "nobody")}, PolicyError, "nobody"),
        ({"methods": ("guessing",)}, InputError, "guessing"),
        ({"methods": ("rejection:0",)}, InputError, "no such number of samples"),
        ({"methods": ("scenewright:5",)}, InputError, "takes no option"),
        ({"methods": ("synchronise:fast",)}, InputError, "takes no option"),
        ({"methods": ("follower:nobody",)}, PolicyError, "nobody"),
    ],
)
def test_what_does_not_exist_is_refused_before_anything_is_made(
    tmp_path: Path, change: dict[str, object], error: type[Exception], named: str
) -> None:
    with pytest.raises(error) as caught:
        run(replace(SMALL, **change), tmp_path / "new")  # type: ignore[arg-type]
    assert named in str(caught.value)
    assert not (tmp_path / "new").exists()


def test_kept_runs_hold_what_a_judge_needs_and_nothing_of_this_machine(small: Path) -> None:
    kept = kept_runs(read_results(small))
    assert kept
    for each in kept:
        assert judge_run_directory(each.directory).holds_at(TIGHT) == ("tight" in each.record.kept)
        assert differences(each) == ()
        for name in ("manifest.json", "params.json", "program.scene", "verdict.json"):
            assert str(Path.home()) not in (each.directory / name).read_text(encoding="utf-8")
        assert (
            json.loads((each.directory / "manifest.json").read_text(encoding="utf-8"))["map"]["file"]
            == "t_intersection"
        )
        assert not (each.directory / "index.html").exists()


def test_record_that_was_embellished_is_found_out(small: Path) -> None:
    kept = kept_runs(read_results(small))[0]
    assert "fine" not in kept.record.kept or "tight" in kept.record.kept
    other = [] if kept.record.kept else ["tight", "loose", "coarse"]
    assert "as recorded" in differences(replace(kept, record=replace(kept.record, kept=other)))[0]


def test_runs_of_our_method_are_kept_and_those_of_rivals_are_not(tmp_path: Path) -> None:
    plan = replace(SMALL, rows=(16,), egos=("constant",), methods=("scenewright", "open-loop"))
    assert run(plan, tmp_path / "both")
    results = read_results(tmp_path / "both")
    assert [each.record.method for each in kept_runs(results)] == ["scenewright"]
    assert [record.directory is None for record in results.records] == [False, True]


def one_case(folder: Path, ego: str) -> BenchCase:
    """Return the case of row 16; its run is not kept."""
    (case,) = Plan((16,), (ego,), 1, ("scenewright",), takes=1).cases(folder)
    return replace(case, keep=False)


def test_command_of_a_case_runs_it_again(small: Path, tmp_path: Path) -> None:
    record = next(r for r in read_results(small).records if r.ego == "noisy")
    words = shlex.split(record.command)
    assert words[:2] == ["scenewright", "run"]
    result = CliRunner().invoke(app, [*words[1:], "--out", str(tmp_path / "run"), "--quiet"])
    assert result.exit_code == {"success": 0, "infeasible": 3}.get(record.status, 1)
    if record.directory is not None:
        trace = (small / record.directory / "trace.parquet").read_bytes()
        assert (tmp_path / "run" / "trace.parquet").read_bytes() == trace


def test_case_that_goes_wrong_is_recorded_with_what_it_said(tmp_path: Path) -> None:
    broken = BenchCase(17, "nobody", 0, "scenewright", 1, (), 1, tmp_path)
    record = run_bench_case(broken)
    assert (record.cause, record.status, record.best_tight) == ("error", "error", False)
    assert "no such ego policy" in record.message


@pytest.mark.usefixtures("nothing_proposed")
def test_infeasible_case_carries_its_proof(tmp_path: Path) -> None:
    case = one_case(tmp_path, "idm")
    wanted = {name: 60.0 if name.startswith("end") else value for name, value in case.parameters}
    record = run_bench_case(replace(case, parameters=tuple(wanted.items())))
    assert (record.cause, record.first_cause, record.takes) == ("proven infeasible", "proven infeasible", 0)
    assert record.proof
    assert "the hero is end_" in record.proof


def test_names_of_cases_are_names_of_files(tmp_path: Path) -> None:
    def key(ego: str) -> str:
        return BenchCase(4, ego, 2, "scenewright", 0, (), 1, tmp_path).key

    assert key("stop-and-go") == "04-stop-and-go-2-scenewright"
    odd = [key(ego) for ego in ("../own.py:Ego:a=1", "../own.py:Ego:a=2", "..\\own.py:Ego:a=1")]
    assert len(set(odd)) == 3
    assert not any("/" in each or "\\" in each or ":" in each for each in odd)


def test_presets() -> None:
    full, quick = preset("full"), preset("quick")
    assert (len(full.rows), full.draws, full.egos, full.takes) == (80, 3, FULL_EGOS, 3)
    assert set(quick.rows) < set(full.rows)
    assert set(quick.egos) < set(full.egos)
    from scenewright.study.benchmark import benchmark_rows
    from scenewright.study.rivals import METHODS

    assert tuple(method.partition(":")[0] for method in full.methods) == tuple(
        name for name in METHODS if name != "smt"
    )
    families = {(row.interaction, row.trigger) for row in benchmark_rows()}
    assert {(row.interaction, row.trigger) for row in benchmark_rows() if row.id in quick.rows} == families
