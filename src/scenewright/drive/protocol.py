"""What an ego policy is: it is told where it starts, then asked once a step what to do.

What enters: the ego's start and, step by step, what it sees. What leaves: an acceleration along its route, or a motion
of its own. The orchestrator knows nothing else of a policy: no plans, no intentions, no landmarks.

A policy of one's own is a class with two methods; it inherits from nothing:

>>> from scenewright.drive.protocol import EgoStart, Observation
>>> class Timid:
...     '''Keeps 8 m/s, and brakes while another car is within 15 m.'''
...     def reset(self, start: EgoStart) -> None:
...         self.length_m = start.length_m
...     def step(self, observation: Observation, dt_s: float) -> float:
...         ego = observation.ego
...         near = [o for o in observation.others if abs(o.x_m - ego.x_m) + abs(o.y_m - ego.y_m) < 15.0]
...         return -3.0 if near and ego.speed_mps > 0.0 else 0.5 * (8.0 - ego.speed_mps)
>>> policy = Timid()
>>> isinstance(policy, EgoPolicy)
True
>>> ego = VehicleState("ego", 0.0, 0.0, 0.0, 6.0, 0.0, 4.5, 1.9, s_m=12.0, route=None)
>>> policy.step(Observation(0.0, ego, ()), 0.02)
1.0

Saved as ``timid.py`` it drives after ``scenewright run ... --ego timid:Timid``; constructor arguments are options, as
in ``--ego timid:Timid:keep_mps=6``. The same seed in `EgoStart` must give the same motion.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

if TYPE_CHECKING:
    import numpy as np

    from scenewright.roads import RoadMap, Route


@dataclass(frozen=True, slots=True)
class VehicleState:
    """One vehicle at one instant.

    Attributes
    ----------
    name
        The actor's name, such as ``"ego"`` or ``"hero"``.
    x_m, y_m, heading_rad
        Centre of its box in the map's frame, heading counter-clockwise from the x axis.
    speed_mps, accel_mps2
        Along its heading.
    length_m, width_m
        Its box.
    s_m, route
        Arc length on its route, and the route; None where the observer must not know where the vehicle is going.
    """

    name: str
    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float
    accel_mps2: float
    length_m: float
    width_m: float
    s_m: float | None
    route: Route | None


@dataclass(frozen=True, slots=True)
class Observation:
    """What the ego sees at one instant: itself and every other vehicle, without noise."""

    time_s: float
    ego: VehicleState
    others: tuple[VehicleState, ...]


@dataclass(frozen=True, slots=True)
class EgoMotion:
    """Where a policy with a vehicle model of its own puts the ego at the end of a step."""

    x_m: float
    y_m: float
    heading_rad: float
    speed_mps: float


@dataclass(frozen=True, slots=True)
class EgoStart:
    """What a policy is told before the first step.

    Attributes
    ----------
    route, road_map
        The route that the ego is to drive, and the map it lies in.
    s_m, speed_mps
        Arc length on the route and speed at the start.
    speed_limit_mps
        The limit that holds at the start, and wherever a lane names none.
    seed
        Makes every random choice of the policy repeatable.
    length_m, width_m
        The ego's box.
    """

    route: Route
    road_map: RoadMap
    s_m: float
    speed_mps: float
    speed_limit_mps: float
    seed: int
    length_m: float
    width_m: float


@dataclass(frozen=True, slots=True)
class Envelope:
    """What a policy promises about its motion, whatever the others do.

    Proofs that a scenario cannot happen lean on it, so a promise that is broken is reported as a finding.

    Attributes
    ----------
    speed_max_mps
        It never drives faster.
    accel_min_mpss, accel_max_mpss
        It never brakes or accelerates harder; braking is negative.
    holds_speed
        Its speed never changes at all.
    """

    speed_max_mps: float
    accel_min_mpss: float
    accel_max_mpss: float
    holds_speed: bool = False


@runtime_checkable
class EgoPolicy(Protocol):
    """The driving policy under test.

    Two further attributes are read where a policy has them:

    ``envelope: Envelope | None``
        A promise about its motion. It may change in `reset`, and holds from one `reset` to the next.
    ``preferred_speed_mps(start: EgoStart) -> float | None``
        The speed it would hold by itself at the start, so that a run need not begin with a transient.
    """

    def reset(self, start: EgoStart) -> None:
        """Forget everything and begin at `start`; called before every run."""

    def step(self, observation: Observation, dt_s: float) -> float | np.floating | EgoMotion:
        """Say what the ego does in the next `dt_s` seconds.

        Returns
        -------
        float or EgoMotion
            An acceleration along the route in m/s^2 (a vehicle that stands does not roll back), or the state that a
            vehicle model of its own reaches at the end of the step.
        """
