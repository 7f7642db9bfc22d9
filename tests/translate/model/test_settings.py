"""Settings: what is usual is safe, and nothing is imported for it."""

from __future__ import annotations

import subprocess
import sys

from scenewright.translate.model.settings import TranslatorSettings


def test_usual_settings_ask_nobody_twice_for_nothing() -> None:
    usual = TranslatorSettings()
    assert (usual.strict, usual.second_opinion, usual.record, usual.replay, usual.ask) == (
        False,
        False,
        None,
        None,
        None,
    )
    assert usual.answers == {}


def test_settings_need_no_library() -> None:
    code = (
        "import sys, scenewright.translate.model.settings; sys.exit('pydantic' in sys.modules or 'z3' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
