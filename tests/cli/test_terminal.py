"""Signs of life: they come after a while, and leave the terminal to a question."""

from __future__ import annotations

import io
import time

from scenewright.cli.terminal import QuietConsole, SignsOfLife


def test_a_question_has_the_terminal_for_itself() -> None:
    shown = io.StringIO()
    with SignsOfLife(QuietConsole(file=shown, force_terminal=True)) as signs:
        signs.say("driving")
        signs._show()  # what the timer does after a second
        time.sleep(0.2)
        assert "driving" in shown.getvalue()
        with signs.silent():
            before = shown.getvalue()
            time.sleep(0.3)  # several times as long as between two frames
            assert shown.getvalue() == before
        time.sleep(0.3)
        assert len(shown.getvalue()) > len(before)
