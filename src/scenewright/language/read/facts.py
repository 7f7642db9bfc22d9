"""What one clause says, and the part of it that is of somebody's way: headings, turns, roads.

What enters: chunks of a clause, one after the other. What leaves: a `Clause` with facts of a way, all of them partial.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace

from scenewright.errors import UnknownWordsError
from scenewright.language import story as st
from scenewright.language.compile import COMPASS
from scenewright.language.phrases import OTHERWISE
from scenewright.language.read.cast import Cast
from scenewright.language.read.chunks import Chunk


@dataclass(slots=True)
class Clause:
    """What one clause says.

    Attributes
    ----------
    measures, rate, times
        What is so of the subject, how hard it brakes or speeds up, and for how long or how long after the start.
    joined
        Conditions that "either", "both", "if" and "it is not so that" join, of whomever they are.
    flags
        ``standstill``, ``while`` (the end is open), ``to`` a speed, ``first``, ``start``, ``kept`` (its speed), ``way``
        (it is open), ``falls`` (an amount that is reached), ``yields``, ``insists``.
    notes
        How it says it, which is no meaning of its own: ``event`` (something is passed), ``wanted`` (a wish).
    """

    quote: st.Quote
    subject: int | None = None
    deed: str | None = None
    phase: str | None = None
    ordinal: int = 0
    measures: list[st.Measure] = field(default_factory=list)
    joined: list[st.Compound] = field(default_factory=list)
    rate: st.Measure | None = None
    times: dict[str, tuple[st.Operator, st.Amount]] = field(default_factory=dict)
    facts: dict[str, str] = field(default_factory=dict)
    flags: set[str] = field(default_factory=set)
    relations: list[st.Relation] = field(default_factory=list)
    notes: set[str] = field(default_factory=set)

    def says_more_than(self, *expected: str) -> bool:
        """Whether anything but these attributes is filled: what carries meaning must be used up."""
        known = {*expected, "quote", "subject", "notes"}
        return any(getattr(self, each.name) for each in fields(self) if each.name not in known)

    @property
    def conditions(self) -> list[st.Condition]:
        """All that it says is so."""
        return [*self.measures, *self.joined]

    @property
    def is_event(self) -> bool:
        """Whether it says that its subject comes to a place, and nothing else."""
        told = self.says_more_than("measures") or not self.measures or "event" not in self.notes
        return not told and all(st.is_event(each) for each in self.measures)


@dataclass(slots=True)
class Facts:
    """A clause while its facts are taken; `at` is the last chunk that was taken."""

    chunks: list[Chunk]
    people: Cast
    subject: int | None = None  # of whom it is where it names nobody
    at: int = 0
    clause: Clause = field(init=False)

    def __post_init__(self) -> None:
        start, end = self.chunks[0].start, self.chunks[-1].end
        self.clause = Clause(st.Quote(start, end, self.people.text[start:end]))

    def peek(self, ahead: int = 1) -> tuple[str, str]:
        """Return kind and value of a chunk from here; nothing where there is none."""
        at = self.at + ahead
        return (self.chunks[at].kind, self.chunks[at].value) if 0 <= at < len(self.chunks) else ("", "")

    def left_over(self, chunk: Chunk) -> UnknownWordsError:
        """Return the error that names a chunk that nothing was made of."""
        expected = "a number with a unit, such as 12 m" if chunk.kind == "no unit" else None
        return UnknownWordsError(
            f"'{chunk.text}' could not be understood here",
            found=self.clause.quote.text,
            expected=expected,
            fix=OTHERWISE,
        )

    def way(self, chunk: Chunk) -> None:
        """Take a chunk that says how somebody drives, with what belongs to it."""
        facts, value = self.clause.facts, chunk.value
        if chunk.kind == "heading" and (self.peek(-2)[0], self.peek(-1)[1]) == (
            "heading",
            "then",
        ):  # "north, then south"
            facts["headings"] = facts.get("headings", facts.pop("heading", "")) + value
        elif chunk.kind == "heading":
            self.headed(chunk)
        elif chunk.kind == "area":
            self.area(chunk)
        elif chunk.kind == "origin" and self.is_lane():
            self.at += 2
            self.fact("heading", self.chunks[self.at - 1])
            self.fact("origin", self.chunks[self.at])
        elif chunk.kind == "origin" and self.peek()[0] in ("area", "heading"):
            self.at += 1
            following = self.chunks[self.at]
            if following.kind == "heading":  # who comes from the east is headed west
                self.headed(following, back=True)
            else:
                self.fact("origin", following)
        elif chunk.kind == "origin" or (chunk.kind == "then_headed" and self.peek()[0] != "heading"):
            raise self.left_over(chunk)
        elif chunk.text.lower().startswith("to ") and "origin" not in facts:
            raise self.left_over(chunk)  # "leaves the road to the left", not "is to the left"
        else:
            if chunk.text.lower().split()[0] in ("turning", "making", "taking"):
                self.clause.notes.add("wanted")
            self.fact("then" if chunk.kind == "then_headed" else chunk.kind, chunk)

    def is_lane(self) -> bool:
        """Whether "the westbound lane" follows, which is no direction to come from."""
        lane = (self.peek()[0], self.peek(2)[0]) == ("heading", "area")
        return lane and self.chunks[self.at + 1].text.lower().endswith("bound")

    def headed(self, chunk: Chunk, back: bool = False) -> None:
        """Take a heading, of the way before or after its turn; `back` is where somebody comes from."""
        later = "then" in self.clause.facts or self.clause.facts.get("turn", "straight") != "straight"
        if back:
            chunk = replace(chunk, value=COMPASS[(COMPASS.index(chunk.value) + 2) % 4])
        self.fact("destination_heading" if later and not back else "heading", chunk)

    def area(self, chunk: Chunk, side: str = "") -> None:
        """Take a road, from which or into which somebody drives."""
        turned = self.clause.facts.get("turn", "straight") != "straight" and side != "from"
        self.fact("destination" if side == "into" or turned else "origin", chunk)

    def fact(self, name: str, chunk: Chunk) -> None:
        """Take one fact of a way; two that differ are left over."""
        if self.clause.facts.setdefault(name, chunk.value) != chunk.value:
            raise self.left_over(chunk)
