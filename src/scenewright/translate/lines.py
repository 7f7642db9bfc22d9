"""What was understood as people read it: sentences beside the words they came from, and each constraint in words.

What enters: stories with the texts that they were read from, and programs. What leaves: lines and clauses in plain
English. What has no words yet stands there as code, so that nothing is left out.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache

from scenewright.errors import Span, TranslationError
from scenewright.program.expressions import Formula
from scenewright.program.printer import print_expression
from scenewright.program.types import Constraint, Program
from scenewright.translate import story as st
from scenewright.translate.compile import clause_around
from scenewright.translate.decompile import Became, decompiled, parts_of, way_of
from scenewright.translate.phrases import DOES, Phrases, amount, listed, sentence
from scenewright.translate.tell import Teller


@dataclass(frozen=True, slots=True)
class Line:
    """A sentence of what was understood, and the words of the text that it came from."""

    sentence: str
    words: str = ""


def lines_of_story(story: st.Story, text: str) -> tuple[Line, ...]:
    """Return `story` as lines with their words in `text`; raises as `tell` does."""
    return tuple(Line(told, words_of(quotes, text)) for told, quotes in Teller(st.arranged(story)).lines())


def lines_of_program(program: Program) -> tuple[Line, ...]:
    """Return `program` as lines; what has no words yet is told as code."""
    text = program.description or ""
    try:
        found = decompiled(program, leniently=True)
        lines = lines_of_story(replace(found.story, title=None), text)  # a program has its name
        rest = tuple(found.untold)
    except TranslationError:
        ways = ((actor.name, Phrases(st.Story(())).way(way_of(actor.route))) for actor in program.actors)
        lines, rest = tuple(Line(sentence(f"the {name} {way}")) for name, way in ways), program.constraints
    told = told_constraints(program) if rest else {}
    return (*lines, *(Line(f"Besides: {told[each.id]}.", program.words_of(each) or "") for each in rest))


def told_constraints(program: Program) -> dict[str, str]:
    """Return each constraint as a clause of plain English, by its id; as code where there are no words for it yet."""
    told = told_formulas(program)
    return {each.id: listed([told[part] for part in parts_of(each.formula)]) for each in program.constraints}


def told_knots(program: Program) -> dict[tuple[int, str], str]:
    """Return what happens at each knot of which anything is said, by actor and knot: ``the hero begins to brake``."""
    told: dict[tuple[int, str], str] = {}
    with suppress(TranslationError):
        found = decompiled(program, leniently=True)
        teller = _knowing_all(found.story)
        for key, moment in found.moment_of.items():
            with suppress(TranslationError):
                told[key] = "start" if moment == st.START else teller.event(moment)
    return told


@lru_cache(maxsize=4)  # one program is asked about constraint by constraint
def told_formulas(program: Program) -> Mapping[Formula, str]:
    """Return the same for each formula of those that stand side by side in a constraint."""
    told = {part: print_expression(part) for each in program.constraints for part in parts_of(each.formula)}
    with suppress(TranslationError):
        found = decompiled(program, leniently=True)
        teller = _knowing_all(found.story)
        for formula, became in found.taken.items():
            with suppress(TranslationError):
                told[formula] = listed([_clause(teller, *each) for each in became]) if became else told[formula]
    return told


def named(program: Program, constraint: Constraint) -> str:
    """Return a constraint as told, after its own name where somebody gave it one."""
    own = "" if re.fullmatch(r"c\d+", constraint.id) else f"{constraint.id}: "
    return own + told_constraints(program)[constraint.id]


def in_words(program: Program, constraint: Constraint) -> str:
    """Return a constraint in the user's own words, or told in plain English where there are none."""
    return program.words_of(constraint) or told_constraints(program)[constraint.id]


def _knowing_all(story: st.Story) -> Teller:
    """Return what tells parts of a story by themselves: every moment is known, by what begins or ends at it."""
    return Teller(story, begun=list(story.deeds), ended=list(story.deeds))


def _clause(teller: Teller, moment: int | None, told: Became) -> str:
    """Return what a constraint became as a clause."""
    clause = teller.clause
    match told:
        case st.Order():
            return teller.order(told)
        case st.Hold():
            return teller.hold(told)
        case st.Measure() if moment is None:
            own = (
                DOES[deed.verb][0] + teller.which_time(deed)
                for deed in teller.story.deeds_of(told.actor)
                if any(told is measure for measure in deed.throughout)
            )
            return f"{clause(told)} while it {next(own, DOES[st.Verb.STAND][0])}"
    assert moment is not None
    if told is None:
        return f"all of this is at one moment, when {teller.event(moment)}"
    if moment == st.START:
        return f"{clause(told)} at the start"
    time = teller.story.moments[moment].time
    if time is not None and not teller.story.owners(moment):  # the clock alone says when
        return f"{clause(told)} {amount(time)} after the start"
    text, event = clause(told, passing=st.is_event(told)), teller.event(moment)
    if isinstance(told, st.Measure):
        name = teller.name(told.actor)
        event = re.sub(f"^{re.escape(name)} ", "it ", event)
        if event == text.replace(name, "it", 1):
            return text
    return f"{text} when {event}"


def words_of(quotes: Sequence[st.Quote], text: str) -> str:
    """Return the clauses of `text` that quotes stand in, each stretch once."""
    found: list[Span] = []
    for span in sorted((clause_around(text, quote.span) for quote in quotes), key=lambda span: span.start):
        if found and not re.search(r"\w", text[found[-1].end : span.start]):  # they meet, or one lies in the other
            found[-1] = found[-1].union(span)
        else:
            found.append(span)
    return " ... ".join(" ".join(span.excerpt(text).split()) for span in found)
