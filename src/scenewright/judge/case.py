"""All that a verdict may rest on: the program, its values, facts of the map, and the trace.

What enters: plain data. What leaves: a `Case` that answers for names (actors, landmarks, shared lanes). It holds no
plan, and where a fact is missing it says so instead of guessing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from scenewright.errors import InputError
from scenewright.judge.timeline import Timeline
from scenewright.program.resolve import resolve, usual_partner
from scenewright.program.structure import Structure, read_structure
from scenewright.program.types import Program
from scenewright.roads.bodies import Body as Box
from scenewright.trace.model import COLUMNS, ActorTrace, FloatArray, Trace
from scenewright.translate.phrases import called

__all__ = ["Box", "CannotJudge", "Case", "Limits", "NotReached", "PathLike"]


class CannotJudge(Exception):  # noqa: N818 - a reason that ends in a failed condition, not an error of the user
    """A condition cannot be judged; the text says why."""


class NotReached(CannotJudge):
    """A state is asked for at a knot that the actor never got to."""

    def __init__(self, actor: str, actor_id: int) -> None:
        super().__init__(f"{called(actor)} never got so far")
        self.actor_id = actor_id


class PathLike(Protocol):
    """What is needed of a route's path."""

    def poses(self, s_m: FloatArray, /) -> FloatArray:
        """Return x (m), y (m) and heading (rad) at arc lengths, shape (N, 3)."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What an actor may do. The defaults are what no road vehicle does."""

    speed_max_mps: float = 60.0
    accel_min_mpss: float = -12.0
    accel_max_mpss: float = 12.0
    lateral_accel_max_mpss: float = 10.0


@dataclass(frozen=True, eq=False)
class Case:
    """One run, ready to be judged.

    Parameters
    ----------
    program
        What was asked for; what it leaves to be understood is resolved here as it is for the planner.
    parameters
        Value of every parameter, in SI units.
    landmarks
        By actor name: arc length (m) of each landmark on that actor's route. Conflict points with others than the ego
        and, on the ego's route, than the first hero have the other's name beside them: ``"conflict_point(hero2)"``.
    shared_offset_m
        By pair of actor names (a, b): what to add to b's arc length to compare it with a's; None where they share no
        lane.
    trace
        What happened.
    vehicles, limits
        By actor name; defaults where absent.
    expected_headings
        By actor name: cardinal directions of the route, first to last.
    paths, unmapped
        By actor name: the route's path, to compare map coordinates with route coordinates; why there is none.

    Raises
    ------
    InputError
        If an actor has no trace or one with NaN, infinite values or unordered times, or a parameter has no value.
    """

    program: Program
    parameters: Mapping[str, float]
    landmarks: Mapping[str, Mapping[str, float]]
    shared_offset_m: Mapping[tuple[str, str], float | None]
    trace: Trace
    vehicles: Mapping[str, Box] = field(default_factory=dict)
    limits: Mapping[str, Limits] = field(default_factory=dict)
    expected_headings: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    paths: Mapping[str, PathLike] = field(default_factory=dict)
    unmapped: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "program", resolve(self.program))
        absent = [actor.name for actor in self.program.actors if actor.name not in self.trace.actors]
        if absent:
            raise InputError(
                "the trace lacks an actor of the program",
                found=", ".join(self.trace.actors),
                expected=", ".join(absent),
                fix="judge a trace with the program that it was made from",
            )
        for actor in self.program.actors:
            # A comparison with NaN is false either way, and would pass for "within the limit".
            if (found := _fault_of(self.trace.actors[actor.name])) is not None:
                raise InputError(
                    f"the trace of {actor.name} cannot be judged",
                    found=found,
                    expected="a finite number for every value, and times that increase",
                    fix="write the trace again from the simulator",
                )
        unset = [p.name for p in self.program.parameters if p.name not in self.parameters]
        if unset:
            raise InputError("a parameter has no value", found="none", expected=", ".join(unset))

    @cached_property
    def structure(self) -> Structure:
        """Triggers and roles of the constraints."""
        return read_structure(self.program)

    @cached_property
    def timelines(self) -> dict[int, Timeline]:
        """The motion of every actor of the program, by id."""
        return {actor.id: Timeline(self.trace.actors[actor.name]) for actor in self.program.actors}

    @property
    def start_s(self) -> float:
        """The first instant of the run."""
        return float(self.trace.time_s[0])

    @property
    def end_s(self) -> float:
        """The last instant of the run."""
        return float(self.trace.time_s[-1])

    def name(self, actor_id: int) -> str:
        """Return the name of an actor."""
        return self.program.actor(actor_id).name

    def box(self, actor_id: int) -> Box:
        """Return the outline of an actor."""
        return self.vehicles.get(self.name(actor_id), Box())

    def limits_of(self, actor_id: int) -> Limits:
        """Return what an actor may do."""
        return self.limits.get(self.name(actor_id), Limits())

    def path(self, actor_id: int) -> PathLike:
        """Return the path of an actor's route.

        Raises
        ------
        CannotJudge
            If it is not known; says why.
        """
        name = self.name(actor_id)
        if name not in self.paths:
            raise CannotJudge(self.unmapped.get(name, "the path of its route is not known"))
        return self.paths[name]

    def landmark_m(self, name: str, actor_id: int, other: int | None = None) -> float:
        """Return the arc length of a landmark on an actor's route.

        Raises
        ------
        CannotJudge
            If the route has no such landmark.
        """
        known = self.landmarks.get(self.name(actor_id), {})
        names = (name, "intersection") if name == "turn" else (name,)
        for key in names:
            if other is not None and (with_other := f"{key}({self.name(other)})") in known:
                return float(known[with_other])
            # A conflict point without a name beside it is the one with the usual partner.
            if key in known and other in (None, usual_partner(self.program, actor_id)):
                return float(known[key])
        with_whom = "" if other is None else f" with {self.name(other)}"
        raise CannotJudge(f"the route of {self.name(actor_id)} has no landmark {name}{with_whom}")

    def offset_m(self, actor_id: int, other: int) -> float | None:
        """Return what to add to `other`'s arc length to compare it with the actor's; None where they share no lane."""
        if actor_id == other:
            return 0.0
        a, b = self.name(actor_id), self.name(other)
        if (a, b) in self.shared_offset_m:
            return self.shared_offset_m[a, b]
        back = self.shared_offset_m.get((b, a))
        return None if back is None else -back


def _fault_of(states: ActorTrace) -> str | None:
    """Return the first of an actor's values that is no number, or its first time that does not increase."""
    for column in ("time_s", *COLUMNS):
        values = getattr(states, column)
        if len(steps := np.flatnonzero(~np.isfinite(values))):
            return f"{column} {values[steps[0]]} at step {steps[0]}"
    late = np.flatnonzero(np.diff(states.time_s) <= 0)
    return f"time_s {states.time_s[late[0] + 1]:g} at step {late[0] + 1}" if len(late) else None
