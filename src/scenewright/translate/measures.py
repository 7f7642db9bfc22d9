"""From a comparison to the one measure that it is: whose place, speed, rate, gap or time, and how much of it.

What enters: comparisons of a program. What leaves: a `Measure` with its amount as it was most likely written, or None
for what is no such thing.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.program import types as pt
from scenewright.program.linear import Atom, Linear, linear
from scenewright.program.resolve import usual_partner
from scenewright.translate import story as st
from scenewright.translate.compile import DERIVED, counted_down
from scenewright.translate.phrases import untold
from scenewright.units import SI_SYMBOL, UNITS, Dimension, format_fraction, unit_of_name

_QUANTITIES = {kind: quantity for quantity, kind in DERIVED.items()}
_DIMENSIONS: dict[st.Quantity, Dimension] = {
    st.Quantity.PLACE: "length",
    st.Quantity.GAP: "length",
    st.Quantity.SPEED: "speed",
    st.Quantity.RATE: "acceleration",
}  # the others are times
_DECIMALS = 2  # of a number in SI units that nobody would rather write in another unit


def measure_of(compare: ex.Compare, program: pt.Program) -> st.Measure | None:
    """Return the measure that `compare` is, at whatever instant, or None."""
    form = difference(compare)
    states = [atom for atom in form.atoms if isinstance(atom, ex.State | ex.Derived)]
    if form.of(ex.Elapsed) or not states or len({state.at is None for state in states}) > 1:
        return None
    state, *others = states
    factor = form.atoms[state]
    form, op = form.scaled(1 / factor), compare.operator if factor > 0 else st.FLIPPED[compare.operator]
    origins: list[Atom] = [*others, *form.of(ex.Landmark)]  # what the amount is counted from
    if len(origins) > 1 or any(form.atoms[each] != -1 for each in origins):
        return None
    measure = _measure(state, origins[0] if origins else None, op, program)
    return None if measure is None else _with_amount(measure, form)


def _measure(
    state: ex.State | ex.Derived, origin: Atom | None, op: st.Operator, program: pt.Program
) -> st.Measure | None:
    """Return the measure without its amount."""
    actor = state.actor
    match state, origin:
        case ex.Derived(kind=kind, target=int(other)), None:
            return st.Measure(actor, _QUANTITIES[kind], op, other=other)
        case ex.Derived(kind=kind, target=ex.Landmark() as target), None:
            return st.Measure(actor, _QUANTITIES[kind], op, place=_place(target, actor, program))
        case ex.State(order=0), ex.Landmark():
            return st.Measure(actor, st.Quantity.PLACE, op, place=_place(origin, actor, program))
        case ex.State(order=0), ex.State(order=0, actor=rear) if rear != actor:
            return st.Measure(rear, st.Quantity.GAP, op, other=actor)
        case ex.State(order=1), ex.State(order=1, actor=other) if other != actor:
            return st.Measure(actor, st.Quantity.SPEED, op, other=other)
        case ex.State(order=1), None:
            return st.Measure(actor, st.Quantity.SPEED, op)
        case ex.State(order=2), None:
            return st.Measure(actor, st.Quantity.RATE, op)
    return None


def _with_amount(measure: st.Measure, form: Linear) -> st.Measure:
    """Return a measure with what stands on the other side of its comparison, which some measures count downwards."""
    quantity, other = measure.quantity, measure.other
    down, amount = right_side(form, _DIMENSIONS.get(quantity, "time"))
    has_origin = quantity is st.Quantity.PLACE or (quantity is st.Quantity.SPEED and other is not None)
    if has_origin and amount.value == 0:
        return measure
    op = st.FLIPPED[measure.op] if down else measure.op
    if has_origin or quantity is st.Quantity.RATE:
        return replace(measure, op=op, amount=amount, opposite=counted_down(quantity, down))
    if quantity is st.Quantity.GAP and other is not None and down:
        return replace(measure, actor=other, other=measure.actor, op=op, amount=amount)
    if down and amount.value is None:
        raise untold(f"the negative of {amount.name}", "turn its sign where it gets its value")
    return replace(measure, amount=replace(amount, value=-amount.value) if down and amount.value else amount)


def _place(landmark: ex.Landmark, actor: int, program: pt.Program) -> st.Place:
    owner = landmark.actor if landmark.actor is not None else actor
    usual = landmark.other in (None, usual_partner(program, owner))
    return st.Place(landmark.name, None if owner == actor else owner, None if usual else landmark.other)


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


def _in_a_unit(value: Fraction, dimension: Dimension) -> st.Amount:
    """Return an amount as it was most likely written: in SI units, or where it is shortest: 30 mph, not 13.4112 m/s."""
    si = SI_SYMBOL[dimension]
    written = {symbol: format_fraction(value / unit.si_factor) for symbol, unit in UNITS.items()
               if unit.dimension == dimension}  # fmt: skip
    plain = {symbol: number for symbol, number in written.items() if "/" not in number} or written
    is_short = si in plain and len(plain[si].partition(".")[2]) <= _DECIMALS
    found = si if is_short else min(plain, key=lambda symbol: len(plain[symbol]))
    return st.Amount(value / UNITS[found].si_factor, found)
