"""Every way in which a policy can misbehave, and what the guard makes of it."""

from __future__ import annotations

from asyncio import CancelledError
from math import inf, nan

import numpy as np
import pytest
from world import Car, route, start_of

from scenewright.drive.constant import Constant
from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoMotion, EgoStart, Envelope, Observation
from scenewright.errors import PolicyError, told_by

ROUTE = route("W")
EGO = Car("ego", ROUTE, 50.0, 10.0)
SEEN = Observation(1.5, EGO.state(secret=False), ())


class WordlessError(Exception):
    """What can be neither told nor shown."""

    def __str__(self) -> str:
        raise RuntimeError("no words")

    __repr__ = __str__


class Answers:
    """A policy that always gives the same answer."""

    def __init__(self, answer: object, envelope: object = None) -> None:
        self.answer, self.envelope = answer, envelope

    def reset(self, start: EgoStart) -> None:
        pass

    def step(self, observation: Observation, dt_s: float) -> object:
        if isinstance(self.answer, BaseException) and not isinstance(self.answer, WordlessError):
            raise self.answer
        return self.answer


def guarded(answer: object, envelope: object = None) -> GuardedPolicy:
    policy = GuardedPolicy(Answers(answer, envelope), "mine")
    policy.reset(start_of(ROUTE, 50.0, 10.0))
    return policy


def motion(forward_m: float = 0.2, left_m: float = 0.0, speed_mps: float = 10.0) -> EgoMotion:
    x, y, heading = ROUTE.path.to_cartesian(50.0 + forward_m, left_m)
    return EgoMotion(x, y, heading, speed_mps)


@pytest.mark.parametrize("answer", [1.25, np.float64(1.25), np.float32(1.25), 1, np.int64(1)])
def test_numbers_of_any_kind_become_plain_floats(answer: object) -> None:
    action = guarded(answer).step(SEEN, 0.02)
    assert type(action) is float
    assert action == float(answer)


def test_a_motion_passes() -> None:
    assert guarded(motion()).step(SEEN, 0.02) == motion()
    assert guarded(motion(speed_mps=-0.01)).step(SEEN, 0.02).speed_mps == 0.0


@pytest.mark.parametrize(
    "answer",
    [
        nan,
        inf,
        -inf,
        None,
        "fast",
        True,
        [1.0],
        np.array([1.0]),
        1j,
        np.float64("nan"),
        10**400,
        10**5000,
        WordlessError(),
    ],
    ids=lambda answer: type(answer).__name__,
)
def test_what_is_not_a_motion_is_refused(answer: object) -> None:
    with pytest.raises(PolicyError, match=r"'mine' returned something that is not a motion at 1\.50 s"):
        guarded(answer).step(SEEN, 0.02)


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (EgoMotion(nan, 0.0, 0.0, 1.0), "not made of finite numbers"),
        (EgoMotion(0.0, 0.0, 0.0, None), "not made of finite numbers"),  # type: ignore[arg-type]
        (EgoMotion(10**400, 0.0, 0.0, 1.0), "not made of finite numbers"),
        (motion(forward_m=1.3), "jumped"),
        (motion(forward_m=-1.3), "jumped"),
        (motion(speed_mps=-1.0), "speed that the ego cannot have"),
        (motion(speed_mps=1e6), "speed that the ego cannot have"),
    ],
)
def test_an_impossible_motion_is_refused(answer: EgoMotion, message: str) -> None:
    with pytest.raises(PolicyError, match=message) as caught:
        guarded(answer).step(SEEN, 0.02)
    assert "1.50 s" in caught.value.message
    assert caught.value.fix


def test_a_fast_car_may_move_far() -> None:
    assert guarded(motion(forward_m=5.5, speed_mps=50.0)).step(SEEN, 0.1) == motion(forward_m=5.5, speed_mps=50.0)


def test_leaving_the_route_is_refused_but_swerving_is_not() -> None:
    policy, (x, y, heading) = guarded(0.0), ROUTE.path.to_cartesian(50.0, 4.6)
    state = EGO.state(secret=False)
    for left_m, fine in ((4.9, True), (5.1, False)):
        beside = Observation(2.0, type(state)("ego", x, y, heading, 10.0, 0.0, 4.5, 1.9, None, None), ())
        policy.policy.answer = motion(left_m=left_m)  # type: ignore[attr-defined]
        if fine:
            policy.step(beside, 0.02)
        else:
            with pytest.raises(PolicyError, match="left its route"):
                policy.step(beside, 0.02)


def test_an_exception_names_policy_time_and_line() -> None:
    with pytest.raises(PolicyError) as caught:
        guarded(ZeroDivisionError("division by zero")).step(SEEN, 0.02)
    assert "'mine'" in caught.value.message
    assert "1.50 s" in caught.value.message
    assert "ZeroDivisionError: division by zero" in caught.value.found
    assert "raise self.answer" in caught.value.found
    assert isinstance(caught.value.__cause__, ZeroDivisionError)


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        (GeneratorExit(), "GeneratorExit: no message"),
        (CancelledError("late"), "CancelledError: late"),
        (SystemExit(3), "SystemExit: 3"),
        (ValueError("\n\nfirst\nsecond"), "ValueError: first"),
    ],
    ids=repr,
)
def test_whatever_is_raised_is_told(fault: BaseException, told: str) -> None:
    with pytest.raises(PolicyError, match="raised an exception in step") as caught:
        guarded(fault).step(SEEN, 0.02)
    assert caught.value.found is not None
    assert caught.value.found.startswith(told)


def test_an_exception_without_words_is_told_by_its_kind() -> None:
    assert told_by(WordlessError()) == "WordlessError: no message"


@pytest.mark.parametrize("name", ["envelope", "preferred_speed_mps"])
def test_attributes_that_fail_are_the_policys_fault(name: str) -> None:
    def fail(self: object) -> None:
        raise ValueError("not yet")

    policy = type("Mine", (Answers,), {name: property(fail, lambda self, value: None)})(0.0)
    method = {"envelope": "reset"}.get(name, name)
    with pytest.raises(PolicyError, match="raised an exception"):
        getattr(GuardedPolicy(policy, "mine"), method)(start_of(ROUTE, 50.0, 10.0))


@pytest.mark.parametrize("method", ["reset", "preferred_speed_mps"])
def test_exceptions_elsewhere_are_caught_too(method: str) -> None:
    def fail(start: EgoStart) -> None:
        raise KeyError("lane")

    policy = Answers(0.0)
    setattr(policy, method, fail)
    with pytest.raises(PolicyError, match="raised an exception"):
        getattr(GuardedPolicy(policy, "mine"), method)(start_of(ROUTE, 50.0, 10.0))


def test_interrupts_are_not_swallowed() -> None:
    class Interrupted(Answers):
        def step(self, observation: Observation, dt_s: float) -> object:
            raise KeyboardInterrupt

    policy = GuardedPolicy(Interrupted(0.0))
    policy.reset(start_of(ROUTE, 50.0, 10.0))
    with pytest.raises(KeyboardInterrupt):
        policy.step(SEEN, 0.02)


@pytest.mark.parametrize(("asked", "given"), [(20.0, 8.0), (-30.0, -12.0), (8.0, 8.0), (-12.0, -12.0)])
def test_what_no_car_can_do_is_clipped_and_found_once(asked: float, given: float) -> None:
    policy = guarded(asked)
    assert [policy.step(SEEN, 0.02) for _ in range(3)] == [given] * 3
    assert len(policy.findings) == (asked != given)
    assert all("1.50 s" in finding for finding in policy.findings)
    policy.reset(start_of(ROUTE, 50.0, 10.0))
    assert policy.findings == []


@pytest.mark.parametrize(
    ("answer", "envelope", "words"),
    [
        (2.0, Envelope(20.0, -3.0, 1.5), "promises -3 to 1.5"),
        (-4.0, Envelope(20.0, -3.0, 1.5), "promises -3 to 1.5"),
        (0.0, Envelope(9.0, -3.0, 1.5), "at most 9.00"),
        (motion(speed_mps=10.0), Envelope(9.0, -3.0, 1.5), "at most 9.00"),
        (motion(speed_mps=10.05), Envelope(20.0, -3.0, 1.5), "asked for 2.50 m/s^2, but its envelope promises -3 to 1"),
        (1.0, Envelope(20.0, -3.0, 1.5, holds_speed=True), "asked for 1.00 m/s^2, but its envelope promises to hold"),
        (motion(speed_mps=9.9), Envelope(20.0, -9.0, 1.5, holds_speed=True), "promises to hold its speed"),
        (motion(speed_mps=11.0), None, "drove 50.0 m/s^2 by a motion of its own, more than a car can do"),
    ],
)
def test_a_broken_promise_is_a_finding(answer: object, envelope: Envelope | None, words: str) -> None:
    policy = guarded(answer, envelope)
    policy.step(SEEN, 0.02)
    (finding,) = policy.findings
    assert words in finding


def test_rounding_in_a_vehicle_model_breaks_no_promise() -> None:
    policy = guarded(motion(speed_mps=10.0005), Envelope(10.0, 0.0, 0.0, holds_speed=True))
    policy.step(SEEN, 0.02)
    assert policy.findings == []


@pytest.mark.parametrize(
    "envelope",
    [Envelope(nan, -3.0, 1.0), Envelope(10.0, 3.0, 1.0), Envelope(10.0, -3.0, -1.0), Envelope(-1.0, -3.0, 1.0), "none"],
    ids=repr,
)
def test_an_envelope_that_makes_no_sense_is_refused(envelope: object) -> None:
    with pytest.raises(PolicyError, match="envelope of policy 'mine' makes no sense"):
        guarded(0.0, envelope)


def test_the_optional_attributes_are_optional_and_passed_on() -> None:
    start = start_of(ROUTE, 50.0, 10.0)
    plain = guarded(0.0)
    assert plain.envelope is None
    assert plain.preferred_speed_mps(start) is None
    constant = GuardedPolicy(Constant(speed_mps=8.0), "constant")
    constant.reset(start_of(ROUTE, 50.0, 8.0))
    assert constant.envelope == Envelope(8.0, 0.0, 0.0, holds_speed=True)
    assert constant.preferred_speed_mps(start) == 8.0


def test_a_preferred_speed_must_be_a_speed() -> None:
    policy = Answers(0.0)
    policy.preferred_speed_mps = lambda start: -1.0  # type: ignore[attr-defined]
    with pytest.raises(PolicyError, match="is not a speed"):
        GuardedPolicy(policy, "mine").preferred_speed_mps(start_of(ROUTE, 50.0, 10.0))
