"""Searches, for cases of the benchmark that missed, whether any approach of the hero would have done with that ego.

python tools/best_approach.py results/fresh                  first takes that missed; 1500 approaches each
python tools/best_approach.py results/fresh 3000 50,72       so many approaches; of these rows

An approach is where and when a hero acts, how fast it is then, its accelerations in the seconds before that, and how it
carries out what it is to do. The ego starts as the first take lets it, and answers. What is found is judged as any run
is. Two searches: of approaches that people might drive, and of any that a vehicle can. This is no planner: each try is
a drive against the ego itself, which no take may know. That nothing is found proves nothing, but says a lot.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

from scenewright.errors import PolicyError
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import begin, case_of
from scenewright.plan.planner import Replan
from scenewright.plan.prediction import EgoSample
from scenewright.program.types import EGO, PieceKind
from scenewright.request import Request, Stages
from scenewright.simulate.beginning import first_states
from scenewright.simulate.loop import simulate
from scenewright.simulate.port import Start
from scenewright.solve.arrival import linear_conditions, tight_of
from scenewright.solve.plan import Plan
from scenewright.study.benchmark.rows import benchmark_rows

HERO = 1
# Chosen: seconds of a hero that are searched through, and how long it comes evenly behind them; the latest trigger; how
# fast heroes are, brake and speed up.
CELLS, EVEN_S, LATEST_S = 4, 0.6, 15.0
MOST_MPS, HARDEST_MPSS, LEAST_MPSS, MOST_MPSS = 17.0, 8.0, 0.62, 4.0
WATCHED_S = 6.0  # after the hero has done all
# What it costs where there is no motion, where the ego is off its side, and at most where a condition fails; chosen.
MOTION, TRIGGER, RUN = 1e6, 1e3, 30.0
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Manner:
    """How heroes may come: accelerations (m/s^2) up to this, and never slower than this (m/s)."""

    name: str
    accel_mpss: float
    slowest_mps: float


MANNERS = Manner("as people might drive", 1.5, 1.8), Manner("as vehicles can", 4.0, 0.0)


class Scripted:
    """A hero that drives one motion whatever the ego does."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.ego_knots_s, self.records = plan, dict[str, float](), list[Replan]()
        self._ends_s = max(plan.profiles[HERO].knot_times_s.values()) + WATCHED_S

    def tick(self, time_s: float) -> Replan:
        raise NotImplementedError("nothing is solved again")

    def observe(self, sample: EgoSample) -> None:
        if sample[0] > self._ends_s:
            raise PolicyError("seen enough")  # what was driven is kept


class Approaches:
    """All approaches to one case; points of a unit cube stand for them."""

    def __init__(self, case: Mapping[str, object], manner: Manner) -> None:
        row = next(row for row in benchmark_rows() if row.id == case["row"])
        values = json.loads(str(case["parameters"]))
        request = Request(
            row.program_text, parameters=values, ego=str(case["ego"]), seed=int(str(case["seed"])), explain="nothing"
        )
        self.manner, (self.world, _, _) = manner, begin(request, Stages(None))
        self.scene, self.start = self.world.scene, next(first_states(self.world))
        conditions = linear_conditions(self.scene, self.world.structure)
        at_trigger = self.world.structure.triggers[HERO]
        self.placed = {next(iter(c.moments)): c for c in conditions if set(c.weights) == {HERO} and c.weights[HERO][0]}
        self.trigger = [c for c in conditions if c.moments <= at_trigger and c.weights.get(EGO, (0.0, 0.0))[0]]
        self.sketch, self.acts = self.scene.program.actor(HERO).sketch, self.world.structure.trigger_knot(HERO) or ""
        self.told_mpss = next((float(v) for name, v in self.scene.parameters.items() if "celeration" in name), None)
        self.size = 6 + CELLS
        self.tried, self.best = 0, math.inf

    def motion(self, point: Array) -> tuple[Profile | None, float]:
        """Return the motion that a point stands for, or by how much there is none."""
        acts_s, speed_mps = 0.7 + (LATEST_S - 0.7) * point[0], self.manner.slowest_mps + MOST_MPS * point[1]
        begins = self.placed.get((HERO, self.acts))
        there_m = self.scene.routes[HERO].landmarks["route_end"] * point[2]
        there_m = there_m if begins is None else begins.place_m(HERO, speed_mps)
        moves, s_m, now_mps, left_s = list[tuple[float, float, int]](), there_m, speed_mps, acts_s
        slowest_mps = min(speed_mps, self.manner.slowest_mps)
        rates = (0.0, *(self.manner.accel_mpss * (2.0 * point[6:] - 1.0)), 0.0)  # from its trigger backwards
        for rate, lasts_s in zip(rates, (EVEN_S, *[1.0] * CELLS, LATEST_S), strict=True):
            lasts_s = min(lasts_s, left_s)
            before_mps = max(now_mps - rate * lasts_s, slowest_mps)
            if lasts_s > 0.0:
                moves.insert(0, (lasts_s, (now_mps - before_mps) / lasts_s, 0))
            s_m -= 0.5 * (now_mps + before_mps) * lasts_s
            now_mps, left_s = before_mps, left_s - lasts_s
        after, knots_s, lacking = self._deeds(point[3:6], acts_s, there_m, speed_mps)
        lacking += max(0.0, 1.0 - s_m)
        if lacking > 0.0:
            return None, lacking
        knots_s |= {self.sketch.knots[0]: 0.0, self.acts: acts_s}
        return Profile(chain(0.0, s_m, now_mps, moves + after), knots_s), 0.0

    def _deeds(
        self, share: Array, acts_s: float, s_m: float, speed_mps: float
    ) -> tuple[list[tuple[float, float, int]], dict[str, float], float]:
        """Return what it does from its trigger on, when its knots come, and by how much that cannot be."""
        moves, knots_s, time_s, lacking = list[tuple[float, float, int]](), dict[str, float](), acts_s, 0.0
        first = self.sketch.knot_index(self.acts)
        for piece, kind in list(enumerate(self.sketch.pieces))[first:]:
            ends = self.sketch.knots[piece + 1]
            placed = self.placed.get((HERO, ends))
            way_m = None if placed is None else placed.place_m(HERO, 0.0) - s_m
            chosen = float(share[int(kind == PieceKind.ACC)])
            own_mpss = self.told_mpss or LEAST_MPSS + (MOST_MPSS - LEAST_MPSS) * chosen
            if kind == PieceKind.DEC:
                rate = own_mpss if way_m is None else 0.5 * speed_mps**2 / max(way_m, 1e-3)
                lacking += max(0.0, rate - HARDEST_MPSS)
                part = [(speed_mps / rate, -rate, piece)]
            elif kind == PieceKind.ACC:
                faster_s = max(0.0, MOST_MPS - speed_mps) / own_mpss
                whole = Profile(chain(0.0, 0.0, speed_mps, [(faster_s, own_mpss, piece), (LATEST_S, 0.0, piece)]))
                lasts_s = 2.0 if way_m is None else whole.time_at(way_m) or LATEST_S
                part = [(min(lasts_s, faster_s), own_mpss, piece), (max(0.0, lasts_s - faster_s), 0.0, piece)]
            else:
                part = [(0.35 + 8.0 * share[2] if kind == PieceKind.STOP else 3.0, 0.0, piece)]
            driven = Profile(chain(time_s, s_m, speed_mps, part))
            moves += part
            time_s = knots_s[ends] = driven.end_s
            s_m, speed_mps, _ = driven.state(time_s)
        return moves, knots_s, lacking

    def cost(self, point: Array) -> float:
        """Return how far an approach is from a success; 0 is one."""
        if self.best == 0.0:
            return 0.0  # the search may end
        motion, lacking = self.motion(point)
        if motion is None:
            return MOTION + lacking
        self.tried += 1
        ego = Profile(chain(0.0, self.start.s_m, self.start.speed_mps, [(1.0, 0.0, 0)]), {"t0": 0.0})
        plan = Plan({EGO: ego, HERO: motion})
        start = Start.of(self.scene, self.world.ego, (self.start.s_m, self.start.speed_mps), plan.profiles)
        off = self._trigger_off(start, motion)
        if off > 3.0:
            return TRIGGER * (1.0 + off)
        run = simulate(self.world.simulator, start, Scripted(plan), replace(self.world.rates, replan_s=None))
        verdict = judge(case_of(self.scene, run, self.world.limits))
        errors = [condition.normalised_error(TIGHT) for condition in verdict.conditions]
        cost = sum(min(max(0.0, error - 0.8), RUN) ** 2 for error in errors) + 1e-6
        self.best = min(self.best, 0.0 if verdict.holds_at(TIGHT) else cost)
        return 0.0 if verdict.holds_at(TIGHT) else cost

    def _trigger_off(self, start: Start, motion: Profile) -> float:
        """Return by how many tight tolerances the ego is off its side when the hero acts; soon seen."""
        simulator, acts_s = self.world.simulator, motion.knot_times_s[self.acts]
        simulator.reset(start, self.world.rates.step_s)
        for _ in range(round(acts_s / self.world.rates.step_s)):
            simulator.apply({HERO: motion})
            simulator.observe()
            simulator.step()
        ego = simulator.observe().actors[EGO]
        states = {EGO: (ego.s_m, ego.speed_mps), HERO: motion.state(acts_s)[:2]}
        return max(abs(each.value(states)) / tight_of(each, ego.speed_mps) for each in self.trigger)


def main(folder: str, approaches: str = "1500", rows: str = "") -> None:
    """Search for each case, and tell what was found."""
    found = {manner.name: 0 for manner in MANNERS}
    cases = [case for case in pq.read_table(Path(folder) / "cases.parquet").to_pylist() if not case["first_tight"]]
    cases = [case for case in cases if case["first_cause"] != "proven infeasible"]
    cases = [case for case in cases if not rows or str(case["row"]) in rows.split(",")]
    for case in cases:
        told = []
        for manner in MANNERS:
            search = Approaches(case, manner)
            each, bounds = 10, [(0.0, 1.0)] * search.size
            differential_evolution(
                search.cost, bounds, popsize=each, maxiter=int(approaches) // (each * search.size) - 1, seed=0,
                polish=False, tol=0.0, atol=0.0, callback=lambda intermediate_result: intermediate_result.fun <= 0.0,
            )  # fmt: skip
            found[manner.name] += search.best == 0.0
            told.append(f"{manner.name} {'yes' if search.best == 0.0 else 'no'} ({search.tried} driven)")
        kept = "met" if case["best_tight"] else "missed"
        print(f"row {case['row']}, {case['ego']}, {kept} in take {case['take']}: {'; '.join(told)}", flush=True)
    print(f"of {len(cases)}: {', '.join(f'{count} {name}' for name, count in found.items())}")


if __name__ == "__main__":
    main(*sys.argv[1:])
