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
from scenewright.study.report import write_report
from scenewright.study.report.contents import Extras, sections_of
from scenewright.study.report.report import compose

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
    tables = {shown.table.name for section in sections for shown in section.tables}
    plots = {plot.name for section in sections for plot in section.plots}
    assert {path.stem for path in (written.parent / "tables").glob("*.csv")} == tables
    assert {path.stem for path in (written.parent / "figures").glob("*.png")} == plots | {f"{p}_dark" for p in plots}
    assert all(f'id="figure-{name}"' in text for name in plots)
    assert all(f'id="table-{name}"' in text for name in tables)


def test_the_page_fetches_nothing(written: Path) -> None:
    text = written.read_text(encoding="utf-8")
    assert not re.findall(r'(?:src|srcset)="(?!data:image/png;base64,)', text)
    assert not re.findall(r'href="(?!#|tables/)', text)
    assert "http" not in re.sub(r"http-equiv", "", re.sub(r"base64,[A-Za-z0-9+/=]+", "", text))
    assert "default-src 'none'" in text
    assert 'style="' not in text


def test_captions_say_command_seed_versions_machine_and_number_of_cases(written: Path) -> None:
    text = written.read_text(encoding="utf-8")
    captions = re.findall(r"<figcaption>(.*?)</figcaption>", text, flags=re.DOTALL)
    assert len(captions) == 11
    for caption in captions:
        assert re.search(r"\d+ (cases|runs|translations|calls)", caption)
        assert "seed 0" in caption
        assert "scenewright 0.1.0" in caption
        assert "<code>scenewright bench" in caption


def test_failures_are_listed_with_their_commands(written: Path) -> None:
    records = made_up(rows=range(1, 81, 5), draws=1, egos=("idm", "noisy"))
    failed = [r for r in records if r.method == "scenewright" and r.cause not in ("success", "proven infeasible")]
    assert failed
    table = re.search(r'id="table-failures".*?</table>', written.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert table is not None
    assert table[0].count('class="copy"') == len(failed)
    assert all(each.command in table[0] for each in failed)


def test_hostile_texts_stay_texts(tmp_path: Path) -> None:
    record = replace(
        made_up(rows=[1], draws=1, methods=("scenewright",), only="missed")[0], message=HOSTILE, command=HOSTILE,
        ego=HOSTILE,
    )  # fmt: skip
    hostile = replace(material([record], Extras()), settings={"command": HOSTILE, "seed": HOSTILE})
    text = compose(hostile, tmp_path).read_text(encoding="utf-8")
    assert "<img src=x" not in text
    assert text.count("</script>") == 2


def test_the_report_is_written_from_a_folder_of_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def measured(*_: Any) -> Extras:
        return EXTRAS

    monkeypatch.setattr(whole, "measure_extras", measured)
    folder = write_store(tmp_path / "results", made_up(rows=[1, 2], draws=1))
    told: list[tuple[str, int, int]] = []
    page = write_report(folder, tmp_path / "report", quick=True, progress=lambda *step: told.append(step))
    assert page == tmp_path / "report" / "index.html"
    assert told[-1] == ("figures", 11, 11)
    assert f"{len(CELLS)} runs" in page.read_text(encoding="utf-8")
    blocked = tmp_path / "file"
    blocked.write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match="cannot be written"):
        write_report(folder, blocked, quick=True)
