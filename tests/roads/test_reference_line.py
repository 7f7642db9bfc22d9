"""Shapes of OpenDRIVE reference lines against formulas from elsewhere."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import fresnel

from scenewright.roads.reference_line import Geometry, poses_along


def test_a_spiral_is_a_fresnel_integral() -> None:
    length_m, curvature = 40.0, 0.1
    spiral = Geometry(0.0, 0.0, 0.0, 0.0, length_m, "spiral", (0.0, curvature), 1)
    s_m = np.linspace(0.0, length_m, 50)
    scale = math.sqrt(math.pi * length_m / curvature)
    v, u = fresnel(s_m / scale)
    assert spiral.poses(s_m)[:, :2] == pytest.approx(scale * np.column_stack([u, v]), abs=1e-9)


def test_a_flat_arc_is_a_line_and_a_spiral_of_constant_curvature_an_arc() -> None:
    s_m = np.linspace(0.0, 30.0, 20)
    flat = Geometry(0.0, 1.0, 2.0, 0.7, 30.0, "arc", (0.0,), 1)
    line = Geometry(0.0, 1.0, 2.0, 0.7, 30.0, "line", (), 1)
    assert flat.poses(s_m) == pytest.approx(line.poses(s_m))
    arc = Geometry(0.0, 1.0, 2.0, 0.7, 30.0, "arc", (-0.05,), 1)
    spiral = Geometry(0.0, 1.0, 2.0, 0.7, 30.0, "spiral", (-0.05, -0.05), 1)
    assert spiral.poses(s_m) == pytest.approx(arc.poses(s_m), abs=1e-9)


def test_a_cubic_is_walked_by_arc_length() -> None:
    # A parabola v = u^2 / 40 from 0 to 20 has this length; the same curve can be stated in two other ways.
    length_m = 10.0 * (math.sqrt(2.0) + math.asinh(1.0))
    poly3 = Geometry(0.0, 0.0, 0.0, 0.0, length_m, "poly3", (0.0, 0.0, 1 / 40, 0.0), 1)
    assert poly3.poses(np.array([length_m]))[0] == pytest.approx((20.0, 10.0, math.pi / 4), abs=1e-3)
    s_m = np.linspace(0.0, length_m, 400)
    steps = np.hypot(*np.diff(poly3.poses(s_m)[:, :2], axis=0).T)
    assert steps == pytest.approx(np.diff(s_m), rel=1e-3)
    for end in (1.0, length_m):
        per = 20.0 / end
        values = (0.0, per, 0.0, 0.0, 0.0, 0.0, per**2 / 40, 0.0, end)
        param = Geometry(0.0, 0.0, 0.0, 0.0, length_m, "paramPoly3", values, 1)
        assert param.poses(np.array([0.0, length_m]))[1] == pytest.approx((20.0, 10.0, math.pi / 4), abs=1e-9)


def test_pieces_take_over_where_they_start() -> None:
    pieces = (
        Geometry(0.0, 0.0, 0.0, 0.0, 10.0, "line", (), 1),
        Geometry(10.0, 10.0, 0.0, 0.0, 5.0, "arc", (0.2,), 2),
    )
    poses = poses_along(pieces, np.array([4.0, 10.0, 15.0]))
    assert poses == pytest.approx(
        np.array([[4.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0 + 5.0 * math.sin(1.0), 5.0 * (1.0 - math.cos(1.0)), 1.0]])
    )
