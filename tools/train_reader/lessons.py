"""Makes examples of descriptions: the pieces that the network sees, and the right answers.

What enters: the descriptions of the repository, with their programs. What leaves: a `Lesson`. A program is taken apart
into the ways of both vehicles, a story (what the hero does, and every constraint without an amount), and what each
amount of the text is. Where that does not come out even, the text counts as one that cannot be read.
"""

from __future__ import annotations

import re
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from scenewright.errors import ScenewrightError
from scenewright.program.expressions import Number, ParameterRef, walk
from scenewright.program.printer import print_expression
from scenewright.program.text import parse_program
from scenewright.program.types import HeadingsRoute, Program
from scenewright.translate.itineraries import default_map
from scenewright.translate.learned.consistency import BOTH
from scenewright.translate.learned.pieces import cut
from scenewright.translate.rules import read_by_rules
from scenewright.translate.tokens import Quantity, tokenise
from scenewright.translate.values import take_values

ROOT = Path(__file__).resolve().parents[2]
KEPT_ASIDE = ROOT / "tests/translate/texts/kept_aside.toml"  # what the reader is measured on, never trained on
TEXTS = (
    *sorted(set((ROOT / "tests/translate/texts").glob("*.toml")) - {KEPT_ASIDE}),
    *sorted((ROOT / "src/scenewright/study/translation_set").glob("*.toml")),
)
VARIANTS = ROOT / "tests/translate/variants.toml"

MAP = "t_intersection"
WAYS = [["W"], ["E"], ["E", "N"], ["W", "N"], ["S", "W"], ["S", "E"]]
AT_ONCE = "A0(t1) == A1(t1)"
JUST_BEFORE = ("A1x(t2) == stop_line - #", "A1x(t2) == conflict_point - #")  # this far where no amount is told
JUST_BEFORE_M = "5"
RARE_STORY, RARE_PART = 5, 8  # below that many texts it is not learned
PIECES = 320  # of the longest text
PIECES_KEPT = 16_000  # of BERT's vocabulary, its first ones; and all that our texts need
NUMBER = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?(?:/\d+)?)(?![\w(])")


@dataclass
class Example:
    """A text as the network sees it, with the right answers; none but `sayable` where nothing can say the text.

    Where `denied`, it means anything but what the answers say.
    """

    id: str
    numbers: list[int]
    marks: list[int] = field(default_factory=list)
    sayable: bool = False
    ego: int = 0
    hero: int = 0
    story: int = 0
    parts: list[list[int]] = field(default_factory=list)  # for each amount those that it may have
    denied: bool = False


def texts() -> Iterator[tuple[str, str, Program | None]]:
    """Yield an id, a text, and what it means; None where it has to be refused."""
    for path in TEXTS:
        for row in tomllib.loads(path.read_text(encoding="utf-8"))["text"]:
            yield row["id"], row["text"], parse_program(row["program"]) if "program" in row else None
    for at, part in enumerate(tomllib.loads(VARIANTS.read_text(encoding="utf-8"))["part"]):
        meant = read_by_rules(part["frame"].format(part["plain"]), default_map(), "variant").program
        for number, said in enumerate(part["said"]):
            yield f"variant{at}-{number}", part["frame"].format(said), meant


def said_of(program: Program) -> tuple[list[str], list[tuple[str, str]]] | None:
    """Return the constraints without amounts, and those with one, with the amount; None where one has two."""
    without, amounts = [], []
    for constraint in program.constraints:
        written = print_expression(constraint.formula)
        names = [node.name for node in walk(constraint.formula) if isinstance(node, ParameterRef)]
        found: list[str] = list(names)
        for name in names:
            written = re.sub(rf"(?<!\w){name}(?!\w)", "#", written)

        def taken(match: re.Match[str], found: list[str] = found) -> str:
            if match.group() == "0":
                return "0"
            found.append(match.group())
            return "#"

        written = re.sub(r"# (?:m/s\^2|m/s|m|s)\b", "#", NUMBER.sub(taken, written))
        if len(found) > 1:
            return None
        if found:
            amounts.append((written, found[0]))
        else:
            without.append(written)
    return without, amounts


def amounts_in(text: str, name: str) -> tuple[str, list[Quantity]] | None:
    """Return a text without the values that it gives to parameters, and its amounts; None where they are not clear."""
    try:
        rest, _ = take_values(text, name)
        return rest, [token.quantity for token in tokenise(rest, name) if token.quantity is not None]
    except ScenewrightError:
        return None


def value_of(amount: Quantity) -> str:
    """Return an amount as `said_of` does."""
    return print_expression(amount.term) if isinstance(amount.term, Number) else amount.term.name


@dataclass
class Meant:
    """What a text means, in the terms of the answers."""

    ways: list[list[str]]
    story: tuple[str, ...]
    amounts: list[tuple[str, str]]


def meant_by(program: Program, told: list[str]) -> Meant | None:
    """Return what `program` says, of a text with the amounts `told`; None where it is of a kind that is not learned."""
    if program.map_name != MAP or len(program.actors) != 2:
        return None
    ego, hero = program.actors
    ways = [list(actor.route.headings) for actor in program.actors if isinstance(actor.route, HeadingsRoute)]
    said = said_of(program)
    if said is None or [str(piece) for piece in ego.sketch.pieces] != ["go", "go"] or any(w not in WAYS for w in ways):
        return None
    without, amounts = said
    if AT_ONCE not in without or len(ways) != 2:
        return None
    without.remove(AT_ONCE)
    fives = sum(value == JUST_BEFORE_M for _, value in amounts)
    kept = []
    for written, value in amounts:
        if written in JUST_BEFORE and value == JUST_BEFORE_M and told.count(value) < fives:
            without.append(written.replace("#", value))
        else:
            kept.append((written, value))
    sketch = "t0" + "".join(f", {piece}, t{at}" for at, piece in enumerate(hero.sketch.pieces, 1))
    return Meant(ways, (sketch, *sorted(without)), kept)


def joined(meant: Meant, told: list[str]) -> Meant | None:
    """Return it with one part for an amount that is told of two things at once; None where it is not clear of which.

    "Both are 30 m from it" tells one amount and means two constraints.
    """
    amounts = []
    for value, count in Counter(value for _, value in meant.amounts).items():
        parts = sorted(part for part, each in meant.amounts if each == value)
        times = told.count(value)
        if 1 < times < count:
            return None
        amounts += [(part, value) for part in ([BOTH.join(parts)] if times == 1 else parts)]
    return Meant(meant.ways, meant.story, amounts)


@dataclass
class Lesson:
    """All examples, and what the answers mean."""

    examples: list[Example]
    vocabulary: list[str]
    kept: list[int]  # the rows of the full vocabulary
    stories: list[tuple[str, ...]]
    parts: list[str]


def prepare(full: list[str]) -> Lesson:
    """Cut all texts, and number what they mean."""
    everything = {piece: at for at, piece in enumerate(full)}
    rows, used = [], set()
    for identifier, text, program in texts():
        found = amounts_in(text, identifier)
        rest, amounts = found or (text, [])
        program = program if found else None
        values = [value_of(each) for each in amounts]
        meant = meant_by(program, values) if program is not None else None
        if meant is not None and (meant := joined(meant, values)) is None:
            continue
        rows.append((identifier, rest, amounts, meant))
        used |= set(cut(rest, amounts, everything).numbers)
    kept = [
        at
        for at, piece in enumerate(full)
        if at in used or re.fullmatch(r"\[(?:PAD|UNK|CLS|SEP|unused[1-8])\]", piece)
        or (at < PIECES_KEPT and piece.isascii() and not piece.startswith("[unused"))
    ]  # fmt: skip
    vocabulary = [full[at] for at in kept]
    numbered = {piece: at for at, piece in enumerate(vocabulary)}
    told = [meant for *_, meant in rows if meant is not None]
    counted = Counter(meant.story for meant in told)
    stories = [story for story, count in counted.most_common() if count >= RARE_STORY]
    counted_parts = Counter(part for meant in told for part in {part for part, _ in meant.amounts})
    parts = [part for part, count in counted_parts.most_common() if count >= RARE_PART]
    examples = []
    for identifier, rest, amounts, meant in rows:
        pieces = cut(rest, amounts, numbered)
        if len(pieces.numbers) <= PIECES:
            example = Example(identifier, list(pieces.numbers), list(pieces.marks))
            answer(example, meant, [value_of(each) for each in amounts], stories, parts)
            examples.append(example)
    return Lesson(examples, vocabulary, kept, stories, parts)


def answer(
    example: Example, meant: Meant | None, told: list[str], stories: list[tuple[str, ...]], parts: list[str]
) -> None:
    """Give an example its right answers, where the network can give them."""
    if not told or meant is None or meant.story not in stories or any(part not in parts for part, _ in meant.amounts):
        return
    by_value = defaultdict(list)
    for part, value in meant.amounts:
        by_value[value].append(parts.index(part))
    if set(by_value) != set(told):
        return
    example.sayable = True
    example.ego, example.hero = (WAYS.index(way) for way in meant.ways)
    example.story = stories.index(meant.story)
    example.parts = [by_value[value] for value in told]
