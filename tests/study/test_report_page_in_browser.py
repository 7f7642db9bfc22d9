"""The report's page in a real browser: opened from a file, without network, in both themes, narrow and wide."""

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
        return compose(material(made_up(rows=range(1, 81, 7), draws=2)), tmp_path_factory.mktemp("report"))


class Opened:
    """A page with what it complained about and asked for."""

    def __init__(self, browser: Any, path: Path, width: int = 1280, scheme: str = "light") -> None:
        self.context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
        self.page = self.context.new_page()
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(path.as_uri())

    def column(self, table: str, number: int) -> list[str]:
        return list(self.page.locator(f"#table-{table} tbody tr td:nth-child({number})").all_inner_texts())


@pytest.fixture
def opened(browser: Any, written: Path) -> Iterator[Opened]:
    view = Opened(browser, written)
    yield view
    view.context.close()


def test_opens_from_a_file_without_a_complaint_or_a_request(opened: Opened) -> None:
    assert opened.page.evaluate("report.ready")
    assert opened.complaints == []
    assert [url for url in opened.requests if not url.startswith(("file://", "data:"))] == []
    widths = opened.page.evaluate("[...document.images].map((image) => image.naturalWidth)")
    assert len(widths) == 11
    assert min(widths) > 700


@pytest.mark.parametrize("width", [1440, 760, 390])
def test_nothing_is_wider_than_the_window(browser: Any, written: Path, width: int) -> None:
    view = Opened(browser, written, width)
    view.page.evaluate("document.querySelectorAll('details').forEach((each) => { each.open = true; })")
    assert view.page.evaluate("document.documentElement.scrollWidth") <= width
    view.context.close()


def test_dark_readers_get_dark_figures(browser: Any, written: Path) -> None:
    sources, grounds = {}, {}
    for scheme in ("light", "dark"):
        view = Opened(browser, written, scheme=scheme)
        sources[scheme] = view.page.evaluate("document.images[0].currentSrc")
        grounds[scheme] = view.page.evaluate("getComputedStyle(document.body).backgroundColor")
        view.context.close()
    assert sources["light"] != sources["dark"]
    assert grounds["light"] != grounds["dark"]


def test_tables_sort_by_their_numbers(opened: Opened) -> None:
    shares = [float(text.split("%")[0]) for text in opened.column("methods", 6)]
    head = opened.page.locator("#table-methods th:nth-child(6)")
    head.locator("button").click()
    assert [float(text.split("%")[0]) for text in opened.column("methods", 6)] == sorted(shares)
    head.locator("button").press("Enter")
    assert [float(text.split("%")[0]) for text in opened.column("methods", 6)] == sorted(shares, reverse=True)
    assert head.get_attribute("aria-sort") == "descending"


def test_failures_filter_by_words(opened: Opened) -> None:
    rows = opened.page.locator("#table-failures tbody tr")
    everything = rows.count()
    field = opened.page.locator("#table-failures input")
    field.fill("noisy missed")
    shown = [rows.nth(i).inner_text() for i in range(everything) if rows.nth(i).is_visible()]
    assert 0 < len(shown) < everything
    assert all("noisy" in text and "missed" in text for text in shown)
    field.fill("")
    assert rows.nth(everything - 1).is_visible()


def test_a_command_is_selected_or_copied_by_its_button(opened: Opened) -> None:
    opened.page.locator("#table-failures button.copy").first.click()
    command = opened.page.locator("#table-failures td.command code").first.inner_text()
    assert opened.page.evaluate("getSelection().toString()") == command
    assert opened.complaints == []


def test_a_link_to_a_folded_table_opens_it(browser: Any, written: Path) -> None:
    context = browser.new_context()
    page = context.new_page()
    page.goto(written.as_uri() + "#table-families")
    assert page.locator("#table-families table").is_visible()
    context.close()
