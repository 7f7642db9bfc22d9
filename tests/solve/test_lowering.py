"""Lowering against the evaluator: two readings of a formula that share no code must agree."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import Phase, assume, example, given, settings
from hypothesis import strategies as st
from motions import motion, tenths, wandering

import scenarios
import smtlib
from scenarios import read_structure
from scenewright.motion.algebra import Symbol, Value, compare, pin, smt
from scenewright.motion.profile import Profile, chain
from scenewright.motion.sketched import SketchedMotion
from scenewright.program.check import check_program
from scenewright.program.evaluate import violation
from scenewright.program.expressions import Compare
from scenewright.program.text import parse_program
from scenewright.roads import load_map
from scenewright.roads.grounding import Scene, ground
from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.solve.lowering import TIGHT, Lowering, NotYet, compared_dimension
from scenewright.solve.plan import PlanWorld
from scenewright.solve.problem import Problem, Satisfiable
from scenewright.solve.views import KnownView, SketchedView

T = load_map("t_intersection")
KNOTS = ("t0", "t1", "t2")
SYNC = "A0(t1) == A1(t1)"
# Everything that can be said of two motions with knots t0, t1, t2; {n} is a number.
FORMS = [
    "A0x(t1) == stop_line - {n}",
    "A1x(t1) <= conflict_point - {n}",
    "A1x(t2) >= A0.conflict_point - {n}",
    "A1x(A0(t1)) == just before conflict_point - {n}",
    "A0v(t0) == {n}",
    "A1v(A0(t1)) >= {n} / 4",
    "A1a(dec) == -{n} / 10",
    "A1a(dec) <= -{n} / 20",
    "A1v(go) <= {n}",
    "A1a(t1) >= -{n} / 5",
    "A1(t2) - A1(t1) <= {n} / 3",
    "A0(t2) > A1(t2)",
    "A1(t2) * 2 >= A0(t1) + {n} / 10",
    "tta(A0, stop_line, t1) == {n} / 5",
    "tta(A1, conflict_point, A0(t1)) <= {n} / 3",
    "gap(A0, A1, t1) == {n}",
    "gap(A1, A0, A0(t1)) <= {n}",
    "headway(A0, A1, t1) >= {n} / 10",
    "ttc(A0, A1, t1) <= {n} and A0v(t1) > A1v(t1)",
    "A1x(t1) - A0x(t1) >= {n}",
    "A0v(t1) / A1v(t1) <= {n} / 4",
    "A0x(t1) / A0v(t1) >= {n} / 10",
    "A0v(t1) * A1v(t1) >= {n}",
    "-A1v(t2) + {n} >= A0v(t1)",
    "A0v(t1) > {n} and A1v(t1) > {n}",
    "A0v(t1) > {n} or not A1v(t1) > {n}",
    "A0v(t1) > {n} implies A1v(t1) <= {n}",
    "always[A1(t0), A1(t2)](A1v <= {n})",
    "never[A1(t0), A1(t1)](A1v > {n})",
    "eventually[A1(t0), A1(t2)](A1v <= {n} / 3)",
]


def scene_with(line: str) -> Scene:
    text = scenarios.example("W", "t0, go, t1, dec, t2", f"{SYNC}\ntested: {line}")
    program = parse_program(text)
    check_program(program, text)
    return ground(program, T)


def sketched(speed: Fraction, steps: list[tuple[Fraction, Fraction]], start_m: Fraction) -> SketchedMotion:
    exact = motion(speed, steps).shifted(start_m)
    lasting = tuple(b - a for a, b in zip(exact.times, exact.times[1:], strict=False))
    return SketchedMotion(Fraction(0), exact.positions, exact.speeds, lasting, exact.accelerations)


def view(sketch: SketchedMotion) -> SketchedView:
    return SketchedView(sketch, {knot: k for k, knot in enumerate(KNOTS)}, {0: (0, 0), 1: (1, 1)})


def as_profile(sketch: SketchedMotion) -> Profile:
    moves = [
        (float(d), float((v1 - v0) / d), k)
        for k, (d, v0, v1) in enumerate(zip(sketch.durations, sketch.speeds, sketch.speeds[1:], strict=False))
    ]
    segments = chain(0.0, float(sketch.positions[0]), float(sketch.speeds[0]), moves)
    return Profile(segments, {knot: float(sketch.time_at_knot(k)) for k, knot in enumerate(KNOTS)})


@st.composite
def two_motions(draw: st.DrawFn) -> tuple[SketchedMotion, SketchedMotion]:
    """An ego and a hero ahead of it that have their knot t1 in common; the hero brakes after it."""
    meeting, after = draw(tenths(1, 8)), draw(tenths(1, 6))
    ego_speeds, hero_speed = [draw(tenths(1, 15)) for _ in range(3)], draw(tenths(1, 15))
    ego = sketched(
        ego_speeds[0], [(meeting, ego_speeds[1]), (draw(tenths(1, 6)), ego_speeds[2])], draw(tenths(150, 250))
    )
    last = hero_speed * draw(st.integers(0, 9)) / 10
    hero = sketched(hero_speed, [(meeting, hero_speed), (after, last)], draw(tenths(200, 280)))
    return ego, hero


@pytest.mark.parametrize("form", FORMS)
@settings(max_examples=15)
@given(pair=two_motions(), number=tenths(0.5, 40))
def test_known_motions_are_judged_alike(
    form: str, pair: tuple[SketchedMotion, SketchedMotion], number: Fraction
) -> None:
    scene = scene_with(form.replace("{n}", str(float(number))))
    formula = scene.program.constraint("tested").formula
    structure = read_structure(scene.program)
    ego, hero = pair
    lowered = Lowering(scene, structure, {0: view(ego), 1: view(hero)}, {}).condition(formula)
    world = PlanWorld(scene, {0: as_profile(ego), 1: as_profile(hero)}, {})
    off = violation(formula, world)
    assume(abs(off) > 1e-3)  # landmarks are pinned to a tenth of a millimetre: right at the edge both may be right
    if off == float("inf") or (isinstance(formula, Compare) and formula.operator == "=="):
        assert lowered is False or off <= 1e-3
        return
    assert lowered is (off <= 0)


# Forms whose denominator may be nothing or less: the evaluator takes a time to collision that never comes as infinite,
# and divides by what is negative as it is.
SIGNED = [
    "ttc(A1, A0, A0(t1)) <= {n}",
    "ttc(A1, A0, A0(t1)) >= {n}",
    "{n} <= ttc(A1, A0, A0(t1))",
    "{n} >= ttc(A1, A0, A0(t1))",
    "not ttc(A1, A0, A0(t1)) <= {n}",
    "A0x(t1) / (A0v(t1) - 10) <= {n}",
    "A0x(t1) / (A0v(t1) - 10) >= -{n}",
]


@pytest.mark.parametrize("form", SIGNED)
@example(
    pair=(
        sketched(Fraction(1), [(Fraction(1), Fraction(11, 10)), (Fraction(1), Fraction(1))], Fraction(150)),
        sketched(Fraction(1), [(Fraction(1), Fraction(1)), (Fraction(1), Fraction(0))], Fraction(200)),
    ),
    number=Fraction(1, 2),
)
@settings(max_examples=60, phases=[Phase.explicit, Phase.generate])
@given(pair=two_motions(), number=tenths(0.5, 40))
def test_denominators_of_either_sign_are_judged_alike(
    form: str, pair: tuple[SketchedMotion, SketchedMotion], number: Fraction
) -> None:
    scene = scene_with(form.replace("{n}", str(float(number))))
    formula = scene.program.constraint("tested").formula
    ego, hero = pair
    assume(ego.speeds[1] not in (10, hero.speeds[1]))
    lowered = Lowering(scene, read_structure(scene.program), {0: view(ego), 1: view(hero)}, {}).condition(formula)
    off = violation(formula, PlanWorld(scene, {0: as_profile(ego), 1: as_profile(hero)}, {}))
    assume(abs(off) > 1e-3)
    assert lowered is (off <= 0)


@pytest.mark.parametrize("form", FORMS)
def test_every_model_of_the_solver_passes_the_evaluator(form: str) -> None:
    scene = scene_with(form.replace("{n}", "6"))
    structure = read_structure(scene.program)
    problem = Problem()
    sketches = {actor: _unknown(problem, actor) for actor in (0, 1)}
    lowering = Lowering(scene, structure, {actor: view(sketch) for actor, sketch in sketches.items()}, {})
    for constraint in scene.program.constraints:
        problem.require(lowering.condition(constraint.formula), constraint.id)
    result = Z3Backend().solve(problem, 20.0)
    assert isinstance(result, Satisfiable), "every form can be met"
    profiles = {actor: as_profile(_known(sketch, result.model)) for actor, sketch in sketches.items()}
    world = PlanWorld(scene, profiles, {})
    for constraint in scene.program.constraints:
        # Landmarks are pinned to a tenth of a millimetre (twice that for two); speeds over 1 m/s make it less in time.
        assert violation(constraint.formula, world) <= 3e-4


def _unknown(problem: Problem, actor: int) -> SketchedMotion:
    positions = tuple(problem.unknown(f"x{actor}{k}") for k in range(3))
    speeds = tuple(problem.unknown(f"v{actor}{k}") for k in range(3))
    durations = tuple(problem.unknown(f"d{actor}{k}") for k in range(2))
    for k, duration in enumerate(durations):
        problem.bound(duration, Fraction(1, 2), 20, "durations")
        problem.require(
            compare("==", 2 * (positions[k + 1] - positions[k]), (speeds[k] + speeds[k + 1]) * duration), "laws"
        )
    for position, speed in zip(positions, speeds, strict=True):
        problem.bound(position, 0, 600, "route")
        problem.bound(speed, Fraction(1, 10), 20, "speed")
    problem.require(compare("<", speeds[2], speeds[1]), "brakes")
    return SketchedMotion(Fraction(0), positions, speeds, durations, (None, None))


def _known(sketch: SketchedMotion, model: dict[str, Fraction]) -> SketchedMotion:
    def read(values: tuple[Value, ...]) -> tuple[Value, ...]:
        return tuple(model[value.text] for value in values if isinstance(value, Symbol))

    return SketchedMotion(
        Fraction(0), read(sketch.positions), read(sketch.speeds), read(sketch.durations), (None, None)
    )


@settings(max_examples=40)
@given(number=tenths(1, 30), units=st.fractions(0, 8, max_denominator=10), off=st.fractions(-3, 3, max_denominator=20))
def test_tolerance_widens_equalities_by_tight_units(number: Fraction, units: Fraction, off: Fraction) -> None:
    scene = scene_with(f"A0v(t0) == {float(number)}")
    formula = scene.program.constraint("tested").formula
    ego = sketched(number + off, [(Fraction(1), Fraction(5)), (Fraction(1), Fraction(5))], Fraction(0))
    lowering = Lowering(scene, read_structure(scene.program), {0: view(ego), 1: view(ego)}, {})
    assert lowering.condition(formula, units) is (abs(off) <= units * TIGHT["speed"])


@pytest.mark.parametrize(
    ("line", "dimension"),
    [
        ("A0x(t1) == 5", "length"),
        ("A0v(t1) == 5", "speed"),
        ("A0a(t1) == 5", "acceleration"),
        ("tta(A0, stop_line, t1) == 5", "time"),
        ("gap(A0, A1, t1) == 5", "length"),
        ("A0(t1) == 5", "time"),
    ],
)
def test_tolerances_are_told_from_what_is_compared(line: str, dimension: str) -> None:
    assert compared_dimension(scene_with(line).program.constraint("tested").formula) == dimension


def test_a_moment_out_of_sight_is_not_yet() -> None:
    scene = scene_with("A0x(t2) == stop_line")
    known = KnownView(Profile(chain(0.0, 0.0, 5.0, [(1.0, 0.0, 0)])), {"t0": 0.0})
    lowering = Lowering(scene, read_structure(scene.program), {0: known, 1: known}, {})
    with pytest.raises(NotYet):
        lowering.condition(scene.program.constraint("tested").formula)


@given(wander=wandering(15, 3, 5), part=st.integers(0, 10))
def test_known_views_give_pinned_values(wander: tuple[Fraction, list[tuple[Fraction, Fraction]]], part: int) -> None:
    exact = motion(*wander)
    knots = {f"t{k}": k for k in range(len(exact.times))}
    profile = exact.profile(knots)
    known = KnownView(profile, profile.knot_times_s)
    time = exact.times[-1] * part / 10
    position = known.at_time(time, 0)
    assert isinstance(position, Fraction)
    assert abs(position - Fraction(profile.state(float(time))[0])) <= Fraction(1, 10**4)
    assert known.time("t0") == 0
    assert known.time("nowhere") is None
    assert known.at_knot("nowhere", 0) is None
    assert known.at_time(Symbol("later"), 0) is None
    assert known.at_knot("t1", 1) == (pin(profile.state(profile.knot_times_s["t1"])[1]), 1)


def test_symbols_in_conditions_evaluate_as_numbers_do() -> None:
    """The same lowering with an unknown parameter, its text evaluated apart from any solver."""
    scene = scene_with("A0x(t1) == stop_line - near_m")
    formula = scene.program.constraint("tested").formula
    ego = sketched(Fraction(5), [(Fraction(2), Fraction(5)), (Fraction(1), Fraction(5))], Fraction(280))
    lowering = Lowering(scene, read_structure(scene.program), {0: view(ego), 1: view(ego)}, {"near_m": Symbol("p")})
    condition = lowering.condition(formula)
    assert isinstance(condition, str)
    assert smtlib.value(condition, {"p": Fraction(10)}) is True
    assert smtlib.value(condition, {"p": Fraction(11)}) is False
    assert smt(Symbol("p")) == "p"
