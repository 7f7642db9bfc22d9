"""From a comparison to the one measure that it is: whose place, speed, rate, gap or time, and how much of it.

What enters: comparisons of a program. What leaves: a `Measure` with its amount as it was most likely written, or None
for what is no such thing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from scenewright.errors import TranslationError
from scenewright.language import story as st
from scenewright.program import expressions as ex
from scenewright.program import types as pt
from scenewright.program.linear import Atom, Linear, linear
from scenewright.program.printer import print_expression
from scenewright.program.resolve import usual_partner
from scenewright.units import SI_SYMBOL, UNITS, Dimension, format_fraction, unit_of_name

_QUANTITIES = {
    "gap": st.Quantity.GAP,
    "headway": st.Quantity.HEADWAY,
    "ttc": st.Quantity.COLLISION,
    "tta": st.Quantity.ARRIVAL,
}
_DIMENSIONS: dict[st.Quantity, Dimension] = {
    st.Quantity.PLACE: "length",
    st.Quantity.GAP: "length",
    st.Quantity.SPEED: "speed",
    st.Quantity.RATE: "acceleration",
    st.Quantity.ARRIVAL: "time",
    st.Quantity.HEADWAY: "time",
    st.Quantity.COLLISION: "time",
}
_DECIMALS = 2  # of a number in SI units that nobody would rather write in another unit
Instant = tuple[int, ex.At]  # whose, and which


def measure_of(compare: ex.Compare, program: pt.Program) -> tuple[st.Measure | None, set[Instant]]:
    """Return the measure that `compare` is, or None, and the instants at which it is measured."""
    form = difference(compare)
    states, landmarks = form.of(ex.State, ex.Derived), form.of(ex.Landmark)
    atoms = [atom for atom in states if isinstance(atom, ex.State | ex.Derived)]
    instants: set[Instant] = {(atom.actor, atom.at) for atom in atoms if atom.at is not None}
    if form.of(ex.Elapsed) or not states or len({atom.at is None for atom in atoms}) > 1:
        return None, instants
    if len(states) > 1:
        return None if landmarks else _of_two(states, compare.operator, form), instants
    ((state, factor),) = states.items()
    assert isinstance(state, ex.State | ex.Derived)
    form, op = form.scaled(1 / factor), compare.operator if factor > 0 else st.FLIPPED[compare.operator]
    return _of_one(state, op, form, program), instants


def _of_one(state: ex.State | ex.Derived, op: st.Operator, form: Linear, program: pt.Program) -> st.Measure | None:
    actor, landmarks = state.actor, form.of(ex.Landmark)
    if isinstance(state, ex.State) and state.order == 0:
        (place, factor), *more = landmarks.items() or [(None, Fraction(0))]
        if more or factor != -1 or not isinstance(place, ex.Landmark):
            return None
        where = _place(place, actor, program)
        before, amount = right_side(form, "length")
        if amount.value == 0:
            return st.Measure(actor, st.Quantity.PLACE, op, None, where)
        op = st.FLIPPED[op] if before else op
        return st.Measure(actor, st.Quantity.PLACE, op, amount, where, opposite=not before)
    if landmarks:
        return None
    if isinstance(state, ex.State):
        quantity = st.Quantity.SPEED if state.order == 1 else st.Quantity.RATE
        slowing, amount = right_side(form, _DIMENSIONS[quantity])
        if quantity is st.Quantity.RATE and slowing:
            return st.Measure(actor, quantity, st.FLIPPED[op], amount, opposite=True)
        return st.Measure(actor, quantity, op, plain_amount(form, _DIMENSIONS[quantity]))
    quantity = _QUANTITIES[state.kind]
    if isinstance(state.target, int):
        return _to(actor, quantity, op, state.target, form)
    return st.Measure(actor, quantity, op, plain_amount(form, "time"), _place(state.target, actor, program))


def _to(actor: int, quantity: st.Quantity, op: st.Operator, other: int, form: Linear) -> st.Measure:
    negative, amount = right_side(form, _DIMENSIONS[quantity])
    if quantity is st.Quantity.GAP and negative:
        return st.Measure(other, quantity, st.FLIPPED[op], amount, other=actor)
    return st.Measure(actor, quantity, op, plain_amount(form, _DIMENSIONS[quantity]), other=other)


def _of_two(states: Mapping[Atom, Fraction], op: st.Operator, form: Linear) -> st.Measure | None:
    if len(states) != 2:
        return None
    (one, factor), (other, against) = states.items()
    if not isinstance(one, ex.State) or not isinstance(other, ex.State) or factor != -against:
        return None
    if one.order != other.order or one.actor == other.actor or one.order == 2:
        return None
    form, op = form.scaled(1 / factor), op if factor > 0 else st.FLIPPED[op]
    if one.order == 0:  # `one` is ahead
        return _to(other.actor, st.Quantity.GAP, op, one.actor, form)
    slower, amount = right_side(form, "speed")
    op = st.FLIPPED[op] if slower else op
    faster_by = None if amount.value == 0 else amount
    return st.Measure(one.actor, st.Quantity.SPEED, op, faster_by, other=other.actor, opposite=slower)


def _place(landmark: ex.Landmark, actor: int, program: pt.Program) -> st.Place:
    owner = landmark.actor if landmark.actor is not None else actor
    usual = landmark.other in (None, usual_partner(program, owner))
    return st.Place(landmark.name, None if owner == actor else owner, None if usual else landmark.other)


# -- amounts --------------------------------------------------------------------------------------------------------
def difference(compare: ex.Compare) -> Linear:
    """Return what a comparison holds against zero."""
    return linear(compare.left).minus(linear(compare.right))


def right_side(form: Linear, dimension: Dimension) -> tuple[bool, st.Amount]:
    """Return what stands on the other side of a comparison: whether below zero, and one number or one parameter."""
    parameters = form.of(ex.ParameterRef)
    if not parameters:
        return form.constant > 0, _in_a_unit(abs(form.constant), dimension)
    (reference, factor), *more = parameters.items()
    assert isinstance(reference, ex.ParameterRef)
    unit = unit_of_name(reference.name)
    if more or form.constant or abs(factor) != 1 or unit is None:
        raise untold("a sum of amounts", "give the sum a parameter of its own")
    return factor > 0, st.Amount(None, unit.symbol, reference.name)


def plain_amount(form: Linear, dimension: Dimension) -> st.Amount:
    """Return the same where only a number may be below zero."""
    negative, amount = right_side(form, dimension)
    if negative and amount.value is None:
        raise untold(f"the negative of {amount.name}", "turn its sign where it gets its value")
    return replace(amount, value=-amount.value) if negative and amount.value is not None else amount


def _in_a_unit(value: Fraction, dimension: Dimension) -> st.Amount:
    """Return an amount as it was most likely written: in SI units, or where it is shortest: 30 mph, not 13.4112 m/s."""
    si = SI_SYMBOL[dimension]
    written = {symbol: format_fraction(value / unit.si_factor) for symbol, unit in UNITS.items()
               if unit.dimension == dimension}  # fmt: skip
    plain = {symbol: number for symbol, number in written.items() if "/" not in number} or written
    is_short = si in plain and len(plain[si].partition(".")[2]) <= _DECIMALS
    found = si if is_short else min(plain, key=lambda symbol: len(plain[symbol]))
    return st.Amount(value / UNITS[found].si_factor, found)


def untold(what: str, fix: str, node: ex.Node | None = None) -> TranslationError:
    """Return the error for what a story cannot tell yet."""
    found = None if node is None else print_expression(node)
    return TranslationError(f"{what} cannot be told in words yet", found=found, fix=fix)
