"""Builds the problem of whether a scenario can happen at all: everybody's motion, from the first knot to the last.

What enters: a scene and bounds on everybody's motion. What leaves: a `Problem`. The motion of the ego, and of heroes on
their way to the trigger, is not sketched but bounded from outside by what any motion within the limits must obey, so
that an unsatisfiable problem is a proof.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from scenewright.motion.algebra import Symbol, Value, compare, conjunction, disjunction, pin
from scenewright.motion.profile import Profile
from scenewright.motion.sketched import SketchedMotion
from scenewright.program.structure import Structure, actors_of
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import MOVING_MPS, STANDSTILL_MIN_S, Limits
from scenewright.solve.lowering import Lowering, NotYet
from scenewright.solve.problem import Problem
from scenewright.solve.turns import TurnSpan, keeps_to_turn_speed
from scenewright.solve.views import KnownView, MotionView, SketchedView

_WEAKEST_MPSS = Fraction(1, 20)


@dataclass(frozen=True, slots=True)
class EgoBounds:
    """What is taken for granted of the ego. The defaults hold for any road vehicle."""

    speed_max_mps: float = 60.0
    accel_max_mpss: float = 8.0
    brake_max_mpss: float = 12.0
    holds_speed: bool = False


@dataclass(frozen=True, slots=True)
class EgoDrive:
    """How the ego really drove, and when it passed its knots: to ask whether any hero could have done better."""

    motion: Profile
    knot_times_s: Mapping[str, float]


class OuterProblem:
    """Everybody's motion at once, bounded from outside where it is not sketched."""

    def __init__(
        self,
        scene: Scene,
        structure: Structure,
        limits: Mapping[int, Limits],
        ego: EgoBounds,
        freed: Mapping[str, tuple[Fraction, Fraction]] | None = None,
        drive: EgoDrive | None = None,
    ) -> None:
        self.scene = scene
        self.structure = structure
        self.limits = limits
        self.ego = ego
        self.problem = Problem()
        parameters: dict[str, Value] = dict(scene.parameters)
        for parameter in scene.open_parameters():
            symbol = parameters[parameter.name] = self.problem.unknown(f"p_{parameter.name}")
            low, high = (bound * parameter.unit.si_factor for bound in parameter.bounds())
            assert isinstance(symbol, Symbol)
            self.problem.bound(symbol, low, high, f"the range of {parameter.name}")
        for name, (low, high) in (freed or {}).items():
            symbol = parameters[name] = self.problem.unknown(f"p_{name}")
            self.problem.bound(symbol, low, high, f"the range of {name}")
        views: dict[int, MotionView] = {
            actor.id: KnownView(drive.motion, drive.knot_times_s) if drive and actor.is_ego else self._add_actor(actor)
            for actor in scene.program.actors
        }
        self._keep_apart(views)
        lowering = Lowering(scene, structure, views, parameters)
        # Against one drive all that counts is what a judge would let pass.
        tolerance = Fraction(1) if drive else Fraction(0)
        for constraint in scene.program.constraints:
            if drive and actors_of(constraint.formula) == {EGO}:
                continue  # what the ego did alone is a fact
            try:
                self.problem.require(lowering.condition(constraint.formula, tolerance), constraint.id)
            except NotYet:
                continue

    def _add_actor(self, actor: Actor) -> SketchedView:
        problem, prefix = self.problem, f"a{actor.id}"
        count = len(actor.sketch.knots)
        positions = tuple(problem.unknown(f"{prefix}x{k}") for k in range(count))
        speeds = tuple(problem.unknown(f"{prefix}v{k}") for k in range(count))
        durations = tuple(problem.unknown(f"{prefix}d{k}") for k in range(count - 1))
        top = pin(self.ego.speed_max_mps if actor.is_ego else self.limits[actor.id].speed_max_mps)
        end = pin(self.scene.routes[actor.id].landmarks["route_end"])
        for position, speed in zip(positions, speeds, strict=True):
            problem.bound(position, 0, end, f"{actor.name} stays on its route (0 to {float(end):.0f} m)")
            problem.bound(speed, 0, top, f"{actor.name} drives forwards, at up to {float(top):.1f} m/s")
        for duration in durations:
            problem.bound(duration, 0, 120, "time runs forwards, for two minutes at most")
        accelerations: list[Value | None] = []
        for piece in range(count - 1):
            accelerations.append(None)
            self._add_piece(actor, piece, positions, speeds, durations[piece])
        motion = SketchedMotion(Fraction(0), positions, speeds, durations, tuple(accelerations))
        knots = {knot: k for k, knot in enumerate(actor.sketch.knots)}
        return SketchedView(motion, knots, {piece: (piece, piece) for piece in range(count - 1)})

    def _add_piece(
        self, actor: Actor, piece: int, positions: tuple[Symbol, ...], speeds: tuple[Symbol, ...], duration: Symbol
    ) -> None:
        require = self.problem.require
        x0, x1, v0, v1 = positions[piece], positions[piece + 1], speeds[piece], speeds[piece + 1]
        rise, change = x1 - x0, v1 - v0
        kind = actor.sketch.pieces[piece]
        laws = "the laws of motion"
        if actor.is_ego and not self.ego.holds_speed:
            self._bound_freely(actor, x0, x1, v0, v1, duration, self.ego.accel_max_mpss, self.ego.brake_max_mpss)
            return
        if actor.is_ego:
            require(compare("==", change, Fraction(0)), f"{actor.name} holds its speed")
            require(compare(">=", v0, pin(MOVING_MPS)), f"{actor.name} drives at {MOVING_MPS:g} m/s or more")
            self._bound_in_turn(actor, x0, v0, x1, v1, braking=False)
        elif kind is PieceKind.GO and self._is_approach(actor, piece):
            limits = self.limits[actor.id]
            self._bound_freely(actor, x0, x1, v0, v1, duration, limits.accel_max_mpss, limits.brake_max_mpss)
            return
        if kind is PieceKind.ACC and not actor.is_ego:
            self._bound_acceleration(actor, x0, x1, v0, v1, duration)
            self._bound_in_turn(actor, x0, v0, x1, v1, braking=False)
            return
        require(compare("==", 2 * rise, (v0 + v1) * duration), laws)
        if kind is PieceKind.GO and not actor.is_ego:
            require(compare("==", change, Fraction(0)), f"{actor.name} holds its speed in a go piece")
        elif kind is PieceKind.STOP:
            origin = f"{actor.name} stands still for {STANDSTILL_MIN_S:g} s or more"
            require(compare("==", v0, Fraction(0)), origin)
            require(compare("==", v1, Fraction(0)), origin)
            require(compare(">=", duration, pin(STANDSTILL_MIN_S)), origin)
        elif kind is PieceKind.DEC:
            self._bound_braking(actor, piece, change, v0, duration)
            self._bound_in_turn(actor, x0, v0, x1, v1, braking=True)

    def _bound_braking(self, actor: Actor, piece: int, change: Value, v0: Symbol, duration: Symbol) -> None:
        least, most = _WEAKEST_MPSS, pin(self.limits[actor.id].brake_max_mpss)
        origin = f"{actor.name} brakes at {float(least):g} to {float(most):g} m/s^2"
        self.problem.require(compare("<=", change, -least * duration), origin)
        self.problem.require(compare(">=", change, -most * duration), origin)
        if self._begins_at_trigger(actor, piece):
            origin = f"{actor.name} moves ({MOVING_MPS:g} m/s or more) when it begins to brake"
            self.problem.require(compare(">=", v0, pin(MOVING_MPS)), origin)

    def _bound_acceleration(
        self, actor: Actor, x0: Symbol, x1: Symbol, v0: Symbol, v1: Symbol, duration: Symbol
    ) -> None:
        """Bound a stretch in which an actor speeds up in any way: never slower than before, within its limits."""
        limits, require = self.limits[actor.id], self.problem.require
        up, rise, change = pin(limits.accel_max_mpss), x1 - x0, v1 - v0
        origin = f"{actor.name} accelerates at up to {float(up):g} m/s^2"
        require(compare(">", change, Fraction(0)), f"{actor.name} speeds up")
        require(compare("<=", change, up * duration), origin)
        require(compare("<=", rise, v0 * duration + up * duration * duration * Fraction(1, 2)), origin)
        require(compare("<=", v1 * v1 - v0 * v0, 2 * up * rise), origin)
        require(compare(">=", rise, v0 * duration), f"{actor.name} speeds up")
        # However it speeds up to v1, it falls behind one that drives v1 all along by at least this much.
        require(compare("<=", change * change, 2 * up * (v1 * duration - rise)), origin)

    def _bound_in_turn(self, actor: Actor, x0: Symbol, v0: Symbol, x1: Symbol, v1: Symbol, braking: bool) -> None:
        turn, limits = TurnSpan.of(self.scene.routes[actor.id]), self.limits[actor.id]
        if turn is not None and limits.turn_speed_max_mps < limits.speed_max_mps:
            condition = keeps_to_turn_speed(turn, limits.turn_speed_max_mps, x0, v0, x1, v1, braking)
            self.problem.require(condition, f"{actor.name} turns at up to {limits.turn_speed_max_mps:.1f} m/s")

    def _bound_freely(
        self,
        actor: Actor,
        x0: Symbol,
        x1: Symbol,
        v0: Symbol,
        v1: Symbol,
        duration: Symbol,
        accel_mpss: float,
        brake_mpss: float,
    ) -> None:
        """Bound a stretch of any motion by what all motions within the limits obey: none is excluded."""
        up, down = pin(accel_mpss), pin(brake_mpss)
        rise, change = x1 - x0, v1 - v0
        square = duration * duration * Fraction(1, 2)
        origin = f"{actor.name} accelerates at up to {float(up):g} and brakes at up to {float(down):g} m/s^2"
        require = self.problem.require
        require(compare(">=", rise, Fraction(0)), f"{actor.name} does not reverse")
        require(compare("<=", change, up * duration), origin)
        require(compare(">=", change, -down * duration), origin)
        require(compare("<=", rise, v0 * duration + up * square), origin)
        require(compare(">=", rise, v0 * duration - down * square), origin)
        require(compare("<=", rise, v1 * duration + down * square), origin)
        require(compare(">=", rise, v1 * duration - up * square), origin)
        require(compare("<=", v1 * v1 - v0 * v0, 2 * up * rise), origin)
        require(compare("<=", v0 * v0 - v1 * v1, 2 * down * rise), origin)
        top = pin(self.ego.speed_max_mps if actor.is_ego else self.limits[actor.id].speed_max_mps)
        require(compare("<=", rise, top * duration), f"{actor.name} drives forwards, at up to {float(top):.1f} m/s")

    def _is_approach(self, actor: Actor, piece: int) -> bool:
        trigger = self.structure.trigger_knot(actor.id)
        return trigger is not None and piece < actor.sketch.knots.index(trigger)

    def _begins_at_trigger(self, actor: Actor, piece: int) -> bool:
        return actor.sketch.knots[piece] == self.structure.trigger_knot(actor.id)

    def _keep_apart(self, views: Mapping[int, MotionView]) -> None:
        """Two vehicles that start in one lane keep their order, and a length between them, up to the trigger."""
        apart = pin(VEHICLE_LENGTH_M)
        for hero in self.scene.program.heroes:
            if self.scene.routes[hero.id].lanes[0] != self.scene.routes[EGO].lanes[0]:
                continue
            knots = [(hero.sketch.knots[0], self.scene.program.ego.sketch.knots[0])]
            own, egos = self.structure.trigger_knot(hero.id), self.structure.trigger_knot(EGO)
            if own is not None and egos is not None:
                knots.append((own, egos))
            ahead, behind = [], []
            for own_knot, ego_knot in knots:
                mine, other = views[hero.id].at_knot(own_knot, 0), views[EGO].at_knot(ego_knot, 0)
                if mine is not None and other is not None:
                    ahead.append(compare(">=", mine[0] - other[0], apart))
                    behind.append(compare("<=", mine[0] - other[0], -apart))
            origin = f"two vehicles {VEHICLE_LENGTH_M:g} m long in one lane neither overlap nor pass through each other"
            self.problem.require(disjunction([conjunction(ahead), conjunction(behind)]), origin)
