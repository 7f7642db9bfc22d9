"""Checks that a program makes sense by itself: names, knots, pieces, units, and comparisons of like with like.

What enters: a `Program` and the text it was read from, if any. What leaves: nothing, or a `ProgramError` that points at
the fault. What depends on a map (routes, which landmarks there are) is checked when the program is grounded.
"""

from __future__ import annotations

from dataclasses import replace
from difflib import get_close_matches
from fractions import Fraction

from scenewright.errors import Place, ProgramError, Span
from scenewright.program import expressions as ex
from scenewright.program.evaluate import landmark_owner
from scenewright.program.limits import check_depth, check_size
from scenewright.program.magnitudes import NoNumberError, Values, check_numbers, magnitude
from scenewright.program.printer import print_expression
from scenewright.program.types import EGO, Actor, Constraint, PieceKind, Program
from scenewright.units import UNIT_SUFFIXES, format_fraction, is_size_of_a_scenario, size_of_a_scenario, unit_of_name

# A dimension as exponents of metre and second; None is a bare number, which goes with anything.
Powers = tuple[int, int] | None
_LENGTH, _TIME, _SPEED, _ACCELERATION = (1, 0), (0, 1), (1, -1), (1, -2)
_OF_ORDER = (_LENGTH, _SPEED, _ACCELERATION)
_OF_DIMENSION = {"length": _LENGTH, "time": _TIME, "speed": _SPEED, "acceleration": _ACCELERATION}
_OF_DERIVED = {"gap": _LENGTH, "freespace": _LENGTH, "tta": _TIME, "ttc": _TIME, "headway": _TIME}
_EXAMPLE_S = ex.Number(Fraction("3.4"))
# What a piece is, the sign of its rate, and how a bound on that reads which leaves but weaker ones.
_PULLS = {PieceKind.DEC: ("braking", -1, ">"), PieceKind.ACC: ("speeding up", 1, "<")}
_NAMES = {
    _LENGTH: "a length (m)",
    _TIME: "a time (s)",
    _SPEED: "a speed (m/s)",
    _ACCELERATION: "an acceleration (m/s^2)",
    (0, 0): "a bare number",
}


def check_program(program: Program, text: str | None = None, name: str = "program", *, nested: bool = False) -> None:
    """Raise `ProgramError` at the first fault of `program`; `text` is what spans point into.

    One temporal operator inside another is a fault unless `nested`: of a run that was driven a judge tells that it
    cannot look at that, and all the rest.
    """
    _Checker(program, text, name, nested).check()


def check_constraint(program: Program, constraint: Constraint, text: str | None = None, name: str = "program") -> None:
    """Raise `ProgramError` at the first fault of one constraint, which need not be among those of `program`."""
    _Checker(program, text, name).check_constraint(constraint)


def check_values(program: Program, values: Values, text: str | None = None, name: str = "program") -> None:
    """Raise `ProgramError` where a constraint is no number with these `values` (SI) of parameters, as `x_m / 0` is."""
    checker = _Checker(program, text, name)
    for constraint in program.constraints:
        checker.check_numbers(constraint, values)


class _Checker:
    def __init__(self, program: Program, text: str | None, name: str, nested: bool = False) -> None:
        self.program = program
        self.nested = nested
        self.text = text
        self.name = name
        self.actors = {actor.id: actor for actor in program.actors}
        self.parameters = {parameter.name: parameter for parameter in program.parameters}

    def check(self) -> None:
        check_size(self.program, self.name)
        self._check_actors()
        self._check_parameters()
        self.program.manner.check(Place(self.name))
        seen: set[str] = set()
        for constraint in self.program.constraints:
            if constraint.id in seen:
                raise self._error(f"two constraints are called {constraint.id}", constraint.span, fix="rename one")
            seen.add(constraint.id)
            self._check_source(constraint)
            self.check_constraint(constraint)

    def _check_source(self, constraint: Constraint) -> None:
        source, words = constraint.source, self.program.description
        if source is not None and words is not None and not 0 <= source.start < source.end <= len(words):
            raise self._error(
                f"the words of {constraint.id} are not in the description",
                constraint.span,
                found=f"@{source.start}..{source.end}",
                expected=f"a stretch of its {len(words)} characters, such as @0..{len(words)}",
            )

    def _error(
        self,
        message: str,
        span: Span | None,
        found: str | None = None,
        expected: str | None = None,
        fix: str | None = None,
    ) -> ProgramError:
        return ProgramError(message, place=Place(self.name, self.text, span), found=found, expected=expected, fix=fix)

    def _check_actors(self) -> None:
        if len(self.actors) != len(self.program.actors):
            raise self._error(
                "two actors have the same number", self.program.actors[-1].span, fix="number them 0, 1, 2"
            )
        if EGO not in self.actors:
            raise self._error("there is no ego", None, expected="an 'Actor 0', the vehicle under test")
        if len(self.actors) < 2:
            raise self._error("there is nobody but the ego", None, expected="an 'Actor 1' that interacts with it")
        ego = self.actors[EGO]
        if any(piece is not PieceKind.GO for piece in ego.sketch.pieces):
            raise self._error(
                f"{ego.name} (A{EGO}) is told what to do, and nobody controls it",
                ego.span,
                found=", ".join(ego.sketch.pieces),
                expected="go for each of its pieces: the policy under test drives it",
                fix=f"ask for it in a constraint, such as A{EGO}a({ego.sketch.knots[0]}) <= -2",
            )
        names = [actor.name for actor in self.program.actors]
        for number, actor in enumerate(self.program.actors):
            if actor.name in names[:number]:
                raise self._error(f"two actors are called {actor.name}", actor.span, fix="give them different names")
            for knot in actor.sketch.knots:
                if knot.rstrip("0123456789") in set(PieceKind):
                    raise self._error(
                        f"a knot of {actor.name} (A{actor.id}) is called like a piece",
                        actor.span,
                        found=knot,
                        expected="knots and pieces in turn, such as [t0, go, t1, dec, t2]",
                    )

    def _check_parameters(self) -> None:
        names = [parameter.name for parameter in self.program.parameters]
        for number, parameter in enumerate(self.program.parameters):
            if parameter.name in names[:number]:
                raise self._error(f"parameter {parameter.name} is declared twice", parameter.span, fix="remove one")
            if unit_of_name(parameter.name) is None:
                raise self._error(
                    f"parameter {parameter.name} has no unit",
                    parameter.span,
                    found=parameter.name,
                    expected=f"a name that ends in {UNIT_SUFFIXES}",
                )
            low, high = parameter.bounds()
            for value in (parameter.value, low, high):
                if value is not None and not is_size_of_a_scenario(value * parameter.unit.si_factor):
                    raise self._error(
                        f"no scenario has a number of the size of {parameter.name}",
                        parameter.span,
                        expected=size_of_a_scenario(),
                    )
            if low > high:
                raise self._error(f"the range of {parameter.name} is empty", parameter.span, found=f"[{low}, {high}]")
            if parameter.value is not None and not low <= parameter.value <= high:
                raise self._error(
                    f"parameter {parameter.name} is out of range",
                    parameter.span,
                    found=f"{float(parameter.value):g} {parameter.unit.symbol}",
                    expected=f"{float(low):g} to {float(high):g} {parameter.unit.symbol}",
                )

    def check_constraint(self, constraint: Constraint) -> None:
        formula = constraint.formula
        check_depth(formula, Place(self.name, self.text, constraint.span))
        for node in ex.walk(formula):
            match node:
                case ex.State(actor=actor, at=at) | ex.Derived(actor=actor, at=at):
                    self._check_moment(self._actor(actor, node.span), at, node.span)
                    if isinstance(node, ex.Derived):
                        self._check_target(node)
                case ex.Elapsed(actor=actor, knot=knot):
                    self._check_knot(self._actor(actor, node.span), knot, node.span)
                case ex.ParameterRef(name=name) if name not in self.parameters:
                    raise self._error(f"parameter {name} is not declared", node.span)
                case ex.Landmark(name=name) if name not in ex.LANDMARKS:
                    raise self._error(
                        f"'{name}' is not a landmark", node.span, found=name, expected=", ".join(ex.LANDMARKS)
                    )
                case ex.Landmark(name=name, actor=actor, other=other):
                    for named in (actor, other):
                        if named is not None:
                            self._actor(named, node.span)
                    if other is not None and (other == actor or name not in ex.CONFLICT_LANDMARKS):
                        raise self._error(
                            f"{name} is shared with nobody" if other != actor else f"{name} of an actor with itself",
                            node.span,
                            found=print_expression(node),
                            expected=f"another actor's, or the place alone: A{actor}.{name}",
                        )
                case _:
                    pass
        self._check_formula(formula, inside_temporal=False)
        self.check_numbers(constraint, {})

    def check_numbers(self, constraint: Constraint, values: Values) -> None:
        try:
            check_numbers(constraint.formula, values)
            self._check_rates(constraint.formula, values)
        except NoNumberError as fault:
            raise self._error(
                fault.message, fault.term.span or constraint.span, found=fault.found, expected=fault.expected
            ) from None

    def _check_rates(self, formula: ex.Formula, values: Values) -> None:
        """Refuse a braking, or a speeding up, with the other one's sign, or so weak that the manner calls it none."""
        if isinstance(formula, ex.Logic) and formula.operator == "and":
            for operand in formula.operands:
                self._check_rates(operand, values)
        state = ex.piece_of(formula)
        if state is None or state.order != 2 or not isinstance(formula, ex.Compare):
            return
        assert isinstance(state.at, ex.PieceRef)
        sketch, faint = self._actor(state.actor, state.span).sketch, self.program.manner.faint_mpss
        what, sign, leaves_weak = _PULLS.get(sketch.pieces[sketch.piece_index(state.at.name)], ("", 1, ""))
        operator: str = formula.operator
        other = formula.right
        if formula.right == state:
            operator, other = ex.FLIPPED[formula.operator], formula.left
        elif formula.left != state:
            return
        rate = magnitude(other, values).constant
        if rate is not None and sign * rate < faint and what and operator in ("==", leaves_weak, f"{leaves_weak}="):
            least = f"{format_fraction(sign * faint)} m/s^2 or {'more' if sign > 0 else 'less'}"
            fix = "give the rate that is meant, or let it go on there: a piece 'go'"
            raise self._error(
                f"a rate of {format_fraction(rate)} m/s^2 is no {what}",
                formula.span,
                found=print_expression(formula),
                expected=f"{least}, by faint_mpss of the manner",
                fix=fix if abs(rate) < faint else f"give it its sign: {format_fraction(-rate)}",
            )

    def _actor(self, actor_id: int, span: Span | None) -> Actor:
        if actor_id not in self.actors:
            there_are = ", ".join(f"A{i} ({actor.name})" for i, actor in sorted(self.actors.items()))
            raise self._error(f"there is no actor {actor_id}", span, found=f"A{actor_id}", expected=there_are)
        return self.actors[actor_id]

    def _check_target(self, derived: ex.Derived) -> None:
        to_actor = isinstance(derived.target, int)
        if isinstance(derived.target, int):
            self._actor(derived.target, derived.span)
        if to_actor == (derived.kind == "tta"):
            raise self._error(
                f"{derived.kind} is measured to {'a place' if to_actor else 'another actor'}",
                derived.span,
                found=print_expression(derived),
                expected=f"tta(A{derived.actor}, stop_line, t1)" if to_actor else f"{derived.kind}(A0, A1, t1)",
            )
        if derived.target == derived.actor:
            raise self._error(f"{derived.kind} of an actor to itself", derived.span, expected="two different actors")

    def _check_knot(self, actor: Actor, knot: str, span: Span | None) -> None:
        if knot not in actor.sketch.knots:
            near = get_close_matches(knot, actor.sketch.knots, n=1)
            raise self._error(
                f"{actor.name} (A{actor.id}) has no knot {knot}",
                span,
                found=knot,
                expected=", ".join(actor.sketch.knots),
                fix=f"did you mean {near[0]}?" if near else f"add {knot} to the sketch of A{actor.id}",
            )

    def _check_moment(self, actor: Actor, at: ex.At, span: Span | None) -> None:
        if isinstance(at, ex.Knot):
            self._check_knot(actor, at.name, span)
        elif isinstance(at, ex.PieceRef):
            try:
                actor.sketch.piece_index(at.name)
            except KeyError:
                raise self._error(
                    f"{actor.name} (A{actor.id}) has no piece {at.name}",
                    span,
                    found=at.name,
                    expected=", ".join(actor.sketch.piece_names()),
                ) from None

    def _check_formula(self, formula: ex.Formula, inside_temporal: bool) -> None:
        match formula:
            case ex.Compare(left=left, right=right):
                self._check_comparison(formula, left, right)
                if not inside_temporal:
                    self._check_has_moments(formula)
            case ex.Logic(operands=operands):
                for operand in operands:
                    self._check_formula(operand, inside_temporal)
            case ex.Temporal() if inside_temporal and not self.nested:
                raise self._error(
                    "one temporal operator stands inside another",
                    formula.span,
                    found=print_expression(formula),
                    expected="always, never or eventually side by side: each has an interval of its own",
                    fix="join them with 'and', or write two constraints",
                )
            case ex.Temporal(start=start, end=end, body=body):
                for bound in (start, end):
                    self._expect(bound, _TIME, self._powers(bound), formula.span)
                    self._check_has_moments(bound)
                self._check_formula(body, inside_temporal=True)

    def _check_has_moments(self, expression: ex.Node) -> None:
        for node in ex.walk(expression):
            if isinstance(node, ex.State | ex.Derived) and node.at is None:
                example = print_expression(replace(node, at=ex.Knot("t1")))
                raise self._error(
                    f"{print_expression(node)} has no moment",
                    node.span,
                    expected=f"a knot or a time, such as {example} or {print_expression(replace(node, at=_EXAMPLE_S))}",
                )

    def _check_comparison(self, compare: ex.Compare, left: ex.Term, right: ex.Term) -> None:
        left_powers, right_powers = self._powers(left), self._powers(right)
        if left_powers is not None and right_powers is not None and left_powers != right_powers:
            raise self._error(
                "two different things are compared",
                compare.span,
                found=f"{print_expression(left)} is {_name(left_powers)}, "
                f"{print_expression(right)} is {_name(right_powers)}",
                expected="the same kind of quantity on both sides",
            )
        bare = [n for n in ex.walk(compare) if isinstance(n, ex.Landmark) and n.actor is None]
        derived = {id(n.target) for n in ex.walk(compare) if isinstance(n, ex.Derived)}
        loose = [n for n in bare if id(n) not in derived]
        if loose and landmark_owner(compare) is None:
            raise self._error(
                f"on whose route is {loose[0].name}?",
                loose[0].span or compare.span,
                found=print_expression(compare),
                expected=f"the position of one actor, or a name with its actor such as A1.{loose[0].name}",
            )

    def _expect(self, term: ex.Term, wanted: Powers, found: Powers, span: Span | None) -> None:
        if found is not None and found != wanted:
            raise self._error(f"{print_expression(term)} is {_name(found)}", term.span or span, expected=_name(wanted))

    def _powers(self, term: ex.Term) -> Powers:
        match term:
            case ex.Number(dimension=dimension):
                return _OF_DIMENSION[dimension] if dimension else None
            case ex.ParameterRef(name=name):
                unit = unit_of_name(name)
                return _OF_DIMENSION[unit.dimension] if unit else None
            case ex.Landmark():
                return _LENGTH
            case ex.Elapsed():
                return _TIME
            case ex.State(order=order):
                return _OF_ORDER[order]
            case ex.Derived(kind=kind):
                return _OF_DERIVED[kind]
            case ex.Negate(operand=operand):
                return self._powers(operand)
            case ex.Arithmetic(operator=operator, left=left, right=right):
                return self._combined(term, operator, self._powers(left), self._powers(right))
            case _:
                return None

    def _combined(self, term: ex.Arithmetic, operator: str, left: Powers, right: Powers) -> Powers:
        if operator in "+-":
            if left is not None and right is not None and left != right:
                raise self._error(
                    f"{print_expression(term)} adds different things",
                    term.span,
                    found=f"{_name(left)} and {_name(right)}",
                    expected="the same kind of quantity on both sides",
                )
            return left if left is not None else right
        if left is None and right is None:
            return None
        a, b = left or (0, 0), right or (0, 0)
        sign = 1 if operator == "*" else -1
        return a[0] + sign * b[0], a[1] + sign * b[1]


def _name(powers: Powers) -> str:
    return "a bare number" if powers is None else _NAMES.get(powers, f"m^{powers[0]} s^{powers[1]}")
