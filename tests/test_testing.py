"""The contract of a simulator: right adapters pass, and every way of being wrong that we know is told."""

from __future__ import annotations

import doctest
import random
from collections.abc import Mapping
from dataclasses import replace
from importlib import import_module

import pytest

from scenewright.drive.protocol import VehicleState
from scenewright.errors import PolicyError
from scenewright.motion.profile import Profile
from scenewright.program.types import EGO
from scenewright.roads.bodies import VEHICLE_LENGTH_M, VEHICLE_WIDTH_M
from scenewright.simulate.builtin import BuiltIn
from scenewright.simulate.port import Capabilities, Simulator, Snapshot, Start, on_route
from scenewright.simulate.vehicles import seen
from scenewright.testing import check_simulator
from scenewright.trace.model import ActorState
from toys import Bicycles, OwnStack


@pytest.mark.parametrize("step_s", [0.02, 0.05, 0.1])
@pytest.mark.parametrize("make", [BuiltIn, Bicycles, OwnStack])
def test_right_ones_pass(make: type[Simulator], step_s: float) -> None:
    check_simulator(make, step_s)


def test_its_example_runs() -> None:
    assert doctest.testmod(import_module("scenewright.testing")) == (0, 2)


class Changed(BuiltIn):
    """The built-in simulator; what it shows is changed."""

    def change(self, actor: int, state: ActorState) -> ActorState:
        return state

    def observe(self) -> Snapshot:
        now = super().observe()
        return Snapshot(now.time_s, {actor: self.change(actor, state) for actor, state in now.actors.items()})


class StartsElsewhere(BuiltIn):
    def reset(self, start: Start, step_s: float) -> None:
        first = start.first[EGO]
        moved = on_route(start.scene.routes[EGO], (first.s_m + 1.0, first.speed_mps, 0.0))
        super().reset(Start(start.scene, start.ego, {**start.first, EGO: moved}), step_s)


class StartsLate(BuiltIn):
    def observe(self) -> Snapshot:
        now = super().observe()
        return Snapshot(now.time_s + 0.4, now.actors)


class HasAStepOfItsOwn(BuiltIn):
    def reset(self, start: Start, step_s: float) -> None:
        super().reset(start, 0.03)


class MovesInApply(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        super().apply(heroes)
        super().step()

    def step(self) -> None:
        pass


class MovesWhereLookedAt(BuiltIn):
    def observe(self) -> Snapshot:
        now = super().observe()
        self._ego.advance(0.0, self._step_s)
        return now


class ShowsTheSameAgain(BuiltIn):
    """What was seen changes as it goes on."""

    def observe(self) -> Snapshot:
        now = super().observe()
        self.shown = getattr(self, "shown", {})
        self.shown.update(now.actors)
        return Snapshot(now.time_s, self.shown)


class LosesAnActor(BuiltIn):
    def observe(self) -> Snapshot:
        now = super().observe()
        return Snapshot(now.time_s, {actor: state for actor, state in now.actors.items() if actor != 2})


class IgnoresHeroes(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        super().apply(self._motions or heroes)


class MixesHeroesUp(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        super().apply({1: heroes[2], 2: heroes[1]})


class PromisesTooMuch(Bicycles):
    capabilities = Capabilities(place_error_m=0.05, speed_error_mps=0.5)


class PromisesNonsense(BuiltIn):
    capabilities = Capabilities(place_error_m=-1.0)


class InKmh(Changed):
    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(speed_mps=3.6 * state.speed_mps)


class StacksSpeedInKmh(OwnStack):
    def ego_state(self) -> ActorState:
        state = super().ego_state()
        return state._replace(speed_mps=3.6 * state.speed_mps) if self.steps else state  # the start would tell


class InDegrees(Changed):
    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(heading_rad=57.3 * state.heading_rad)


class WithoutAccelerations(Changed):
    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(accel_mps2=0.0)


class MirrorsTheMap(Changed):
    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(y_m=-state.y_m)


class HasNoPlaceInTime(Changed):
    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(s_m=float("nan")) if actor == 1 and self._time_s > 3.0 else state


class NeverRepeats(Changed):
    def reset(self, start: Start, step_s: float) -> None:
        self.noise_mps = random.SystemRandom().uniform(0.0, 1e-3)
        super().reset(start, step_s)

    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(speed_mps=state.speed_mps + self.noise_mps)


class RemembersTheLastRun(Changed):
    """One that was reset is not as one that is new."""

    runs = 0

    def reset(self, start: Start, step_s: float) -> None:
        self.runs += 1
        super().reset(start, step_s)

    def change(self, actor: int, state: ActorState) -> ActorState:
        return state._replace(speed_mps=state.speed_mps + 1e-4 * self.runs)


class IsNotReset(BuiltIn):
    def reset(self, start: Start, step_s: float) -> None:
        if not hasattr(self, "_scene"):
            super().reset(start, step_s)


class DrivesTheEgoInSecret(OwnStack):
    capabilities = Capabilities(place_error_m=0.2, speed_error_mps=0.5)


class AsksThePolicyInSecret(BuiltIn):
    capabilities = Capabilities(drives_ego=True)


class AsksTwice(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        super().apply(heroes)
        super().apply(heroes)


class ShowsThePolicyThePast(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        self._motions, shown = heroes, self._heroes
        if self._steps >= 1:
            shown = {h: on_route(self._scene.routes[h], m.state(self._time_s - 0.5)) for h, m in heroes.items()}
        others = tuple(
            VehicleState(h.name, *shown[h.id][:5], VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, None, None)
            for h in self._scene.program.heroes
        )
        self._place_heroes()
        self._action = self._ego.decide(self._time_s, others, self._step_s)


class TellsThePolicyTheRoutes(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        self._motions = heroes
        self._place_heroes()
        others = tuple(
            VehicleState(
                h.name, *self._heroes[h.id][:5], VEHICLE_LENGTH_M, VEHICLE_WIDTH_M, None, self._scene.routes[h.id]
            )
            for h in self._scene.program.heroes
        )
        self._action = self._ego.decide(self._time_s, others, self._step_s)


class Shakes(Changed):
    """Heroes are a centimetre to either side of where they are to be, along their way."""

    capabilities = Capabilities(place_error_m=0.05)

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        self._motions = heroes
        self._place_heroes()
        shown = {actor: self.change(actor, state) for actor, state in self._heroes.items()}
        self._action = self._ego.decide(self._time_s, seen(self._scene, shown), self._step_s)

    def change(self, actor: int, state: ActorState) -> ActorState:
        if actor == EGO:
            return state
        off_m = 0.01 if self._steps % 2 else -0.01
        return on_route(self._scene.routes[actor], (state.s_m + off_m, state.speed_mps, state.accel_mps2))


class AcceleratesByHalf(Changed):
    """For half a second the ego's accelerations are not those that it has."""

    def change(self, actor: int, state: ActorState) -> ActorState:
        wrong = actor == EGO and 3.0 < self._time_s < 3.5
        return state._replace(accel_mps2=state.accel_mps2 + 1.5) if wrong else state


class ShowsThePolicy(BuiltIn):
    """What it shows the policy of others is changed."""

    def apply(self, heroes: Mapping[int, Profile]) -> None:
        self._motions = heroes
        self._place_heroes()
        others = tuple(self.shown(other) for other in seen(self._scene, self._heroes))
        self._action = self._ego.decide(self._time_s, others, self._step_s)

    def shown(self, other: VehicleState) -> VehicleState:
        raise NotImplementedError


class ShowsThePolicyNoHeadings(ShowsThePolicy):
    def shown(self, other: VehicleState) -> VehicleState:
        return replace(other, heading_rad=0.0)


class ShowsThePolicyNoAccelerations(ShowsThePolicy):
    def shown(self, other: VehicleState) -> VehicleState:
        return replace(other, accel_mps2=0.0)


class MisleadsThePolicyOnItsOwnPlace(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        here = self._ego.state
        self._ego.state = here._replace(s_m=here.s_m + 1.0)
        super().apply(heroes)
        self._ego.state = self._ego.state._replace(s_m=here.s_m)


class ShowsNothing(BuiltIn):
    def observe(self) -> Snapshot:
        return None  # type: ignore[return-value]


class ShowsNumbers(Changed):
    def change(self, actor: int, state: ActorState) -> ActorState:
        return tuple(state)  # type: ignore[return-value]


class SaysNothing(BuiltIn):
    capabilities = None  # type: ignore[assignment]


class DrivesOnWithoutThePolicy(BuiltIn):
    def apply(self, heroes: Mapping[int, Profile]) -> None:
        try:
            super().apply(heroes)
        except PolicyError:
            self._action = 0.0


class SlowerEgo(BuiltIn):
    def step(self) -> None:
        assert isinstance(self._action, float)
        self._ego.state = self._ego.state._replace(accel_mps2=0.5 * self._action)
        super().step()


class ClosesOnce(BuiltIn):
    def close(self) -> None:
        del self._ego


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (StartsElsewhere, "actor 0 at 0.00 s is 1.000 m"),
        (StartsLate, "went from 0.4"),
        (HasAStepOfItsOwn, "a step from 0 to 0.02 s went from 0.0 to 0.03 s"),
        (MovesInApply, "a step from 0 to 0.02 s went from 0.02"),
        (MovesWhereLookedAt, "looking at it at 0.0 s changed it"),
        (ShowsTheSameAgain, "what was seen before changed"),
        (LosesAnActor, r"there are actors \[0, 1\]"),
        (IgnoresHeroes, "off from what was told"),
        (MixesHeroesUp, "off from what was told"),
        (PromisesTooMuch, "at most 0.05 m and 0.5 m/s is declared"),
        (PromisesNonsense, "make no sense"),
        (InKmh, "0.000 m and 20.800 m/s off"),
        (StacksSpeedInKmh, "actor 0 drove .* by its speeds"),
        (InDegrees, "does not head along its route"),
        (WithoutAccelerations, "by its accelerations it is 0.00 m/s"),
        (MirrorsTheMap, "say another place than"),
        (HasNoPlaceInTime, "finite"),
        (NeverRepeats, "from the same start it drove otherwise"),
        (RemembersTheLastRun, "from the same start it drove otherwise"),
        (IsNotReset, "a step from 0 to 0.02 s went from 12.0 to"),
        (DrivesTheEgoInSecret, "the policy was asked 0 times in 600 steps"),
        (AsksThePolicyInSecret, "asks the policy"),
        (AsksTwice, "the policy was asked 1200 times in 600 steps"),
        (ShowsThePolicyThePast, "the policy saw"),
        (TellsThePolicyTheRoutes, "told where heroes are going"),
        (Shakes, "actor 1 moves otherwise than it says, by 1.00 m/s"),
        (AcceleratesByHalf, "actor 0 gains speed otherwise than it says"),
        (ShowsThePolicyNoHeadings, "the policy saw"),
        (ShowsThePolicyNoAccelerations, r"saw ahead speed up at 0.0 m/s\^2"),
        (MisleadsThePolicyOnItsOwnPlace, "was told that it is at 21.0 m, which is at 20.0 m"),
        (ShowsNothing, "it shows None"),
        (ShowsNumbers, "a state is an ActorState"),
        (SaysNothing, "its capabilities are None"),
        (DrivesOnWithoutThePolicy, "no PolicyError came through"),
        (SlowerEgo, "actor 0 .* off from what was told"),
    ],
)
def test_wrong_ones_are_told(make: type[Simulator], said: str) -> None:
    with pytest.raises(AssertionError, match=said):
        check_simulator(make)


def test_two_that_drive_otherwise_are_told() -> None:
    made: list[Simulator] = []

    def make() -> Simulator:
        made.append(BuiltIn() if len(made) == 2 else Bicycles())
        return made[-1]

    with pytest.raises(AssertionError, match="a second one of it"):
        check_simulator(make)


def test_one_that_says_so_need_not_repeat_itself() -> None:
    class Honest(NeverRepeats):
        capabilities = Capabilities(repeatable=False)

    check_simulator(Honest)


def test_one_that_can_be_closed_only_once_is_told() -> None:
    with pytest.raises(AttributeError):
        check_simulator(ClosesOnce)
