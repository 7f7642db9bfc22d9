"""Twelve egos that nobody tuned for: unsteady, late, coarse, or out to spoil what was planned.

What enters: nothing but what a policy sees. What leaves: accelerations. ``scenewright bench --egos
tools/more_egos.py:Sprinter,...`` takes them; `docs/evaluation.md` says how often scenarios happen against them. All but
the first three are a careful driver (`drive.idm`) with something done to it; chance comes from the seed.
"""

from __future__ import annotations

from collections import deque
from math import hypot, pi, sin

import numpy as np

from scenewright.drive.idm import Idm
from scenewright.drive.protocol import EgoStart, Observation


class Waverer:
    """Knows no speed but around the one it started at: presses and lifts, every four seconds."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        return max(1.2 * sin(2 * pi * observation.time_s / 4.0), -observation.ego.speed_mps / dt_s)


class Sprinter:
    """Holds its speed, and speeds up as soon as anybody else is within 60 m."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""
        self.top_mps = 1.3 * start.speed_limit_mps

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        return 2.0 if nearest_m(observation) < 60.0 and observation.ego.speed_mps < self.top_mps else 0.0


class Spoiler:
    """Speeds up while another comes nearer, and brakes while it moves away: no meeting is as planned."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""
        self.top_mps, self.before_m = 1.2 * start.speed_limit_mps, float("inf")

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        distance_m, speed_mps = nearest_m(observation), observation.ego.speed_mps
        nearing, self.before_m = distance_m < self.before_m, distance_m
        if distance_m > 50.0:
            return 0.0
        return (1.0 if speed_mps < self.top_mps else 0.0) if nearing else max(-1.0, -speed_mps / dt_s)


def nearest_m(observation: Observation) -> float:
    """Return how far the nearest other vehicle is (m); infinite where there is none."""
    ego = observation.ego
    return min((hypot(o.x_m - ego.x_m, o.y_m - ego.y_m) for o in observation.others), default=float("inf"))


class _Careful:
    """A careful driver with something done to what it does."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""
        self.driver, self.generator = Idm(), np.random.default_rng(start.seed)
        self.driver.reset(start)
        self.begin(start)

    def begin(self, start: EgoStart) -> None:
        """Prepare what it needs besides."""

    def preferred_speed_mps(self, start: EgoStart) -> float | None:
        """Return the speed in m/s it wants where it starts."""
        return Idm().preferred_speed_mps(start)

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        accel = self.changed(self.driver.step(observation, dt_s), observation, dt_s)
        return max(accel, -observation.ego.speed_mps / dt_s)

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        """Return what becomes of the careful driver's acceleration (m/s^2)."""
        raise NotImplementedError


class LateBraker(_Careful):
    """Brakes for nothing until it has to brake hard."""

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        return accel_mpss if accel_mpss > 0.0 else 1.4 * accel_mpss if accel_mpss < -1.8 else 0.0


class Flincher(_Careful):
    """Brakes for half a second whenever another comes within 45 m, once each two seconds."""

    def begin(self, start: EgoStart) -> None:
        self.since_s = -2.0

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        if nearest_m(observation) < 45.0 and observation.time_s >= self.since_s + 2.0:
            self.since_s = observation.time_s
        return min(accel_mpss, -2.5) if observation.time_s < self.since_s + 0.5 else accel_mpss


class Stepper(_Careful):
    """Decides twice a second, in steps of 1 m/s^2."""

    def begin(self, start: EgoStart) -> None:
        self.until_s, self.held_mpss = -1.0, 0.0

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        if observation.time_s >= self.until_s:
            self.until_s, self.held_mpss = observation.time_s + 0.5, float(round(accel_mpss))
        return self.held_mpss


class Sleeper(_Careful):
    """Does what was right 0.7 s ago."""

    def begin(self, start: EgoStart) -> None:
        self.waiting = deque[float]()

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        self.waiting.append(accel_mpss)
        return self.waiting.popleft() if len(self.waiting) > 0.7 / dt_s else 0.0


class Tapper(_Careful):
    """Taps its brake for 0.4 s at random moments, every 3 s on average."""

    def begin(self, start: EgoStart) -> None:
        self.next_s = float(self.generator.exponential(3.0))

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        if observation.time_s > self.next_s + 0.4:
            self.next_s = observation.time_s + float(self.generator.exponential(3.0))
        return min(accel_mpss, -3.0) if observation.time_s >= self.next_s else accel_mpss


class Drifter(_Careful):
    """Has a foot that wanders: up to 0.8 m/s^2 more or less, anew every 1.5 s."""

    def begin(self, start: EgoStart) -> None:
        self.until_s, self.more_mpss = -1.0, 0.0

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        if observation.time_s >= self.until_s:
            self.until_s, self.more_mpss = observation.time_s + 1.5, float(self.generator.uniform(-0.8, 0.8))
        return accel_mpss + self.more_mpss


class Learner(_Careful):
    """Goes gently, and brakes twice as hard as need be."""

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        return 0.4 * accel_mpss if accel_mpss > 0.0 else max(-8.0, 2.0 * accel_mpss)


class Phoner(_Careful):
    """Looks up for a second, and away for one and a half: then it goes on as fast as it is."""

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        return accel_mpss if observation.time_s % 2.5 < 1.0 else 0.0


class Waiter(_Careful):
    """Stands for three seconds, once, 12 s after the start or when it is slow, whichever comes first."""

    def begin(self, start: EgoStart) -> None:
        self.until_s = float("inf")

    def changed(self, accel_mpss: float, observation: Observation, dt_s: float) -> float:
        slow = observation.time_s > 1.0 and observation.ego.speed_mps < 3.0
        if self.until_s == float("inf") and (slow or observation.time_s > 12.0):
            self.until_s = observation.time_s + 3.0
        return min(accel_mpss, -3.0) if self.until_s - 3.0 <= observation.time_s < self.until_s else accel_mpss
