"""Every row of the page on plain English is what the teller writes, and is read back."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scenewright.program.text import parse_program
from scenewright.translate.decompile import decompile
from scenewright.translate.read.sentences import read
from scenewright.translate.story import arranged
from scenewright.translate.tell import tell

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "english.md").read_text(encoding="utf-8")
SHOWN, TOLD = re.findall(r"^```text\n(.*?)^```", PAGE, flags=re.MULTILINE | re.DOTALL)
BASE = SHOWN[: SHOWN.index("A1x(t4)")]
ROWS = re.findall(r"^\| [^|]+ \| `([^|]+)` \| ([^|]+) \|$", PAGE, flags=re.MULTILINE)


def test_the_example_is_what_is_told() -> None:
    assert "\n".join(tell(decompile(parse_program(SHOWN)))) == TOLD.strip()


@pytest.mark.parametrize(("constraint", "told"), ROWS, ids=[row[0] for row in ROWS])
def test_a_row_is_what_is_told_and_reads_back(constraint: str, told: str) -> None:
    before = tell(decompile(parse_program(BASE)))
    story = decompile(parse_program(f"{BASE}{constraint}\n"))
    lines = tell(story)
    assert " ".join(line for line in lines if line not in before) == told
    assert arranged(read("\n".join(lines))) == story


def test_there_is_a_row_for_every_quantity() -> None:
    assert len(ROWS) >= 30
    for word in (
        "gap(",
        "freespace(",
        "headway(",
        "ttc(",
        "tta(",
        "always[",
        "never[",
        "eventually[",
        " or ",
        "not ",
        "implies",
    ):
        assert any(word in constraint for constraint, _ in ROWS), word


def test_sentences_in_the_text_are_read() -> None:
    sentences = re.findall(r"`((?:The|Parameter|Manner)\s[^`]+\.)`", PAGE)
    assert len(sentences) >= 4
    for sentence in sentences:
        story = read("\n".join(["The ego has an open way.", " ".join(sentence.split())]))
        assert not (*story.questions, *story.asides)
