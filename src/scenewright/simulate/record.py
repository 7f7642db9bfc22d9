"""Writes a run directory: everything of one run but its verdict and its page.

What enters: a scene, a run, and how it came about. What leaves: files as the outside contract names them. Each is
written whole and then put in place, so that a reader never sees half of one.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from itertools import combinations
from pathlib import Path
from typing import Any

from scenewright import __version__
from scenewright.errors import OutputError, Place
from scenewright.program.printer import print_program
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.conflicts import shared_offset_m
from scenewright.roads.grounding import Scene
from scenewright.roads.model import RoadMap
from scenewright.simulate.loop import Rates, Run
from scenewright.solve.limits import Limits
from scenewright.solve.plan import SCHEMA_VERSION
from scenewright.trace.files import TRACE_FILE, write_trace
from scenewright.translate.lines import lines_of_program
from scenewright.translate.understand import Understanding, as_data

TEXT_FILE, ANSWERS_FILE = "description.txt", "answers.json"
_PACKAGES = ("z3-solver", "daqp", "numpy", "scipy", "pyarrow")


@dataclass(frozen=True, slots=True)
class Circumstances:
    """How a run came about: what the manifest says beside the scene."""

    ego_name: str
    ego_options: Mapping[str, object]
    mode: str
    tolerance: str
    seed: int
    translator: str
    rates: Rates
    chosen_parameters: frozenset[str] = frozenset()
    given_parameters: frozenset[str] = frozenset()
    timings_s: Mapping[str, float] = field(default_factory=dict)
    take: int = 1
    simulator: str = "builtin"
    planner: str = "convex"
    understanding: Understanding | None = None  # of a text; None where a program was given


def prepare_directory(directory: Path) -> None:
    """Make sure that `directory` can be written; raises OutputError before any work is done in vain."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        probe = directory / ".writable"
        probe.write_text("", encoding="utf-8")
        probe.unlink()
    except OSError as error:
        raise OutputError(
            "the output folder cannot be written",
            place=Place(str(directory)),
            found=error.strerror or str(error),
            fix="choose another folder with --out DIR",
        ) from None


def write_run(
    directory: Path, scene: Scene, run: Run, limits: Mapping[int, Limits], circumstances: Circumstances
) -> None:
    """Write manifest, program, parameters, plan, trace and re-solves of `run` into `directory`.

    Raises
    ------
    OutputError
        Where a file cannot be written.
    """
    _write(directory / "program.scene", lambda path: path.write_text(print_program(scene.program), encoding="utf-8"))
    write_json(directory / "params.json", _parameters(scene, circumstances))
    _write_text(directory, circumstances.understanding)
    write_json(directory / "plan.json", run.first_plan.as_dict(scene))
    _write(directory / TRACE_FILE, lambda path: write_trace(run.trace, path))
    _write(directory / "replans.parquet", lambda path: _write_replans(run, path))
    write_json(directory / "manifest.json", _manifest(scene, run, limits, circumstances))


def _write_text(directory: Path, understanding: Understanding | None) -> None:
    """Keep a text with its answers, which give the same program again; leave none of an earlier run."""
    if understanding is None:
        for name in (TEXT_FILE, ANSWERS_FILE):
            (directory / name).unlink(missing_ok=True)
        return
    text = understanding.text
    _write(directory / TEXT_FILE, lambda path: path.write_text(text, encoding="utf-8", newline=""))
    write_json(directory / ANSWERS_FILE, understanding.all_answers)


def write_json(path: Path, data: object) -> None:
    """Write `data` as JSON, readable by people, in one step."""
    text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    _write(path, lambda target: target.write_text(text, encoding="utf-8"))


def _write(path: Path, write: Callable[[Path], object]) -> None:
    temporary = path.with_name(f".{path.name}.part")
    try:
        write(temporary)
        os.replace(temporary, path)
    except OSError as error:
        raise OutputError(
            "a result could not be written",
            place=Place(str(path)),
            found=error.strerror or str(error),
            fix="make room, or choose another folder with --out DIR",
        ) from None


def _parameters(scene: Scene, circumstances: Circumstances) -> dict[str, Any]:
    result: dict[str, Any] = {}
    for parameter in scene.program.parameters:
        value = scene.parameters[parameter.name] / parameter.unit.si_factor
        source = "solver" if parameter.name in circumstances.chosen_parameters else "program"
        source = "given" if parameter.name in circumstances.given_parameters else source
        result[parameter.name] = {"value": float(value), "unit": parameter.unit.symbol, "source": source}
    return result


def _write_replans(run: Run, path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    names = ("time_s", "status", "backend", "wall_s", "tolerance", "reason")
    pq.write_table(pa.table({name: [getattr(record, name) for record in run.replans] for name in names}), path)


def _manifest(scene: Scene, run: Run, limits: Mapping[int, Limits], circumstances: Circumstances) -> dict[str, Any]:
    program, understanding = scene.program, circumstances.understanding
    lines = understanding.lines if understanding else lines_of_program(program)
    notes = [": ".join(each) for each in understanding.remarks] if understanding else []
    return {
        "schema_version": SCHEMA_VERSION,
        "scenewright_version": __version__,
        "name": program.name,
        "description": program.description,
        "understood": [{"sentence": line.sentence, "words": line.words} for line in lines],
        "questions": as_data(understanding.questions) if understanding else [],
        "status": run.status,
        "fault": str(run.fault) if run.fault else None,
        "seed": circumstances.seed,
        "take": circumstances.take,
        "mode": circumstances.mode,
        "tolerance": circumstances.tolerance,
        "translator": circumstances.translator,
        "simulator": circumstances.simulator,
        "planner": circumstances.planner,
        "ego": {"name": circumstances.ego_name, "options": dict(circumstances.ego_options)},
        "map": _map(scene.road_map),
        "routes": {actor.name: _route(scene, actor.id) for actor in program.actors},
        "landmarks": {actor.name: scene.named_landmarks_m(actor.id) for actor in program.actors},
        "vehicles": {
            actor.name: {"length_m": VEHICLE_LENGTH_M, "width_m": VEHICLE_WIDTH_M} for actor in program.actors
        },
        "limits": {actor.name: _limits(limits[actor.id]) for actor in program.heroes},
        "shared_offsets": [
            {"a": a.name, "b": b.name, "offset_m": shared_offset_m(scene.routes[a.id], scene.routes[b.id])}
            for a, b in combinations(program.actors, 2)
        ],
        "rates": {
            "simulation_hz": round(1 / circumstances.rates.step_s, 6),
            "replan_hz": round(1 / circumstances.rates.replan_s, 6) if circumstances.rates.replan_s else 0,
        },
        "knots": _knots(scene, run),
        "plan": {"tolerance": run.last_plan.tolerance},
        "timings": {name: round(seconds, 6) for name, seconds in circumstances.timings_s.items()},
        "packages": _packages(),
        "notes": [*notes, *scene.notes, *scene.road_map.notes],
        "findings": list(run.findings),
    }


def _map(road_map: RoadMap) -> dict[str, str]:
    digest = hashlib.sha256(road_map.source.read_bytes()).hexdigest()
    return {"name": road_map.name, "file": str(road_map.source), "sha256": digest}


def _route(scene: Scene, actor: int) -> dict[str, Any]:
    route = scene.routes[actor]
    return {"headings": list(route.headings), "lanes": list(route.lanes), "turn": route.turn}


def _limits(limits: Limits) -> dict[str, float]:
    return {
        "speed_max_mps": limits.speed_max_mps,
        "accel_min_mpss": -limits.brake_max_mpss,
        "accel_max_mpss": limits.accel_max_mpss,
        "lateral_accel_max_mpss": limits.lateral_max_mpss,
    }


def _knots(scene: Scene, run: Run) -> dict[str, dict[str, float]]:
    """Return when knots were passed, as far as the run got."""
    end_s = run.trace.duration_s
    result = {scene.program.ego.name: dict(run.ego_knots_s)}
    for hero in scene.program.heroes:
        times = run.last_plan.profiles[hero.id].knot_times_s
        result[hero.name] = {knot: time_s for knot, time_s in times.items() if time_s <= end_s}
    return result


def _packages() -> dict[str, str]:
    result = {"python": platform.python_version()}
    for name in _PACKAGES:
        try:
            result[name] = version(name)
        except PackageNotFoundError:
            continue
    return result
