"""What a clause says, before it is known what that means for the program: events with who, what, where and how.

What enters: nothing. What leaves: the dataclasses that `clauses` fills and `interpret` reads.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Literal

from scenewright.errors import Span
from scenewright.translate.tokens import Quantity

EGO_ID, HERO_ID = 0, 1
SAY_IT_ALONE = "say it in a sentence of its own, or leave it out"
ACTOR_NAMES = {EGO_ID: "ego", HERO_ID: "hero"}
_GOES_ON = re.compile(
    r"\b(?:(?:dr[io]v|r[io]d|carr|roll|mov|com|press|go|went|cruis)\w* (?:straight |right )?on|continu\w+|proceed\w*"
    r"|(?:keep|kept)s? (?:on )?\w+ing)\b",
    re.IGNORECASE,
)
Relation = Literal["behind", "ahead", "before", "from", "past", "at", "just_before"]


@dataclass(frozen=True, slots=True)
class Place:
    """A position relative to a landmark or another actor: ``12 m behind the stop line``."""

    relation: Relation
    target: str | int  # a landmark's name, or an actor's id
    amount: Quantity | None
    span: Span
    of_whom: int | None = None  # "the hero's stop line"
    vague: bool = False  # "the driveway" stands for the landmark


AreaRole = Literal["on", "from", "into", "across", "towards"]
AreaKind = Literal["road", "driveway", "lane"]


@dataclass(frozen=True, slots=True)
class Area:
    """A stretch of the map that an actor is on, comes from or wants: ``onto the road travelling westbound``."""

    role: AreaRole
    kind: AreaKind
    span: Span
    heading: str | None = None
    side: str | None = None  # "the northern driveway"
    lane_of: int | None = None  # "into the ego's lane"
    oncoming: bool = False  # "the oncoming lane"
    wanted_by: int | None = None  # "the lane that the ego wants to turn into"


@dataclass(slots=True)
class Event:
    """One verb (or verbless statement) with everything that was said about it."""

    verb: str
    actor: int | None
    span: Span
    sentence: int
    links: list[str] = field(default_factory=list)
    negated: bool = False
    begins: bool = False
    wanted: bool = False
    perfect: bool = False
    gerund: bool = False
    initial: bool = False
    explicit: bool = False  # has a subject of its own, not one carried over
    first: bool = False
    to_stop: bool = False
    places: list[Place] = field(default_factory=list)
    areas: list[Area] = field(default_factory=list)
    headings: list[tuple[str, Span]] = field(default_factory=list)
    ends: list[tuple[str, Span]] = field(default_factory=list)  # headings at the end of the way
    direction: str | None = None
    rate: Quantity | None = None
    speed: Quantity | None = None
    to_speed: Quantity | None = None
    duration: Quantity | None = None
    ttc: Quantity | None = None
    landmark: str | None = None
    than_actor: int | None = None  # "before the ego": the actor that is beaten
    after_actor: int | None = None  # "after the ego": the actor that comes first
    to_actor: int | None = None  # "yields to the ego"
    between: tuple[int, int] | None = None
    relations: list[tuple[str, int, Span]] = field(default_factory=list)  # ("lead", actor, span)
    notes: list[str] = field(default_factory=list)
    mode: str = "main"
    both: bool = False  # told of the hero too
    in_front: bool = False  # "pulls out in front of the ego"
    resumed: bool = False  # goes on with a subject that was interrupted


def goes_on(said: str) -> bool:
    """Whether who does this drives on as before, and does not set off or speed up: "simply drives on"."""
    return _GOES_ON.search(said) is not None
