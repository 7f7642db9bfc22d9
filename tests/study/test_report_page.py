"""The report's page: complete, self-contained, and safe whatever the store says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from report_store import made_up, write_store
from test_report_figures import CELLS, EXTRAS, material

from scenewright.errors import OutputError
from scenewright.study.report import report as whole
from scenewright.study.report.page import render_page
from scenewright.study.report.report import Extras, compose, sections_of, write_report

HOSTILE = '</script><img src=x onerror="alert(1)"> & "quoted" 车'


# The figures themselves have tests of their own.
PNG = b"\x89PNG of no interest here"


@pytest.fixture(scope="module", autouse=True)
def _no_drawing() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(whole, "render_png", lambda *_: PNG)
        yield


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    return compose(material(made_up(rows=range(1, 81, 5), draws=1, egos=("idm", "noisy"))), folder)


def test_the_page_names_every_figure_and_table_and_they_are_there(written: Path) -> None:
    text = written.read_text(encoding="utf-8")
    for link in set(re.findall(r'href="(tables/[^"]+)"', text)):
        assert (written.parent / link).stat().st_size > 0
    sections = sections_of(material(made_up(rows=[1], draws=1)))
    shown = {table.name for section in sections for table in section.tables}
    written_down = {table.name for section in sections for table in section.files}
    plots = {plot.name for section in sections for plot in section.plots}
    assert {path.stem for path in (written.parent / "tables").iterdir()} == written_down
    assert {path.stem for path in (written.parent / "figures").iterdir()} == plots
    assert all(f'id="figure-{name}"' in text for name in plots)
    assert all(f'id="table-{name}"' in text for name in shown)
    assert all(f'href="tables/{name}.csv"' in text for name in written_down if name not in nothing_in(written))


def test_what_there_is_one_of_is_told_so() -> None:
    settings = {"rows": [1], "egos": ["idm", "noisy"], "methods": ["scenewright"], "draws": 1, "takes": 3}
    text = render_page(settings, 2, [], {})
    assert "2 cases · 1 row · 2 egos · 1 method · 1 draw · 3 takes · not finished" in text


def nothing_in(written: Path) -> set[str]:
    """Return the tables without a line."""
    files = (written.parent / "tables").iterdir()
    return {path.stem for path in files if path.read_text(encoding="utf-8").count("\n") == 1}


def test_the_page_fetches_nothing(written: Path) -> None:
    text = written.read_text(encoding="utf-8")
    assert not re.findall(r'src="(?!data:image/png;base64,)', text)
    assert not re.findall(r'href="(?!#|tables/)', text)
    assert "http" not in re.sub(r"http-equiv", "", re.sub(r"base64,[A-Za-z0-9+/=]+", "", text))
    assert "default-src 'none'" in text
    assert "<script" not in text
    assert 'style="' not in text


def test_the_page_says_command_seed_versions_and_number_of_cases(written: Path) -> None:
    head = re.search(r"<header>(.*?)</header>", written.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert head is not None
    for told in ("192 cases", "seed 0", "scenewright 0.1.0", "<code>scenewright bench", "open against closed loop"):
        assert told in head[1]


def test_failures_are_listed_with_their_commands(written: Path) -> None:
    records = made_up(rows=range(1, 81, 5), draws=1, egos=("idm", "noisy"))
    failed = [r for r in records if r.method == "scenewright" and r.cause not in ("success", "proven infeasible")]
    assert failed
    table = re.search(r'id="table-failures".*?</table>', written.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert table is not None
    assert table[0].count('<td class="command">') == len(failed)
    assert all(each.command in table[0] for each in failed)


def test_hostile_texts_stay_texts(tmp_path: Path) -> None:
    record = replace(
        made_up(rows=[1], draws=1, methods=("scenewright",), only="missed")[0], message=HOSTILE, command=HOSTILE,
        ego=HOSTILE,
    )  # fmt: skip
    settings = {"command": HOSTILE, "seed": HOSTILE, "version": HOSTILE, "machine": {"cpu": HOSTILE}}
    hostile = replace(material([record], Extras()), settings=settings)
    text = compose(hostile, tmp_path).read_text(encoding="utf-8")
    assert "<img src=x" not in text
    assert "</script>" not in text


def test_the_report_is_written_from_a_folder_of_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def measured(*_: Any) -> Extras:
        return EXTRAS

    monkeypatch.setattr(whole, "measure_extras", measured)
    folder = write_store(tmp_path / "results", made_up(rows=[1, 2], draws=1))
    told: list[tuple[str, int, int]] = []
    page = write_report(folder, quick=True, progress=lambda *step: told.append(step))
    assert page == folder / "report" / "index.html"
    assert told[-1] == ("figures", 6, 6)
    assert (folder / "report" / "tables" / "precision_cells.csv").read_text().count("\n") == 1 + len(CELLS)
    other = write_store(tmp_path / "other", made_up(rows=[1], draws=1))
    (other / "report").write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match="cannot be written"):
        write_report(other, quick=True)
