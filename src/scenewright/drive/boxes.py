"""Whether vehicles touch, and how far one can drive along a path before it touches another.

What enters: poses and sizes of boxes, and a path. What leaves: yes or no, or metres. Nobody moves here but the one
asked about.
"""

from __future__ import annotations

from math import cos, sin

from scenewright.drive.protocol import VehicleState
from scenewright.roads import Path

_STEP_M = 0.5


def boxes_touch(
    pose_a: tuple[float, float, float],
    size_a_m: tuple[float, float],
    pose_b: tuple[float, float, float],
    size_b_m: tuple[float, float],
) -> bool:
    """Return whether two boxes overlap, by the separating axes of both.

    Parameters
    ----------
    pose_a, pose_b
        ``x_m, y_m, heading_rad`` of the centres.
    size_a_m, size_b_m
        Length and width.

    Examples
    --------
    >>> boxes_touch((0.0, 0.0, 0.0), (4.0, 2.0), (3.9, 0.0, 0.0), (4.0, 2.0))
    True
    >>> boxes_touch((0.0, 0.0, 0.0), (4.0, 2.0), (0.0, 2.1, 0.0), (4.0, 2.0))
    False
    """
    (x_a, y_a, heading_a), (x_b, y_b, heading_b) = pose_a, pose_b
    dx, dy = x_b - x_a, y_b - y_a
    cosine, sine = abs(cos(heading_b - heading_a)), abs(sin(heading_b - heading_a))
    for heading, (length_1, width_1), (length_2, width_2) in (
        (heading_a, size_a_m, size_b_m),
        (heading_b, size_b_m, size_a_m),
    ):
        along, across = cos(heading), sin(heading)
        if abs(dx * along + dy * across) > 0.5 * (length_1 + length_2 * cosine + width_2 * sine):
            return False
        if abs(dy * along - dx * across) > 0.5 * (width_1 + length_2 * sine + width_2 * cosine):
            return False
    return True


def free_way_m(path: Path, ego: VehicleState, ego_s_m: float, other: VehicleState, *, reach_m: float) -> float | None:
    """Return how far the ego can drive along its path before it touches another vehicle where that is now.

    Parameters
    ----------
    path, ego, ego_s_m
        Where the ego drives, its size, and its place on the path.
    other
        The vehicle that may be in the way.
    reach_m
        How far to look.

    Returns
    -------
    float or None
        Metres, to half a metre and never too many; None where it passes the other.
    """
    there = (other.x_m, other.y_m, other.heading_rad)
    sizes = (ego.length_m, ego.width_m), (other.length_m, other.width_m)
    ahead_m = _STEP_M
    while ahead_m <= reach_m:
        if boxes_touch(path.pose(ego_s_m + ahead_m), sizes[0], there, sizes[1]):
            return ahead_m - _STEP_M
        ahead_m += _STEP_M
    return None
