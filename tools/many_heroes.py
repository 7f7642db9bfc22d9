"""Drives many heroes at once: how long planning took, what was met, and how near anybody surely came to another.

python tools/many_heroes.py                              the table of docs/many-heroes.md
python tools/many_heroes.py platoon:8:idm chain:3:idm    these programs with so many heroes and these egos only
python tools/many_heroes.py takes 8 1-3                  with 8 heroes, all programs and egos, these seeds, two takes
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, fields
from itertools import combinations, product
from typing import Any

import numpy as np

from scenewright.judge.boxes import surely_apart_m
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.orchestrate import case_of, orchestrate
from scenewright.plan.planner import Planner, Replan
from scenewright.program.structure import actors_of
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.roads.bodies import CAR
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.simulate.beginning import first_plan
from scenewright.simulate.loop import DEFAULT_REPLAN_S, Rates, Run, simulate
from scenewright.simulate.port import Start
from scenewright.simulate.world import World
from scenewright.trace.model import ActorTrace, Trace

COUNTS, EGOS = (1, 4, 8, 12, 20), ("constant", "idm", "dawdler", "noisy", "stop-and-go")


def program_of(ego_knots: str, heroes: list[tuple[str, str]], constraints: list[str]) -> str:
    """Return a program of a westbound ego and heroes, each with its way and its knots."""
    actors = [f"Actor {k} (car{k}):\n- {way}\n- [{knots}]\n" for k, (way, knots) in enumerate(heroes, 1)]
    return "\n".join([f"Actor 0 (ego):\n- W\n- [{ego_knots}]\n", *actors, "Constraints:", *constraints, ""])


def platoon(count: int) -> str:
    """Return a program in which all ahead of the ego brake in turn: the foremost at the trigger, then one by one."""
    rows = [
        f"A0(t{1 + count - k}) == A{k}(t1)\nA0x(t{1 + count - k}) == {60 + 12 * (count - k)}\n"
        f"A{k}x(t1) == {80 + 12 * (count - k) + 22 * k}\nA{k}v(t2) == 3"
        for k in range(count, 0, -1)
    ]
    return program_of(", go, ".join(f"t{k}" for k in range(count + 2)), [("W", "t0, go, t1, dec, t2")] * count, rows)


def crossing(count: int) -> str:
    """Return a program in which cars of four lanes brake short of the junction when the ego is 60 m before it."""
    ways = [("E, N", "E", "S, W", "S, E")[k % 4] for k in range(1, count + 1)]
    rows = [
        f"A0(t1) == A{k}(t1)\nA{k}v(t2) == 2\n"
        f"A{k}x(t1) == stop_line - {14 + 16 * ((k - 1) // 4) + 7 * (k % 4 in (1, 3))}"
        for k in range(1, count + 1)
    ]
    heroes = [(way, "t0, go, t1, dec, t2") for way in ways]
    return program_of("t0, go, t1, go, t2", heroes, ["A0x(t1) == stop_line - 60", *rows])


def chain(count: int) -> str:
    """Return a program in which the car ahead brakes, and each behind the one before 1.5 s after that began."""
    rows = ["A0(t1) == A1(t1)", "A0x(t1) == stop_line - 200", f"A1x(t1) == stop_line - {180 - 18 * count}"]
    for k in range(2, count + 1):
        rows += [f"A{k}(t1) == A{k - 1}(t1) + 1.5 s", f"gap(A{k}, A{k - 1}, t1) == 16", f"A{k}a(dec) == -2"]
    return program_of("t0, go, t1, go, t2", [("W", "t0, go, t1, dec, t2")] * count, rows)


def mixed(count: int) -> str:
    """Return a program in which half brake ahead of the ego, and half go through the junction across its way."""
    ahead = (count + 1) // 2
    heroes, rows = list[tuple[str, str]](), list[str]()
    for k in range(1, count + 1):
        if k <= ahead:
            heroes.append(("W", "t0, go, t1, dec, t2"))
            rows += [f"A0(t1) == A{k}(t1)", f"A{k}x(t1) == stop_line - {100 - 20 * k}", f"A{k}v(t2) == 5"]
        else:
            row, way = divmod(k - ahead - 1, 2)
            heroes.append((("E", "S, E")[way], "t0, go, t1, acc, t2"))
            rows += [f"A0(t1) == A{k}(t1)", f"A{k}x(t1) == stop_line - {10 + 18 * row + 8 * way}", f"A{k}v(t2) == 9"]
    return program_of("t0, go, t1, go, t2", heroes, ["A0x(t1) == stop_line - 120", *rows])


PROGRAMS = {"platoon": platoon, "crossing": crossing, "mixed": mixed, "chain": chain}


class Clocked:
    """A planner whose ticks are timed, by the processor's clock: other work on the machine does not count."""

    def __init__(self, planner: Planner) -> None:
        self._planner = planner
        self.ticks_s: list[float] = []

    def tick(self, time_s: float) -> Replan:
        """Solve again, and keep how long that took if anything was solved."""
        began_s = time.process_time()
        record = self._planner.tick(time_s)
        if record.status != "frozen":
            self.ticks_s.append(time.process_time() - began_s)
        return record

    def __getattr__(self, name: str) -> Any:
        return getattr(self._planner, name)


@dataclass(frozen=True)
class Driven:
    """One run, and how long planning took (s of the processor)."""

    scene: Scene
    run: Run
    verdict: Verdict
    planned_s: float
    ticks_s: list[float]

    @property
    def met(self) -> int:
        """Of how many heroes everything holds."""
        return met(self.scene, self.verdict)

    def apart_m(self, *, of_ego: bool) -> float:
        """Return what heroes surely keep from each other, or each from the ego until its first moment."""
        return apart_m(self.scene, self.run.trace, self.verdict, of_ego=of_ego)


def met(scene: Scene, verdict: Verdict) -> int:
    """Return of how many heroes everything holds that the program says of them, at the tight tolerance."""
    broken = {condition.id for condition in verdict.conditions if not condition.holds_at(TIGHT)}
    of_broken = [actors_of(c.formula) for c in scene.program.constraints if c.id in broken]
    return sum(not any(hero.id in actors for actors in of_broken) for hero in scene.program.heroes)


def apart_m(scene: Scene, trace: Trace, verdict: Verdict, *, of_ego: bool) -> float:
    """Return what heroes surely keep from each other, or each from the ego until its first moment."""
    actors, knots = trace.actors, verdict.facts["knot_times_s"]

    def until_s(hero: str) -> float:
        return float(knots[hero].get("t1", np.inf)) if of_ego else np.inf

    return min(
        (
            surely_apart_m(*(_until(actors[each], until_s(b)) for each in (a, b)), (CAR, CAR))
            for a, b in combinations(actors, 2)
            if (a == scene.program.ego.name) == of_ego
        ),
        default=np.inf,
    )


def _until(states: ActorTrace, until_s: float) -> ActorTrace:
    count = max(2, int(np.searchsorted(states.time_s, until_s, side="right")))
    return ActorTrace(*(getattr(states, each.name)[:count] for each in fields(states)))


def drive(text: str, ego: str, seed: int = 0, replan_s: float = DEFAULT_REPLAN_S) -> Driven:
    """Plan and drive a program once, in one take."""
    program = parse_program(text)
    scene = ground(program, load_map(program.map_name), {})
    world = World(scene, ego, seed, Rates(replan_s=replan_s))
    began_s = time.process_time()
    planned = first_plan(world)
    assert planned is not None
    planned_s = time.process_time() - began_s
    heroes, start = Clocked(planned[0]), planned[1]
    begin_at = Start.of(scene, world.ego, (start.s_m, start.speed_mps), heroes.plan.profiles)
    run = simulate(world.simulator, begin_at, heroes, world.rates)
    return Driven(scene, run, judge(case_of(scene, run, world.limits)), planned_s, heroes.ticks_s)


def row(name: str, count: int, ego: str) -> str:
    """Return a line of the table."""
    driven = drive(PROGRAMS[name](count), ego)
    p50, p99 = 1000.0 * np.percentile(driven.ticks_s or [0.0], [50, 99])
    between, to_ego = (f"{driven.apart_m(of_ego=each):.2f}" for each in (False, True))
    lasted_s = len(next(iter(driven.run.trace.actors.values())).time_s) * 0.02
    cells = (
        name,
        count,
        ego,
        f"{driven.planned_s:.2f}",
        f"{p50:.0f} / {p99:.0f}",
        f"{driven.met}/{count}",
        between,
        to_ego,
        f"{lasted_s:.0f}",
    )
    return f"| {' | '.join(map(str, cells))} |"


def takes(count: int, seeds: range) -> Iterator[str]:
    """Yield lines: of how many heroes all holds in the first take and in the better of two, how near anybody came."""
    first = best = heroes = ticks = clear = runs = 0
    nearest_m = np.inf
    for name, ego, seed in product(PROGRAMS, EGOS, seeds):
        request = Request(PROGRAMS[name](count), ego=ego, seed=seed, takes=2, explain="nothing")
        result = orchestrate(request)
        if not result.takes:
            yield f"{name} {ego} seed {seed}: {result.status}"
            continue
        mets = [met(result.scene, take.verdict) for take in result.takes]
        seen = [(result.scene, take.trace, take.verdict) for take in result.takes]
        to_ego_m = apart_m(*seen[0], of_ego=True)
        first, best, heroes, runs = first + mets[0], best + max(mets), heroes + count, runs + 1
        ticks += sum(len(next(iter(take.trace.actors.values())).time_s) - 1 for take in result.takes)
        clear += to_ego_m > 0.0
        own_m = min(apart_m(*each, of_ego=False) for each in seen)
        nearest_m = min(nearest_m, own_m)
        if mets[0] < count or to_ego_m <= 0.0:
            yield f"{name} {ego} seed {seed}: met {mets}, apart {own_m:.2f} m, from the ego {to_ego_m:.2f} m"
    yield f"{count} heroes, {runs} runs, {ticks} steps: first take {first} of {heroes}, better of two {best}"
    yield f"no two heroes nearer than {nearest_m:.2f} m; clear of the ego before their moments in {clear} of {runs}"


def main(wanted: list[str]) -> None:
    """Print the table."""
    if len(wanted) == 3 and wanted[0] == "takes":
        begin, _, end = wanted[2].partition("-")
        for line in takes(int(wanted[1]), range(int(begin), int(end or begin) + 1)):
            print(line, flush=True)
        return
    if any(each.count(":") != 2 for each in wanted):
        raise SystemExit(
            "usage: many_heroes.py [PROGRAM:HEROES:EGO ...]\nfor instance platoon:8:idm; all of them without any"
        )
    print("| program | heroes | ego | first plan s | tick p50 / p99 ms | met | apart m | from the ego m | lasted s |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for each in wanted or [f"{name}:{count}:{ego}" for name in PROGRAMS for count in COUNTS for ego in EGOS]:
        name, count, ego = each.split(":")
        print(row(name, int(count), ego), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
