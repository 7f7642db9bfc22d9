"""Texts that neither the rules were widened for nor the learned reader was trained on: what to expect of new ones."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from types import ModuleType

from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.study.translation import Asking, measure, read_texts
from scenewright.translate.offline import translate_offline

TEXTS = Path(__file__).parents[1] / "texts" / "kept_aside.toml"
RIGHT_PAPER, RIGHT_FREE, WRONG = 0.98, 0.8, 0.01  # what is aimed at


def reading_of(text: str) -> Asking:
    return Asking(translate_offline(text).program)


def test_new_texts_are_read_as_often_as_is_aimed_at() -> None:
    found = {each.text.id: each.outcome for each in measure(read_texts(TEXTS), reading_of, Z3Backend())}
    groups = {
        name: Counter(each for key, each in found.items() if key.startswith(name)) for name in ("qa", "qb", "qc", "qe")
    }
    free = groups["qb"] + groups["qc"] + groups["qe"]
    assert groups["qa"]["right"] >= RIGHT_PAPER * groups["qa"].total()
    assert free["right"] >= RIGHT_FREE * free.total()
    assert sum(group["silently wrong"] for group in groups.values()) <= WRONG * free.total()
    traps = Counter(each for key, each in found.items() if key.startswith("qd"))
    assert traps["rightly refused"] >= 0.95 * traps.total()
    assert len(found) == 300


def test_the_training_leaves_them_out(training: tuple[ModuleType, ModuleType]) -> None:
    lessons, _ = training
    assert lessons.KEPT_ASIDE == TEXTS
    assert TEXTS.with_name("prose.toml") in lessons.TEXTS
    assert TEXTS not in lessons.TEXTS
    learned = {identifier for identifier, *_ in lessons.texts()}
    assert learned.isdisjoint(text.id for text in read_texts(TEXTS))
