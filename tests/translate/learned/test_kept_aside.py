"""Texts that neither the rules were widened for nor the learned reader was trained on: what to expect of new ones."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from types import ModuleType

from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.study.translation import Asking, measure, read_texts
from scenewright.translate.offline import translate_offline

TEXTS = Path(__file__).parents[1] / "texts" / "kept_aside.toml"
RIGHT_PAPER, RIGHT_FREE, WRONG, REFUSED = 0.98, 0.8, 0.01, 0.9  # what is aimed at


def reading_of(text: str) -> Asking:
    return Asking(translate_offline(text).program)


def test_new_texts_are_read_as_often_as_is_aimed_at() -> None:
    groups: dict[str, Counter[str]] = {"the paper's kind": Counter(), "traps": Counter(), "free": Counter()}
    for each in measure(read_texts(TEXTS), reading_of, Z3Backend()):
        _, _, kind = each.text.group.partition(": ")
        groups[kind if kind in groups else "free"][each.outcome] += 1
    paper, traps, free = groups.values()
    assert paper["right"] >= RIGHT_PAPER * paper.total()
    assert free["right"] >= RIGHT_FREE * free.total()
    assert paper["silently wrong"] + free["silently wrong"] <= WRONG * free.total()
    assert traps["rightly refused"] >= REFUSED * traps.total()
    assert [group.total() for group in groups.values()] == [180, 180, 400]


def test_the_training_leaves_them_out(training: tuple[ModuleType, ModuleType]) -> None:
    lessons, _ = training
    assert lessons.KEPT_ASIDE == TEXTS
    assert TEXTS.with_name("prose.toml") in lessons.TEXTS
    assert TEXTS not in lessons.TEXTS
    learned = {text.id for path in lessons.TEXTS for text in read_texts(path)}
    assert learned.isdisjoint(text.id for text in read_texts(TEXTS))
