"""Rivals: each does what its name says, within the limits of a car, before the judge that judges us."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.errors import InputError
from scenewright.judge.files import judge_run_directory
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.plan import planner
from scenewright.program.types import EGO
from scenewright.request import Request, Result
from scenewright.study.rivals import METHODS, request_of, run_method
from scenewright.study.rivals.script import SpeedAction

HERO = 1
STEP_S = 0.02
RIVALS = ("trigger-action", "synchronise", "rejection:4", "follower")
YIELDS = """\
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]

Constraints:
A0x(t0) == intersection - 90
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1x(t1) == conflict_point - 18
A1x(t2) == conflict_point - 6
A1v(t2) == 0
"""
BRAKES = """\
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0x(t0) == intersection - 120
A0(t1) == A1(t1)
gap(A0, A1, t1) == 20
A1a(dec) == -3
A1v(t2) == 0
"""
IMPOSSIBLE = YIELDS + "A1v(t1) < 0\n"


@cache
def driven(method: str, ego: str = "constant", text: str = YIELDS) -> Result:
    """Return a run, made once for all tests that look at it."""
    return run_method(method, Request(text, ego=ego, explain="nothing", replan_hz=2.0))


def failed(result: Result) -> list[str]:
    assert result.verdict is not None
    return [condition.id for condition in result.verdict.conditions if not condition.holds_at(TIGHT)]


@pytest.mark.parametrize("method", ["scenewright", "open-loop", "smt", "trigger-action", "synchronise"])
def test_succeeds_where_the_ego_does_as_foreseen(method: str) -> None:
    result = driven(method)
    assert (result.status, failed(result)) == ("success", [])


def test_gap_trigger_is_fired_by_conditions_too() -> None:
    assert driven("trigger-action", "noisy", BRAKES).status == "success"


def test_a_method_that_is_ours_otherwise_says_how() -> None:
    assert [request_of(method, Request(YIELDS)).planner for method in ("scenewright", "smt")] == ["convex", "smt"]
    assert request_of("open-loop", Request(YIELDS)).mode == "open"


@pytest.mark.usefixtures("nothing_proposed")
@pytest.mark.parametrize("method", METHODS)
def test_what_is_proven_infeasible_is_driven_by_nobody(method: str) -> None:
    result = driven(method, text=IMPOSSIBLE)
    assert result.status == "infeasible"
    assert result.feasibility is not None
    assert result.run is None


@pytest.mark.parametrize("method", [method for method in METHODS if method != "smt"])  # it has a plan of its own
def test_what_has_no_plan_is_driven_by_nobody(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(planner, "_FIRST_STEPS", 0)  # its first guess is no plan
    result = run_method(method, Request(f"{YIELDS}A1v(t0) == 3\n"))
    assert (result.status, result.run) == ("gave up", None)
    assert result.not_held


@pytest.mark.parametrize("method", RIVALS)
@pytest.mark.parametrize("ego", ["constant", "stop-and-go", "noisy"])
def test_heroes_move_as_cars_do(method: str, ego: str) -> None:
    # YIELDS has a hero that turns: lateral acceleration counts too.
    assert [name for name in failed(driven(method, ego)) if name.startswith("kin_hero")] == []


@pytest.mark.parametrize("method", ["trigger-action", "synchronise", "follower"])
def test_ego_starts_alike_for_all(method: str) -> None:
    def first(result: Result) -> tuple[float, float]:
        assert result.run is not None
        ego = result.run.trace.actors["ego"]
        return float(ego.s_m[0]), float(ego.speed_mps[0])

    assert first(driven(method, "idm")) == first(driven("scenewright", "idm"))


# -- trigger-action -------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("ego", ["constant", "stop-and-go", "noisy"])
def test_manoeuvre_begins_at_the_step_where_both_conditions_first_hold(ego: str) -> None:
    result = driven("trigger-action", ego)
    assert result.run is not None
    ego_trace, hero = result.run.trace.actors["ego"], result.run.trace.actors["hero"]
    own, others = result.scene.landmarks_m[HERO]["conflict_point"], result.scene.landmarks_m[EGO]["conflict_point"]
    # Conditions have measured places to 0.1 mm (`scenewright.units.pin`), so they are half of that off at most.
    perhaps, surely = (
        int(np.flatnonzero((others - ego_trace.s_m <= 30.0 + off_m) & (own - hero.s_m <= 18.0 + off_m))[0])
        for off_m in (6e-5, -6e-5)
    )
    begins = int(np.flatnonzero(hero.accel_mps2 < -0.5)[0])
    assert perhaps <= begins <= surely <= perhaps + 1
    # Before that the hero knew of nothing to react to: it went as planned, and then on as fast as it was.
    assert result.attempt is not None
    plan = result.attempt.plan.profiles[HERO]
    planned = [plan.state(min(index * STEP_S, plan.knot_times_s["t1"] - 1e-9))[1] for index in range(begins)]
    assert hero.speed_mps[:begins] == pytest.approx(planned)


def test_a_time_to_arrival_never_counts_as_below_its_value_for_one_that_stands() -> None:
    text = YIELDS.replace("A0x(t1) == conflict_point - 30", "tta(A0, conflict_point, t1) == 3")
    result = driven("trigger-action", "stop-and-go", text)
    assert result.run is not None
    ego, hero = result.run.trace.actors["ego"], result.run.trace.actors["hero"]
    begins = round(result.run.ego_knots_s["t1"] / STEP_S)
    assert hero.accel_mps2[begins] < -0.5
    left_m = result.scene.landmarks_m[EGO]["conflict_point"] - ego.s_m
    assert left_m[begins] <= 3.0 * ego.speed_mps[begins] + 1e-4


def test_speed_actions_start_from_the_real_speed_and_keep_to_limits() -> None:
    limits = Limits(15.0, 15.0, 8.0, 13.0, 13.0, 6.0, accel_max_mpss=4.0, brake_max_mpss=8.0)
    assert SpeedAction(1, 0.0, rate_mpss=2.0).move(10.0, limits) == (5.0, -2.0)
    assert SpeedAction(1, 0.0, rate_mpss=2.0, distance_m=10.0).move(10.0, limits) == (2.0, -5.0)
    assert SpeedAction(1, 0.0, rate_mpss=2.0, distance_m=1.0).move(10.0, limits) == (1.25, -8.0)
    assert SpeedAction(1, 12.0, rate_mpss=9.0).move(10.0, limits) == (0.5, 4.0)
    assert SpeedAction(1, 3.0, duration_s=2.0).move(10.0, limits) == (2.0, 0.0)


# -- synchronise ----------------------------------------------------------------------------------------------------
def miss_m(result: Result) -> float:
    """Return how far the hero is from its place when the ego is at its own."""
    assert result.run is not None
    ego, hero = result.run.trace.actors["ego"], result.run.trace.actors["hero"]
    arrived = float(np.interp(result.scene.landmarks_m[EGO]["conflict_point"] - 30.0, ego.s_m, ego.time_s))
    place_m = result.scene.landmarks_m[HERO]["conflict_point"] - 18.0
    return abs(float(np.interp(arrived, hero.time_s, hero.s_m)) - place_m)


def test_synchronised_hero_arrives_with_a_steady_ego_and_misses_one_that_stops_and_goes() -> None:
    assert miss_m(driven("synchronise", "constant")) < 0.3
    assert miss_m(driven("synchronise", "stop-and-go")) > 0.5


class Heeds:
    """Holds its speed where it is alone, and is slower by 2 m/s while anybody else is there."""

    def reset(self, start: EgoStart) -> None:
        self.keep_mps = start.speed_mps

    def step(self, observation: Observation, dt_s: float) -> float:
        return 0.5 * (self.keep_mps - (2.0 if observation.others else 0.0) - observation.ego.speed_mps)


def test_synchronised_hero_comes_nearer_than_one_on_a_fixed_approach() -> None:
    ego = f"{__name__}:Heeds"
    assert miss_m(driven("synchronise", ego)) < miss_m(driven("trigger-action", ego))


# -- rejection ------------------------------------------------------------------------------------------------------
def test_rejection_stops_at_its_first_success_and_keeps_it() -> None:
    result = driven("rejection", text=BRAKES, ego="noisy")
    held = [take.verdict.holds_at(TIGHT) for take in result.takes]
    assert 1 < len(held) <= 20
    assert held == [False] * (len(held) - 1) + [True]
    assert (result.status, result.take) == ("success", len(held))


def test_rejection_without_success_keeps_the_best_it_has() -> None:
    result = run_method("rejection:4", Request(YIELDS, ego="idm", seed=3, explain="nothing"))
    assert result.status == "failure"
    assert len(result.takes) == 4
    errors = [max(c.normalised_error(LOOSE) for c in take.verdict.conditions) for take in result.takes]
    best = errors.index(min(errors)) if min(errors) <= 1.0 else 0
    assert result.take == best + 1
    assert result.verdict is result.takes[best].verdict


def test_rejection_is_repeatable_and_its_seed_counts() -> None:
    def starts(seed: int) -> list[tuple[float, float]]:
        takes = run_method("rejection:2", Request(YIELDS, seed=seed, explain="nothing")).takes
        heroes = [take.trace.actors["hero"] for take in takes]
        return [(float(hero.s_m[0]), float(hero.speed_mps[0])) for hero in heroes]

    once = starts(0)
    assert len(set(once)) == 2
    assert starts(0) == once
    assert starts(1) != once


def test_rejection_keeps_the_first_state_that_the_program_gives() -> None:
    text = YIELDS.replace("A0(t1)", "A1v(t0) == 8\nA1x(t0) == conflict_point - 70\nA0(t1)", 1)
    result = run_method("rejection:2", Request(text))
    place_m = result.scene.landmarks_m[HERO]["conflict_point"] - 70.0
    for take in result.takes:
        hero = take.trace.actors["hero"]
        assert (hero.s_m[0], hero.speed_mps[0]) == pytest.approx((place_m, 8.0))


# -- all of them ----------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("method", "found"), [("telepathy", "telepathy"), ("rejection:0", "0"), ("rejection:many", "many")]
)
def test_unknown_methods_are_refused(method: str, found: str) -> None:
    with pytest.raises(InputError) as refused:
        run_method(method, Request(YIELDS))
    assert refused.value.found == found


@pytest.mark.parametrize("method", ["trigger-action", "follower"])
def test_a_rival_leaves_a_run_directory_that_is_judged_alike(method: str, tmp_path: Path) -> None:
    result = run_method(method, Request(YIELDS, out=tmp_path / "run"))
    assert result.run_directory == tmp_path / "run"
    assert result.verdict is not None
    assert judge_run_directory(tmp_path / "run").as_dict() == result.verdict.as_dict()
    assert f"rival method {method}" in (tmp_path / "run" / "manifest.json").read_text(encoding="utf-8")


def test_script_means_what_the_plan_means() -> None:
    result = driven("trigger-action")
    assert result.attempt is not None
    assert result.run is not None
    plan: Profile = result.attempt.plan.profiles[HERO]
    meant = result.run.first_plan.profiles[HERO]
    for time_s in np.linspace(0.0, plan.knot_times_s["t1"], 30):
        assert meant.state(float(time_s))[:2] == pytest.approx(plan.state(float(time_s))[:2], abs=1e-6)
    # Its braking is even, that of the plan need not be: it ends in the same place, at a time of its own.
    ends = [motion.state(motion.knot_times_s["t2"])[:2] for motion in (meant, plan)]
    assert ends[0] == pytest.approx(ends[1], abs=1e-3)
    assert all(isinstance(segment, Segment) and segment.duration_s >= 0.0 for segment in meant.segments)
