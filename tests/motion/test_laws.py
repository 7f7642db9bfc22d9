"""Laws of motion: what is admitted is in reach, what is in reach is realised, and a millimetre outside is not."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.motion.laws import ANY, Law, Move, Reach, holds, reach, realise

FREE = Law(Fraction(-8), Fraction(4), Fraction(0), Fraction(18))
LAWS = [
    FREE,
    Law(Fraction(-8), Fraction(0), Fraction(0), Fraction(18)),
    Law(Fraction(0), Fraction(4), Fraction(0), Fraction(18)),
    Law(Fraction(-3), Fraction(-1), Fraction(0), Fraction(18)),
    Law(Fraction(-3), Fraction(2), Fraction(4), Fraction(9)),
    Law(Fraction(-2), Fraction(-2), Fraction(0), Fraction(18)),
    Law(Fraction(0), Fraction(0), Fraction(0), Fraction(0)),
]


@st.composite
def driven(draw: st.DrawFn, law: Law) -> tuple[float, list[Move]]:
    """Draw a motion of a law: a first speed and moves."""
    low, high = float(law.speed_low), float(law.speed_high)
    first = speed = draw(st.floats(low, high))
    moves: list[Move] = []
    for _ in range(draw(st.integers(1, 5))):
        lasts = draw(st.floats(0.05, 2.0))
        slowest, fastest = (
            max(float(law.rate_low), (low - speed) / lasts),
            min(float(law.rate_high), (high - speed) / lasts),
        )
        if slowest > fastest:
            break
        rate = draw(st.sampled_from([slowest, fastest, 0.5 * (slowest + fastest)]))
        moves.append((lasts, rate))
        speed += lasts * rate
    return first, moves


def ends(first: float, moves: list[Move]) -> tuple[float, float, float]:
    """Return last speed, duration and distance."""
    speed, lasts, way = first, 0.0, 0.0
    for duration, rate in moves:
        way += (speed + 0.5 * rate * duration) * duration
        speed, lasts = speed + rate * duration, lasts + duration
    return speed, lasts, way


@pytest.mark.parametrize("law", LAWS)
@given(st.data())
def test_whatever_is_admitted_is_in_reach(law: Law, data: st.DataObject) -> None:
    first, moves = data.draw(driven(law))
    assert law.admits(first, moves)
    last, lasts, way = ends(first, moves)
    assert holds(reach(law, first, last, lasts, way), 1e-6)


@pytest.mark.parametrize("law", LAWS)
@given(st.data())
def test_whatever_is_in_reach_is_realised_by_a_motion_of_the_law(law: Law, data: st.DataObject) -> None:
    first, moves = data.draw(driven(law))
    last, lasts, way = ends(first, moves)
    last = min(max(last + data.draw(st.floats(-1.0, 1.0)), float(law.speed_low)), float(law.speed_high))
    way += data.draw(st.floats(-3.0, 3.0))
    if not holds(reach(law, first, last, lasts, way)):
        return
    made = realise(law, first, last, lasts, way)
    assert law.admits(first, made)
    assert ends(first, made) == pytest.approx((last, lasts, way), abs=1e-6)


@pytest.mark.parametrize("law", [LAWS[0], LAWS[1], LAWS[2], LAWS[4]])
@pytest.mark.parametrize(
    ("first", "last", "lasts"), [(5.0, 5.0, 3.0), (8.0, 7.0, 1.0), (6.0, 7.0, 2.0), (9.0, 4.0, 4.0)]
)
def test_a_millimetre_beyond_the_extremes_is_out_of_reach(law: Law, first: float, last: float, lasts: float) -> None:
    def reached(millimetres: int) -> bool:
        return holds(reach(law, first, last, lasts, millimetres / 1000))

    coarse = [n for n in range(0, 80_000, 50) if reached(n)]
    if not coarse:  # this law cannot change its speed so
        return
    fine = [n for edge in (coarse[0], coarse[-1]) for n in range(edge - 60, edge + 61) if reached(n)]
    assert coarse == list(range(coarse[0], coarse[-1] + 1, 50)), "reach is an interval"
    low, high = fine[0] / 1000, fine[-1] / 1000
    for way in (low, high):
        made = realise(law, first, last, lasts, way)
        assert law.admits(first, made)
        assert ends(first, made)[2] == pytest.approx(way, abs=1e-6)
    for way, beyond in ((low, low - 0.002), (high, high + 0.002)):
        assert not holds(reach(law, first, last, lasts, beyond)), way


@given(st.data())
def test_a_part_of_a_motion_obeys_the_same_law(data: st.DataObject) -> None:
    first, moves = data.draw(driven(FREE))
    cut = data.draw(st.integers(0, len(moves)))
    middle, lasts, way = ends(first, moves[:cut])
    last, rest, further = ends(middle, moves[cut:])
    assert holds(reach(FREE, first, middle, lasts, way), 1e-6)
    assert holds(reach(FREE, middle, last, rest, further), 1e-6)


def test_laws_meet() -> None:
    slow = Law(ANY.rate_low, ANY.rate_high, ANY.speed_low, Fraction(6))
    assert FREE.meet(slow) == Law(Fraction(-8), Fraction(4), Fraction(0), Fraction(6))
    nothing = LAWS[1].meet(Law(Fraction(1), Fraction(4), Fraction(0), Fraction(18)))
    assert nothing.is_empty
    assert reach(nothing, 1.0, 1.0, 1.0, 1.0) == Reach(impossible=True)
    assert not holds(reach(nothing, 1.0, 1.0, 1.0, 1.0), 100.0)


def test_what_breaks_a_law_is_not_admitted() -> None:
    assert not FREE.admits(5.0, [(1.0, -8.1)])
    assert not FREE.admits(5.0, [(1.0, -5.1)]), "backwards"
    assert not FREE.admits(17.0, [(1.0, 2.0)]), "beyond the top speed"
    assert not FREE.admits(18.1, [])


@pytest.mark.parametrize(
    ("law", "words"),
    [
        (Law(Fraction(-8), Fraction(4), Fraction(0), Fraction(325, 18)),
         "brakes at 8 m/s^2 at most, speeds up at 4 m/s^2 at most, and is 18.1 m/s fast at most"),
        (Law(Fraction(0), Fraction(3, 2), Fraction(0), Fraction(9)),
         "never brakes, speeds up at 1.5 m/s^2 at most, and is 9 m/s fast at most"),
        (Law(Fraction(0), Fraction(0), Fraction(0), Fraction(0)), "stands"),
    ],
)  # fmt: skip
def test_a_law_in_words(law: Law, words: str) -> None:
    assert law.words() == words
