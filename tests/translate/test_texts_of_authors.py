"""Texts of many authors, each new to the translator once: read as everybody's are, by rules and by likeness.

Most of them are what the rules were widened for and what the learned reader was trained on: regression, no promise.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.study.translation import Asking, measure, read_texts
from scenewright.translate.offline import translate_offline

FOLDER = Path(__file__).parent / "texts"
# A time to collision of whoever is behind, "it goes on only after", what stands first: rare facts, read wrong.
WRONG = {"aj-019", "aj-044", "aj-046", "aj-102", "aj-116", "aj-118", "ap-036"}
ACCEPTED_TRAPS = 51  # of 2258; may only fall


def reading_of(text: str) -> Asking:
    return Asking(translate_offline(text).program)


@pytest.mark.parametrize(("name", "least"), [("paper_kind.toml", 0.97), ("prose.toml", 0.85), ("beyond.toml", 0.2)])
def test_texts_of_many_authors_mean_the_same_or_are_refused(name: str, least: float) -> None:
    outcomes = {each.text.id: each.outcome for each in measure(read_texts(FOLDER / name), reading_of, Z3Backend())}
    wrong = {identifier for identifier, each in outcomes.items() if each not in ("right", "refused", "rightly refused")}
    assert wrong <= WRONG
    assert Counter(outcomes.values())["right"] >= least * len(outcomes)
    assert len(outcomes) >= 60


def test_traps_are_refused() -> None:
    texts = read_texts(FOLDER / "traps.toml")
    outcomes = Counter(each.outcome for each in measure(texts, reading_of, Z3Backend()))
    assert outcomes["silently wrong"] == 0
    assert outcomes["wrongly accepted"] <= ACCEPTED_TRAPS
    assert outcomes["rightly refused"] > 2000
