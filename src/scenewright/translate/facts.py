"""Typed facts of a description: what each actor wants, where it is when, what the hero does, who comes first.

What enters: nothing. What leaves: the dataclasses that `interpret` fills and `assemble` turns into a program.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from scenewright.translate.events import Event, Place
from scenewright.translate.tokens import Quantity

WishKey = Literal["origin_kind", "origin_heading", "turn", "destination_kind", "destination_heading"]


@dataclass(frozen=True, slots=True)
class Said:
    """A value with the event that said it."""

    value: str
    event: Event


@dataclass(frozen=True, slots=True)
class Condition:
    """What holds of an actor at one moment: its place, its speed, the time to collision, or that since the start."""

    actor: int
    event: Event
    place: Place | None = None
    speed: Quantity | None = None
    ttc: Quantity | None = None
    clock: Quantity | None = None


Bound = Literal["==", "<=", ">="]


@dataclass(slots=True)
class Phase:
    """One thing that the hero does after its trigger."""

    kind: Literal["dec", "acc", "go", "turn"]
    events: list[Event]
    place: Place | None = None
    place_event: Event | None = None
    rate: Quantity | None = None
    rate_event: Event | None = None
    to_stop: bool = False
    to_speed: Quantity | None = None
    goal: str | None = None
    goal_event: Event | None = None
    wait: Quantity | None = None
    wait_bound: Bound = "=="  # "for at least 2 s"
    yields: bool = False
    goal_assumed: str | None = None  # the assumption that gave the goal, where no words did


@dataclass(frozen=True, slots=True)
class Order:
    """Who comes first: the hero with the goal of its last phase, or the ego at `ego_landmark`."""

    hero_first: bool
    ego_landmark: str
    event: Event
    at_start: bool = False  # the hero's last phase begins (not ends) after the ego
    margin: Quantity | None = None  # "1 s before the ego does"
    margin_bound: Bound = "=="


@dataclass(frozen=True, slots=True)
class LaneRelation:
    """How an actor's route relates to the other's: lead, oncoming, into its lane, across its path, ..."""

    kind: str
    actor: int
    event: Event


@dataclass(slots=True)
class Facts:
    """Everything that a description says."""

    wishes: dict[int, dict[WishKey, Said]] = field(default_factory=lambda: {0: {}, 1: {}})
    relations: list[LaneRelation] = field(default_factory=list)
    initial: list[Condition] = field(default_factory=list)
    trigger: list[Condition] = field(default_factory=list)
    phases: list[Phase] = field(default_factory=list)
    order: Order | None = None
    not_yielding: Event | None = None
    let_goal: tuple[str, Event] | None = None  # the moment of the ego that the hero lets it reach
    steady: Event | None = None  # the hero does not speed up
    held: Event | None = None  # what the hero does not do until the ego has passed
    standing: Event | None = None  # the hero waits at the start until the trigger
    mentioned: set[int] = field(default_factory=set)
    assumptions: list[str] = field(default_factory=list)
    understood: dict[int, list[str]] = field(default_factory=dict)  # by id() of the event
