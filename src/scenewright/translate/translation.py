"""What a translation is: a program, with the account of how each clause of the description came to be in it.

What enters: nothing. What leaves: the dataclasses that translators fill, and rows for people to read.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.errors import Span
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
    """

    span: Span
    text: str
    understood: str
    constraint_ids: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Translation:
    """A program with the account of how it came from the description."""

    program: Program
    readings: tuple[Reading, ...]
    assumptions: tuple[str, ...]


def explain(translation: Translation) -> list[tuple[str, str, str]]:
    """Return rows for display: the words of each clause, how they were understood, the constraints they gave."""
    rows = []
    for reading in translation.readings:
        formulas = [
            print_expression(translation.program.constraint(identifier).formula)
            for identifier in reading.constraint_ids
        ]
        rows.append((reading.text, reading.understood, "; ".join(formulas)))
    return rows
