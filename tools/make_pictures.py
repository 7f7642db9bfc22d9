"""Write the pictures of the documentation.

What enters: ``examples/demo.txt`` and the system's Chromium. What leaves: ``docs/images/*.png``, screenshots of a real
run's page a moment after its trigger. Run it where the page has changed: ``python tools/make_pictures.py``.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from scenewright.orchestrate import orchestrate
from scenewright.request import Request

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SIZE = {"width": 1280, "height": 860}
AFTER_TRIGGER_S = 0.8
ARGS = ["--no-sandbox", "--disable-gpu"]


def drive(description: Path, folder: Path) -> Path:
    """Orchestrate a description and return the page of its run."""
    result = orchestrate(Request(str(description), out=folder))
    if result.status != "success":
        sys.exit(f"{description.name} ended in {result.status}: there is nothing to show")
    return folder / "index.html"


def photograph(page_file: Path, picture: Path, browser: str) -> None:
    """Open a run's page, move to a moment after the trigger, and save what is to be seen."""
    with sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=browser, args=ARGS)
        page = chromium.new_page(viewport=SIZE, color_scheme="light")
        page.goto(page_file.as_uri())
        while not page.evaluate("Boolean(window.scenewright && window.scenewright.ready)"):
            page.wait_for_timeout(20)
        page.evaluate("after => scenewright.seek(scenewright.triggers[0].time_s + after)", AFTER_TRIGGER_S)
        page.select_option("#camera", "follow:hero")
        page.mouse.move(0, 0)
        page.wait_for_timeout(200)
        picture.parent.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=str(picture))
        chromium.close()


def main() -> None:
    """Write every picture."""
    browser = next((path for name in BROWSERS if (path := shutil.which(name))), None)
    if browser is None:
        sys.exit(f"none of {', '.join(BROWSERS)} is on the PATH")
    with tempfile.TemporaryDirectory() as folder:
        photograph(drive(ROOT / "examples" / "demo.txt", Path(folder) / "demo"), IMAGES / "run.png", browser)


if __name__ == "__main__":
    main()
