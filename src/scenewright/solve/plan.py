"""A plan: one concrete motion for each orchestrated actor, and what it promises.

What enters: profiles. What leaves: a `Plan` that can be carried out, checked against the program, and written as data.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.motion.profile import Profile
from scenewright.program.expressions import Order
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene

SCHEMA_VERSION = 1
_SAME_MOMENT_S = 1e-6


@dataclass(frozen=True, slots=True)
class Plan:
    """Motions by actor id; for the ego what was predicted.

    Attributes
    ----------
    tolerance
        What is missed most of what is asked of heroes, in tight tolerances.
    """

    profiles: Mapping[int, Profile]
    tolerance: float = 0.0
    parameters: Mapping[str, float] = field(default_factory=dict)

    def as_dict(self, scene: Scene) -> dict[str, object]:
        """Return the plan as plain data (`plan.json`)."""
        actors: dict[str, object] = {}
        for actor_id, profile in sorted(self.profiles.items()):
            actor = scene.program.actor(actor_id)
            names = actor.sketch.piece_names()
            knots = []
            for knot, time_s in profile.knot_times_s.items():
                s_m, speed, _ = profile.state(time_s)
                knots.append({"name": knot, "time_s": time_s, "s_m": s_m, "speed_mps": speed})
            segments = [
                {
                    "piece": names[segment.piece] if segment.piece < len(names) else "go",
                    "start_s": segment.start_s,
                    "duration_s": segment.duration_s,
                    "s_m": segment.s_m,
                    "speed_mps": segment.speed_mps,
                    "accel_mpss": segment.accel_mpss,
                    "jerk_mpsss": segment.jerk_mpsss,
                }
                for segment in profile.segments
            ]
            actors[actor.name] = {"knots": knots, "segments": segments}
        return {"schema_version": SCHEMA_VERSION, "tolerance": self.tolerance, "actors": actors}


class PlanWorld:
    """Evaluates terms of the program on the profiles of a plan (see `program.evaluate.World`)."""

    def __init__(self, scene: Scene, profiles: Mapping[int, Profile], parameters: Mapping[str, float]) -> None:
        self._scene = scene
        self._profiles = profiles
        self._parameters = parameters

    def state(self, actor: int, order: Order, time_s: float) -> float:
        """Return position, speed or acceleration of `actor` at an instant; at its last knot that of what ends there."""
        profile = self._profiles[actor]
        last = self._scene.program.actor(actor).sketch.knots[-1]
        if order == 2 and abs(time_s - profile.knot_times_s.get(last, math.inf)) < _SAME_MOMENT_S:
            time_s -= 2 * _SAME_MOMENT_S
        return profile.state(time_s)[order]

    def piece_span_s(self, actor: int, piece: str) -> tuple[float, float]:
        """Return when a piece begins and ends; infinite where that is not known."""
        begins, ends = self._scene.program.actor(actor).sketch.piece_ends(piece)
        return self.knot_time_s(actor, begins), self.knot_time_s(actor, ends)

    def knot_time_s(self, actor: int, knot: str) -> float:
        """Return when `actor` passes `knot`; infinite where it is not known to."""
        return self._profiles[actor].knot_times_s.get(knot, math.inf)

    def changes_s(self) -> Sequence[float]:
        """Return the instants at which some motion changes."""
        return [segment.start_s for profile in self._profiles.values() for segment in profile.segments]

    def landmark_m(self, actor: int, name: str, other: int | None) -> float:
        """Return the arc length of a landmark on the route of `actor`."""
        return self._scene.landmark_m(actor, name, other)

    def parameter(self, name: str) -> float:
        """Return a parameter's SI value."""
        return self._parameters[name]

    def offset_m(self, actor: int, other: int) -> float:
        """Return what to add to the arc length of `other` to compare it with that of `actor`."""
        return self._scene.offset_m(actor, other)

    def between_m(self, actor: int, other: int) -> float:
        """Return how much of a gap between two actors' centres their bodies take up."""
        return VEHICLE_LENGTH_M
