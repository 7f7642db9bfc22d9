"""Tables of turns of phrase: what every match holds, and that what is said instead refers to groups that are there."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from scenewright.translate.gist.idioms import _INDEXED
from scenewright.translate.gist.rewriting import needed

TEXTS = [
    row["text"]
    for name in ("paper_kind.toml", "prose.toml", "traps.toml")
    for row in tomllib.loads((Path(__file__).parents[1] / "texts" / name).read_text(encoding="utf-8"))["text"]
]


@pytest.mark.parametrize(
    ("pattern", "held"),
    [
        (r"\bthe van is parked\b", "the van is parked"),
        (r"(?:the|our) Van[s]? is parked(?: there)?", " is parked"),
        (r"a(?:b|c)de+|f", ""),
        (r"foo ?bars{2}q+", "foo"),
        (r"[(|]xy[]|]z", "xy"),
        (r"(?<!before )\bgo\.on", "go"),
    ],
)
def test_what_every_match_holds(pattern: str, held: str) -> None:
    assert needed(re.compile(pattern)) == held


def test_no_match_is_missed() -> None:
    missed = []
    for text in TEXTS[::7]:
        lowered = text.lower()
        missed += [held for held, pattern, _ in _INDEXED if held not in lowered and pattern.search(text)]
    assert missed == []


def test_most_patterns_need_not_be_searched() -> None:
    assert sum(len(held) > 3 for held, _, _ in _INDEXED) > len(_INDEXED) / 2


def test_what_is_said_instead_refers_to_groups_that_are_there() -> None:
    for _, pattern, words in _INDEXED:
        assert isinstance(words, str) is not callable(words)
        if isinstance(words, str):
            pattern.sub(words, "")  # raises re.error where a group is not there
