"""A tiny world for policies: vehicles that move along routes, one Euler step at a time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from math import cos, sin

from scenewright.drive.protocol import EgoPolicy, EgoStart, Observation, VehicleState
from scenewright.roads import Route, find_route, load_map

DT_S = 0.02
LENGTH_M, WIDTH_M = 4.5, 1.9
T_MAP = load_map("t_intersection")


def route(*headings: str) -> Route:
    return find_route(T_MAP, headings=headings)


@dataclass
class Car:
    """A vehicle on a route; `drive(time_s, car)` gives its acceleration."""

    name: str
    route: Route
    s_m: float
    speed_mps: float
    drive: Callable[[float, Car], float] = lambda time_s, car: 0.0
    accel_mpss: float = 0.0

    def state(self, *, secret: bool = True) -> VehicleState:
        x, y, heading = self.route.path.pose(self.s_m)
        known = (None, None) if secret else (self.s_m, self.route)
        return VehicleState(self.name, x, y, heading, self.speed_mps, self.accel_mpss, LENGTH_M, WIDTH_M, *known)

    def move(self, accel_mpss: float) -> None:
        before = self.speed_mps
        self.speed_mps = max(0.0, before + accel_mpss * DT_S)
        self.accel_mpss = (self.speed_mps - before) / DT_S
        self.s_m += 0.5 * (before + self.speed_mps) * DT_S


@dataclass
class Log:
    """What the ego did, step by step, and how near the others came."""

    time_s: list[float] = field(default_factory=list)
    s_m: list[float] = field(default_factory=list)
    speed_mps: list[float] = field(default_factory=list)
    accel_mpss: list[float] = field(default_factory=list)
    others_s_m: list[list[float]] = field(default_factory=list)
    collided: bool = False

    def passed_s(self, s_m: float) -> float:
        """Return when the ego's centre passed a place; infinity where it never did."""
        return next((t for t, s in zip(self.time_s, self.s_m, strict=True) if s >= s_m), float("inf"))

    def other_passed_s(self, index: int, s_m: float) -> float:
        return next(
            (t for t, all_s in zip(self.time_s, self.others_s_m, strict=True) if all_s[index] >= s_m), float("inf")
        )

    def halts(self, below_mps: float = 0.05) -> list[float]:
        """Return the places at which the ego came to stand."""
        pairs = zip(self.speed_mps, self.speed_mps[1:], self.s_m[1:], strict=False)
        return [s for before, after, s in pairs if before >= below_mps > after]


def start_of(ego: Route, s_m: float, speed_mps: float, seed: int = 1) -> EgoStart:
    return EgoStart(ego, T_MAP, s_m, speed_mps, 13.89, seed, LENGTH_M, WIDTH_M)


def drive(
    policy: EgoPolicy, ego: Route, s_m: float, speed_mps: float, others: list[Car], duration_s: float, seed: int = 1
) -> Log:
    """Let a policy drive among scripted cars, whose routes it does not know."""
    policy.reset(start_of(ego, s_m, speed_mps, seed))
    car, log = Car("ego", ego, s_m, speed_mps), Log()
    for step in range(round(duration_s / DT_S)):
        time_s = step * DT_S
        states = tuple(other.state() for other in others)
        mine = car.state(secret=False)
        log.collided = log.collided or any(overlap(mine, state) for state in states)
        accel = policy.step(Observation(time_s, mine, states), DT_S)
        log.time_s.append(time_s)
        log.s_m.append(car.s_m)
        log.speed_mps.append(car.speed_mps)
        log.accel_mpss.append(float(accel))
        log.others_s_m.append([other.s_m for other in others])
        for other in others:
            other.move(other.drive(time_s, other))
        car.move(float(accel))
    return log


def overlap(a: VehicleState, b: VehicleState) -> bool:
    """Return whether two boxes overlap (separating axes)."""
    dx, dy = b.x_m - a.x_m, b.y_m - a.y_m
    for heading in (a.heading_rad, b.heading_rad):
        for axis_x, axis_y in ((cos(heading), sin(heading)), (-sin(heading), cos(heading))):
            reach = sum(
                0.5 * v.length_m * abs(axis_x * cos(v.heading_rad) + axis_y * sin(v.heading_rad))
                + 0.5 * v.width_m * abs(-axis_x * sin(v.heading_rad) + axis_y * cos(v.heading_rad))
                for v in (a, b)
            )
            if abs(dx * axis_x + dy * axis_y) >= reach:
                return False
    return True
