"""Tables of turns of phrase: what every match holds, and that what is said instead refers to groups that are there."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from scenewright.translate.gist.idioms import _INDEXED
from scenewright.translate.gist.rewriting import held, needed

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


@pytest.mark.parametrize(
    ("pattern", "runs"),
    [
        (r"\b(?:goes|drives) (?:on|past the van)\b", ("goes", "drives")),
        (r"\b(?:goes|drives) past the van\b", (" past the van",)),
        (r"(?:stops|halts)? (?:there|at the line(?: again)?)", ("there", "at the line")),
        (r"(?<=abcde) (?:x|y)z", ("",)),
        (r"(?!parked)(?P<who>lorry|tractor)s?", ("lorry", "tractor")),
        (r"(?:ab\|cd|[|)]efgh)", ("ab", "efgh")),
    ],
)
def test_one_of_which_every_match_holds(pattern: str, runs: tuple[str, ...]) -> None:
    found = held(re.compile(pattern))
    assert found == runs or (len(min(runs, key=len)) <= 3 and min(map(len, found)) <= 3)


def test_no_match_is_missed() -> None:
    missed = []
    for text in TEXTS[::7]:
        lowered = text.lower()
        missed += [
            runs for runs, pattern, _ in _INDEXED if not any(run in lowered for run in runs) and pattern.search(text)
        ]
    assert missed == []


def test_most_patterns_need_not_be_searched() -> None:
    assert sum(min(map(len, runs)) > 3 for runs, _, _ in _INDEXED) > len(_INDEXED) / 2


def test_what_is_said_instead_refers_to_groups_that_are_there() -> None:
    for _, pattern, words in _INDEXED:
        assert isinstance(words, str) is not callable(words)
        if isinstance(words, str):
            pattern.sub(words, "")  # raises re.error where a group is not there
