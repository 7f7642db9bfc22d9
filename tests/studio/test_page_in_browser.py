"""The page in a real browser: opened from a file, without network, driven by pointer and keyboard."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from itertools import combinations, product
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as parquet
import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import Request
from scenewright.studio.page import write_page
from scenewright.trace.files import read_trace, write_trace
from scenewright.trace.model import ActorTrace, Trace
from stories import STORIES

playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

pytestmark = pytest.mark.browser
ARGS = [
    "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync",
]  # fmt: skip
HOSTILE = 'The "AV" </script><script>window.stolen = 1</script><img src=x onerror="window.stolen = 1"> <!-- 车辆 12 m'


@pytest.fixture(scope="module")
def browser(chromium: str) -> Iterator[Any]:
    with playwright.sync_playwright() as driver:
        instance = driver.chromium.launch(executable_path=chromium, args=ARGS)
        yield instance
        instance.close()


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
        self.until("Boolean(window.scenewright && window.scenewright.ready)")

    def until(self, condition: str) -> None:
        """Wait for a condition; Playwright's own way evaluates text in the page, which its policy forbids."""
        for _ in range(500):
            if self.page.evaluate(condition):
                return
            self.page.wait_for_timeout(20)
        pytest.fail(f"it never came to {condition}")

    @property
    def time(self) -> float:
        return float(self.page.evaluate("scenewright.time"))

    def drawn(self, actor: str) -> list[float]:
        """Return x, y and degrees of the vehicle's group as it stands in the document."""
        transform = self.page.get_attribute(f'.vehicle[data-actor="{actor}"]', "transform")
        return [
            float(part) for part in transform.replace("translate(", "").replace(") rotate(", " ").strip(")").split()
        ]


@pytest.fixture
def opened(browser: Any, run_dir: Path) -> Iterator[Opened]:
    view = Opened(browser, write_page(run_dir))
    yield view
    view.context.close()


def test_opens_from_a_file_without_a_complaint_or_a_request(opened: Opened) -> None:
    assert opened.complaints == []
    assert len(opened.requests) == 1
    assert opened.requests[0].startswith("file://")
    assert opened.page.title() == "Loose only: right turn, hero yields"


def test_replay_advances_while_playing_and_stands_when_paused(opened: Opened) -> None:
    opened.page.select_option("#speed", "4")
    opened.page.click("#play")
    opened.until("scenewright.time > 0.3")
    assert opened.page.inner_text("#play") == "Pause"
    opened.page.click("#play")
    stopped = opened.time
    opened.page.wait_for_timeout(80)
    assert opened.time == stopped


def test_replay_stops_at_the_end_and_begins_again(opened: Opened) -> None:
    opened.page.evaluate("scenewright.seek(scenewright.duration - 0.05)")
    opened.page.evaluate("scenewright.play()")
    opened.until("!scenewright.playing")
    assert opened.time == pytest.approx(16.0)
    opened.page.evaluate("scenewright.play()")
    assert opened.time < 1.0


def test_seek_puts_the_boxes_where_the_trace_has_them(opened: Opened, run_dir: Path) -> None:
    actors = read_trace(run_dir / "trace.parquet").actors
    for time_s, (name, states) in product((0.0, 3.3, 4.0, 9.51, 16.0), actors.items()):
        opened.page.evaluate("t => scenewright.seek(t)", time_s)
        x, y, degrees = opened.drawn(name)
        expected = [np.interp(time_s, states.time_s, values) for values in (states.x_m, states.y_m)]
        assert [x, y] == pytest.approx(expected, abs=2e-3)
        heading = np.interp(time_s, states.time_s, np.unwrap(states.heading_rad))
        assert np.cos(np.radians(degrees) - heading) == pytest.approx(1.0, abs=1e-5)
        pose = opened.page.evaluate("name => scenewright.pose(name)", name)
        assert [pose["x_m"], pose["y_m"]] == pytest.approx(expected, abs=2e-3)


def test_boxes_have_their_true_size_on_the_screen(opened: Opened) -> None:
    scale = opened.page.evaluate("scenewright.camera.pixelsPerMetre")
    box = opened.page.evaluate(
        "document.querySelector('.vehicle[data-actor=hero] .box').getBoundingClientRect().toJSON()"
    )
    assert box["width"] == pytest.approx(5.1 * scale, abs=1.5)
    assert box["height"] == pytest.approx(2.0 * scale, abs=1.5)


def test_table_shows_what_the_verdict_says(opened: Opened, run_dir: Path) -> None:
    conditions = json.loads((run_dir / "verdict.json").read_text(encoding="utf-8"))["conditions"]
    assert opened.page.locator("#condition-table tr[data-id]").count() == len(conditions)
    for condition in conditions:
        row = opened.page.locator(f'tr[data-id="{condition["id"]}"]')
        for key in ("required", "measured", "error"):
            cell = row.locator(f'[data-cell="{key}"]')
            assert json.loads(cell.get_attribute("data-value")) == condition[key]
            if condition[key] is None:
                assert cell.inner_text() == "–"
            else:
                shown = cell.inner_text().replace("−", "-").split()
                assert float(shown[0]) == pytest.approx(condition[key], abs=6e-4)
                assert shown[1].replace("²", "^2") == condition["unit"]
        marks = [mark.inner_text() for mark in row.locator("td.mark-cell").all()]
        assert marks == ["✓ met" if condition[key] else "✗ missed" for key in ("tight", "loose")]


def test_a_row_jumps_to_its_moment_and_lights_its_words(opened: Opened) -> None:
    opened.page.click('tr[data-id="c5"]')
    assert opened.time == pytest.approx(7.75)
    assert opened.page.locator(".clause.lit").all_inner_texts() == ["at end_distance_m behind the conflict point"]
    opened.page.hover(".clause >> text=it is 40 m behind the stop line")
    assert opened.page.locator("tr.lit").evaluate_all("rows => rows.map(row => row.dataset.id)") == ["c1"]


def test_trigger_button_jumps_there_and_shows_the_distances(opened: Opened) -> None:
    assert not opened.page.locator(".ghost").first.is_visible()
    opened.page.click("#jumps button")
    assert opened.time == pytest.approx(4.0)
    labels = opened.page.locator("text.label.number").all_text_contents()
    assert labels == ["12.10 m to stop line", "42.00 m to conflict point"]
    assert opened.page.locator("text.label.number").first.is_visible()


def test_keyboard(opened: Opened) -> None:
    press = opened.page.keyboard.press
    press("t")
    assert opened.time == pytest.approx(4.0)
    press("ArrowRight")
    assert opened.time == pytest.approx(4.1)
    press("Shift+ArrowLeft")
    assert opened.time == pytest.approx(3.1)
    press("End")
    assert opened.time == pytest.approx(16.0)
    press("Home")
    assert opened.time == 0.0
    press("Space")
    opened.until("scenewright.time > 0")
    press("Space")
    assert opened.page.evaluate("scenewright.playing") is False
    opened.page.focus("#scrubber")
    press("Home")
    press("ArrowRight")
    assert opened.time == pytest.approx(0.1), "one key moves the time once, also on the scrubber"


def test_wheel_zooms_about_the_pointer_and_follow_keeps_the_car_in_the_middle(opened: Opened) -> None:
    before = opened.page.evaluate("scenewright.camera.pixelsPerMetre")
    opened.page.hover("#stage", position={"x": 200, "y": 200})
    opened.page.mouse.wheel(0, -300)
    opened.until(f"scenewright.camera.pixelsPerMetre > {before * 1.1}")
    opened.page.select_option("#camera", "follow:hero")
    opened.page.evaluate("scenewright.seek(6)")
    stage, box = (
        opened.page.evaluate("query => document.querySelector(query).getBoundingClientRect().toJSON()", query)
        for query in ("#stage", ".vehicle[data-actor=hero] .box")
    )
    for low, size in (("x", "width"), ("y", "height")):
        assert box[low] + box[size] / 2 == pytest.approx(stage[low] + stage[size] / 2, abs=2.0)
    opened.page.keyboard.press("f")
    assert opened.page.evaluate("scenewright.camera.mode") == "fit"


def test_charts_read_values_under_the_pointer_and_follow_the_replay(opened: Opened) -> None:
    opened.page.evaluate("scenewright.seek(2)")
    values = opened.page.locator(".chart:nth-child(2) .value")
    assert values.all_text_contents() == ["7.00", "12.00"]
    opened.page.locator(".chart:nth-child(2)").click(position={"x": 400, "y": 60})
    at_click = opened.time
    assert at_click > 2.0
    cursors = opened.page.locator(".cursor").evaluate_all("lines => lines.slice(0, 3).map(l => l.getAttribute('x1'))")
    assert len(set(cursors)) == 1


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (800, "dark"), (390, "light")])
def test_nothing_scrolls_sideways(browser: Any, run_dir: Path, width: int, scheme: str) -> None:
    view = Opened(browser, write_page(run_dir), width, scheme)
    scrolled, shown = view.page.evaluate("[document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    view.context.close()
    assert scrolled <= shown


def test_on_a_phone_sentences_are_wide_enough_to_read(browser: Any, run_dir: Path) -> None:
    """What was understood takes its row where nothing stands beside it, and conditions are no columns of words."""
    view = Opened(browser, write_page(run_dir), 390)
    width = "([one, other]) => document.querySelector(one).offsetWidth / document.querySelector(other).offsetWidth"
    assert view.page.evaluate(width, ["#understood li span", "#understood li"]) > 0.95
    assert view.page.evaluate(width, ["#condition-table .said", "body"]) > 0.4
    view.context.close()
    wide = Opened(browser, write_page(run_dir))
    assert wide.page.evaluate(width, ["#understood li span:only-child", "#understood li"]) > 0.95
    wide.context.close()


@pytest.mark.parametrize(("count", "told"), [(1, "1 moment, 1 solved · p50"), (2, "2 moments, 1 solved · p50")])
def test_what_is_frozen_is_not_counted_as_solved(browser: Any, run_dir: Path, count: int, told: str) -> None:
    path = run_dir / "replans.parquet"
    parquet.write_table(parquet.read_table(path).slice(0, count), path)
    view = Opened(browser, write_page(run_dir))
    assert view.page.inner_text("#replans-summary").startswith(told)
    assert view.page.inner_text("#replan-readout").endswith("ms · daqp · off by 0.05 tight tolerances")
    view.context.close()


def test_hostile_words_are_shown_and_not_run(browser: Any, run_dir: Path) -> None:
    manifest = json.loads((run_dir / "manifest.json").read_text(encoding="utf-8"))
    manifest |= {"name": HOSTILE, "description": HOSTILE, "notes": [HOSTILE]}
    (run_dir / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    (run_dir / "program.scene").unlink()
    view = Opened(browser, write_page(run_dir))
    assert view.page.evaluate("window.stolen") is None
    assert view.page.inner_text("#description") == HOSTILE
    assert view.page.inner_text("#name") == HOSTILE
    assert view.complaints == []
    assert len(view.requests) == 1
    view.context.close()


def test_an_interrupted_run_still_opens(browser: Any, run_dir: Path) -> None:
    for name in ("program.scene", "params.json", "plan.json", "replans.parquet", "verdict.json"):
        (run_dir / name).unlink()
    manifest = json.loads((run_dir / "manifest.json").read_text(encoding="utf-8"))
    kept = {key: manifest[key] for key in ("schema_version", "description")} | {"status": "interrupted"}
    (run_dir / "manifest.json").write_text(json.dumps(kept), encoding="utf-8")
    view = Opened(browser, write_page(run_dir))
    assert "Interrupted" in view.page.inner_text("#verdict")
    assert view.page.locator("#missing li").count() == 6
    assert view.complaints == []
    view.page.evaluate("scenewright.seek(5)")
    assert view.time == 5.0
    view.context.close()


def test_a_run_of_one_moment_opens(browser: Any, run_dir: Path) -> None:
    trace = read_trace(run_dir / "trace.parquet")
    columns = [field.name for field in dataclasses.fields(ActorTrace)]
    first = {name: ActorTrace(**{c: getattr(a, c)[:1] for c in columns}) for name, a in trace.actors.items()}
    write_trace(Trace(first), run_dir / "trace.parquet")
    view = Opened(browser, write_page(run_dir))
    view.page.evaluate("scenewright.play()")
    view.until("!scenewright.playing")
    assert view.complaints == []
    view.context.close()


def test_what_came_of_it_stands_at_the_top_and_a_collision_leads_to_its_moment(browser: Any, run_dir: Path) -> None:
    view = Opened(browser, write_page(run_dir))
    assert view.page.inner_text("#aftermath").strip() == (
        "What came of it: no collision; closest 5.4 m, the ego did not brake."
    )
    assert view.page.locator("#aftermath button").count() == 0
    view.context.close()
    verdict = json.loads((run_dir / "verdict.json").read_text(encoding="utf-8"))
    verdict["aftermath"] |= {"text": "the ego hit hero at 5.3 s", "collision": {"time_s": 5.25}}
    (run_dir / "verdict.json").write_text(json.dumps(verdict), encoding="utf-8")
    view = Opened(browser, write_page(run_dir))
    assert "the ego hit hero at 5.3 s" in view.page.inner_text("#aftermath.collision")
    view.page.click("#aftermath button")
    assert view.time == 5.25
    verdict.pop("aftermath")
    (run_dir / "verdict.json").write_text(json.dumps(verdict), encoding="utf-8")
    view.context.close()
    view = Opened(browser, write_page(run_dir))
    assert not view.page.locator("#aftermath").is_visible()
    assert view.complaints == []
    view.context.close()


def test_routine_checks_are_folded_away_and_failed_ones_are_not(browser: Any, run_dir: Path) -> None:
    verdict = json.loads((run_dir / "verdict.json").read_text(encoding="utf-8"))
    check = {"kind": "route", "text": "on the line", "required": 1.0, "measured": 0.0, "error": 0.0, "unit": "m"}
    verdict["conditions"] += [check | {"id": f"route_{i}", "tight": i != 2, "loose": i != 2} for i in range(5)]
    (run_dir / "verdict.json").write_text(json.dumps(verdict), encoding="utf-8")
    view = Opened(browser, write_page(run_dir))
    shown = [view.page.locator(f'tr[data-id="route_{i}"]').is_visible() for i in range(5)]
    assert shown == [False, False, True, False, False]
    assert view.page.locator('tr[data-id="no_collision"]').is_visible()
    view.page.click("#routine")
    assert view.page.locator('tr[data-id="route_4"]').is_visible()
    view.context.close()


def test_labels_of_the_plan_view_hide_none_of_each_other_at_the_trigger(browser: Any, tmp_path: Path) -> None:
    """Two measures that end at one place, a landmark's name and two vehicles' tags, all near to each other."""
    result = orchestrate(Request(STORIES["yields, distance"], ego="constant", takes=1, out=tmp_path / "run"))
    assert result.verdict is not None
    view = Opened(browser, write_page(tmp_path / "run"))
    view.page.evaluate(f"scenewright.seek({result.verdict.facts['trigger_time_s']['hero']})")
    boxes = view.page.evaluate(
        """[...document.querySelectorAll('#stage rect.pill')].filter((rect) => !rect.closest('[hidden], .off'))
        .map((rect) => rect.getBoundingClientRect()).map((box) => [box.left, box.top, box.right, box.bottom])"""
    )
    view.context.close()
    assert len(boxes) >= 5
    for first, second in combinations(boxes, 2):
        apart = first[2] <= second[0] or second[2] <= first[0] or first[3] <= second[1] or second[3] <= first[1]
        assert apart, (first, second)
