"""First guesses: who is told a place at its trigger is there, evenly; whether that is so of all is told."""

from __future__ import annotations

import pytest
from many_heroes import PROGRAMS
from situations import planner_of, scene_of

from scenewright.motion.profile import Profile, chain
from scenewright.plan.guesses import JOINT_S, even_motions, meet_later
from scenewright.program.structure import read_structure
from scenewright.program.types import EGO
from scenewright.solve.proofs.witness import Witness
from stories import program

JOINT = program(
    "W",
    "t0, go, t1, dec, t2",
    """
A0(t1) == A1(t1)
gap(A0, A1, t1) == 20
A1v(t2) == 0
""",
)


@pytest.mark.parametrize("program", ["platoon", "crossing", "chain", "mixed"])
def test_each_comes_evenly_to_where_its_trigger_wants_it(program: str) -> None:
    planner = planner_of(scene_of(PROGRAMS[program](4)))
    ego = Profile(chain(0.0, 20.0, 12.0, [(60.0, 0.0, 0)]))
    for pace in (0.25, 0.8):
        found, told = even_motions(planner._asked, planner._times, ego, None, pace)
        assert told
        motions = {**found, EGO: ego}
        for hero in planner.scene.program.heroes:
            natural_mps = planner.limits[hero.id].natural_approach_speed_mps
            assert found[hero.id].state(3.0)[1:] == pytest.approx((pace * natural_mps, 0.0))
            if hero.id in planner._times.sides:
                at_s = planner._times.instant_s(hero, 0.0, ego, None)
                instant = planner.structure.triggers[hero.id]
                here = [c for c in planner.conditions if c.moments <= instant and hero.id in c.weights]
                assert here
                states = {actor: motions[actor].state(at_s)[:2] for actor in motions}
                assert [c.value(states) for c in here] == pytest.approx([0.0] * len(here), abs=1e-6)


def test_who_decides_too_when_its_trigger_comes_is_guessed_to_come_in_a_few_seconds() -> None:
    planner = planner_of(scene_of(JOINT))
    ego = Profile(chain(0.0, 20.0, 12.0, [(60.0, 0.0, 0)]))
    found, told = even_motions(planner._asked, planner._times, ego, None, 0.5)
    assert not told
    assert found[1].state(JOINT_S)[0] + planner.scene.offset_m(EGO, 1) - ego.state(JOINT_S)[0] == pytest.approx(20.0)


@pytest.mark.parametrize(("text", "later"), [(JOINT, False), (PROGRAMS["mixed"](4), False)])
def test_whether_heroes_are_told_to_meet_later(text: str, later: bool) -> None:
    program = scene_of(text).program
    assert meet_later(program, read_structure(program)) is later


def test_two_that_are_at_places_at_one_moment_after_their_triggers_meet_later() -> None:
    program = scene_of(
        PROGRAMS["crossing"](2) + "A1(t2) == A2(t2)\nA1x(t2) == stop_line\nA2x(t2) == stop_line\n"
    ).program
    assert meet_later(program, read_structure(program))


def test_where_no_condition_tells_a_place_it_is_as_far_from_the_ego_as_in_a_witness() -> None:
    text = program("W", "t0, go, t1", "A0x(t1) == stop_line - 10\nalways[A0(t0), A0(t1)] (gap(A1, A0) <= 20)")
    planner = planner_of(scene_of(text))
    ego = Profile(chain(0.0, 60.0, 12.0, [(60.0, 0.0, 0)]))
    moves = {EGO: Profile(chain(0.0, 100.0, 9.0, [(9.0, 0.0, 0)])), 1: Profile(chain(0.0, 83.0, 9.0, [(9.0, 0.0, 0)]))}
    found, told = even_motions(planner._asked, planner._times, ego, Witness(moves, {}, {}, 9.0), 0.5)
    assert not told
    assert found[1].state(0.0)[0] == pytest.approx(60.0 - 17.0)
