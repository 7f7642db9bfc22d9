"""Drives the benchmark's programs with numbers that are read off drives against the very ego: all of them can happen.

python tools/possible_runs.py 2 5                        seeds 2 to 4, all egos that answer a hero, one take
python tools/possible_runs.py 2 5 idm,noisy 3            these egos, three takes

A hero comes evenly, at a speed and a moment that are drawn, and then brakes or speeds up as the row has it, while the
ego drives as it does. Where the ego is then within the row's range of its side of the trigger (and the hero is first,
if it is to be), that is the row's case; its other numbers are the benchmark's. What fails is told with why.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Mapping

from scenewright.judge.tolerance import TIGHT
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import begin, orchestrate
from scenewright.program.types import EGO
from scenewright.request import Request, Stages
from scenewright.roads.grounding import Scene
from scenewright.simulate.beginning import first_states
from scenewright.simulate.builtin import BuiltIn
from scenewright.simulate.ego_start import EgoFirstState
from scenewright.simulate.port import Start
from scenewright.simulate.world import World
from scenewright.study.benchmark.draws import draw_row, range_of
from scenewright.study.benchmark.rows import BenchmarkRow, benchmark_rows

EGOS, HERO, STEP_S = "idm,dawdler,staller,stop-and-go,noisy", 1, 0.02
_DRAWS, _HEROES = 60, 12
Named = tuple[str, float]


def sides_of(row: BenchmarkRow, drawn: Mapping[str, float]) -> tuple[Named, Named] | None:
    """Return the parameters of both sides of a trigger by time, where a row has one of each and no more to do."""
    own = [(name, value) for name, value in drawn.items() if name.startswith("ego_tta")]
    theirs = [(name, value) for name, value in drawn.items() if name.startswith("hero_tta")]
    return (own[0], theirs[0]) if own and theirs and row.interaction != "Hero yields then goes" else None


def place_m(scene: Scene, name: str, actor: int) -> float:
    """Return the landmark that a parameter counts from, on an actor's route."""
    landmark = name.split("_behind_")[1].rsplit("_", 1)[0]
    return scene.landmark_m(actor, landmark, 1 - actor)


def hero_motion(
    scene: Scene, drawn: Mapping[str, float], side: Named, chance: random.Random
) -> tuple[Profile, float, float | None] | None:
    """Return a hero that comes evenly to its side and acts there, when it does, and when it is to be past all."""
    speed_mps, acts_s = chance.uniform(4.0, 13.5), chance.uniform(2.0, 10.0)
    there_m = place_m(scene, side[0], HERO) - side[1] * speed_mps
    begins_m, conflict_m = there_m - speed_mps * acts_s, scene.landmark_m(HERO, "conflict_point", EGO)
    ends = next((value for name, value in drawn.items() if name.startswith("end_hero")), None)
    if begins_m < 1.0:
        return None
    if ends is None:
        motion = Profile(chain(0.0, begins_m, speed_mps, [(acts_s, 0.0, 0), (8.0, 1.5 if speed_mps < 9.0 else 0.9, 0)]))
        return motion, acts_s, motion.time_at(conflict_m)
    rate = 0.5 * speed_mps**2 / max(conflict_m - ends - there_m, 1e-3)
    if not 0.7 < rate < 5.0:
        return None
    moves = [(acts_s, 0.0, 0), (speed_mps / rate, -rate, 0), (3.0, 0.0, 0)]
    return Profile(chain(0.0, begins_m, speed_mps, moves)), acts_s, None


def seen(
    world: World, start: EgoFirstState, drawn: Mapping[str, float], sides: tuple[Named, Named], chance: random.Random
) -> float | None:
    """Return how long (s) the ego is from its place when a hero acts; None where that is no case of the row."""
    scene, found = world.scene, hero_motion(world.scene, drawn, sides[1], chance)
    if found is None:
        return None
    motion, acts_s, passes_s = found
    place = place_m(scene, sides[0][0], EGO)
    before_m = min(place, scene.landmarks_m[EGO].get("turn_start", place))
    simulator = BuiltIn()
    simulator.reset(Start.of(scene, world.ego, (start.s_m, start.speed_mps), {HERO: motion}), STEP_S)
    away_s = None
    for _ in range(round((passes_s if passes_s is not None else acts_s) / STEP_S) + 1):
        simulator.apply({HERO: motion})
        now = simulator.observe()
        ego = now.actors[EGO]
        if away_s is None and now.time_s >= acts_s - 1e-6:
            away_s = (place - ego.s_m) / ego.speed_mps if ego.speed_mps > 1.0 else -1.0
        simulator.step()
    return away_s if passes_s is None or ego.s_m < before_m else None


def case_of(row: BenchmarkRow, ego: str, seed: int) -> dict[str, float] | None:
    """Return parameters of a row that can happen with an ego; None where no hero that was tried leads to such."""
    chance = random.Random(1000 * seed + row.id)
    for draw in range(_DRAWS):
        drawn = dict(draw_row(row, draw, seed))
        sides = sides_of(row, drawn)
        if sides is None:
            return None
        request = Request(row.program_text, parameters=drawn, ego=ego, seed=seed, explain="nothing")
        world, _, answer = begin(request, Stages(None))
        limits = range_of(row, sides[0][0])
        start = None if answer == "infeasible" else next(first_states(world), None)
        for _ in range(0 if start is None or start.last_resort else _HEROES):
            away_s = seen(world, start, drawn, sides, chance)
            if away_s is not None and limits.low <= away_s <= limits.high:
                return drawn | {sides[0][0]: round(away_s, 3)}
    return None


def main(first: str, end: str, egos: str = EGOS, takes: str = "1") -> None:
    """Find cases, drive them and count."""
    counts: Counter[str] = Counter()
    for seed in range(int(first), int(end)):
        for row in benchmark_rows():
            for ego in egos.split(",") if sides_of(row, draw_row(row, 0, seed)) else ():
                parameters = case_of(row, ego, seed)
                if parameters is None:
                    counts["no such case found"] += 1
                    continue
                asked = Request(row.program_text, parameters=parameters, ego=ego, seed=seed, takes=int(takes))
                result = orchestrate(asked)
                counts[result.status] += 1
                if result.status != "success" and result.verdict is not None:
                    missed = [each.id for each in result.verdict.conditions if not each.holds_at(TIGHT)]
                    why = result.verdict.cause.text if result.verdict.cause is not None else ""
                    print(f"row {row.id}, {ego}, seed {seed}: {', '.join(missed)}: {why}", flush=True)
    print(", ".join(f"{status}: {count}" for status, count in counts.items()))


if __name__ == "__main__":
    main(*sys.argv[1:])
