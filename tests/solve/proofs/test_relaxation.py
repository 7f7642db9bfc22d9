"""What refutations rest on: every formula is true of motions that are legal, whatever they are."""

from __future__ import annotations

import re
from fractions import Fraction

import numpy as np
import pytest
from planted import Motion, Planted, lowered, plant
from scipy.optimize import linprog

from posed import violation
from scenewright.algebra.polynomials import origins_of, resting_on
from scenewright.motion.limits import limits_on
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.solve.proofs.bends import bound_in_bend
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.refuters import SOLVERS, clashing
from scenewright.solve.proofs.relaxation import EVEN_RATE, relaxation

HEAD = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]

Constraints:
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 25
A1v(t2) == 0
"""


def values_of(planted: Planted, events: Events, lowering: Lowering) -> list[float]:
    """Return what each unknown is in the planted motions."""
    point = [0.0] * len(events.unknowns)
    times: dict[int, Fraction] = {}
    for number, time in enumerate(events.times):
        if time.constant is not None:
            times[number] = time.constant
    for key, instant in {key: events.knot(*key) for key in planted.knots}.items():
        times[instant] = planted.knots[key]
    for number, time in enumerate(events.times):
        if number in times and time.constant is None:
            point[next(iter(time.terms))[0]] = float(times[number])
    for number, defined in events.defined.items():
        times[number] = max(Fraction(0), Fraction(defined.value(point)).limit_denominator(10**9))
        point[next(iter(events.times[number].terms))[0]] = float(times[number])
    for (actor, place), made in events.places.items():
        times[made] = Fraction(passing_s(planted.motions[actor], float(place), float(max(times.values()))))
        point[next(iter(events.times[made].terms))[0]] = float(times[made])
    for (actor, instant), state in events.states.items():
        place, speed, _ = planted.motions[actor].state(times[instant])
        point[next(iter(state.place.terms))[0]] = float(place)
        point[next(iter(state.speed.terms))[0]] = float(speed)
    for (actor, first, last), rate in lowering.means.items():
        change = planted.motions[actor].state(times[last])[1] - planted.motions[actor].state(times[first])[1]
        point[next(iter(rate.terms))[0]] = float(change / (times[last] - times[first]))
    return point


def passing_s(motion: Motion, place_m: float, end_s: float) -> float:
    """Return when a place is passed; the end where it never is."""
    low, high = 0.0, end_s
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if motion.state(Fraction(middle))[0] >= place_m else (middle, high)
    return high


def check_planted(planted: Planted) -> int:
    """Check that all formulas are true of the motions; return how many bounds there are on speeds in bends."""
    events, lowering = lowered(planted.scene())
    constraints = events.scene.program.constraints
    bound_in_bend(events, 1, [each.formula for each in lowering.lower(constraints)])
    formulas = relaxation(events, lowering.narrowings, lowering.lower(constraints))
    point = values_of(planted, events, lowering)
    for unknown, value in zip(events.unknowns, point, strict=True):
        assert float(unknown.low) - 1e-6 <= value <= float(unknown.high) + 1e-6, unknown
    for each in formulas:
        assert violation(each.formula, point) < 1e-5, (each.origin, planted.text)
    return sum("sideways" in origin for each in formulas for origin in each.origins)


@pytest.mark.parametrize("seed", range(42))  # six of each sketch
def test_planted_motions_satisfy_every_formula(seed: int) -> None:
    check_planted(plant(seed))


def test_motions_through_bends_satisfy_every_formula() -> None:
    """They begin just before the junction, and are pressed sideways as much as they just may."""
    assert sum(check_planted(plant(seed, (276, 306))) > 0 for seed in range(42)) > 14


def test_what_is_false_of_the_motions_is_among_the_formulas_too() -> None:
    """The property above could not fail if the formulas said nothing."""
    planted = plant(0)
    scene = planted.scene()
    events, lowering = lowered(scene)
    formulas = relaxation(events, lowering.narrowings, lowering.lower(scene.program.constraints))
    point = values_of(planted, events, lowering)
    spoilt = 0
    for number, unknown in enumerate(events.unknowns):
        if unknown.kind in ("place", "speed", "time"):
            moved = [*point[:number], point[number] + 40.0, *point[number + 1 :]]
            spoilt += any(violation(each.formula, moved) > 1e-3 for each in formulas)
    assert spoilt == sum(unknown.kind in ("place", "speed", "time") for unknown in events.unknowns)


def test_contradictory_orders_of_moments_are_refuted_and_not_believed() -> None:
    """90 m in half a second: what follows for the order of moments contradicts itself, and must not hide the laws."""
    planted = plant(1)
    head = planted.text[: planted.text.index("Constraints:")]
    text = re.sub(r"\(\d+ / \d+\)", "1", head) + "Constraints:\nA0x(t0) == 50\nA0x(t1) == 140\nA0(t1) == 0.5 s\n"
    scene = Planted(text, planted.motions, planted.knots).scene()
    events, lowering = lowered(scene)
    formulas = relaxation(events, lowering.narrowings, lowering.lower(scene.program.constraints))
    assert SOLVERS.called("z3").ask(events.unknowns, formulas, 5.0).kind == "refuted"


def test_a_law_that_a_constraint_makes_narrower_rests_on_both() -> None:
    """`always` of a speed is no formula of its own: without its id in the core the proof would not name it."""
    head = HEAD.replace("A1v(t2) == 0", "A1v(t2) == 4")
    scene = Planted(f"{head}c: always[A1(t1), A1(t2)] (A1v <= 5)\n", {}, {}).scene()
    events, lowering = lowered(scene)
    formulas = relaxation(events, lowering.narrowings, lowering.lower(scene.program.constraints))
    narrower = [each for each in formulas if "c" in each.besides]
    assert narrower
    origin = narrower[0].origin
    assert narrower[0].origins == (origin, "c")
    assert resting_on(narrower[:1], {origin}) == []
    assert resting_on(narrower[:1], {"c"}) == []
    assert resting_on(narrower[:1], {origin, "c"}) == narrower[:1]


@pytest.mark.parametrize(
    "constraint", ["always[A1(t1), A1(t2)] (A1v >= 9)", "A1v(dec) >= 9", "A1v(dec) >= 9 and A1v(t1) <= 12"]
)
def test_what_clashes_names_what_makes_a_law_narrower(constraint: str) -> None:
    scene = Planted(f"{HEAD}probe: {constraint}\n", {}, {}).scene()
    events, lowering = lowered(scene)
    formulas = relaxation(events, lowering.narrowings, lowering.lower(scene.program.constraints))
    z3 = SOLVERS.called("z3")
    found = clashing(z3, origins_of(formulas), lambda names: (events.unknowns, resting_on(formulas, names)))
    assert "probe" in found
    assert z3.ask(events.unknowns, resting_on(formulas, found), 5.0).kind == "refuted", "it clashes by itself"


def furthest_m(lasts_s: float, ramp_s: float, law: tuple[float, float], rate_mpss: float, side: int) -> float:
    """Return how much further (1), or less far (-1), than evenly one comes at most in a piece of one rate, as judged.

    A linear program: the mean is that number, and where three ramps fit in, so is each part as long as one, to 0.25.
    """
    part = 12
    cells = round(lasts_s / ramp_s * part)
    step_s, rows = lasts_s / cells, list[np.ndarray]()
    for first in range(part, cells - 2 * part + 1):
        row = np.zeros(cells)
        row[first : first + part] = 1.0 / part
        rows += [row, -row]
    bounds = [rate_mpss + 0.25, 0.25 - rate_mpss] * (len(rows) // 2)
    way = np.arange(cells - 0.5, -0.5, -1.0) * step_s**2
    found = linprog(
        -side * way, np.array(rows) if rows else None, bounds or None,
        np.full((1, cells), 1.0 / cells), [rate_mpss], [law] * cells,
    )  # fmt: skip
    return float(way @ found.x - 0.5 * rate_mpss * lasts_s**2)


@pytest.mark.parametrize("ramp_s", ["0.3", "2"])
@pytest.mark.parametrize("rate_mpss", [-0.5, -2.0, -6.0])
@pytest.mark.parametrize("ramps", [1.5, 2.9, 3.0, 6.0, 12.0])
def test_nobody_comes_further_at_one_rate_than_a_proof_takes_for_granted(
    ramp_s: str, rate_mpss: float, ramps: float
) -> None:
    text = f"manner:\n- ramp_s = {ramp_s}\n\n{HEAD}A1a(dec) == {rate_mpss}\n"
    scene = ground(parse_program(text), load_map("t_intersection"))
    events = Events(
        scene, {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}, EgoBounds()
    )
    lowering = Lowering(events)
    all_lowered = lowering.lower(scene.program.constraints)  # makes the narrowings
    rules = relaxation(events, lowering.narrowings, all_lowered)
    (even,) = (each for each in rules if each.origin == EVEN_RATE)
    lasts_s, first, last = ramps * float(ramp_s), events.knot(1, "t1"), events.knot(1, "t2")
    begins, ends = events.state(1, first), events.state(1, last)
    for side in (1, -1):
        more_m = furthest_m(lasts_s, float(ramp_s), (-8.0, 0.0), rate_mpss, side)
        point = [0.0] * len(events.unknowns)
        for value, number in (
            (begins.speed, -rate_mpss * lasts_s),
            (ends.place, -0.5 * rate_mpss * lasts_s**2 + more_m),
            (events.times[last], lasts_s),
        ):
            point[value.number] = number
        assert violation(even.formula, point) <= 1e-6
        point[ends.place.number] += side * 10.0 * (3.0 + lasts_s**2)
        assert violation(even.formula, point) > 0.0
