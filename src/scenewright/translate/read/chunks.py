"""Cuts a text into sentences of typed chunks: people, amounts, places, deeds, links and the rest.

What enters: a text. What leaves: for each sentence its chunks, each with the stretch it came from; a word that is not
of the domain is a chunk of kind `unknown`. It decides nothing about what belongs to what.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from fractions import Fraction
from functools import lru_cache
from importlib.resources import files
from itertools import pairwise

from scenewright.translate.phrases import ORDINALS
from scenewright.translate.story import Amount, Quote
from scenewright.units import UNITS, unit_of_name

_TOKEN = re.compile(
    r"(?P<layout>\n[ \t]*(?=\n|[A-Z][A-Za-z ]{1,24}:)|(?:(?<=\n)|\A)[ \t]*(?:[-*•]|\d{1,2}[.)])[ \t]+)"
    r"|(?P<quoted>(?<![\w'])'[^'\n]+')"
    r"|(?P<number>(?<![\w.])-?\d+(?:\.\d+|/[1-9]\d*)?)"
    r"|\{(?P<braced>[A-Za-z]\w*)\}"
    r"|(?P<snake>[A-Za-z][A-Za-z0-9]*_\w*)"
    r"|(?P<word>[^\W\d_]+(?:[-’'](?!s\b|ve\b|ll\b)[^\W\d_]+)*)"
    r"|(?P<possessive>['’]s\b|['’](?=\s))"
    r"|(?P<short>['’](?:ve|ll)\b)"
    r"|(?P<mark>[.,;:!?()\[\]–—\"“”])"
    r"|(?P<other>\S)"
)
_LINE = re.compile(r"([ \t]*)([-*•]|\d{1,2}[.)])?")  # how a line begins: how far in, and the mark of an item
_LANE = r"[A-Za-z0-9_]+(?:\.-?[A-Za-z0-9_]+)+"
_LANES = re.compile(rf"follows? the lanes ({_LANE}(?:, {_LANE})*)")
_NUMBERS = "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen"
_TENS = "twenty thirty forty fifty sixty"
# "Half a second", "a third of a g", "one and a half metres", as far as a unit follows.
_PART = re.compile(
    r"(?:(\w+) and (?=a\b))?(?:(an?|one|two|three)[ -])?(half|thirds?|quarters?)\b(?: of\b)?(?: an?\b)?", re.IGNORECASE
)
_PARTS = {"half": Fraction(1, 2), "third": Fraction(1, 3), "quarter": Fraction(1, 4)}
_ENDS = ".;!?"
_QUOTES = '"“”'
MARKS = frozenset("123456789ABCDEFGH")  # that tell one "hero 2" or "car B" from others
_TRAITS = ("heading", "relation", "quality", "other", "turn")
_LONG = 8  # letters; of shorter words too many differ from another word by one letter
_SPELLED = 4  # letters; a shorter word is another one, not one that is misspelled, and few slips are the first letter
_LIKE = 0.86  # of two words of so many letters, one slip apart, 7 letters in 8 agree
_SUFFIX = {"m": "_m", "s": "_s", "m/s": "_mps", "m/s^2": "_mpss", "km/h": "_kmph", "mph": "_mph", "ft": "_ft"}


@dataclass(frozen=True, slots=True)
class Chunk:
    """A stretch of a text with what it is: `kind` and `value` are those of the vocabulary."""

    kind: str
    value: str
    start: int
    end: int
    text: str
    amount: Amount | None = None
    traits: tuple[Chunk, ...] = ()  # of somebody: which one, how its way lies
    is_new: bool = False  # "a car", "another car"
    slips: tuple[str, ...] = ()  # the words that it was read with where the text seems to have a slip of the pen

    @property
    def words(self) -> str:
        """The words that it is, however they are written and broken into lines."""
        return " ".join(self.text.lower().split())

    @property
    def dimension(self) -> str:
        """What its amount is one of; nothing where it is none."""
        return "" if self.amount is None else self.amount.dimension

    @property
    def quote(self) -> Quote:
        """Where it came from."""
        return Quote(self.start, self.end, self.text)


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """Phrases by their first word, the longest first; unit words and number words."""

    phrases: dict[str, list[tuple[tuple[str, ...], str, str]]]
    units: dict[str, str]
    numbers: dict[str, Fraction]
    labels: dict[str, str]
    words: frozenset[str]  # all that stand in phrases
    long: tuple[str, ...]
    lookalikes: frozenset[str]  # real words that are never taken for a slip of the pen
    unit_pattern: re.Pattern[str]


@lru_cache(maxsize=1)
def vocabulary() -> Vocabulary:
    """Return the words of the domain."""
    table = tomllib.loads(files("scenewright.translate.read").joinpath("words.toml").read_text(encoding="utf-8"))
    units = {symbol: symbol for symbol in UNITS}
    units |= {word: symbol for symbol, said in table.pop("unit").items() for word in said.split(" | ")}
    numbers = {word: Fraction(number) for number, word in enumerate(_NUMBERS.split())}
    numbers |= {word: Fraction(10 * tens) for tens, word in enumerate(_TENS.split(), start=2)}
    lookalikes = frozenset(table.pop("lookalike")["words"].split())
    labels = {word: kind for kind, said in table.pop("label").items() for word in said.split(" | ")}
    table["ordinal"] = {str(number): f"for the {word} time" for number, word in enumerate(ORDINALS)}
    phrases: dict[str, list[tuple[tuple[str, ...], str, str]]] = {}
    for kind, values in table.items():
        for value, said in values.items():
            for phrase in said.split(" | "):
                for form in _forms(phrase) + ([f"the {phrase}"] if kind == "place" else []):
                    words = tuple(form.split())
                    phrases.setdefault(words[0], []).append((words, kind, value or phrase.lstrip("*")))
    for known in phrases.values():
        known.sort(key=lambda each: -len(each[0]))
    longest = "|".join(map(re.escape, sorted(units, key=len, reverse=True)))
    pattern = re.compile(rf"[\s-]?({longest})(?![\w/^²])", re.IGNORECASE)
    single = frozenset(word for same in phrases.values() for said, _, _ in same for word in said)
    long = tuple(sorted(word for word in single if len(word) >= _LONG))
    return Vocabulary(phrases, units, numbers, labels, single, long, lookalikes, pattern)


_IRREGULAR = {
    "drive": "drove driven", "go": "went gone", "come": "came", "stand": "stood", "begin": "began begun",
    "leave": "left", "get": "got", "keep": "kept", "hold": "held", "make": "made", "take": "took taken",
    "fall": "fell fallen", "mean": "meant", "shrink": "shrank shrunk", "ride": "rode", "run": "ran",
}  # fmt: skip
_DOUBLED = ("stop", "begin", "get", "plan", "slam", "drop", "run")


def _forms(phrase: str) -> list[str]:
    """Return a phrase, and where it is a verb (marked with *) its other forms."""
    if not phrase.startswith("*"):
        return [phrase]
    verb, _, rest = phrase[1:].partition(" ")
    doubled = verb + verb[-1] if verb in _DOUBLED else verb
    carried = f"{verb[:-1]}ie" if verb.endswith("y") and verb[-2] not in "aeiou" else verb  # "carry", "carries"
    third = f"{verb}es" if verb.endswith(("s", "sh", "ch", "x", "o")) else f"{carried}s"
    past = _IRREGULAR.get(verb, f"{carried}d" if carried.endswith("e") else f"{doubled}ed").split()
    now = f"{verb[:-1] if verb.endswith('e') else doubled}ing"
    return [f"{form} {rest}".strip() for form in (verb, third, now, *past)]


def sentences(text: str) -> list[list[Chunk]]:
    """Return the chunks of each sentence of `text`; what means nothing is left out."""
    found: list[list[Chunk]] = [[]]
    for chunk in _chunks(text):
        if chunk.kind == "end":
            if chunk.text == "?":  # a question states nothing
                found[-1].append(replace(chunk, kind="unknown"))
            found.append([])
        else:
            found[-1].append(chunk)
    return [chunks for each in _headed([each for each in found if each], text) if (chunks := _described(each))]


@dataclass(slots=True)
class _Heading:
    """A label alone on its line; what it says is said of each item of the list below it."""

    label: list[Chunk]
    depth: int
    items: list[list[Chunk]] = field(default_factory=list)
    inner: _Heading | None = None  # an item that heads a list of its own

    def take(self, said: list[Chunk], depth: int) -> None:
        """Take what an item says, as said of whom the headings above it name."""
        self.inner = self.inner if self.inner is not None and self.inner.depth < depth else None
        above = [*self.label, *(self.inner.label if self.inner is not None else ())]
        named = {each for item in self.items for each in item}
        people = [_at(each, said[0]) if each in named else each for each in above if each.kind != "link"]
        opens = next((each for each in said if each.kind not in ("det", "filler", *_TRAITS)), said[0])
        said = said[1:] if people and said[0].value == "it" else said
        self.items.append(said if opens.kind in ("actor", "name") else [*people, *said])

    def sentences(self) -> Iterator[list[Chunk]]:
        """Return a sentence for each item; the items of a moment are one, and so is a heading without any."""
        links = [each for each in self.label if each.kind == "link"]
        if not self.items:
            yield self.label
        elif links and links[0].value == "when":
            found = links
            for item in self.items:
                joint = _at(Chunk("joint", "and", 0, 0, "and"), item[0])
                found = [*found, *([joint] if found != links else []), *_without_when(links, item)]
            yield found
        else:
            for item in self.items:
                yield [*(_at(each, item[0]) for each in links), *item]


def _at(chunk: Chunk, where: Chunk) -> Chunk:
    """Return a chunk as one that says the same right before another one, where it is not written."""
    return replace(chunk, start=where.start, end=where.start)


def _headed(found: list[list[Chunk]], text: str) -> Iterator[list[Chunk]]:
    """Give what labels say to what they stand in front of, or above."""
    heading: _Heading | None = None
    for chunks in found:
        label, said = _labelled(chunks)
        line = _LINE.match(text, text.rfind("\n", 0, chunks[0].start) + 1)
        depth = len(line[1]) + (line[2] is not None) if line is not None else 0
        if heading is not None and depth > heading.depth and not any(each.kind == "link" for each in label or ()):
            if said:
                heading.take([*(label or ()), *said], depth)
            else:
                heading.inner = _Heading(label or [], depth)
            continue
        if heading is not None:
            yield from heading.sentences()
        heading = None if said else _Heading(label or [], depth)
        if heading is None:
            yield [*(label or ()), *said]
    if heading is not None:
        yield from heading.sentences()


def _labelled(chunks: list[Chunk]) -> tuple[list[Chunk] | None, list[Chunk]]:
    """Return what a label in front of a colon says (whom, when, or nothing, ``Action: ...``), and what is behind it."""
    colon = next((number for number, each in enumerate(chunks[:6]) if each.text == ":"), 0)
    if not colon:
        return None, chunks
    people = [each for each in chunks[:colon] if each.kind == "actor"]
    words = " ".join(each.text.lower() for each in chunks[:colon] if each.kind not in ("actor", "filler", "possessive"))
    kind = vocabulary().labels.get(words)
    if kind is None and (words or not people):
        return None, chunks
    first = [replace(chunks[0], kind="link", value=kind)] if kind in ("when", "start", "then") else []
    return [*people, *first], _without_when(first, chunks[colon + 1 :])


def _without_when(links: list[Chunk], said: list[Chunk]) -> list[Chunk]:
    """Return what is said under a label without a "when" that the label has said."""
    return said[1:] if [each.value for each in (*links[:1], *said[:1])] == ["when", "when"] else said


def _described(chunks: list[Chunk]) -> list[Chunk]:
    """Give somebody the words that describe it, and leave out what means nothing: ``an oncoming red car``."""
    found: list[Chunk] = []
    for chunk in _ranged(chunks):
        if chunk.kind == "actor":
            first = len(found)
            while first and found[first - 1].kind in _TRAITS:
                first -= 1
            does = found[first - 1] if first > 1 and found[first - 2].kind == "det" else chunk
            how = (does.kind == "deed" or does.value == "drives") and does.words not in ("waiting", "approaching")
            if how and not does.words.endswith("ed"):  # "a slow truck": how slow, or since when, nothing here knows
                found[first - 1] = replace(does, kind="share")
            is_new = first > 0 and (found[first - 1].kind, found[first - 1].value) == ("det", "a")
            chunk = replace(chunk, traits=tuple(found[first:]), is_new=is_new)
            del found[first - is_new :]
        if chunk.text in MARKS and found and found[-1].kind == "actor" and found[-1].value != "ego":  # "hero 2"
            traits = (*found[-1].traits, replace(chunk, kind="quality"))
            chunk = replace(found.pop(), end=chunk.end, traits=traits)
        if chunk.kind == "name" and found and found[-1].kind == "actor":  # "the car 'blue'"
            chunk = replace(chunk, traits=(found.pop(),))
        found.append(chunk)
    if found and found[0].words == "as" and any(each.kind == "actor" for each in found[1:3]):
        found[0] = replace(found[0], kind="link", value="when")  # "as the ego turns left, ..."
    another = {each for each in found if (each.kind, each.value) == ("det", "a") and len(each.text) > 2}
    for at, (before, each) in enumerate(pairwise(found), 1):
        if before.text == "in" and (each.kind == "bound" or each.amount is not None):
            found[at - 1] = replace(before, kind="side", value="in")  # "brakes to a stop in 4 s"
        if each.words == "there" and before.kind in ("deed", "event", "standstill", "state", "amount"):
            found[at] = replace(each, kind="there")  # "stops there": where that is, nothing here knows
        meant = (before.words, each.kind) in (("having", "deed"), ("having", "event"), ("left", "area"))
        how = before.kind == "harmless" and each.kind == "side" and any(e.kind == "place" for e in found[at : at + 3])
        if meant or (how and each.value == "behind") or (before.kind, each.value) == ("harmless", "after"):
            found[at - 1] = replace(before, kind="share")  # "having passed it", "left lane", "directly after it stops"
        if (before.kind, each.kind) == ("det", "quality"):  # "the first brakes": the first of whom, nothing here knows
            found[at] = replace(each, kind="share")
    for at, each in enumerate(found):
        if each.kind == "or bound" and found[at - 1].kind == "amount":  # "5 m/s or more"
            found[at - 1 : at + 1] = [_at(replace(each, kind="bound"), found[at - 1]), found[at - 1]]
    kept = [each for each in found if each in another or each.kind not in ("filler", "det")]
    return [replace(each, kind="unknown") if each in another else each for each in kept]  # "another stop line"


def _ranged(chunks: list[Chunk]) -> list[Chunk]:
    """Say "20-25 m" and "between 20 m and 25 m" as at least 20 m and at most 25 m; "from 20 to 25 m" is a change."""
    found = [*chunks]
    for at in range(len(chunks) - 3, -1, -1):
        low, joint, high = found[at : at + 3]
        lead, own, top = found[at - 1].value if at else "", low.amount, high.amount
        if low.kind == "no unit" and top is not None and low.value[0].isdigit():
            own = replace(top, value=Fraction(low.value), quote=low.quote)
        if own is None or top is None or own.dimension != top.dimension:
            continue
        is_between, goes_to = (lead, joint.value) == ("between", "and"), low.amount is None and joint.value == "to"
        if goes_to and lead == "from":
            found[at] = replace(low, kind="amount", amount=own)
        elif (is_between or goes_to or joint.text in tuple("-–—")) and (not own.si or not top.si or own.si < top.si):
            found[at - is_between : at + 3] = [
                replace(low, kind="bound", value=">="), replace(low, kind="amount", amount=own),
                replace(joint, kind="joint", value="and"), replace(joint, kind="bound", value="<="), high,
            ]  # fmt: skip
    return found


def _chunks(text: str) -> Iterator[Chunk]:
    tokens = list(_TOKEN.finditer(text))
    words = [token.group().lower() for token in tokens]
    slips = {at: right for at, token in enumerate(tokens) if token["word"] and (right := corrected(words[at]))}
    words = [slips.get(at, word) for at, word in enumerate(words)]
    end = 0
    for index, token in enumerate(tokens):
        if token.start() >= end:
            chunk = _lanes(text, token.start()) or _part(text, token) or _amount(text, token)
            chunk = chunk or _phrase(text, tokens, words, index) or _plain(token)
            end = chunk.end
            slipped = [each for at, each in slips.items() if chunk.start <= tokens[at].start() < end]
            yield replace(chunk, slips=tuple(slipped)) if slipped else chunk


def _lanes(text: str, at: int) -> Chunk | None:
    match = _LANES.match(text, at)
    return None if match is None else Chunk("lanes", match[1], at, match.end(), match[0])


def _part(text: str, token: re.Match[str]) -> Chunk | None:
    """Return a part of a unit as an amount: "half a second"; None where it is none of a unit: "half as fast"."""
    known = vocabulary()
    match = _PART.match(text, token.start())
    unit = None if match is None else known.unit_pattern.match(text, match.end())
    if match is None or unit is None:
        return None
    whole, count, part = (each and each.lower() for each in match.groups())
    number = Fraction(whole) if whole and whole.isdigit() else known.numbers.get(whole or "zero")
    if number is None or (part != "half" and count is None):  # "the third m"
        return None
    number += known.numbers.get(count or "", Fraction(1)) * _PARTS[part.removesuffix("s")]
    symbol = known.units[unit[1].lower() if unit[1].lower() in known.units else unit[1]]
    quote = Quote(match.start(), unit.end(), text[match.start() : unit.end()])
    return Chunk("amount", str(number), quote.start, quote.end, quote.text, Amount(number, symbol, None, quote))


def _amount(text: str, match: re.Match[str]) -> Chunk | None:
    """Return a number, a number word or a parameter, with its unit."""
    known = vocabulary()
    name = match["braced"] or match["snake"]
    number = match["number"] or known.numbers.get((match["word"] or "").lower())
    unit = known.unit_pattern.match(text, match.end())
    symbol = None if unit is None else known.units[unit[1].lower() if unit[1].lower() in known.units else unit[1]]
    if not name and (number is None or (match["word"] and symbol is None)):
        return None  # "one" of them
    own = None if symbol is None else UNITS[symbol]
    if name:
        told, own = own, unit_of_name(name)
        if own is None and symbol in _SUFFIX:
            name, own = name + _SUFFIX[symbol], told
        own = None if own is None or (told is not None and told.dimension != own.dimension) else own
    quote = Quote(match.start(), end := (unit or match).end(), text[match.start() : end])
    amount = None if own is None else Amount(None if name else Fraction(number or 0), own.symbol, name, quote)
    return Chunk("no unit" if amount is None else "amount", name or str(number), quote.start, end, quote.text, amount)


def _phrase(text: str, tokens: list[re.Match[str]], said: list[str], index: int) -> Chunk | None:
    """Return the longest phrase of the domain that begins here."""
    if tokens[index]["word"] is None and tokens[index]["short"] is None:
        return None
    for words, kind, value in vocabulary().phrases.get(said[index], ()):
        last = index + len(words) - 1
        if tuple(said[index : last + 1]) != words:
            continue
        after = said[last + 1] if last + 1 < len(said) else ""
        where = after == "of" if words[-1] == "start" else words[-1] == "on" and after in ("the", "a")
        if len(words) == 1 or not where:  # "drives on the road", "at the start of the turn" say where
            start, end = tokens[index].start(), tokens[last].end()
            return Chunk(kind, value, start, end, text[start:end])
    return None


def _plain(token: re.Match[str]) -> Chunk:
    (start, end), said = token.span(), token.group()
    if token["quoted"]:
        return Chunk("name", said[1:-1], start, end, said)
    mark = "end" if token["layout"] or said in _ENDS else "filler" if said in _QUOTES else "comma"
    other = "possessive" if token["possessive"] else "unknown"
    return Chunk(mark if token["mark"] or token["layout"] else other, said, start, end, said)


def corrected(word: str) -> str | None:
    """Return the long word of the domain that an unknown one is taken for; None where it may be a word of its own."""
    known = vocabulary()
    if len(word) < _LONG - 1 or word in known.words or word in known.lookalikes:
        return None
    return next(iter(get_close_matches(word, known.long, 1, _LIKE)), None)


def nearest_words(word: str) -> list[str]:
    """Return the words of the domain that are spelled most like `word`."""
    single = {words[0] for known in vocabulary().phrases.values() for words, _, _ in known if len(words) == 1}
    alike = [each for each in sorted(single) if each[0] == word[0].lower()]
    return get_close_matches(word.lower(), alike, n=2, cutoff=0.7) if len(word) >= _SPELLED else []


def word_as(chunk: Chunk, word: str) -> Chunk:
    """Return `chunk` as what another word is."""
    kind, value = next((kind, value) for words, kind, value in vocabulary().phrases[word] if words == (word,))
    return replace(chunk, kind=kind, value=value)
