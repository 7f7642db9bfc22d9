"""Records of cases that were never run."""

from __future__ import annotations

from dataclasses import replace

from scenewright.study.store import CaseRecord

BLANK = CaseRecord(
    case="",
    row=1,
    ego="idm",
    draw=0,
    seed=1,
    method="scenewright",
    interaction="Hero brakes",
    trigger="Distance",
    ego_state="Driveway",
    ego_intent="Right turn",
    hero_state="Driveway",
    hero_intent="Right turn",
    parameters='{"ego_distance_m": 12.5}',
    command="scenewright run x.scene",
)


def record(
    row: int = 1, ego: str = "idm", cause: str = "success", first: str | None = None, **changes: object
) -> CaseRecord:
    """Return a record whose levels fit its causes."""
    first = cause if first is None else first
    levels = {}
    for which, own in (("best", cause), ("first", first)):
        for level in ("tight", "loose", "coarse"):
            levels[f"{which}_{level}"] = own == "success" or (own == "loose only" and level != "tight")
    method = str(changes.get("method", "scenewright"))
    made = replace(BLANK, row=row, ego=ego, cause=cause, first_cause=first, **levels)
    return replace(made, **{"case": f"{row:02d}-{ego}-{changes.get('draw', 0)}-{method}", **changes})
