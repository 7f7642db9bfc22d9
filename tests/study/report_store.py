"""A store of results made up, in the schema of the real one: outcomes by a seeded die, consistent within a case."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from scenewright.study.lines import LineLog
from scenewright.study.store import LINES_FILE, CaseRecord, compact, write_settings

INTERACTIONS = ("Hero brakes", "Hero yields", "Hero does not yield", "Hero yields then goes")
METHODS = ("scenewright", "open-loop", "trigger-action", "synchronise", "rejection", "follower")
EGOS = ("constant", "idm", "dawdler", "staller", "stop-and-go", "noisy")
# How often each outcome comes up, by method; the rest are misses.
ODDS: dict[str, Mapping[str, float]] = {
    "scenewright": {"success": 0.9, "loose only": 0.02, "ego left no room": 0.02, "ego never met the condition": 0.02},
    "open-loop": {"success": 0.3, "loose only": 0.2, "ego never met the condition": 0.04},
    "trigger-action": {"success": 0.25, "loose only": 0.35, "ego never met the condition": 0.03},
    "synchronise": {"success": 0.4, "loose only": 0.25, "ego never met the condition": 0.03},
    "rejection": {"success": 0.1, "loose only": 0.25, "ego never met the condition": 0.03},
    "follower": {"success": 0.15, "loose only": 0.2, "ego never met the condition": 0.03},
}
LEVELS = ("fine", "tight", "loose", "coarse")


def made_up(
    rows: Sequence[int] = range(1, 81),
    egos: Sequence[str] = EGOS,
    draws: int = 3,
    methods: Sequence[str] = METHODS,
    seed: int = 0,
    only: str | None = None,
) -> list[CaseRecord]:
    """Return records of every combination; with `only` every case has that outcome."""
    random = np.random.default_rng(seed)
    records = []
    for row in rows:
        for draw in range(draws):
            infeasible = only == "proven infeasible" or (only is None and random.random() < 0.06)
            for ego in egos:
                for method in methods:
                    cause = "proven infeasible" if infeasible else only or rolled(method, random)
                    records.append(record(row, ego, draw, method, cause, random))
    return records


def rolled(method: str, random: np.random.Generator) -> str:
    odds = ODDS[method]
    left = 1.0 - sum(odds.values())
    return str(random.choice([*odds, "missed", "gave up"], p=[*odds.values(), 0.9 * left, 0.1 * left]))


def record(row: int, ego: str, draw: int, method: str, cause: str, random: np.random.Generator) -> CaseRecord:
    key = f"{row:02d}-{ego}-{draw}-{method}"
    driven = cause not in ("proven infeasible", "gave up", "error")
    later = cause == "success" and method == "scenewright" and random.random() < 0.04
    best = {"success": 3, "loose only": 2}.get(cause, int(random.random() < 0.2)) if driven else 0
    finest = cause == "success" and random.random() < 0.6
    first = 1 if later else best
    held = {level: rank >= 4 - best for rank, level in enumerate(LEVELS)}
    held["fine"] = finest
    began = {level: held[level] and first == best for level in LEVELS} | ({"coarse": True} if first else {})
    return CaseRecord(
        case=key,
        row=row,
        ego=ego,
        draw=draw,
        seed=draw,
        method=method,
        interaction=INTERACTIONS[(row - 1) % 4],
        trigger="Distance" if row <= 40 else "Time",
        ego_state="Westbound",
        ego_intent="Lane follow",
        hero_state="Driveway",
        hero_intent="Right turn",
        parameters=json.dumps({"ego_distance_behind_conflict_point_m": 12.5, "hero_distance_behind_stop_line_m": 20.0}),
        command=f"scenewright run results/programs/row_{row:02d}.scene -p ego_distance_behind_conflict_point_m=12.5 "
        f"-p hero_distance_behind_stop_line_m=20.0 --ego {ego} --seed {draw} --takes 3",
        status={"success": "success", "proven infeasible": "infeasible"}.get(cause, "failure"),
        cause=cause,
        first_cause="missed" if later else cause,
        take=2 if later else 1,
        takes=(2 if later else 1 if cause == "success" else 3) if driven else 0,
        **{f"best_{level}": held[level] for level in LEVELS},
        **{f"first_{level}": began[level] for level in LEVELS},
        criteria_disagree=driven and random.random() < 0.002,
        failed_conditions=[] if cause == "success" or not driven else ["c3", "criterion hero_side"],
        proof="c3: A1x(t1) == conflict_point - p\nhero: accelerates and brakes within its limits"
        if cause == "proven infeasible"
        else None,
        simulated_s=12.0 if driven else 0.0,
        wall_s=float(random.uniform(0.05, 0.6)),
        solve_ms=[float(value) for value in random.lognormal(1.8, 0.5, 20)] if method == "scenewright" else [],
    )


def write_store(folder: Path, records: Sequence[CaseRecord]) -> Path:
    """Write records and settings as an experiment does."""
    folder.mkdir(parents=True, exist_ok=True)
    settings = {
        "schema_version": 1,
        "command": "scenewright bench run --full --out results",
        "seed": 0,
        "rows": sorted({r.row for r in records}),
        "egos": list(dict.fromkeys(r.ego for r in records)),
        "draws": len({r.draw for r in records}),
        "methods": list(dict.fromkeys(r.method for r in records)),
        "takes": 3,
        "keep": "ours",
        "version": "0.1.0",
        "revision": "0123456789ab",
        "packages": {"z3-solver": "4.13.0.0", "numpy": "2.1.0"},
        "machine": {"cpu": "A processor", "cores": 2, "system": "Linux", "python": "3.11.2"},
        "started": "2026-01-01T00:00:00+00:00",
        "finished": "2026-01-01T00:20:00+00:00",
    }
    write_settings(folder, settings)
    log = LineLog(folder / LINES_FILE)
    for each in records:
        log.append(asdict(each))
    log.close()
    compact(folder)
    return folder
