"""The contract of a simulator as a test that travels: whoever writes an adapter calls it from a test of their own.

What enters: something that makes a simulator. What leaves: nothing, or an `AssertionError` that says what is not kept.
The adapter is driven as the closed loop drives it, on a shipped map; nothing is planned, and nothing is judged.

>>> from scenewright.simulate.builtin import BuiltIn
>>> check_simulator(BuiltIn)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import cos, hypot, inf, isfinite

import numpy as np

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.protocol import EgoStart, Observation, VehicleState
from scenewright.errors import PolicyError
from scenewright.judge.kinematics import map_drift, speed_jump
from scenewright.judge.tolerance import TIGHT
from scenewright.motion.profile import Profile, chain
from scenewright.program.text import parse_program
from scenewright.program.types import EGO
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map
from scenewright.roads.path import wrap_rad
from scenewright.simulate.port import Capabilities, Simulator, Snapshot, Start
from scenewright.simulate.vehicles import EgoVehicle
from scenewright.trace.model import ActorState, ActorTrace

_PROGRAM = """\
Actor 0 (ego):
- W
- [t0, go, t1]

Actor 1 (turning):
- E, N
- [t0, go, t1]

Actor 2 (ahead):
- W
- [t0, go, t1]

Constraints:
A0v(t0) == 8
"""
# First place (m) and speed of everybody, and what heroes do: for so many seconds an acceleration, until plans change.
_EGO_FIRST, _FIRST = (20.0, 8.0), {1: (280.0, 9.0), 2: (60.0, 7.0)}
_MOVES = {1: [(2.0, 0.0, 0), (2.0, -2.0, 0), (5.0, 1.0, 0)], 2: [(1.0, 0.0, 0), (4.0, 1.5, 0), (4.0, -1.0, 0)]}
_CHANGED = {1: [(1.0, 0.0, 0), (6.0, -1.5, 0)], 2: [(3.0, 0.5, 0), (3.0, -0.5, 0)]}
_CHANGE_S, _END_S, _FAULT_S = 5.0, 12.0, 1.0
_EGO_MPSS = (0.8, -1.2, 0.0, 0.5, -2.0)  # what its policy does, for a second each
_ROUNDING = 2e-3  # what single precision leaves of places and speeds, on a map 10 km across
_SAME_S = 1e-6
_ALONG = 0.9  # cosine: 26 degrees off, more than any car that keeps to its lane
_UNITS = 0.1  # of what was driven; a unit that is mistaken makes more of a difference


def check_simulator(make: Callable[[], Simulator], step_s: float = 0.02) -> None:
    """Check what the closed loop relies on.

    A step takes `step_s`; everybody at the start, and then heroes and an ego that a policy drives, are where they are
    told to be, as near as the adapter declares; looking changes nothing; the policy is asked once a step, sees
    where everybody is and not where they are going, and its faults are let through; a start can be begun again, and
    gives the same run where the adapter says so.

    Parameters
    ----------
    make
        Makes a simulator, such as the adapter's class; called up to three times.
    step_s
        The step to check with (s).

    Raises
    ------
    AssertionError
        Where something of it is not so, with what was found.
    """
    make().close()  # nothing was opened
    simulator, start = make(), _start()
    can = simulator.capabilities
    _require(isinstance(can, Capabilities), f"its capabilities are {can}")
    errors = (can.place_error_m, can.speed_error_mps)
    _require(all(isfinite(error) and error >= 0.0 for error in errors), f"the declared errors make no sense: {errors}")
    try:
        first = _drive(simulator, start, step_s)
        first.check()
        _check_fault(simulator, start, step_s)
        again = _drive(simulator, start, step_s)
        again.check()
    finally:
        simulator.close()
    simulator.close()  # more than once is no fault
    _require(simulator.capabilities == can, f"capabilities changed from {can} to {simulator.capabilities}")
    if can.repeatable:
        other = make()
        try:
            apart = _drive(other, _start(), step_s)
        finally:
            other.close()
        _require(first.seen == again.seen, "it says that it is repeatable, but from the same start it drove otherwise")
        _require(first.seen == apart.seen, "it says that it is repeatable, but a second one of it drove otherwise")


# -- driving ----------------------------------------------------------------------------------------------------------
@dataclass
class _Recorder:
    """A policy that does what is written down for it, and writes down what it is told."""

    fails_at_s: float = inf
    told: list[tuple[Observation, float]] = field(default_factory=list)

    def reset(self, start: EgoStart) -> None:
        self.told.clear()

    def step(self, observation: Observation, dt_s: float) -> float:
        self.told.append((observation, dt_s))
        if observation.time_s >= self.fails_at_s:
            raise ArithmeticError("a fault of the policy")
        return _EGO_MPSS[int(observation.time_s + _SAME_S) % len(_EGO_MPSS)]


def _start() -> Start:
    program = parse_program(_PROGRAM)
    scene = ground(program, load_map(program.map_name))
    ego = EgoVehicle(GuardedPolicy(_Recorder(), "recorder"), scene.routes[EGO], scene.road_map)
    return Start.of(scene, ego, _EGO_FIRST, _motions())


def _motions(before: Mapping[int, Profile] | None = None) -> dict[int, Profile]:
    """Return the heroes' first motions, or what follows them."""
    if before is None:
        return {hero: Profile(chain(0.0, *_FIRST[hero], moves)) for hero, moves in _MOVES.items()}
    states = {hero: motion.state(_CHANGE_S)[:2] for hero, motion in before.items()}
    return {hero: Profile(chain(_CHANGE_S, *states[hero], moves)) for hero, moves in _CHANGED.items()}


def _recorder(start: Start) -> _Recorder:
    policy = start.ego.policy.policy
    assert isinstance(policy, _Recorder)
    return policy


def _drive(simulator: Simulator, start: Start, step_s: float, until_s: float = _END_S) -> _Run:
    """Drive as the loop does."""
    run, motions = _Run(simulator.capabilities, start, step_s), _motions()
    simulator.reset(start, step_s)
    run.look(simulator)
    for step in range(round(until_s / step_s)):
        if step == round(_CHANGE_S / step_s):
            motions = _motions(motions)
        run.motions.append(motions)
        simulator.apply(motions)
        run.look(simulator)
        simulator.step()
        run.look(simulator)
    run.told = list(_recorder(start).told)
    return run


def _check_fault(simulator: Simulator, start: Start, step_s: float) -> None:
    """Drive a little, until the policy fails where it is asked; the next run begins from there."""
    policy = _recorder(start)
    policy.fails_at_s = _FAULT_S
    try:
        _drive(simulator, start, step_s, until_s=2 * _FAULT_S)
    except PolicyError:
        return
    finally:
        policy.fails_at_s = inf
    _require(simulator.capabilities.drives_ego, "the policy failed, and no PolicyError came through")


@dataclass
class _Run:
    """What was seen: at the start, then for each step after `apply` and after `step`; what was to be; who was told."""

    can: Capabilities
    start: Start
    step_s: float
    seen: list[Snapshot] = field(default_factory=list)
    motions: list[Mapping[int, Profile]] = field(default_factory=list)
    told: list[tuple[Observation, float]] = field(default_factory=list)
    _last: Mapping[int, ActorState] = field(default_factory=dict)

    def look(self, simulator: Simulator) -> None:
        """Look twice, and keep a copy: what was seen may not change afterwards."""
        now = simulator.observe()
        _require(isinstance(now, Snapshot), f"looked at, it shows {now}")
        if self.seen:
            _require(dict(self._last) == self.seen[-1].actors, "what was seen before changed when it went on")
        self._last, kept = now.actors, Snapshot(now.time_s, dict(now.actors))
        self._check_sense(kept)
        again = simulator.observe()
        _require(kept == (again.time_s, dict(again.actors)), f"looking at it at {now.time_s} s changed it")
        self.seen.append(kept)

    # -- what must be so ----------------------------------------------------------------------------------------------
    def check(self) -> None:
        """Check all that one run tells."""
        self._check_time()
        for actor, first in self.start.first.items():
            self._check_near(self.seen[0], actor, (first.s_m, first.speed_mps))
        for motions, *both in zip(self.motions, self.before, self.after[1:], strict=True):
            for now in both:
                for hero, motion in motions.items():
                    self._check_near(now, hero, motion.state(now.time_s)[:2])
        if self.can.drives_ego:
            _require(not self.told, "it says that it drives the ego, and asks the policy")
        else:
            self._check_told()
            self._check_ego()
        for actor in self.start.first:
            self._check_units(actor, [now.actors[actor] for now in self.after], [n.actors[actor] for n in self.before])
            self._check_agreement(actor)
        self._check_accels_told()

    @property
    def before(self) -> list[Snapshot]:
        """What was seen before each step, when everybody had been told what to do."""
        return self.seen[1::2]

    @property
    def after(self) -> list[Snapshot]:
        """What was seen at the start and after each step."""
        return self.seen[::2]

    def _check_sense(self, now: Snapshot) -> None:
        at = f"at {now.time_s:.2f} s"
        _require(set(now.actors) == set(self.start.first), f"{at} there are actors {sorted(now.actors)}")
        for actor, state in now.actors.items():
            where = f"actor {actor} {at}: {state}"
            _require(isinstance(state, ActorState), f"a state is an ActorState; {where}")
            _require(all(map(isfinite, state)), f"a state is made of finite numbers; {where}")
            _require(state.speed_mps >= -_ROUNDING, f"nobody drives backwards; {where}")
            x_m, y_m, heading_rad = self.start.scene.routes[actor].path.to_cartesian(state.s_m, state.d_m)
            off_m = hypot(x_m - state.x_m, y_m - state.y_m)
            _require(off_m <= _ROUNDING, f"s_m and d_m say another place than x_m and y_m, {off_m:.3f} m off; {where}")
            along = cos(heading_rad - state.heading_rad) > _ALONG
            _require(along, f"it does not head along its route; {where}")

    def _check_near(self, now: Snapshot, actor: int, wanted: tuple[float, float]) -> None:
        place_error_m, speed_error_mps, state = self.can.place_error_m, self.can.speed_error_mps, now.actors[actor]
        off_m, off_mps = hypot(state.s_m - wanted[0], state.d_m), abs(state.speed_mps - wanted[1])
        where = f"actor {actor} at {now.time_s:.2f} s is {off_m:.3f} m and {off_mps:.3f} m/s off from what was told"
        near = off_m <= place_error_m + _ROUNDING and off_mps <= speed_error_mps + _ROUNDING
        _require(near, f"{where}; at most {place_error_m:g} m and {speed_error_mps:g} m/s is declared")

    def _check_time(self) -> None:
        for step, (before, after) in enumerate(zip(self.before, self.after[1:], strict=True)):
            due_s = (step * self.step_s, (step + 1) * self.step_s)
            right = abs(before.time_s - due_s[0]) < _SAME_S and abs(after.time_s - due_s[1]) < _SAME_S
            _require(right, f"a step from {due_s[0]:g} to {due_s[1]:g} s went from {before.time_s} to {after.time_s} s")

    def _check_units(self, actor: int, after: Sequence[ActorState], before: Sequence[ActorState]) -> None:
        """Check that places, speeds and accelerations tell of one motion."""
        driven_m = sum(hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(after))
        by_speed_m = sum(0.5 * (a.speed_mps + b.speed_mps) * self.step_s for a, b in pairwise(after))
        same = abs(by_speed_m - driven_m) <= _UNITS * driven_m + self.can.place_error_m + _ROUNDING
        _require(same, f"actor {actor} drove {driven_m:.1f} m; by its speeds it would be {by_speed_m:.1f} m")
        gained_mps = after[-1].speed_mps - after[0].speed_mps
        by_accel_mps = sum(state.accel_mps2 for state in before) * self.step_s
        changes_mpss = sum(abs(b.accel_mps2 - a.accel_mps2) for a, b in pairwise(before))
        slack_mps = self.step_s * changes_mpss + 2.0 * self.can.speed_error_mps + _UNITS * abs(gained_mps) + _ROUNDING
        same = abs(by_accel_mps - gained_mps) <= slack_mps
        _require(same, f"actor {actor} gained {gained_mps:.2f} m/s; by its accelerations it is {by_accel_mps:.2f} m/s")

    def _check_agreement(self, actor: int) -> None:
        """Check, as the judge does, that places, speeds and accelerations agree from step to step."""
        columns = np.array([now.actors[actor] for now in self.before], dtype=np.float64).T
        states = ActorTrace(np.array([now.time_s for now in self.before]), *columns)
        most_mps = TIGHT.of("speed")
        for what, off_mps in (("moves", map_drift(states)), ("gains speed", speed_jump(states))):
            told = f"actor {actor} {what} otherwise than it says, by {off_mps:.2f} m/s in a step or a second"
            _require(off_mps <= most_mps, f"{told}; by {most_mps:g} m/s at most, or no run in it is a success")

    def _check_told(self) -> None:
        asked, steps = len(self.told), len(self.motions)
        _require(asked == steps, f"the policy was asked {asked} times in {steps} steps")
        names = {actor.id: actor.name for actor in self.start.scene.program.actors}
        for (observation, dt_s), now in zip(self.told, self.before, strict=True):
            at = f"at {now.time_s:.2f} s the policy"
            right = abs(observation.time_s - now.time_s) < _SAME_S and abs(dt_s - self.step_s) < _SAME_S
            _require(right, f"{at} was told that it is {observation.time_s} s, and asked for {dt_s} s")
            others = {other.name: other for other in observation.others}
            _require(set(others) == set(names.values()) - {names[EGO]}, f"{at} saw {sorted(others)}")
            hidden = all(other.s_m is None and other.route is None for other in others.values())
            _require(hidden, f"{at} was told where heroes are going")
            for actor, state in now.actors.items():
                shown = observation.ego if actor == EGO else others[names[actor]]
                _require(_same(shown, state), f"{at} saw {names[actor]} at {shown}, which is at {state}")
            ego, route = observation.ego, self.start.scene.routes[EGO]
            own = ego.route is route and ego.s_m is not None and abs(ego.s_m - now.actors[EGO].s_m) <= _ROUNDING
            _require(
                own, f"{at} was told that it is at {ego.s_m} m, which is at {now.actors[EGO].s_m} m, or another route"
            )

    def _check_accels_told(self) -> None:
        ids = {actor.name: actor.id for actor in self.start.scene.program.actors}
        for (observation, _), *both in zip(self.told, self.after, self.before, strict=False):
            for shown in (observation.ego, *observation.others):
                accels = [
                    now.actors[ids[shown.name]].accel_mps2 for now in both
                ]  # this step's, or still the last one's
                known = min(abs(shown.accel_mps2 - accel_mpss) for accel_mpss in accels) <= _ROUNDING
                what = f"at {both[1].time_s:.2f} s the policy saw {shown.name} speed up at {shown.accel_mps2} m/s^2"
                _require(known, f"{what}, not at {accels}")

    def _check_ego(self) -> None:
        s_m, speed_mps = _EGO_FIRST
        for (observation, _), after in zip(self.told, self.after[1:], strict=True):
            accel_mpss = _EGO_MPSS[int(observation.time_s + _SAME_S) % len(_EGO_MPSS)]
            then_mps = max(0.0, speed_mps + accel_mpss * self.step_s)
            s_m, speed_mps = s_m + 0.5 * (speed_mps + then_mps) * self.step_s, then_mps
            self._check_near(after, EGO, (s_m, speed_mps))


def _same(shown: VehicleState, state: ActorState) -> bool:
    pairs = ((shown.x_m, state.x_m), (shown.y_m, state.y_m), (shown.speed_mps, state.speed_mps))
    turned_rad = wrap_rad(shown.heading_rad - state.heading_rad)
    return all(abs(off) <= _ROUNDING for off in (turned_rad, *(one - other for one, other in pairs)))


def _require(holds: bool, otherwise: str) -> None:
    """Raise where something does not hold; an `assert` would be gone where Python is asked to be fast."""
    if not holds:
        raise AssertionError(otherwise)
