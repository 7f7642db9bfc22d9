"""Whether a run begins as traffic does, and comes to its trigger so: nobody is put where only braking hard saves it.

What enters: a `Case`, and for triggers what was measured. What leaves: conditions. A time to collision is a danger that
grows as it falls: one that is met while it rises was there before, and nobody acted on it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np

from scenewright.judge.boxes import moving_box, times_to_collision_s
from scenewright.judge.case import CannotJudge, Case
from scenewright.judge.knots import Measured, conjuncts
from scenewright.judge.terms import Moments, sides
from scenewright.judge.verdict import Condition, bounded
from scenewright.program.expressions import Compare, Derived, walk
from scenewright.program.starts import AT_ONCE_S, HARD_MPSS, kept_m, says_how_near
from scenewright.program.structure import Role, knots_of
from scenewright.program.types import EGO, PieceKind
from scenewright.translate.lines import told_formulas
from scenewright.translate.phrases import called

_INSTANT_S = 0.001  # who touches another meets it at once: no way is divided by no time


def start_condition(case: Case) -> Condition:
    """Judge that nobody who begins near to another has to brake hard at once."""
    braked = ((_hardest_braking_mpss(case, actor.id), actor.id) for actor in case.program.actors)
    near = ((rate, who) for rate, who in braked if rate > HARD_MPSS and _is_put_near(case, who))
    hardest, who = max(near, default=(0.0, None))
    whose = "" if who is None else f"; {called(case.name(who))} does"
    text = f"nobody begins so near to another that it brakes hard at once, unless the program puts it there{whose}"
    return bounded(
        "start", "safety", text,
        required=HARD_MPSS, measured=hardest, error=max(0.0, hardest - HARD_MPSS), dimension="acceleration",
    )  # fmt: skip


def falling_conditions(case: Case, measured: Measured) -> Iterator[Condition]:
    """Judge that a time to collision at which somebody acts had not been shorter before, unless that is asked for."""
    told = told_formulas(case.program)
    for constraint in case.program.constraints:
        for part in conjuncts(constraint.formula) if case.structure.roles[constraint.id] is Role.TRIGGER else ():
            own = next((node for node in walk(part) if isinstance(node, Derived) and node.kind == "ttc"), None)
            if own is None or not (isinstance(part, Compare) and part.operator == "==" and isinstance(own.target, int)):
                continue
            moments = [float(np.max(measured.moments.knots.get(key, np.inf))) for key in knots_of(part)]
            if np.isfinite(moments).all() and not says_how_near(case.program, case.structure, own.actor, own.target):
                with suppress(CannotJudge):  # then the trigger itself fails, and says why
                    yield _falls(case, measured, part, f"{constraint.id}_falls", told.get(part, constraint.id))


def _falls(case: Case, measured: Measured, part: Compare, name: str, words: str) -> Condition:
    known, keys = measured.moments.knots, list(knots_of(part))
    before = case.timelines[EGO].instants(case.start_s, float(np.max([known[key] for key in keys])))
    left, right = sides(case, part, Moments({**known, **dict.fromkeys(keys, before)}))
    if not isinstance(part.left, Derived):
        left, right = right, left
    values, required = np.broadcast_arrays(left, right)
    worst = int(np.argmin(values - required))
    least, asked = float(values[worst]), float(required[worst])
    return bounded(
        name, "trigger", f"{words}: it had not been shorter before",
        required=asked, measured=least, error=max(0.0, asked - least), dimension="time",
    )  # fmt: skip


def _hardest_braking_mpss(case: Case, actor: int) -> float:
    states = case.timelines[actor].states
    at_once = states.time_s <= case.start_s + AT_ONCE_S
    return max(0.0, -float(states.accel_mps2[at_once].min()))


def _is_put_near(case: Case, actor_id: int) -> bool:
    """Whether somebody begins near to another whom it drives towards, though nothing asks it to, nor to brake."""
    if actor_id != EGO and case.program.actor(actor_id).sketch.pieces[0] is PieceKind.DEC:
        return False
    others = (other.id for other in case.program.actors if other.id != actor_id)
    return any(
        _is_near(case, actor_id, other) and not says_how_near(case.program, case.structure, actor_id, other)
        for other in others
    )


def _is_near(case: Case, actor: int, other: int) -> bool:
    """Whether an actor begins with less room before where the other is than anybody would choose."""
    at = np.array([case.start_s])
    own, theirs = (moving_box(case.timelines[each].states, case.box(each), at) for each in (actor, other))
    headway_s = times_to_collision_s(own, replace(theirs, speed_mps=np.zeros(1)))[0]
    if not np.isfinite(headway_s):
        return False
    apart_m, meets_s = headway_s * own.speed_mps[0], max(float(times_to_collision_s(own, theirs)[0]), _INSTANT_S)
    return bool(apart_m < kept_m(float(own.speed_mps[0]), apart_m / meets_s))
