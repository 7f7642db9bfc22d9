"""Whether each actor, for itself, ever met its own side of a trigger.

What enters: a `Case` and what was measured. What leaves: facts with evidence. An ego that never comes to the place
where the trigger waits is a finding about the pair of program and ego, and must not be mistaken for a failure to
orchestrate.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.formulas import miss_of
from scenewright.judge.instants import minima
from scenewright.judge.knots import Measured, sides_of
from scenewright.judge.terms import Moments
from scenewright.judge.tolerance import LOOSE, TIGHT, FloatArray, dimension_of, normalised, unit_symbol
from scenewright.judge.verdict import Condition
from scenewright.program.expressions import Compare, Derived, Formula, State, walk
from scenewright.program.printer import print_expression
from scenewright.program.structure import KnotKey, Role, knots_of
from scenewright.program.types import EGO
from scenewright.translate.lines import told_formulas


def triggers_that_came(case: Case, asked: Sequence[Condition]) -> frozenset[int]:
    """Return the heroes whose trigger came: all that is asked of its moment holds at the loose tolerance.

    There is always an instant that is nearest to a trigger. Where that is not near enough, it never came.
    """
    held = {condition.id for condition in asked if condition.holds_at(LOOSE)}
    of_triggers = [each for each in case.program.constraints if case.structure.roles[each.id] is Role.TRIGGER]
    return frozenset(
        hero
        for hero, instant in case.structure.triggers.items()
        if all(each.id in held for each in of_triggers if set(knots_of(each.formula)) <= instant)
    )


def encounter_facts(case: Case, measured: Measured) -> dict[str, Any]:
    """Return who never met its side of a trigger within the tight tolerance, and how near everybody came."""
    facts: dict[str, Any] = {
        "ego_never_met_condition": False,
        "hero_never_met_condition": False,
        "pair_never_met_condition": False,
        "closest": [],
    }
    told = told_formulas(case.program)
    starts = {(actor.id, actor.sketch.knots[0]) for actor in case.program.actors}
    apart_s: list[float] = []
    for instant in dict.fromkeys(case.structure.triggers.values()):
        sides: list[dict[str, Any]] = []
        for part in sides_of(case, instant, starts):
            evidence = _closest(case, part, told.get(part) or print_expression(part), instant, measured)
            if evidence is None:
                continue
            actors = _actors(part)
            who = "pair" if len(actors) > 1 else "ego" if actors == {EGO} else "hero"
            sides.append({"who": who, "actors": [case.name(actor) for actor in sorted(actors)], **evidence})
            facts[f"{who}_never_met_condition"] |= not evidence["met"]
        facts["closest"] += sides
        apart_s += [apart for apart in [_apart(sides)] if apart is not None]
    facts["trigger_sides_apart_s"] = max(apart_s, default=None)
    return facts


def _actors(part: Formula) -> set[int]:
    actors = {node.actor for node in walk(part) if isinstance(node, State | Derived)}
    return actors | {node.target for node in walk(part) if isinstance(node, Derived) and isinstance(node.target, int)}


def _closest(
    case: Case, part: Formula, told: str, instant: frozenset[KnotKey], measured: Measured
) -> dict[str, Any] | None:
    """Return how near one side came to being met, at the instant nearest to the trigger among equally good ones."""

    def score(time_s: FloatArray) -> FloatArray:
        moments = Moments({**measured.moments.knots, **dict.fromkeys(instant, time_s)})
        errors = np.asarray(normalised(miss_of(case, part, moments), TIGHT), dtype=np.float64)
        return np.broadcast_to(errors, time_s.shape)

    try:
        found = minima(score, case.timelines[EGO].instants(case.start_s, case.end_s, parts=2))
    except CannotJudge:
        return None
    heroes = [hero for hero, knots in case.structure.triggers.items() if knots == instant]
    trigger_s = measured.triggers[heroes[0]]
    if not found:
        return {"side": told, "met": False, "error": None, "unit": "", "time_s": None}
    good = [minimum for minimum in found if minimum.score <= found[0].score + 1e-3]
    best = min(good, key=lambda minimum: abs(minimum.time_s - trigger_s))
    dimension = dimension_of(part) if isinstance(part, Compare) else None
    error = best.score * TIGHT.of(dimension) if isinstance(part, Compare) else best.score
    return {
        "side": told,
        "met": bool(best.score <= 1),
        "error": error,
        "unit": unit_symbol(dimension),
        "time_s": best.time_s,
    }


def _apart(closest: list[dict[str, Any]]) -> float | None:
    """Return how far apart in time the sides of one trigger were met; None where one of them never was."""
    times = [side["time_s"] for side in closest]
    return max(times) - min(times) if len(times) > 1 and all(side["met"] for side in closest) else None
