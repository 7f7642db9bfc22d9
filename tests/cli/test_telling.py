"""`tell`: programs and descriptions in plain English."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from sentences import SENTENCE

Command = Callable[..., Any]
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "hesitates_and_goes.scene"


def test_a_program_is_told_in_plain_english(command: Command) -> None:
    result = command("tell", str(EXAMPLE))
    assert result.exit_code == 0
    assert "Then the hero stands still." in result.stdout.splitlines()
    assert "A1" not in result.stdout


def test_a_description_is_told_as_it_was_understood(command: Command) -> None:
    told = json.loads(command("tell", SENTENCE, "--json").stdout)["sentences"]
    assert told[0] == "The ego is headed west and goes straight on."
    assert "until it stands 8 m before the conflict point" in told[-1]


def test_what_has_no_words_is_refused_by_name(command: Command, tmp_path: Path) -> None:
    program = EXAMPLE.read_text(encoding="utf-8") + "A1v(t1) * A0v(t0) == 12\n"
    (tmp_path / "product.scene").write_text(program, encoding="utf-8")
    result = command("tell", str(tmp_path / "product.scene"))
    assert result.exit_code == 2
    assert "cannot be told in words yet" in result.stderr
