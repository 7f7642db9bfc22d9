"""How soon somebody can be past a bend: against drives through it that were made step by step, and against a clock."""

from __future__ import annotations

import numpy as np
import pytest

from scenewright.algebra.polynomials import Atom
from scenewright.motion.limits import limits_on
from scenewright.program.text import parse_program
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.proofs.bends import bound_in_bend
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.lowering import Lowering

TEXT = """scenario "s"
map "t_intersection"

Actor 0 (ego):
- W
- [t0, go, t1]

Actor 1 (hero):
- S, {turn}
- [t0, go, t1, go, t2]

Constraints:
{asked}
"""
STEP_S = 0.01


def bounds(asked: str, turn: str) -> tuple[Scene, list[tuple[float, float, float]]]:
    """Return the scene, and each bound on the time from t1 to t2: per metre and metre a second at t1, and the rest."""
    scene = ground(parse_program(TEXT.format(asked=asked, turn=turn)), load_map("t_intersection"))
    limits = {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}
    events = Events(scene, limits, EgoBounds())
    early, late = events.knot(1, "t1"), events.knot(1, "t2")
    state, found = events.state(1, early), list[tuple[float, float, float]]()
    bound_in_bend(events, 1, [each.formula for each in Lowering(events).lower(scene.program.constraints)])
    for each in (each for each in events.rules if isinstance(each.formula, Atom)):
        terms = each.formula.left.terms
        if {events.times[early].number, events.times[late].number} <= {key[0] for key in terms if key}:
            per_m, per_mps = (float(terms.get((number.number,), 0)) for number in (state.place, state.speed))
            found.append((per_m, per_mps, float(terms.get((), 0))))
    return scene, found


def driven_s(scene: Scene, begins_m: float, speed_mps: float, to_m: float, generator: np.random.Generator) -> float:
    """Return how long a drive takes that brakes and speeds up as hard as it may, or somewhat less, step by step."""
    path, limits = scene.routes[1].path, limits_on(scene.routes[1], scene.road_map)
    along_m = np.arange(begins_m, to_m + 0.1, 0.1)
    tops = np.array([limits.lateral_max_mpss / max(abs(path.curvature(s)), 1e-6) for s in along_m])
    tops = np.minimum(tops, limits.speed_max_mps**2)
    for k in range(len(tops) - 2, -1, -1):
        tops[k] = min(tops[k], tops[k + 1] + 2 * 0.1 * limits.brake_max_mpss)
    share = generator.choice([1.0, generator.uniform(0.5, 1.0)])
    place_m, time_s, speed_mps = begins_m, 0.0, min(speed_mps, float(np.sqrt(tops[0])))
    while place_m < to_m:
        ahead_m = place_m + speed_mps * STEP_S + 0.5 * limits.accel_max_mpss * STEP_S**2
        most_mps = float(np.sqrt(np.interp(ahead_m, along_m, tops)))
        then_mps = min(speed_mps + share * limits.accel_max_mpss * STEP_S, most_mps)
        place_m, time_s, speed_mps = place_m + 0.5 * (speed_mps + then_mps) * STEP_S, time_s + STEP_S, then_mps
    return time_s


@pytest.mark.parametrize("turn", ["E", "W"])
def test_no_drive_is_sooner_and_the_fastest_is_hardly_later(turn: str) -> None:
    asked = "A1.stop_line - 40 <= A1x(t1) <= A1.stop_line\nA1x(t2) == A1.turn_end"
    scene, found = bounds(asked, turn)
    marks, generator = scene.landmarks_m[1], np.random.default_rng(0)
    late_s = list[float]()
    for _ in range(60):
        begins_m, speed_mps = marks["stop_line"] - generator.uniform(0, 40), generator.uniform(0.0, 14.0)
        took_s = driven_s(scene, begins_m, speed_mps, marks["turn_end"], generator)
        least_s = max(per_m * begins_m + per_mps * speed_mps + rest for per_m, per_mps, rest in found)
        assert took_s >= least_s - STEP_S
        late_s.append(took_s - least_s)
    assert min(late_s) < 0.1, "bounds that are far below every drive refute nothing"


def test_who_may_be_past_the_bend_before_is_not_bounded() -> None:
    assert bounds("A1x(t1) >= 5\nA1x(t2) == A1.turn_end", "W")[1] == []
