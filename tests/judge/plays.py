"""Traces made by exact integration of piecewise-constant accelerations, and the programs they play."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from scenewright.judge.case import Box, Case, Limits
from scenewright.judge.tolerance import Tolerance
from scenewright.judge.verdict import Verdict
from scenewright.program.text import parse_program
from scenewright.trace.model import ActorTrace, Trace

Array = NDArray[np.float64]
STEP_S = 0.02


def failed(verdict: Verdict, tolerance: Tolerance) -> set[str]:
    """Return the ids of the conditions that do not hold."""
    return {condition.id for condition in verdict.conditions if not condition.holds_at(tolerance)}


@dataclass(frozen=True)
class Motion:
    """Start state and (duration, acceleration) pieces; then the speed is held. A car that stops stays so."""

    s_m: float
    speed_mps: float
    pieces: Sequence[tuple[float, float]]

    def states(self, time_s: Array) -> tuple[Array, Array, Array]:
        start, s, v = 0.0, self.s_m, self.speed_mps
        position, speed, accel = (np.zeros_like(time_s) for _ in range(3))
        for duration, a in (*self.pieces, (1e9, 0.0)):
            parts = [(duration, a)]
            if a < 0 and v + a * duration < 0:
                parts = [(-v / a, a), (duration + v / a, 0.0)]
            for length, rate in parts:
                inside = time_s >= start - 1e-12
                u = np.maximum(time_s[inside] - start, 0.0)
                position[inside] = s + v * u + 0.5 * rate * u * u
                speed[inside], accel[inside] = np.maximum(v + rate * u, 0.0), rate
                length = min(length, 1e6)
                s, v, start = s + v * length + 0.5 * rate * length**2, max(v + rate * length, 0.0), start + length
        return position, speed, accel


def actor_trace(motion: Motion, time_s: Array, line: tuple[float, float, float]) -> ActorTrace:
    """Drive along a straight line; `line` is x and y at arc length 0 and the heading."""
    s, v, a = motion.states(time_s)
    return on_line(time_s, s, v, a, line)


def on_line(time_s: Array, s: Array, v: Array, a: Array, line: tuple[float, float, float]) -> ActorTrace:
    x0, y0, heading = line
    return ActorTrace(
        time_s=time_s,
        x_m=x0 + s * np.cos(heading),
        y_m=y0 + s * np.sin(heading),
        heading_rad=np.full_like(s, heading),
        speed_mps=v,
        accel_mps2=a,
        s_m=s,
        d_m=np.zeros_like(s),
    )


@dataclass(frozen=True)
class Line:
    """A straight route: x and y at arc length 0, and the heading."""

    x_m: float = 0.0
    y_m: float = 0.0
    heading_rad: float = 0.0

    def poses(self, s_m: Array, /) -> Array:
        heading = np.full_like(s_m, self.heading_rad)
        return np.column_stack([self.x_m + s_m * np.cos(heading), self.y_m + s_m * np.sin(heading), heading])


@dataclass(frozen=True)
class Play:
    """A program and the motions that perform it exactly."""

    text: str
    ego: Motion
    hero: Motion
    trigger_s: float
    hero_line: tuple[float, float, float]
    ego_line: tuple[float, float, float] = (0.0, 0.0, 0.0)
    parameters: Mapping[str, float] = field(default_factory=dict)
    offset_m: float | None = None
    duration_s: float = 20.0
    phase_s: float = 0.0

    def case(self, change: Callable[[ActorTrace], ActorTrace] | None = None) -> Case:
        """Return the case to judge; `change` tampers with the hero's trace."""
        time_s = np.concatenate(([0.0], np.arange(STEP_S - self.phase_s, self.duration_s, STEP_S)))
        hero = actor_trace(self.hero, time_s, self.hero_line)
        traces = {"ego": actor_trace(self.ego, time_s, self.ego_line), "hero": change(hero) if change else hero}
        return Case(
            program=parse_program(self.text),
            parameters=self.parameters,
            landmarks=LANDMARKS,
            shared_offset_m={("ego", "hero"): self.offset_m},
            trace=Trace(traces),
            vehicles={"ego": Box(), "hero": Box()},
            limits={"hero": Limits(20.0, -8.0, 4.0, 3.0)},
            paths={"ego": Line(*self.ego_line), "hero": Line(*self.hero_line)},
        )

    def with_hero(self, **changes: object) -> Play:
        return replace(self, hero=replace(self.hero, **changes))  # type: ignore[arg-type]

    def with_ego(self, **changes: object) -> Play:
        return replace(self, ego=replace(self.ego, **changes))  # type: ignore[arg-type]


LANDMARKS = {
    "ego": {
        "stop_line": 60.0,
        "turn_start": 64.0,
        "conflict_point": 70.0,
        "intersection": 70.0,
        "turn_end": 76.0,
        "junction_start": 62.0,
    },
    "hero": {"stop_line": 90.0, "conflict_point": 100.0, "intersection": 100.0, "turn_end": 106.0},
}
# The ego goes east; the hero comes from the north on a road of its own and crosses at the conflict points.
CROSSING = (70.0, 100.0, -np.pi / 2)
AHEAD = (0.0, 0.0, 0.0)  # the same lane

HEAD = """scenario "test"
description:
"Ego drives. {words}"

Actor 0 (ego):
- E
- {ego_sketch}

Actor 1 (hero):
- {heading}
- {hero_sketch}

Constraints:
{constraints}
"""


def text(hero_sketch: str, constraints: str, ego_sketch: str = "[t0, go, t1, go, t2]", heading: str = "S") -> str:
    return HEAD.format(
        words="The hero acts.", ego_sketch=ego_sketch, heading=heading, hero_sketch=hero_sketch, constraints=constraints
    )


# Ego 10 m/s from 0; hero 35 m ahead at 8 m/s: the gap is 20 m at 7.5 s. Then it brakes at 4 m/s^2.
BRAKES = Play(
    text=text(
        "[t0, go, t1, dec, t2]",
        "A0v(t0) == 10\nA0(t1) == A1(t1)\ngap(A0, A1, t1) == gap_m  @0..4\nA1a(dec) == -rate_mpss\nA1v(t2) == 0",
        heading="E",
    ),
    ego=Motion(0.0, 10.0, [(7.5, 0.0), (10.0, -2.2)]),
    hero=Motion(35.0, 8.0, [(7.5, 0.0), (5.0, -4.0)]),
    trigger_s=7.5,
    hero_line=AHEAD,
    parameters={"gap_m": 20.0, "rate_mpss": 4.0},
    offset_m=0.0,
)

# The ego is 18 m short of the line at 4.003 s; the hero is 40 m short of its point then, and stops 12 m short of it.
YIELDS_AT_S = 4.003
YIELDS = Play(
    text=text(
        "[t0, go, t1, dec, t2]",
        "A0x(t0) == intersection - 60\nA0(t1) == A1(t1)\nA0x(t1) == stop_line - 18\nA1x(t1) == conflict_point - 40\n"
        "A1x(t2) == conflict_point - 12\nA1v(t2) == 0",
    ),
    ego=Motion(42.0 - 8.0 * YIELDS_AT_S, 8.0, [(YIELDS_AT_S, 0.0), (10.0, 0.5)]),
    hero=Motion(60.0 - 12.0 * YIELDS_AT_S, 12.0, [(YIELDS_AT_S, 0.0), (10.0, -(12.0**2) / (2 * 28.0))]),
    trigger_s=YIELDS_AT_S,
    hero_line=CROSSING,
    duration_s=15.0,
)
YIELDS = replace(YIELDS, text=YIELDS.text.replace("intersection - 60", f"intersection - {70.0 - YIELDS.ego.s_m:.6f}"))

NOT_YIELDING = Play(
    text=text(
        "[t0, go, t1, acc, t2]",
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 18\nA1x(t1) == conflict_point - 40\n"
        "A1x(t2) == conflict_point\nA0x(t2) == turn_start\nA1(t2) < A0(t2)",
    ),
    ego=Motion(42.0 - 8.0 * YIELDS_AT_S, 8.0, [(YIELDS_AT_S, 0.0), (1.0, -1.5)]),
    hero=Motion(60.0 - 12.0 * YIELDS_AT_S, 12.0, [(YIELDS_AT_S, 0.0), (2.6, 2.0)]),
    trigger_s=YIELDS_AT_S,
    hero_line=CROSSING,
    duration_s=15.0,
)

GOES_AFTER = Play(
    text=text(
        "[t0, go, t1, dec, t2, stop, t3, acc, t4]",
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 18\nA1x(t1) == conflict_point - 40\n"
        "A1x(t2) == conflict_point - 12\nA1v(t2) == 0\nA1v(stop) == 0\nA1x(t4) == conflict_point\n"
        "A0x(t2) == turn_start\nA1(t4) < A0(t2)",
    ),
    ego=Motion(42.0 - 8.0 * YIELDS_AT_S, 8.0, [(YIELDS_AT_S, 0.0), (10.0, -1.7777778), (7.0, 0.0), (30.0, 1.0)]),
    hero=Motion(
        60.0 - 12.0 * YIELDS_AT_S, 12.0, [(YIELDS_AT_S, 0.0), (56.0 / 12.0, -(12.0**2) / 56.0), (1.5, 0.0), (4.0, 2.0)]
    ),
    trigger_s=YIELDS_AT_S,
    hero_line=CROSSING,
    duration_s=30.0,
)

# tta sides: 18 m at 8 m/s is 2.25 s, 40 m at 12 m/s is 10/3 s.
ARRIVAL = replace(
    YIELDS,
    text=text(
        "[t0, go, t1, dec, t2]",
        "A0(t1) == A1(t1)\ntta(A0, stop_line, t1) == 2.25 s\ntta(A1, conflict_point, t1) == 10 / 3\n"
        "A1x(t2) == conflict_point - 12\nA1v(t2) == 0",
    ),
)

PLAYS = {
    "brakes": BRAKES,
    "yields": YIELDS,
    "does not yield": NOT_YIELDING,
    "yields then goes": GOES_AFTER,
    "arrival times": ARRIVAL,
}
