"""A policy in a cage: whatever it does wrong becomes one error that says which policy, when, and what.

What enters: any policy. What leaves: a policy that returns a plain finite acceleration or a plausible `EgoMotion`, or
raises `PolicyError`. What is odd but can be driven (commands that no car can follow, broken promises) is kept as
findings.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import hypot, isfinite
from typing import TypeGuard

import numpy as np

from scenewright.drive.protocol import EgoMotion, EgoPolicy, EgoStart, Envelope, Observation
from scenewright.errors import PolicyError, shown_as, told_by

ACCEL_MIN_MPSS, ACCEL_MAX_MPSS = -12.0, 8.0  # what tyres and engines can do at most
SPEED_MAX_MPS = 100.0
_TELEPORT_MARGIN_M = 1.0
_OFF_ROUTE_M = 5.0
_ROLL_BACK_MPS = 0.05  # rounding in a vehicle model, not reversing
_SLACK_MPSS, _SLACK_MPS = 1e-6, 1e-3  # rounding of accelerations, and of the speeds of a vehicle model


@dataclass(slots=True)
class GuardedPolicy:
    """Wraps a policy.

    Attributes
    ----------
    policy, name
        The policy, and what messages call it.
    findings
        What was odd since the last `reset`, one sentence each, each kind once with its first time.
    """

    policy: EgoPolicy
    name: str = "ego"
    findings: list[str] = field(init=False, default_factory=list)
    _start: EgoStart | None = field(init=False, default=None, repr=False)
    _seen: set[str] = field(init=False, default_factory=set, repr=False)
    _envelope: Envelope | None = field(init=False, default=None, repr=False)

    @property
    def envelope(self) -> Envelope | None:
        """The promise that the policy makes, or None.

        Raises
        ------
        PolicyError
            If it is not an `Envelope` of finite numbers in order.
        """
        with self._own("its envelope"):
            promise: object = getattr(self.policy, "envelope", None)
        if promise is None:
            return None
        if not isinstance(promise, Envelope) or not _makes_sense(promise):
            raise PolicyError(
                f"the envelope of policy {self.name!r} makes no sense",
                found=shown_as(promise),
                expected="Envelope(speed_max_mps >= 0, accel_min_mpss <= 0, accel_max_mpss >= 0), all finite",
                fix="correct the envelope, or leave it out: it is optional",
            )
        return promise

    def promise_from(self, start: EgoStart | None) -> Envelope | None:
        """Return what the policy promises of a run that begins so: what it does before it is reset, and reset there.

        Where both differ, the wider of both; None where it promises nothing. No start is any that it would choose.
        """
        before = self.envelope
        if start is None or before is None:
            return before
        self.reset(start)
        then = self.envelope
        return then and Envelope(
            max(before.speed_max_mps, then.speed_max_mps),
            min(before.accel_min_mpss, then.accel_min_mpss),
            max(before.accel_max_mpss, then.accel_max_mpss),
            before.holds_speed and then.holds_speed,
        )

    def preferred_speed_mps(self, start: EgoStart) -> float | None:
        """Return the speed in m/s that the policy would hold by itself, or None where it does not say."""
        with self._own("preferred_speed_mps()"):
            ask = getattr(self.policy, "preferred_speed_mps", None)
            speed_mps: object = None if ask is None else ask(start)
        if speed_mps is None:
            return None
        if not _is_number(speed_mps) or not 0.0 <= speed_mps <= SPEED_MAX_MPS:
            raise PolicyError(
                f"preferred_speed_mps() of policy {self.name!r} is not a speed",
                found=shown_as(speed_mps),
                expected=f"a number from 0 to {SPEED_MAX_MPS:g} m/s, or None",
                fix="return None where there is no such speed",
            )
        return float(speed_mps)

    def reset(self, start: EgoStart) -> None:
        """Reset the policy and forget all findings.

        Raises
        ------
        PolicyError
            If the policy raises, or its envelope makes no sense.
        """
        self._start = start
        self.findings.clear()
        self._seen.clear()
        with self._own("reset()"):
            self.policy.reset(start)
        self._envelope = self.envelope

    def step(self, observation: Observation, dt_s: float) -> float | EgoMotion:
        """Return what the policy does in the next `dt_s` seconds, as plain finite numbers.

        Raises
        ------
        PolicyError
            If the policy raises, returns anything but a finite number or an `EgoMotion`, jumps, reverses, or
            leaves its route by more than 5 m.
        """
        with self._own(f"step() at {observation.time_s:.2f} s"):
            action: object = self.policy.step(observation, dt_s)
        if isinstance(action, EgoMotion):
            return self._checked_motion(action, observation, dt_s)
        if not _is_number(action):
            raise self._fault(
                "returned something that is not a motion", observation.time_s, shown_as(action),
                "a finite acceleration in m/s^2, or an EgoMotion", "return a number from step() in every case",
            )  # fmt: skip
        return self._checked_accel(float(action), observation)

    def _checked_accel(self, accel_mpss: float, observation: Observation) -> float:
        clipped_mpss = min(ACCEL_MAX_MPSS, max(ACCEL_MIN_MPSS, accel_mpss))
        if clipped_mpss != accel_mpss:
            self._find(
                "clipped", observation.time_s,
                f"asked for {accel_mpss:.1f} m/s^2 and got {clipped_mpss:.1f} m/s^2, the most that a car can do",
            )  # fmt: skip
        self._check_promise(accel_mpss, _SLACK_MPSS, observation.ego.speed_mps, observation)
        return clipped_mpss

    def _check_promise(self, accel_mpss: float, slack_mpss: float, speed_mps: float, observation: Observation) -> None:
        promise, time_s = self._envelope, observation.time_s
        if promise is None:
            return
        low_mpss, high_mpss = promise.accel_min_mpss, promise.accel_max_mpss
        bounds = f"{low_mpss:g} to {high_mpss:g} m/s^2"
        if promise.holds_speed:
            low_mpss, high_mpss, bounds = 0.0, 0.0, "to hold its speed"
        # A standing car does not roll back, so braking at standstill moves nothing and breaks no promise.
        moves = accel_mpss > 0.0 or observation.ego.speed_mps > 0.0
        if moves and not low_mpss - slack_mpss <= accel_mpss <= high_mpss + slack_mpss:
            self._find("accel", time_s, f"asked for {accel_mpss:.2f} m/s^2, but its envelope promises {bounds}")
        if speed_mps > promise.speed_max_mps + _SLACK_MPS:
            self._find(
                "speed", time_s,
                f"drives {speed_mps:.2f} m/s, but its envelope promises at most {promise.speed_max_mps:.2f} m/s",
            )  # fmt: skip

    def _checked_motion(self, motion: EgoMotion, observation: Observation, dt_s: float) -> EgoMotion:
        time_s, ego = observation.time_s, observation.ego
        numbers = (motion.x_m, motion.y_m, motion.heading_rad, motion.speed_mps)
        if not all(map(_is_number, numbers)):
            raise self._fault(
                "returned a motion that is not made of finite numbers", time_s, shown_as(motion),
                "finite x_m, y_m, heading_rad and speed_mps", "check the vehicle model for a division by zero",
            )  # fmt: skip
        x_m, y_m, heading_rad, speed_mps = map(float, numbers)
        if not -_ROLL_BACK_MPS <= speed_mps <= SPEED_MAX_MPS:
            raise self._fault(
                "returned a speed that the ego cannot have", time_s, f"{speed_mps:g} m/s",
                f"0 to {SPEED_MAX_MPS:g} m/s along its heading", "stop at 0: an ego does not reverse",
            )  # fmt: skip
        moved_m = hypot(x_m - ego.x_m, y_m - ego.y_m)
        reach_m = max(speed_mps, ego.speed_mps) * dt_s + _TELEPORT_MARGIN_M
        if moved_m > reach_m:
            raise self._fault(
                "jumped", time_s, f"{moved_m:.2f} m from where the ego was",
                f"at most {reach_m:.2f} m at {max(speed_mps, ego.speed_mps):.1f} m/s in {dt_s:g} s",
                "move from observation.ego, by the speed that is returned",
            )  # fmt: skip
        self._check_on_route(x_m, y_m, observation)
        speed_mps = max(0.0, speed_mps)
        accel_mpss, slack_mpss = (speed_mps - ego.speed_mps) / dt_s, _SLACK_MPS / dt_s
        if not ACCEL_MIN_MPSS - slack_mpss <= accel_mpss <= ACCEL_MAX_MPSS + slack_mpss:
            self._find("beyond", time_s, f"drove {accel_mpss:.1f} m/s^2 by a motion of its own, more than a car can do")
        self._check_promise(accel_mpss, slack_mpss, speed_mps, observation)
        return EgoMotion(x_m, y_m, heading_rad, speed_mps)

    def _check_on_route(self, x_m: float, y_m: float, observation: Observation) -> None:
        if self._start is None:
            return
        s_m, d_m, _ = self._start.route.path.to_frenet(x_m, y_m, near_s_m=observation.ego.s_m)
        if abs(d_m) > _OFF_ROUTE_M:
            raise self._fault(
                "left its route", observation.time_s, f"{abs(d_m):.1f} m beside it at s = {s_m:.1f} m",
                f"at most {_OFF_ROUTE_M:g} m", "follow start.route.path; the scenario is defined on that route",
            )  # fmt: skip

    def _find(self, kind: str, time_s: float, text: str) -> None:
        if kind not in self._seen:
            self._seen.add(kind)
            self.findings.append(f"policy {self.name!r} at {time_s:.2f} s: {text}")

    def _fault(self, what: str, time_s: float, found: str, expected: str, fix: str) -> PolicyError:
        return PolicyError(f"policy {self.name!r} {what} at {time_s:.2f} s", found=found, expected=expected, fix=fix)

    @contextmanager
    def _own(self, where: str) -> Iterator[None]:
        """Turn whatever code of the policy's raises inside, or where it ends the process, into one error."""
        try:
            yield
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # code of a user's may raise anything, what no Exception is included
            raise PolicyError(
                f"policy {self.name!r} raised an exception in {where}",
                found=told_by(error),
                fix="correct the policy; run it alone with the same observation to see the whole traceback",
            ) from error


def _makes_sense(promise: Envelope) -> bool:
    numbers = (promise.speed_max_mps, promise.accel_min_mpss, promise.accel_max_mpss)
    if not all(map(_is_number, numbers)):
        return False
    return promise.speed_max_mps >= 0.0 and promise.accel_min_mpss <= 0.0 <= promise.accel_max_mpss


def _is_number(value: object) -> TypeGuard[float]:
    if type(value) is float:  # nearly all are, at every step
        return isfinite(value)
    if isinstance(value, bool | np.bool_) or not isinstance(value, float | int | np.floating | np.integer):
        return False
    try:
        return isfinite(value)
    except OverflowError:  # a whole number that is larger than any float
        return False
