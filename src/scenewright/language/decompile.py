"""From a program to its story, for every program in the constructs that a story has.

What enters: a `Program`. What leaves: an arranged `Story` that compiles to a program of the same meaning (knots are
named and comparisons written the compiler's way), or a `TranslationError` that names what a story cannot tell yet.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal

from scenewright.errors import ProgramError, TranslationError
from scenewright.language import story as st
from scenewright.language.compile import COMPASS, PIECES, TURNS, UNNAMED, amounts_of, kind_of
from scenewright.program import expressions as ex
from scenewright.program import types as pt
from scenewright.program.linear import Atom, Linear, linear
from scenewright.program.printer import print_expression
from scenewright.program.resolve import usual_partner
from scenewright.program.structure import knots_of, synchronised
from scenewright.program.types import EGO
from scenewright.units import SI_SYMBOL, UNITS, Dimension, format_fraction, unit_of_name

_VERBS = {piece: verb for verb, piece in PIECES.items()}
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
Key = tuple[int, str]


def decompile(program: pt.Program) -> st.Story:
    """Return the story that `program` tells.

    Raises
    ------
    TranslationError
        For what a story cannot tell yet, with the constraint that says it.
    """
    try:
        return _Decompiler(program).story()
    except ProgramError as error:  # of a term that is no sum
        raise TranslationError(f"{error.message}, and cannot be told in words yet", found=error.found) from None


def way_of(route: pt.RouteSpec) -> st.Way:
    """Return the facts of a way that make `route`."""
    match route:
        case pt.LanesRoute(lanes=lanes):
            return st.Way(lanes=lanes)
        case pt.HeadingsRoute(headings=(heading,)):
            return st.Way(heading=heading, turn="straight")
        case pt.HeadingsRoute(headings=(first, second) as headings):
            turned = (COMPASS.index(second) - COMPASS.index(first)) % 4
            turn = next((name for name, quarters in TURNS.items() if quarters == turned and quarters), None)
            return st.Way(heading=first, turn=turn) if turn else st.Way(headings=headings)
        case pt.HeadingsRoute(headings=headings):
            return st.Way(headings=headings)
        case pt.IntentRoute():
            return st.Way(route.origin, route.origin_heading, route.turn, route.destination, route.destination_heading)


@dataclass(slots=True)
class _Decompiler:
    program: pt.Program
    moment_of: dict[Key, int] = field(default_factory=dict)
    conditions: list[list[st.Condition]] = field(default_factory=list)
    times: dict[int, st.Amount] = field(default_factory=dict)
    throughout: dict[tuple[int, int], list[st.Measure]] = field(default_factory=dict)  # by actor and piece
    orders: list[st.Order] = field(default_factory=list)
    holds: list[st.Hold] = field(default_factory=list)

    def story(self) -> st.Story:
        program = self.program
        formulas = [part for constraint in program.constraints for part in _parts(constraint.formula)]
        self._name_moments(formulas)
        for formula in formulas:
            if isinstance(formula, ex.Compare):
                self._fix_time(formula)
        for formula in formulas:
            self._take(formula)
        if set(program.ego.sketch.pieces) != {pt.PieceKind.GO}:
            raise _untold("a deed of the ego", "let its pieces be 'go': the policy under test drives it")
        ego = [self.moment_of[EGO, knot] for knot in program.ego.sketch.knots[1:] if (EGO, knot) in self.moment_of]
        if [actor.id for actor in program.actors] != [*range(len(program.actors))]:
            raise _untold("actors that are not numbered one after the other", "number them 0, 1, 2")
        story = st.Story(
            tuple(st.Actor(each.id, "ego" if each.is_ego else each.name, way_of(each.route), kind_of(each.name))
                  for each in program.actors),
            tuple(st.Moment(tuple(dict.fromkeys(own)), self.times.get(number))
                  for number, own in enumerate(self.conditions)),
            tuple(ego),
            tuple(self._deeds()),
            tuple(dict.fromkeys(self.orders)),
            tuple(dict.fromkeys(self.holds)),
            (),
            program.manner,
            program.map_name,
            None if program.name in UNNAMED else program.name,
        )  # fmt: skip
        used = {amount.name for amount in amounts_of(story)}
        declared = [each for each in program.parameters if each.name not in used or each != pt.Parameter(each.name)]
        return st.arranged(replace(story, parameters=tuple(declared)))

    def _name_moments(self, formulas: list[ex.Formula]) -> None:
        """Give a number to every instant: the start, what the program merges, and every other knot that matters."""
        spoken = {key for formula in formulas for key in knots_of(formula)}
        merged: dict[Key, Key] = {}

        def root(key: Key) -> Key:
            while merged.get(key, key) != key:
                key = merged[key]
            return key

        first = (EGO, self.program.ego.sketch.knots[0])
        for actor in self.program.actors:
            merged[root((actor.id, actor.sketch.knots[0]))] = first
        for formula in formulas:
            for one, other in synchronised(formula):
                merged[root(one)] = root(other)
        numbers = {root(first): st.START}
        for actor in (*self.program.heroes, self.program.ego):
            own = [root((actor.id, knot)) for knot in actor.sketch.knots]
            if len(set(own)) != len(own):
                raise _untold(f"two knots of {actor.name} at one moment", "leave one of them out")
            for knot in actor.sketch.knots:
                key = (actor.id, knot)
                if actor.is_ego and root(key) not in numbers and key not in spoken:
                    continue  # an end of its sketch of which nothing is asked
                self.moment_of[key] = numbers.setdefault(root(key), len(numbers))
        self.conditions = [[] for _ in numbers]

    def _fix_time(self, compare: ex.Compare) -> None:
        """Take ``A1(t1) == 5 s``."""
        form = self._linear(compare)
        instants = self._instants(form)
        if compare.operator == "==" and _is_of_times(form) and list(instants.values()) == [1]:
            (moment,) = instants
            self.times.setdefault(moment, self._plain(form, "time"))

    def _deeds(self) -> Iterator[st.Deed]:
        for actor in self.program.heroes:
            for index, piece in enumerate(actor.sketch.pieces):
                ends = [self.moment_of[actor.id, knot] for knot in actor.sketch.knots[index : index + 2]]
                held = tuple(dict.fromkeys(self.throughout.get((actor.id, index), ())))
                yield st.Deed(actor.id, _VERBS[piece], ends[0], ends[1], held)

    def _take(self, formula: ex.Formula) -> None:
        if list(synchronised(formula)):
            return
        if isinstance(formula, ex.Temporal):
            self.holds.append(self._hold(formula))
            return
        if isinstance(formula, ex.Compare):
            piece = ex.piece_of(formula)
            if piece is not None:
                self._take_piece(formula, piece)
                return
            if self._take_order(formula):
                return
        moments: set[int] = set()
        condition = self._condition(formula, moments)
        if len(moments) != 1:
            raise _untold("a condition about more than one moment", "ask for each by itself", formula)
        self.conditions[moments.pop()].append(condition)

    def _take_piece(self, compare: ex.Compare, piece: ex.State) -> None:
        assert isinstance(piece.at, ex.PieceRef)
        sketch = self.program.actor(piece.actor).sketch
        index = sketch.piece_index(piece.at.name)
        bare = ex.with_state(compare, piece, replace(piece, at=None))
        measure = self._measure(bare, set())
        if piece.actor == EGO or measure is None or measure.other is not None:
            raise _untold("this condition on a piece", "ask for it from one moment until another", compare)
        standstill = st.Measure(piece.actor, st.Quantity.SPEED, "==", st.Amount(Fraction(0), "m/s"))
        if sketch.pieces[index] is not pt.PieceKind.STOP or measure != standstill:
            self.throughout.setdefault((piece.actor, index), []).append(measure)

    def _take_order(self, compare: ex.Compare) -> bool:
        form = self._linear(compare)
        if not _is_of_times(form):
            return False
        instants, op = self._instants(form), compare.operator
        negative, amount = self._right(form, "time")
        if op == "==" and list(instants.values()) == [1] and self.times.get(*instants) == amount:
            return True
        first = next((moment for moment, factor in instants.items() if factor == -1), st.START)
        second = next((moment for moment, factor in instants.items() if factor == 1), st.START)
        if sorted(instants.values()) not in ([-1], [1], [-1, 1]):
            raise _untold("a sum of times", "ask for the time from one moment to another", compare)
        margin = None if amount.value == 0 else amount
        if negative or (margin is None and op in ("<", "<=")):
            first, second, op = second, first, st.FLIPPED[op]
        self.orders.append(st.Order(first, second, op, margin))
        return True

    def _hold(self, temporal: ex.Temporal) -> st.Hold:
        how: st.How = "at some time" if temporal.operator == "eventually" else temporal.operator
        inside: set[int] = set()
        condition = self._condition(temporal.body, inside)
        if inside:
            raise _untold("a moment inside an interval", "ask for it apart from the interval", temporal)
        return st.Hold(how, self._point(temporal.start), self._point(temporal.end), condition)

    def _point(self, term: ex.Term) -> st.Point:
        form = linear(term)
        instants = [(self.moment_of[atom.actor, atom.knot], factor)
                    for atom, factor in form.atoms.items() if isinstance(atom, ex.Elapsed)]  # fmt: skip
        if len(instants) > 1 or any(factor != 1 for _, factor in instants):
            raise _untold("the end of an interval", "let it begin and end some time after a moment", term)
        earlier, offset = self._right(form.scaled(Fraction(-1)), "time")
        moment = instants[0][0] if instants else st.START
        return st.Point(moment) if offset.value == 0 else st.Point(moment, offset, earlier)

    # -- conditions ---------------------------------------------------------------------------------------------------
    def _condition(self, formula: ex.Formula, moments: set[int]) -> st.Condition:
        match formula:
            case ex.Compare():
                measure = self._measure(formula, moments)
                if measure is None:
                    raise _untold("this comparison", "compare a place, a speed or a gap with an amount", formula)
                return measure
            case ex.Logic(operator=operator, operands=operands):
                parts = tuple(self._condition(operand, moments) for operand in operands)
                joint: Literal["and", "or", "not", "if"] = "if" if operator == "implies" else operator
                return st.Compound(joint, parts)
            case ex.Temporal():
                raise _untold("an interval inside another condition", "ask for it by itself", formula)

    def _measure(self, compare: ex.Compare, moments: set[int]) -> st.Measure | None:
        """Return the one measure that a comparison is, or None; adds the moment that it is about."""
        form = self._linear(compare)
        states, landmarks = form.of(ex.State, ex.Derived), form.of(ex.Landmark)
        moments_at = [atom.at for atom in states if isinstance(atom, ex.State | ex.Derived)]
        found = {self._moment(atom.actor, atom.at) for atom in states
                 if isinstance(atom, ex.State | ex.Derived) and atom.at is not None}  # fmt: skip
        if form.of(ex.Elapsed) or len(found) > 1 or not states or len({at is None for at in moments_at}) > 1:
            return None
        moments |= found
        if len(states) > 1:
            return None if landmarks else self._of_two(states, compare.operator, form)
        ((state, factor),) = states.items()
        assert isinstance(state, ex.State | ex.Derived)
        form, op = form.scaled(1 / factor), compare.operator if factor > 0 else st.FLIPPED[compare.operator]
        return self._of_one(state, op, form, form.of(ex.Landmark))

    def _of_one(
        self, state: ex.State | ex.Derived, op: st.Operator, form: Linear, landmarks: Mapping[Atom, Fraction]
    ) -> st.Measure | None:
        actor = state.actor
        if isinstance(state, ex.State) and state.order == 0:
            (place, factor), *more = landmarks.items() or [(None, Fraction(0))]
            if more or factor != -1 or not isinstance(place, ex.Landmark):
                return None
            before, amount = self._right(form, "length")
            if amount.value == 0:
                return st.Measure(actor, st.Quantity.PLACE, op, None, self._place(place, actor))
            op = st.FLIPPED[op] if before else op
            return st.Measure(actor, st.Quantity.PLACE, op, amount, self._place(place, actor), opposite=not before)
        if landmarks:
            return None
        if isinstance(state, ex.State):
            quantity = st.Quantity.SPEED if state.order == 1 else st.Quantity.RATE
            slowing, amount = self._right(form, _DIMENSIONS[quantity])
            if quantity is st.Quantity.RATE and slowing:
                return st.Measure(actor, quantity, st.FLIPPED[op], amount, opposite=True)
            return st.Measure(actor, quantity, op, self._plain(form, _DIMENSIONS[quantity]))
        quantity = _QUANTITIES[state.kind]
        if isinstance(state.target, int):
            return self._to(actor, quantity, op, state.target, form)
        return st.Measure(actor, quantity, op, self._plain(form, "time"), self._place(state.target, actor))

    def _to(self, actor: int, quantity: st.Quantity, op: st.Operator, other: int, form: Linear) -> st.Measure:
        negative, amount = self._right(form, _DIMENSIONS[quantity])
        if quantity is st.Quantity.GAP and negative:
            return st.Measure(other, quantity, st.FLIPPED[op], amount, other=actor)
        return st.Measure(actor, quantity, op, self._plain(form, _DIMENSIONS[quantity]), other=other)

    def _of_two(self, states: Mapping[Atom, Fraction], op: st.Operator, form: Linear) -> st.Measure | None:
        if len(states) != 2:
            return None
        (one, factor), (other, against) = states.items()
        if not isinstance(one, ex.State) or not isinstance(other, ex.State) or factor != -against:
            return None
        if one.order != other.order or one.actor == other.actor or one.order == 2:
            return None
        form, op = form.scaled(1 / factor), op if factor > 0 else st.FLIPPED[op]
        if one.order == 0:  # `one` is ahead
            return self._to(other.actor, st.Quantity.GAP, op, one.actor, form)
        slower, amount = self._right(form, "speed")
        op = st.FLIPPED[op] if slower else op
        faster_by = None if amount.value == 0 else amount
        return st.Measure(one.actor, st.Quantity.SPEED, op, faster_by, other=other.actor, opposite=slower)

    def _place(self, landmark: ex.Landmark, actor: int) -> st.Place:
        owner = landmark.actor if landmark.actor is not None else actor
        usual = landmark.other in (None, usual_partner(self.program, owner))
        return st.Place(landmark.name, None if owner == actor else owner, None if usual else landmark.other)

    # -- moments and amounts ------------------------------------------------------------------------------------------
    def _moment(self, actor: int, at: ex.At) -> int:
        match at:
            case ex.Knot(name=name):
                return self.moment_of[actor, name]
            case ex.Elapsed(actor=owner, knot=knot):
                return self.moment_of[owner, knot]
            case ex.Number(value=value):
                time = st.Amount(value, "s")
                known = next((number for number, own in self.times.items() if own == time), len(self.conditions))
                if known == len(self.conditions):
                    self.conditions.append([])
                    self.times[known] = time
                return known
            case _:
                raise _untold("this moment", "name a knot or a time")

    def _instants(self, form: Linear) -> dict[int, Fraction]:
        found: dict[int, Fraction] = {}
        for atom, factor in form.atoms.items():
            if isinstance(atom, ex.Elapsed):
                moment = self.moment_of[atom.actor, atom.knot]
                if moment != st.START:
                    found[moment] = found.get(moment, Fraction(0)) + factor
        return found

    def _linear(self, compare: ex.Compare) -> Linear:
        return linear(compare.left).minus(linear(compare.right))

    def _right(self, form: Linear, dimension: Dimension) -> tuple[bool, st.Amount]:
        """Return what stands on the other side of a comparison: whether below zero, and one number or one parameter."""
        parameters = form.of(ex.ParameterRef)
        if not parameters:
            return form.constant > 0, _in_a_unit(abs(form.constant), dimension)
        (reference, factor), *more = parameters.items()
        assert isinstance(reference, ex.ParameterRef)
        unit = unit_of_name(reference.name)
        if more or form.constant or abs(factor) != 1 or unit is None:
            raise _untold("a sum of amounts", "give the sum a parameter of its own")
        return factor > 0, st.Amount(None, unit.symbol, reference.name)

    def _plain(self, form: Linear, dimension: Dimension) -> st.Amount:
        """Return the same where only a number may be below zero."""
        negative, amount = self._right(form, dimension)
        if negative and amount.value is None:
            raise _untold(f"the negative of {amount.name}", "turn its sign where it gets its value")
        return replace(amount, value=-amount.value) if negative and amount.value is not None else amount


def _in_a_unit(value: Fraction, dimension: Dimension) -> st.Amount:
    """Return an amount in SI units, or in the first others in which it is a decimal: 50 km/h, not 125/9 m/s."""
    units = [SI_SYMBOL[dimension], *(symbol for symbol, unit in UNITS.items() if unit.dimension == dimension)]
    found = next((each for each in units if "/" not in format_fraction(value / UNITS[each].si_factor)), units[0])
    return st.Amount(value / UNITS[found].si_factor, found)


def _is_of_times(form: Linear) -> bool:
    return bool(form.of(ex.Elapsed)) and len(form.atoms) == len(form.of(ex.Elapsed, ex.ParameterRef))


def _parts(formula: ex.Formula) -> Iterator[ex.Formula]:
    """Yield what a constraint asks for side by side; a contrary of an interval is the interval of the contrary."""
    if isinstance(formula, ex.Logic) and formula.operator == "and":
        for operand in formula.operands:
            yield from _parts(operand)
    elif isinstance(formula, ex.Logic) and formula.operator == "not" and isinstance(formula.operands[0], ex.Temporal):
        inner = formula.operands[0]
        if inner.operator == "always":
            yield replace(inner, operator="eventually", body=ex.Logic("not", (inner.body,)))
        else:
            yield replace(inner, operator="never" if inner.operator == "eventually" else "eventually")
    else:
        yield formula


def _untold(what: str, fix: str, node: ex.Node | None = None) -> TranslationError:
    found = None if node is None else print_expression(node)
    return TranslationError(f"{what} cannot be told in words yet", found=found, fix=fix)
