"""The motion a sketch stands for (the paper's algorithms 1 and 2): symbols and numbers agree, at knots and at times."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import smtlib
from scenewright.motion.algebra import Symbol, Value, smt
from scenewright.motion.profile import Profile, chain
from scenewright.motion.sketched import SketchedMotion

speeds = st.fractions(0, 20, max_denominator=12)
durations = st.fractions(Fraction(1, 10), 8, max_denominator=12)
shapes = st.integers(1, 4).flatmap(
    lambda n: st.tuples(
        st.lists(speeds, min_size=n + 1, max_size=n + 1),
        st.lists(durations, min_size=n, max_size=n),
        st.fractions(0, 50, max_denominator=12),
    )
)
Shape = tuple[list[Fraction], list[Fraction], Fraction]


def numeric(shape: Shape) -> SketchedMotion:
    knots, lasting, start = shape
    positions = [Fraction(7)]
    for v0, v1, duration in zip(knots, knots[1:], lasting, strict=False):
        positions.append(positions[-1] + (v0 + v1) * duration / 2)
    rates = tuple((v1 - v0) / d for v0, v1, d in zip(knots, knots[1:], lasting, strict=False))
    return SketchedMotion(start, tuple(positions), tuple(knots), tuple(lasting), rates)


def symbolic(motion: SketchedMotion) -> tuple[SketchedMotion, dict[str, Fraction]]:
    known: dict[str, Fraction] = {}

    def named(letter: str, values: tuple[Value, ...]) -> tuple[Value, ...]:
        for k, value in enumerate(values):
            assert isinstance(value, Fraction)
            known[f"{letter}{k}"] = value
        return tuple(Symbol(f"{letter}{k}") for k in range(len(values)))

    (start,) = named("t", (motion.start,))
    rates = tuple(rate for rate in motion.accelerations if rate is not None)
    return (
        SketchedMotion(
            start,
            named("x", motion.positions),
            named("v", motion.speeds),
            named("d", motion.durations),
            named("a", rates),
        ),
        known,
    )


def as_profile(shape: Shape) -> Profile:
    knots, lasting, start = shape
    moves = [
        (float(d), float((v1 - v0) / d), k)
        for k, (v0, v1, d) in enumerate(zip(knots, knots[1:], lasting, strict=False))
    ]
    return Profile(chain(float(start), 7.0, float(knots[0]), moves))


@given(shapes, st.sampled_from([0, 1, 2]))
def test_states_at_knots_agree(shape: Shape, order: int) -> None:
    motion = numeric(shape)
    symbols, known = symbolic(motion)
    for index in range(len(motion.speeds)):
        numerator, denominator = motion.state_at_knot(index, order)
        symbol_numerator, symbol_denominator = symbols.state_at_knot(index, order)
        found = Fraction(smtlib.value(smt(symbol_numerator), known)) / smtlib.value(smt(symbol_denominator), known)
        assert found == numerator / denominator
        assert smtlib.value(smt(symbols.time_at_knot(index)), known) == motion.time_at_knot(index)


@given(shapes, st.sampled_from([0, 1]), st.fractions(0, 1, max_denominator=97))
def test_states_at_concrete_times_agree_with_numbers_and_with_the_profile(
    shape: Shape, order: int, part: Fraction
) -> None:
    motion = numeric(shape)
    symbols, known = symbolic(motion)
    end = motion.time_at_knot(len(motion.durations))
    time = motion.start + part * (end + 2 - motion.start)
    exact = motion.state_at_time(time, order)
    assert smtlib.value(smt(symbols.state_at_time(time, order)), known) == exact
    assert smtlib.value(smt(symbols.state_at_time(Symbol("now"), order)), known | {"now": time}) == exact
    assert as_profile(shape).state(float(time))[order] == pytest.approx(float(exact), abs=1e-6)


@given(shapes)
def test_an_unknown_acceleration_is_the_ratio_of_its_ends(shape: Shape) -> None:
    motion = numeric(shape)
    bare = SketchedMotion(
        motion.start, motion.positions, motion.speeds, motion.durations, (None,) * len(motion.durations)
    )
    for piece in range(len(motion.durations)):
        numerator, denominator = bare.acceleration_of(piece)
        assert numerator / denominator == motion.accelerations[piece]
    with pytest.raises(ValueError, match="acceleration of every piece"):
        bare.state_at_time(motion.start, 0)
