"""Open against closed loop: four scenarios, reactive egos, drawn parameters, first take only.

What enters: egos, a number of draws, a seed. What leaves: one record a run, and a table of rates by scenario and mode.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scenewright.study.causes import NOT_OURS, cause_of
from scenewright.study.report.measuring import Bench, Job, Measured
from scenewright.study.report.precision import scene_text
from scenewright.study.report.tables import Table, Value
from scenewright.study.summary import Rate

SCENES = {
    "lead_turns_off": "lead turns into\nthe driveway",
    "oncoming_turns_across": "oncoming car turns\nacross the ego's way",
    "pulls_out_ahead": "car from the driveway\nturns into ego's lane",
    "pulls_out_across": "car from the driveway\nturns across ego's way",
}
MODES = ("open", "closed")
REACTIVE_EGOS = ("idm", "dawdler", "noisy", "delayed", "stop-and-go", "staller")


def measure_loops(bench: Bench, egos: Sequence[str], draws: int, seed: int) -> list[Measured]:
    """Run every scenario, ego and draw in open and in closed loop."""
    jobs = [
        {
            "scene": scene,
            "ego": ego,
            "draw": draw,
            "seed": seed + draw,
            "mode": mode,
            "program": scene_text(scene),
            "parameters": _drawn(scene, seed, draw),
        }
        for scene in SCENES
        for draw in range(draws)
        for ego in egos
        for mode in MODES
    ]
    return bench.measure("loops", run_loop, jobs)


def _drawn(scene: str, seed: int, draw: int) -> dict[str, float]:
    """Return values for a scenario's parameters within the ranges that it declares; the same for egos and modes."""
    from scenewright.program.text import parse_program

    random = np.random.default_rng([seed, sorted(SCENES).index(scene), draw])
    values = {}
    for parameter in parse_program(scene_text(scene), scene).parameters:
        low, high = parameter.bounds()
        values[parameter.name] = round(float(random.uniform(float(low), float(high))), 2)
    return values


def run_loop(job: Job) -> Measured:
    """Run one scenario once."""
    from scenewright.judge.tolerance import LOOSE, TIGHT
    from scenewright.orchestrate import orchestrate
    from scenewright.request import Request

    request = Request(job["program"], job["parameters"], ego=job["ego"], seed=job["seed"], mode=job["mode"], takes=1)
    result = orchestrate(request)
    verdict = result.verdict
    tight, loose = (verdict is not None and verdict.holds_at(tolerance) for tolerance in (TIGHT, LOOSE))
    return {"outcome": cause_of(result), "tight": tight, "loose": loose}


def loops_table(records: Sequence[Measured]) -> Table:
    """Return one line a scenario and mode, and one for all.

    A case is left out where it is infeasible or the ego never met its side, in both modes or not at all.
    """
    denied = [_case(r) for r in records if r.get("outcome") in NOT_OURS]
    left_out = {case for case in denied if denied.count(case) == len(MODES)}
    rows: list[tuple[Value, ...]] = []
    for scene in (*SCENES, "all"):
        for mode in MODES:
            own = [r for r in records if r["mode"] == mode and scene in (r["scene"], "all")]
            over = [r for r in own if _case(r) not in left_out]
            tight = Rate(sum(bool(r.get("tight")) for r in over), len(over))
            loose = Rate(sum(bool(r.get("loose")) for r in over), len(over))
            rows.append((scene, mode, len(own), len(over), tight, loose))
    columns = {
        "scene": "scenario",
        "mode": "loop",
        "cases": "cases",
        "counted": "counted",
        "tight": "tight, first take",
        "loose": "loose, first take",
    }
    return Table("loops", "Open against closed loop, four scenarios", columns, tuple(rows))


def _case(record: Measured) -> tuple[str, str, int]:
    return record["scene"], record["ego"], record["draw"]
