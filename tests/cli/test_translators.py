"""Questions on the terminal: asked by number, answered by default, by number or in words, and never guessed."""

from __future__ import annotations

import io
import os
import pty
import subprocess
import sys
from collections.abc import Callable

import pytest
from sentences import SENTENCE

from scenewright.cli.translators import ask
from scenewright.translate.story import Question, Quote
from scenewright.translate.understand import OpenQuestionsError

WAY = Question("way of ego", "Which way does the ego go?", ("left", "right", "straight on"), 2, Quote(4, 7, "ego"))
Type = Callable[[str], None]


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> Type:
    return lambda text: monkeypatch.setattr(sys, "stdin", io.StringIO(text))


@pytest.mark.parametrize(
    ("text", "answer"),
    [("1\n", "left"), ("\n", "straight on"), ("", "straight on"), ("right\n", "right"), ("9\nup\n2\n", "right")],
)
def test_an_answer_is_a_number_its_words_or_the_default(text: str, answer: str, typed: Type) -> None:
    typed(text)
    assert ask(WAY) == answer


def test_a_question_is_shown_with_its_words_its_numbers_and_its_default(
    typed: Type, capsys: pytest.CaptureFixture[str]
) -> None:
    typed("\n")
    ask(WAY)
    told = capsys.readouterr()
    assert told.out == ""
    assert 'Which way does the ego go?  ("ego")' in told.err
    assert "  3  straight on" in told.err
    assert told.err.endswith("number [3]: ")


def test_without_a_default_it_is_asked_until_it_is_answered(typed: Type) -> None:
    question = Question("word 4", "What is 'zonks'?", ("set it aside",), None)
    typed("\n\n1\n")
    assert ask(question) == "set it aside"
    typed("\n")
    with pytest.raises(OpenQuestionsError, match="leaves something open"):
        ask(question)


def test_one_question_after_another_is_asked_on_a_terminal() -> None:
    """The whole command on a terminal of its own: standard input and error are what questions need."""
    text = SENTENCE.replace("The ego drives westbound", "The ego has an open way")
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "scenewright", "translate", text]
    with subprocess.Popen(command, stdin=theirs, stderr=theirs, stdout=subprocess.PIPE, text=True) as process:
        os.write(ours, b"1\n")
        told, _ = process.communicate(timeout=60)
    os.close(theirs)
    shown = os.read(ours, 10_000).decode()
    os.close(ours)
    assert "Which way does the ego go?" in shown
    assert "could also be" not in told
    assert process.returncode == 0
