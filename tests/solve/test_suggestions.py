"""Numbers that would do are tried before they are proposed: each works when it is taken, and is near."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from functools import partial

import pytest

from scenarios import BRAKES, INFEASIBLE, TOO_HARD, Example, feasibility, limits_of
from scenewright.orchestrate import orchestrate, set_up
from scenewright.program.printer import print_expression, print_program
from scenewright.program.resolve import resolve
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.request import Request, Stages
from scenewright.roads import load_map
from scenewright.roads.grounding import Scene, ground
from scenewright.solve import suggestions
from scenewright.solve.feasibility import check_feasibility
from scenewright.solve.proofs.decide import Question
from scenewright.solve.suggestions import Suggestion, suggest
from scenewright.units import decimal_fraction, format_fraction
from stories import STORIES, program

T = load_map("t_intersection")


def applied(scene: Scene, suggestion: Suggestion) -> Scene:
    """Return `scene` with the one number changed that `suggestion` names."""
    nearest = decimal_fraction(suggestion.nearest)
    if suggestion.what in scene.parameters:
        return replace(scene, parameters={**scene.parameters, suggestion.what: nearest})
    number, where = suggestion.what.split(" in ", 1)
    program = scene.program
    for constraint in program.constraints:
        formula = print_expression(constraint.formula)
        if where in (formula, f'"{program.words_of(constraint)}"'):
            old = rf"(?<![\w.]){re.escape(number)}(?![\w.])"
            changed, count = re.subn(old, f"({format_fraction(nearest)})", formula)
            assert count == 1
            text = print_program(program).replace(f"{constraint.id}: {formula}", f"{constraint.id}: {changed}")
            assert text != print_program(program)
            return replace(scene, program=resolve(parse_program(text)))
    raise AssertionError(f"{suggestion.what} is in no constraint")


@pytest.fixture
def proposed_sooner(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let less be tried, for tests of whether what is proposed works."""
    monkeypatch.setattr(suggestions, "_Trials", partial(suggestions._Trials, left_s=1.2))
    monkeypatch.setattr(suggestions, "_NEARER_S", 0.4)


@pytest.mark.usefixtures("proposed_sooner")
@pytest.mark.parametrize(
    "case",
    INFEASIBLE,
    ids=lambda case: case.name,
)
def test_what_cannot_happen_is_explained_by_what_clashes_and_every_suggestion_works_when_taken(case: Example) -> None:
    scene = case.scene()
    found = feasibility(scene)
    assert found.answer == "infeasible"
    own = {constraint.id for constraint in scene.program.constraints}
    assert {clash.id for clash in found.clashes} & own == set(case.clashes)
    for clash in found.clashes:
        assert (clash.formula is not None) is (clash.id in own)
        assert str(clash) in found.explain()
    plain = found.as_dict()
    assert plain["answer"] == "infeasible"
    assert len(plain["clashes"]) == len(found.clashes)
    assert found.suggestions
    for suggestion in found.suggestions:
        assert suggestion.nearest != suggestion.value
        assert feasibility(applied(scene, suggestion), explain=False).answer == "feasible"


@pytest.mark.usefixtures("proposed_sooner")
@pytest.mark.parametrize(
    ("speed", "rate", "way"),
    [(Fraction(10), Fraction(2), Fraction(10)), (Fraction(8), Fraction(4), Fraction(8))],
    ids=["too hard", "just so"],
)
def test_suggestions_for_braking_work_and_are_near(speed: Fraction, rate: Fraction, way: Fraction) -> None:
    """Speed, rate and way of a braking car are tied by v^2 = 2 a s: each suggestion must restore that."""
    text = TOO_HARD.text.replace("A1v(t1) == 10", f"A1v(t1) == {float(speed)}")
    scene = ground(parse_program(text), T, {"rate_mpss": rate, "braking_m": way})
    found = feasibility(scene)
    assert (found.answer == "feasible") is (speed * speed == 2 * rate * way)
    for suggestion in found.suggestions:
        assert feasibility(applied(scene, suggestion), explain=False).answer == "feasible"


def answer(text: str) -> str:
    """Return whether it can happen, without asking why not."""
    world, _ = set_up(Request(text, ego="idm"), Stages(None))
    return check_feasibility(
        Question(world.scene, world.structure, world.limits, world.ego_bounds), explain=False
    ).answer


def test_every_suggestion_makes_it_possible() -> None:
    text = STORIES["yields, distance"].replace("conflict_point - 6", "conflict_point - 17.6\nA1v(t1) == 4")
    result = orchestrate(Request(text, ego="idm"))
    assert result.feasibility is not None
    assert result.feasibility.suggestions
    for suggestion in result.feasibility.suggestions:
        number, formula = suggestion.what.split(" in ")
        assert float(number) == suggestion.value
        assert formula in text
        mended = text.replace(formula, f"{formula.removesuffix(number)}{suggestion.nearest}")
        assert answer(mended) == "feasible"
        further = suggestion.nearest + 0.05 * (suggestion.value - suggestion.nearest)
        short = text.replace(formula, f"{formula.removesuffix(number)}{further:.4f}")
        assert answer(short) == "infeasible"


def test_no_suggestion_is_off_by_the_rounding_of_what_was_found() -> None:
    """At least 2 s at no less than 6.9 m/s, then to a stand: 9 + 6.9 / 2 + 6.9^2 / 8 m, a millimetre more than 18.4."""
    hero = "A1x(t1) == conflict_point - 40\nA1v(t1) == 12\nalways[A1(t1), A1(t1) + 2] (A1v >= 6.9)\n"
    rest = "A0(t1) == A1(t1)\nA1x(t2) == conflict_point - 23\nA1v(t2) == 0\nA1(t2) - A1(t1) >= 2\n"
    text = program("E, N", "t0, go, t1, dec, t2", hero + rest)
    scene = ground(parse_program(text), T)
    question = Question(scene, read_structure(scene.program), limits_of(scene))
    where = next(c.id for c in scene.program.constraints if print_expression(c.formula).startswith("A1x(t1)"))
    (found,) = suggest(question, {where})
    assert found.nearest == pytest.approx(41.401, abs=0.02)
    assert answer(text.replace("point - 40", f"point - {found.nearest}")) == "feasible"


@pytest.mark.parametrize(
    ("line", "unit", "nearest"),
    [
        ("A1a(dec) == -20", "m/s^2", -8.0),
        ("always[A1(t1), A1(t2)] (A1a <= -50)", "m/s^2", -8.0),
        ("always[1, 2] (A1v >= 100)", "m/s", 18.0),
        ("always[A1(t0), A1(t1)] (A1x >= 0 implies A1v >= 100)", "m/s", 18.0),
    ],
)
def test_bounds_of_a_stretch_of_time_have_ways_out_in_their_own_unit(line: str, unit: str, nearest: float) -> None:
    """As unknowns they bound no law of motion, so they are tried as numbers; and no empty stretch is proposed."""
    head = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- E, N\n- [t0, go, t1, dec, t2]\n\n"
    text = f"{head}Constraints:\nA0(t1) == A1(t1)\nA1x(t2) <= conflict_point - 5\nprobe: {line}\n"
    scene = ground(parse_program(text), T)
    probe = print_expression(scene.program.constraint("probe").formula)
    question = Question(scene, read_structure(scene.program), limits_of(scene))
    found = [each for each in suggest(question, {"probe"}) if each.what.endswith(probe) and each.unit == unit]
    assert len(found) == 1
    assert found[0].nearest == pytest.approx(nearest, abs=0.3)


def test_a_number_is_told_in_the_unit_of_whoever_gave_it() -> None:
    """Who wrote 26 ft looks for no 7.9248, and what is set by the name of a parameter is in the unit of that name."""
    said = "the hero is 26 ft before the conflict point at speed_mph"
    text = f"The ego drives west. An oncoming hero turns left. When {said}, the hero brakes to a stop 5 m before it."
    result = orchestrate(Request(text, parameters={"speed_mph": 30.0}), until="plan")
    assert result.feasibility is not None
    told = {each.what: (each.value, each.unit) for each in result.feasibility.suggestions}
    assert told == {f'26 in "{said}"': (26.0, "ft"), "speed_mph": (30.0, "mph")}
    faster = {each.what: each.nearest for each in result.feasibility.suggestions}["speed_mph"]
    assert orchestrate(Request(text, parameters={"speed_mph": faster}), until="check").status == "success"


def test_a_factor_has_no_unit() -> None:
    text = BRAKES.text + "c8: A1v(t1) == 3 * A0v(t1)\nc9: A0v(t1) == 9\nc10: A1v(t1) <= 3 m/s * 2\n"
    scene = ground(parse_program(text), T)
    told = {lever.what.split(" in ")[0]: lever.unit for lever in suggestions.levers(scene, {"c8", "c9", "c10"})}
    assert told == {"3": "m/s", "9": "m/s", "2": ""}
    assert [lever.unit for lever in suggestions.levers(scene, {"c8"})] == [""]
    assert str(Suggestion("3 in A1v(t1) == 3 * A0v(t1)", 3.0, 1.5, "")).endswith(": 1.5 instead of 3")


CLOSE = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, acc, t2]

Constraints:
tie: A0(t1) == A1(t1)
ego_near: A0x(t1) == conflict_point - 38.9
near: A1x(t1) == conflict_point - 30.9
slow: A1v(t1) <= 5.7
there: A1x(t2) == conflict_point
ego_there: A0x(t2) == conflict_point
first: A1(t2) <= A0(t2) - 0.9
soon: A0(t2) - A0(t1) <= 1.8
"""


def test_every_number_that_clashes_has_its_share_of_the_search() -> None:
    """At 18 m/s the hero takes 1.7 s, and is to be 0.9 s before the ego; numbers late in the list are bisected too."""
    found = orchestrate(Request(CLOSE, ego="idm"), until="check").feasibility
    assert found is not None
    own = {clash.id for clash in found.clashes if clash.formula is not None}
    assert own <= {"tie", "near", "slow", "there", "first", "soon"}
    assert len(own) < 8, "where the ego is, and that it passes, matters not"
    (soon,) = [each for each in found.suggestions if each.value == 1.8]
    assert answer(CLOSE.replace("<= 1.8", f"<= {soon.nearest}")) == "feasible"
    assert soon.nearest < 5.5
