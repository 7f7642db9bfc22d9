"""A textbook follower, written apart from the project's own."""

from __future__ import annotations

from scenewright.motion.limits import Signs
from scenewright.plan.following import Leader
from scenewright.plan.prediction import EgoSample

CRUISE_MPS = 13.9
SIGNS = Signs((0.0,), (CRUISE_MPS,))


def idm(moments: int, leader: Leader, s_m: float, speed_mps: float, headway_s: float) -> list[EgoSample]:
    """Drive it step by step."""
    accel_max, brake, standstill_m, step_s = 1.5, 2.0, 2.0, 0.02
    samples = []
    for k in range(moments):
        time_s = k * step_s
        room_m, leader_mps = leader.ahead(time_s, s_m)
        wanted_m = standstill_m + max(
            0.0, speed_mps * headway_s + speed_mps * (speed_mps - leader_mps) / (2 * (accel_max * brake) ** 0.5)
        )
        accel = accel_max * (1 - (speed_mps / CRUISE_MPS) ** 4 - (wanted_m / room_m) ** 2)
        samples.append((time_s, s_m, speed_mps, accel))
        s_m += speed_mps * step_s
        speed_mps = max(0.0, speed_mps + accel * step_s)
    return samples
