"""Judges what lies in a run directory, and writes `verdict.json`.

What enters: a directory with `manifest.json`, `program.scene`, `params.json` and `trace.parquet`. What leaves: a
`Verdict`, or an `InputError` that says what is missing. Of the manifest only facts of the map and the vehicles are
read, never its knots.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, Field, RootModel, TypeAdapter, ValidationError

from scenewright.errors import InputError, MapError, OutputError, Place
from scenewright.judge.case import Box, Case, Limits, PathLike
from scenewright.judge.judgement import judge
from scenewright.judge.verdict import Cause, Verdict
from scenewright.program.check import check_program
from scenewright.program.text import parse_program
from scenewright.program.types import Actor, Program
from scenewright.roads.model import RoadMap
from scenewright.trace.files import TRACE_FILE, read_trace
from scenewright.units import UNITS

SCHEMA_VERSION = 1
VERDICT_FILE = "verdict.json"


class _Model(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True, allow_inf_nan=False)


class RouteModel(_Model):
    """A route as the manifest states it."""

    headings: tuple[str, ...] = ()
    lanes: tuple[str, ...] = ()


class MapModel(_Model):
    """Which map the run was on."""

    name: str
    file: str
    sha256: str


class VehicleModel(_Model):
    """A vehicle's outline."""

    length_m: float = Field(gt=0)
    width_m: float = Field(gt=0)


class LimitsModel(_Model):
    """What an actor may do; what is absent or null is not limited further than for any car."""

    speed_max_mps: float | None = None
    accel_min_mpss: float | None = None
    accel_max_mpss: float | None = None
    lateral_accel_max_mpss: float | None = None


class SharedOffsetModel(_Model):
    """What to add to b's arc length to compare it with a's; null where they share no lane."""

    a: str
    b: str
    offset_m: float | None


class ManifestModel(_Model):
    """The part of `manifest.json` that a judge may use."""

    schema_version: int
    landmarks: dict[str, dict[str, float | None]]
    routes: dict[str, RouteModel] = {}
    vehicles: dict[str, VehicleModel] = {}
    limits: dict[str, LimitsModel] = {}
    shared_offsets: list[SharedOffsetModel] = []
    map: MapModel | None = None


class ParameterModel(_Model):
    """One parameter's value, in the unit stated with it."""

    value: float
    unit: str


class ParametersModel(RootModel[dict[str, ParameterModel]]):
    """`params.json`."""


_Any = TypeVar("_Any", bound=BaseModel)


def judge_run_directory(directory: Path | str) -> Verdict:
    """Judge a run from the files it left.

    Parameters
    ----------
    directory
        A run directory.

    Raises
    ------
    InputError
        If a file is missing, cannot be read, or lacks something.
    ProgramError
        If the program does not parse.
    """
    return judge(read_case(directory))


def cause_told(directory: Path) -> Cause | None:
    """Return why a run missed as whoever drove it has written into its verdict; None where nothing is told."""
    try:
        told = json.loads((directory / VERDICT_FILE).read_text(encoding="utf-8"))
        return TypeAdapter(Cause).validate_python(told["cause"])
    except (OSError, ValueError, TypeError, KeyError):
        return None


def read_case(directory: Path | str) -> Case:
    """Read what a verdict may rest on from a run directory; raises as `judge_run_directory` does."""
    directory = Path(directory)
    if not directory.is_dir():
        raise InputError("there is no run directory here", place=Place(str(directory)))
    manifest = _read_model(directory / "manifest.json", ManifestModel)
    if manifest.schema_version != SCHEMA_VERSION:
        raise InputError(
            "the manifest has another schema version",
            place=Place(str(directory / "manifest.json")),
            found=str(manifest.schema_version),
            expected=str(SCHEMA_VERSION),
        )
    text = _read_text(directory / "program.scene")
    program = parse_program(text, "program.scene")
    check_program(program, text, "program.scene", nested=True)
    paths, unmapped = _paths(manifest, program.actors)
    parameters = _si_values(_read_model(directory / "params.json", ParametersModel), program, directory)
    return Case(
        program=program,
        parameters=parameters,
        landmarks={
            actor: {name: value for name, value in places.items() if value is not None}
            for actor, places in manifest.landmarks.items()
        },
        shared_offset_m={(pair.a, pair.b): pair.offset_m for pair in manifest.shared_offsets},
        trace=read_trace(directory / TRACE_FILE),
        vehicles={name: Box(box.length_m, box.width_m) for name, box in manifest.vehicles.items()},
        limits={name: Limits(**limits.model_dump(exclude_none=True)) for name, limits in manifest.limits.items()},
        expected_headings={name: route.headings for name, route in manifest.routes.items() if route.headings},
        paths=paths,
        unmapped=unmapped,
    )


def _paths(manifest: ManifestModel, actors: Iterable[Actor]) -> tuple[dict[str, PathLike], dict[str, str]]:
    """Return the paths of the actors' routes on the map that was driven on, and by actor why there is none."""
    from scenewright.roads.grounding import query_of
    from scenewright.roads.routes import find_routes

    road_map = _map_driven_on(manifest.map)
    paths: dict[str, PathLike] = {}
    unmapped: dict[str, str] = {}
    for name, asked in ((actor.name, query_of(actor.route)) for actor in actors):
        if isinstance(road_map, str):
            unmapped[name] = road_map
        elif name not in manifest.routes:
            unmapped[name] = "the manifest names no route of it"
        else:
            found = {route.lanes: route.path for route in find_routes(road_map, **asked)}
            path = found.get(manifest.routes[name].lanes)
            if path is None:
                unmapped[name] = "the map has no such route as program and manifest name"
            else:
                paths[name] = path
    return paths, unmapped


def _map_driven_on(named: MapModel | None) -> RoadMap | str:
    """Return the map, where it was or else by its name, or why it is not to be had; another one is not it."""
    from scenewright.roads.load import load_map

    if named is None:
        return "the manifest names no map"
    why = "the map cannot be read"
    for source in (named.file, named.name):
        try:
            road_map = load_map(source)
            if hashlib.sha256(road_map.source.read_bytes()).hexdigest() == named.sha256:
                return road_map
        except (MapError, OSError):
            continue
        why = "the map is another one by now"
    return why


def write_verdict(verdict: Verdict, path: Path) -> None:
    """Write `verdict.json`.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    try:
        path.write_text(json.dumps(verdict.as_dict(), indent=2, allow_nan=False) + "\n", encoding="utf-8")
    except OSError as error:
        raise OutputError("the verdict cannot be written", place=Place(str(path)), found=str(error)) from None


def _si_values(stored: ParametersModel, program: Program, directory: Path) -> dict[str, float]:
    place = Place(str(directory / "params.json"))
    values = {}
    for name, parameter in stored.root.items():
        if parameter.unit not in UNITS:
            raise InputError(
                f"the unit of '{name}' is unknown", place=place, found=parameter.unit, expected=", ".join(UNITS)
            )
        values[name] = parameter.value * float(UNITS[parameter.unit].si_factor)
    missing = [parameter.name for parameter in program.parameters if parameter.name not in values]
    if missing:
        raise InputError("a parameter of the program has no value", place=place, expected=", ".join(missing))
    return values


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(f"the run directory lacks {path.name}", place=Place(str(path.parent))) from None
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path.name} cannot be read", place=Place(str(path)), found=str(error)) from None


def _read_model(path: Path, model: type[_Any]) -> _Any:
    text = _read_text(path)
    try:
        return model.model_validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        raise InputError(
            f"{path.name} is not what it should be" + (f" at '{where}'" if where else ""),
            place=Place(str(path)),
            found=str(first["msg"]),
        ) from None
