"""What happened between the vehicles: collisions, distances, times to collision, post-encroachment time.

What enters: a `Case` and what was measured. What leaves: facts, and conditions. A crash of the ego before the trigger
means that the situation asked for did not come about; one of two orchestrated actors is never what the ego did. A crash
of the ego after the trigger is what the test is for: it is told in the aftermath. So is one that the situation consists
of: where the program says of both where they are at the trigger, and they touch.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np

from scenewright.judge.aftermath import collision_at
from scenewright.judge.boxes import closest_m, distances_m, moving_box, overlapping, times_to_collision_s
from scenewright.judge.case import Case
from scenewright.judge.encroachment import post_encroachment_s
from scenewright.judge.knots import Measured
from scenewright.judge.verdict import Condition, bounded
from scenewright.program.structure import placed_at
from scenewright.program.types import EGO

_SUB_STEPS = 5  # the samples, and four instants between each two
_INSTANT_S = 0.001  # a collision at the trigger itself, or in the last instant of a run, is one, too


def safety_facts(case: Case) -> dict[str, Any]:
    """Return facts about every pair of actors, by ``"ego, hero"``."""
    return {f"{case.name(a)}, {case.name(b)}": _pair(case, a, b) for a, b in _pairs(case)}


def clear_conditions(case: Case, measured: Measured, came: frozenset[int], facts: dict[str, Any]) -> list[Condition]:
    """Judge that the ego is clear of all up to the trigger and orchestrated actors of each other throughout.

    But for those whom the program puts into each other at a trigger. What "clear" means is in the program's manner.
    Where the trigger of a hero is not among those that `came`, all of the run is before it. Where the program has none
    at all, nobody waits for anything: that the ego drives into another is then what the test is for.
    """
    clear_m = float(case.program.manner.clear_m)
    room = f" (and is more than {clear_m:g} m from anybody)" if clear_m else ""

    def first_s(of_ego: bool) -> float | None:
        times = (
            _first_near_s(case, a, b, clear_m, facts[f"{case.name(a)}, {case.name(b)}"]["collision_time_s"])
            for a, b in _pairs(case)
            if (EGO in (a, b)) == of_ego
            and not _contact_is_asked_for(case, measured, a, b)
            and not (of_ego and not clear_m and _ego_drives_into(case, a, b, facts))
        )
        return min((time_s for time_s in times if time_s is not None), default=None)

    text = f"the ego collides with nobody before the trigger{room}"
    clear = [_clear("no_collision", text, first_s(True), _trigger_time_s(case, measured, came))]
    if len(case.program.heroes) > 1:
        text = f"orchestrated actors do not collide with each other{room}"
        clear.append(_clear("heroes_apart", text, first_s(False), case.end_s))
    return clear


def _ego_drives_into(case: Case, a: int, b: int, facts: dict[str, Any]) -> bool:
    """Whether two collide, in a program without a trigger, because the ego drove into the other."""
    hit_s = facts[f"{case.name(a)}, {case.name(b)}"]["collision_time_s"]
    return (
        not case.structure.triggers
        and hit_s is not None
        and collision_at(case, a, b, hit_s).actors[0] == case.name(EGO)
    )


def _first_near_s(case: Case, a: int, b: int, clear_m: float, collision_s: float | None) -> float | None:
    """Return when (s) two were first no further apart than `clear_m`; None where they never were."""
    if not clear_m:
        return collision_s
    instants = case.timelines[a].instants(case.start_s, case.end_s, parts=_SUB_STEPS)
    boxes = [moving_box(case.timelines[actor].states, case.box(actor), instants) for actor in (a, b)]
    near = np.flatnonzero(distances_m(*boxes) <= clear_m)
    return float(instants[near[0]]) if len(near) else None


def _clear(condition_id: str, text: str, first_s: float | None, until_s: float) -> Condition:
    early = 0.0 if first_s is None else max(0.0, until_s + _INSTANT_S - first_s)
    return bounded(
        condition_id, "safety", text,
        required=until_s, measured=first_s, error=early, dimension="time", exact=True,
    )  # fmt: skip


def _pairs(case: Case) -> Iterator[tuple[int, int]]:
    return combinations(sorted(actor.id for actor in case.program.actors), 2)


def _trigger_time_s(case: Case, measured: Measured, came: frozenset[int]) -> float:
    """Return when the last trigger came; the end of the run where one never did or there is none."""
    if not came.issuperset(case.structure.triggers):
        return case.end_s
    knots = ((hero.id, case.structure.trigger_knot(hero.id)) for hero in case.program.heroes)
    times = [float(np.max(measured.moments.knots.get((hero, knot), np.inf))) for hero, knot in knots if knot]
    return min(max(times, default=np.inf), case.end_s)


def _contact_is_asked_for(case: Case, measured: Measured, a: int, b: int) -> bool:
    """Whether two touch at a trigger that says where both of them are, and not before they come to it."""
    for instant in case.structure.triggers.values():
        known = measured.moments.knots
        until_s = max((float(np.max(known[key])) for key in instant if key in known), default=np.inf)
        if {a, b} <= placed_at(case.program, instant) and np.isfinite(until_s):
            instants = case.timelines[a].instants(case.start_s, until_s, parts=_SUB_STEPS)
            boxes = (moving_box(case.timelines[actor].states, case.box(actor), instants) for actor in (a, b))
            touch = overlapping(*boxes)
            if touch[-1] and np.count_nonzero(np.diff(touch.astype(int))) <= 1:  # one contact, still on at the trigger
                return True
    return False


def _pair(case: Case, a: int, b: int) -> dict[str, Any]:
    instants = case.timelines[a].instants(case.start_s, case.end_s, parts=_SUB_STEPS)
    box_a = moving_box(case.timelines[a].states, case.box(a), instants)
    box_b = moving_box(case.timelines[b].states, case.box(b), instants)
    hits = np.flatnonzero(overlapping(box_a, box_b))
    distance, when = closest_m(box_a, box_b)
    ttc = times_to_collision_s(box_a, box_b)
    soonest = int(np.argmin(ttc))
    # Who drives through another has not passed it.
    states = case.timelines[a].states, case.timelines[b].states
    after_s = None if len(hits) else post_encroachment_s(*states, (case.box(a), case.box(b)))
    return {
        "collision_time_s": float(instants[hits[0]]) if len(hits) else None,
        "min_distance_m": distance,
        "min_distance_time_s": float(instants[when]),
        "min_ttc_s": float(ttc[soonest]) if np.isfinite(ttc[soonest]) else None,
        "min_ttc_time_s": float(instants[soonest]) if np.isfinite(ttc[soonest]) else None,
        "post_encroachment_time_s": after_s,
    }
