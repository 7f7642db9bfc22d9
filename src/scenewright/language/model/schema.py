"""The form of a reply: the story with names for numbers and quoted words for positions, made from its own dataclasses.

What enters: the text of a reply. What leaves: its JSON schema; a `Claim`, which is a `Story` with the stretches of the
text that its parts quote; or a `TranslationError` that can go back to the model. Whether the words say so is for
`evidence` to find out.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cache
from importlib.resources import files
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, create_model

from scenewright.errors import Span, TranslationError
from scenewright.language import story as st
from scenewright.language.compile import COMPASS, DRIVEN, TURNS
from scenewright.language.model.exchange import CUT_OFF, LONGEST_REPLY
from scenewright.language.phrases import PLACES
from scenewright.language.ways import BEARINGS
from scenewright.program.types import EGO, AreaKind, Parameter
from scenewright.units import DIGITS, UNITS, is_size_of_a_scenario, unit_of_name

EGO_NAME = "ego"
START_NAME = "start"
MOST_ENTRIES = 100
LONGEST_WORDS = 2_000
DEEPEST = 3  # conditions in conditions; the teller has words for no more
_PEOPLE = ("actor", "other", "of", "partner")  # slots that are numbers of actors; all other numbers are of moments
# Ours to say, or found by the program: a reply could name any file as its map, or let anything pass as a standstill.
_OURS = {
    st.Story: {"manner", "map_name", "title"},
    st.Actor: {"id", "quote"},
    st.Moment: {"quote"},
    st.Compound: {"quote"},
    Parameter: {"span"},
}
_WORDS: dict[tuple[type, str], Any] = {  # slots of any text, and the words that they may be
    (st.Amount, "unit"): Literal[tuple(UNITS)],
    (st.Place, "name"): Literal[tuple(PLACES)],
    (st.Way, "heading"): Literal[tuple(COMPASS)],
    (st.Way, "destination_heading"): Literal[tuple(COMPASS)],
    (st.Way, "turn"): Literal[tuple(TURNS)],
    (st.Way, "origin"): AreaKind,
    (st.Way, "destination"): AreaKind,
}
# Slots in which a word that the program language does not know may stand: it is refused by that name.
_KNOWN: dict[tuple[type, str], tuple[str, ...]] = {
    (st.Actor, "kind"): DRIVEN,
    (st.Deed, "verb"): tuple(st.Verb),
    (st.Relation, "kind"): tuple(BEARINGS),
}


def _plain(value: object) -> object:
    """Return a text without characters that could steer a terminal."""
    if isinstance(value, str):
        return "".join(c if c.isprintable() else " " for c in value).strip()[:LONGEST_WORDS]
    return str(value) if isinstance(value, int | float) and not isinstance(value, bool) else value


Words = Annotated[str, BeforeValidator(_plain)]
_MORE: dict[type, dict[str, tuple[Any, Any]]] = {
    st.Actor: {"called": (list[Words], ...)},
    st.Moment: {"name": (Words, ...)},
    st.Way: {"words": (Words, "")},
}
_CONFIG = ConfigDict(extra="forbid")


@cache
def descriptions() -> dict[str, dict[str, str]]:
    """Return what each slot means, by form and name."""
    return tomllib.loads(files("scenewright.language.model").joinpath("slots.toml").read_text(encoding="utf-8"))


_hints = cache(get_type_hints)


def _made(name: str, slots: Mapping[str, tuple[Any, Any]]) -> type[BaseModel]:
    told = descriptions().get(name.rstrip("0123456789"), {})
    made: dict[str, Any] = {}
    for slot, (kind, default) in slots.items():
        often = {"max_length": MOST_ENTRIES} if get_origin(kind) is list else {}
        made[slot] = (kind, Field(default, description=told.get(slot), **often))
    return create_model(name, __config__=_CONFIG, **made)


@cache
def form_of(cls: type, depth: int = DEEPEST) -> type[BaseModel]:
    """Return the form for a dataclass of the story; `depth` says how many conditions may lie in each other."""
    hints = _hints(cls)
    slots: dict[str, tuple[Any, Any]] = dict(_MORE.get(cls, {}))
    for each in fields(cls):
        if each.name in _OURS.get(cls, ()):
            continue
        kind = _kind(hints[each.name], depth - (cls is st.Compound), (cls, each.name))
        empty: Any = None if type(None) in get_args(hints[each.name]) else ...
        default = empty if each.default is MISSING or is_dataclass(each.default) else each.default
        slots["words" if each.name == "quote" else each.name] = (
            (Words, "") if each.name == "quote" else (kind, [] if default == () else default)
        )
    if cls is st.Story:
        slots |= {"asides": (list[Words], []), "assumptions": (list[Assumption], [])}
    if cls is st.Question:
        slots["default"] = (Words | None, None)
    return _made(cls.__name__ + (str(depth) if cls is st.Compound else ""), slots)


def _kind(hint: Any, depth: int, slot: tuple[type, str] | None = None) -> Any:
    """Return what stands in a reply for a type of the story."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        kinds = [_kind(each, depth, slot) for each in parts if each is not st.Compound or depth > 0]
        return Union[tuple(kinds)]  # noqa: UP007
    if origin is tuple:
        return list[_kind(parts[0], depth, slot)]  # type: ignore[misc]
    if slot in _WORDS and hint is str:
        return _WORDS[slot]
    if hint in (str, int, Fraction):  # numbers of actors and moments are names; a number is written in digits
        return Words
    return form_of(hint, depth) if is_dataclass(hint) else hint


Assumption = _made("Assumption", {"words": (Words, ""), "says": (Words, ...)})
_READING = _made("Reading", {"words": (Words, ...), "means": (Words, ...)})
_REFUSAL = _made("Refusal", {"reason": (Words, ...), "words": (Words, ""), "fix": (Words, "")})
Reply: Any = _made(
    "Reply",
    {
        "readings": (list[_READING], []),  # type: ignore[valid-type]
        "refusal": (_REFUSAL | None, None),
        "story": (form_of(st.Story) | None, None),
    },
)


def reply_schema() -> dict[str, Any]:
    """Return the JSON schema of a reply."""
    return Reply.model_json_schema()  # type: ignore[no-any-return]


def sheet() -> str:
    """Return the form of a reply as lines of text: each part with its slots, what may stand there and what it means."""
    parts = (Reply, _READING, _REFUSAL, st.Story, Assumption, st.Question, st.Actor, st.Way, st.Relation, st.Moment,
             st.Measure, st.Amount, st.Place, st.Compound, st.Deed, st.Order, st.Hold, st.Point, Parameter)  # fmt: skip
    lines: list[str] = []
    for part in parts:
        form: Any = form_of(part) if is_dataclass(part) else part
        lines.append(f"\n{part.__name__}")
        for name, slot in form.model_fields.items():
            known = _KNOWN.get((part, name), ())  # type: ignore[arg-type]
            words = [f'"{word}"' for word in known] or [_shown(slot.annotation)]
            lines.append(f"- {name}: {' | '.join(words)}. {slot.description or ''}".rstrip())
    return "\n".join(lines).strip()


def _shown(kind: Any) -> str:
    """Return a type in the words of the sheet."""
    if get_origin(kind) is Annotated:
        return _shown(get_args(kind)[0])
    if get_origin(kind) is list:
        return f"[{_shown(get_args(kind)[0])}, ...]"
    if get_origin(kind) is Literal:
        return " | ".join(json.dumps(each) for each in get_args(kind))
    if get_args(kind):
        shown = [_shown(each) for each in get_args(kind)]
        return " | ".join(dict.fromkeys(shown))
    if isinstance(kind, type) and issubclass(kind, StrEnum):
        return " | ".join(f'"{each}"' for each in kind)
    names = {str: "text", bool: "true | false", type(None): "null"}
    return names.get(kind) or kind.__name__.rstrip("0123456789")


# -- reading --------------------------------------------------------------------------------------------------------
def read_reply(text: str) -> Any:
    """Read the one JSON object in `text`; what stands around it (a code fence, a greeting) does no harm.

    Raises
    ------
    TranslationError
        Where there is none, or it is not of the form.

    Examples
    --------
    >>> read_reply('Here you are: {"refusal": {"reason": "It is a recipe."}}').refusal.reason
    'It is a recipe.'
    """
    if len(text) > LONGEST_REPLY:
        most = f"one JSON object of at most {LONGEST_REPLY} characters"
        raise TranslationError("the reply is too long", found=f"{len(text)} characters", expected=most)
    if text.endswith(CUT_OFF):
        shorter = "a shorter reply: the JSON object alone, each reading in a few words"
        raise TranslationError("the reply is cut off", found="more tokens than --max-tokens allows", expected=shorter)
    try:
        reply = Reply.model_validate(_object_in(text))
    except ValidationError as error:
        told = [f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors(include_url=False)[:4]]
        form = "the slots of the form, and no others"
        raise TranslationError("the reply is not of the form asked for", found="; ".join(told), expected=form) from None
    if (reply.story is None) == (reply.refusal is None):
        raise TranslationError("the reply holds neither or both of story and refusal", expected="one of both")
    return reply


def _object_in(text: str) -> object:
    fault = "no JSON object"
    for start in [match.start() for match in re.finditer(r"\{", text)][:50]:
        try:
            value, _ = json.JSONDecoder().raw_decode(text, start)
        except json.JSONDecodeError as error:
            fault = f"{error.msg} at character {error.pos} of the reply" if fault == "no JSON object" else fault
        except (RecursionError, ValueError):
            fault = "an object or a number without end"
            break
        else:
            if isinstance(value, dict) and value.keys() & Reply.model_fields.keys():
                return value
    begins = str(_plain(text[:160]))
    found = f"{fault}; it begins: {begins}" if begins else "an empty reply"
    raise TranslationError("the reply holds no JSON object that can be read", found=found, expected="one JSON object")


# -- from names and words to numbers and positions ------------------------------------------------------------------
@dataclass(slots=True)
class Claim:
    """A story as a reply claims it, with what it quotes beside the quotes of the story itself.

    Attributes
    ----------
    called
        By actor, the words by which the text names it.
    ways
        By actor, the stretch that tells its way.
    owned
        The stretches of assumptions and questions, with what they say: what they name is told to the user.
    read
        The stretches of the readings.
    """

    story: st.Story
    called: dict[int, tuple[str, ...]] = field(default_factory=dict)
    ways: dict[int, st.Quote] = field(default_factory=dict)
    owned: list[tuple[Span | None, str]] = field(default_factory=list)
    read: list[Span] = field(default_factory=list)


def claim_of(reply: Any, text: str) -> Claim:
    """Return what a reply claims of `text`.

    Raises
    ------
    TranslationError
        Where a name is nobody's, or quoted words are not in the text.
    """
    reader = _Reader(text, reply.story)
    claim = Claim(reader.story())
    for number, actor in enumerate(reply.story.actors):
        claim.called[number] = tuple(actor.called)
        if quote := reader.quote(actor.way.words, None):
            claim.ways[number] = quote
    for each in (*reply.story.assumptions, *reply.story.questions):
        quote = reader.quote(each.words, None)
        said = getattr(each, "says", "") or f"{each.text} {' '.join(each.alternatives)}"
        claim.owned.append((quote.span if quote else None, said))
    found = [reader.quote(each.words, None) for each in reply.readings]
    claim.read = [quote.span for quote in found if quote]
    if reader.faults:
        raise TranslationError(
            "the story does not hold together",
            found="; ".join(dict.fromkeys(reader.faults)),
            expected="names that are given in `actors` and `moments`, words copied letter by letter",
        )
    return claim


@dataclass(slots=True)
class _Reader:
    text: str
    form: Any
    people: dict[str, int] = field(default_factory=dict)
    moments: dict[str, int] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)
    said: dict[tuple[str, Span | None], int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.people = self._numbers("actor", [each.name for each in self.form.actors], EGO_NAME, EGO)
        names = [each.name for each in self.form.moments]
        if START_NAME not in names:
            self.form.moments.insert(0, form_of(st.Moment)(name=START_NAME))
            names.insert(0, START_NAME)
        self.moments = self._numbers("moment", names, START_NAME, st.START)

    def _numbers(self, what: str, names: Sequence[str], first: str, number: int) -> dict[str, int]:
        if len(set(names)) < len(names) or names[number : number + 1] != [first]:
            self.faults.append(f"each {what} has a name of its own, and '{first}' is the first: {', '.join(names)}")
        return {name: place for place, name in enumerate(names)}

    def story(self) -> st.Story:
        made: st.Story = self.build(st.Story, self.form, None)
        return made

    def build(self, cls: type, form: Any, within: Span | None) -> Any:
        """Return the part of the story that a form fills; `within` is the stretch that an amount is quoted from."""
        hints, values = _hints(cls), dict[str, Any]()
        within = within if cls is st.Amount else None
        quote = self.quote(form.words, within) if "words" in type(form).model_fields and cls is not st.Way else None
        inner = quote.span if quote else None
        special: dict[str, Callable[[], Any]] = {
            "id": lambda: self.people[form.name],
            "quote": lambda: quote or self._mention(form),
            "asides": lambda: tuple(filter(None, (self.quote(words, None) for words in form.asides))),
            "assumptions": lambda: tuple(each.says for each in form.assumptions),
            "default": lambda: self._default(form),
        }
        for each in fields(cls):
            if each.name in special:
                values[each.name] = special[each.name]()
            elif each.name not in _OURS.get(cls, ()):
                values[each.name] = self._value(hints[each.name], getattr(form, each.name), inner, each.name)
        made = cls(**values)
        if isinstance(made, st.Amount):
            self._check_amount(made)
        return made

    def _value(self, hint: Any, value: Any, within: Span | None, slot: str) -> Any:
        if value is None:
            return None
        if get_origin(hint) in (Union, UnionType):
            kinds = [each for each in get_args(hint) if each is not type(None)]
            name = type(value).__name__.rstrip("0123456789")
            hint = next((each for each in kinds if getattr(each, "__name__", "") == name), kinds[0])
        if get_origin(hint) is tuple:
            return tuple(self._value(get_args(hint)[0], each, within, slot) for each in value)
        if hint is int:
            return self._number(value, slot)
        if hint is Fraction:
            return self._fraction(value)
        return self.build(hint, value, within) if is_dataclass(hint) else value

    def _number(self, name: str, slot: str) -> int:
        what, known = ("actor", self.people) if slot in _PEOPLE else ("moment", self.moments)
        if name not in known:
            self.faults.append(f"there is no {what} '{name}' ({slot}); there are: {', '.join(known)}")
        return known.get(name, 0)

    def _fraction(self, digits: str) -> Fraction:
        try:
            value = Fraction(digits) if len(digits) <= DIGITS else Fraction(-1, 10**DIGITS)
        except (ValueError, ZeroDivisionError):
            value = Fraction(-1, 10**DIGITS)
        if not is_size_of_a_scenario(value):
            self.faults.append(f"'{digits[:DIGITS]}' is no number in digits of a size that a test has")
        return value

    def _check_amount(self, amount: st.Amount) -> None:
        if (amount.name is None) == (amount.value is None):
            self.faults.append("an amount has either a value or the name of a parameter")
        elif amount.name is not None:
            unit = unit_of_name(amount.name)
            if unit is None or unit.symbol != amount.unit:
                ends = f"it is {unit.symbol}" if unit else "it ends in none; ask for it, or refuse"
                self.faults.append(f"'{amount.unit}' is not the unit that the parameter {amount.name} ends in: {ends}")

    def _default(self, form: Any) -> int | None:
        if len(form.alternatives) < 2 or (form.default is not None and form.default not in form.alternatives):
            self.faults.append(f"the question '{form.slot}' needs two alternatives, its default among them")
            return None
        return None if form.default is None else list(form.alternatives).index(form.default)

    def _mention(self, form: Any) -> st.Quote | None:
        """Return where the text first names an actor."""
        names = getattr(form, "called", ())
        for name in names:
            if not locate(name, self.text):
                self.faults.append(f"nobody is called '{name}' in the text")
        found = [span for name in names for span in locate(name, self.text)]
        return self._quoted(min(found, key=lambda span: span.start)) if found else None

    def quote(self, words: str, within: Span | None) -> st.Quote | None:
        """Return the stretch that is quoted; words that stand there more than once are taken in turn."""
        if not words:
            return None
        places = [span for span in locate(words, self.text) if not within or _is_in(span, within)]
        if not places:
            where = "the text" if within is None else f"'{within.excerpt(self.text)}', the words of what it belongs to"
            self.faults.append(f"the words '{words[:80]}' are not in {where}")
            return None
        number = self.said.get((words, within), 0)
        self.said[words, within] = number + 1
        return self._quoted(places[min(number, len(places) - 1)])

    def _quoted(self, span: Span) -> st.Quote:
        return st.Quote(span.start, span.end, span.excerpt(self.text))


def _is_in(inner: Span, outer: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end


def locate(words: str, text: str) -> list[Span]:
    """Return every place where `words` stand in `text`, whatever the case, the spaces and the signs between them.

    Examples
    --------
    >>> locate("the  ego, stops", "When the ego stops")
    [Span(start=5, end=18)]
    """
    tokens = re.findall(r"\w+", words)
    if not tokens:
        return []
    pattern = r"(?<!\w)" + r"[^\w]{1,4}".join(map(re.escape, tokens)) + r"(?!\w)"
    return [Span(*match.span()) for match in re.finditer(pattern, text, re.IGNORECASE)]
