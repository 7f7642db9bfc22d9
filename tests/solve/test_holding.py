"""What a first plan does not hold is told by name, before anything is driven."""

from __future__ import annotations

import math

import pytest

from forms import PROBE, UNPLANNED
from scenarios import YIELDS, limits_of
from scenewright.judge.tolerance import LOOSE, dimension_of
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import orchestrate
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.holding import NotHeld, not_held

HEAD = """Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]

Constraints:
"""


def scene_with(constraints: str) -> Scene:
    program = parse_program(HEAD + constraints)
    return ground(program, load_map(program.map_name))


def driven(scene: Scene) -> dict[int, Profile]:
    """Everybody drives at 10 m/s for 4 s, and the hero brakes at 2 m/s^2 from then on."""
    ego = chain(0.0, 100.0, 10.0, [(8.0, 0.0, 0)])
    hero = chain(0.0, 100.0, 10.0, [(4.0, 0.0, 0), (4.0, -2.0, 1)])
    return {0: Profile(ego, {"t0": 0.0, "t1": 4.0}), 1: Profile(hero, {"t0": 0.0, "t1": 4.0, "t2": 8.0})}


def told(constraints: str) -> list[NotHeld]:
    scene = scene_with(constraints)
    return list(not_held(scene, driven(scene), dimension_of, LOOSE.of))


@pytest.mark.parametrize(
    ("constraint", "by", "unit"),
    [
        ("A1v(t2) == 0", 2.0, "m/s"),
        ("A1a(dec) <= -4", 2.0, "m/s^2"),
        ("A1a(t2) <= -4", 2.0, "m/s^2"),  # of the piece that ends there
        ("A1(t2) - A1(t1) >= 6", 2.0, "s"),
        ("always[A1(t0), A1(t2)] (A1v >= 8)", 6.0, "m/s"),
        ("A1v(t1) == A0v(t1) - 3", 3.0, "m/s"),
        ("A0v(2.0) == 7", 3.0, "m/s"),
        ("A1(t2) < A0(t1) and A1v(t2) == 5", 3.0, "m/s"),
        ("A1(t2) <= 5", 3.0, "s"),
        ("A1v(t1) / A1v(t0) <= 1/2", 0.5, ""),
    ],
)
def test_what_is_broken_is_told_with_its_number(constraint: str, by: float, unit: str) -> None:
    (found,) = told(f"probe: {constraint}\n")
    assert found.constraint.id == "probe"
    assert found.by == pytest.approx(by, abs=1e-6)
    assert found.unit == unit
    assert f"off by {by:.3g}" in str(found)
    assert ("nobody's to hold" in str(found)) == constraint.startswith("A0")


@pytest.mark.parametrize(
    "constraint",
    [
        "A1v(t2) == 2",
        "A1v(t2) == 1.2",  # within the loose tolerance
        "A1(t2) < A0(t1)",  # who comes first is seen by driving
        "A1(t2) < A0(t1) and A1v(t2) == 2",
        "A1(t2) < A0(t1) or A1v(t2) == 7",
        "A0v(t2) == 3",  # nobody foresees when that is
        "A0v(t1) == 3",  # nor that
        "A0(t1) == A1(t1)",
    ],
)
def test_what_holds_or_cannot_be_told_is_not(constraint: str) -> None:
    assert told(f"probe: {constraint}\n") == []


@pytest.mark.parametrize(
    ("told_there", "asked"),
    [
        ("A0(t1) == A1(t1)\nA1x(t1) == 140", False),  # the hero comes there when the ego is so slow
        ("A0(t1) == A1(t2)\nA1(t2) - A1(t1) >= 1", False),
        ("A0(t1) - A1(t2) == 1", False),
        ("A0(t1) == A1(t1)\nA0x(t1) == 140", True),
        ("A0(t1) == A1(t1)\nA1(t1) == 4", True),
        ("A1(t1) == 3\nA0(t1) - A1(t1) == 1", True),
    ],
)
def test_how_fast_the_ego_is_at_a_moment_is_asked_of_a_plan_where_something_else_tells_that_moment(
    told_there: str, asked: bool
) -> None:
    found = [each for each in told(f"{told_there}\nprobe: A0v(t1) == 3\n") if each.constraint.id == "probe"]
    assert bool(found) is asked


def test_knots_of_the_ego_are_when_it_passes_their_places() -> None:
    places = "A0x(t1) == conflict_point - {}\nA0(t2) - A0(t1) == 2 s\n"
    scene = scene_with(places.format(30))
    place_m = scene.landmark_m(0, "conflict_point", None) - 30
    assert place_m > 130
    profiles = driven(scene)
    ego = Profile(chain(0.0, place_m - 20.0, 10.0, [(8.0, 0.0, 0)]), {"t0": 0.0, "t1": 4.0, "t2": 4.0})
    assert list(not_held(scene, {**profiles, 0: ego}, dimension_of, LOOSE.of)) == [], (
        "it is there after 2 s, and t2 is 4 s"
    )
    late = Profile(ego.segments, {"t0": 0.0, "t1": 4.0, "t2": 7.0})
    (found,) = not_held(scene, {**profiles, 0: late}, dimension_of, LOOSE.of)
    assert found.by == pytest.approx(3.0, abs=1e-6)


def test_what_has_no_number_is_told_without_one() -> None:
    (found,) = told("probe: not (A1v(t1) == 10)\n")
    assert math.isinf(found.by)
    assert "off by" not in str(found)


def test_nothing_is_driven_where_a_plan_breaks_what_nobody_plans() -> None:
    request = Request(UNPLANNED, ego="constant")
    result = orchestrate(request)
    assert result.status == "gave up"
    assert [each.constraint.id for each in result.not_held] == [PROBE]
    assert result.run is None
    assert orchestrate(request, until="check").status == "gave up"


def test_an_example_is_held() -> None:
    scene = YIELDS.scene()
    assert limits_of(scene)
    result = orchestrate(Request(YIELDS.text, YIELDS.parameters, ego="constant"), until="plan")
    assert result.attempt is not None
    assert result.not_held == ()


def test_what_is_of_the_ego_alone_is_asked_of_one_that_keeps_its_promise() -> None:
    scene = scene_with("A0(t1) == A1(t1)\nA1(t1) == 4\nprobe: A0v(t1) == 3\n")
    for promised in (True, False):
        found = list(not_held(scene, driven(scene), dimension_of, LOOSE.of, ego_promised=promised))
        assert bool(found) is promised


def test_what_lasts_beside_the_ego_is_seen_by_driving() -> None:
    assert told("probe: always[A0(t0), A0(t1)] (A0v - A1v >= 3)\n") == []
    assert told("probe: always[A0(t0), A0(t1)] (A1v >= 12)\n") != []
