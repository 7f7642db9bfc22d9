"""Policies that answer a hero, or nobody, in plain ways, to be named as ``answering:Class``."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scenewright.drive.protocol import EgoMotion, EgoStart, Observation


@dataclass
class Heedless:
    """Keeps a speed, whoever is there."""

    keep_mps: float = 9.0

    def reset(self, start: EgoStart) -> None:
        self.began_m = start.s_m

    def step(self, observation: Observation, dt_s: float) -> float:
        return max(-3.0, min(1.5, 0.8 * (self.wanted(observation) - observation.ego.speed_mps)))

    def wanted(self, observation: Observation) -> float:
        return self.keep_mps

    def nearest_m(self, observation: Observation) -> float:
        ego = observation.ego
        return min((math.hypot(o.x_m - ego.x_m, o.y_m - ego.y_m) for o in observation.others), default=math.inf)


class Shy(Heedless):
    """Stops while anybody is within 40 m."""

    def wanted(self, observation: Observation) -> float:
        return 0.0 if self.nearest_m(observation) < 40.0 else self.keep_mps


class Early(Heedless):
    """Creeps while anybody is within 80 m."""

    def wanted(self, observation: Observation) -> float:
        return 4.0 if self.nearest_m(observation) < 80.0 else self.keep_mps


class Stops(Heedless):
    """Stops for good after 30 m, for nobody."""

    def wanted(self, observation: Observation) -> float:
        return 0.0 if observation.ego.s_m - self.began_m > 30.0 else self.keep_mps


class Creeps(Heedless):
    """Creeps from the beginning, for nobody."""

    def wanted(self, observation: Observation) -> float:
        return 3.0


class Swings(Heedless):
    """Its speed goes up and down, for nobody."""

    def wanted(self, observation: Observation) -> float:
        return self.keep_mps + 5.0 * math.sin(2.0 * math.pi * observation.time_s / 3.0)


@dataclass
class Strays:
    """Keeps 9 m/s, and from 3 s on leaves its line to the left, up to 1.5 m."""

    states_mps: float = 9.0

    def reset(self, start: EgoStart) -> None:
        self.path, self.s_m = start.route.path, start.s_m

    def beside_m(self, time_s: float) -> float:
        return min(1.5, max(0.0, 0.5 * (time_s - 3.0)))

    def preferred_speed_mps(self, start: EgoStart) -> float:
        return self.states_mps

    def step(self, observation: Observation, dt_s: float) -> EgoMotion:
        self.s_m += 9.0 * dt_s
        return EgoMotion(*self.path.to_cartesian(self.s_m, self.beside_m(observation.time_s)), self.states_mps)


@dataclass
class States(Strays):
    """Keeps 9 m/s on its line, and states 11 m/s."""

    states_mps: float = 11.0

    def beside_m(self, time_s: float) -> float:
        return 0.0
