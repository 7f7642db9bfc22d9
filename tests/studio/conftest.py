"""A run directory made by hand: the ego turns right out of a driveway, the hero brakes to a stop for it."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from scenewright.roads.conflicts import find_conflict
from scenewright.roads.load import load_map
from scenewright.roads.routes import Route, find_route
from scenewright.trace.files import write_trace
from scenewright.trace.model import ActorTrace, Trace

STEP_S = 0.02
DURATION_S = 16.0
TRIGGER_S = 4.0
STOPPED_S = 7.75
DESCRIPTION = (
    "Ego is on the driveway exit and it is 40 m behind the stop line. It wants to turn right onto the road travelling "
    "westbound. There is a hero vehicle on the road. It wants to lane follow along the road travelling westbound. "
    "When the ego is 12 m behind the stop line and the hero vehicle is hero_distance_m behind the conflict point, "
    "the hero vehicle begins to decelerate to a complete stop at end_distance_m behind the conflict point. "
    "The ego passes the conflict point while the hero waits."
)


@dataclass(frozen=True)
class Piece:
    """Constant acceleration for a while."""

    duration_s: float
    accel_mps2: float


def source(words: str) -> str:
    start = DESCRIPTION.index(words)
    return f"@{start}..{start + len(words)}"


def program_text(description: str = DESCRIPTION) -> str:
    escaped = description.replace("\\", "\\\\").replace('"', '\\"')
    return f"""scenario "right turn, hero yields"
map "t_intersection"
description:
"{escaped}"

parameters:
- hero_distance_m = 42
- end_distance_m

Actor 0 (ego):
- S, W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0x(t0) == stop_line - 40 {source("it is 40 m behind the stop line")}
A0(t1) == A1(t1) {source("When the ego is 12 m behind the stop line and")}
A0x(t1) == stop_line - 12 {source("the ego is 12 m behind the stop line")}
A1x(t1) == conflict_point - hero_distance_m {source("the hero vehicle is hero_distance_m behind the conflict point")}
A1x(t2) == conflict_point - end_distance_m {source("at end_distance_m behind the conflict point")}
A1v(t2) == 0 {source("begins to decelerate to a complete stop")}
A0x(t2) == conflict_point {source("The ego passes the conflict point while the hero waits.")}
A1(t2) < A0(t2) {source("The ego passes the conflict point while the hero waits.")}
"""


def driven(route: Route, start_m: float, speed_mps: float, pieces: list[Piece]) -> ActorTrace:
    """Integrate the pieces along a route; a speed never falls below zero."""
    count = round(DURATION_S / STEP_S) + 1
    time = np.arange(count) * STEP_S
    accel = np.zeros(count)
    ends = np.cumsum([piece.duration_s for piece in pieces])
    for index in range(count):
        at = int(np.searchsorted(ends, time[index] + 1e-9, side="right"))
        accel[index] = pieces[at].accel_mps2 if at < len(pieces) else 0.0
    speed = np.zeros(count)
    position = np.zeros(count)
    speed[0], position[0] = speed_mps, start_m
    for index in range(1, count):
        speed[index] = max(0.0, speed[index - 1] + accel[index - 1] * STEP_S)
        position[index] = position[index - 1] + 0.5 * (speed[index] + speed[index - 1]) * STEP_S
    poses = route.path.poses(position)
    return ActorTrace(time, poses[:, 0], poses[:, 1], poses[:, 2], speed, accel, position, np.zeros(count))


def condition(
    kind: str, identifier: str, text: str, required: float, measured: float, unit: str, **more: Any
) -> dict[str, Any]:
    error = abs(measured - required)
    return {
        "id": identifier,
        "kind": kind,
        "text": text,
        "required": required,
        "measured": measured,
        "error": error,
        "unit": unit,
        "tight": error <= 0.5,
        "loose": error <= 2.0,
        **more,
    }


def write_json(path: Path, content: object) -> None:
    path.write_text(json.dumps(content, ensure_ascii=False, indent=1), encoding="utf-8")


def build_run(folder: Path) -> Path:
    """Write every file of a run into `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    road_map = load_map("t_intersection")
    routes = {"ego": find_route(road_map, headings=["S", "W"]), "hero": find_route(road_map, headings=["W"])}
    conflict = find_conflict(routes["ego"], routes["hero"])
    assert conflict is not None
    meeting = {"ego": float(conflict.s_a_m), "hero": float(conflict.s_b_m)}
    marks = {
        name: {
            **{k: float(v) for k, v in route.landmarks.items()},
            "conflict_point": meeting[name],
            "intersection": meeting[name],
        }
        for name, route in routes.items()
    }
    # The hero covers 4 s at 12 m/s, then brakes at 3.2 m/s^2 from 42 m before the conflict point to 19.5 m.
    hero = driven(routes["hero"], meeting["hero"] - 42.0 - 48.0, 12.0, [Piece(4.0, 0.0), Piece(3.75, -3.2)])
    ego = driven(
        routes["ego"],
        marks["ego"]["stop_line"] - 40.1,
        7.0,
        [Piece(4.0, 0.0), Piece(3.0, -1.6), Piece(2.0, 0.5), Piece(5.0, 1.1)],
    )
    trace = Trace({"ego": ego, "hero": hero})
    write_trace(trace, folder / "trace.parquet")
    passes_s = float(np.interp(meeting["ego"], ego.s_m, ego.time_s))
    write_json(folder / "manifest.json", manifest(routes, marks, passes_s))
    write_json(folder / "plan.json", plan(trace))
    params = {
        "hero_distance_m": {"value": 42.0, "unit": "m", "source": "given"},
        "end_distance_m": {"value": 19.5, "unit": "m", "source": "solver"},
    }
    write_json(folder / "params.json", params)
    (folder / "program.scene").write_text(program_text(), encoding="utf-8")
    write_replans(folder)
    write_json(folder / "verdict.json", verdict(trace, marks, passes_s))
    return folder


def manifest(routes: dict[str, Route], marks: dict[str, dict[str, float]], passes_s: float) -> dict[str, Any]:
    return {
        "schema_version": 1,
        "scenewright_version": "0.1.0",
        "name": "right turn, hero yields",
        "description": DESCRIPTION,
        "status": "finished",
        "seed": 7,
        "mode": "closed",
        "tolerance": "tight",
        "translator": "offline",
        "ego": {"name": "idm", "options": {"desired_speed_mps": 8.0}},
        "map": {"name": "t_intersection", "file": "t_intersection", "sha256": "0"},
        "routes": {
            n: {"headings": list(r.headings), "lanes": list(r.lanes), "turn": r.turn} for n, r in routes.items()
        },
        "landmarks": marks,
        "vehicles": {"ego": {"length_m": 4.5, "width_m": 1.9}, "hero": {"length_m": 5.1, "width_m": 2.0}},
        "limits": {
            "hero": {
                "speed_max_mps": 18.0,
                "accel_min_mpss": -4.0,
                "accel_max_mpss": 3.0,
                "lateral_accel_max_mpss": 3.0,
            }
        },
        "shared_offsets": [{"a": "ego", "b": "hero", "offset_m": None}],
        "rates": {"simulation_hz": 50, "replan_hz": 10},
        "knots": {
            "ego": {"t0": 0.0, "t1": TRIGGER_S, "t2": passes_s},
            "hero": {"t0": 0.0, "t1": TRIGGER_S, "t2": STOPPED_S},
        },
        "timings": {"total": 1.25},
        "packages": {"numpy": "2"},
        "notes": ["Take 2 of 3 was kept."],
        "findings": ["The ego came to walking pace before the stop line by itself."],
    }


def plan(trace: Trace) -> dict[str, Any]:
    hero, ego = trace.actors["hero"], trace.actors["ego"]
    pieces = {
        "hero": [
            ("go", 0.0, 3.6, hero.s_m[0], 13.0, 0.0, 0.0),
            ("dec", 3.6, 4.0, hero.s_m[0] + 46.8, 13.0, -2.25, -0.5),
        ],
        "ego": [("go", 0.0, 4.0, ego.s_m[0], 7.0, 0.0, 0.0), ("go", 4.0, 9.0, ego.s_m[0] + 28.0, 7.0, 0.0, 0.0)],
    }
    keys = ("piece", "start_s", "duration_s", "s_m", "speed_mps", "accel_mpss", "jerk_mpsss")
    return {
        "schema_version": 1,
        "actors": {
            name: {
                "knots": [
                    {"name": f"t{i}", "time_s": row[1], "s_m": row[3], "speed_mps": row[4]}
                    for i, row in enumerate(rows)
                ],
                "segments": [dict(zip(keys, (row[0], *map(float, row[1:])), strict=True)) for row in rows],
            }
            for name, rows in pieces.items()
        },
    }


def write_replans(folder: Path) -> None:
    random = np.random.default_rng(3)
    times = np.arange(0.0, 10.0, 0.1)
    statuses = ["frozen" if i % 3 else "sat" for i in range(len(times))]
    reasons = ["after its trigger the hero does not adapt" if status == "frozen" else "" for status in statuses]
    statuses[31], reasons[31] = "relaxed", "the ego slows down"
    statuses[32], reasons[32] = "unknown", "time limit of 50 ms"
    wall = np.where([status == "frozen" for status in statuses], 0.00003, 0.004) * random.uniform(0.7, 1.6, len(times))
    wall[32] = 0.05
    table = {
        "time_s": times,
        "status": statuses,
        "backend": ["" if status == "frozen" else "daqp" for status in statuses],
        "wall_s": wall,
        "tolerance": [0.05] * len(times),
        "reason": reasons,
    }
    pq.write_table(pa.table(table), folder / "replans.parquet")


def verdict(trace: Trace, marks: dict[str, dict[str, float]], passes_s: float) -> dict[str, Any]:
    ego, hero = trace.actors["ego"], trace.actors["hero"]
    ego_m = marks["ego"]["stop_line"] - ego.position(TRIGGER_S)
    hero_m = marks["hero"]["conflict_point"] - hero.position(TRIGGER_S)
    stop_m = marks["hero"]["conflict_point"] - hero.position(STOPPED_S)
    start_m = marks["ego"]["stop_line"] - ego.position(0.0)
    rows = [
        condition("initial", "c1", "the ego is 40 m before the stop line at the start", 40.0, start_m, "m"),
        condition("trigger", "c2", "all of this is at one moment, when the hero begins to brake", 0.0, 0.02, "s"),
        condition("trigger", "c3", "the ego is 12 m before the stop line", 12.0, ego_m, "m"),
        condition("trigger", "c4", "the hero is hero_distance_m before the conflict point", 42.0, hero_m, "m"),
        condition("interaction", "c5", "the hero is end_distance_m before the conflict point", 19.5, stop_m + 0.7, "m"),
        condition("interaction", "hero_onset", "hero begins to brake at the trigger", 4.0, 4.0, "s"),
        condition("interaction", "c6", "the hero stands", 0.0, hero.speed(STOPPED_S), "m/s"),
        condition(
            "outcome",
            "c7",
            "the ego passes the conflict point",
            marks["ego"]["conflict_point"],
            marks["ego"]["conflict_point"],
            "m",
        ),
        {
            **condition(
                "outcome", "c8", "the hero stands before the ego passes the conflict point", passes_s, STOPPED_S, "s"
            ),
            "error": 0.0,
            "tight": True,
            "loose": True,
        },
        {
            **condition("safety", "no_collision", "the vehicles do not touch", 0.0, 0.0, "m"),
            "required": None,
            "measured": None,
        },
    ]
    return {
        "schema_version": 1,
        "success": {"tight": False, "loose": True},
        "conditions": rows,
        "aftermath": {
            "collision": None,
            "closest_m": 5.43219,
            "min_ttc_s": None,
            "post_encroachment_s": None,
            "ego_hardest_braking_mps2": 0.0,
            "text": "no collision; closest 5.4 m, the ego did not brake",
        },
        "facts": {
            "trigger_time_s": {"hero": TRIGGER_S},
            "knot_times_s": {"hero": {"t1": TRIGGER_S}},
            "ego_never_met_condition": False,
            "closest": [
                {
                    "who": "ego",
                    "side": "the ego is 12 m before the stop line",
                    "met": True,
                    "error": 0.1,
                    "unit": "m",
                    "time_s": 4.0,
                }
            ],
            "pairs": {"ego, hero": {"collision_time_s": None, "min_distance_m": 5.43219, "min_ttc_s": 3.21}},
            "kinematics": {"ego": {"speed_max": 8.7}},
        },
    }


@pytest.fixture
def run_dir(tmp_path: Path) -> Path:
    """Return a fresh, complete run directory."""
    return build_run(tmp_path / "run")


@pytest.fixture
def edit() -> Callable[[Path, Callable[[Any], None]], None]:
    """Return a function that changes a JSON file in place."""

    def change(path: Path, mutate: Callable[[Any], None]) -> None:
        content = json.loads(path.read_text(encoding="utf-8"))
        mutate(content)
        write_json(path, content)

    return change
