"""Hypothesis strategies: expressions and programs as data, in the form that the text has for them."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from scenewright.errors import Span
from scenewright.program.arithmetic import combine, negate
from scenewright.program.expressions import (
    LANDMARKS,
    Compare,
    Derived,
    Elapsed,
    Formula,
    Knot,
    Landmark,
    Logic,
    Number,
    ParameterRef,
    PieceRef,
    State,
    Temporal,
    Term,
)
from scenewright.program.manner import NUMBERS, Manner
from scenewright.program.types import (
    Actor,
    Constraint,
    HeadingsRoute,
    IntentRoute,
    LanesRoute,
    Parameter,
    PieceKind,
    Program,
    Sketch,
)

KINDS = [str(kind) for kind in PieceKind]
names = st.from_regex(r"[a-z_][a-z0-9_]{0,7}", fullmatch=True)
odd_names = st.sampled_from(["hero 2", "Blue-2", 'the "big" one', "Ümit", "7 (seven)"])  # of people in prose
knots = names.filter(lambda name: name.rstrip("0123456789") not in KINDS)
parameter_names = st.builds(
    lambda stem, unit: stem + unit, names, st.sampled_from(["_m", "_s", "_mps", "_mpss", "_ft"])
)
fractions = st.one_of(
    st.integers(0, 999).map(Fraction),
    st.decimals(0, 1000, places=3).map(Fraction),
    st.fractions(0, 1000, max_denominator=900),
)
actors = st.integers(0, 3)
landmarks = st.builds(Landmark, st.sampled_from(LANDMARKS)) | st.builds(
    Landmark, st.sampled_from(LANDMARKS), actors, st.none() | actors
)
elapsed = st.builds(Elapsed, actors, knots)
pieces = st.builds(
    lambda kind, number: PieceRef(f"{kind}{number}"), st.sampled_from(KINDS), st.sampled_from(["", 1, 2])
)
moments = st.one_of(st.none(), st.builds(Knot, knots), elapsed, st.builds(Number, fractions))
states = st.builds(State, actors, st.sampled_from([0, 1, 2]), moments | pieces)
derived = st.builds(Derived, st.just("tta"), actors, landmarks, moments) | st.builds(
    Derived, st.sampled_from(["gap", "freespace", "ttc", "headway"]), actors, actors, moments
)
numbers = st.builds(lambda value, sign: Number(sign * value), fractions, st.sampled_from([1, -1]))


def terms(parameters: list[str]) -> st.SearchStrategy[Term]:
    leaves: list[st.SearchStrategy[Term]] = [numbers, states, derived, elapsed, landmarks]
    if parameters:
        leaves.append(st.builds(ParameterRef, st.sampled_from(parameters)))
    return st.recursive(
        st.one_of(leaves),
        lambda inner: st.builds(combine, st.sampled_from("+-*/"), inner, inner) | st.builds(negate, inner),
        max_leaves=6,
    )


def formulas(parameters: list[str]) -> st.SearchStrategy[Formula]:
    term = terms(parameters)
    compare = st.builds(Compare, st.sampled_from(["==", "<=", ">=", "<", ">"]), term, term)
    return st.recursive(
        compare,
        lambda inner: st.one_of(
            st.builds(Logic, st.sampled_from(["and", "or"]), st.lists(inner, min_size=2, max_size=3).map(tuple)),
            st.builds(lambda operand: Logic("not", (operand,)), inner),
            st.builds(lambda left, right: Logic("implies", (left, right)), inner, inner),
            st.builds(Temporal, st.sampled_from(["always", "never", "eventually"]), term, term, inner),
        ),
        max_leaves=4,
    )


headings = st.sampled_from("NESW")
areas = st.none() | st.sampled_from(["road", "driveway"])
routes = st.one_of(
    st.builds(HeadingsRoute, st.lists(headings, min_size=1, max_size=3).map(tuple)),
    st.builds(LanesRoute, st.lists(st.sampled_from(["1.0.-1", "12.0.1", "a.b"]), min_size=1, max_size=3).map(tuple)),
    st.builds(
        IntentRoute,
        areas,
        st.none() | st.sampled_from(["left", "right", "straight"]),
        areas,
        st.none() | headings,
        st.none() | headings,
    ),
)

manners = st.builds(
    Manner, **{name: st.fractions(of.low, of.high, max_denominator=900) for name, of in NUMBERS.items()}
)


@st.composite
def sketches(draw: st.DrawFn) -> Sketch:
    kinds = draw(st.lists(st.sampled_from(list(PieceKind)), min_size=1, max_size=4))
    count = len(kinds) + 1
    return Sketch(tuple(draw(st.lists(knots, min_size=count, max_size=count, unique=True))), tuple(kinds))


@st.composite
def parameters(draw: st.DrawFn, name: str) -> Parameter:
    value = draw(st.none() | fractions)
    low, high = draw(st.just((None, None)) | st.tuples(fractions, fractions))
    return Parameter(name, value, low, high)


@st.composite
def programs(draw: st.DrawFn) -> Program:
    words = st.text(st.characters(exclude_categories=["Cs"]), max_size=30)
    description = draw(st.none() | words)
    declared = draw(st.lists(parameter_names, max_size=3, unique=True))
    count = draw(st.integers(1, 3))
    drawn = draw(st.lists(formulas(declared), max_size=4))
    ids = draw(st.lists(st.none() | names, min_size=len(drawn), max_size=len(drawn)))
    spans = st.none() | st.builds(Span, st.integers(0, 40), st.integers(0, 40))
    return Program(
        draw(words),
        tuple(Actor(i, draw(names | odd_names), draw(routes), draw(sketches())) for i in range(count)),
        tuple(
            Constraint(label or f"c{i}", f, draw(spans))
            for i, (label, f) in enumerate(zip(ids, drawn, strict=True), start=1)
        ),
        tuple(draw(parameters(name)) for name in declared),
        draw(names),
        description,
        draw(manners),
    )
