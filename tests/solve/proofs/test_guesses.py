"""First guesses: what constraints fix is taken over, knots are in order, drawn guesses differ."""

from __future__ import annotations

import numpy as np
import pytest
from planted import T, limits_of

from scenewright.algebra.polynomials import atoms
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.guesses import first_guess
from scenewright.solve.proofs.lowering import Lowering

TEXT = (
    "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- W\n- [t0, go, t1, dec, t2]\n\nConstraints:\n"
    "A0(t1) == A1(t1)\nA0x(t1) == 100\nA1x(t1) == 130\nA1x(t2) == 140\nA1v(t2) == 0\n"
    "eventually[A1(t0), A1(t2)] (A1v <= 3)\n"
)


def test_what_is_told_is_guessed_as_told() -> None:
    scene = ground(parse_program(TEXT), T)
    events = Events(scene, limits_of(scene), EgoBounds())
    formulas = [each.formula for each in Lowering(events).lower(scene.program.constraints)]
    point = first_guess(events, formulas, None)
    for actor, knot, place in ((0, "t1", 100.0), (1, "t1", 130.0), (1, "t2", 140.0)):
        assert events.state(actor, events.knot(actor, knot)).place.value(point) == place
    times = [events.times[events.knot(1, knot)].value(point) for knot in ("t0", "t1", "t2")]
    assert times == sorted(times)
    assert times[0] == 0.0
    drawn = [first_guess(events, formulas, np.random.default_rng(seed)) for seed in (1, 1, 2)]
    assert np.array_equal(drawn[0], drawn[1])
    assert not np.array_equal(drawn[0], drawn[2])


@pytest.mark.parametrize(
    "beside", ["gap(A0, A1, A1(t0)) == 30", "headway(A0, A1, A1(t0)) == 2", "A1x(t0) == A0x(t0) + 30"]
)
def test_who_is_told_no_place_is_guessed_where_it_is_told_to_be_beside_another(beside: str) -> None:
    text = TEXT.split("Constraints:", maxsplit=1)[0] + f"Constraints:\n{beside}\nA1x(t1) == 130\n"
    scene = ground(parse_program(text), T)
    events = Events(scene, limits_of(scene), EgoBounds())
    formulas = [each.formula for each in Lowering(events).lower(scene.program.constraints)]
    point = first_guess(events, formulas, None)
    for formula in formulas:
        assert all(abs(part.left.value(point)) < 1e-6 for part in atoms(formula) if part.relation == "==")
