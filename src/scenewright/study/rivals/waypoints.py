"""What a driver model is that follows waypoints, and a plain one that is built in.

What enters: where the vehicle has been for a second, then what it sees and where it is to be in a few seconds. What
leaves: an acceleration along its route, or a motion. A learned model takes the place of ours by the same two methods:

>>> from scenewright.study.rivals.waypoints import DriverStart, View, Waypoint
>>> class Stubborn:
...     '''Heeds no waypoint.'''
...     def reset(self, start: DriverStart) -> None:
...         self.speed_mps = start.history[-1].speed_mps
...     def step(self, view: View, waypoint: Waypoint, dt_s: float) -> float:
...         return 0.5 * (self.speed_mps - view.own.speed_mps)
>>> isinstance(Stubborn(), WaypointDriver)
True
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from scenewright.drive.protocol import EgoMotion, VehicleState

if TYPE_CHECKING:
    from scenewright.roads.model import RoadMap
    from scenewright.roads.routes import Route

_LEAST_TIME_S = 0.1
_LEAST_WAY_M = 0.05


@dataclass(frozen=True, slots=True)
class Waypoint:
    """Where the vehicle is to be, and when: a point in the map's frame, the heading there, and a time of the run."""

    x_m: float
    y_m: float
    heading_rad: float
    time_s: float


@dataclass(frozen=True, slots=True)
class DriverStart:
    """What a driver model is told when it takes over.

    Attributes
    ----------
    history
        The vehicle's own states so far, one a step, the last one at the moment of taking over: a warm-up.
    others
        What the other vehicles did in the same steps, by name.
    seed
        Makes every random choice of the model repeatable.
    """

    route: Route
    road_map: RoadMap
    history: tuple[VehicleState, ...]
    others: dict[str, tuple[VehicleState, ...]]
    step_s: float
    seed: int


@dataclass(frozen=True, slots=True)
class View:
    """What the driver sees at one instant: its own vehicle, and where the others are, not where they are going."""

    time_s: float
    own: VehicleState
    others: tuple[VehicleState, ...]


@runtime_checkable
class WaypointDriver(Protocol):
    """Drives one hero from one waypoint to the next."""

    def reset(self, start: DriverStart) -> None:
        """Forget everything and take over; called once a run."""

    def step(self, view: View, waypoint: Waypoint, dt_s: float) -> float | EgoMotion:
        """Say what the vehicle does in the next `dt_s` seconds.

        Returns
        -------
        float or EgoMotion
            An acceleration along the route (m/s^2), or where a model of its own would put the vehicle; of that its
            speed counts, for heroes keep to the middle of their route. Either is cut to what the vehicle can do.
        """


@dataclass(slots=True)
class SteadyFollower:
    """Takes the one acceleration that leads to its waypoint in time, as gently as people drive.

    Where that would carry it past the waypoint and back, it brakes to a stop there. It was chosen over the intelligent
    driver model at the waypoint's mean speed, which tracks worse.

    Attributes
    ----------
    accel_mpss, brake_mpss
        The most that it accelerates and brakes.
    """

    accel_mpss: float = 2.5
    brake_mpss: float = 4.0
    _route: Route | None = field(init=False, default=None, repr=False)
    _waypoint: Waypoint | None = field(init=False, default=None, repr=False)
    _place_m: float = field(init=False, default=0.0, repr=False)

    def reset(self, start: DriverStart) -> None:
        """Take over; the warm-up tells it nothing that it needs."""
        self._route, self._waypoint = start.route, None

    def step(self, view: View, waypoint: Waypoint, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        own_m, speed = view.own.s_m, view.own.speed_mps
        if self._route is None or own_m is None:
            raise RuntimeError("step() was called before reset()")
        if waypoint is not self._waypoint:
            self._waypoint = waypoint
            self._place_m = self._route.path.to_frenet(waypoint.x_m, waypoint.y_m, waypoint.heading_rad)[0]
        left_m = max(_LEAST_WAY_M, self._place_m - own_m)
        left_s = max(_LEAST_TIME_S, waypoint.time_s - view.time_s)
        if 2.0 * left_m < speed * left_s:
            return -min(self.brake_mpss, speed * speed / (2.0 * left_m))
        wanted_mpss = 2.0 * (left_m - speed * left_s) / left_s**2
        return max(-self.brake_mpss, min(self.accel_mpss, wanted_mpss))
