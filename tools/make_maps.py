"""Write the maps that come with Scenewright.

What enters: the numbers below. What leaves: ``src/scenewright/roads/maps/*.xodr``, the same bytes every time. The
shipped files are what counts; run this only to change them: ``python tools/make_maps.py``.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

MAPS = Path(__file__).parents[1] / "src" / "scenewright" / "roads" / "maps"

LANE_WIDTH_M = 3.5
ROAD_ARM_M = 300.0
DRIVEWAY_M = 130.0
BOUNDARY_M = 14.0  # from the junction's centre to where each arm begins
STOP_LINE_M = 1.5  # before the boundary
SPIRAL_M = 6.0  # at each end of a turn, so that curvature grows and falls without jumps
ROAD_KMH, DRIVEWAY_KMH = 50, 20


def spiral_shift(radius_m: float) -> tuple[float, float, float]:
    """Return forward and sideward way and the heading at the end of a spiral from straight to `radius_m`."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    s = 0.5 * SPIRAL_M * (nodes + 1.0)
    angle = s * s / (2.0 * radius_m * SPIRAL_M)
    scale = 0.5 * SPIRAL_M * weights
    return float(scale @ np.cos(angle)), float(scale @ np.sin(angle)), SPIRAL_M / (2.0 * radius_m)


def turn_tangent_m(radius_m: float) -> float:
    """Return the distance from the start of a quarter turn (spiral, arc, spiral) to its corner point."""
    forward, sideward, angle = spiral_shift(radius_m)
    return forward - radius_m * math.sin(angle) + sideward + radius_m * math.cos(angle)


def radius_for_tangent_m(tangent_m: float) -> float:
    """Return the radius with which a quarter turn fits between two arms (bisection)."""
    low, high = SPIRAL_M, 50.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if turn_tangent_m(middle) < tangent_m else (low, middle)
    return 0.5 * (low + high)


def geometry(s: float, x: float, y: float, heading: float, length: float, shape: str) -> str:
    return (
        f'      <geometry s="{s:.10f}" x="{x:.10f}" y="{y:.10f}" hdg="{heading:.12f}" length="{length:.10f}">\n'
        f"        <{shape}/>\n      </geometry>\n"
    )


def quarter_turn(x: float, y: float, heading: float, tangent_m: float, sign: int) -> tuple[str, float]:
    """Return the planView pieces and the length of a quarter turn; `sign` +1 turns left."""
    radius = radius_for_tangent_m(tangent_m)
    forward, sideward, angle = spiral_shift(radius)
    arc_angle = math.pi / 2 - 2 * angle
    curvature = sign / radius
    end = f'curvature="{curvature:.12f}"'
    text = geometry(0.0, x, y, heading, SPIRAL_M, f'spiral curvStart="0" curvEnd="{curvature:.12f}"')
    x += forward * math.cos(heading) - sign * sideward * math.sin(heading)
    y += forward * math.sin(heading) + sign * sideward * math.cos(heading)
    heading += sign * angle
    text += geometry(SPIRAL_M, x, y, heading, radius * arc_angle, f"arc {end}")
    u, v = radius * math.sin(arc_angle), sign * radius * (1.0 - math.cos(arc_angle))
    x, y = x + u * math.cos(heading) - v * math.sin(heading), y + u * math.sin(heading) + v * math.cos(heading)
    heading += sign * arc_angle
    s = SPIRAL_M + radius * arc_angle
    text += geometry(s, x, y, heading, SPIRAL_M, f'spiral curvStart="{curvature:.12f}" curvEnd="0"')
    return text, s + SPIRAL_M


def road(
    road_id: int,
    name: str,
    junction: int,
    length: float,
    link: str,
    kind: tuple[str, int],
    plan: str,
    lanes: str,
    signals: str = "",
) -> str:
    road_type, limit_kmh = kind
    return f"""  <road name="{name}" length="{length:.10f}" id="{road_id}" junction="{junction}" rule="RHT">
    <link>
{link}    </link>
    <type s="0" type="{road_type}"><speed max="{limit_kmh}" unit="km/h"/></type>
    <planView>
{plan}    </planView>
    <elevationProfile><elevation s="0" a="0" b="0" c="0" d="0"/></elevationProfile>
    <lanes>
{lanes}    </lanes>
{signals}  </road>
"""


MARK = '<roadMark sOffset="0" type="{}" weight="standard" color="standard" width="0.12" laneChange="none"/>'


def lane(number: int, link: str, mark: str) -> str:
    return (
        f'<lane id="{number}" type="driving" level="false"><link>{link}</link>'
        f'<width sOffset="0" a="{LANE_WIDTH_M}" b="0" c="0" d="0"/>{MARK.format(mark)}</lane>'
    )


def center(mark: str) -> str:
    return f'        <center><lane id="0" type="none" level="false"><link/>{MARK.format(mark)}</lane></center>\n'


def arm(
    road_id: int, name: str, length: float, end: str, kind: tuple[str, int], pose: tuple[float, float, float]
) -> str:
    link = f'      <{end} elementType="junction" elementId="100"/>\n'
    lanes = (
        '      <laneSection s="0">\n'
        f"        <left>{lane(1, '', 'solid')}</left>\n{center('broken')}"
        f"        <right>{lane(-1, '', 'solid')}</right>\n"
        "      </laneSection>\n"
    )
    signals = ""
    if kind[0] == "lowSpeed":
        signals = (
            f'    <signals>\n      <signal s="{STOP_LINE_M}" t="{LANE_WIDTH_M / 2}" id="1" name="stop line" '
            'dynamic="no" orientation="-" zOffset="0" country="DE" countryRevision="2017" type="294" subtype="-1" '
            f'width="{LANE_WIDTH_M}" height="0.5">\n        <validity fromLane="1" toLane="1"/>\n      </signal>\n'
            "    </signals>\n"
        )
    return road(road_id, name, -1, length, link, kind, geometry(0.0, *pose, length, "line"), lanes, signals)


# Arms: where traffic enters the junction (x, y, heading), its lane, and the lane on which traffic leaves by this arm.
HALF = LANE_WIDTH_M / 2
ARMS = {
    "west": (1, "end", (-BOUNDARY_M, -HALF, 0.0), -1, 1),
    "east": (2, "start", (BOUNDARY_M, HALF, math.pi), 1, -1),
    "north": (3, "start", (-HALF, BOUNDARY_M, -math.pi / 2), 1, -1),
}
PATHS = [
    ("east", "west", "straight"),
    ("west", "east", "straight"),
    ("north", "west", "right"),
    ("north", "east", "left"),
    ("west", "north", "left"),
    ("east", "north", "right"),
]


def connecting_road(road_id: int, origin: str, destination: str, turn: str) -> tuple[str, str]:
    """Return a connecting road, its reference line in the middle of its one lane, and its junction connection."""
    from_id, from_end, (x, y, heading), lane_in, _ = ARMS[origin]
    to_id, to_end, _, _, lane_out = ARMS[destination]
    if turn == "straight":
        length = 2 * BOUNDARY_M
        plan, kind = geometry(0.0, x, y, heading, length, "line"), ("town", ROAD_KMH)
    else:
        sign = 1 if turn == "left" else -1
        plan, length = quarter_turn(x, y, heading, BOUNDARY_M + sign * HALF, sign)
        kind = ("town", DRIVEWAY_KMH)
    link = (
        f'      <predecessor elementType="road" elementId="{from_id}" contactPoint="{from_end}"/>\n'
        f'      <successor elementType="road" elementId="{to_id}" contactPoint="{to_end}"/>\n'
    )
    lane_link = f'<predecessor id="{lane_in}"/><successor id="{lane_out}"/>'
    lanes = (
        f'      <laneOffset s="0" a="{HALF}" b="0" c="0" d="0"/>\n      <laneSection s="0">\n'
        f"{center('none')}        <right>{lane(-1, lane_link, 'none')}</right>\n      </laneSection>\n"
    )
    connection = (
        f'    <connection id="{road_id - 10}" incomingRoad="{from_id}" connectingRoad="{road_id}" '
        'contactPoint="start">\n'
        f'      <laneLink from="{lane_in}" to="-1"/>\n    </connection>\n'
    )
    return road(road_id, f"from {origin} to {destination}", 100, length, link, kind, plan, lanes), connection


def t_intersection() -> str:
    """Return a two-way road from west to east with a driveway to the north."""
    far = BOUNDARY_M + ROAD_ARM_M
    roads = [
        arm(1, "west arm", ROAD_ARM_M, "successor", ("town", ROAD_KMH), (-far, 0.0, 0.0)),
        arm(2, "east arm", ROAD_ARM_M, "predecessor", ("town", ROAD_KMH), (BOUNDARY_M, 0.0, 0.0)),
        arm(3, "driveway", DRIVEWAY_M, "predecessor", ("lowSpeed", DRIVEWAY_KMH), (0.0, BOUNDARY_M, math.pi / 2)),
    ]
    connections = []
    for number, path in enumerate(PATHS):
        text, connection = connecting_road(10 + number, *path)
        roads.append(text)
        connections.append(connection)
    north = BOUNDARY_M + DRIVEWAY_M
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<OpenDRIVE>\n'
        f'  <header revMajor="1" revMinor="7" name="t_intersection" version="1.00" date="2026-01-01T00:00:00" '
        f'north="{north}" south="{-LANE_WIDTH_M}" east="{far}" west="{-far}" vendor="Scenewright">\n'
        "    <geoReference><![CDATA[+proj=tmerc +lat_0=0 +lon_0=0 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs]]>"
        "</geoReference>\n  </header>\n"
        + "".join(roads)
        + '  <junction name="junction" id="100" type="default">\n'
        + "".join(connections)
        + "  </junction>\n</OpenDRIVE>\n"
    )


if __name__ == "__main__":
    MAPS.mkdir(parents=True, exist_ok=True)
    (MAPS / "t_intersection.xodr").write_text(t_intersection(), encoding="utf-8")
