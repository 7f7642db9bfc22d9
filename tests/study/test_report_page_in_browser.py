"""The report's page in a real browser: opened from a file, without network, narrow and wide."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from report_store import made_up
from test_report_figures import material

from scenewright.study.report import style
from scenewright.study.report.report import compose

playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

pytestmark = pytest.mark.browser
ARGS = [
    "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip


@pytest.fixture(scope="module")
def browser(chromium: str) -> Iterator[Any]:
    with playwright.sync_playwright() as driver:
        instance = driver.chromium.launch(executable_path=chromium, args=ARGS)
        yield instance
        instance.close()


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(style, "DPI", 72)
        return compose(material(made_up(rows=range(1, 81, 4), draws=2)), tmp_path_factory.mktemp("report"))


class Opened:
    """A page with what it complained about and asked for."""

    def __init__(self, browser: Any, path: Path, width: int = 1280) -> None:
        self.context = browser.new_context(viewport={"width": width, "height": 900})
        self.page = self.context.new_page()
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(path.as_uri())


@pytest.fixture
def opened(browser: Any, written: Path) -> Iterator[Opened]:
    view = Opened(browser, written)
    yield view
    view.context.close()


def test_opens_from_a_file_without_a_complaint_or_a_request(opened: Opened) -> None:
    assert opened.complaints == []
    assert [url for url in opened.requests if not url.startswith(("file://", "data:"))] == []
    widths = opened.page.evaluate("[...document.images].map((image) => image.naturalWidth)")
    assert len(widths) == 6
    assert min(widths) > 700


@pytest.mark.parametrize("width", [1440, 760, 390])
def test_nothing_is_wider_than_the_window(browser: Any, written: Path, width: int) -> None:
    view = Opened(browser, written, width)
    view.page.evaluate("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    assert view.page.evaluate("document.documentElement.scrollWidth") <= width
    view.context.close()


def test_a_click_selects_a_whole_command(opened: Opened) -> None:
    opened.page.locator("#table-failures summary").click()
    code = opened.page.locator("#table-failures td.command code").first
    code.click()
    assert opened.page.evaluate("getSelection().toString()").strip() == code.inner_text()
    assert opened.complaints == []


def test_long_tables_are_folded_and_open_at_a_click(opened: Opened) -> None:
    table = opened.page.locator("#table-failures table")
    assert not table.is_visible()
    opened.page.locator("#table-failures summary").click()
    assert table.is_visible()
    assert opened.page.locator("#table-methods table").is_visible()
