"""Where the ego starts: what the program says is met exactly, and the rest is what its policy would do by itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.loading import load_policy
from scenewright.drive.protocol import EgoPolicy, EgoStart, Observation
from scenewright.orchestrate import orchestrate
from scenewright.request import Request
from scenewright.simulate.ego_start import EgoFirstState, drives_alone, ego_starts, usual_lead_s
from stories import Stage, program

REST = """
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 18
A1x(t2) == conflict_point - 6
A1v(t2) == 0
"""
EGOS = ["constant", "idm", "dawdler", "noisy"]


def stage(initial: str, ego: str | EgoPolicy) -> Stage:
    policy = load_policy(ego).policy if isinstance(ego, str) else ego
    return Stage(program("E, N", "t0, go, t1, dec, t2", initial + REST), policy)


def starts(on: Stage) -> list[EgoFirstState]:
    return list(ego_starts(on.scene, on.ego, on.limits[0], on.conditions))


@pytest.mark.parametrize("ego", EGOS)
def test_given_place(ego: str) -> None:
    on = stage("A0x(t0) == intersection - 90", ego)
    found = starts(on)
    assert found
    for start in found:
        assert start.s_m == pytest.approx(on.scene.landmarks_m[0]["intersection"] - 90.0)
        assert 0.0 < start.speed_mps <= on.limits[0].speed_max_mps


@pytest.mark.parametrize("ego", EGOS)
def test_given_speed_leaves_no_choice(ego: str) -> None:
    on = stage("A0v(t0) == 7", ego)
    (start,) = starts(on)
    assert start.speed_mps == pytest.approx(7.0)
    trigger_m = on.scene.landmarks_m[0]["conflict_point"] - 30.0
    assert trigger_m - start.s_m > 2.0 * start.speed_mps, "the trigger does not come at once"
    if ego == "idm":
        assert start.accel_mpss > 0.5, "slower than it wishes, it is known to speed up from the first moment on"


@pytest.mark.parametrize("ego", EGOS)
@pytest.mark.parametrize(
    ("bound", "least", "most"),
    [
        ("A0v(t0) <= 6", (0, 0), (999, 6)),
        ("A0v(t0) >= 15", (0, 15), (999, 60)),
        ("always[A0(t0), A0(t1)] (A0v >= 9 and A0v <= 11)", (0, 9), (999, 11)),
        ("A0x(t0) <= 90", (0, 0), (90, 60)),
        ("A0x(t0) >= 240", (240, 0), (999, 60)),
        ("A0x(t0) >= 120\nA0x(t0) <= 125", (120, 0), (125, 60)),
    ],
)
def test_it_begins_within_the_bounds_that_are_told(
    ego: str, bound: str, least: tuple[float, float], most: tuple[float, float]
) -> None:
    found = starts(stage(bound, ego))
    assert found
    for start in found:
        assert least[0] <= start.s_m <= most[0]
        assert least[1] <= start.speed_mps <= most[1]
    assert len({(start.s_m, start.speed_mps) for start in found}) == len(found)


def test_given_place_and_speed() -> None:
    on = stage("A0x(t0) == intersection - 60\nA0v(t0) == 25 km/h", "idm")
    (start,) = starts(on)
    assert start.s_m == pytest.approx(on.scene.landmarks_m[0]["intersection"] - 60.0)
    assert start.speed_mps == pytest.approx(25 / 3.6)


@pytest.mark.parametrize("ego", EGOS)
def test_given_time_to_arrival(ego: str) -> None:
    on = stage("tta(A0, intersection, t0) == 8", ego)
    for start in starts(on):
        distance_m = on.scene.landmarks_m[0]["intersection"] - start.s_m
        assert distance_m / start.speed_mps == pytest.approx(8.0, abs=1e-4)


@pytest.mark.parametrize("ego", EGOS)
def test_free_start_lies_well_before_the_trigger(ego: str) -> None:
    on = stage("", ego)
    trigger_m = on.scene.landmarks_m[0]["conflict_point"] - 30.0
    for start in starts(on):
        assert start.s_m >= 1.0
        assert (trigger_m - start.s_m) / start.speed_mps > 2.0


@pytest.mark.parametrize("ego", ["idm", "dawdler", "stop-and-go", "staller"])
@pytest.mark.parametrize("initial", ["", "A0x(t0) == intersection - 90", "tta(A0, intersection, t0) == 8"])
def test_ego_goes_on_as_it_starts(ego: str, initial: str) -> None:
    on = stage(initial, ego)
    start = starts(on)[0]
    on.ego.reset(start.s_m, start.speed_mps)
    for step in range(25):
        on.ego.advance(on.ego.decide(0.02 * step, (), 0.02), 0.02)
        assert on.ego.state.speed_mps == pytest.approx(start.speed_mps + 0.02 * (step + 1) * start.accel_mpss, abs=0.15)


def test_constant_tries_natural_speeds_first() -> None:
    on = stage("A0x(t0) == intersection - 90", "constant")
    speeds = [start.speed_mps for start in starts(on)]
    natural, fastest = on.limits[0].natural_turn_speed_mps, on.limits[0].turn_speed_max_mps
    assert speeds[0] == pytest.approx(natural)
    slower = [speed for speed in speeds if speed <= natural]
    assert speeds[: len(slower)] == sorted(slower, reverse=True)
    assert len(slower) > 5
    assert all(natural < speed <= fastest for speed in speeds[len(slower) :])


def test_constant_with_a_speed_of_its_own_keeps_it() -> None:
    on = stage("A0x(t0) == intersection - 90", "constant:speed_mps=6.5")
    (start,) = starts(on)
    assert start.speed_mps == pytest.approx(6.5)


def test_speed_that_a_policy_prefers_is_taken() -> None:
    class Tractor:
        def preferred_speed_mps(self, start: object) -> float:
            return 5.5

        def reset(self, start: object) -> None:
            pass

        def step(self, observation: object, dt_s: float) -> float:
            return 0.0

    on = stage("A0x(t0) == intersection - 90", Tractor())
    assert isinstance(on.ego.policy, GuardedPolicy)
    start = starts(on)[0]
    assert start.speed_mps == pytest.approx(5.5)
    assert start.s_m == pytest.approx(on.scene.landmarks_m[0]["intersection"] - 90.0)


def test_policy_that_never_gets_to_its_place_still_starts_there() -> None:
    class Parked:
        def reset(self, start: object) -> None:
            pass

        def step(self, observation: object, dt_s: float) -> float:
            return -9.0

    on = stage("A0x(t0) == intersection - 90", Parked())
    start = starts(on)[0]
    assert start.s_m == pytest.approx(on.scene.landmarks_m[0]["intersection"] - 90.0)
    assert start.speed_mps > 0.0


@pytest.mark.parametrize("initial", ["A0x(t0) == intersection - 90", "tta(A0, intersection, t0) == 8", ""])
def test_slower_states_come_by_choice_after_what_the_policy_holds(initial: str) -> None:
    on = stage(initial, "idm")
    held, *slower = starts(on)
    assert len(slower) > 1
    speeds = [start.speed_mps for start in (held, *slower)]
    assert speeds == sorted(speeds, reverse=True)
    for start in slower:
        assert start.accel_mpss > 0.5, "from there it speeds up, and the planner is told"
        if initial.startswith("tta"):
            assert (on.scene.landmarks_m[0]["intersection"] - start.s_m) / start.speed_mps == pytest.approx(
                8.0, abs=1e-4
            )


@pytest.mark.parametrize("ego", [*EGOS, "stop-and-go"])
@pytest.mark.parametrize("at_s", [2, 5, 15])
def test_an_ego_starts_so_that_alone_it_comes_to_its_place_when_the_program_says(ego: str, at_s: int) -> None:
    on = stage(f"A1(t1) == {at_s}", ego)
    place_m = on.scene.landmarks_m[0]["conflict_point"] - 30.0
    for start in starts(on)[:2]:
        on.ego.reset(start.s_m, start.speed_mps)
        for step in range(20 * at_s):
            on.ego.advance(on.ego.decide(0.05 * step, (), 0.05), 0.05)
        assert on.ego.state.s_m == pytest.approx(place_m, abs=0.1)


@pytest.mark.parametrize(("told", "low_s", "high_s"), [("A1(t1) <= 4", 3.5, 4.5), ("A1(t1) >= 11", 10.0, 12.0)])
def test_a_bound_on_the_time_of_the_trigger_moves_the_start(told: str, low_s: float, high_s: float) -> None:
    on = stage(told, "constant")
    start = starts(on)[0]
    way_m = on.scene.landmarks_m[0]["conflict_point"] - 30.0 - start.s_m
    assert low_s <= way_m / start.speed_mps <= high_s


@pytest.mark.parametrize("lines", ["A0x(A1(t1)) == stop_line - 80", "gap(A0, A1, t1) == 30\nA1x(t1) == stop_line - 50"])
def test_an_ego_whose_place_another_one_tells_begins_well_before_it(lines: str) -> None:
    text = program("W", "t0, go, t1, dec, t2", f"A0(t1) == A1(t1)\n{lines}\nA0x(t2) == stop_line - 20\nA1v(t2) == 2")
    result = orchestrate(Request(text, ego="constant", takes=1))
    assert result.status == "success"
    assert result.verdict is not None
    assert result.verdict.facts["trigger_time_s"]["hero"] == pytest.approx(8.0, abs=0.1)


def test_a_road_without_a_junction_leaves_room_before_its_end(shared_dir: Path) -> None:
    """Two on one way meet nowhere on it: where it ends there is no room for what they are to do."""
    on = Stage(
        f'map "{shared_dir / "maps/ncap/StraightRoad_NCAP.xodr"}"\n'
        + program("E", "t0, go, t1, dec, t2", "A0(t1) == A1(t1)\ngap(A0, A1, t1) == 30\nA1v(t2) == 0", ego_route="E"),
        load_policy("constant").policy,
    )
    assert all(start.s_m < 750.0 for start in starts(on))


@pytest.mark.parametrize("begins_mps", [None, 9.0])
@pytest.mark.parametrize("way_m", [5.0, 15.0, 30.0, 100.0])
def test_nobody_waits_for_the_ego_to_come_where_its_own_way_is_short(way_m: float, begins_mps: float | None) -> None:
    told = f"A1x(t0) == conflict_point - 18 - {way_m}\n" + (f"A1v(t0) == {begins_mps}\n" if begins_mps else "")
    on = stage(told, "constant")
    lead_s = usual_lead_s(on.scene, on.structure, on.limits, on.conditions)
    usual_mps = begins_mps or on.limits[1].natural_turn_speed_mps
    assert lead_s == pytest.approx(min(8.0, max(1.0, way_m / usual_mps)))
    ego, lands = next(ego_starts(on.scene, on.ego, on.limits[0], on.conditions, lead_s)), on.scene.landmarks_m[0]
    assert (lands["conflict_point"] - 30.0 - ego.s_m) / ego.speed_mps == pytest.approx(lead_s, abs=1e-4)


@pytest.mark.parametrize("way_m", [150.0, 180.0])
def test_who_begins_far_off_has_the_time_that_its_way_takes(way_m: float) -> None:
    on = stage(f"A1x(t0) == conflict_point - 18 - {way_m}", "constant")
    lead_s = usual_lead_s(on.scene, on.structure, on.limits, on.conditions)
    assert lead_s == pytest.approx(way_m / on.limits[1].natural_approach_speed_mps)
    assert lead_s > 8.0


def test_who_is_to_stand_until_its_trigger_has_all_the_time() -> None:
    text = program("E, N", "t0, stop, t1, acc, t2", REST.replace("A1v(t2) == 0", "A1v(t2) == 5"))
    on = Stage(text, load_policy("constant").policy)
    assert usual_lead_s(on.scene, on.structure, on.limits, on.conditions) == 8.0


@pytest.mark.parametrize("ego", ["idm", "stop-and-go", "noisy"])
def test_a_drive_alone_is_what_the_policy_does_with_nobody_there(ego: str) -> None:
    on = stage("A0x(t0) == intersection - 90", ego)
    start = starts(on)[0]
    alone = drives_alone(on.ego, start, 0.02)
    assert alone.state(0.0)[:2] == pytest.approx((start.s_m, start.speed_mps))
    on.ego.reset(start.s_m, start.speed_mps)
    for step in range(400):
        on.ego.advance(on.ego.decide(step * 0.02, (), 0.02), 0.02)
    assert alone.state(8.0)[:2] == pytest.approx((on.ego.state.s_m, on.ego.state.speed_mps), abs=0.02)
    assert alone.end_s <= 40.0


class Fails:
    """Holds its speed, and fails after three seconds."""

    def reset(self, start: EgoStart) -> None:
        """Begin."""

    def step(self, observation: Observation, dt_s: float) -> float:
        if observation.time_s > 3.0:
            raise RuntimeError("lost")
        return 0.0


def test_a_drive_alone_ends_where_the_policy_fails() -> None:
    on = stage("A0x(t0) == intersection - 90", Fails())
    alone = drives_alone(on.ego, EgoFirstState(200.0, 8.0), 0.02)
    assert alone.end_s == pytest.approx(3.0, abs=0.11)
    assert alone.state(2.0)[:2] == pytest.approx((216.0, 8.0))


def test_an_ego_that_has_to_slow_down_to_be_so_long_from_a_place_starts_at_last() -> None:
    """It is 20 s from it as it starts and is to be 25 s: a fault of ours, once, where no other start was left."""
    initial = "tta(A0, intersection, t0) == 20\nA0v(t0) == 4"
    text = f"{initial}\nA0(t1) == A1(t1)\ntta(A0, intersection, t1) == 25\nA1x(t1) == conflict_point - 18\nA1v(t2) == 0"
    story = program("E, N", "t0, go, t1, dec, t2", text)
    (start,) = starts(Stage(story, load_policy("idm").policy))
    assert start.last_resort
    assert start.speed_mps == pytest.approx(4.0)
    assert orchestrate(Request(story, ego="idm", takes=1)).status == "failure"
