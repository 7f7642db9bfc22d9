"""Whether each actor, for itself, ever met its own side of a trigger.

What enters: a `Case` and what was measured. What leaves: facts with evidence. An ego that never comes to the place
where the trigger waits is a finding about the pair of program and ego, and must not be mistaken for a failure to
orchestrate.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.formulas import miss_of
from scenewright.judge.instants import minima
from scenewright.judge.knots import Measured, sides_of
from scenewright.judge.terms import Moments
from scenewright.judge.tolerance import LOOSE, TIGHT, FloatArray, Miss, Values, normalised, only_dimension, unit_symbol
from scenewright.judge.verdict import Condition
from scenewright.program.expressions import Derived, Formula, Logic, State, walk
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
        whole: dict[frozenset[int], list[Formula]] = {}
        for part in sides_of(case, instant, starts):
            evidence = _closest(case, part, told.get(part) or print_expression(part), instant, measured)
            if evidence is None:
                continue
            actors = frozenset(_actors(part))
            whole.setdefault(actors, []).append(part)
            sides.append(_side_of(case, actors, evidence))
        facts["closest"] += [*sides, *_not_at_once(case, whole, sides, instant, measured)]
        apart_s += [apart for apart in [_apart(sides)] if apart is not None]
    for side in facts["closest"]:
        facts[f"{side['who']}_never_met_condition"] |= not side["met"]
    facts["trigger_sides_apart_s"] = max(apart_s, default=None)
    return facts


def _side_of(case: Case, actors: frozenset[int], evidence: Mapping[str, Any]) -> dict[str, Any]:
    who = "pair" if len(actors) > 1 else "ego" if actors == {EGO} else "hero"
    return {"who": who, "actors": [case.name(actor) for actor in sorted(actors)], **evidence}


def _not_at_once(
    case: Case,
    whole: Mapping[frozenset[int], Sequence[Formula]],
    sides: Sequence[Mapping[str, Any]],
    instant: frozenset[KnotKey],
    measured: Measured,
) -> Iterator[dict[str, Any]]:
    """Yield the sides of those who met each part of theirs at some time, and never all of them at once."""
    for actors, parts in whole.items():
        own = [side for side in sides if side["actors"] == [case.name(actor) for actor in sorted(actors)]]
        if len(parts) > 1 and all(side["met"] for side in own):
            words = " and ".join(dict.fromkeys(side["side"] for side in own))
            evidence = _closest(case, Logic("and", tuple(parts)), words, instant, measured)
            if evidence is not None and not evidence["met"]:
                yield _side_of(case, actors, evidence)


def _actors(part: Formula) -> set[int]:
    actors = {node.actor for node in walk(part) if isinstance(node, State | Derived)}
    return actors | {node.target for node in walk(part) if isinstance(node, Derived) and isinstance(node.target, int)}


def _closest(
    case: Case, part: Formula, told: str, instant: frozenset[KnotKey], measured: Measured
) -> dict[str, Any] | None:
    """Return how near one side came to being met, at the instant nearest to the trigger among equally good ones."""

    def miss(time_s: Values) -> Miss:
        return miss_of(case, part, Moments({**measured.moments.knots, **dict.fromkeys(instant, time_s)}))

    def score(time_s: FloatArray) -> FloatArray:
        return np.broadcast_to(np.asarray(normalised(miss(time_s), TIGHT), dtype=np.float64), time_s.shape)

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
    dimension = only_dimension(miss(best.time_s))
    return {
        "side": told,
        "met": bool(best.score <= 1),
        "error": best.score * (TIGHT.of(dimension) if dimension else 1.0),
        "unit": unit_symbol(dimension) or "tight tolerances",
        "time_s": best.time_s,
    }


def _apart(closest: list[dict[str, Any]]) -> float | None:
    """Return how far apart in time the sides of one trigger were met; None where one of them never was."""
    times = [side["time_s"] for side in closest]
    return max(times) - min(times) if len(times) > 1 and all(side["met"] for side in closest) else None
