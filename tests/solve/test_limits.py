"""Styles of moving in the manner of a program: what is asked for comes before what is preferred."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

from scenewright.program.manner import USUAL, Manner
from scenewright.solve.limits import (
    CLOSE,
    CLOSE_QUICK,
    COUNTER,
    FIRM,
    GENTLE,
    HASTE,
    ROOM,
    STEADY,
    URGENT,
    WHOLE,
    Style,
    calm_mpss,
)

STYLES = (STEADY, GENTLE, FIRM, WHOLE, URGENT, COUNTER, CLOSE, CLOSE_QUICK, HASTE)
STRICT = Manner(
    begins_mpss=Fraction(3),
    begins_s=Fraction(1),
    settled_mpss=Fraction(3, 10),
    settled_s=Fraction(2),
    stands_s=Fraction(3),
)


@pytest.mark.parametrize("manner", [USUAL, STRICT], ids=["usual", "strict"])
@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.name)
def test_no_style_does_less_than_the_manner_asks_for(style: Style, manner: Manner) -> None:
    kept, strict = style.kept_to(manner), manner.stricter(ROOM)
    assert kept.settle_s >= float(strict.settled_s)
    assert kept.seen_s >= float(strict.begins_s)
    assert kept.early_mpss <= float(min(strict.settled_mpss, manner.begins_mpss / 2))
    for low, high in (kept.dec_mpss, kept.acc_mpss):
        assert float(strict.begins_mpss) <= low <= high
    assert kept.stop_s[0] >= float(strict.stands_s)
    assert kept.stop_s[1] > kept.stop_s[0]
    assert kept.kept_to(manner) == kept


def test_what_a_style_prefers_beyond_that_stays() -> None:
    assert FIRM.kept_to(USUAL) == FIRM
    assert FIRM.kept_to(replace(USUAL, settled_s=Fraction(2))) == replace(FIRM, settle_s=2.2)


def test_who_is_settled_is_not_yet_seen_to_begin() -> None:
    """What begins is seen from `begins_mpss` on, or from half of what it comes to: who is settled does less."""
    for manner in (USUAL, STRICT, replace(USUAL, settled_mpss=Fraction(3))):
        assert calm_mpss(manner) < manner.settled_mpss
        assert 2 * calm_mpss(manner) <= manner.begins_mpss
