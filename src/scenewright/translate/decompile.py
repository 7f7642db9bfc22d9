"""From a program to its story, for every program in the constructs that a story has.

What enters: a `Program`. What leaves: an arranged `Story` that compiles to a program of the same meaning (knots are
named and comparisons written the compiler's way), or a `TranslationError` that names what a story cannot tell yet.
What a program says of where it came from in a text becomes the story's quotes, and an amount stands in the unit in
which it was most likely written.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal

from scenewright.errors import ProgramError, TranslationError
from scenewright.program import expressions as ex
from scenewright.program import types as pt
from scenewright.program.linear import Atom, Linear, linear
from scenewright.program.resolve import usual_partner
from scenewright.program.structure import knots_of, read_structure, synchronised
from scenewright.translate import story as st
from scenewright.translate.compile import DERIVED, DRIVEN, PIECES, TURNS, UNNAMED, counted_down, route_of
from scenewright.translate.phrases import untold
from scenewright.units import SI_SYMBOL, UNITS, Dimension, format_fraction, unit_of_name

_VERBS = {piece: verb for verb, piece in PIECES.items()}
_QUANTITIES = {kind: quantity for quantity, kind in DERIVED.items()}
_DIMENSIONS: dict[st.Quantity, Dimension] = {
    st.Quantity.PLACE: "length",
    st.Quantity.GAP: "length",
    st.Quantity.FREE_SPACE: "length",
    st.Quantity.SPEED: "speed",
    st.Quantity.RATE: "acceleration",
}  # the others are times
_DECIMALS = 2  # of a number in SI units that nobody would rather write in another unit
Key = tuple[int, str]
Became = st.Measure | st.Compound | st.Order | st.Hold | None  # what a constraint is; None: it makes moments one
Taken = tuple[int | None, Became]  # and at which moment, where it is about one


def decompile(program: pt.Program) -> st.Story:
    """Return the story that `program` tells; raises `TranslationError` for what a story cannot tell yet."""
    return st.arranged(decompiled(program).story)


def decompiled(program: pt.Program, leniently: bool = False) -> Decompiled:
    """Return the same with what became of each constraint; `leniently` without those that a story cannot tell yet."""
    try:
        return Decompiled(program, leniently)
    except ProgramError as error:  # of a term that is no sum
        raise TranslationError(f"{error.message}, and cannot be told in words yet", found=error.found) from None


def way_of(route: pt.RouteSpec) -> st.Way:
    """Return the facts of a way that make `route`."""
    match route:
        case pt.LanesRoute(lanes=lanes):
            return st.Way(lanes=lanes)
        case pt.HeadingsRoute(headings=headings):
            short = (st.Way(heading=headings[0], turn=turn) for turn in TURNS)
            return next((each for each in short if route_of(each) == route), st.Way(headings=headings))
        case pt.IntentRoute():
            return st.Way(route.origin, route.origin_heading, route.turn, route.destination, route.destination_heading)


@dataclass(slots=True)
class Decompiled:
    """The story of a program as its moments come, and what became of each constraint."""

    program: pt.Program
    leniently: bool = False
    story: st.Story = field(init=False)
    taken: dict[ex.Formula, tuple[Taken, ...]] = field(default_factory=dict)  # of formulas that stand side by side
    moment_of: dict[Key, int] = field(default_factory=dict)  # of the knots that matter
    untold: list[pt.Constraint] = field(default_factory=list)  # which the story is without
    _conditions: list[list[st.Condition]] = field(default_factory=list)
    _times: dict[int, st.Amount] = field(default_factory=dict)
    _throughout: dict[tuple[int, int], list[st.Measure]] = field(default_factory=dict)  # by actor and piece
    _quote: st.Quote | None = None  # of the constraint that is being taken

    def __post_init__(self) -> None:
        parts = {each.id: list(parts_of(each.formula)) for each in self.program.constraints}
        formulas = [formula for own in parts.values() for formula in own]
        self._name_moments(formulas)
        for formula in formulas:
            with suppress(TranslationError, ProgramError):  # raised when it is taken
                self._fix_time(formula)
        for constraint in self.program.constraints:
            source, words = constraint.source, self.program.words_of(constraint)
            self._quote = None if source is None or words is None else st.Quote(source.start, source.end, words)
            try:
                for formula in parts[constraint.id]:
                    self.taken[formula] = tuple(self._take(formula))
            except (TranslationError, ProgramError, LookupError):  # of a piece that there is not
                if not self.leniently:
                    raise
                self.untold.append(constraint)
        self.story = self._story()

    def _story(self) -> st.Story:
        program = self.program
        if set(program.ego.sketch.pieces) != {pt.PieceKind.GO}:
            raise untold("a deed of the ego", "let its pieces be 'go': the policy under test drives it")
        if [actor.id for actor in program.actors] != [*range(len(program.actors))]:
            raise untold("actors that are not numbered one after the other", "number them 0, 1, 2")
        taken = dict.fromkeys(each for own in self.taken.values() for _, each in own)
        fixed = {st.Order(st.START, moment, "==", time) for moment, time in self._times.items()}  # told as times
        story = st.Story(
            tuple(st.Actor(each.id, "ego" if each.is_ego else each.name, way_of(each.route),
                           each.name if each.name in DRIVEN else "car") for each in program.actors),
            tuple(st.Moment(tuple(dict.fromkeys(own)), self._times.get(number))
                  for number, own in enumerate(self._conditions)),
            tuple(moment for (actor, _), moment in self.moment_of.items() if actor == pt.EGO and moment != st.START),
            tuple(self._deeds()),
            tuple(each for each in taken if isinstance(each, st.Order) and each not in fixed),
            tuple(each for each in taken if isinstance(each, st.Hold)),
            (),
            program.manner,
            program.map_name,
            None if program.name in UNNAMED else program.name,
        )  # fmt: skip
        used = {amount.name for amount in st.within(story, st.Amount)}
        declared = (each for each in program.parameters if each.name not in used or each != pt.Parameter(each.name))
        return replace(story, parameters=tuple(declared))

    def _name_moments(self, formulas: list[ex.Formula]) -> None:
        """Give a number to every instant: the start, what the program merges, and every other knot that matters."""
        spoken = {key for formula in formulas for key in knots_of(formula)}
        structure = read_structure(self.program)
        starts = frozenset(structure.starts.items())
        merged = [group for group in structure.instants if not group & starts]
        start = starts.union(*(group for group in structure.instants if group & starts))
        instant_of = {key: group for group in (start, *merged) for key in group}
        numbers = {start: st.START}
        for actor in (*self.program.heroes, self.program.ego):
            keys = [(actor.id, knot) for knot in actor.sketch.knots]
            own = {key: instant_of.get(key, frozenset({key})) for key in keys}
            if len(set(own.values())) != len(own):
                raise untold(f"two knots of {actor.name} at one moment", "leave one of them out")
            for key, instant in own.items():
                if not actor.is_ego or instant in numbers or key in spoken:  # else an end that nothing is asked of
                    self.moment_of[key] = numbers.setdefault(instant, len(numbers))
        self._conditions = [[] for _ in numbers]

    def _fix_time(self, formula: ex.Formula) -> None:
        """Take ``A1(t1) == 5 s``."""
        if isinstance(formula, ex.Compare) and formula.operator == "==" and (form := _of_times(formula)) is not None:
            below_zero, amount = right_side(form, "time")
            match list(self._instants(form).items()):
                case [(moment, factor)] if factor == 1 and not below_zero:
                    self._times.setdefault(moment, amount)

    def _deeds(self) -> Iterator[st.Deed]:
        for actor in self.program.heroes:
            moments = [self.moment_of[actor.id, knot] for knot in actor.sketch.knots]
            for index, piece in enumerate(actor.sketch.pieces):
                held = tuple(dict.fromkeys(self._throughout.get((actor.id, index), ())))
                yield st.Deed(actor.id, _VERBS[piece], moments[index], moments[index + 1], held)

    def _take(self, formula: ex.Formula) -> list[Taken]:
        if merged := list(synchronised(formula)):
            return [(self.moment_of[one], None) for one, _ in merged]
        if isinstance(formula, ex.Temporal):
            return [(None, self._hold(formula))]
        if isinstance(formula, ex.Compare):
            if (piece := ex.piece_of(formula)) is not None:
                return [(None, self._held(formula, piece))]
            if (form := _of_times(formula)) is not None:
                return [(None, self._order(formula, form))]
        condition, moments = self._condition(formula), self._moments_in(formula)
        if len(moments) != 1:
            raise untold("a condition about more than one moment", "ask for each by itself", formula)
        (moment,) = moments
        self._conditions[moment].append(condition)
        return [(moment, condition)]

    def _held(self, compare: ex.Compare, piece: ex.State) -> st.Measure:
        assert isinstance(piece.at, ex.PieceRef)
        sketch = self.program.actor(piece.actor).sketch
        index = sketch.piece_index(piece.at.name)
        measure = measure_of(ex.at_each_moment(compare, piece), self.program)
        if piece.actor == pt.EGO or measure is None or measure.other is not None:
            raise untold("this condition on a piece", "ask for it from one moment until another", compare)
        measure = replace(measure, quote=self._quote)
        if sketch.pieces[index] is not pt.PieceKind.STOP or measure != st.standstill(piece.actor):
            self._throughout.setdefault((piece.actor, index), []).append(measure)
        return measure

    def _order(self, compare: ex.Compare, form: Linear) -> st.Order:
        instants, op = self._instants(form), compare.operator
        if sorted(instants.values()) not in ([-1], [1], [-1, 1]):
            raise untold("a sum of times", "ask for the time from one moment to another", compare)
        moments = {factor: moment for moment, factor in instants.items()}
        first, second = moments.get(Fraction(-1), st.START), moments.get(Fraction(1), st.START)
        below_zero, amount = right_side(form, "time")
        margin = None if amount.value == 0 else amount
        if below_zero or (margin is None and op in ("<", "<=")):
            first, second, op = second, first, ex.FLIPPED[op]
        return st.Order(first, second, op, margin, self._quote)

    def _hold(self, temporal: ex.Temporal) -> st.Hold:
        how: st.How = "at some time" if temporal.operator == "eventually" else temporal.operator
        if self._moments_in(temporal.body):
            raise untold("a moment inside an interval", "ask for it apart from the interval", temporal)
        start, end = self._point(temporal.start), self._point(temporal.end)
        return st.Hold(how, start, end, self._condition(temporal.body), self._quote)

    def _point(self, term: ex.Term) -> st.Point:
        form = linear(term)
        instants = [(self.moment_of[atom.actor, atom.knot], factor)
                    for atom, factor in form.atoms.items() if isinstance(atom, ex.Elapsed)]  # fmt: skip
        if len(instants) > 1 or any(factor != 1 for _, factor in instants):
            raise untold("the end of an interval", "let it begin and end some time after a moment", term)
        earlier, offset = right_side(form.scaled(Fraction(-1)), "time")
        moment = instants[0][0] if instants else st.START
        return st.Point(moment) if offset.value == 0 else st.Point(moment, offset, earlier)

    def _condition(self, formula: ex.Formula) -> st.Condition:
        match formula:
            case ex.Compare():
                measure = measure_of(formula, self.program)
                if measure is None:
                    raise untold("this comparison", "compare a place, a speed or a gap with an amount", formula)
                return replace(measure, quote=self._quote)
            case ex.Logic(operator=operator, operands=operands):
                joint: Literal["and", "or", "not", "if"] = "if" if operator == "implies" else operator
                return st.Compound(joint, tuple(self._condition(each) for each in operands), self._quote)
            case ex.Temporal():
                raise untold("an interval inside another condition", "ask for it by itself", formula)

    def _moments_in(self, formula: ex.Formula) -> set[int]:
        states = (node for node in ex.walk(formula) if isinstance(node, ex.State | ex.Derived))
        return {self._moment(state.actor, state.at) for state in states if state.at is not None}

    def _moment(self, actor: int, at: ex.At) -> int:
        match at:
            case ex.Knot(name=name):
                return self.moment_of[actor, name]
            case ex.Elapsed(actor=owner, knot=knot):
                return self.moment_of[owner, knot]
            case ex.Number(value=value):
                time = st.Amount(value, "s")
                if time not in self._times.values():
                    self._times[len(self._conditions)] = time
                    self._conditions.append([])
                return next(number for number, own in self._times.items() if own == time)
            case _:
                raise untold("this moment", "name a knot or a time")

    def _instants(self, form: Linear) -> dict[int, Fraction]:
        found: dict[int, Fraction] = {}
        for atom, factor in form.of(ex.Elapsed).items():
            assert isinstance(atom, ex.Elapsed)
            moment = self.moment_of[atom.actor, atom.knot]
            if moment != st.START:
                found[moment] = found.get(moment, Fraction(0)) + factor
        return found


def _of_times(compare: ex.Compare) -> Linear | None:
    """Return what a comparison of times holds against zero; None for other comparisons."""
    form = linear(compare.left).minus(linear(compare.right))
    only = len(form.atoms) == len(form.of(ex.Elapsed, ex.ParameterRef))
    return form if only and form.of(ex.Elapsed) else None


def parts_of(formula: ex.Formula) -> Iterator[ex.Formula]:
    """Yield what a constraint asks for side by side; a contrary of an interval is the interval of the contrary."""
    if isinstance(formula, ex.Logic) and formula.operator == "and":
        for operand in formula.operands:
            yield from parts_of(operand)
    elif isinstance(formula, ex.Logic) and formula.operator == "not" and isinstance(formula.operands[0], ex.Temporal):
        inner = formula.operands[0]
        if inner.operator == "always":
            yield replace(inner, operator="eventually", body=ex.Logic("not", (inner.body,)))
        else:
            yield replace(inner, operator="never" if inner.operator == "eventually" else "eventually")
    else:
        yield formula


# -- a comparison as the one measure that it is ---------------------------------------------------------------------
def measure_of(compare: ex.Compare, program: pt.Program) -> st.Measure | None:
    """Return the measure that `compare` is, at whatever instant, or None."""
    form = linear(compare.left).minus(linear(compare.right))
    states = [atom for atom in form.atoms if isinstance(atom, ex.State | ex.Derived)]
    if form.of(ex.Elapsed) or not states or len({state.at is None for state in states}) > 1:
        return None
    state, *others = states
    factor = form.atoms[state]
    form, op = form.scaled(1 / factor), compare.operator if factor > 0 else ex.FLIPPED[compare.operator]
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
    op = ex.FLIPPED[measure.op] if down else measure.op
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


def right_side(form: Linear, dimension: Dimension) -> tuple[bool, st.Amount]:
    """Return what stands on the other side of a comparison: whether below zero, and one number or one parameter."""
    parameters = form.of(ex.ParameterRef)
    if not parameters:
        return form.constant > 0, in_a_unit(abs(form.constant), dimension)
    (reference, factor), *more = parameters.items()
    assert isinstance(reference, ex.ParameterRef)
    unit = unit_of_name(reference.name)
    if more or form.constant or abs(factor) != 1 or unit is None:
        raise untold("a sum of amounts", "give the sum a parameter of its own")
    return factor > 0, st.Amount(None, unit.symbol, reference.name)


def in_a_unit(value: Fraction, dimension: Dimension) -> st.Amount:
    """Return an amount as it was most likely written: in SI units, or where it is shortest: 30 mph, not 13.4112 m/s."""
    si = SI_SYMBOL[dimension]
    written = {symbol: format_fraction(value / unit.si_factor) for symbol, unit in UNITS.items()
               if unit.dimension == dimension}  # fmt: skip
    plain = {symbol: number for symbol, number in written.items() if "/" not in number} or written
    is_short = si in plain and len(plain[si].partition(".")[2]) <= _DECIMALS
    found = si if is_short else min(plain, key=lambda symbol: len(plain[symbol]))
    return st.Amount(value / UNITS[found].si_factor, found)
