"""What all tests share: the folder of maps and texts beside the clone, the system's Chromium, Hypothesis profiles."""

from __future__ import annotations

import gc
import os
import shutil
import signal
import sys
from pathlib import Path

# One test process runs on each core: numpy's own threads would only be in each other's way.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import hypothesis
import pytest

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # Started in the background of a shell: whatever a test starts would ignore Ctrl-C too.
    signal.signal(signal.SIGINT, signal.default_int_handler)


ROOT = Path(__file__).resolve().parents[1]
# Import mode `importlib` puts no folder on the path: these hold what several tests share, and tools that are tested.
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tools")]
BROWSERS = ("chromium", "chromium-browser", "google-chrome")

# The same examples every time where a failure must be repeatable by others; fresh ones where somebody is looking.
hypothesis.settings.register_profile("ci", deadline=None, derandomize=True, max_examples=60)
hypothesis.settings.register_profile("dev", deadline=None, max_examples=60)
hypothesis.settings.load_profile("ci" if os.environ.get("CI") else "dev")


@pytest.fixture(scope="session")
def no_settings(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder for settings that holds none of ours; other programs may write theirs there."""
    return tmp_path_factory.mktemp("settings")


@pytest.fixture(autouse=True)
def no_model_of_the_users(monkeypatch: pytest.MonkeyPatch, no_settings: Path) -> None:
    """Let nobody be asked whom the user has configured: descriptions are read offline."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(no_settings))
    monkeypatch.delenv("SCENEWRIGHT_TRANSLATOR", raising=False)


@pytest.fixture
def nothing_proposed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let nobody look for numbers that would do, for tests of proofs alone: it takes most of the time of a check."""
    monkeypatch.setattr("scenewright.solve.feasibility.suggest", lambda *_: ())


@pytest.fixture
def searched_less(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let little be searched for a motion, for tests of runs of which none is found: it takes longer than the run."""
    monkeypatch.setattr("scenewright.solve.proofs.decide._WORK_PER_S", 200_000)


@pytest.fixture
def replanned_seldom(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let plans be made anew twice a second, for tests of what becomes of whole runs: a plan takes as long as they."""
    from stories import replan_seldom

    replan_seldom(monkeypatch)


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """Return the folder `shared` beside the clone, which holds maps and texts that are not ours to keep in it."""
    path = ROOT.parent / "shared"
    if not path.is_dir():
        pytest.skip("no folder 'shared' beside the clone")
    return path


@pytest.fixture(scope="session")
def chromium() -> str:
    """Return the path of the system's Chromium."""
    for name in BROWSERS:
        if path := shutil.which(name):
            return path
    reason = f"none of {', '.join(BROWSERS)} is on the PATH"
    if os.environ.get("SCENEWRIGHT_REQUIRE_BROWSER") == "1":
        pytest.fail(f"{reason}, and SCENEWRIGHT_REQUIRE_BROWSER=1 asks for one")
    pytest.skip(reason)


def pytest_collection() -> None:
    """Let nothing look for garbage while tests are collected: there is none, and it takes a quarter of that time."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Look for garbage again, but seldom, and not among what was collected: that stays to the end."""
    gc.freeze()
    gc.set_threshold(200_000)  # measured: a tenth less time than with the usual 700
    gc.enable()
