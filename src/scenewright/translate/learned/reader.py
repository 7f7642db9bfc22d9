"""Reads a description by likeness: what descriptions like this one mean, and how sure that is.

What enters: a description and a map. What leaves: `Likely`, a program with its probability and with the words that
counted for each part; None where the network cannot say. It refuses nothing and believes nothing: `offline` decides.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import lru_cache
from typing import Any, cast

from scenewright.errors import ScenewrightError, Span
from scenewright.program.arithmetic import JUST_BEFORE_M, negate
from scenewright.program.check import check_program
from scenewright.program.expressions import Formula, Negate, Node, Number, ParameterRef, Term, walk
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import Constraint, Parameter, Program
from scenewright.roads import RoadMap
from scenewright.roads.grounding import ground
from scenewright.translate.learned.amounts import amounts_of, clause_around, may_be_of_both, sentences
from scenewright.translate.learned.consistency import BOTH, bounded, fits_words, parts_named
from scenewright.translate.learned.network import Answers, Floats, load_network
from scenewright.translate.learned.pieces import Pieces, cut
from scenewright.translate.tokens import Quantity, tokenise
from scenewright.translate.translation import ROLES

EGO_WAY, HERO_WAY, STORY, SAYABLE = "ego", "hero", "story", "sayable"
_AMOUNT = "#"  # stands in a part for the amount that it has
_EGO_SKETCH = "t0, go, t1, go, t2"
_JUST_BEFORE = f"'just before' is {JUST_BEFORE_M} m before"
_JUST_BEFORE_ENDS = f" - {JUST_BEFORE_M}"
_AT_ONCE = "A0(t1) == A1(t1)"  # every trigger


@dataclass(frozen=True, slots=True)
class Part:
    """One part of what a description is taken to mean, with the words that counted most for it."""

    meaning: str
    span: Span
    probability: float
    constraint_ids: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Likely:
    """What a description most likely means.

    Attributes
    ----------
    program
        With spans into the description.
    probability
        That all of it is so, and that a program can say all that the description says; 0 where a word forbids it.
    sayable
        That a program can say all that the description says.
    doubtful
        The sentence that counted most for that.
    parts
        How it comes together.
    assumptions
        What no words of it say.
    """

    program: Program
    probability: float
    sayable: float
    doubtful: Span
    parts: tuple[Part, ...]
    assumptions: tuple[str, ...]


def read_likely(text: str, name: str, road_map: RoadMap) -> Likely | None:
    """Return what descriptions like `text` mean; None where there is no such program, or none on this map."""
    network = load_network()
    amounts = amounts_of(text, name)
    if not amounts or road_map.name != network.meanings["map"]:
        return None
    pieces = cut(text, amounts, network.vocabulary)
    if len(pieces.numbers) > network.most_pieces:
        return None
    answers = network.answer(pieces)
    kinds = parts_named(
        tokenise(text, name), [network.meanings["parts"][int(each.argmax())] for each in answers.amounts]
    )
    if kinds is None:
        return None
    story = network.meanings["stories"][int(answers.likely[STORY].argmax())]
    told = _Told(text, amounts, kinds, pieces, answers, story["sketch"], _lines(story["constraints"], kinds, amounts))
    if told.contradicts_itself():
        return None
    try:
        program = told.program(name)
        check_program(program, text, name)
        scene = ground(program, road_map)
    except ScenewrightError:
        return None
    parts = told.parts(program)
    sayable = float(told.answers.likely[SAYABLE][1])
    probability = sayable * math.prod(part.probability for part in parts)
    if not fits_words(text, [(route.turn, *route.headings) for route in scene.routes.values()]) or any(
        bounded(text, amount.span) or (BOTH not in kind and may_be_of_both(amount, amounts, text))
        for kind, amount in zip(kinds, amounts, strict=True)
    ):
        probability = 0.0
    assumed = (_JUST_BEFORE,) if any(line.endswith(_JUST_BEFORE_ENDS) for line, _ in told.lines) else ()
    return Likely(program, probability, sayable, told.counted(SAYABLE), parts, assumed)


@dataclass(frozen=True, slots=True)
class _Told:
    """A text with what the network answered."""

    text: str
    amounts: list[Quantity]
    kinds: list[str]  # the constraint that each amount belongs to, or two of them
    pieces: Pieces
    answers: Answers
    sketch: str
    lines: list[tuple[str, Quantity | None]]  # the constraints as they are written, in order, each with its amount

    def way(self, question: str) -> str:
        return ", ".join(load_network().meanings["ways"][int(self.answers.likely[question].argmax())])

    def contradicts_itself(self) -> bool:
        """Whether two things are told of one state; the same amount may be told twice."""
        pairs = zip(self.kinds, self.amounts, strict=True)
        told = {(each, amount.term) for kind, amount in pairs for each in kind.split(BOTH)}
        states = [line.split(" == ")[0] for line, _ in self.lines if " == " in line]
        return len({kind for kind, _ in told}) < len(told) or len(set(states)) < len(states)

    def program(self, name: str) -> Program:
        """Build the program: written down with a name for each amount, parsed, and the amounts put in."""
        told = self.counted(STORY)
        written = [line.replace(_AMOUNT, f"said_{at}_m") for at, (line, _) in enumerate(self.lines)]
        actors = (
            f"Actor 0:\n- {self.way(EGO_WAY)}\n- [{_EGO_SKETCH}]\n",
            f"Actor 1:\n- {self.way(HERO_WAY)}\n- [{self.sketch}]\n",
        )
        draft = _draft("\n".join((*actors, "Constraints:", *written, "")))
        constraints = tuple(
            Constraint(each.id, cast(Formula, _filled(each.formula, amount)), span, span)
            for each, (_, amount) in zip(draft.constraints, self.lines, strict=True)
            for span in [told if amount is None else clause_around(amount.span, self.text)]
        )
        used = [node.name for each in constraints for node in walk(each.formula) if isinstance(node, ParameterRef)]
        parameters = tuple(Parameter(each) for each in dict.fromkeys(used))
        drivers = tuple(replace(actor, span=None) for actor in draft.actors)
        return Program(name, drivers, constraints, parameters, draft.map_name, self.text)

    def parts(self, program: Program) -> tuple[Part, ...]:
        """Return how the program comes together, in the order of the text."""
        ids = {line: each.id for (line, _), each in zip(self.lines, program.constraints, strict=True)}
        story = tuple(ids[line] for line, amount in self.lines if amount is None)
        parts = [
            Part(f"the ego's route: {self.way(EGO_WAY)}", self.counted(EGO_WAY), self._sure(EGO_WAY)),
            Part(f"the hero's route: {self.way(HERO_WAY)}", self.counted(HERO_WAY), self._sure(HERO_WAY)),
            Part("what happens, in which order", self.counted(STORY), self._sure(STORY), story),
        ]
        roles = read_structure(program).roles
        for kind, amount, likely in zip(self.kinds, self.amounts, self.answers.amounts, strict=True):
            clause, meant = clause_around(amount.span, self.text), tuple(ids[each] for each in kind.split(BOTH))
            parts.append(Part(ROLES[roles[meant[0]]], clause, float(likely.max()), meant))
        return tuple(sorted(parts, key=lambda part: part.span.start))

    def counted(self, question: str) -> Span:
        """Return the sentence whose words counted most for an answer."""
        weights: Floats = self.answers.counted[question]
        best, most = Span(0, len(self.text)), -1.0
        for sentence in sentences(self.text):
            inside = [at for at, span in enumerate(self.pieces.spans) if sentence.start <= span.start < sentence.end]
            if (much := float(weights[inside].sum())) > most and sentence.excerpt(self.text).strip():
                best, most = sentence, much
        return best.trimmed(self.text)

    def _sure(self, question: str) -> float:
        return float(self.answers.likely[question].max())


@lru_cache(maxsize=1024)
def _draft(written: str) -> Program:
    """Parse a program: most of those that are written down only differ in their amounts."""
    return parse_program(written)


def _lines(story: list[str], kinds: list[str], amounts: list[Quantity]) -> list[tuple[str, Quantity | None]]:
    """Return the constraints of a story and of its amounts, in the order of a program."""
    lines: dict[str, Quantity | None] = dict.fromkeys((_AT_ONCE, *story))
    for kind, amount in zip(kinds, amounts, strict=True):
        for each in kind.split(BOTH):
            lines.setdefault(each, amount)
    return sorted(lines.items(), key=lambda line: _rank(line[0]))


def _filled(node: Node, amount: Quantity | None) -> Node:
    """Return `node` with the amount in place of the name that stands for it, and without spans of the draft."""
    if isinstance(node, ParameterRef) and amount is not None:
        return amount.term
    if isinstance(node, Negate) and amount is not None:
        if isinstance(amount.term, Number) and amount.term.value < 0:
            return amount.term  # "brakes at -4 m/s^2" and "at 4 m/s^2" say the same
        return negate(cast(Term, _filled(node.operand, amount)), amount.span)
    changed: dict[str, Any] = {}
    for each in fields(node):
        value = getattr(node, each.name)
        if isinstance(value, Span):
            changed[each.name] = amount.span if amount is not None else None
        elif is_dataclass(value):
            changed[each.name] = _filled(cast(Node, value), amount)
    return replace(node, **changed)


def _rank(line: str) -> int:
    """Return where a constraint stands: the beginning, the trigger, what the hero does, the ego's moment, the order."""
    if "t0)" in line:
        return 0
    if line == _AT_ONCE:
        return 1
    if "t1)" in line and "A1(t2)" not in line:
        return 2
    orders = (r"A1a", r"A1x\(t2\)", r"A1v\(t2\)", r"A1", r"A0x", r"")
    if re.match(r"A\d\(t\d\) [<>-]", line):
        return 3 + len(orders)
    return 3 + next(at for at, begins in enumerate(orders) if re.match(begins, line))
