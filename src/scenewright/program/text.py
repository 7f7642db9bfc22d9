"""Reads the text form of a program (`.scene` files and the paper's pseudocode blocks).

What enters: text. What leaves: a `Program`, or a `ProgramError` with line, column, excerpt and what could have stood
there. It does not check that names and units make sense (see `check`), and knows no map.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from dataclasses import replace
from difflib import get_close_matches
from fractions import Fraction
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any, cast

from lark import Lark, Token, Transformer, v_args
from lark.exceptions import UnexpectedInput, VisitError
from lark.tree import Meta

from scenewright.errors import Place, ProgramError, Span
from scenewright.program.arithmetic import JUST_BEFORE_M, combine, just_before, negate
from scenewright.program.expressions import (
    LANDMARKS,
    Compare,
    ComparisonOperator,
    Derived,
    Elapsed,
    Formula,
    Knot,
    Landmark,
    Logic,
    Node,
    Number,
    Order,
    ParameterRef,
    PieceRef,
    State,
    Temporal,
    Term,
    walk,
)
from scenewright.program.limits import check_depth, check_text
from scenewright.program.manner import manner_of, unit_of
from scenewright.program.syntax_errors import syntax_error
from scenewright.program.types import (
    DEFAULT_MAP,
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
from scenewright.units import UNIT_SUFFIXES, UNITS, Unit, unit_of_name

__all__ = ["JUST_BEFORE_M", "negate", "parse_program"]

_ARTICLES = {"length": "a length", "time": "a time", "speed": "a speed", "acceleration": "an acceleration"}


def parse_program(text: str, name: str = "program") -> Program:
    r"""Parse the text form of a program.

    Parameters
    ----------
    text
        A `.scene` text or one of the paper's pseudocode blocks.
    name
        What to call the text in messages, and the program where the text gives no name.

    Returns
    -------
    Program
        With spans into `text`. Parameters that are used but not declared are added as open ones.

    Raises
    ------
    ProgramError
        Where the text is not a program, or is larger than one may be (see `limits`).

    Examples
    --------
    >>> program = parse_program("Actor 0:\n- W\n- [t0, go, t1]\nConstraints:\nA0v(t0) == 5 m/s\n")
    >>> len(program.constraints)
    1
    """
    if not text.strip():
        raise ProgramError(
            "the program is empty",
            place=Place(name),
            expected="actors, then constraints",
            fix="see 'scenewright translate --help' for an example",
        )
    check_text(text, name)
    if "\n" not in text[len(text.rstrip()) :]:
        text += "\n"
    try:
        tree = _parser().parse(text)
        return _Builder(text, name).transform(tree)  # type: ignore[no-any-return]
    except UnexpectedInput as error:
        raise syntax_error(error, text, name) from None
    except VisitError as error:
        if isinstance(error.orig_exc, ProgramError):
            raise error.orig_exc from None
        raise


@lru_cache(maxsize=1)
def _parser() -> Lark:
    grammar = files("scenewright.program").joinpath("scene.lark").read_text(encoding="utf-8")
    # To build the parser takes ten times as long as to read what was built; who may not write there does without.
    folder = Path(os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache"), "scenewright")
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
    built = str(folder / f"scene-{sys.version_info.major}.{sys.version_info.minor}.lark")
    return Lark(grammar, parser="lalr", propagate_positions=True, maybe_placeholders=True, cache=built)


@v_args(meta=True)
class _Builder(Transformer[Token, Any]):
    """Turns the parse tree into typed data, bottom up."""

    def __init__(self, text: str, name: str) -> None:
        super().__init__()
        self._text = text
        self._name = name

    def _place(self, span: Span) -> Place:
        return Place(self._name, self._text, span)

    @staticmethod
    def _span(meta: Meta) -> Span:
        return Span(meta.start_pos, meta.end_pos)

    # -- headers ----------------------------------------------------------------------------------------------------
    def scenario(self, meta: Meta, items: list[Any]) -> tuple[str, str, Span]:
        return "name", _unquote(items[0]), self._span(meta)

    def map(self, meta: Meta, items: list[Any]) -> tuple[str, str, Span]:
        token = items[0]
        return "map_name", _name(token), self._span(meta)

    def description(self, meta: Meta, items: list[Any]) -> tuple[str, str, Span]:
        quoted = next(item for item in items if item is not None and item.type == "STRING")
        return "description", _unquote(quoted), self._span(meta)

    def parameters(self, meta: Meta, items: list[Any]) -> tuple[str, list[Parameter]]:
        return "parameters", [item for item in items if isinstance(item, Parameter)]

    def parameter(self, meta: Meta, items: list[Any]) -> Parameter:
        name, value, low, high = items
        span = Span(name.start_pos, name.end_pos)
        unit = unit_of_name(name)
        own = [None if n is None else self._in_unit(unit, f"parameter {name}", n, span) for n in (value, low, high)]
        return Parameter(str(name), own[0], own[1], own[2], span)

    def manner(self, meta: Meta, items: list[Any]) -> tuple[str, list[tuple[str, Fraction, Place]]]:
        return "manner", [item for item in items if isinstance(item, tuple)]

    def manner_number(self, meta: Meta, items: list[Any]) -> tuple[str, Fraction, Place]:
        name, number = items
        span = Span(name.start_pos, name.end_pos)
        unit = unit_of(str(name), self._place(span))
        return str(name), self._in_unit(unit, f"{name} of the manner", number, span), self._place(span)

    def _in_unit(self, own: Unit | None, what: str, number: tuple[Fraction, str | None], span: Span) -> Fraction:
        value, symbol = number
        if symbol is None or own is None:
            return value
        unit = UNITS[symbol]
        if unit.dimension != own.dimension:
            raise ProgramError(
                f"{what} is {_ARTICLES[own.dimension]}, its value is {_ARTICLES[unit.dimension]}",
                place=self._place(span),
                found=symbol,
                expected=f"a unit of {own.dimension}, such as {own.symbol}",
            )
        return value * unit.si_factor / own.si_factor

    def signed_number(self, meta: Meta, items: list[Any]) -> tuple[Fraction, str | None]:
        minus, number, divisor, unit = items
        value = self._ratio(number, divisor)
        return (-value if minus else value), unit

    def _ratio(self, number: Token, divisor: Token | None) -> Fraction:
        if divisor is None:
            return Fraction(number)
        if not Fraction(divisor):
            span = Span(cast(int, divisor.start_pos), cast(int, divisor.end_pos))
            raise ProgramError(
                "a number is divided by zero",
                place=self._place(span),
                found=f"{number}/{divisor}",
                expected="a divisor that is not zero",
            )
        return Fraction(number) / Fraction(divisor)

    def unit(self, meta: Meta, items: list[Any]) -> str:
        return str(items[0])

    # -- actors -----------------------------------------------------------------------------------------------------
    def actor(self, meta: Meta, items: list[Any]) -> Actor:
        parts = [item for item in items if not (isinstance(item, Token) and item.type == "_NL")]
        number, name, route, sketch = parts
        actor_id = int(number)
        default = "ego" if actor_id == 0 else "hero" if actor_id == 1 else f"hero{actor_id}"
        return Actor(actor_id, _name(name) if name else default, route, sketch, self._span(meta))

    def headings(self, meta: Meta, items: list[Any]) -> HeadingsRoute:
        return HeadingsRoute(tuple(str(item) for item in items))

    def lanes(self, meta: Meta, items: list[Any]) -> LanesRoute:
        return LanesRoute(tuple(str(item) for item in items))

    def intent(self, meta: Meta, items: list[Any]) -> IntentRoute:
        origin, origin_heading, turn, destination, destination_heading = (str(i) if i else None for i in items)
        return IntentRoute(
            cast(Any, origin), cast(Any, turn), cast(Any, destination), origin_heading, destination_heading
        )

    def sketch(self, meta: Meta, items: list[Any]) -> Sketch:
        names = [str(item) for item in items]
        knots, pieces = tuple(names[0::2]), tuple(names[1::2])
        if len(names) % 2 == 0:
            raise ProgramError(
                "a motion sketch begins and ends with a knot",
                place=self._place(self._span(meta)),
                expected="knots and pieces in turn, such as [t0, go, t1, dec, t2]",
            )
        known = {str(kind) for kind in PieceKind}
        for item in items[1::2]:
            if str(item) not in known:
                raise ProgramError(
                    f"'{item}' is not a piece of motion",
                    place=self._place(Span(item.start_pos, item.end_pos)),
                    found=str(item),
                    expected="go, acc, dec or stop",
                )
        if len(set(knots)) != len(knots):
            raise ProgramError(
                "a knot's name occurs twice", place=self._place(self._span(meta)), fix="number the knots"
            )
        return Sketch(knots, tuple(PieceKind(piece) for piece in pieces))

    # -- constraints ------------------------------------------------------------------------------------------------
    def constraints(self, meta: Meta, items: list[Any]) -> tuple[str, list[tuple[Any, ...]]]:
        return "constraints", [item for item in items if isinstance(item, tuple)]

    def constraint(self, meta: Meta, items: list[Any]) -> tuple[Any, ...]:
        label, formula, start, end = items[:4]
        source = Span(int(start), int(end)) if start is not None else None
        span = formula.span or self._span(meta)
        check_depth(formula, self._place(span))
        return (str(label)[:-1] if label else None, formula, source, span)

    def implication(self, meta: Meta, items: list[Any]) -> Formula:
        return Logic("implies", (items[0], items[1]), self._span(meta))

    def disjunction(self, meta: Meta, items: list[Any]) -> Formula:
        return Logic("or", tuple(items), self._span(meta))

    def conjunction(self, meta: Meta, items: list[Any]) -> Formula:
        return Logic("and", tuple(items), self._span(meta))

    def negated(self, meta: Meta, items: list[Any]) -> Formula:
        return Logic("not", (items[0],), self._span(meta))

    def temporal(self, meta: Meta, items: list[Any]) -> Formula:
        operator, start, end, body = items
        return Temporal(cast(Any, str(operator)), start, end, body, self._span(meta))

    def comparison(self, meta: Meta, items: list[Any]) -> Formula:
        span = self._span(meta)
        pairs = [
            Compare(cast(ComparisonOperator, str(items[i + 1])), items[i], items[i + 2], span)
            for i in range(0, len(items) - 2, 2)
        ]
        return pairs[0] if len(pairs) == 1 else Logic("and", tuple(pairs), span)

    def group(self, meta: Meta, items: list[Any]) -> Node:
        """Let what stands in parentheses cover them too, so that every span is a text that parses by itself."""
        node: Node = items[0]
        return replace(node, span=self._span(meta))

    # -- terms ------------------------------------------------------------------------------------------------------
    def sum(self, meta: Meta, items: list[Any]) -> Term:
        return self._fold(items)

    def product(self, meta: Meta, items: list[Any]) -> Term:
        return self._fold(items)

    @staticmethod
    def _fold(items: list[Any]) -> Term:
        result: Term = items[0]
        for operator, right in zip(items[1::2], items[2::2], strict=True):
            span = result.span.union(right.span) if result.span and right.span else None
            result = combine(cast(Any, str(operator)), result, right, span)
        return result

    def negate(self, meta: Meta, items: list[Any]) -> Term:
        return negate(items[-1], self._span(meta))

    def number(self, meta: Meta, items: list[Any]) -> Number:
        value, unit = Fraction(items[0]), items[1]
        if unit is None:
            return Number(value, self._span(meta))
        return Number(value * UNITS[unit].si_factor, self._span(meta), UNITS[unit].dimension)

    def instant(self, meta: Meta, items: list[Any]) -> Number:
        span, number = self._span(meta), (self._ratio(items[0], items[1]), items[2])
        return Number(self._in_unit(UNITS["s"], "a moment", number, span), span)

    def state(self, meta: Meta, items: list[Any]) -> State:
        token, at = items
        letter = str(token)[-1]
        return State(int(str(token)[1:-1]), cast(Order, "xva".index(letter)), at, self._span(meta))

    def at(self, meta: Meta, items: list[Any]) -> Any:
        return items[0]

    def moment_name(self, meta: Meta, items: list[Any]) -> Knot | PieceRef:
        name = str(items[0])
        stem = name.rstrip("0123456789")
        return PieceRef(name) if stem in {str(kind) for kind in PieceKind} else Knot(name)

    def elapsed(self, meta: Meta, items: list[Any]) -> Elapsed:
        return Elapsed(int(str(items[0])[1:]), str(items[1]), self._span(meta))

    def derived(self, meta: Meta, items: list[Any]) -> Derived:
        kind, actor, target, at = items
        if not isinstance(target, int | Landmark):
            raise ProgramError(
                f"{kind} is measured to an actor or a landmark",
                place=self._place(target.span),
                found=target.name,
                expected=f"an actor such as A1, or a landmark ({', '.join(LANDMARKS)})",
            )
        return Derived(cast(Any, str(kind)), int(str(actor)[1:]), target, at, self._span(meta))

    def target_actor(self, meta: Meta, items: list[Any]) -> int:
        return int(str(items[0])[1:])

    def landmark_of(self, meta: Meta, items: list[Any]) -> Landmark:
        actor, name, other = items
        self._known_landmark(name)
        return Landmark(str(name), int(actor[1:]), int(other[1:]) if other else None, self._span(meta))

    def _known_landmark(self, name: Token) -> None:
        if str(name) not in LANDMARKS:
            raise ProgramError(
                f"'{name}' is not a landmark",
                place=self._place(Span(cast(int, name.start_pos), cast(int, name.end_pos))),
                found=str(name),
                expected=", ".join(LANDMARKS),
            )

    def just_before(self, meta: Meta, items: list[Any]) -> Term:
        return just_before(items[0], self._span(meta))

    def name(self, meta: Meta, items: list[Any]) -> Term:
        name, span = str(items[0]), self._span(meta)
        if name in LANDMARKS:
            return Landmark(name, span=span)
        if unit_of_name(name) is None:
            near = get_close_matches(name.lower(), LANDMARKS, n=1)
            raise ProgramError(
                f"'{name}' is neither a landmark nor a parameter",
                place=self._place(span),
                found=name,
                expected=f"a landmark ({', '.join(LANDMARKS)}) or a parameter whose name ends in its unit",
                fix=f"did you mean {near[0]}?" if near else f"end the name in {UNIT_SUFFIXES} if it is a parameter",
            )
        return ParameterRef(name, span)

    # -- the whole --------------------------------------------------------------------------------------------------
    def start(self, meta: Meta, items: list[Any]) -> Program:
        given: dict[str, Any] = {}
        declared: list[Parameter] = []
        rows: list[tuple[Any, ...]] = []
        numbers: list[tuple[str, Fraction, Place]] = []
        actors: list[Actor] = []
        for item in items:
            if isinstance(item, Actor):
                actors.append(item)
            elif isinstance(item, tuple) and item[0] == "parameters":
                declared += item[1]
            elif isinstance(item, tuple) and item[0] == "manner":
                numbers += item[1]
            elif isinstance(item, tuple) and item[0] == "constraints":
                rows = item[1]
            elif isinstance(item, tuple):
                field, value, span = item
                if field in given:  # neither of two is to be left out in silence
                    raise ProgramError("this is said twice", place=self._place(span), found=value, fix="remove one")
                given[field] = value
        constraints = tuple(
            Constraint(label or f"c{index}", formula, source, span)
            for index, (label, formula, source, span) in enumerate(rows, start=1)
        )
        return Program(
            actors=tuple(actors),
            constraints=constraints,
            parameters=_with_used_parameters(declared, constraints),
            manner=manner_of(numbers),
            **({"name": self._name, "map_name": DEFAULT_MAP} | given),
        )


def _with_used_parameters(declared: list[Parameter], constraints: tuple[Constraint, ...]) -> tuple[Parameter, ...]:
    known = {parameter.name for parameter in declared}
    result = list(declared)
    for constraint in constraints:
        node: Node
        for node in walk(constraint.formula):
            if isinstance(node, ParameterRef) and node.name not in known:
                known.add(node.name)
                result.append(Parameter(node.name, span=node.span))
    return tuple(result)


def _name(token: Token) -> str:
    return _unquote(token) if token.type == "STRING" else str(token)


def _unquote(token: Token) -> str:
    body = str(token)[1:-1]
    return body.replace('\\"', '"').replace("\\\\", "\\")
