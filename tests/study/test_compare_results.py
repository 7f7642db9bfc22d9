"""Summaries and comparisons: what is counted among what, and what got better or worse."""

from __future__ import annotations

from pathlib import Path

import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import record

from scenewright.study.causes import CAUSES, NOT_OURS, cause_across, cause_of_take
from scenewright.study.compare import Comparison, compare, moved
from scenewright.study.store import CaseRecord, Results
from scenewright.study.summary import Rate, disagreements, failures, percent, summary, tally_by

RECORDS = [
    record(1, "idm", "success", "missed"),
    record(2, "idm", "success"),
    record(3, "idm", "loose only", "ego never met the condition"),
    record(4, "idm", "proven infeasible"),
    record(1, "noisy", "ego never met the condition"),
    record(2, "noisy", "ego left no room"),
    record(3, "noisy", "error"),
    record(4, "noisy", "proven infeasible"),
]


def results(records: list[CaseRecord], **settings: object) -> Results:
    return Results(Path("x"), {"takes": 3, **settings}, tuple(records))


def test_rates_leave_out_what_is_nobodys_fault_and_nothing_else() -> None:
    idm, noisy, everything = tally_by(RECORDS, lambda r: r.ego)
    assert (idm.cases, idm.rated) == (4, 3)
    assert idm.rate("first", "tight") == Rate(1, 3)
    assert idm.rate("best", "tight") == Rate(2, 3)
    assert idm.rate("best", "loose").value == 1.0
    assert (noisy.cases, noisy.rated, noisy.rate("best", "coarse").value) == (4, 2, 0.0)
    assert noisy.rate_where_let.value == 0.0
    assert (everything.cases, everything.rated) == (8, 5)
    assert everything.rate_where_let == Rate(2, 4)


def test_group_of_impossible_cases_has_no_rate() -> None:
    (only,) = tally_by([record(4, cause="proven infeasible")], lambda r: r.ego, total="")
    assert (only.rated, only.rate("best", "tight").value, only.rate_where_let.value) == (0, None, None)


def test_failures_are_ours_and_disagreements_are_all() -> None:
    assert [r.cause for r in failures(RECORDS)] == ["loose only", "ego left no room", "error"]
    odd = record(5, criteria_disagree=True)
    assert disagreements([*RECORDS, odd]) == [odd]


def test_summary_is_plain_and_complete() -> None:
    data = summary([*RECORDS, record(1, method="rejection", cause="missed")])
    assert data["cases"] == 9
    assert [each["name"] for each in data["by_method"]] == ["scenewright", "rejection"]
    assert data["methods"]["scenewright"]["by_ego"][-1]["name"] == "all"
    assert {each["case"] for each in data["failures"]} >= {"01-idm-0-rejection", "03-noisy-0-scenewright"}
    assert all(each["command"] for each in data["failures"])


@given(st.lists(st.sampled_from(CAUSES), max_size=30))
def test_tallies_add_up(causes: list[str]) -> None:
    (*parts, everything) = tally_by(
        [record(n, cause=cause) for n, cause in enumerate(causes)], lambda r: str(r.row % 3)
    )
    assert everything.cases == len(causes) == sum(part.cases for part in parts)
    assert everything.rated == sum(cause not in NOT_OURS for cause in causes) == sum(part.rated for part in parts)
    assert everything.hits["best", "tight"] == causes.count("success")


def test_causes_of_takes() -> None:
    def cause(**what: bool) -> str:
        return cause_of_take(**{"tight": False, "loose": False, "never_met": False, "no_room": False, **what})

    assert cause(tight=True, loose=True, no_room=True) == "success"
    assert cause(loose=True) == "loose only"
    assert cause(never_met=True, no_room=True) == "ego never met the condition"
    assert cause(no_room=True, loose=True) == "ego left no room"
    assert cause() == "missed"
    assert cause_across(["missed", "success"]) == "success"
    assert cause_across(["ego never met the condition", "ego left no room"]) == "ego left no room"


def test_comparison_names_what_turned() -> None:
    then = [record(n) for n in range(1, 5)] + [record(5, cause="missed"), record(6, cause="missed"), record(9)]
    now = [record(1), record(2, cause="missed"), *(record(n) for n in (3, 4, 5)), record(6, cause="gave up"), record(8)]
    found = compare(results(then), results(now))
    assert [pair[1].case for pair in found.lost] == ["02-idm-0-scenewright"]
    assert [pair[1].case for pair in found.won] == ["05-idm-0-scenewright"]
    assert [pair[1].cause for pair in found.other_cause] == ["gave up"]
    assert (found.only_then, found.only_now) == (("09-idm-0-scenewright",), ("08-idm-0-scenewright",))
    assert len(found.pairs) == 6
    assert not found.regressed
    data = found.as_dict()
    assert data["compared"] == 6
    assert data["lost"][0]["command"]
    rows = {then.name for then, _ in moved(found.tallies(lambda r: str(r.row), total=""))}
    assert rows == {"2", "5"}


def test_same_name_of_another_draw_is_not_compared() -> None:
    then, now = [record(1), record(2), record(3)], [record(1, parameters="{}"), record(2, seed=9), record(3)]
    found = compare(results(then), results(now))
    assert found.drawn_otherwise == ("01-idm-0-scenewright", "02-idm-0-scenewright")
    assert len(found.pairs) == 1


@pytest.mark.parametrize(
    ("lost", "won", "regressed"),
    [(0, 0, False), (4, 0, False), (5, 0, True), (5, 3, False), (20, 5, True), (0, 9, False)],
)
def test_regression_is_more_than_chance(lost: int, won: int, regressed: bool) -> None:
    good, bad = record(1), record(1, cause="missed")
    found = Comparison((*((good, bad) for _ in range(lost)), *((bad, good) for _ in range(won))), (), (), ())
    assert found.regressed is regressed
    assert 0.0 < found.chance <= 1.0


def test_table_is_one_that_others_can_query() -> None:
    table = results(RECORDS).table
    assert isinstance(table, pa.Table)
    assert sum(table.column("best_tight").to_pylist()) == 2


def test_rates_say_one_hundred_percent_only_where_it_is() -> None:
    assert percent(1439 / 1440) == "99.9 %"
    assert percent(1 / 4000) == "0.1 %"
    assert (str(Rate(0, 0)), Rate(0, 0).interval) == ("-", None)
    low, high = Rate(97, 100).interval or (0.0, 0.0)
    assert (round(low, 3), round(high, 3)) == (0.915, 0.990)  # as tables of Wilson's interval have it
