"""Puts formulas of a program into plain English: who is where, how fast, how far from whom, who comes first.

What enters: formulas. What leaves: clauses without a full stop. A formula that has no plain words keeps its own text in
quotes; nothing is left out and nothing is rounded to another value.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.program.printer import print_expression
from scenewright.program.types import PieceKind, Program
from scenewright.units import SI_SYMBOL, Dimension, format_fraction

_MIRRORED: dict[ex.ComparisonOperator, ex.ComparisonOperator] = {"==": "==", "<": ">", "<=": ">=", ">": "<", ">=": "<="}
_BOUND: dict[ex.ComparisonOperator, str] = {
    "==": "",
    "<=": "at most ",
    ">=": "at least ",
    "<": "less than ",
    ">": "more than ",
}
_PLACES = {
    "stop_line": "{its} stop line",
    "conflict_point": "the conflict point",
    "intersection": "the intersection",
    "turn": "the place where the ways meet ('turn')",
    "turn_start": "the start of {its} turn",
    "turn_end": "the end of {its} turn",
    "junction_start": "the beginning of the junction",
    "junction_end": "the end of the junction",
    "route_end": "the end of {its} route",
}
_OF_ORDER: tuple[Dimension, ...] = ("length", "speed", "acceleration")
_WHEN = {"always": "at every moment", "never": "at no moment", "eventually": "at some moment"}


def amount(value: Fraction, dimension: Dimension | None) -> str:
    """Return a number with the SI unit of its dimension, with at most four digits after the point."""
    text = format_fraction(value)
    if len(text.partition(".")[2]) > 4 or "/" in text:
        text = f"{float(value):.4f}".rstrip("0").rstrip(".")
        text = text if Fraction(text) == value else f"about {text}"
    return text if dimension is None else f"{text} {SI_SYMBOL[dimension]}"


@dataclass(frozen=True, slots=True)
class Wording:
    """The words for formulas of one program."""

    program: Program

    def name(self, actor: int) -> str:
        """Return what an actor is called; its number for one that the program does not have."""
        names = {each.id: each.name for each in self.program.actors}
        return f"the {names[actor]}" if actor in names else f"A{actor}"

    def clause(self, formula: ex.Formula) -> str:
        """Return a formula in words, without the moment at which it holds."""
        match formula:
            case ex.Compare():
                subject, predicate = self._sentence(formula)
                return f"{subject} {predicate}"
            case ex.Logic(operator="and", operands=operands):
                return " and ".join(self.clause(each) for each in operands)
            case ex.Logic(operator="or", operands=operands):
                return "either " + " or ".join(self.clause(each) for each in operands)
            case ex.Logic(operator="not", operands=(operand,)):
                return f"it is not so that {self.clause(operand)}"
            case ex.Logic(operator="implies", operands=(one, other)):
                return f"if {self.clause(one)}, then {self.clause(other)}"
            case ex.Temporal(operator=operator, start=start, end=end, body=body):
                return f"{_WHEN[operator]} from {self._time(start)} to {self._time(end)} {self.clause(body)}"
            case _:
                return f"'{print_expression(formula)}'"

    def whole(self, formula: ex.Formula) -> str:
        """Return a formula in words with its own text, which names the moments."""
        return f"{self.clause(formula)} ({print_expression(formula)})"

    def of_one(self, formulas: list[ex.Formula], actor: int) -> str:
        """Return formulas in words, with "it" for an actor that was named just before."""
        own, others = [], []
        for formula in formulas:
            subject, predicate = self._sentence(formula) if isinstance(formula, ex.Compare) else ("", "")
            if subject == self.name(actor):
                own.append(predicate)
            else:
                others.append(self.clause(formula))
        return listed([*([f"it {listed(own)}"] if own else []), *others])

    def during(self, formula: ex.Formula, piece: PieceKind) -> str:
        """Return what holds all through a piece, to be put behind what the actor does there."""
        if isinstance(formula, ex.Compare) and isinstance(formula.left, ex.Arithmetic):
            return f" for {self._term(formula.right, 'time')}"
        if isinstance(formula, ex.Compare) and formula.operator == "==" and isinstance(formula.left, ex.State):
            state, right = formula.left, formula.right
            if state.order == 1 and isinstance(right, ex.Number) and not right.value:
                return ""  # a piece in which it stands
            if state.order == 2 and (rate := self._rate(right, piece)) is not None:
                return f" at {rate}"
            if state.order == 1:
                return f" at {self._term(right, 'speed')}"
        return f" ({self.whole(formula)})"

    def is_about_piece(self, formula: ex.Formula, actor: int, *names: str) -> bool:
        """Whether `formula` compares a state of `actor` all through the piece that has one of these names."""
        state = formula.left if isinstance(formula, ex.Compare) else None
        return (
            isinstance(state, ex.State)
            and state.actor == actor
            and isinstance(state.at, ex.PieceRef)
            and state.at.name in (*names, f"{names[-1]}1")
            and (state.at.name != names[-1] or names[0] in (names[-1], f"{names[-1]}1"))
        )

    def lasts(self, formula: ex.Formula, actor: int) -> tuple[str, str] | None:
        """Return the two knots of `actor` between which `formula` says how much time passes; None for any other."""
        match formula:
            case ex.Compare(
                left=ex.Arithmetic(operator="-", left=ex.Elapsed() as end, right=ex.Elapsed() as start), operator="=="
            ):
                return (start.knot, end.knot) if start.actor == end.actor == actor else None
            case _:
                return None

    def is_place(self, formula: ex.Formula) -> bool:
        """Whether `formula` says where an actor is."""
        return isinstance(formula, ex.Compare) and isinstance(formula.left, ex.State) and formula.left.order == 0

    def order(self, formula: ex.Formula) -> tuple[ex.Elapsed, str, ex.Elapsed] | None:
        """Return two moments and the word between them, where `formula` is about which comes first."""
        if (
            isinstance(formula, ex.Compare)
            and isinstance(formula.left, ex.Elapsed)
            and isinstance(formula.right, ex.Elapsed)
        ):
            words = {"<": "before", "<=": "no later than", ">": "only after", ">=": "no earlier than"}
            word = words.get(formula.operator, "at the moment when")
            return formula.left, word, formula.right
        return None

    # -- comparisons ------------------------------------------------------------------------------------------------
    def _sentence(self, compare: ex.Compare) -> tuple[str, str]:
        """Return subject and predicate of a comparison."""
        operator, left, right = compare.operator, compare.left, compare.right
        if isinstance(right, ex.State | ex.Derived) and not isinstance(left, ex.State | ex.Derived):
            operator, left, right = _MIRRORED[operator], right, left
        bound = _BOUND[operator]
        match left:
            case ex.State(actor=actor, order=0):
                predicate = self._position(actor, operator, right)
                if predicate is not None:
                    return self.name(actor), predicate
            case ex.State(actor=actor, order=1):
                if operator == "==" and isinstance(right, ex.Number) and not right.value:
                    return self.name(actor), "stands still"
                speed = self._term(right, "speed")
                return self.name(actor), f"has a speed of {bound}{speed}" if bound else f"drives at {speed}"
            case ex.State(actor=actor, order=2):
                return self.name(actor), f"has an acceleration of {bound}{self._term(right, 'acceleration')}"
            case ex.Derived(actor=actor, target=int() as other):
                return self._between(left, actor, other, bound, right)
            case ex.Derived(actor=actor, target=ex.Landmark() as landmark):
                place = self._place(landmark, actor)
                return self.name(actor), f"is {bound}{self._term(right, 'time')} from {place} (distance over speed)"
            case ex.Elapsed() if not isinstance(right, ex.Elapsed):
                return "the run", f"has lasted {bound}{self._term(right, 'time')}"
            case ex.Arithmetic(operator="-", left=ex.Elapsed() as end, right=ex.Elapsed() as start):
                moments = f"{self._time(start)} to {self._time(end)}"
                return f"the time from {moments}", f"is {bound}{self._term(right, 'time')}"
            case _:
                pass
        return f"'{print_expression(compare)}'", "holds"

    def _between(self, derived: ex.Derived, actor: int, other: int, bound: str, right: ex.Term) -> tuple[str, str]:
        one, two = self.name(actor), self.name(other)
        if derived.kind == "gap":
            return two, f"is {bound}{self._term(right, 'length')} ahead of {one}"
        size = f"{bound}{self._term(right, 'time')}"
        if derived.kind == "headway":
            return one, f"is {size} behind {two} (what lies between the bodies, over its own speed)"
        return f"the time to collision of {one} with {two}", f"is {size}"

    def _position(self, actor: int, operator: ex.ComparisonOperator, right: ex.Term) -> str | None:
        """Return "is 12 m before its stop line"; None where `right` is more than a landmark and a distance."""
        parts = list(_summands(right))
        landmarks = [part for part, sign in parts if isinstance(part, ex.Landmark) and sign > 0]
        rest = [(part, sign) for part, sign in parts if not isinstance(part, ex.Landmark)]
        signs = {sign for _, sign in rest}
        if len(landmarks) != 1 or len(landmarks) + len(rest) != len(parts) or len(signs) > 1:
            return None
        if not all(isinstance(part, ex.Number | ex.ParameterRef) for part, _ in rest):
            return None
        place = self._place(landmarks[0], actor)
        if not rest:
            return {"==": "is at", "<": "is before", "<=": "is not past", ">": "is past", ">=": "has reached"}[
                operator
            ] + f" {place}"
        before = signs == {-1}
        # Further along the route means less before a place, and more past it.
        bound = _BOUND[_MIRRORED[operator] if before else operator]
        far = " and ".join(self._term(part, "length") for part, _ in rest)
        return f"is {bound}{far} {'before' if before else 'past'} {place}"

    def _place(self, landmark: ex.Landmark, actor: int) -> str:
        owner = landmark.actor if landmark.actor is not None else actor
        its = "its" if owner == actor else f"{self.name(owner)}'s"
        text = _PLACES.get(landmark.name, landmark.name).format(its=its)
        return text if landmark.other is None else f"{text} with {self.name(landmark.other)}"

    # -- terms ------------------------------------------------------------------------------------------------------
    def _term(self, term: ex.Term, dimension: Dimension) -> str:
        match term:
            case ex.Number(value=value):
                return amount(value, dimension)
            case ex.ParameterRef(name=name):
                return name
            case ex.Negate(operand=ex.ParameterRef(name=name)):
                return f"-{name}"
            case ex.State(actor=actor, order=order) if order == 1:
                return f"the speed of {self.name(actor)}"
            case _:
                return f"'{print_expression(term)}'"

    def _rate(self, term: ex.Term, piece: PieceKind) -> str | None:
        """Return the size of an acceleration; None where its sign is not that of what the vehicle does there."""
        match term:
            case ex.Number(value=value) if (value < 0) == (piece is PieceKind.DEC):
                return amount(abs(value), "acceleration")
            case ex.ParameterRef(name=name) | ex.Negate(operand=ex.ParameterRef(name=name)):
                return name
            case _:
                return None

    def _time(self, term: ex.Term | ex.At) -> str:
        match term:
            case ex.Elapsed(actor=actor, knot=knot):
                return f"{self.name(actor)}'s {knot}"
            case ex.Number(value=value):
                return amount(value, "time")
            case ex.Knot(name=knot):
                return knot
            case None:
                return "now"
            case _:
                return f"'{print_expression(term)}'" if not isinstance(term, ex.PieceRef) else term.name


def _summands(term: ex.Term, sign: int = 1) -> list[tuple[ex.Term, int]]:
    match term:
        case ex.Arithmetic(operator="+" | "-" as operator, left=left, right=right):
            return _summands(left, sign) + _summands(right, sign if operator == "+" else -sign)
        case ex.Negate(operand=operand):
            return _summands(operand, -sign)
        case ex.Number(value=value) if value < 0:
            return [(ex.Number(-value), -sign)]
        case _:
            return [(term, sign)]


def listed(parts: list[str]) -> str:
    """Return "a, b and c"; nothing for nothing."""
    return parts[0] if len(parts) == 1 else ", ".join(parts[:-1]) + f" and {parts[-1]}" if parts else ""
