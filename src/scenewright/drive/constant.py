"""A policy that holds its speed: the simplest ego there is, and the one that is easiest to reason about.

What enters: the start. What leaves: zero acceleration, or the way to a speed that was asked for. It sees nobody.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.drive.options import SPEED_MAX_MPS, require
from scenewright.drive.protocol import EgoStart, Envelope, Observation

_ACCEL_MPSS = 2.0
_SAME_SPEED_MPS = 1e-6


@dataclass(slots=True)
class Constant:
    """Holds the speed it starts with, or goes to `speed_mps` and holds that.

    Attributes
    ----------
    speed_mps
        The speed to hold; None for the one it starts with.
    envelope
        Promises to hold its speed, unless it starts with another than `speed_mps`.
    """

    speed_mps: float | None = None
    envelope: Envelope = field(init=False)

    def __post_init__(self) -> None:
        require("constant", self, ("speed_mps",), least=0.0)
        speed_max_mps = SPEED_MAX_MPS if self.speed_mps is None else self.speed_mps
        self.envelope = Envelope(speed_max_mps, 0.0, 0.0, holds_speed=True)

    def preferred_speed_mps(self, start: EgoStart) -> float | None:
        """Return the speed that was asked for, or None for whatever the run begins with."""
        return self.speed_mps

    def reset(self, start: EgoStart) -> None:
        """Renew the promise, which is about the speed at the start."""
        target_mps = start.speed_mps if self.speed_mps is None else self.speed_mps
        if abs(target_mps - start.speed_mps) <= _SAME_SPEED_MPS:
            self.envelope = Envelope(start.speed_mps, 0.0, 0.0, holds_speed=True)
        else:
            self.envelope = Envelope(max(target_mps, start.speed_mps), -_ACCEL_MPSS, _ACCEL_MPSS)

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2 that leads to the speed to hold."""
        if self.speed_mps is None or self.envelope.holds_speed:
            return 0.0
        return min(_ACCEL_MPSS, max(-_ACCEL_MPSS, (self.speed_mps - observation.ego.speed_mps) / dt_s))
