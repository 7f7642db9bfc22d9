"""What a program asks of heroes: in tight tolerances, of alternatives the nearest; and how fast bends may be driven."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from situations import HERO, Array, asked_of, scene_of

from scenewright.plan.asked import TIGHT, Asked, Row, number_of
from scenewright.program.types import EGO
from scenewright.solve.proofs.forms import TIGHT as EXACT
from scenewright.units import Dimension
from stories import program

SYNC = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\n"
LANE = "A0(t1) == A1(t1)\n"


def asked_for(line: str, route: str = "E, N", sync: str = SYNC) -> Asked:
    return asked_of(scene_of(program(route, "t0, go, t1, dec, t2", f"{sync}A1v(t2) == 0\ntested: {line}")))


def state(asked: Asked, actor: int, knot: str) -> tuple[int, int]:
    found = asked.events.states[actor, asked.knot(actor, knot)]
    place, speed = number_of(found.place), number_of(found.speed)
    assert place is not None
    assert speed is not None
    return place, speed


def number(unknown: int | None) -> int:
    assert unknown is not None
    return unknown


def rows_at(asked: Asked, values: dict[int, float]) -> list[Row]:
    point = np.zeros(asked.size + 1)
    point[-1] = 1.0
    for number, value in values.items():
        point[number] = value
    slopes: Array = np.vstack([np.eye(asked.size), np.zeros(asked.size)])
    return list(asked.rows(point, slopes))


@pytest.mark.parametrize(
    ("line", "kind"),
    [("A1x(t1) == conflict_point - 20", "place"), ("A1v(t1) == 6", "speed"), ("A1(t1) == 4", "time")],
)
@given(off=st.floats(-9.0, 9.0))
def test_levels_are_in_tight_tolerances(line: str, kind: str, off: float) -> None:
    asked = asked_for(line)
    place, speed = state(asked, HERO, "t1")
    time = asked.times[asked.knot(HERO, "t1")]
    place_m = asked.scene.landmark_m(HERO, "conflict_point", EGO) - 20.0
    unknown, value = {"place": (place, place_m), "speed": (speed, 6.0), "time": (time, 4.0)}[kind]
    assert unknown is not None
    rows = rows_at(asked, {unknown: value + off * TIGHT[kind]})
    (row,) = [row for row in rows if np.flatnonzero(row.slope).tolist() == [unknown] and row.equal]
    assert abs(row.level) == pytest.approx(abs(off), abs=1e-3)
    assert abs(row.slope[unknown]) == pytest.approx(1.0 / TIGHT[kind])


@given(mps=st.floats(0.5, 15.0), off=st.floats(-5.0, 5.0))
def test_a_time_to_arrival_is_off_by_its_own_tolerance(mps: float, off: float) -> None:
    """As long as it takes at that speed: the slower the hero, the shorter the way that a tenth of a second is."""
    asked = asked_for("tta(A1, conflict_point, t1) == 2.5")
    place, speed = state(asked, HERO, "t1")
    there_m = asked.scene.landmark_m(HERO, "conflict_point", EGO) - (2.5 + 0.1 * off) * mps
    rows = rows_at(asked, {place: there_m, speed: mps})
    (row,) = [row for row in rows if set(np.flatnonzero(row.slope)) == {place, speed} and row.equal]
    slowest = max(mps, asked.wanted.moves_mps)
    assert abs(row.level) == pytest.approx(abs(off) * mps / slowest, abs=1e-3)


@given(short_mps=st.floats(0.0, 0.6))
def test_nobody_who_stands_at_its_place_is_a_time_from_it(short_mps: float) -> None:
    """No way at no speed takes as long as one likes, as far as a product of the two can tell."""
    asked = asked_for("tta(A1, conflict_point, t1) == 5")
    place, speed = state(asked, HERO, "t1")
    place_m = asked.scene.landmark_m(HERO, "conflict_point", EGO)
    mps = asked.wanted.moves_mps - short_mps
    found = {speed: mps, place: place_m - 5.0 * mps}
    slower = [row for row in rows_at(asked, found) if np.flatnonzero(row.slope).tolist() == [speed] and not row.equal]
    assert max(row.level for row in slower if row.slope[speed] < 0.0) == pytest.approx(short_mps / TIGHT["speed"])


@pytest.mark.parametrize(("faster", "chosen"), [(9.8, "speed"), (9.0, "place")])
def test_of_alternatives_the_nearest_to_holding_is_asked(faster: float, chosen: str) -> None:
    asked = asked_for("A1v(t1) >= 10 or A1x(t1) <= conflict_point - 60")
    place, speed = state(asked, HERO, "t1")
    place_m = asked.scene.landmark_m(HERO, "conflict_point", EGO) - 59.0
    rows = rows_at(asked, {place: place_m, speed: faster})
    told = [set(np.flatnonzero(row.slope)) for row in rows]
    assert ({speed} in told) is (chosen == "speed")
    assert ({place} in told) is (chosen == "place")


def test_who_is_to_be_earlier_is_told_from_what_holds_by_the_clock() -> None:
    lines = "A1x(t2) == conflict_point\nA0x(t2) == conflict_point\nA1(t2) < A0(t2)"
    asked = asked_of(scene_of(program("E, N", "t0, go, t1, acc, t2", SYNC + lines)))
    hero, ego = (asked.times[asked.knot(actor, "t2")] for actor in (HERO, EGO))
    assert hero is not None
    assert ego is not None
    (row,) = [row for row in rows_at(asked, {hero: 6.0, ego: 8.0}) if row.slope[hero] and row.slope[ego]]
    assert row.order
    assert not row.equal
    assert row.level * TIGHT["time"] == pytest.approx(-2.0 / np.sqrt(2.0))


@pytest.mark.parametrize(
    ("line", "row"),
    [("A0v(t0) == 9", False), ("A0v(t1) <= A1v(t1)", True), ("A1v(t0) == 9", True)],
)
def test_nothing_is_asked_of_the_ego_alone(line: str, row: bool) -> None:
    asked = asked_for(line)
    assert ("tested" in {each.origin for each in asked.narrowings}) is False
    speeds = {
        number_of(found.speed)
        for (actor, instant), found in asked.events.states.items()
        if instant == asked.knot(HERO if "A1" in line else EGO, "t1" if "t1" in line else "t0")
    }
    moved = {k for each in rows_at(asked, {}) for k in np.flatnonzero(each.slope)}
    assert bool(speeds & moved) is row


@pytest.mark.parametrize("at", ["A0(t1) - A0(t0) == 3", "A0(t1) == 3"])
def test_when_a_trigger_comes_that_both_decide_is_asked_of_both(at: str) -> None:
    """It is the hero's trigger too, and nobody else's to decide where neither has to be anywhere then."""
    asked = asked_for(at, "W", LANE)
    trigger = asked.trigger(HERO)
    assert trigger is not None
    time = asked.times[trigger]
    assert time is not None
    told = [row for row in rows_at(asked, {time: 5.0}) if np.flatnonzero(row.slope).tolist() == [time] and row.equal]
    assert [abs(row.level) for row in told] == [pytest.approx(2.0 / TIGHT["time"])]


def test_tolerances_are_those_of_the_contract() -> None:
    of: dict[str, Dimension] = {"time": "time", "place": "length", "speed": "speed", "rate": "acceleration"}
    assert {kind: float(EXACT[dimension]) for kind, dimension in of.items()} == {kind: TIGHT[kind] for kind in of}


@pytest.mark.parametrize(("route", "turns"), [("W", False), ("E, N", True)])
def test_caps_are_those_of_bends_and_of_the_road(route: str, turns: bool) -> None:
    asked = asked_for("A1v(t1) >= 2", route)
    caps, limits, path = asked.caps[HERO], asked.limits[HERO], asked.scene.routes[HERO].path
    for s_m in np.linspace(1.0, path.length_m - 1.0, 300):
        most, comfortable = (caps.at(s_m, each)[0] for each in (caps.most, caps.comfortable))
        bend = abs(path.curvature(float(s_m)))
        assert max(comfortable, most) < limits.speed_max_mps
        assert comfortable <= most or bend < 0.01, "in a bend"
        assert most**2 * bend <= limits.lateral_max_mpss
        assert comfortable**2 * bend <= asked.wanted.lateral_mpss * 1.01
    assert (min(caps.most) < 0.8 * limits.speed_max_mps) == turns
    braked = -np.diff(caps.most**2) / (2.0 * np.diff(caps.places))
    assert braked.max() <= limits.brake_max_mpss, "whoever is no faster than that can keep to it"


def test_caps_tell_how_they_change() -> None:
    caps = asked_for("A1v(t1) >= 2").caps[HERO]
    steep = 0
    for s_m in np.arange(1.0, caps.places[-1] - 1.0, 0.5):
        for speeds in (caps.most, caps.comfortable, *caps.on_the_way_to(s_m)):
            before, (here, slope), after = (caps.at(s_m + by, speeds) for by in (-0.5, 0.0, 0.5))
            assert slope == pytest.approx(after[0] - before[0], abs=1e-9)
            steep += abs(slope) > 0.5
            assert here > 0.0
    assert steep > 4


def test_which_of_two_heroes_is_first_is_no_matter_of_rounding() -> None:
    two = "\nActor 2 (other):\n- W\n- [t0, go, t1, dec, t2]\n"
    text = program("E, N", "t0, go, t1, acc, t2", SYNC + "A2(t1) - A1(t1) == 1\nA1(t2) < A2(t2)")
    asked = asked_of(scene_of(text.replace("\nConstraints:", f"{two}\nConstraints:")))
    one, other = (asked.times[asked.knot(actor, "t2")] for actor in (HERO, 2))
    assert one is not None
    assert other is not None
    rows = [row for row in rows_at(asked, {one: 6.0, other: 6.0}) if row.slope[one] and row.slope[other]]
    assert [(row.order, row.spare > 0.0) for row in rows] == [(False, True)]
    late = [row for row in rows_at(asked, {one: 6.0, other: 6.0}) if row.equal and row.slope.any()]
    assert all(row.spare == 0.0 for row in late)


@pytest.mark.parametrize(
    ("line", "ordered"),
    [
        ("A0x(t2) == conflict_point\nlater: A1(t2) < A0(t2)", True),
        ("A1(t2) - A1(t1) <= 9", False),  # how long it lasts is in its own hands, though the ego begins it, too
        ("always[A1(t1) + 2, A1(t1) + 4] (A1v <= 5)", False),
    ],
)
def test_only_what_the_ego_decides_alone_is_a_matter_of_forecasts(line: str, ordered: bool) -> None:
    asked = asked_for(line)
    rows = rows_at(asked, {number: 1.0 + k for k, number in enumerate(asked.times) if number is not None})
    assert any(row.order for row in rows) is ordered


@pytest.mark.parametrize(
    ("line", "looked_at"),
    [
        ("always[A0(t0), A0(t1)] (gap(A0, A1) >= 15)", {EGO, HERO}),
        ("never[A0(t0), A1(t2)] (A1x >= A1.route_end - 20 and A0v <= 2)", {EGO, HERO}),
        ("always[A0(t0), A0(t1)] (tta(A1, route_end) >= 3)", {HERO}),
        ("always[A0(t0), A1(t2)] (A1v <= 9)", set()),  # a law of motion says it all
        ("eventually[A0(t0), A0(t1)] (gap(A0, A1) >= 35)", set()),
        ("always[A0(t0), 9 / A0v(t1)] (gap(A0, A1) >= 15)", set()),  # no plan is asked for it, it is refused by name
    ],
)
def test_what_has_to_last_of_places_is_looked_at_between_moments(line: str, looked_at: set[int]) -> None:
    asked = asked_for(line, "W", LANE)
    assert {actor for actor, instant in asked.events.states if instant in asked.looks} == looked_at
    assert bool(asked.looks) is bool(looked_at)


@pytest.mark.parametrize("gap_m", [10.0, 16.0])
def test_within_its_stretch_of_time_what_has_to_last_is_asked_at_a_look(gap_m: float) -> None:
    asked = asked_for("always[A0(t0), A0(t1)] (gap(A0, A1) >= 15)", "W", LANE)
    look, trigger = asked.looks[3], asked.trigger(HERO)
    place, ego = (number(number_of(asked.events.states[actor, look].place)) for actor in (HERO, EGO))
    then, ends = number(asked.times[look]), number(asked.times[number(trigger)])
    at = {place: 100.0 + gap_m, ego: 100.0, ends: 6.0}
    within, after = (
        [row for row in rows_at(asked, at | {then: time_s}) if row.slope[place] and row.slope[ego]]
        for time_s in (4.0, 7.0)
    )
    (row,) = within
    assert (row.level > 0.0) is (gap_m < 15.0)
    assert row.spare > 0.0, "a distance that is kept is no matter of rounding"
    assert not after


def test_what_has_to_last_is_not_done_by_ending_it_sooner() -> None:
    """Of a stretch of a quarter of a second with a distance that is 20 m short it is the distance that is asked for."""
    asked = asked_for("always[A1(t1), A1(t2)] (gap(A0, A1) >= 40)", "W", LANE)
    look, (first, last) = asked.looks[-1], next(iter(asked.stretches))
    of = asked.events.states
    states = {each: [number(number_of(of[actor, each].place)) for actor in (EGO, HERO)] for each in (look, first, last)}
    at = {number(asked.times[k]): at_s for k, at_s in ((look, 6.1), (first, 6.0), (last, 6.25))}
    at |= {place: m for places in states.values() for place, m in zip(places, (100.0, 120.0), strict=True)}
    rows = rows_at(asked, at)
    for each, places in states.items():
        (row,) = [row for row in rows if all(row.slope[place] for place in places)]
        assert row.level > 10.0, each
        assert row.spare == (0.5 if each == look else 0.0)


@pytest.mark.parametrize(("bound", "drives"), [("<= 2", True), (">= 0.8", False), ("== 1", True)])
def test_who_is_to_be_there_soon_enough_drives(bound: str, drives: bool) -> None:
    """Standing, one is as long from any place as one likes: longer than at most 2 s, and never shorter than 0.8 s."""
    asked = asked_for(f"headway(A1, A0, t1) {bound}", "W", LANE)
    (place, speed), (ego, _) = state(asked, HERO, "t1"), state(asked, EGO, "t1")
    rows = rows_at(asked, {place: 100.0, ego: 104.6, speed: 0.1})
    slow = [row for row in rows if np.flatnonzero(row.slope).tolist() == [speed] and row.slope[speed] < 0.0]
    short = (asked.wanted.moves_mps - 0.1) / TIGHT["speed"]
    assert any(row.level == pytest.approx(short) for row in slow) is drives
