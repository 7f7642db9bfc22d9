"""Sources: files and texts, programs and descriptions, and who reads them."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.errors import InputError
from scenewright.program.printer import print_program
from scenewright.translate.model.exchange import TranslatorSettings
from scenewright.translate.sources import is_program, read_scenario, text_of

SENTENCE = (
    "The ego drives west and goes straight on. An oncoming hero turns left into the driveway. When the ego is 25 m "
    "before the conflict point, the hero brakes to a stop."
)


def test_program_is_told_from_a_description() -> None:
    program, understood = read_scenario(SENTENCE)
    assert understood is not None
    assert understood.translator == "offline"
    text = print_program(program)
    assert is_program(text)
    assert read_scenario(text) == (program, None)
    assert is_program("  ACTOR 0 (ego):\n- W")
    assert not is_program(SENTENCE)
    assert not is_program("The actor 1 m before the line brakes.")


def test_a_file_is_read_whatever_mark_it_begins_with(tmp_path: Path) -> None:
    (tmp_path / "left turn.txt").write_bytes(b"\xef\xbb\xbf" + SENTENCE.encode())
    assert text_of(str(tmp_path / "left turn.txt")) == (SENTENCE, "left turn.txt")
    assert text_of(SENTENCE) == (SENTENCE, "description")


def test_source_that_is_no_file_is_told_by_its_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_scenario(str(tmp_path / "nothing.scene"))
    (tmp_path / "built.py").write_text('"""A car turns left."""\nscene.text()\n', encoding="utf-8")
    with pytest.raises(InputError, match="this is Python"):
        read_scenario(str(tmp_path / "built.py"))
    (tmp_path / "picture.txt").write_bytes(b"\xff\xfe\x00\xd8")
    with pytest.raises(InputError, match="cannot be read as text"):
        read_scenario(str(tmp_path / "picture.txt"))
    (tmp_path / "long.txt").write_bytes(b"a" * 5_000_000)
    with pytest.raises(InputError, match="too large"):
        read_scenario(str(tmp_path / "long.txt"))


def test_a_translator_that_there_is_not_is_refused_for_descriptions_alone() -> None:
    with pytest.raises(InputError, match="no translator oracle"):
        read_scenario(SENTENCE, "oracle")
    assert read_scenario(print_program(read_scenario(SENTENCE)[0]), "oracle")[1] is None


def test_answers_and_strictness_hold_offline() -> None:
    text = SENTENCE.replace("The ego drives west and goes straight on", "The ego has an open way")
    _, understood = read_scenario(text)
    assert understood is not None
    (question,) = understood.questions
    settings = TranslatorSettings(answers={question.slot: question.alternatives[-1]}, strict=True)
    _, answered = read_scenario(text, settings=settings)
    assert answered is not None
    assert question.alternatives[-1] in answered.lines[0].sentence
