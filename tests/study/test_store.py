"""The store: every record once, whatever was torn, killed or compacted in between."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import asdict
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from records import record

from scenewright.errors import InputError, OutputError
from scenewright.study.lines import LineLog
from scenewright.study.store import (
    LINES_FILE,
    PARQUET_FILE,
    CaseRecord,
    compact,
    locked,
    read_records,
    read_results,
    write_settings,
)

SETTINGS = {"schema_version": 1, "methods": ["scenewright", "rejection"], "rows": [1, 2], "egos": ["idm", "noisy"]}
FULL = record(
    1,
    "noisy",
    "missed",
    kept=["coarse"],
    failed_conditions=["c3", "criterion order"],
    proof="c3: ü",
    solve_ms=[1.5, 2.0],
    directory="runs/x",
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_settings(tmp_path, SETTINGS)
    return tmp_path


def append(folder: Path, *records: CaseRecord) -> None:
    log = LineLog(folder / LINES_FILE)
    for each in records:
        log.append(asdict(each))
    log.close()


def test_records_survive_lines_and_parquet(folder: Path) -> None:
    append(folder, FULL, record(2))
    lines = read_results(folder).records
    compact(folder)
    assert not (folder / LINES_FILE).exists()
    assert read_results(folder).records == lines
    assert lines[0] == FULL


def test_order_is_that_of_the_settings(folder: Path) -> None:
    append(folder, record(2, "noisy"), record(1, method="rejection"), record(1, "noisy"), record(1))
    compact(folder)
    order = ["01-idm-0-scenewright", "01-noisy-0-scenewright", "02-noisy-0-scenewright", "01-idm-0-rejection"]
    assert [each.case for each in read_results(folder).records] == order
    assert pq.read_table(folder / PARQUET_FILE).column("case").to_pylist() == order


@pytest.mark.parametrize("torn", [b"{", b'{"case": "03-idm-0-scenewright", "row": 3', b"\xc3"])
def test_torn_last_line_is_dropped_and_written_over(folder: Path, torn: bytes) -> None:
    append(folder, record(1))
    with (folder / LINES_FILE).open("ab") as file:
        file.write(torn)
    assert list(read_records(folder)) == ["01-idm-0-scenewright"]
    append(folder, record(2))
    assert list(read_records(folder)) == ["01-idm-0-scenewright", "02-idm-0-scenewright"]


def test_line_broken_elsewhere_is_told_by_number(folder: Path) -> None:
    append(folder, record(1), record(2))
    text = (folder / LINES_FILE).read_bytes()
    (folder / LINES_FILE).write_bytes(b"nonsense\n" + text)
    with pytest.raises(InputError, match="not the record of a case") as caught:
        read_records(folder)
    assert f"{LINES_FILE}:1" in str(caught.value)


def test_killed_between_parquet_and_removing_lines_counts_once(folder: Path) -> None:
    append(folder, record(1), record(2))
    lines = (folder / LINES_FILE).read_bytes()
    compact(folder)
    (folder / LINES_FILE).write_bytes(lines)
    append(folder, record(1, "noisy"))
    assert len(read_results(folder).records) == 3
    compact(folder)
    assert len(read_results(folder).records) == 3


def test_columns_have_their_types_even_where_all_is_empty(folder: Path) -> None:
    empty = read_results(folder).table.schema
    append(folder, FULL)
    assert read_results(folder).table.schema == empty
    assert "double" in str(empty.field("solve_ms").type)


def test_what_earlier_versions_kept_besides_is_no_hindrance(folder: Path) -> None:
    log = LineLog(folder / LINES_FILE)
    log.append({**asdict(record(1)), "trigger_met": True, "ego_trigger_error": 0.1})
    log.close()
    assert read_results(folder).records == (record(1),)
    rows = [{**asdict(record(1)), "first_collision": False}]
    pq.write_table(pa.Table.from_pylist(rows), folder / PARQUET_FILE)
    (folder / LINES_FILE).unlink()
    assert read_results(folder).records == (record(1),)


def test_what_is_no_result_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no results of an experiment"):
        read_results(tmp_path)
    (tmp_path / "settings.json").write_text("{", encoding="utf-8")
    with pytest.raises(InputError, match="cannot be read"):
        read_results(tmp_path)
    (tmp_path / "settings.json").write_text(json.dumps({**SETTINGS, "schema_version": 9}), encoding="utf-8")
    with pytest.raises(InputError, match="another schema version"):
        read_results(tmp_path)


def test_broken_parquet_is_told(folder: Path) -> None:
    (folder / PARQUET_FILE).write_bytes(b"PAR1 nothing")
    with pytest.raises(InputError, match="cannot be read"):
        read_results(folder)


def test_two_processes_do_not_write_to_one_folder(folder: Path) -> None:
    code = (
        f"from pathlib import Path\nfrom scenewright.study.store import locked\nwith locked(Path({str(folder)!r})): ..."
    )
    with locked(folder):
        held = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
        with pytest.raises(OutputError, match="another experiment"), locked(folder):
            pass
    assert "another experiment" in held.stderr
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
