"""The report's tables add up to the store, and say what an independent count says."""

from __future__ import annotations

import csv
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from report_store import METHODS, made_up, record, write_store

from scenewright.study.causes import NOT_OURS
from scenewright.study.report.loops import loops_table
from scenewright.study.report.outcomes import (
    aims_table,
    failures_table,
    methods_table,
    proofs_table,
    rates_table,
    takes_table,
    tolerance_table,
)
from scenewright.study.report.tables import Table, write_table
from scenewright.study.store import CaseRecord, read_results
from scenewright.study.summary import Rate, tally_by

CAUSES = (
    "success", "loose only", "missed", "gave up", "error", "ego left no room", "ego never met the condition",
    "proven infeasible",
)  # fmt: skip
EMPTY_LOOPS = loops_table([])


@st.composite
def stores(draw: st.DrawFn) -> list[CaseRecord]:
    """Return few records of any outcomes."""
    keys = st.tuples(
        st.integers(1, 80),
        st.sampled_from(["idm", "noisy", "own:speed=3"]),
        st.integers(0, 2),
        st.sampled_from(METHODS),
    )
    chosen = draw(st.lists(keys, min_size=1, max_size=40, unique=True))
    random = np.random.default_rng(draw(st.integers(0, 1000)))
    return [record(*key, draw(st.sampled_from(CAUSES)), random) for key in chosen]


def ours(records: list[CaseRecord]) -> list[CaseRecord]:
    return [record for record in records if record.method == "scenewright"]


def total(table: Table, column: str) -> int:
    return sum(int(value) for value in table.column(column) if isinstance(value, int))


def grouped_tables(records: list[CaseRecord]) -> list[Table]:
    groups = {"families": ("interaction", "trigger", "method"), "egos": ("ego", "method"), "rows": ("row", "method")}
    return [methods_table(records), *(rates_table(name, records, by) for name, by in groups.items())]


@given(stores())
@settings(max_examples=60)
def test_cases_of_every_table_add_up_to_the_store(records: list[CaseRecord]) -> None:
    for table in grouped_tables(records):
        assert total(table, "cases") == len(records)
    for line in methods_table(records).records():
        others = [cause.replace(" ", "_") for cause in CAUSES if cause not in ("success", *NOT_OURS)]
        assert line["counted"] == line["best_tight_successes"] + sum(line.get(cause, 0) for cause in others)


@given(stores())
@settings(max_examples=60)
def test_what_is_left_out_is_shown_beside_what_is_counted(records: list[CaseRecord]) -> None:
    for table in grouped_tables(records):
        for line in table.records():
            assert line["cases"] == line["counted"] + line["proven_infeasible"] + line["ego_never_met"]
            assert line["counted"] == line["first_tight_cases"] == line["best_loose_cases"]
            assert line["first_tight_successes"] <= line["best_tight_successes"] <= line["best_loose_successes"]


@given(stores())
@settings(max_examples=60)
def test_rates_are_those_of_the_tallies_of_the_command_line(records: list[CaseRecord]) -> None:
    tallies = {tally.name: tally for tally in tally_by(records, lambda r: r.method, total="")}
    table = methods_table(records)
    assert set(table.column("method")) == set(tallies)
    for line in table.records():
        tally = tallies[line["method"]]
        for which in ("first", "best"):
            for level in ("tight", "loose"):
                assert line[f"{which}_{level}"] == pytest.approx(tally.rate(which, level).value, abs=1e-6)
        assert line["best_tight_where_ego_let_it"] == pytest.approx(tally.rate_where_let.value, abs=1e-6)
        assert line["disagreements"] == tally.disagreements


@given(stores())
@settings(max_examples=60)
def test_every_case_of_ours_is_a_success_or_listed(records: list[CaseRecord]) -> None:
    own = Counter(r.cause for r in records if r.method == "scenewright")
    failed = failures_table(ours(records), Path())
    assert len(failed.rows) == sum(own.values()) - own["success"] - own["proven infeasible"]
    assert all(failed.column("command"))
    infeasible = {(r.row, r.ego, r.draw) for r in records if r.cause == "proven infeasible"}
    assert len(proofs_table(records).rows) == len(infeasible)


def test_that_nothing_failed_is_said_only_where_something_was_run() -> None:
    assert failures_table([], Path()).empty == "No case is of our method."
    succeeded = [replace(record, cause="success") for record in made_up(rows=[1], draws=1)]
    assert "succeeded" in failures_table(ours(succeeded), Path()).empty


@given(stores())
@settings(max_examples=30)
def test_takes_add_up_to_the_counted_cases_of_ours(records: list[CaseRecord]) -> None:
    lines = takes_table(ours(records)).records()
    for line in lines:
        assert line["counted"] == sum(line[name] for name in line if name not in ("ego", "counted"))
    assert lines[-1]["counted"] == sum(line["counted"] for line in lines[:-1])


def test_success_grows_with_tolerance_in_a_store_that_is_consistent() -> None:
    lines = tolerance_table(made_up(rows=range(1, 21))).records()
    assert [line["tolerance"] for line in lines[:4]] == ["fine", "tight", "loose", "coarse"]
    for first in range(0, len(lines), 4):
        shares = [line["best"] for line in lines[first : first + 4]]
        assert shares == sorted(shares)


def test_a_later_success_counts_for_the_best_take_alone() -> None:
    random = np.random.default_rng(0)
    won = record(1, "idm", 0, "scenewright", "success", random)
    later = replace(won, case="x", draw=1, first_tight=False, take=2, takes=2)
    table = methods_table([replace(won, first_tight=True), later])
    assert (table.column("first_tight"), table.column("best_tight")) == ([Rate(1, 2)], [Rate(2, 2)])
    assert takes_table([replace(won, first_tight=True), later]).records()[-1]["take_2"] == 1


def test_aims_are_measured_over_what_there_is() -> None:
    perfect = made_up(rows=range(1, 9), draws=1, methods=("scenewright",), only="success")
    perfect = [replace(r, first_tight=True, first_loose=True) for r in perfect]
    assert aims_table(perfect, EMPTY_LOOPS).column("met") == ["yes"] * 5
    lost = [replace(r, cause="missed", best_tight=False, first_tight=False) if r.ego == "idm" else r for r in perfect]
    found = aims_table(lost, EMPTY_LOOPS)
    assert found.column("met") == ["no", "no", "yes", "no", "no"]
    assert "idm" in str(found.column("measured")[4])
    nothing = made_up(rows=[1], draws=1, methods=("open-loop",))
    assert set(aims_table(ours(nothing), EMPTY_LOOPS).column("met")) == {"-"}


def test_files_hold_the_table(tmp_path: Path) -> None:
    columns = {"name": "name", "share": "share", "off_m": "off (m)"}
    table = Table("some", "Some", columns, (("a, b", Rate(3, 4), float("nan")), ("c", Rate(0, 0), 1.5)))
    with write_table(table, tmp_path).open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    assert lines == [
        {"name": "a, b", "share": "0.75", "share_successes": "3", "share_cases": "4", "off_m": ""},
        {"name": "c", "share": "", "share_successes": "0", "share_cases": "0", "off_m": "1.5"},
    ]
    assert write_table(Table("none", "None", columns, ()), tmp_path).read_text(encoding="utf-8") == "name,share,off_m\n"
    with pytest.raises(ValueError, match="every row"):
        Table("odd", "Odd", table.columns, (("a",),))


def test_a_store_read_back_gives_the_same_tables(tmp_path: Path) -> None:
    records = made_up(rows=range(1, 6), draws=1)
    results = read_results(write_store(tmp_path / "results", records))
    assert methods_table(list(results.records)).records() == methods_table(records).records()
