"""Policies that make a scenario hard to orchestrate: too fast, too slow, unsteady, late.

What enters: options, the start with its seed, and what it sees. What leaves: an acceleration along its route. Each is
the careful driver of `driver` with other traits, or with something done to what it sees or wants; chance comes from
the seed.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from math import exp, sqrt

import numpy as np

from scenewright.drive.driver import Driver, Traits, wanted_speeds
from scenewright.drive.options import require
from scenewright.drive.protocol import EgoStart, Envelope, Observation
from scenewright.drive.speeds import stopping_accel
from scenewright.errors import PolicyError

_NOISE_LIMIT = 3.0  # standard deviations; a foot does not twitch harder
_FIRM_MPSS = 3.0
_LEAST_DRIVE_S = 2.0


@dataclass(slots=True)
class _OnDriver:
    """What all of them share: a driver made anew for every run, and a generator."""

    envelope: Envelope | None = field(init=False, default=None)
    _driver: Driver | None = field(init=False, default=None, repr=False)
    _generator: np.random.Generator = field(init=False, repr=False, default_factory=np.random.default_rng)

    def preferred_speed_mps(self, start: EgoStart) -> float | None:
        """Return the speed in m/s it wants where it starts, as if nobody else were there."""
        return wanted_speeds(self._traits(np.random.default_rng(start.seed)), start).at(start.s_m)

    def reset(self, start: EgoStart) -> None:
        """Take a new driver and a new generator for a new run."""
        self._generator = np.random.default_rng(start.seed)
        self._driver = Driver(self._traits(self._generator), start)
        self.envelope = self._driver.envelope
        self._begin()

    def _traits(self, generator: np.random.Generator) -> Traits:
        """Return who drives; the first draws from a new generator decide what the seed decides."""
        return Traits()

    def _begin(self) -> None:
        """Prepare what a run needs beyond the driver."""

    def _ready(self) -> Driver:
        if self._driver is None:
            raise RuntimeError("step() was called before reset()")
        return self._driver

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2 for the next step."""
        return self._ready().accelerate(observation, dt_s)


@dataclass(slots=True)
class Speeder(_OnDriver):
    """Drives 30 to 50 % over the limit, accelerates hard, ignores stop line and priority; follows what is in its lane.

    Attributes
    ----------
    factor
        What it makes of a limit; None for 1.3 to 1.5 by the seed.
    accel_mpss
        How hard it accelerates.
    """

    factor: float | None = None
    accel_mpss: float = 3.0

    def __post_init__(self) -> None:
        require("speeder", self, ("factor", "accel_mpss"), above=0.0)

    def _traits(self, generator: np.random.Generator) -> Traits:
        factor = float(generator.uniform(1.3, 1.5)) if self.factor is None else self.factor
        return Traits(
            limit_factor=factor, accel_mpss=self.accel_mpss, brake_mpss=3.5, headway_s=0.8, lateral_mpss=3.0,
            lawful=False,
        )  # fmt: skip


@dataclass(slots=True)
class Dawdler(_OnDriver):
    """Drives at 40 to 60 % of the limit and accelerates gently; stops and yields like the careful driver.

    Attributes
    ----------
    factor
        What it makes of a limit; None for 0.4 to 0.6 by the seed.
    accel_mpss
        How hard it accelerates.
    """

    factor: float | None = None
    accel_mpss: float = 0.8

    def __post_init__(self) -> None:
        require("dawdler", self, ("factor", "accel_mpss"), above=0.0)

    def _traits(self, generator: np.random.Generator) -> Traits:
        factor = float(generator.uniform(0.4, 0.6)) if self.factor is None else self.factor
        return Traits(limit_factor=factor, accel_mpss=self.accel_mpss, brake_mpss=1.5, headway_s=2.0)


@dataclass(slots=True)
class Staller(_OnDriver):
    """Drives carefully, but comes to a stop at random moments, for 1.5 to 4 s.

    Attributes
    ----------
    every_s
        The mean time that it drives between two stops, 2 s of it certain.
    """

    every_s: float = 8.0
    _next_s: float = field(init=False, default=0.0, repr=False)
    _until_s: float | None = field(init=False, default=None, repr=False)
    _stall_s: float = field(init=False, default=0.0, repr=False)

    def __post_init__(self) -> None:
        require("staller", self, ("every_s",), above=0.0)

    def _begin(self) -> None:
        self._until_s = None
        self._draw(0.0)

    def _draw(self, time_s: float) -> None:
        rest_s = max(0.0, self.every_s - _LEAST_DRIVE_S)
        self._next_s = time_s + min(_LEAST_DRIVE_S, self.every_s) + float(self._generator.exponential(rest_s))
        self._stall_s = float(self._generator.uniform(1.5, 4.0))

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2: the careful driver's, or firm braking to a stop and staying there."""
        driver, time_s, speed_mps = self._ready(), observation.time_s, observation.ego.speed_mps
        accel = driver.accelerate(observation, dt_s)
        if time_s < self._next_s:
            return accel
        if self._until_s is None and speed_mps < 0.05:
            self._until_s = time_s + self._stall_s  # the stall counts from standstill
        if self._until_s is not None and time_s >= self._until_s:
            self._until_s = None
            self._draw(time_s)
            return accel
        return driver.bounded(min(accel, -_FIRM_MPSS), speed_mps, dt_s)


@dataclass(slots=True)
class StopAndGo(_OnDriver):
    """Changes between going, for 2 to 5 s, and crawling at 0 to 1.5 m/s, for 1.5 to 3.5 s.

    Attributes
    ----------
    crawl_mps
        The fastest that it crawls; about every third crawl is a stop.
    """

    crawl_mps: float = 1.5
    _going: bool = field(init=False, default=True, repr=False)
    _until_s: float = field(init=False, default=0.0, repr=False)
    _slow_mps: float = field(init=False, default=0.0, repr=False)

    def __post_init__(self) -> None:
        require("stop-and-go", self, ("crawl_mps",), least=0.0)

    def _begin(self) -> None:
        self._going = True
        self._until_s = float(self._generator.uniform(2.0, 5.0))

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2: the careful driver's, held down to a crawl at times."""
        driver, speed_mps = self._ready(), observation.ego.speed_mps
        if observation.time_s >= self._until_s:
            self._going = not self._going
            low_s, high_s = (2.0, 5.0) if self._going else (1.5, 3.5)
            self._until_s = observation.time_s + float(self._generator.uniform(low_s, high_s))
            self._slow_mps = max(0.0, float(self._generator.uniform(-0.5, 1.0))) * self.crawl_mps
        accel = driver.accelerate(observation, dt_s)
        if self._going:
            return accel
        crawl = max(-_FIRM_MPSS, 2.0 * (self._slow_mps - speed_mps))
        if self._slow_mps == 0.0:
            crawl = min(crawl, stopping_accel(speed_mps, 0.0, _FIRM_MPSS) if speed_mps < 0.3 else crawl)
        return driver.bounded(min(accel, crawl), speed_mps, dt_s)


@dataclass(slots=True)
class Noisy(_OnDriver):
    """Drives carefully with an unsteady foot: correlated noise on its acceleration.

    Attributes
    ----------
    sigma_mpss
        The standard deviation of the noise.
    correlation_s
        How long it takes to forget itself.
    """

    sigma_mpss: float = 0.5
    correlation_s: float = 1.0
    _noise_mpss: float = field(init=False, default=0.0, repr=False)

    def __post_init__(self) -> None:
        require("noisy", self, ("sigma_mpss",), least=0.0)
        require("noisy", self, ("correlation_s",), above=0.0)

    def _begin(self) -> None:
        self._noise_mpss = self.sigma_mpss * float(self._generator.standard_normal())
        # The foot may twitch beyond what the driver wants, so the promise is wider by as much.
        promise, most = self._ready().envelope, _NOISE_LIMIT * self.sigma_mpss
        self.envelope = Envelope(promise.speed_max_mps, promise.accel_min_mpss, promise.accel_max_mpss + most)
        self._ready().envelope = self.envelope

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2: the careful driver's, disturbed while it moves."""
        driver, speed_mps = self._ready(), observation.ego.speed_mps
        keep = exp(-dt_s / self.correlation_s)
        fresh = self.sigma_mpss * sqrt(1.0 - keep * keep) * float(self._generator.standard_normal())
        most = _NOISE_LIMIT * self.sigma_mpss
        self._noise_mpss = min(most, max(-most, keep * self._noise_mpss + fresh))
        accel = driver.accelerate(observation, dt_s)
        if speed_mps == 0.0 and accel <= 0.0:
            return accel  # a foot on the brake of a standing car moves nothing
        return driver.bounded(accel + self._noise_mpss, speed_mps, dt_s)


@dataclass(slots=True)
class Delayed(_OnDriver):
    """Drives carefully, but acts on what it saw a while ago, of itself and of the others.

    Attributes
    ----------
    delay_s
        How old what it acts on is; at first it acts on what it saw first.
    """

    delay_s: float = 0.4
    _seen: deque[Observation] = field(init=False, default_factory=deque, repr=False)

    def __post_init__(self) -> None:
        require("delayed", self, ("delay_s",), least=0.0)
        if self.delay_s > 2.0:
            raise PolicyError(
                "option 'delay_s' of 'delayed' is out of range",
                found=f"{self.delay_s:g}",
                expected="0 to 2 s: nobody drives with more",
                fix="give a smaller value, or leave the option out",
            )

    def _begin(self) -> None:
        self._seen.clear()

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return the acceleration in m/s^2 that was right a while ago."""
        driver, seen = self._ready(), self._seen
        seen.append(observation)
        while len(seen) > 1 and seen[1].time_s <= observation.time_s - self.delay_s + 1e-9:
            seen.popleft()
        return driver.bounded(driver.accelerate(seen[0], dt_s), observation.ego.speed_mps, dt_s)
