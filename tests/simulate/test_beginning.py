"""How a run begins: of the ego's possible starts the first from which the heroes do what was asked."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

import pytest

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.judge.tolerance import TIGHT
from scenewright.motion.profile import Profile, chain
from scenewright.orchestrate import begin, orchestrate
from scenewright.plan.prediction import Rehearsed
from scenewright.program.starts import HARD_MPSS
from scenewright.program.types import EGO
from scenewright.request import Request, Stages
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.conflicts import shared_offset_m
from scenewright.simulate import beginning
from scenewright.simulate.beginning import first_plan, first_states, is_timed_by_ego
from scenewright.simulate.ego_start import EgoFirstState, ego_starts
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions
from stories import BRAKES_GAP, GOES_FIRST_TIME, STOPS_AND_GOES, YIELDS_DISTANCE, YIELDS_TIME, program

pytestmark = pytest.mark.usefixtures("replanned_seldom")

# Only an ego that comes slowly leaves the hero the time to be first.
IN_TIME = program(
    "E, N",
    "t0, go, t1, acc, t2",
    """
A0x(t0) == intersection - 80
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 22
A1x(t1) == conflict_point - 14
A1x(t2) == turn_end
A0x(t2) == conflict_point
A1(t2) < A0(t2)
""",
)
# Against an ego that is about to arrive everyday distances leave the hero no time to be first.
LEFT_OPEN = IN_TIME.replace("point - 22", "point - ego_m").replace("point - 14", "point - hero_m")
# With 3 s for both the ego gives way to the hero, and stands.
GIVES_WAY = program(
    "W",
    "t0, go, t1, acc, t2",
    """
tta(A0, intersection, t0) == 8
A0(t1) == A1(t1)
tta(A0, conflict_point, t1) == ego_s
tta(A1, conflict_point, t1) == hero_s
A1x(t2) == conflict_point
A0x(t2) == turn_start
A1(t2) < A0(t2)
""",
    ego_route="E, N",
)


def world_of(text: str, ego: str = "constant") -> World:
    world, _, answer = begin(Request(text, ego=ego), Stages(None))
    assert answer == "feasible"
    return world


def starts_of(world: World) -> list[float]:
    conditions = linear_conditions(world.scene, world.structure)
    return [start.speed_mps for start in ego_starts(world.scene, world.ego, world.limits[EGO], conditions)]


@pytest.mark.parametrize("ego", ["constant", "idm", "dawdler"])
def test_the_first_start_that_does_is_taken(ego: str) -> None:
    world = world_of(YIELDS_DISTANCE, ego)
    found = first_plan(world)
    assert found is not None
    planner, start, attempt = found
    assert attempt.is_good
    assert attempt.promises_outcome
    assert start.speed_mps == pytest.approx(starts_of(world)[0])
    assert planner.plan is attempt.plan
    assert [record.time_s for record in planner.records] == [0.0]
    ego_motion = attempt.plan.profiles[EGO]
    assert ego_motion.state(0.0)[:2] == pytest.approx((start.s_m, start.speed_mps))


@pytest.mark.parametrize("holds_speed", [True, False])
def test_nobody_is_started_faster_than_it_promises_to_drive(holds_speed: bool) -> None:
    world = world_of(YIELDS_DISTANCE, f"misbehaving:Modest:most_mps=6,holds_speed={'yes' if holds_speed else 'no'}")
    assert all(start.speed_mps <= 6.0 for start in first_states(world))


@pytest.mark.parametrize("ego", ["constant", "idm", "staller"])
def test_values_that_were_left_open_are_such_that_a_plan_does_what_is_asked(ego: str) -> None:
    world = world_of(LEFT_OPEN, ego)
    found = first_plan(world)
    assert found is not None
    assert (found[2].is_good, found[2].promises_outcome) == (True, True)
    values = world.scene.parameters
    assert {name: (100 * value).denominator for name, value in values.items()} == {"ego_m": 1, "hero_m": 1}
    assert world.planned.parameters == found[0].scene.parameters == values
    fixed = "".join(f" -p {name}={float(value)}" for name, value in values.items())
    as_given = orchestrate(Request(LEFT_OPEN, parameters={k: float(v) for k, v in values.items()}, ego=ego))
    assert as_given.status == "success", fixed


def test_a_value_that_was_given_is_never_another() -> None:
    world, _, _ = begin(Request(LEFT_OPEN, parameters={"hero_m": 16.0}, ego="idm"), Stages(None))
    first_plan(world, anew=True)
    assert world.scene.parameters["hero_m"] == 16
    assert "ego_m" in world.scene.parameters
    given = {"hero_m": 14.0, "ego_m": 22.0}  # as above, where a slow ego is the only way
    world, _, _ = begin(Request(LEFT_OPEN, parameters=given, ego="constant"), Stages(None))
    first_plan(world, anew=True)
    assert world.scene.parameters == given


def test_whoever_stops_the_search_for_values_has_those_that_were_driven(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    world = world_of(LEFT_OPEN, "idm")
    before = world.scene
    monkeypatch.setattr(beginning, "rounded", interrupt)
    with pytest.raises(KeyboardInterrupt):
        first_plan(world, anew=True)
    assert world.scene == before


def test_values_that_missed_though_a_plan_promised_them_are_others_in_the_next_take() -> None:
    first, result = (orchestrate(Request(GIVES_WAY, ego="idm", takes=takes)) for takes in (1, 3))
    assert (first.status, result.status) == ("failure", "success")
    assert result.take > 1
    assert result.scene.parameters != first.scene.parameters
    assert result.scene.parameters["ego_s"] > result.scene.parameters["hero_s"]


def test_an_ego_that_would_leave_no_time_starts_more_slowly() -> None:
    world = world_of(IN_TIME)
    found = first_plan(world)
    assert found is not None
    _, start, attempt = found
    assert attempt.promises_outcome
    assert start.speed_mps < starts_of(world)[0] - 0.1


@pytest.mark.parametrize("slower_than_mps", [8.0, 5.0])
def test_it_starts_slower_than_it_must(slower_than_mps: float) -> None:
    world = world_of(YIELDS_DISTANCE)
    found = first_plan(world, None, slower_than_mps)
    assert found is not None
    assert found[1].speed_mps < slower_than_mps


def test_where_it_cannot_start_so_slowly_there_is_no_plan() -> None:
    world = world_of(YIELDS_DISTANCE)
    assert first_plan(world, None, slower_than_mps=0.0) is None
    assert first_plan(world, None, slower_than_mps=math.inf) is not None


@pytest.mark.parametrize(
    ("text", "timed"),
    [
        (YIELDS_DISTANCE, False),
        (YIELDS_TIME, True),
        (STOPS_AND_GOES, False),
        (GOES_FIRST_TIME, True),
        (BRAKES_GAP, False),
    ],
)
def test_whether_a_trigger_waits_for_the_time_of_the_ego(text: str, timed: bool) -> None:
    assert is_timed_by_ego(world_of(text)) is timed


def test_nobody_starts_where_only_hard_braking_saves_it() -> None:
    """The time to collision that is asked for would be there at once if the ego began behind a slow truck, too near."""
    text = (
        "The ego drives westbound along the road. A truck drives ahead of it in the same lane. "
        "When the TTC is 2.5 s, the truck brakes at 4 m/s^2 to a standstill."
    )
    result = orchestrate(Request(text, ego="idm", takes=1, replan_hz=2.0))
    assert result.run is not None
    ego, truck = (result.run.trace.actors[name] for name in ("ego", "truck"))
    offset_m = shared_offset_m(result.scene.routes[EGO], result.scene.routes[1])
    assert offset_m is not None
    room_m = float(truck.s_m[0] + offset_m - ego.s_m[0]) - VEHICLE_LENGTH_M
    closing_mps = max(0.0, float(ego.speed_mps[0] - truck.speed_mps[0]))
    assert closing_mps**2 / (2.0 * (room_m - closing_mps)) < 3.0, "who reacts within a second can brake evenly"
    assert result.verdict is not None
    assert result.verdict.condition("start").holds_at(TIGHT)
    assert result.status == "success" or result.verdict.cause is not None


TAILS = program(
    "W",
    "t0, go, t1, dec, t2",
    """
A0(t1) == A1(t1)
headway(A0, A1, t1) == 1.2 s
A1a(dec) == -3 m/s^2
A1v(t2) == 0
{asked}
""",
)


def at_once_mpss(asked: str, ego_name: str = "idm") -> float:
    """Return how hard the ego has braked by the first second of a run in which it is to follow closely."""
    result = orchestrate(Request(TAILS.format(asked=asked), ego=ego_name, takes=1, explain="nothing", replan_hz=2.0))
    assert result.run is not None
    ego = result.run.trace.actors["ego"]
    return -float(ego.accel_mps2[ego.time_s < 1.0].min())


def test_an_ego_that_would_brake_hard_begins_further_behind() -> None:
    """Planned from anywhere, it begins 1.5 m behind the other: the headway is met as it grows.

    It acts on what it saw a while ago, and so brakes a while later than the one above, which acts at once.
    """
    assert at_once_mpss("", "delayed") < HARD_MPSS


def test_an_ego_that_brakes_hard_for_somebody_further_off_begins_further_behind_too(shared_dir: Path) -> None:
    """On a motorway: with 30.6 m/s it began 44 m behind one of 16.5 m/s, under 8 m/s^2 of braking."""
    way = "- lanes 1.0.1, 0.2.1, 0.1.1, 0.0.1\n"
    text = program("W", "t0, go, t1, dec, t2", "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 30\nA1v(t2) == 3\n")
    text = f'map "{shared_dir / "maps/esmini/highway_exit.xodr"}"\n' + text.replace("- W\n", way)
    result = orchestrate(Request(text, ego="idm", takes=1, explain="nothing"))
    assert result.status == "success"
    assert result.run is not None
    ego = result.run.trace.actors["ego"]
    assert ego.accel_mps2[ego.time_s < 1.0].min() > -HARD_MPSS


def test_who_is_asked_to_begin_near_does() -> None:
    asked = TAILS.format(asked="headway(A0, A1, t0) == 0.3 s")
    result = orchestrate(Request(asked, ego="idm", takes=1, explain="nothing"))
    assert result.verdict is not None
    near = [condition for condition in result.verdict.conditions if condition.kind == "initial"]
    assert [condition.required for condition in near] == [pytest.approx(0.3)]
    assert all(condition.holds_at(TIGHT) for condition in (*near, result.verdict.condition("start")))


def test_when_the_steps_are_spent_only_last_resorts_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    world, tried, plan_from = world_of(IN_TIME), list[EgoFirstState](), beginning._plan_from

    def noted(world: World, start: EgoFirstState, *how: Any) -> beginning._Planned:
        tried.append(start)
        return plan_from(world, start, *how)

    monkeypatch.setattr(beginning, "_plan_from", noted)
    first_plan(world)
    assert len(tried) > 2
    assert not any(start.last_resort for start in tried)
    tried.clear()
    monkeypatch.setattr(beginning, "_MOST_STEPS", 0)
    first_plan(world)
    assert [start.last_resort for start in tried[1:]] == [True] * (len(tried) - 1)


@pytest.mark.parametrize("ego", ["constant", "idm"])
def test_an_ego_that_only_a_hero_places_begins_as_it_drives_by_itself(ego: str) -> None:
    """Where it would begin else, the other has long been past its place; in some motion or other it has 34 m/s."""
    asked = "gap(A0, A1, A1(t0)) == 45\nA1v(t0) == 11\nA0(t1) == A1(t1)\nA1x(t1) == 119\nA1v(t2) >= A1v(t1) + 2\n"
    text = program("W", "t0, go, t1, acc, t2", asked)
    result = orchestrate(Request(text, ego=ego, takes=1, explain="nothing"))
    assert result.status == "success"
    assert result.run is not None
    assert result.run.trace.actors["ego"].speed_mps[0] == pytest.approx(13.9, abs=0.1)


def test_no_plan_has_a_hero_pass_through_the_ego() -> None:
    """It begins 57 m along its road and is to be ahead: an ego that began at its usual place would be in its way."""
    asked = "A1x(t0) == 57\nA0(t1) == A1(t1)\nheadway(A0, A1, t1) == 2.5\nA1v(t2) == 3\n"
    world = world_of(program("W", "t0, go, t1, dec, t2", asked), "constant")
    planned = first_plan(world)
    assert planned is not None
    assert planned[2].is_good
    assert planned[1].s_m < 57.0 - VEHICLE_LENGTH_M


@pytest.mark.parametrize("ego", ["constant", "idm"])
def test_who_acts_by_the_clock_does_not_run_into_an_ego_that_turns(ego: str) -> None:
    """Nothing of the ego is in what it is to do: it came from behind, and drove through the ego after 4 s."""
    asked = "A1(t1) - A1(t0) == 7\nA1v(t2) >= A1v(t1) + 2\n"
    text = program("E", "t0, go, t1, acc, t2", asked, ego_route="E, N")
    assert orchestrate(Request(text, ego=ego, takes=1, explain="nothing")).status == "success"


@pytest.mark.parametrize("ego", ["idm", "noisy"])
def test_an_ego_that_nothing_places_begins_so_far_back_that_the_outcome_can_come_about(ego: str) -> None:
    """By the clock a hero brakes, and then passes before the ego: where that is until then is nobody's business."""
    rest = (
        "A1(t1) == 6\nA1x(t1) == conflict_point - 40\nA1v(t1) == 9\nA1a(dec) == -2.5\nA1v(t2) == 4\n"
        "A1x(t3) == conflict_point\nA0x(t1) == conflict_point\nA0(t1) - A1(t3) >= 1"
    )
    actors = "Actor 0 (ego):\n- W\n- [t0, go, t1]\n\nActor 1 (hero):\n- E, N\n- [t0, go, t1, dec, t2, acc, t3]\n"
    text = f'scenario "by the clock"\n{actors}\nConstraints:\n{rest}'
    result = orchestrate(Request(text, ego=ego, takes=1))
    assert result.status == "success"


def test_the_ego_begins_in_nobodys_place() -> None:
    """Its road begins so near that whoever comes behind would begin in the place of an ego of natural speed."""
    text = program(
        "W",
        "t0, go, t1, dec, t2",
        "A0(t1) == A1(t1)\nA0x(t1) == stop_line - 200\nA1x(t1) == stop_line - 235\nA1v(t2) == 3",
    )
    world = world_of(text)
    planned = first_plan(world)
    assert planned is not None
    planner, start, attempt = planned
    behind_m = start.s_m - planner.plan.profiles[1].state(0.0)[0]
    assert attempt.is_good
    assert behind_m > VEHICLE_LENGTH_M


def test_no_trigger_comes_before_what_is_to_be_seen_before_it() -> None:
    """21.5 s before its line an ego that drives as people there do is where its road begins."""
    asked = "A0(t1) == A1(t1)\ntta(A0, stop_line, t1) == 21.5\nA1x(t1) == conflict_point - 18\nA1v(t2) == 0\n"
    world = world_of(program("E, N", "t0, go, t1, dec, t2", asked))
    found = first_plan(world)
    assert found is not None
    assert found[2].plan.profiles[1].knot_times_s["t1"] >= 0.5


class Chancy:
    """Holds its speed for some seconds, and brakes then: another number of them each time."""

    seconds = itertools.count(2)

    def __init__(self, repeats: bool = False) -> None:
        self.repeats = repeats

    def reset(self, start: EgoStart) -> None:
        self.brakes_s = 3 if self.repeats else next(self.seconds)

    def step(self, observation: Observation, dt_s: float) -> float:
        return -2.0 if observation.time_s > self.brakes_s else 0.0


@pytest.mark.parametrize(
    ("ego", "known"),
    [("constant", False), ("idm", True), ("staller", True), ("Chancy", False), ("Chancy:repeats=true", True)],
)
def test_an_ego_is_foreseen_by_a_drive_alone_only_if_it_drives_alike_each_time(ego: str, known: bool) -> None:
    world = world_of(YIELDS_DISTANCE, f"{__name__}:{ego}" if ego.startswith("Chancy") else ego)
    start = EgoFirstState(220.0, 9.0)
    alone, behind, signs = beginning._foreseen(world, start, None)
    assert behind is world.predictor
    if ego == "Chancy:repeats=true":
        assert signs.at_mps(250.0) == pytest.approx(9.0), "what it drives, not what is posted"
    assert isinstance(alone, Rehearsed) is known
    if "repeats" in ego:
        assert alone.predict([(0.0, 220.0, 9.0, 0.0)]).state(5.0)[1] == pytest.approx(5.0, abs=0.1)
    drive = Profile(chain(0.0, 220.0, 9.0, [(1.0, 0.0, 0)]))
    assert [each.drive for each in beginning._foreseen(world, start, drive) if isinstance(each, Rehearsed)] == [
        drive
    ] * 2


@pytest.mark.parametrize(
    ("asked", "low_mps", "high_mps"),
    [("A0v(2.0) == 7", 6.75, 7.25), ("A0v(t1) <= 5", 0.5, 5.25), ("always[0, A0(t1)] (A0v >= 11)", 10.75, 15.0)],
)
def test_an_ego_that_holds_its_speed_starts_as_fast_as_it_is_to_be_at_any_moment(
    asked: str, low_mps: float, high_mps: float
) -> None:
    trigger = "A0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\nA1x(t1) == conflict_point - 25\nA1v(t2) == 0\n"
    world = world_of(program("W", "t0, go, t1, dec, t2", trigger + asked + "\n"), "constant")
    world.choose_and_check()
    found = first_plan(world)
    assert found is not None
    assert found[2].is_good
    assert low_mps <= found[1].speed_mps <= high_mps


@pytest.mark.parametrize(("beyond_m", "before_m"), [(3, 30), (12, 45), (25, 60)])
def test_nobody_begins_within_a_junction(beyond_m: int, before_m: int) -> None:
    """Without that the nearest plans begin 4 to 17 m inside."""
    asked = f"A0x(t0) == intersection - {before_m + 20}\nA0(t1) == A1(t1)\nA0x(t1) == intersection - 20\n"
    asked += f"A1x(t1) == junction_end + {beyond_m}\nA1v(t2) == 0\n"
    world, _, _ = begin(Request(program("E", "t0, go, t1, dec, t2", asked), ego="constant"), Stages(None))
    planned = first_plan(world)
    assert planned is not None
    begins_m, marks = planned[0].plan.profiles[1].state(0.0)[0], world.scene.landmarks_m[1]
    assert planned[2].is_good
    assert not marks["junction_start"] + 0.5 < begins_m < marks["junction_end"]
