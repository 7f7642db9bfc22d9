"""Perfect performances pass with errors near nothing; each way of spoiling one fails exactly what it should."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from plays import BRAKES, GOES_AFTER, NOT_YIELDING, PLAYS, YIELDS, YIELDS_AT_S, Motion, Play, failed, on_line

from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.program.text import parse_program
from scenewright.trace.model import COLUMNS, ActorTrace, Trace


@pytest.mark.parametrize("phase_s", [0.0, 0.003, 0.0137])
@pytest.mark.parametrize("name", PLAYS)
def test_perfect_performance_passes_with_errors_near_nothing(name: str, phase_s: float) -> None:
    play = replace(PLAYS[name], phase_s=phase_s)
    verdict = judge(play.case())
    assert not failed(verdict, TIGHT)
    assert verdict.as_dict()["success"] == {"tight": True, "loose": True}
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(play.trigger_s, abs=1e-3)
    checked = [c for c in verdict.conditions if c.kind in ("initial", "trigger", "interaction", "outcome")]
    assert all(abs(c.error) < 1e-3 for c in checked if c.error is not None), [(c.id, c.error) for c in checked]
    assert {c.kind for c in verdict.conditions} >= {"route", "trigger", "interaction", "safety"}


def test_every_constraint_of_the_program_has_a_condition_in_plain_words() -> None:
    for play in PLAYS.values():
        case = play.case()
        verdict = judge(case)
        assert {c.id for c in case.program.constraints} <= {c.id for c in verdict.conditions}
    told = judge(BRAKES.case()).condition("c3").text
    assert told == "the ego is gap_m behind the hero when the hero begins to brake"


def line_of(trace: ActorTrace) -> tuple[float, float, float]:
    heading = float(trace.heading_rad[0])
    x0 = float(trace.x_m[0] - trace.s_m[0] * np.cos(heading))
    y0 = float(trace.y_m[0] - trace.s_m[0] * np.sin(heading))
    return x0, y0, heading


def backing_up(trace: ActorTrace) -> ActorTrace:
    """Add a second of rolling backwards, ever faster, and a second of slowing down from it."""
    a = np.where((trace.time_s > 11.0) & (trace.time_s < 12.0), -0.5, 0.0)
    a += np.where((trace.time_s > 12.0) & (trace.time_s < 13.0), 0.5, 0.0)
    steps = np.diff(trace.time_s)
    v = np.concatenate(([0.0], np.cumsum(a[:-1] * steps)))
    s = np.concatenate(([0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * steps)))
    return on_line(trace.time_s, trace.s_m + s, trace.speed_mps + v, trace.accel_mps2 + a, line_of(trace))


def jumping(trace: ActorTrace) -> ActorTrace:
    v = trace.speed_mps.copy()
    v[100:125] += 1.2
    v[125:150] -= 1.2
    s = trace.s_m[0] + np.concatenate(([0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(trace.time_s))))
    return on_line(trace.time_s, s, v, trace.accel_mps2, line_of(trace))


STOP_28 = -(12.0**2) / 56.0
ELSEWHERE = (500.0, 100.0, -np.pi / 2)  # far from the ego, so that a late hero does not hit it as well
# Hero 1.5 m late at the trigger, yet it stops where it should. Half of the 1.5 m falls on each side, by their speeds.
OFF = Motion(YIELDS.hero.s_m - 1.5, 12.0, [(YIELDS_AT_S, 0.0), (10.0, -(12.0**2) / (2 * 29.5))])
BACK_LATE = {"route_hero_progress", "kin_hero_reverse"}

SPOILED: dict[str, tuple[Play, Callable[[ActorTrace], ActorTrace] | None, set[str], set[str]]] = {
    "brakes 0.3 s late": (BRAKES.with_hero(pieces=[(7.8, 0.0), (5.0, -4.0)]), None, {"hero_onset"}, set()),
    "brakes 0.4 s early": (BRAKES.with_hero(pieces=[(7.1, 0.0), (5.0, -4.0)]), None, {"hero_onset"}, set()),
    "brakes 1 s early": (BRAKES.with_hero(pieces=[(6.5, 0.0), (5.0, -4.0)]), None, {"hero_onset"}, {"hero_onset"}),
    "brakes, lets go, brakes at the trigger": (
        BRAKES.with_hero(s_m=35.16, pieces=[(7.0, 0.0), (0.2, -2.0), (0.3, 0.0), (5.0, -4.0)]).with_ego(
            pieces=[(7.5, 0.0), (10.0, -2.2)]
        ),
        None,
        {"hero_settled"},
        {"hero_settled"},
    ),
    "rate 20 % off": (BRAKES.with_hero(pieces=[(7.5, 0.0), (5.0, -4.8)]), None, {"c4"}, set()),
    "rate 40 % off": (BRAKES.with_hero(pieces=[(7.5, 0.0), (5.0, -5.6)]), None, {"c4"}, {"c4"}),
    "gap 3 m off all the time": (
        replace(BRAKES, parameters={"gap_m": 40.0, "rate_mpss": 4.0}),
        None,
        {"c3", "hero_onset"},
        {"c3", "hero_onset"},
    ),
    "hero 1.5 m off": (replace(YIELDS, hero=OFF), None, {"c3", "c4"}, set()),
    "stops 1 m short": (
        YIELDS.with_hero(pieces=[(YIELDS_AT_S, 0.0), (10.0, -(12.0**2) / 54.0)]),
        None,
        {"c5"},
        set(),
    ),
    "stops 3 m too far": (
        YIELDS.with_hero(pieces=[(YIELDS_AT_S, 0.0), (10.0, -(12.0**2) / 62.0)]),
        None,
        {"c5"},
        {"c5"},
    ),
    "never stops": (
        YIELDS.with_hero(pieces=[(YIELDS_AT_S, 0.0), (4.0, -2.2)]),
        None,
        {"c5", "c6", "hero_standstill"},
        {"c5", "c6", "hero_standstill"},
    ),
    "ego stops 10 m before its side of the trigger": (
        YIELDS.with_ego(pieces=[(1.752998, 0.0), (9.0, -4.0)]),
        None,
        {"c3"},
        {"c3"},
    ),
    "starts elsewhere": (
        replace(YIELDS, text=YIELDS.text.replace("intersection - 60.02", "intersection - 61.22")),
        None,
        {"c1"},
        set(),
    ),
    "goes after the ego": (
        replace(NOT_YIELDING, hero_line=ELSEWHERE).with_ego(pieces=[(YIELDS_AT_S, 0.0), (4.0, 2.0)]),
        None,
        {"c6"},
        {"c6"},
    ),
    "does not speed up": (
        NOT_YIELDING.with_hero(pieces=[]).with_ego(pieces=[(YIELDS_AT_S, 0.0), (1.0, -2.5)]),
        None,
        {"hero_onset", "hero_acc"},
        {"hero_onset", "hero_acc"},
    ),
    "never goes again": (
        GOES_AFTER.with_hero(pieces=[(YIELDS_AT_S, 0.0), (56.0 / 12.0, STOP_28)]),
        None,
        {"c7", "c9", "hero_goes_again", "hero_acc"},
        {"c7", "c9", "hero_goes_again", "hero_acc"},
    ),
    "goes again too late": (
        replace(GOES_AFTER, hero_line=ELSEWHERE).with_hero(
            pieces=[(YIELDS_AT_S, 0.0), (56.0 / 12.0, STOP_28), (14.5, 0.0), (4.0, 2.0)]
        ),
        None,
        {"c9"},
        {"c9"},
    ),
    "hesitates while speeding up": (
        NOT_YIELDING.with_hero(pieces=[(YIELDS_AT_S, 0.0), (1.0, 2.0), (0.5, -1.2), (3.0, 2.0)]),
        None,
        {"hero_acc"},
        set(),
    ),
    "jumps in speed": (BRAKES, jumping, {"kin_hero_speed_jump"}, {"kin_hero_speed_jump"}),
    "backs up": (YIELDS, backing_up, BACK_LATE, {"route_hero_progress"}),
}


@pytest.mark.parametrize("name", SPOILED)
def test_spoiled_performance_fails_exactly_what_it_should(name: str) -> None:
    play, change, tight, loose = SPOILED[name]
    verdict = judge(play.case(change))
    table = [(c.id, c.required, c.measured, c.error) for c in verdict.conditions if not c.holds_at(TIGHT)]
    assert failed(verdict, TIGHT) == tight, table
    assert failed(verdict, LOOSE) == loose, table
    assert verdict.as_dict()["success"] == {"tight": not tight, "loose": not loose}


PARAMETERS = {"gap_m": 20.0, "rate_mpss": 4.0}


@pytest.mark.parametrize("samples", [1, 2, 3, 150, 250])
def test_run_that_ended_early_fails_without_a_fault(samples: int) -> None:
    case = YIELDS.case()
    columns = ("time_s", *COLUMNS)
    cut = {
        name: ActorTrace(**{column: getattr(states, column)[:samples] for column in columns})
        for name, states in case.trace.actors.items()
    }
    for program in PLAYS.values():
        verdict = judge(replace(case, program=parse_program(program.text), parameters=PARAMETERS, trace=Trace(cut)))
        assert not verdict.holds_at(LOOSE)
        assert verdict.as_dict()["success"] == {"tight": False, "loose": False}
