"""Judges a case: measures when things were, holds every condition against it, and adds facts.

What enters: a `Case`. What leaves: a `Verdict`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from scenewright.judge.aftermath import aftermath
from scenewright.judge.case import Case
from scenewright.judge.conditions import program_conditions
from scenewright.judge.encounter import encounter_facts, triggers_that_came
from scenewright.judge.interaction import interaction_conditions, interaction_facts
from scenewright.judge.kinematics import kinematic_conditions, kinematic_facts
from scenewright.judge.route import route_conditions
from scenewright.judge.safety import clear_conditions, safety_facts
from scenewright.judge.start import falling_conditions, start_condition
from scenewright.judge.unseen import measured_at_best
from scenewright.judge.verdict import Condition, Verdict
from scenewright.program.types import EGO

_ORDER = ("route", "initial", "trigger", "interaction", "outcome", "safety")


def judge(case: Case) -> Verdict:
    """Judge a run from its program, its trace and facts of the map.

    Parameters
    ----------
    case
        What was asked for and what happened.

    Returns
    -------
    Verdict
        Conditions in the order of the story, each with required and measured value, what came of it, and facts.
        Times are those of the trace (s).
    """
    # What never happens is at infinity, and differences of such times have no value; `formulas.error_of` fails those.
    with np.errstate(invalid="ignore"):
        return _judge(case)


def _judge(case: Case) -> Verdict:
    measured = measured_at_best(case)
    pairs, asked = safety_facts(case), program_conditions(case, measured)
    came = triggers_that_came(case, asked)
    conditions: list[Condition] = [
        *route_conditions(case),
        *asked,
        *falling_conditions(case, measured),
        *interaction_conditions(case, measured),
        start_condition(case),
        *clear_conditions(case, measured, came, pairs),
        *kinematic_conditions(case),
    ]
    conditions.sort(key=lambda condition: _ORDER.index(condition.kind))
    knot_times: dict[str, dict[str, Any]] = {actor.name: {} for actor in case.program.actors}
    for (actor_id, knot), time_s in measured.moments.knots.items():
        knot_times[case.name(actor_id)][knot] = time_s
    facts: dict[str, Any] = {
        "trigger_time_s": {case.name(hero): time_s for hero, time_s in measured.triggers.items()},
        "trigger_came": {case.name(hero): hero in came for hero in measured.triggers},
        "knot_times_s": knot_times,
        **encounter_facts(case, measured),
        "interaction": interaction_facts(case, measured),
        "pairs": pairs,
        "kinematics": {case.name(EGO): kinematic_facts(case, EGO)},
    }
    acts_s = min((measured.triggers[hero] for hero in came), default=None)
    return Verdict(tuple(conditions), aftermath(case, acts_s, pairs), facts)
