"""Newton steps: what is found meets all that was asked, exactly; alternatives, orders and narrow laws are kept."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from planted import T, limits_of, plant

from posed import violation
from scenewright.algebra.polynomials import compare
from scenewright.motion.laws import holds, reach
from scenewright.program.text import parse_program
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.guesses import first_guess
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.search import Search


def searched(text: str, *more: object) -> tuple[Events, Search, np.ndarray | None]:
    scene = ground(parse_program(text), T)
    events = Events(scene, limits_of(scene), EgoBounds(20.0, 2.0, 6.0))
    lowering = Lowering(events)
    formulas = [each.formula for each in lowering.lower(scene.program.constraints)]
    formulas += [each.formula for each in events.rules] + list(more)
    search = Search(events, formulas, lowering.narrowings)
    point = None
    for attempt in range(6):
        generator = np.random.default_rng(attempt) if attempt else None
        point = search.run(first_guess(events, formulas, generator), generator)
        if point is not None:
            break
    return events, search, point


@pytest.mark.parametrize("seed", range(0, 42, 2))
def test_what_is_found_meets_formulas_and_laws(seed: int) -> None:
    events, search, point = searched(plant(seed).text)
    if point is None:
        pytest.skip("not found: how many are is tested below")
    for formula in search._compiled._formulas:
        assert violation(formula, point) < 2e-3
    for actor in (0, 1):
        order, laws = search.way_of(point, actor)
        times = [events.times[k].value(point) for k in order]
        assert all(b - a > -1e-6 for a, b in pairwise(times))
        for number, (early, late) in enumerate(pairwise(order)):
            a, b = events.state(actor, early), events.state(actor, late)
            v1, v2, x = a.speed.value(point), b.speed.value(point), b.place.value(point) - a.place.value(point)
            assert holds(reach(laws[number], v1, v2, times[number + 1] - times[number], x), 2e-3)


def test_steps_are_few_and_nearly_all_that_was_planted_is_found() -> None:
    found = [searched(plant(seed).text) for seed in range(100, 140)]
    assert np.median([search.steps for _, search, _ in found]) <= 8
    assert sum(point is not None for _, _, point in found) >= 34


def test_nothing_is_found_where_nothing_is() -> None:
    text = plant(0).text + "A1v(t1) >= 30\n"
    assert searched(text)[2] is None


def test_of_alternatives_one_is_taken_whole() -> None:
    head = plant(5).text.split("Constraints:")[0]
    text = f"{head}Constraints:\nA0(t1) == A1(t1)\n(A1v(t1) == 3 and A0v(t1) == 9) or (A1v(t1) == 8 and A0v(t1) == 2)\n"
    events, _, point = searched(text)
    assert point is not None
    found = tuple(round(events.state(a, events.knot(a, "t1")).speed.value(point), 2) for a in (1, 0))
    assert found in ((3.0, 9.0), (8.0, 2.0))


def test_what_is_owed_besides_is_kept() -> None:
    scene_text = plant(3).text.split("Constraints:")[0] + "Constraints:\nA0(t1) == A1(t1)\nA1v(t1) >= 5\n"
    events, _, point = searched(scene_text)
    speed = events.state(1, events.knot(1, "t1")).speed
    events, _, point = searched(scene_text, compare("<=", speed, 6))
    assert point is not None
    assert 5 - 1e-3 <= events.state(1, events.knot(1, "t1")).speed.value(point) <= 6 + 1e-3


def test_alternatives_that_what_is_told_rules_out_are_not_taken() -> None:
    head = plant(5).text.split("Constraints:")[0]
    text = f"{head}Constraints:\nA0(t1) == A1(t1)\nA1v(t1) == 4\nA1v(t1) >= 4.2 or A0v(t1) == 11\n"
    events, _, point = searched(text)  # the first alternative is the nearer one
    assert point is not None
    assert abs(events.state(0, events.knot(0, "t1")).speed.value(point) - 11) < 1e-3
