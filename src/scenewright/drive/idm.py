"""The careful driver as a policy: the intelligent driver model, with manners at junctions.

What enters: options, the start, and what it sees. What leaves: an acceleration along its route. How it drives is in
`driver`; this module only gives it options and a name.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from scenewright.drive.driver import Driver, Traits, wanted_speeds
from scenewright.drive.options import SPEED_MAX_MPS, require
from scenewright.drive.protocol import EgoStart, Envelope, Observation

_IMPATIENCE = 0.25


@dataclass(slots=True)
class Idm:
    """Follows, slows down for curves, stops at the stop line, yields where it must, and takes gaps.

    Attributes
    ----------
    speed_mps
        Its own speed limit; None for the roads' limits alone.
    headway_s, standstill_m, accel_mpss, brake_mpss
        The intelligent driver model's time headway, standstill gap, acceleration and comfortable deceleration.
    lateral_mpss
        Comfortable lateral acceleration in curves.
    min_stop_s
        How long it stands at a driveway's stop line.
    critical_gap_s
        It goes before a vehicle that arrives later than this, and later than it needs to cross.
    patience_s
        How long it waits for a vehicle that stands; up to a quarter longer, by the seed, so that two of them do not
        set off together for ever.
    envelope
        Its promise: 5 % over the speed it wants at most, and accelerations up to emergency braking.
    """

    speed_mps: float | None = None
    headway_s: float = 1.2
    standstill_m: float = 2.0
    accel_mpss: float = 1.5
    brake_mpss: float = 2.0
    lateral_mpss: float = 2.5
    min_stop_s: float = 0.8
    critical_gap_s: float = 4.5
    patience_s: float = 2.0
    envelope: Envelope = field(init=False)
    _driver: Driver | None = field(init=False, default=None, repr=False)

    def __post_init__(self) -> None:
        positive = ("speed_mps", "accel_mpss", "brake_mpss", "lateral_mpss")
        require("idm", self, positive, above=0.0)
        require("idm", self, ("headway_s", "standstill_m", "min_stop_s", "critical_gap_s", "patience_s"), least=0.0)
        emergency_mpss = self._traits(self.patience_s).emergency_mpss
        speed_max_mps = SPEED_MAX_MPS if self.speed_mps is None else 1.05 * self.speed_mps
        self.envelope = Envelope(speed_max_mps, -emergency_mpss, self.accel_mpss)

    def preferred_speed_mps(self, start: EgoStart) -> float | None:
        """Return the speed it wants where it starts, as if nobody else were there."""
        return wanted_speeds(self._traits(self.patience_s), start).at(start.s_m)

    def reset(self, start: EgoStart) -> None:
        """Take a new driver for a new run."""
        generator = np.random.default_rng(start.seed)
        patience_s = self.patience_s * (1.0 + _IMPATIENCE * float(generator.random()))
        self._driver = Driver(self._traits(patience_s), start)
        self.envelope = self._driver.envelope

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2 for the next step."""
        if self._driver is None:
            raise RuntimeError("step() was called before reset()")
        return self._driver.accelerate(observation, dt_s)

    def _traits(self, patience_s: float) -> Traits:
        return Traits(
            desired_mps=self.speed_mps,
            headway_s=self.headway_s,
            standstill_m=self.standstill_m,
            accel_mpss=self.accel_mpss,
            brake_mpss=self.brake_mpss,
            lateral_mpss=self.lateral_mpss,
            min_stop_s=self.min_stop_s,
            critical_gap_s=self.critical_gap_s,
            patience_s=patience_s,
        )
