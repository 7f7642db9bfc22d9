"""What a translation is: a program, with the account of how each clause of the description came to be in it.

What enters: nothing. What leaves: the dataclasses that translators fill, and rows for people to read.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Place, Span, TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.structure import Role
from scenewright.program.types import Program

ROLES = {
    Role.INITIAL: "at the start",
    Role.TRIGGER: "the moment at which the hero reacts",
    Role.INTERACTION: "what the hero does",
    Role.OUTCOME: "how it ends",
}


@dataclass(frozen=True, slots=True)
class Reading:
    """How one clause was understood.

    Attributes
    ----------
    span, text
        The clause, as offsets into the description and as words.
    understood
        Its meaning in plain words.
    constraint_ids
        The constraints that it gave; empty for clauses that decide a route.
    confidence, basis
        How sure the reading is, from 0 to 1, and what that means; see `confidence.Basis`.
    """

    span: Span
    text: str
    understood: str
    constraint_ids: tuple[str, ...]
    confidence: float = 1.0
    basis: str = ""


@dataclass(frozen=True, slots=True)
class Translation:
    """A program with the account of how it came from the description.

    Attributes
    ----------
    by_facts
        Whether its facts were picked out of a free text; not every word of that is accounted for.
    """

    program: Program
    readings: tuple[Reading, ...]
    assumptions: tuple[str, ...]
    by_facts: bool = field(default=False, kw_only=True)


def explain(translation: Translation) -> list[tuple[str, str, str]]:
    """Return rows for display: the words of each clause, how they were understood, the constraints they gave."""
    rows = []
    for reading in translation.readings:
        formulas = [
            print_expression(translation.program.constraint(identifier).formula)
            for identifier in reading.constraint_ids
        ]
        understood = reading.understood
        if reading.confidence < 1:
            understood += f" [confidence {reading.confidence:g}: {reading.basis}]"
        rows.append((reading.text, understood, "; ".join(formulas)))
    return rows


def refuse_two_ways(program: Program, other: Program, text: str, name: str, expected: str) -> None:
    """Refuse a text that two readers read in two ways: as `program`, and as `other`.

    Raises
    ------
    TranslationError
        With the first thing that only one of them says.
    """
    if [(each.route, each.sketch) for each in program.actors] != [(each.route, each.sketch) for each in other.actors]:
        place, found = Place(name, text, Span(0, len(text))), "another route, or another order of what the hero does"
    else:
        formulas = [each.formula for each in other.constraints]
        only = [each for each in program.constraints if each.formula not in formulas]
        if not only and len(formulas) == len(program.constraints):
            return
        constraint = only[0] if only else other.constraints[-1]
        place, found = Place(name, text, constraint.span), print_expression(constraint.formula)
    raise TranslationError(
        "this can be read in two ways",
        place=place,
        found=found,
        expected=expected,
        fix="say it in shorter sentences, each with the name of the vehicle it is about",
    )
