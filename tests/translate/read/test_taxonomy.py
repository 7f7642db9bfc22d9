"""Every combination of routes, interaction and trigger of the paper's taxonomy, composed here and read back."""

from __future__ import annotations

import pytest
from readings import reading_of, written

from scenewright.program.printer import print_expression
from scenewright.program.types import Program

# Route as headings: where it starts, the wish in words.
ROUTES = {
    "SW": ("driveway", "turn right onto the road travelling westbound"),
    "SE": ("driveway", "turn left onto the road travelling eastbound"),
    "W": ("road", "lane follow along the road travelling westbound"),
    "E": ("road", "lane follow along the road travelling eastbound"),
    "EN": ("road", "turn left into the driveway"),
    "WN": ("road", "turn right into the driveway"),
}
CROSSING = [("SW", "W"), ("SE", "W"), ("SE", "E"), ("SE", "EN"), ("W", "EN"), ("W", "SW"), ("W", "SE"), ("WN", "EN"),
            ("E", "SE"), ("EN", "W"), ("EN", "WN"), ("EN", "SE")]  # fmt: skip
FOLLOWING = [("SW", "SW"), ("SE", "SE"), ("W", "WN"), ("E", "EN"), ("W", "W"), ("E", "E"), ("EN", "EN"), ("WN", "W")]
ACTS = {"yields": "go dec", "does not yield": "go acc", "yields then goes": "go dec stop acc"}


def taken(text: str) -> Program:
    reading = reading_of(text)
    assert reading.kind == "taken"
    assert reading.program is not None
    return reading.program


def formulas(program: Program) -> frozenset[str]:
    return written(print_expression(constraint.formula) for constraint in program.constraints)


def opening(ego: str, hero: str, amount: str) -> str:
    line = "stop line" if ROUTES[ego][0] == "driveway" else "intersection"
    return (
        f"Ego is on the {ROUTES[ego][0]} and it is {amount.format('start')} the {line}. It wants to {ROUTES[ego][1]}. "
        f"There is a hero vehicle on the {ROUTES[hero][0]}. It wants to {ROUTES[hero][1]}. "
    )


def near(actor: int, landmark: str, name: str, knot: str, *, timed: bool) -> str:
    if timed:
        return f"tta(A{actor}, {landmark}, {knot}) == {name}_s"
    return f"A{actor}x({knot}) == {landmark} - {name}_m"


@pytest.mark.parametrize("timed", [False, True], ids=["distance", "time"])
@pytest.mark.parametrize("interaction", ACTS)
@pytest.mark.parametrize(("ego", "hero"), CROSSING)
def test_vehicles_that_meet(ego: str, hero: str, interaction: str, timed: bool) -> None:
    amount = "{}_s from" if timed else "{}_m behind"
    ego_line = "stop_line" if ROUTES[ego][0] == "driveway" else "conflict_point"
    hero_line = "stop_line" if ROUTES[hero][0] == "driveway" else "conflict_point"
    start_line = "stop_line" if ROUTES[ego][0] == "driveway" else "intersection"
    stop = "decelerate to a complete stop at end_m behind the conflict point. "
    ego_turns = len(ego) > 1
    go = "accelerate to pass the conflict point before the ego " + (
        "begins to turn. " if ego_turns else "passes the conflict point. "
    )
    text = opening(ego, hero, amount) + (
        f"When the ego is {amount.format('near')} the {ego_line.replace('_', ' ')} and the hero vehicle is "
        f"{amount.format('far')} the {hero_line.replace('_', ' ')}, the hero vehicle begins to "
    )
    expected = [
        near(0, start_line, "start", "t0", timed=timed),
        "A0(t1) == A1(t1)",
        near(0, ego_line, "near", "t1", timed=timed),
        near(1, hero_line, "far", "t1", timed=timed),
    ]
    last = "t2"
    if interaction != "does not yield":
        text += stop
        expected += ["A1x(t2) == conflict_point - end_m", "A1v(t2) == 0"]
    if interaction == "yields then goes":
        text += "Then, the hero vehicle begins to "
        expected.append("A1v(stop) == 0")
        last = "t4"
    if interaction != "yields":
        text += go
        expected += [f"A1x({last}) == conflict_point", f"A0x(t2) == {'turn_start' if ego_turns else 'conflict_point'}"]
        expected.append(f"A1({last}) < A0(t2)")
    program = taken(text)
    assert ["".join(actor.route.headings) for actor in program.actors] == [ego, hero]  # type: ignore[union-attr]
    assert " ".join(program.actors[1].sketch.pieces) == ACTS[interaction]
    assert formulas(program) == written(expected)


@pytest.mark.parametrize(("ego", "hero"), FOLLOWING)
def test_vehicles_behind_each_other(ego: str, hero: str) -> None:
    text = opening(ego, hero, "{}_s from") + (
        "When the ego is gap_m behind the hero vehicle, the hero vehicle begins to decelerate to a complete stop "
        "at a rate of rate_mpss."
    )
    program = taken(text)
    assert ["".join(actor.route.headings) for actor in program.actors] == [ego, hero]  # type: ignore[union-attr]
    assert formulas(program) == {
        near(0, "stop_line" if ROUTES[ego][0] == "driveway" else "intersection", "start", "t0", timed=True),
        "gap(A0, A1, t1) == gap_m",
        "A1a(dec) == -rate_mpss",
        "A1v(t2) == 0",
    }
