"""The form of a reply: the story with names for numbers and quoted words for positions, made from its own dataclasses.

What enters: the text of a reply. What leaves: its JSON schema; a `Claim`, which is a `Story` with the stretches of the
text that its parts quote; or a `TranslationError` that can go back to the model. Whether the words say so is for
`evidence` to find out.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cache
from importlib.resources import files
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, create_model

from scenewright.errors import Span, TranslationError
from scenewright.program.types import AreaKind, Parameter
from scenewright.translate import story as st
from scenewright.translate.compile import COMPASS, DRIVEN, TURNS
from scenewright.translate.model.exchange import CUT_OFF, LONGEST_REPLY
from scenewright.translate.phrases import PLACES
from scenewright.translate.ways import BEARINGS
from scenewright.units import DIGITS, UNITS, is_size_of_a_scenario, unit_of_name

# Far more than any test needs; a reply that holds more is a flood.
MOST_ENTRIES = 100
LONGEST_WORDS = 2_000  # characters
DEEPEST = 3  # conditions in conditions; the teller has words for no more
PEOPLE = ("actor", "other", "of", "partner")  # slots that are numbers of actors; all other numbers are of moments
# Ours to say, or found by the program: a reply could name any file as its map, or let anything pass as a standstill.
OURS: dict[Any, set[str]] = {
    st.Story: {"manner", "map_name", "title"}, st.Actor: {"id", "quote"}, st.Moment: {"quote"},
    st.Compound: {"quote"}, Parameter: {"span"},
}  # fmt: skip
# Slots of any text, and the words that they may be; in the latter a word that no program knows is refused by its name.
_WORDS: dict[tuple[Any, str], Any] = {
    (st.Amount, "unit"): Literal[tuple(UNITS)], (st.Place, "name"): Literal[tuple(PLACES)],
    (st.Way, "heading"): Literal[tuple(COMPASS)], (st.Way, "destination_heading"): Literal[tuple(COMPASS)],
    (st.Way, "turn"): Literal[tuple(TURNS)], (st.Way, "origin"): AreaKind, (st.Way, "destination"): AreaKind,
}  # fmt: skip
KNOWN: dict[tuple[Any, str], tuple[str, ...]] = {
    (st.Actor, "kind"): DRIVEN, (st.Deed, "verb"): tuple(st.Verb), (st.Relation, "kind"): tuple(BEARINGS),
}  # fmt: skip


def _plain(value: object) -> object:
    """Return a text without characters that could steer a terminal; a number as a text."""
    if isinstance(value, str):
        return "".join(c if c.isprintable() else " " for c in value).strip()[:LONGEST_WORDS]
    return str(value) if isinstance(value, int | float) and not isinstance(value, bool) else value


def _fraction(digits: str) -> Fraction:
    # No exponents: their exact value could fill the memory.
    plain = len(digits) <= DIGITS and re.fullmatch(r"-?[0-9]+(\.[0-9]+|/0*[1-9][0-9]*)?", digits)
    if not plain or not is_size_of_a_scenario(Fraction(digits)):
        raise ValueError(f"'{digits[:DIGITS]}' is no number in digits of a size that a test has")
    return Fraction(digits)


Words = Annotated[str, BeforeValidator(_plain)]
Digits = Annotated[Words, AfterValidator(_fraction)]
_Slots = Mapping[str, tuple[Any, Any]]
_MORE: dict[Any, _Slots] = {
    st.Actor: {"called": (list[Words], ...)}, st.Moment: {"name": (Words, ...)}, st.Way: {"words": (Words, "")},
}  # fmt: skip
_hints: Any = cache(get_type_hints)


@cache
def descriptions() -> dict[str, dict[str, str]]:
    """Return what each slot means, by form and name."""
    return tomllib.loads(files(__package__ or "").joinpath("slots.toml").read_text(encoding="utf-8"))


def _made(name: str, slots: _Slots) -> Any:
    told, made = descriptions().get(name.rstrip("0123456789"), {}), dict[str, Any]()
    for slot, (kind, default) in slots.items():
        origin: Any = get_origin(kind)
        most = MOST_ENTRIES if origin is list else None
        made[slot] = (kind, Field(default, description=told.get(slot), max_length=most))
    return create_model(name, __config__=ConfigDict(extra="forbid"), **made)


@cache
def form_of(cls: Any, depth: int = DEEPEST) -> Any:
    """Return the form for a dataclass of the story; `depth` says how many conditions may lie in each other."""
    slots: dict[str, tuple[Any, Any]] = dict(_MORE.get(cls, {}))
    for each in fields(cls):
        hint = _hints(cls)[each.name]
        default: Any = None if type(None) in get_args(hint) else ...
        if each.default is not MISSING and not is_dataclass(each.default):
            default = [] if each.default == () else each.default
        if each.name == "quote" and "quote" not in OURS.get(cls, ()):
            slots["words"] = (Words, "")
        elif each.name not in OURS.get(cls, ()):
            slots[each.name] = (_kind(hint, depth - (cls is st.Compound), (cls, each.name)), default)
    if cls is st.Story:
        slots |= {"asides": (list[Words], []), "assumptions": (list[Assumption], [])}
    if cls is st.Question:
        slots["default"] = (Words | None, None)
    return _made(cls.__name__ + (str(depth) if cls is st.Compound else ""), slots)


def _kind(hint: Any, depth: int, slot: tuple[Any, str]) -> Any:
    """Return what stands in a reply for a type of the story."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        return Union[tuple(_kind(each, depth, slot) for each in parts if each is not st.Compound or depth > 0)]  # noqa: UP007
    if origin is tuple:
        return list[_kind(parts[0], depth, slot)]  # type: ignore[misc]
    if hint in (str, int, Fraction):  # numbers of actors and moments are names; a number is written in digits
        return Digits if hint is Fraction else _WORDS.get(slot, Words)
    return form_of(hint, depth) if hasattr(hint, "__dataclass_fields__") else hint


Assumption: Any = _made("Assumption", {"words": (Words, ""), "says": (Words, ...)})
_READING: Any = _made("Reading", {"words": (Words, ...), "means": (Words, ...)})
_REFUSAL: Any = _made("Refusal", {"reason": (Words, ...), "words": (Words, ""), "fix": (Words, "")})
_SLOTS: _Slots = {"readings": (list[_READING], []), "refusal": (_REFUSAL | None, None)}
Reply: type[BaseModel] = _made("Reply", {**_SLOTS, "story": (form_of(st.Story) | None, None)})


def reply_schema() -> dict[str, Any]:
    """Return the JSON schema of a reply."""
    return Reply.model_json_schema()


def sheet() -> str:
    """Return the form of a reply as lines of text: each part with its slots, what may stand there and what it means."""
    parts = (Reply, _READING, _REFUSAL, st.Story, Assumption, st.Question, st.Actor, st.Way, st.Relation, st.Moment,
             st.Measure, st.Amount, st.Place, st.Compound, st.Deed, st.Order, st.Hold, st.Point, Parameter)  # fmt: skip
    lines: list[str] = []
    part: Any
    for part in parts:
        form: Any = form_of(part) if hasattr(part, "__dataclass_fields__") else part
        lines.append(f"\n{part.__name__}")
        for name, slot in form.model_fields.items():
            words = [json.dumps(word) for word in KNOWN.get((part, name), ())] or [_shown(slot.annotation)]
            lines.append(f"- {name}: {' | '.join(words)}. {slot.description or ''}".rstrip())
    return "\n".join(lines).strip()


def _shown(kind: Any) -> str:
    """Return a type in the words of the sheet."""
    origin, parts = get_origin(kind), get_args(kind)
    if origin is list:
        return f"[{_shown(parts[0])}, ...]"
    if origin is Literal or (isinstance(kind, type) and issubclass(kind, StrEnum)):
        return " | ".join(json.dumps(each) for each in parts or tuple(kind))
    if parts:
        return " | ".join(dict.fromkeys(_shown(each) for each in (parts[:1] if origin is Annotated else parts)))
    names: dict[Any, str] = {str: "text", bool: "true | false", type(None): "null"}
    return names.get(kind) or str(kind.__name__).rstrip("0123456789")


# -- reading --------------------------------------------------------------------------------------------------------
def read_reply(text: str) -> Any:
    """Read the one JSON object in `text`; what stands around it (a code fence, a greeting) does no harm.

    Raises TranslationError where there is none, or it is not of the form.

    Examples
    --------
    >>> read_reply('Here you are: {"refusal": {"reason": "It is a recipe."}}').refusal.reason
    'It is a recipe.'
    """
    if len(text) > LONGEST_REPLY or text.endswith(CUT_OFF):
        most = f"one JSON object of at most {LONGEST_REPLY} characters and --max-tokens tokens, readings in a few words"
        raise TranslationError("the reply is too long, or cut off", found=f"{len(text)} characters", expected=most)
    try:
        reply: Any = Reply.model_validate(_object_in(text))
    except ValidationError as error:
        told = [f"{'.'.join(map(str, each['loc']))}: {each['msg']}" for each in error.errors(include_url=False)[:4]]
        form = "the slots of the form, and no others"
        raise TranslationError("the reply is not of the form asked for", found="; ".join(told), expected=form) from None
    if (reply.story is None) == (reply.refusal is None):
        raise TranslationError("the reply holds neither or both of story and refusal", expected="one of both")
    return reply


def _object_in(text: str) -> object:
    begins = str(_plain(text[:160]))
    fault = f"no JSON object; it begins: {begins}" if begins else "an empty reply"
    for match in list(re.finditer(r"\{", text))[:50]:
        try:
            value, _ = json.JSONDecoder().raw_decode(text, match.start())
            if value.keys() & Reply.model_fields.keys():
                return value
        except json.JSONDecodeError as error:
            fault = f"no JSON object: {error.msg} at character {error.pos}; it begins: {begins}"
        except (RecursionError, ValueError):
            fault = "an object or a number without end"
            break
    raise TranslationError("the reply holds no JSON object that can be read", found=fault, expected="one JSON object")


# -- from names and words to numbers and positions ------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Claim:
    """A story as a reply claims it, with what it quotes beside the quotes of the story itself."""

    story: st.Story
    called: Mapping[int, Sequence[str]] = field(default_factory=dict)  # by actor, the words by which the text names it
    ways: Mapping[int, st.Quote] = field(default_factory=dict)  # by actor, the stretch that tells its way
    owned: Sequence[tuple[Span | None, str]] = ()  # what assumptions and questions quote and say
    read: Sequence[Span] = ()  # the stretches of the readings


def claim_of(reply: Any, text: str) -> Claim:
    """Return what a reply claims; raises TranslationError where a name is nobody's, or words are not in `text`."""
    form, reader = reply.story, _Reader(text, reply.story)
    story = reader.part(form)
    ways = {number: quote for number, each in enumerate(form.actors) if (quote := reader.quote(each.way.words))}
    said = [(each.words, each.says) for each in form.assumptions]
    said += [(each.words, f"{each.text} {' '.join(each.alternatives)}") for each in form.questions]
    owned = [(quote.span if (quote := reader.quote(words)) else None, says) for words, says in said]
    read = [quote.span for each in reply.readings if (quote := reader.quote(each.words))]
    if reader.faults:
        raise TranslationError(
            "the story does not hold together",
            found="; ".join(dict.fromkeys(reader.faults)),
            expected="names that are given in `actors` and `moments`, words copied letter by letter",
        )
    return Claim(story, {number: each.called for number, each in enumerate(form.actors)}, ways, owned, read)


@dataclass(slots=True)
class _Reader:
    text: str
    form: Any
    names: dict[str, list[str]] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)
    said: dict[tuple[str, Span | None], int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if all(each.name != "start" for each in self.form.moments):
            self.form.moments.insert(0, form_of(st.Moment)(name="start"))
        for what, forms, first in (("actor", self.form.actors, "ego"), ("moment", self.form.moments, "start")):
            names = self.names[what] = [each.name for each in forms]
            if len(set(names)) < len(names) or names[:1] != [first]:
                self.faults.append(f"each {what} has a name of its own, and '{first}' is the first: {', '.join(names)}")

    def part(self, form: Any, within: Span | None = None) -> Any:
        """Return the part of the story that a form fills; `within` is the stretch that an amount is quoted from."""
        cls: Any = getattr(st, type(form).__name__.rstrip("0123456789"))
        slots, made = [each.name for each in fields(cls) if each.name not in OURS.get(cls, ())], dict[str, Any]()
        if "quote" in slots:
            made["quote"] = self.quote(form.words, within if cls is st.Amount else None)
        inner = quote.span if (quote := made.get("quote")) else None
        if cls is st.Actor:
            made |= {"id": self.names["actor"].index(form.name), "quote": self._mention(form.called)}
        if cls is st.Question:
            made["default"] = self._default(form)
        if cls is st.Amount:
            self._check_amount(form)
        filled = {slot: self._value(getattr(form, slot), slot, _hints(cls)[slot], inner) for slot in slots
                  if slot not in made}  # fmt: skip
        return cls(**made, **filled)

    def _value(self, value: Any, slot: str, hint: Any, within: Span | None) -> Any:
        if isinstance(value, list):
            return tuple(self._value(each, slot, hint, within) for each in value)
        if isinstance(value, Assumption):
            return value.says
        if isinstance(value, BaseModel):
            return self.part(value, within)
        if st.Quote in get_args(hint):
            return self.quote(value)
        if value is None or int not in (hint, *get_args(hint)):
            return value
        what = "actor" if slot in PEOPLE else "moment"
        if value not in self.names[what]:
            self.faults.append(f"there is no {what} '{value}' ({slot}); there are: {', '.join(self.names[what])}")
            return 0
        return self.names[what].index(value)

    def _check_amount(self, form: Any) -> None:
        unit = unit_of_name(form.name or "")
        if (form.name is None) == (form.value is None):
            self.faults.append("an amount has either a value or the name of a parameter")
        elif form.name is not None and (unit is None or unit.symbol != form.unit):
            ends = f"it is {unit.symbol}" if unit else "it ends in none; ask for it, or refuse"
            self.faults.append(f"'{form.unit}' is not the unit that the parameter {form.name} ends in: {ends}")

    def _default(self, form: Any) -> int | None:
        if len(form.alternatives) < 2 or form.default not in (None, *form.alternatives):
            self.faults.append(f"the question '{form.slot}' needs two alternatives, its default among them")
            return None
        return None if form.default is None else int(form.alternatives.index(form.default))

    def _mention(self, names: Sequence[str]) -> st.Quote | None:
        """Return where the text first names an actor."""
        self.faults += [f"nobody is called '{name}' in the text" for name in names if not locate(name, self.text)]
        found = sorted((span.start, span.end) for name in names for span in locate(name, self.text))
        return st.Quote(*found[0], self.text[slice(*found[0])]) if found else None

    def quote(self, words: str, within: Span | None = None) -> st.Quote | None:
        """Return the stretch that is quoted; words that stand there more than once are taken in turn."""
        if not words:
            return None
        places = [each for each in locate(words, self.text)
                  if not within or (within.start <= each.start and each.end <= within.end)]  # fmt: skip
        if not places:
            where = "the text" if within is None else f"'{within.excerpt(self.text)}', the words of what it belongs to"
            self.faults.append(f"the words '{words[:80]}' are not in {where}")
            return None
        number = self.said.get((words, within), 0)
        self.said[words, within] = number + 1
        span = places[min(number, len(places) - 1)]
        return st.Quote(span.start, span.end, span.excerpt(self.text))


def locate(words: str, text: str) -> list[Span]:
    """Return every place where `words` stand in `text`, whatever the case, the spaces and the signs between them.

    Examples
    --------
    >>> locate("the  ego, stops", "When the ego stops")
    [Span(start=5, end=18)]
    """
    tokens = re.findall(r"\w+", words)
    pattern = r"(?<!\w)" + r"[^\w]{1,4}".join(map(re.escape, tokens)) + r"(?!\w)"
    return [Span(*match.span()) for match in re.finditer(pattern, text, re.IGNORECASE)] if tokens else []
