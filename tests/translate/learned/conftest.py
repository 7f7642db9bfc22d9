"""The parts of the training that need no PyTorch."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import pytest

TOOL = Path(__file__).parents[3] / "tools" / "train_reader"


@pytest.fixture(scope="session")
def training() -> tuple[ModuleType, ModuleType]:
    """Return the modules that make lessons of texts, and that change them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(TOOL)
        import changes
        import lessons
    return lessons, changes
