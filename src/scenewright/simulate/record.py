"""Writes a run directory: everything of one run but its verdict and its page.

What enters: a scene, a run, and how it came about. What leaves: files as the outside contract names them. Each is
written whole and then put in place, so that a reader never sees half of one.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib.metadata import PackageNotFoundError, version
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

from scenewright import __version__
from scenewright.errors import OutputError, Place
from scenewright.motion.limits import Limits
from scenewright.program.printer import print_program
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.roads.conflicts import shared_offset_m
from scenewright.roads.grounding import Scene
from scenewright.simulate.loop import Run
from scenewright.solve.plan import SCHEMA_VERSION
from scenewright.trace.files import TRACE_FILE, write_trace
from scenewright.translate.lines import lines_of_program
from scenewright.translate.understand import Understanding, as_data

TEXT_FILE, ANSWERS_FILE = "description.txt", "answers.json"
_PACKAGES = ("z3-solver", "daqp", "numpy", "scipy", "pyarrow")


@contextmanager
def _or_told(what: str, path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise OutputError(
            what,
            place=Place(str(path)),
            found=error.strerror or str(error),
            fix="make room, or choose another folder with --out DIR",
        ) from None


def prepare_directory(directory: Path) -> None:
    """Make sure that `directory` can be written; raises OutputError before any work is done in vain."""
    with _or_told("the output folder cannot be written", directory):
        directory.mkdir(parents=True, exist_ok=True)
        TemporaryFile(dir=directory).close()


def write_run(
    directory: Path,
    scene: Scene,
    run: Run,
    limits: Mapping[int, Limits],
    circumstances: Mapping[str, object],
    given: Collection[str] = (),
    understanding: Understanding | None = None,
) -> None:
    """Write manifest, program, parameters, plan, trace and re-solves of `run` into `directory`.

    Parameters
    ----------
    circumstances
        How it came about: what the manifest says beside the scene and the run.
    given
        The parameters that the user gave.
    understanding
        Of a text, which is kept with its answers: they give the same program again. None where a program was given.

    Raises
    ------
    OutputError
        Where a file cannot be written.
    """
    _write_text(directory / "program.scene", print_program(scene.program))
    write_json(directory / "params.json", _parameters(scene, given))
    for name in (TEXT_FILE, ANSWERS_FILE):  # of an earlier run
        (directory / name).unlink(missing_ok=True)
    if understanding is not None:
        _write_text(directory / TEXT_FILE, understanding.text)
        write_json(directory / ANSWERS_FILE, understanding.all_answers)
    write_json(directory / "plan.json", run.first_plan.as_dict(scene))
    _write(directory / TRACE_FILE, lambda path: write_trace(run.trace, path))
    _write(directory / "replans.parquet", lambda path: _write_replans(run, path))
    write_json(directory / "manifest.json", _manifest(scene, run, limits, circumstances, understanding))


def write_json(path: Path, data: object) -> None:
    """Write `data` as JSON, readable by people, in one step."""
    _write_text(path, json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def _write_text(path: Path, text: str) -> None:
    _write(path, lambda target: target.write_text(text, encoding="utf-8", newline=""))


def _write(path: Path, write: Callable[[Path], object]) -> None:
    temporary = path.with_name(f".{path.name}.part")
    with _or_told("a result could not be written", path):
        write(temporary)
        os.replace(temporary, path)


def _parameters(scene: Scene, given: Collection[str]) -> dict[str, Any]:
    result: dict[str, Any] = {}
    for parameter in scene.program.parameters:
        value = scene.parameters[parameter.name] / parameter.unit.si_factor
        source = "given" if parameter.name in given else "solver" if parameter.value is None else "program"
        result[parameter.name] = {"value": float(value), "unit": parameter.unit.symbol, "source": source}
    return result


def _write_replans(run: Run, path: Path) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    names = ("time_s", "status", "backend", "wall_s", "tolerance", "reason")
    pq.write_table(pa.table({name: [getattr(record, name) for record in run.replans] for name in names}), path)


def _manifest(
    scene: Scene,
    run: Run,
    limits: Mapping[int, Limits],
    circumstances: Mapping[str, object],
    understanding: Understanding | None,
) -> dict[str, Any]:
    program, road_map = scene.program, scene.road_map
    lines = understanding.lines if understanding else lines_of_program(program)
    notes = [": ".join(each) for each in understanding.remarks] if understanding else []
    routes = {actor.name: scene.routes[actor.id] for actor in program.actors}
    return {
        "schema_version": SCHEMA_VERSION,
        "scenewright_version": __version__,
        "name": program.name,
        "description": program.description,
        "understood": [{"sentence": line.sentence, "words": line.words} for line in lines],
        "questions": as_data(understanding.questions) if understanding else [],
        "translator": understanding.translator if understanding else "none",
        "status": run.status,
        "fault": str(run.fault) if run.fault else None,
        **circumstances,
        "map": {
            "name": road_map.name,
            "file": str(road_map.source),
            "sha256": hashlib.sha256(road_map.source.read_bytes()).hexdigest(),
        },
        "routes": {
            name: {"headings": list(route.headings), "lanes": list(route.lanes), "turn": route.turn}
            for name, route in routes.items()
        },
        "landmarks": {actor.name: scene.named_landmarks_m(actor.id) for actor in program.actors},
        "vehicles": {name: {"length_m": VEHICLE_LENGTH_M, "width_m": VEHICLE_WIDTH_M} for name in routes},
        "limits": {actor.name: _limits(limits[actor.id]) for actor in program.heroes},
        "shared_offsets": [
            {"a": a, "b": b, "offset_m": shared_offset_m(routes[a], routes[b])} for a, b in combinations(routes, 2)
        ],
        "knots": _knots(scene, run),
        "plan": {"tolerance": run.last_plan.tolerance},
        "packages": _packages(),
        "notes": [*notes, *scene.notes, *road_map.notes],
        "findings": list(run.findings),
    }


def _limits(limits: Limits) -> dict[str, float]:
    return {
        "speed_max_mps": limits.speed_max_mps,
        "accel_min_mpss": -limits.brake_max_mpss,
        "accel_max_mpss": limits.accel_max_mpss,
        "lateral_accel_max_mpss": limits.lateral_max_mpss,
    }


def _knots(scene: Scene, run: Run) -> dict[str, dict[str, float]]:
    """Return when knots were passed, as far as the run got."""
    result = {scene.program.ego.name: dict(run.ego_knots_s)}
    for hero in scene.program.heroes:
        times = run.last_plan.profiles[hero.id].knot_times_s
        result[hero.name] = {knot: time_s for knot, time_s in times.items() if time_s <= run.trace.duration_s}
    return result


def _packages() -> dict[str, str]:
    result = {"python": platform.python_version()}
    for name in _PACKAGES:
        with suppress(PackageNotFoundError):
            result[name] = version(name)
    return result
