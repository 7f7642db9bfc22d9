"""Reads what a text says its parameters are: "hero_decel_mpss = 3.5", "with ego_gap_m between 10 m and 20 m".

What enters: a description. What leaves: the description without what it says of values, every other character in its
place, and a `GivenValue` for each parameter. A name that has no other part in the text is left where it stands.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.errors import Place, Span, TranslationError
from scenewright.program.expressions import Number
from scenewright.program.types import Parameter, Program
from scenewright.translate.tokens import PARAMETER, tokenise
from scenewright.units import unit_of_name

_UNIT = (
    r"(?: ?(?:m/s\^?2|m/s²|m/s|km/h|kph|mph|ft/s|g|m|met(?:re|er)s?(?: per second(?: squared)?)?|s|secs?|seconds?"
    r"|ft|feet"
    r"|foot|yds?|yards?)(?![\w^/²]))"
)
_NUMBER = r"[-+−]?\d+(?:\.\d+)?"
_AMOUNT = rf"{_NUMBER}{_UNIT}?(?![\w^/²])(?!\.\d)"
_NAME = rf"\{{?(?:{PARAMETER})\}}?"
_IS = (
    r"(?: ?:?= ?| ?: ?| (?:is|be|are)(?: (?:set|fixed|equal|kept))?(?: (?:to|at))? | (?:equals|being|set to|fixed "
    r"at|taken as"
    r"|equal to) )"
)
_RANGE = (
    rf"(?:(?: ?[:=]| (?:is|are|lies|varies|ranges|runs|goes|be|taken|chosen|sampled|drawn))? ?(?:(?:anywhere "
    rf")?(?:between|from)"
    rf"|in the range(?: of| from)?|in|within|∈) ?\[?(?P<low>{_AMOUNT})(?: ?(?:and|to|\.\.\.?|–|-|,) "
    rf"?)(?P<high>{_AMOUNT})\]?)"
)
_ONE = rf"(?:the value of )?(?P<name>{_NAME})(?:{_IS}(?P<value>{_AMOUNT})(?! ?(?:to|and|\.\.|–|-) ?\d)|{_RANGE})"
_PLAIN = re.sub(r"\?P<\w+>", "?:", _ONE)
_AND = r"(?: ?[,;] ?(?:and )?| and |\s*\n[ \t]*(?:[-*•] )?)"
_LEAD = (
    r"(?:(?P<fresh>^|(?<=[.!?;:]\s)|(?<=\n))[ \t]*(?:[-*•] )?(?:(?:the )?(?:parameters?|(?:parameter )?values?"
    r"|settings)"
    r"(?: are| is)?: ?|(?:here|let|set|use|take|with|where|and),? )*|(?P<joint>,? ?\((?:(?:with|where|here),? )?|,? "
    r"(?:with|where|for|using),? ))"
)
_TOLD = re.compile(
    rf"{_LEAD}(?P<list>{_PLAIN}(?:{_AND}{_PLAIN})*)(?P<close>\))?(?=\s*(?:[.,;!?)]|\n|$))",
    re.IGNORECASE,
)
_EACH = re.compile(_ONE, re.IGNORECASE)
# "brakes at hero_decel_mpss = 3.5 to a standstill", "hero_gap_m (12 m)"
_BESIDE = re.compile(
    rf"(?P<name>{_NAME})(?P<told> ?:?= ?(?P<value>{_AMOUNT})| \((?:= ?|here |i\.e\. )?(?P<inside>{_AMOUNT})\))",
    re.IGNORECASE,
)
# "Logical scenario, values to be sampled.", "The sampler fills in ego_gap_m and hero_gap_m."
_LEFT_OPEN = re.compile(
    r"(?P<before>^|(?<=[.!?;]\s)|,? )(?:(?:all |the |their |parameter )*(?:values|parameters) (?:(?:are|will be|is) "
    r")?(?:(?:to be|yet to be"
    r"|still to be) )?(?:sampled|filled in|drawn|chosen|set|given|left open)(?: later| separately| by (?:the|a) "
    r"[\w ]+)?"
    rf"|The (?:sampler|sweep|optimi[sz]er|search|generator|test bench) (?:fills in|chooses|sets|samples|draws|varies) "
    rf"(?P<names>{_NAME}(?:(?:, and |, | and ){_NAME})*))(?=[.;])",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class GivenValue:
    """A parameter with the value, or the range, that a text gives it in its own unit, and where."""

    name: str
    span: Span
    value: Fraction | None = None
    low: Fraction | None = None
    high: Fraction | None = None

    def parameter(self) -> Parameter:
        """Return it as a program holds it."""
        return Parameter(self.name, self.value, self.low, self.high)

    def __str__(self) -> str:
        unit = unit_of_name(self.name)
        symbol = unit.symbol if unit else ""
        if self.value is not None:
            return f"{self.name} is {float(self.value):g} {symbol}"
        return f"{self.name} is between {float(self.low or 0):g} and {float(self.high or 0):g} {symbol}"


def take_values(text: str, name: str) -> tuple[str, tuple[GivenValue, ...]]:
    """Return the text without the values of its parameters, and these.

    Raises
    ------
    TranslationError
        Where a value has a unit of another dimension than its name, is negative, or is given twice, or where a range
        is empty.

    Examples
    --------
    >>> text = "When it is gap_m behind the hero, the hero brakes. gap_m = 12."
    >>> rest, (given,) = take_values(text, "description")
    >>> rest.rstrip(), str(given), len(rest) == len(text)
    ('When it is gap_m behind the hero, the hero brakes.', 'gap_m is 12 m', True)
    """
    given: list[GivenValue] = []
    whole = text
    for found in _TOLD.finditer(text):
        inside = Span(*found.span("list"))
        each = list(_EACH.finditer(text, inside.start, inside.end))
        if ("(" in (found["joint"] or "")) != bool(found["close"]):
            continue
        if not all(_has_a_part(one["name"], text, inside) for one in each):
            continue
        given += [_read(one, whole, name) for one in each]
        ends = bool(found["fresh"] is not None) and text[found.end() : found.end() + 1] in (".", ";", "!")
        text = _without(text, found.start(), found.end() + ends)
    for found in _LEFT_OPEN.finditer(text):
        inside = Span(*found.span())
        names = re.findall(PARAMETER, found["names"] or "") or re.findall(PARAMETER, text)
        if any(_has_a_part(each, text, inside) for each in names[:1]) and all(
            _has_a_part(each, text, inside) for each in (names if found["names"] else ())
        ):
            ends = not found["before"].strip() and found.start("before") == found.end("before")
            text = _without(text, found.start(), found.end() + ends)
    for found in _BESIDE.finditer(text):
        if unit_of_name(_bare(found["name"])) is not None:
            value = _value(found["value"] or found["inside"], found, whole, name)
            given.append(GivenValue(_bare(found["name"]), Span(*found.span()), value))
            text = _without(text, *found.span("told"))
    _refuse_two_values(given, whole, name)
    return text, tuple(given)


def with_values(program: Program, given: tuple[GivenValue, ...], text: str, name: str) -> Program:
    """Return the program of `text` with the values that it gives its parameters.

    Raises
    ------
    TranslationError
        Where one is none of the program's.
    """
    named = {each.name: each for each in given}
    for each in given:
        if each.name not in {parameter.name for parameter in program.parameters}:
            raise TranslationError(
                f"'{each.name}' is given a value but has no part in what was understood",
                place=Place(name, text, each.span),
                found=each.span.excerpt(text),
                expected="a parameter of the description",
                fix="use it in a sentence, or leave it out",
            )
    parameters = (named[each.name].parameter() if each.name in named else each for each in program.parameters)
    return replace(program, parameters=tuple(parameters), description=text)


def _bare(name: str) -> str:
    return name.strip("{}").replace("\\", "")


def _without(text: str, start: int, end: int) -> str:
    return text[:start] + " " * (end - start) + text[end:]


def _has_a_part(name: str, text: str, inside: Span) -> bool:
    """Whether a name with a unit stands elsewhere in the text too, and so has a part in what is described."""
    rest = text[: inside.start] + text[inside.end :]
    return unit_of_name(_bare(name)) is not None and re.search(rf"\b{re.escape(_bare(name))}\b", rest) is not None


def _read(one: re.Match[str], text: str, name: str) -> GivenValue:
    span, own = Span(*one.span()), _bare(one["name"])
    if one["value"] is not None:
        return GivenValue(own, span, _value(one["value"], one, text, name))
    shared = re.search(rf"{_UNIT}$", one["high"])  # "between 10 and 20 m"
    low_told = one["low"] if shared is None or re.search(rf"{_UNIT}$", one["low"]) else one["low"] + shared.group()
    low, high = _value(low_told, one, text, name), _value(one["high"], one, text, name)
    if low > high:
        raise TranslationError(
            "this range is empty",
            place=Place(name, text, span),
            found=one.group(),
            expected="the smaller value first",
            fix=f"write '{own} between {one['high']} and {one['low']}'",
        )
    return GivenValue(own, span, low=low, high=high)


def _value(told: str, found: re.Match[str], text: str, name: str) -> Fraction:
    """Return an amount in the unit of the parameter that it is told of."""
    own = _bare(found["name"])
    unit = unit_of_name(own)
    place = Place(name, text, Span(*found.span()))
    assert unit is not None
    number = re.match(_NUMBER, told)
    assert number is not None
    value = Fraction(number.group().replace("−", "-"))
    if value < 0:
        raise TranslationError(
            f"the parameter '{own}' cannot be negative",
            place=place,
            found=told,
            expected="its size; the description says whether a vehicle brakes or accelerates",
            fix=f"write '{own} = {told.lstrip('-−')}'",
        )
    if number.end() == len(told.rstrip()):
        return value
    quantity = next(each.quantity for each in tokenise(told, name) if each.quantity is not None)
    if quantity.dimension != unit.dimension or not isinstance(quantity.term, Number):
        raise TranslationError(
            f"the parameter '{own}' is in {unit.symbol}, but the text gives it {told}",
            place=place,
            found=found.group(),
            expected=f"an amount in {unit.symbol} or another unit of {unit.dimension}",
            fix="correct the unit, or the name",
        )
    return quantity.term.value / unit.si_factor


def _refuse_two_values(given: list[GivenValue], text: str, name: str) -> None:
    seen: dict[str, GivenValue] = {}
    for each in given:
        other = seen.setdefault(each.name, each)
        if (other.value, other.low, other.high) != (each.value, each.low, each.high):
            raise TranslationError(
                f"the parameter '{each.name}' is given two values",
                place=Place(name, text, each.span),
                found=str(each),
                expected=str(other),
                fix="give it one of them",
            )
