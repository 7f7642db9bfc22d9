"""Readings are counted by meaning: right, refused, silently wrong; and what is to be refused must be."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.errors import InputError, SolverError, TranslationError
from scenewright.program.text import parse_program
from scenewright.study.translation import (
    Asking,
    GoldText,
    Outcome,
    Translate,
    measure,
    read_texts,
    shipped_texts,
    tally,
)
from scenewright.translate.sources import read_scenario

GOLD = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0(t1) == A1(t1)
gap(A0, A1, t1) == 20
A1a(dec) == -3
A1v(t2) == 0
"""
ASKED = GoldText("a", "any text", GOLD)
REFUSED = GoldText("b", "any text", None, "off-topic")


EITHER = GoldText("d", "any text", GOLD, "not supported")
AMBIGUOUS = GoldText("c", "any text", None, "ambiguous")


def gives(text: str, *questions: str) -> Translate:
    return lambda _: Asking(parse_program(text), questions)


def outcome_of(gold: GoldText, translate: Translate) -> Outcome:
    (reading,) = measure([gold], translate)
    return reading.outcome


def refuses(_: str) -> Asking:
    raise TranslationError("not understood", found="hover")


def falls_silent(_: str) -> Asking:
    raise SolverError("no reply in time")


@pytest.mark.parametrize(
    ("gold", "translate", "outcome"),
    [
        (ASKED, gives(GOLD), "right"),
        (ASKED, gives(GOLD.replace("gap(A0, A1, t1) == 20", "A1x(t1) - A0x(t1) == 20")), "right"),
        (ASKED, gives(GOLD.replace("== 20", "== 2")), "silently wrong"),
        (ASKED, gives(GOLD.replace("A1a(dec) == -3\n", "")), "silently wrong"),
        (ASKED, refuses, "refused"),
        (REFUSED, refuses, "rightly refused"),
        (REFUSED, gives(GOLD), "wrongly accepted"),
        (REFUSED, gives(GOLD + "A1v(t1) == 0\n"), "rightly refused"),
        (EITHER, gives(GOLD), "right"),
        (EITHER, refuses, "rightly refused"),
        (EITHER, gives(GOLD.replace("== 20", "== 2")), "silently wrong"),
        (AMBIGUOUS, gives(GOLD), "wrongly accepted"),
        (AMBIGUOUS, gives(GOLD, "Which of the two?"), "rightly asked"),
        (REFUSED, gives(GOLD, "Which of the two?"), "wrongly accepted"),
        (ASKED, gives(GOLD.replace("== 20", "== 2"), "Really?"), "silently wrong"),
        (ASKED, falls_silent, "unanswered"),
    ],
)
def test_outcomes(gold: GoldText, translate: Translate, outcome: Outcome) -> None:
    assert outcome_of(gold, translate) == outcome


def test_what_is_wrong_is_told() -> None:
    (reading,) = measure([ASKED], gives(GOLD.replace("== 20", "== 2")))
    assert reading.notes == ("lost: gap(A0, A1, t1) == 20", "added: gap(A0, A1, t1) == 2")


def test_tallies_add_up() -> None:
    golds = [GoldText("a", "x", GOLD, group="one"), GoldText("b", "x", GOLD, group="two"), REFUSED]
    *groups, every = tally(list(measure(golds, refuses)))
    assert sum(group.total for group in groups) == every.total == 3
    assert every.share("refused") == pytest.approx(2 / 3)
    assert every.share("right", "rightly refused") == pytest.approx(1 / 3)


@pytest.mark.parametrize(
    "content",
    [
        "nothing here",
        '[[text]]\nid = "a"\ntext = "x"\n',
        '[[text]]\ntext = "x"\nprogram = "p"\n',
    ],
)
def test_what_is_no_set_is_told(tmp_path: Path, content: str) -> None:
    path = tmp_path / "set.toml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_texts(path)
    assert "program or refuse" in (caught.value.expected or "")


def test_shipped_set_is_large_sound_and_read_well_offline() -> None:
    texts = shipped_texts()
    assert len({text.id for text in texts}) == len(texts) >= 200
    assert sum(text.program is None for text in texts) >= 20
    readings = list(measure(texts, lambda text: Asking(read_scenario(text)[0])))
    counts = tally(readings)[-1]
    # Floors, so that a change for the worse is seen; docs/evaluation.md has the figures.
    assert counts.share("silently wrong", "wrongly accepted") <= 0.01
    assert counts.share("right", "rightly refused") >= 0.85
