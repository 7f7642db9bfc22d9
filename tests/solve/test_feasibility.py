"""Whether a scenario can happen: what can is never denied, what cannot is proven, explained, and can be mended."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import partial

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from motions import Exact, Move, motion, tenths, wandering

from scenarios import (
    FEASIBLE,
    NOT_YIELDING,
    TOO_FAST,
    Example,
    example,
    feasibility,
    limits_of,
)
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads import load_map
from scenewright.roads.grounding import ground
from scenewright.solve import suggestions
from scenewright.solve.feasibility import EgoBounds
from scenewright.solve.proofs.decide import Decision, Question, decide
from scenewright.solve.proofs.lowering import MEAN_RATE
from scenewright.solve.proofs.relaxation import EVEN_RATE
from scenewright.solve.proofs.witness import Broken
from scenewright.units import format_fraction, pin

T = load_map("t_intersection")


@pytest.mark.parametrize("case", FEASIBLE, ids=lambda case: case.name)
def test_what_can_happen(case: Example) -> None:
    found = feasibility(case.scene())
    assert found.answer == "feasible"
    assert found.clashes == found.suggestions == ()


HERO = "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- {}\n- [t0, go, t1, {}, t2]\n\nConstraints:\n"
MET = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 25\n"
ACC = "while hero speeds up, it never brakes, speeds up at 4 m/s^2 at most, and is 18.1 m/s fast at most"
DEC = "while hero brakes, it brakes at 8 m/s^2 at most, never speeds up, and is 18.1 m/s fast at most"
EGO = "ego brakes at 12 m/s^2 at most, speeds up at 8 m/s^2 at most, and is 60 m/s fast at most, as any road vehicle"


@pytest.mark.parametrize(
    ("route", "piece", "constraints", "laws"),
    [
        pytest.param("E, N", "dec", f"{MET}A1v(t1) == 9\nA1x(t2) - A1x(t1) == 4\nA1v(t2) == 0\n", {DEC}, id="speed"),
        pytest.param(
            "E, N", "acc", f"{MET}A1x(t1) == conflict_point - 60\nA1x(t2) == conflict_point\nA1(t2) - A1(t1) == 1.5\n",
            {ACC}, id="place and time",
        ),
        pytest.param(
            "W", "dec", "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 3\nA1v(t2) == 0\n",
            {"the ego touches nobody before the trigger"}, id="gap",
        ),
        pytest.param(
            "E, N", "acc",
            f"{MET}A1x(t1) == conflict_point - 30\nA1v(t1) <= 5\nA1x(t2) == conflict_point\nA0x(t2) == conflict_point\n"
            "A1(t2) < A0(t2)\nA0v(t1) == 25\n",
            {ACC, EGO}, id="orders",
        ),
        pytest.param("E, N", "dec", f"{MET}A1v(t2) == 2\nalways[A1(t1), A1(t2)] (A1v >= 6)\n", {DEC}, id="interval"),
        pytest.param(
            "E, N", "dec", f"{MET}A1v(t1) == 9\nA1a(dec) == -2\nA1v(t2) == 0\nA1(t2) - A1(t1) == 3\n", {MEAN_RATE},
            id="rate",
        ),
        pytest.param(
            "E, N", "dec", f"{MET}A1v(t1) == 12\nA1a(dec) == -2\nA1v(t2) == 0\nA1x(t2) - A1x(t1) == 25\n",
            {MEAN_RATE, EVEN_RATE}, id="rate and way",
        ),
    ],
)  # fmt: skip
def test_a_proof_names_in_plain_words_what_it_takes_for_granted(
    route: str, piece: str, constraints: str, laws: set[str]
) -> None:
    scene = ground(parse_program(HERO.format(route, piece) + constraints), T)
    decision = decide(Question(scene, read_structure(scene.program), limits_of(scene)), 5.0)
    assert decision.answer == "infeasible"
    own = {constraint.id for constraint in scene.program.constraints}
    assert laws <= set(decision.core) - own
    assert set(decision.core) & own


@pytest.mark.parametrize(
    ("way_m", "answers"), [(25, ["infeasible"]), (33, ["feasible", "undecided"]), (36, ["feasible"])]
)
def test_how_far_one_rate_leads_is_refuted_only_where_no_ramp_makes_up_for_it(way_m: int, answers: list[str]) -> None:
    """From 12 m/s to a stand at 2 m/s^2 it is 36 m; harder in one ramp, and less in the other, it is 33 m."""
    told = f"{MET}A1v(t1) == 12\nA1a(dec) == -2\nA1v(t2) == 0\nA1x(t2) - A1x(t1) == {way_m}\n"
    scene = ground(parse_program(HERO.format("E, N", "dec") + told), T)
    assert decide(Question(scene, read_structure(scene.program), limits_of(scene)), 0.5).answer in answers


@pytest.mark.parametrize(
    ("broken", "words"),
    [
        (Broken("turn", 1, 2.0, 1.0), "in the best motion hero takes its turn too fast"),
        (Broken("apart", 1, 2.0, 1.0, 0), "in the best motion ego and hero touch"),
        (Broken("law", 1, 2.0, 1.0), "in the best motion hero moves as nobody can"),
        (
            Broken("c1", 1, 2.0, 1.0),
            "in the best motion this does not hold: all of this is at one moment, when the hero begins to brake",
        ),
    ],
)
def test_what_is_undecided_says_what_is_amiss(broken: Broken, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    undecided = Decision("undecided", amiss=(broken,))
    monkeypatch.setattr("scenewright.solve.feasibility.decide", lambda *_, **__: undecided)
    found = feasibility(ground(parse_program(HERO.format("E, N", "dec") + MET), T))
    assert found.answer == "undecided"
    assert found.reason.endswith(words)


def test_clashes_carry_the_words_of_the_description(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(suggestions, "_Trials", partial(suggestions._Trials, left_s=1.2))
    words = "it drives at 12 m/s"
    text = f'description: "When {words}, it stops."\n' + TOO_FAST.text.replace(
        "fast: A1v(t1) == 12", f"fast: A1v(t1) == 12  @5..{5 + len(words)}"
    )
    found = feasibility(ground(parse_program(text), T))
    assert {c.id: c.words for c in found.clashes}["fast"] == words
    assert f'- fast: the hero drives at 12 m/s when it begins to brake  ("{words}")' in found.explain()
    assert any(suggestion.what == f'12 in "{words}"' for suggestion in found.suggestions)


def test_open_parameters_are_given_values_that_work() -> None:
    text = example(
        "E, N",
        "t0, go, t1, dec, t2",
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 20\nA1v(t1) == speed_mps\nA1x(t1) == conflict_point - near_m\n"
        "A1x(t2) == conflict_point - 6\nA1v(t2) == 0",
    )
    scene = ground(parse_program(text), T, {"near_m": 20})
    found = feasibility(scene)
    assert found.answer == "feasible"
    assert set(found.parameters) == {"speed_mps"}
    settled = replace(scene, parameters={**scene.parameters, **found.parameters})
    assert feasibility(settled).answer == "feasible"
    impossible = replace(scene, parameters={**scene.parameters, "speed_mps": Fraction(40)})
    assert feasibility(impossible, explain=False).answer == "infeasible"


def test_what_is_granted_of_the_ego_matters() -> None:
    """An ego that holds its speed cannot be at two places at once in two ways; any other ego can."""
    text = NOT_YIELDING.text + "A0v(t1) == 5\nA0v(t2) == 9\n"
    scene = ground(parse_program(text), T)
    assert feasibility(scene, explain=False).answer == "feasible"
    assert feasibility(scene, ego=EgoBounds(holds_speed=True), explain=False).answer == "infeasible"


# -- soundness: what has happened is possible -----------------------------------------------------------------------
Wander = tuple[Fraction, list[Move]]


@st.composite
def happenings(draw: st.DrawFn) -> tuple[str, Exact, Exact, int, int]:
    """Draw a hero's route and exact motions of ego and hero with the trigger at one moment, within their limits."""
    route = draw(st.sampled_from(["E, N", "W"]))
    top = 18.0 if route == "W" else 8.0
    ego_before: Wander = draw(wandering(20, 8, 12))
    hero_before: Wander = draw(wandering(top, 4, 8))
    first, second = (sum(d for d, _ in steps) for _, steps in (ego_before, hero_before))
    for (speed, steps), lacking in ((ego_before, second - first), (hero_before, first - second)):
        if lacking > 0:
            steps.append((lacking, steps[-1][1] if steps else speed))
    trigger_speed = hero_before[1][-1][1]
    assume(trigger_speed >= 1)
    kind = draw(st.sampled_from(["dec", "acc"]))
    share, lasting = draw(st.integers(0, 10)), draw(tenths(0.5, 5))
    if kind == "dec":
        low, high = max(Fraction(0), trigger_speed - 8 * lasting), trigger_speed - lasting / 20
    else:
        low, high = trigger_speed + Fraction(1, 100), min(Fraction(str(top)), trigger_speed + 4 * lasting)
    assume(low <= high)
    end = low + (high - low) * share / 10
    hero = motion(hero_before[0], [*hero_before[1], (lasting, end)])
    ego_after = draw(wandering(20, 8, 12, most=2))[1]
    speed, after = ego_before[1][-1][1], []
    for duration, wanted in ego_after:
        wanted = min(max(wanted, speed - 12 * duration), speed + 8 * duration)
        after.append((duration, wanted))
        speed = wanted
    ego = motion(ego_before[0], [*ego_before[1], *after])
    return f"{route}|{kind}", ego, hero, len(ego_before[1]), len(hero_before[1])


def said(value: Fraction) -> str:
    return f"({format_fraction(value)})"


@settings(max_examples=40)
@given(
    happening=happenings(),
    ego_way=tenths(0, 120),
    hero_way=tenths(5, 80),
    chosen=st.lists(st.integers(0, 15), min_size=2, max_size=9, unique=True),
)
def test_what_has_happened_is_never_called_impossible(
    happening: tuple[str, Exact, Exact, int, int], ego_way: Fraction, hero_way: Fraction, chosen: list[int]
) -> None:
    shape, ego, hero, e1, h1 = happening
    route, kind = shape.split("|")
    base = ground(parse_program(example(route, f"t0, go, t1, {kind}, t2", "A0(t1) == A1(t1)")), T)
    line, place = pin(base.landmark_m(0, "stop_line")), pin(base.landmark_m(1, "intersection"))
    ego = ego.shifted(line - ego_way - ego.positions[e1])
    hero = hero.shifted(place - hero_way - hero.positions[h1])
    assume(min(ego.positions[0], hero.positions[0]) >= 0)
    assume(ego.positions[-1] <= 620)
    assume(hero.positions[-1] <= 440)
    if route == "W":
        gaps = [hero.positions[0] - ego.positions[0], hero.positions[h1] - ego.positions[e1]]
        assume(all(gap >= Fraction(9, 2) for gap in gaps) or all(gap <= -Fraction(9, 2) for gap in gaps))
    speed = ego.speeds[e1]
    order = "<" if hero.times[-1] < ego.times[-1] else ">="
    facts = [
        f"A0x(t1) == stop_line - {said(ego_way)}",
        f"A1x(t1) == intersection - {said(hero_way)}",
        f"A0v(t1) == {said(speed)}",
        f"A1v(t1) == {said(hero.speeds[h1])}",
        f"A1v(t2) == {said(hero.speeds[-1])}",
        f"A1a({kind}) == {said(hero.accelerations[-1])}",
        f"A1x(t2) == intersection - {said(place - hero.positions[-1])}",
        f"A1(t2) - A1(t1) == {said(hero.times[-1] - hero.times[h1])}",
        f"A0(t2) - A0(t1) == {said(ego.times[-1] - ego.times[e1])}",
        f"A0x(t0) == stop_line - {said(line - ego.positions[0])}",
        f"A1x(t0) == intersection - {said(place - hero.positions[0])}",
        f"A0v(t0) == {said(ego.speeds[0])} and A1v(t0) == {said(hero.speeds[0])}",
        f"A0x(t2) == stop_line - {said(line - ego.positions[-1])}",
        f"A1(t2) {order} A0(t2)",
        f"A0(t1) == {said(ego.times[e1])}",
        f"tta(A0, stop_line, t1) == {said(ego_way / speed)}" if speed else "A0v(t1) == 0",
    ]
    constraints = "\n".join(["A0(t1) == A1(t1)", *(facts[index] for index in chosen)])
    scene = ground(parse_program(example(route, f"t0, go, t1, {kind}, t2", constraints)), T)
    limits = limits_of(scene)[1]
    assert max(hero.speeds) <= limits.turn_speed_max_mps
    assert feasibility(scene, explain=False).answer != "infeasible"


def test_a_time_to_collision_that_never_comes_is_long_enough() -> None:
    text = example(
        "W",
        "t0, go, t1, dec, t2",
        "A0(t1) == A1(t1)\nA0v(t1) == 5\nA1v(t1) == 8\ngap(A0, A1, t1) == 20\nttc(A0, A1, t1) >= 3\nA1v(t2) == 0",
    )
    assert feasibility(ground(parse_program(text), T), explain=False).answer == "feasible"


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("A0v(1.0) >= 100", "how fast anybody may be: ego 0 to 60 m/s"),
        ("A1a(acc) == 12", "how hard anybody may brake and speed up: hero -8 to 4 m/s^2"),
    ],
)
def test_a_number_out_of_range_clashes_with_its_range_in_words(line: str, words: str) -> None:
    scene = replace(NOT_YIELDING, text=f"{NOT_YIELDING.text}{line}\n").scene()
    decision = decide(Question(scene, read_structure(scene.program), limits_of(scene)), 5.0)
    assert words in decision.core
