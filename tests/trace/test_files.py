"""Trace files: written and read back, the same bytes for the same trace, broken files told by their fault."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from scenewright.errors import InputError
from scenewright.trace.files import TRACE_FILE, read_trace, write_trace
from scenewright.trace.model import COLUMNS, ActorTrace, Trace

FIELDS = ("time_s", *COLUMNS)


@st.composite
def traces(draw: st.DrawFn) -> Trace:
    steps = draw(st.integers(1, 12))
    time_s = np.cumsum(draw(arrays(np.float64, steps, elements=st.floats(0.01, 1.0))))
    names = draw(st.lists(st.text("abcdefg_0", min_size=1, max_size=5), min_size=1, max_size=3, unique=True))
    values = st.floats(-1e9, 1e9)
    return Trace(
        {
            name: ActorTrace(time_s, *(draw(arrays(np.float64, steps, elements=values)) for _ in COLUMNS))
            for name in names
        }
    )


def one(steps: int = 3) -> Trace:
    time_s = np.arange(steps) * 0.02
    return Trace({name: ActorTrace(time_s, *(np.full(steps, float(k)) for k in range(7))) for name in ("ego", "hero")})


@settings(max_examples=40)
@given(traces())
def test_what_is_written_is_read_back(tmp_path_factory: pytest.TempPathFactory, trace: Trace) -> None:
    path = tmp_path_factory.mktemp("trace") / TRACE_FILE
    write_trace(trace, path)
    again = read_trace(path)
    assert list(again.actors) == list(trace.actors)
    for name, actor in trace.actors.items():
        for field in FIELDS:
            np.testing.assert_array_equal(getattr(again.actors[name], field), getattr(actor, field))


def test_the_same_trace_gives_the_same_bytes(tmp_path: Path) -> None:
    first, second = tmp_path / "a.parquet", tmp_path / "b.parquet"
    write_trace(one(), first)
    write_trace(one(), second)
    assert first.read_bytes() == second.read_bytes()


def test_rows_are_ordered_by_step_then_actor_with_the_columns_of_the_contract(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(2), path)
    table = pq.read_table(path)
    assert table.column_names == [
        *("step", "time_s", "actor", "x_m", "y_m", "heading_rad", "speed_mps", "accel_mps2", "s_m", "d_m")
    ]
    assert table.column("step").to_pylist() == [0, 0, 1, 1]
    assert table.column("actor").to_pylist() == ["ego", "hero", "ego", "hero"]
    assert table.column("heading_rad").to_pylist() == [2.0] * 4


def test_rows_of_others_may_come_in_any_order(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(4), path)
    table = pq.read_table(path)
    pq.write_table(table.take(pa.array([7, 2, 5, 0, 3, 6, 1, 4])), path)
    again = read_trace(path)
    np.testing.assert_allclose(again.actors["ego"].time_s, one(4).time_s)
    assert set(again.actors) == {"ego", "hero"}


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no trace here") as caught:
        read_trace(tmp_path / TRACE_FILE)
    assert "trace.parquet" in str(caught.value.place)


@pytest.mark.parametrize("content", [b"", b"PAR1", b"not parquet at all", b"PAR1" + b"\0" * 40 + b"PAR1"])
def test_a_broken_file(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / TRACE_FILE
    path.write_bytes(content)
    with pytest.raises(InputError, match="cannot be read"):
        read_trace(path)


def test_a_cut_file(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(), path)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(InputError, match="cannot be read"):
        read_trace(path)


def test_a_missing_column(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(), path)
    pq.write_table(pq.read_table(path).drop_columns(["s_m", "actor"]), path)
    with pytest.raises(InputError, match="lacks columns") as caught:
        read_trace(path)
    assert caught.value.found == "actor, s_m missing"


def test_an_empty_table(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(), path)
    pq.write_table(pq.read_table(path).slice(0, 0), path)
    with pytest.raises(InputError, match="empty"):
        read_trace(path)


def test_actors_sampled_at_different_times_are_told(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(), path)
    pq.write_table(pq.read_table(path).slice(0, 5), path)
    with pytest.raises(InputError, match="same instants"):
        read_trace(path)


@pytest.mark.parametrize(("left_out", "found"), [(range(2, 5), "step 5 of ego where step 2"), (range(1), "step 1 of")])
def test_a_missing_step_is_named(tmp_path: Path, left_out: range, found: str) -> None:
    """The last ones may be: a run may end early."""
    path = tmp_path / TRACE_FILE
    write_trace(one(7), path)
    whole = pq.read_table(path)
    pq.write_table(whole.take(pa.array([row for row in range(14) if row // 2 not in left_out])), path)
    with pytest.raises(InputError, match="lacks a step") as caught:
        read_trace(path)
    assert caught.value.found is not None
    assert caught.value.found.startswith(found)
    pq.write_table(whole.slice(0, 8), path)
    assert len(read_trace(path).time_s) == 4


@pytest.mark.parametrize("column", ["s_m", "time_s"])
def test_columns_that_are_no_numbers_are_told(tmp_path: Path, column: str) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(), path)
    table = pq.read_table(path)
    index = table.column_names.index(column)
    pq.write_table(table.set_column(index, column, pa.array(["far"] * table.num_rows)), path)
    with pytest.raises(InputError, match="not a number"):
        read_trace(path)


def test_gaps_in_the_numbers_are_told(tmp_path: Path) -> None:
    path = tmp_path / TRACE_FILE
    write_trace(one(), path)
    table = pq.read_table(path)
    index = table.column_names.index("s_m")
    pq.write_table(table.set_column(index, "s_m", pa.array([1.0, None, *[2.0] * 4])), path)
    with pytest.raises(InputError, match="not a number"):
        read_trace(path)
