"""Cuts a description into tagged tokens with spans: words and phrases, quantities with units, stops.

What enters: the description. What leaves: a list of `Token`. Words that the lexicon does not know are corrected where
they are a slip of exactly one known word, else tagged ``unknown`` (`refuse_unknown` names them). Numbers without a unit
and quantities whose units contradict each other are refused here, with their place. No grammar is applied.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache

from scenewright.errors import Place, Span, TranslationError, UnknownWordsError
from scenewright.program.expressions import Number, ParameterRef
from scenewright.translate.contractions import short_verb
from scenewright.translate.lexicon import Lexicon, load_lexicon
from scenewright.translate.numerals import number_in_words, tail
from scenewright.translate.spelling import correction, suggestions
from scenewright.units import UNITS, Dimension, Unit, unit_of_name

PARAMETER = r"[A-Za-z][A-Za-z0-9]*(?:\\?_[A-Za-z0-9]+)+"
END_OF_SENTENCE = "\v"  # ends a sentence where a text has no full stop
_RAW = re.compile(
    rf"""(?P<ie>\b(?:i\.e\.|e\.g\.),?)
    |(?P<wrt>\b[wW]\.?r\.?t\b\.?)
    |(?P<zero>\b(?:[Aa]t\s+)?[tT]\s*=\s*0(?:\.0)?(?:\s*s(?:ec)?)?(?![\w.]))
    |(?P<braced>\{{\s*{PARAMETER}\s*\}})
    |(?P<parameter>{PARAMETER})
    |(?P<number>(?<![\w.])[+\-−]?(?:\d+(?:,\d+)*(?:\.\d+)?|\.\d+)(?:/\d+)?)
    |(?P<instant>\bt_?[01]\b|\bt\s*=\s*(?:t_?)?0(?:\s*s)?\b|\bv_?0\b|\bv\(0\))
    |(?P<word>[^\W\d_]+?n['’]t\b|['’](?:ll|re|ve|d|m)\b|[^\W\d_]+)
    |(?P<genitive>['’]s\b|(?<=s)['’](?=\s))
    |(?P<title>(?:(?<=\n)|^)[ \t]*\#+[^\n]*(?:\n|$))
    |(?P<mark>\*\*+|`+|__+)
    |(?P<stop>(?:[.;!?]+|…)(?=\s|$|["')\]])|\n[ \t]*(?:[-*•–—](?!\*)|\d+[.)]|\(?\w[.)])[ \t]+|\n[ \t]*\n\s*
      |[ \t]*\v\s*)
    |(?P<label>:|-{{1,2}}>|=>|→|⇒)
    |(?P<comma>[,()\[\]"“”/]|(?<=\s)[-–—](?=\s)|[–—])
    |(?P<compare>[<>≤≥]=?|±|={{1,2}}|~|≈)
    |(?P<both>&(?=\s))
    |(?P<joiner>[-‐‑'’])
    |(?P<space>\s+)
    |(?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)
_LEADING_BULLET = re.compile(r"\s*(?:[-*•–—]|\d+[.)]|\(?[a-zA-Z0-9][.)])\s+")
_LABELLED_LINE = re.compile(r"\n(?=[ \t]*[A-Za-z][A-Za-z ]{0,30}:)")
_GOES_ON = re.compile(
    r"(?:[,:(]|\b(?:the|a|an|of|to|and|or|is|its|from|with|when|before|behind|at|on))$", re.IGNORECASE
)
_LOOKED_AHEAD = 3
_UNIT_END = r"(?![A-Za-z0-9²^/*])"


@dataclass(frozen=True, slots=True)
class Quantity:
    """An amount with its dimension: a literal in SI units, or a parameter."""

    term: Number | ParameterRef
    dimension: Dimension
    span: Span


@dataclass(frozen=True, slots=True)
class Token:
    """One word, known phrase, quantity or stop.

    `tags` maps the word classes it can belong to onto values; `forms` are verb forms. Punctuation has the tags
    ``end``, ``comma``, ``colon`` or ``genitive``. `slips` are the words that were corrected, as (written, read).
    """

    text: str
    span: Span
    tags: Mapping[str, str]
    forms: frozenset[str] = frozenset()
    quantity: Quantity | None = None
    slips: tuple[tuple[str, str], ...] = ()


@dataclass(slots=True)
class _Raw:
    kind: str
    text: str
    span: Span
    written: str | None = None  # where `text` is a correction


@dataclass(slots=True)
class _Tagger:
    text: str
    name: str
    lexicon: Lexicon
    raw: list[_Raw] = field(default_factory=list)

    def place(self, span: Span) -> Place:
        return Place(self.name, self.text, span)


def tokenise(text: str, name: str) -> list[Token]:
    """Cut `text` into tagged tokens, and close it with as many ends of the text as readers look ahead.

    Raises
    ------
    TranslationError
        Where the text is empty or holds a quantity whose unit is missing or contradictory.
    """
    return list(_tokens(text, name))


@lru_cache(maxsize=16)  # several readers ask for the same stretches
def _tokens(text: str, name: str) -> tuple[Token, ...]:
    if not text.strip():
        raise TranslationError(
            "the description is empty",
            place=Place(name),
            expected="a sentence about the ego and one other vehicle",
            fix='for example: "Ego is on the driveway exit and wants to turn right. ..."',
        )
    tagger = _Tagger(text, name, load_lexicon())
    tagger.raw = _spelled_out([_corrected(raw, tagger.lexicon) for raw in _cut(text)], tagger.lexicon)
    tokens: list[Token] = []
    index = 0
    while index < len(tagger.raw):
        index = _next(tagger, index, tokens)
    end = Token("", Span(len(text), len(text)), {"end": "text"})
    return (*tokens, *[end] * _LOOKED_AHEAD)


def _cut(text: str) -> list[_Raw]:
    breaks = {match.start() for match in _LABELLED_LINE.finditer(text)} | _line_ends(text)
    bullet = _LEADING_BULLET.match(text)
    raw: list[_Raw] = []
    for match in _RAW.finditer(text, bullet.end() if bullet else 0):
        kind = match.lastgroup or "other"
        if kind == "mark":
            continue
        if kind == "space":
            if any(position in breaks for position in range(match.start(), match.end())):
                raw.append(_Raw("stop", match.group(), Span(*match.span())))
            continue
        if kind == "instant":  # "t=0", "t_1", "v0": words of their own
            word = re.sub(r".*=.*", "t0", match.group(), flags=re.DOTALL)
            raw.append(_Raw("word", re.sub(r"\W|_", "", word).lower(), Span(*match.span())))
            continue
        raw.append(_Raw(kind, match.group(), Span(*match.span())))
    return raw


def _line_ends(text: str) -> set[int]:
    """Return where lines end that are sentences without a full stop: each line begins anew, none is broken off."""
    lines = [line.strip() for line in text.split("\n") if line.strip()]
    if len(lines) < 2 or not all(line[0].isupper() or not line[0].isalpha() for line in lines):
        return set()
    return {
        match.start()
        for match in re.finditer(r"\n(?=[ \t]*[A-Z])", text)
        if not _GOES_ON.search(text[: match.start()].rstrip())
    }


def _corrected(raw: _Raw, lexicon: Lexicon) -> _Raw:
    """Return `raw` with a slip of the pen corrected."""
    word = raw.text.lower().replace("’", "'")
    if raw.kind != "word" or word in lexicon.words or word in lexicon.units:
        return raw
    better = correction(word, lexicon.words)
    return _Raw(raw.kind, better, raw.span, raw.text) if better else raw


def _spelled_out(raws: list[_Raw], lexicon: Lexicon) -> list[_Raw]:
    """Let "it's about to" be "it is about to", where a known phrase begins with "is", and "let's" be one word."""
    read: list[_Raw] = []
    for index, raw in enumerate(raws):
        before = read[-1] if read and read[-1].kind == "word" else None
        following = [each.text.lower() for each in raws[index + 1 : index + 6] if each.kind == "word"]
        if raw.kind != "genitive" or before is None or not following:
            read.append(raw)
        elif before.text.lower() == "let":
            read[-1] = _Raw("word", f"{before.text}'s", before.span.union(raw.span))
        elif short := short_verb(before.text.lower(), following, lexicon):
            read.append(_Raw("word", short, raw.span))
        else:
            read.append(raw)
    return read


def _next(tagger: _Tagger, index: int, tokens: list[Token]) -> int:
    raw = tagger.raw[index]
    if raw.kind in ("number", "braced", "parameter"):
        return _quantity(tagger, index, tokens)
    if raw.kind == "joiner":
        return index + 1
    if raw.kind in ("stop", "comma", "label", "genitive"):
        tag = {"stop": "end", "comma": "comma", "label": "colon", "genitive": "genitive"}[raw.kind]
        tokens.append(Token(raw.text, raw.span, {tag: raw.text.strip()}))
        return index + 1
    if raw.kind == "zero":
        tokens.append(Token(raw.text, raw.span, {"adverb": "initially"}))
        return index + 1
    if raw.kind == "both":
        tokens.append(Token("and", raw.span, {"link": "and"}))
        return index + 1
    if raw.kind == "wrt":
        tokens.append(Token(raw.text, raw.span, {"preposition": "to"}))
        return index + 1
    if raw.kind == "ie":
        tokens.append(Token(raw.text, raw.span, {"comma": ","}))
        return index + 1
    if raw.kind == "title":
        tokens.append(Token(raw.text.strip(), raw.span, {"comment": "line"}))
        return index + 1
    return _words(tagger, index, tokens)


def _word_run(tagger: _Tagger, index: int) -> tuple[list[str], list[int]]:
    """Return the words from `index` on, joined across hyphens, and the raw index after each."""
    words: list[str] = []
    ends: list[int] = []
    while index < len(tagger.raw) and len(words) < tagger.lexicon.longest + 1:
        raw = tagger.raw[index]
        if raw.kind in ("word", "compare"):
            words.append(raw.text.lower().replace("’", "'"))
            ends.append(index + 1)
        elif raw.kind != "joiner" or not words:
            break
        index += 1
    return words, ends


def _words(tagger: _Tagger, index: int, tokens: list[Token]) -> int:
    words, ends = _word_run(tagger, index)
    first = tagger.raw[index]
    if not words:
        tokens.append(Token(first.text, first.span, {"unknown": first.text}))
        return index + 1
    length, tags, forms = tagger.lexicon.lookup(words, 0)
    fresh = not tokens or bool(tokens[-1].tags.keys() & {"end", "colon"})
    if tags.get("comment") == "sentence" and len(tags) == 1 and not fresh:  # "the car on the road is westbound"
        length, tags, forms = tagger.lexicon.lookup(words[: length - 1], 0)
    if (
        length > 1
        and "ego" not in tags
        and "ego" in tagger.lexicon.entries.get(tuple(words[length - 1 : length + 1]), {})
    ):
        length, tags, forms = tagger.lexicon.lookup(words[: length - 1], 0)  # "in the test car" is "in", "the test car"
    if length > 1 and words[length - 1] == "one" and _begins_amount(tagger, words, ends, length - 1):
        # "the ego one and a half seconds from it" is no "ego one"
        length, tags, forms = tagger.lexicon.lookup(words[: length - 1], 0)
    if length > 1 and "link" in tags and _is_place_after(tagger, words, length, tokens):
        # "3 m after the stop line" is no "after the stop"
        length, tags, forms = tagger.lexicon.lookup(words[: length - 1], 0)
    if length < 2 and (after := _number_in_words(tagger, index, words, ends, tokens)):
        return after
    if not length:
        tokens.append(Token(first.text, first.span, {"unknown": first.text}))
        return index + 1
    used = tagger.raw[index : ends[length - 1]]
    span = first.span.union(used[-1].span)
    if "determiner" in tags and tokens and tokens[-1].text.lower() == words[0] and length == 1:
        return ends[0]  # a slip of the pen: "behind the the conflict point"
    slips = tuple((raw.written, raw.text) for raw in used if raw.written is not None)
    text = " ".join(raw.text for raw in used if raw.kind != "joiner")
    tokens.append(Token(text, span, tags, forms, slips=slips))
    return ends[length - 1]


def _begins_amount(tagger: _Tagger, words: list[str], ends: list[int], at: int) -> bool:
    """Whether an amount in words begins here: "one and a half seconds"."""
    found = number_in_words(words, at, tagger.lexicon.numbers)
    return found is not None and _unit(tagger, ends[at + found[1] - 1], strict=False)[0] is not None


def _is_place_after(tagger: _Tagger, words: list[str], length: int, tokens: list[Token]) -> bool:
    """Whether a linking phrase ends within a place: "after the stop" in "after the stop line"."""
    if "landmark" in tagger.lexicon.entries.get(tuple(words[length - 1 : length + 1]), {}):
        return True
    measured = bool(tokens) and tokens[-1].quantity is not None
    return (
        measured
        and words[length - 1] in ("that", "this", "the")
        and words[length : length + 1] in (["point"], ["line"])
    )


def _number_in_words(tagger: _Tagger, index: int, words: list[str], ends: list[int], tokens: list[Token]) -> int | None:
    """Read "twelve metres", "half a second", "a second and a half"; None where it is no amount."""
    found = number_in_words(words, 0, tagger.lexicon.numbers)
    if found is None:
        if words[0] == "a" and len(words) > 3 and words[1] in ("second", "metre", "meter") and tail(words, 2):
            found = Fraction(1), 1  # "a second and a half"
        else:
            return None
    value, used = found
    span = tagger.raw[index].span.union(tagger.raw[ends[used - 1] - 1].span)
    unit, after = _unit(tagger, ends[used - 1], strict=False)
    if unit is None:
        if value == 1 and used == 1 and len(words) > 1:  # "one car"
            tokens.append(Token(words[0], span, {"determiner": "indefinite"}))
            return ends[0]
        if used == 1 and "stop_noun" in tagger.lexicon.entries.get((words[0],), {}):
            return None  # "brakes to zero"
        tokens.append(Token(" ".join(words[:used]), span, {"bare_number": " ".join(words[:used])}))
        return ends[used - 1]
    rest = [raw.text.lower() for raw in tagger.raw[after : after + 4] if raw.kind == "word"]
    if value.denominator == 1 and (more := tail(rest, 0)):
        value, after = value + more[0], after + more[1]
    whole = span.union(tagger.raw[after - 1].span)
    tokens.append(_literal(tagger, value, unit, whole))
    return after


def _quantity(tagger: _Tagger, index: int, tokens: list[Token]) -> int:
    raw = tagger.raw[index]
    unit, after = _unit(tagger, index + 1)
    span = raw.span.union(tagger.raw[after - 1].span)
    if raw.kind == "number":
        written = raw.text
        if unit is not None and re.fullmatch(r"\d{1,3},\d{1,2}", written):
            raw = replace(raw, text=written.replace(",", "."))  # "2,5 s": no thousands have one or two digits
        if "," in raw.text or "/" in raw.text:
            raise TranslationError(
                f"'{raw.text}' can be read in more than one way",
                place=tagger.place(raw.span),
                found=raw.text,
                expected="a number such as 12 or 12.5",
                fix="write a decimal point and no thousands separator",
            )
        if unit is None:
            tokens.append(Token(raw.text, raw.span, {"bare_number": raw.text}))
            return after
        value = Fraction(raw.text.replace("−", "-").lstrip("+"))
        literal = _literal(tagger, value, unit, span)
        tokens.append(literal if raw.text == written else replace(literal, slips=((written, raw.text),)))
    else:
        tokens.append(_parameter(tagger, raw, unit, span))
    return after


def _parameter(tagger: _Tagger, raw: _Raw, unit: Unit | None, span: Span) -> Token:
    name = raw.text.strip("{} \t").replace("\\", "")
    own = unit_of_name(name)
    if own is None:
        raise TranslationError(
            f"the parameter '{name}' does not end in a unit",
            place=tagger.place(raw.span),
            found=name,
            expected="a name that ends in _m, _s, _mps or _mpss",
            fix=f"write {name}_m for metres or {name}_s for seconds",
        )
    if unit is not None and unit.symbol != own.symbol:
        raise TranslationError(
            f"the parameter '{name}' is in {own.symbol}, but the text says {unit.symbol}",
            place=tagger.place(span),
            found=span.excerpt(tagger.text),
            expected=own.symbol,
            fix="use the same unit in the name and after it",
        )
    quantity = Quantity(ParameterRef(name, raw.span), own.dimension, span)
    return Token(span.excerpt(tagger.text), span, {"quantity": own.dimension}, frozenset(), quantity)


def _literal(tagger: _Tagger, value: Fraction, unit: Unit, span: Span) -> Token:
    if value < 0 and unit.dimension != "acceleration":
        raise TranslationError(
            f"a {unit.dimension} cannot be negative here",
            place=tagger.place(span),
            found=span.excerpt(tagger.text),
            expected="a positive amount",
            fix="say 'before' or 'past' a place",
        )
    quantity = Quantity(Number(value * unit.si_factor, span), unit.dimension, span)
    return Token(span.excerpt(tagger.text), span, {"quantity": unit.dimension}, frozenset(), quantity)


def _unit(tagger: _Tagger, index: int, *, strict: bool = True) -> tuple[Unit | None, int]:
    """Read a unit at raw token `index`; return it and the index after it (unchanged where there is none)."""
    if index >= len(tagger.raw):
        return None, index
    start = tagger.raw[index].span.start
    if tagger.raw[index].kind == "joiner" and index + 1 < len(tagger.raw):  # "12-metre"
        index += 1
        start = tagger.raw[index].span.start
    match = _unit_pattern().match(tagger.text, start)
    previous = tagger.raw[index - 1].span.end
    if match is None or start - previous > 3:
        strange = re.compile(r"[A-Za-zµ°%]+(?:[/^*²³0-9]+[A-Za-z0-9²³^]*)+|[°%]|k?g\b").match(tagger.text, start)
        if strange and strict:
            raise TranslationError(
                f"'{strange.group()}' is not a unit that fits here",
                place=tagger.place(Span(*strange.span())),
                found=strange.group(),
                expected="m, ft, km, s, m/s, km/h, mph, m/s^2 or g",
            )
        return None, index if tagger.raw[index - 1].kind != "joiner" else index - 1
    symbol = tagger.lexicon.units[re.sub(r"[\s-]+", " ", match.group().lower())]
    after = index
    while after < len(tagger.raw) and tagger.raw[after].span.start < match.end():
        after += 1
    return UNITS[symbol], after


_PATTERNS: list[re.Pattern[str]] = []


def _unit_pattern() -> re.Pattern[str]:
    if not _PATTERNS:
        spellings = sorted(load_lexicon().units, key=len, reverse=True)
        body = "|".join(re.escape(item).replace(r"\ ", r"[\s-]+") for item in spellings)
        _PATTERNS.append(re.compile(rf"(?:{body}){_UNIT_END}", re.IGNORECASE))
    return _PATTERNS[0]


def refuse_unknown(tokens: list[Token], text: str, name: str) -> None:
    """Refuse a text with words that are not known, all of them at once, with what they look like.

    Raises
    ------
    TranslationError
        Where a token is ``unknown`` or a number without a unit.
    """
    unknown = [token for token in tokens if "unknown" in token.tags]
    if not unknown and any("unsupported" in token.tags for token in tokens):
        return  # "two heroes": not the number is what is amiss
    if not unknown:
        for token in tokens:
            if "bare_number" in token.tags:
                # "two" may count something; digits want a unit.
                kind = UnknownWordsError if token.text.isalpha() else TranslationError
                raise kind(
                    f"'{token.text}' has no unit",
                    place=Place(name, text, token.span),
                    found=token.text,
                    expected="a number with a unit, such as 12 m, 5 s, 40 km/h or 3 m/s^2",
                    fix=f"write '{token.text} m' or '{token.text} s'",
                )
        return
    lexicon = load_lexicon()
    words = list(dict.fromkeys(token.text for token in unknown))
    words = [word for word in words if word.lower() not in lexicon.units] or words
    near = {word: suggestions(word, lexicon.words) for word in words}
    hints = [f"did you mean '{found[0]}' for '{word}'?" for word, found in near.items() if found]
    listed = ", ".join(f"'{word}'" for word in words[:12])
    raise UnknownWordsError(
        f"these words were not understood: {listed}" if len(words) > 1 else f"this word was not understood: {listed}",
        place=Place(name, text, unknown[0].span),
        found=listed,
        expected="words about two vehicles on a road: where they are, what they want, when one reacts, and how",
        fix=" ".join(hints)
        or "leave these words out or say it in other words; nothing is guessed and nothing is dropped",
    )
