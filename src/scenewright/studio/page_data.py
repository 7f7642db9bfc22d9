"""Everything the run page shows, gathered from a run directory as plain JSON-ready data.

What enters: a run directory, of which only the manifest and the trace must be there. What leaves: a dict without NaN,
rounded and thinned so that a page stays small. It writes nothing and knows no HTML.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scenewright.errors import InputError, Place, ProgramError
from scenewright.program.structure import KnotKey, read_structure
from scenewright.program.types import Program
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.studio.program_data import clauses, condition_times, places, triggers
from scenewright.studio.replans_data import read_replans
from scenewright.studio.scene_data import SceneGeometry, scene_geometry
from scenewright.studio.told_facts import told_facts
from scenewright.trace.files import TRACE_FILE, read_trace
from scenewright.trace.model import ActorTrace, Trace
from scenewright.translate.compile import UNNAMED

Json = dict[str, Any]

MAX_SAMPLES = 2000  # per actor
_AN_INSTANT_S = 1e-3  # rounding
_MAX_SAMPLES_IN_ALL = 12_000  # what keeps the page of a run with many actors under a megabyte
_DEFAULT_SIZE_M = (VEHICLE_LENGTH_M, VEHICLE_WIDTH_M)


def collect(run_dir: Path) -> Json:
    """Gather the page's data.

    Raises
    ------
    InputError
        If the manifest or the trace is missing or broken. Other files may be missing: ``missing`` then says so.
    """
    manifest = _manifest(run_dir)
    missing = [f"the run broke off: {manifest['fault']}"] if manifest.get("fault") else []
    trace = read_trace(run_dir / TRACE_FILE)
    program = _program(run_dir, missing)
    params = _json(run_dir, "params.json", "the parameters' values", missing) or {}
    plan = _json(run_dir, "plan.json", "the planned motion", missing) or {}
    verdict = _json(run_dir, "verdict.json", "the judgement", missing)
    replans = read_replans(run_dir, missing)
    scene = scene_geometry(manifest, trace)
    if scene.problem:
        missing.append(scene.problem)
    chosen = _chosen_samples(trace)
    knots = _knots(manifest, verdict)
    facts = (verdict or {}).get("facts") or {}
    came = facts.get("trigger_came") or {}  # of one that never did, the nearest moment is no trigger
    known = triggers(program, knots, manifest.get("landmarks") or {}) if program else []
    reached = [trigger for trigger in known if came.get(trigger["hero"], True)]
    data: Json = {
        "schema_version": 1,
        "name": run_dir.resolve().name if manifest.get("name") in (None, "", *UNNAMED) else manifest["name"],
        "outcome": _outcome(manifest, verdict),
        "aftermath": _aftermath(verdict),
        "cause": _cause(verdict),
        "about": _about(manifest),
        "description": clauses(program) if program and program.description else _plain(manifest.get("description")),
        "understood": _understood(manifest, program),
        "program": _text(run_dir / "program.scene"),
        "parameters": _parameters(params),
        "missing": missing,
        "notes": [*(manifest.get("findings") or []), *(manifest.get("notes") or [])],
        "origin": list(scene.origin_xy_m),
        "map": scene.roads,
        "time": _numbers(trace.time_s[chosen], 4),
        "actors": _actors(trace, chosen, manifest, plan, scene, _in_order(knots, program, came, trace)),
        "triggers": reached,
        "places": places(program) if program else None,
        "conditions": _conditions(verdict, program, knots, reached),
        "facts": told_facts(facts),
        "replans": replans,
    }
    cleaned: Json = _without_nan(data)
    return cleaned


def _manifest(run_dir: Path) -> Json:
    path = run_dir / "manifest.json"
    if not path.is_file():
        raise InputError(
            "this is not a run directory",
            place=Place(str(run_dir)),
            expected="a folder with manifest.json and trace.parquet, as `scenewright run --out DIR` writes it",
        )
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, OSError) as error:
        raise InputError("the manifest cannot be read", place=Place(str(path)), found=str(error)) from None
    if not isinstance(content, dict):
        raise InputError("the manifest is not an object", place=Place(str(path)), found=type(content).__name__)
    return content


def _json(run_dir: Path, name: str, what: str, missing: list[str]) -> Json | None:
    path = run_dir / name
    if not path.is_file():
        missing.append(f"{name} is missing: {what} cannot be shown")
        return None
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, OSError):
        content = None
    if not isinstance(content, dict):
        missing.append(f"{name} cannot be read: {what} cannot be shown")
        return None
    return content


def _text(path: Path) -> str | None:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else None


def _program(run_dir: Path, missing: list[str]) -> Program | None:
    from scenewright.program.resolve import resolve
    from scenewright.program.text import parse_program

    text = _text(run_dir / "program.scene")
    if text is None:
        missing.append("program.scene is missing: triggers and the clauses of the description cannot be marked")
        return None
    try:
        return resolve(parse_program(text, "program.scene"))
    except ProgramError as error:
        missing.append(f"program.scene cannot be read ({error.message}): triggers and clauses cannot be marked")
        return None


def _plain(description: object) -> list[Json]:
    return [{"text": str(description), "ids": []}] if description else []


def _understood(manifest: Json, program: Program | None) -> list[Json]:
    """Return the sentences of what was understood with the words they came from, or else what the program says."""
    from scenewright.translate.lines import lines_of_program

    if (told := manifest.get("understood")) or program is None:
        return told or []
    return [{"sentence": line.sentence, "words": line.words} for line in lines_of_program(program)]


def _outcome(manifest: Json, verdict: Json | None) -> Json:
    """Say in one word how the run went, and how many of its conditions were met."""
    status = manifest.get("status")
    success = (verdict or {}).get("success") or {}
    conditions = (verdict or {}).get("conditions") or []
    if status == "interrupted":
        level = "interrupted"
    elif status == "failed" and not success.get("loose"):
        level = "failed"
    elif verdict is None:
        level = "unjudged"
    else:
        level = "tight" if success.get("tight") else "loose" if success.get("loose") else "failed"
    return {
        "level": level,
        "judged": verdict is not None,
        "total": len(conditions),
        "tight": sum(bool(c.get("tight")) for c in conditions),
        "loose": sum(bool(c.get("loose")) for c in conditions),
    }


def _aftermath(verdict: Json | None) -> Json | None:
    """Say in the judge's words what came of it, and when there was a collision; None where no verdict tells."""
    came = (verdict or {}).get("aftermath") or {}
    if not came.get("text"):
        return None
    return {"text": came["text"], "collision_s": (came.get("collision") or {}).get("time_s")}


def _cause(verdict: Json | None) -> str | None:
    """Say why it missed and what would do, as whoever drove it found; None where nothing is told."""
    cause = (verdict or {}).get("cause") or {}
    return " ".join(filter(None, (cause.get("text"), cause.get("way_out")))) or None


def _about(manifest: Json) -> list[list[str]]:
    ego = manifest.get("ego") or {}
    options = ego.get("options") or {}
    setting = ", ".join(f"{key}={_shown(value)}" for key, value in sorted(options.items())) if options else ""
    rates = manifest.get("rates") or {}
    rows = [
        ("Ego", f"{ego.get('name', '')}{f' ({setting})' if setting else ''}"),
        ("Simulator", manifest.get("simulator")),
        ("Map", (manifest.get("map") or {}).get("name")),
        ("Mode", manifest.get("mode")),
        ("Tolerance", manifest.get("tolerance")),
        ("Seed", manifest.get("seed")),
        ("Take", f"{take}, which knew how the ego drove before" if (take := manifest.get("take") or 1) > 1 else None),
        ("Re-solved at", f"{_shown(rates['replan_hz'])} Hz" if rates.get("replan_hz") else None),
        ("Translator", manifest.get("translator")),
        ("Version", manifest.get("scenewright_version")),
    ]
    return [[label, str(value)] for label, value in rows if value not in (None, "")]


def _parameters(params: Json) -> list[Json]:
    rows = []
    for name, entry in params.items():
        given = entry if isinstance(entry, dict) else {"value": entry}
        value = given.get("value")
        rows.append(
            {
                "name": name,
                "value": _shown(value) if value is not None else None,
                "unit": given.get("unit") or "",
                "source": given.get("source") or "",
            }
        )
    return rows


def _knots(manifest: Json, verdict: Json | None) -> dict[str, dict[str, float]]:
    """Return when each actor passed its knots: as the judge measured it, else as the run recorded it."""
    measured = ((verdict or {}).get("facts") or {}).get("knot_times_s") or {}
    recorded = manifest.get("knots") or {}
    return {
        actor: {
            name: float(time)
            for name, time in ((recorded.get(actor) or {}) | (measured.get(actor) or {})).items()
            if isinstance(time, int | float) and math.isfinite(time)
        }
        for actor in {**recorded, **measured}
    }


def _in_order(
    knots: Mapping[str, Mapping[str, float]], program: Program | None, came: Mapping[str, bool], trace: Trace
) -> dict[str, list[list[Any]]]:
    """Return by actor its knots in time: name, moment, and what happens then; nothing where nothing is said of it."""
    told = _happens(program, knots, came, float(trace.time_s[-1])) if program else {}
    numbers = {actor.name: actor.id for actor in program.actors} if program else {}
    return {
        actor: [
            [name, round(time, 4), told.get((numbers.get(actor, -1), name), "")]
            for name, time in sorted(own.items(), key=lambda knot: knot[1])
        ]
        for actor, own in knots.items()
    }


def _happens(
    program: Program, knots: Mapping[str, Mapping[str, float]], came: Mapping[str, bool], end_s: float
) -> dict[KnotKey, str]:
    """Return what happens at knots, but where a trigger never came.

    At what is nearest to it nothing begins, and at the end of the run nothing that was to follow.
    """
    from scenewright.translate.lines import told_knots

    told = told_knots(program)
    for hero, instant in read_structure(program).triggers.items():
        name = program.actor(hero).name
        if not came.get(name, True):
            own = knots.get(name, {}).items()
            unseen = instant | {(hero, knot) for knot, time_s in own if time_s >= end_s - _AN_INSTANT_S}
            told = {key: words for key, words in told.items() if key not in unseen}
    return told


def _chosen_samples(trace: Trace) -> NDArray[np.intp]:
    count = len(trace.time_s)
    kept = min(count, MAX_SAMPLES, max(200, _MAX_SAMPLES_IN_ALL // max(1, len(trace.actors))))
    return np.unique(np.linspace(0, count - 1, kept).round().astype(np.intp))


def _actors(
    trace: Trace,
    chosen: NDArray[np.intp],
    manifest: Json,
    plan: Json,
    scene: SceneGeometry,
    knots: Mapping[str, list[list[Any]]],
) -> list[Json]:
    return [
        _actor(name, actor, chosen, manifest, plan, scene) | {"knots": knots.get(name, [])}
        for name, actor in trace.actors.items()
    ]


def _actor(
    name: str, actor: ActorTrace, chosen: NDArray[np.intp], manifest: Json, plan: Json, scene: SceneGeometry
) -> Json:
    size = (manifest.get("vehicles") or {}).get(name) or {}
    planned = ((plan.get("actors") or {}).get(name) or {}).get("segments") or []
    origin = scene.origin_xy_m
    return {
        "name": name,
        "length": size.get("length_m", _DEFAULT_SIZE_M[0]),
        "width": size.get("width_m", _DEFAULT_SIZE_M[1]),
        "x": _numbers(actor.x_m[chosen] - origin[0], 3),
        "y": _numbers(actor.y_m[chosen] - origin[1], 3),
        "heading": _numbers(actor.heading_rad[chosen], 4),
        "s": _numbers(actor.s_m[chosen], 3),
        "v": _numbers(actor.speed_mps[chosen], 3),
        "a": _numbers(actor.accel_mps2[chosen], 3),
        "plan": [[_rounded(piece.get(key), 4) for key in _PIECE] for piece in planned],
        "limits": (manifest.get("limits") or {}).get(name) or {},
        "route": scene.routes.get(name, []),
        "landmarks": scene.landmarks.get(name, []),
    }


_PIECE = ("start_s", "duration_s", "s_m", "speed_mps", "accel_mpss", "jerk_mpsss")


def _conditions(
    verdict: Json | None, program: Program | None, knots: Mapping[str, Mapping[str, float]], reached: list[Json]
) -> list[Json]:
    times = condition_times(program, knots) if program else {}
    words = {c.id: program.words_of(c) for c in program.constraints} if program else {}
    came = {trigger["hero"]: trigger["time_s"] for trigger in reached}
    heroes = sorted((hero.name for hero in program.heroes), key=len, reverse=True) if program else []
    rows = []
    for condition in (verdict or {}).get("conditions") or []:
        identifier, text = str(condition.get("id", "")), str(condition.get("text") or "")
        # A condition may judge one side of a constraint: its id is then the constraint's with an ending (`c3.1`).
        owner = identifier if identifier in words else identifier.partition(".")[0]
        said = words.get(owner)
        time = times.get(owner)
        if owner not in words and condition.get("kind") in ("trigger", "interaction"):
            # What the judge asks beyond the program is about what begins at a trigger: that of the hero it is about.
            about = next((name for name in heroes if identifier.startswith(f"{name}_")), None)
            time = times.get(identifier.removesuffix("_falls")) if about is None else came.get(about)
        rows.append(
            {
                "id": identifier,
                "owner": owner,
                "kind": condition.get("kind") or "",
                "text": text,
                "words": said,
                "required": condition.get("required"),
                "measured": condition.get("measured"),
                "error": condition.get("error"),
                "unit": condition.get("unit") or "",
                "tight": condition.get("tight"),
                "loose": condition.get("loose"),
                "time": condition.get("time_s", time),
            }
        )
    return rows


def _shown(value: object) -> str:
    """Return a value as a person reads it: at most four decimals."""
    return f"{value:.4f}".rstrip("0").rstrip(".") if isinstance(value, float) else str(value)


def _numbers(values: NDArray[np.float64], digits: int) -> list[float | None]:
    return [_rounded(value, digits) for value in values.tolist()]


def _rounded(value: float | None, digits: int) -> float | None:
    if value is None or not math.isfinite(value):
        return None
    rounded = round(float(value), digits)
    return int(rounded) if rounded == int(rounded) else rounded


def _without_nan(value: Any) -> Any:
    """Return the same data with None for every number that JSON cannot hold."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {str(key): _without_nan(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_without_nan(item) for item in value]
    return value
