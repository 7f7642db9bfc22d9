"""Policies that drive well for a while and then do what they must not, to be named as ``misbehaving:Class``."""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.drive.protocol import EgoMotion, EgoStart, Envelope, Observation

LATE_S = 3.0


@dataclass
class _Late:
    """Holds its speed. After a while in a run, not when it is rehearsed alone, it misbehaves."""

    after_s: float = LATE_S

    def reset(self, start: EgoStart) -> None:
        pass

    def step(self, observation: Observation, dt_s: float) -> float | EgoMotion:
        if observation.others and observation.time_s >= self.after_s:
            return self.misbehave(observation)
        return 0.0

    def misbehave(self, observation: Observation) -> float | EgoMotion:
        raise NotImplementedError


class Raises(_Late):
    def misbehave(self, observation: Observation) -> float:
        raise ZeroDivisionError("no more fuel")


class ReturnsNaN(_Late):
    def misbehave(self, observation: Observation) -> float:
        return float("nan")


class ReturnsNothing(_Late):
    def misbehave(self, observation: Observation) -> float:
        return None  # type: ignore[return-value]


class Teleports(_Late):
    def misbehave(self, observation: Observation) -> EgoMotion:
        ego = observation.ego
        return EgoMotion(ego.x_m + 40.0, ego.y_m, ego.heading_rad, ego.speed_mps)


class LeavesItsRoute(_Late):
    def misbehave(self, observation: Observation) -> EgoMotion:
        ego = observation.ego
        return EgoMotion(ego.x_m, ego.y_m + 0.5, ego.heading_rad, ego.speed_mps)


class IsInterrupted(_Late):
    """Stands for the user who presses Ctrl-C while the run goes on."""

    def misbehave(self, observation: Observation) -> float:
        raise KeyboardInterrupt


@dataclass
class Drives(_Late):
    """An ego with a vehicle model of its own, which is a point that goes straight ahead."""

    speed_mps: float = 9.0

    def preferred_speed_mps(self, start: EgoStart) -> float:
        return self.speed_mps

    def reset(self, start: EgoStart) -> None:
        self.route = start.route

    def step(self, observation: Observation, dt_s: float) -> EgoMotion:
        ego = observation.ego
        assert ego.s_m is not None
        return EgoMotion(*self.route.path.pose(ego.s_m + self.speed_mps * dt_s), self.speed_mps)


@dataclass
class Modest(_Late):
    """Holds the speed that it starts with, and promises that this is no more than so."""

    most_mps: float = 6.0
    holds_speed: bool = True

    def __post_init__(self) -> None:
        self.envelope = Envelope(self.most_mps, -3.0, 3.0, self.holds_speed)

    def misbehave(self, observation: Observation) -> float:
        return 0.0
