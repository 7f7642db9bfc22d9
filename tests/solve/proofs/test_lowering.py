"""Constraints over states of moments: every form says of numbers what the evaluator says of motions."""

from __future__ import annotations

from fractions import Fraction

import pytest
from planted import T, limits_of, lowered, plant
from test_relaxation import values_of

from posed import violation
from scenewright.algebra.polynomials import atoms
from scenewright.motion.profile import Profile, chain
from scenewright.program.evaluate import violation as violation_of_motion
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.events import EgoBounds, Events, Narrowing
from scenewright.solve.proofs.lowering import Lowering

FORMS = [
    "A1x(t1) == 90", "A1v(t1) <= 6", "A1v(A0(t2)) >= 4", "A1x(2.0) <= 100", "A1(t2) - A1(t1) >= 2 s", "A1(t1) < A0(t2)",
    "A1v(t1) - A0v(t1) <= 1", "A1v(t1) * 2 s >= 9 m", "A1v(t1) / A1v(t0) <= 1 / 2", "5 <= A1v(t1) <= 7",
    "tta(A1, route_end, t1) <= 60", "gap(A0, A1, t1) >= 5", "freespace(A0, A1, t1) >= 1", "headway(A0, A1, t1) >= 1",
    "ttc(A0, A1, t1) >= 3", "ttc(A1, A0, t1) <= 9", "A1x(t1) - A0x(t1) >= 3", "A1x(t1) == A0x(t1) + 20",
    "not (A1v(t1) >= 6)", "A1v(t1) >= 6 or A0v(t1) >= 6", "A1v(t1) >= 6 implies A0v(t1) >= 6",
    "not (A1v(t1) >= 6 and A0v(t1) >= 6)", "not (A1v(t1) == 6)",
    # what is divided by may be nothing or less: a time to collision that never comes is infinite
    "ttc(A1, A0, A0(t1)) >= 6", "6 >= ttc(A1, A0, A0(t1))", "not ttc(A1, A0, A0(t1)) <= 6",
    "A0x(t1) / (A0v(t1) - 6) <= 6", "A0x(t1) / (A0v(t1) - 6) >= -6", "A0v(t1) / A1v(t1) <= 3 / 2",
    "-A1v(t2) + 6 >= A0v(t1)", "A1x(A0(t1)) <= just before conflict_point", "A1(t2) * 2 >= A0(t1) + 1 / 10",
]  # fmt: skip


def with_constraint(seed: int, constraint: str) -> str:
    text = plant(seed).text
    head = text[: text.index("Constraints:")]
    routes = head.split("- ")
    assert routes
    lane = head.replace("- E, N\n", "- W\n").replace("- S, E\n", "- W\n").replace("- S, W\n", "- W\n")
    return f"{lane}Constraints:\nA0(t1) == A1(t1)\nprobe: {constraint}\n"


@pytest.mark.parametrize("constraint", FORMS)
def test_a_formula_holds_of_numbers_where_it_holds_of_the_motions(constraint: str) -> None:
    told = set()
    for seed in range(0, 60, 5):
        planted = plant(seed)
        scene = ground(parse_program(with_constraint(seed, constraint)), T)
        events = Events(scene, limits_of(scene), EgoBounds(20.0, 2.0, 6.0))
        lowering = Lowering(events)
        formula = lowering.lower(scene.program.constraints)[1].formula
        point = values_of(planted, events, lowering)
        profiles = {
            actor: Profile(
                chain(
                    0.0, float(motion.place), float(motion.speed), [(float(d), float(a), 0) for d, a in motion.moves]
                ),
                {knot: float(t) for (owner, knot), t in planted.knots.items() if owner == actor},
            )
            for actor, motion in planted.motions.items()
        }
        world = PlanWorld(scene, profiles, {})
        amiss = violation_of_motion(scene.program.constraints[1].formula, world)
        if abs(amiss) < 1e-6:
            continue
        told.add(amiss <= 0)
        assert (violation(formula, point) < 1e-9) == (amiss <= 0), (seed, amiss)
    assert told, "it was looked at nowhere"


def test_bounds_that_last_narrow_the_law() -> None:
    text = (
        "Actor 0 (ego):\n- W\n- [t0, go, t1]\n\nActor 1 (hero):\n- W\n- [t0, go, t1, dec, t2]\n\nConstraints:\n"
        "always[A1(t0), A1(t1)] (A1v <= 7)\nnever[1, 2] (A1v < 2 or A1a > 1)\nA1v(dec) <= 5\nA1a(dec) == -3\n"
        "always[A1(t0), A1(t1)] (A1x >= 100 implies A1v <= 4)\nA1v(t1) == 3 or always[1, 2] (A1v <= 1)\n"
    )
    _, lowering = lowered(ground(parse_program(text), T))
    found = lowering.narrowings
    assert [float(each.law.speed_high) for each in found if each.law.speed_high < 100] == [7.0, 5.0, 4.0]
    assert [float(each.law.speed_low) for each in found if each.law.speed_low > -100] == [2.0]
    rates = [each for each in found if each.law.rate_high < 100]
    assert [round(float(each.law.rate_high), 2) for each in rates] == [1.0, -3.0]
    assert rates[1].proven is None, "of a piece only its mean rate is proven"
    place = next(each for each in found if each.place is not None)
    assert isinstance(place, Narrowing)
    assert place.place in place.begins()
    assert not any(each.law.speed_high == 1 for each in found), "an alternative binds nobody"


def test_a_product_of_three_unknowns_is_named() -> None:
    text = (
        "Actor 0 (ego):\n- W\n- [t0, go, t1]\n\nActor 1 (hero):\n- W\n- [t0, go, t1]\n\nConstraints:\n"
        "cubic: A1v(t1) * A1v(t0) * A0v(t1) >= A0v(t0) * A1v(t1) * A1v(t1)\nA1v(t1) == 3\n"
    )
    scene = ground(parse_program(text), T)
    events = Events(scene, limits_of(scene), EgoBounds())
    cubic, plain = Lowering(events).lower(scene.program.constraints)
    assert cubic.origin == "cubic"
    assert "two unknowns" in cubic.refused
    assert not plain.refused


@pytest.mark.parametrize(
    ("constraint", "unit"),
    [("A1v(t1) == 6", 0.25), ("A1x(t1) == 90", 0.5), ("A1(t1) == 3", 0.1), ("gap(A0, A1, t1) == 5", 0.5)],
)
def test_slack_lets_an_equality_off_by_tight_tolerances(constraint: str, unit: float) -> None:
    scene = ground(parse_program(with_constraint(0, constraint)), T)
    for slack in (0, 1, 3):
        events = Events(scene, limits_of(scene), EgoBounds())
        formula = Lowering(events, Fraction(slack)).lower(scene.program.constraints)[1].formula
        exact = Lowering(events).lower(scene.program.constraints)[1].formula
        (equality,) = [each for each in atoms(exact) if each.relation == "=="]
        number = next(key[0] for key in equality.left.terms if key)
        factor = float(equality.left.terms[number,])
        point = [0.0] * len(events.unknowns)
        point[number] = -equality.left.value(point) / factor
        assert violation(formula, point) == pytest.approx(0.0, abs=1e-9)
        for off in (0.98 * slack, 1.02 * slack + 0.02):
            other = list(point)
            other[number] += off * unit
            assert (violation(formula, other) < 1e-9) == (off <= slack)
