"""Builds the problem of one re-solve: the rest of every hero's motion, given where all are and where the ego will be.

What enters: a scene, a `Situation`, a `Style`. What leaves: a `Problem` and how to read a model of it back as
profiles. History is fixed, the ego is a prediction, and what of a hero's motion has a known duration makes linear
conditions.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from scenewright.motion.algebra import Condition, Symbol, Value, compare, pin
from scenewright.motion.profile import Profile, chain
from scenewright.motion.sketched import SketchedMotion
from scenewright.program.expressions import Compare, Elapsed, Formula, PieceRef, State, walk
from scenewright.program.structure import KnotKey, Role, Structure, actors_of, knots_of
from scenewright.program.types import EGO, Actor, Constraint, PieceKind
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition, hero_side
from scenewright.solve.clearance import APART_M, Clearance, out_of_way_mps
from scenewright.solve.limits import BRAKE_MAX_MPSS, MOVING_MPS, ROOM, Limits, Style
from scenewright.solve.lowering import Lowering, NotYet
from scenewright.solve.problem import Problem
from scenewright.solve.readiness import readiness
from scenewright.solve.situation import HeroState, Situation
from scenewright.solve.smoothness import smoothed
from scenewright.solve.stretches import (
    Division,
    Stretch,
    approach_rates,
    following_piece,
    rate_is_given,
    shortest_s,
    trigger_speed_mps,
)
from scenewright.solve.turns import TurnSpan, is_slow_in_turn, keeps_to_turn_speed
from scenewright.solve.views import KnownView, MotionView, SketchedView

# An ego knot that is not in sight is taken to come this much later (s).
_OUT_OF_SIGHT_S = 60.0
_START_MARGIN_M = 3.0
_LONGEST_CLEARANCE_S = 8.0
_RESERVE = 0.8
_OPENING_RANGE_MPS = 1.0
_LONGEST_S = Fraction(90)


class HeroProblem:
    """One problem over the rest of the motion of all heroes."""

    def __init__(
        self,
        scene: Scene,
        structure: Structure,
        limits: Mapping[int, Limits],
        situation: Situation,
        style: Style,
        tolerance: Fraction = Fraction(0),
        conditions: tuple[LinearCondition, ...] = (),
    ) -> None:
        self.scene = scene
        self.conditions = conditions
        self.structure = structure
        self.limits = limits
        self.situation = situation
        self.style = style
        self.tolerance = tolerance
        self.problem = Problem()
        self.asserted: list[Constraint] = []
        self._stretches: dict[int, list[Stretch]] = {}
        self._led: set[int] = set()  # heroes that have to keep clear of the ego on their way
        self._turning: set[int] = set()  # heroes whose side of the trigger lies beyond the beginning of their turn
        self._views: dict[int, MotionView] = {EGO: self._ego_view()}
        self._parameters: dict[str, Value] = dict(scene.parameters)
        for hero in scene.program.heroes:
            self._views[hero.id] = self._add_hero(hero)
        self._add_constraints()

    # -- the ego ----------------------------------------------------------------------------------------------------
    def _ego_view(self) -> MotionView:
        sketch = self.scene.program.ego.sketch
        knots = {sketch.knots[0]: 0.0, **self.situation.ego_knots_s}
        later = self.situation.time_s + _OUT_OF_SIGHT_S
        for knot in sketch.knots:
            knots.setdefault(knot, later)
        return KnownView(self.situation.ego, knots)

    # -- heroes -----------------------------------------------------------------------------------------------------
    def _add_hero(self, hero: Actor) -> MotionView:
        state = self.situation.heroes.get(hero.id)
        stretches = Division(
            self.scene.program, self.structure, self.limits[hero.id], self.situation, self.style, self.conditions
        ).stretches(hero)
        self._stretches[hero.id] = stretches
        problem, prefix = self.problem, f"a{hero.id}"
        start, position, speed = self._first_state(hero, state)
        positions: list[Value] = [position]
        speeds: list[Value] = [speed]
        durations: list[Value] = []
        knots: dict[str, int] = {}
        pieces: dict[int, tuple[int, int]] = {}
        if state is None:
            knots[hero.sketch.knots[0]] = 0
        clearance = self._clearance(hero, state, position)
        if clearance is not None:
            self._led.add(hero.id)
        side = hero_side(self.conditions, self.structure, hero.id)
        turn = TurnSpan.of(self.scene.routes[hero.id])
        if turn is not None and _turns_before_trigger(turn, side or self._joint_side(hero), hero.id):
            self._turning.add(hero.id)
        now: Value | None = start
        for k, stretch in enumerate(stretches):
            duration: Value
            if stretch.duration_s is None:
                duration = problem.unknown(f"{prefix}d{k}")
                begun = state is not None and stretch.piece == state.piece
                shortest = Fraction(0)
                if not begun and not stretch.cruise:
                    shortest = shortest_s(self.style, hero, stretch.piece, self.structure.trigger_knot(hero.id), side)
                    if self.style.steps == 1 and rate_is_given(self.scene.program, hero, stretch.piece):
                        # Who is slow has soon done what it is told.
                        shortest = min(shortest, self.scene.program.manner.stricter(ROOM).begins_s)
                problem.bound(duration, shortest, _LONGEST_S, f"{hero.name}'s pieces take some time")
            else:
                duration = stretch.duration_s
            next_speed = problem.unknown(f"{prefix}v{k + 1}")
            next_position = problem.unknown(f"{prefix}x{k + 1}")
            self._add_stretch(hero, stretch, positions[-1], speeds[-1], next_position, next_speed, duration)
            if stretch.place_m is not None:
                low, high = map(pin, stretch.place_m)
                self.problem.bound(next_position, low, high, f"{hero.name} waits at its place")
            now = now + duration if isinstance(now, Fraction) and isinstance(duration, Fraction) else None
            if clearance is not None and isinstance(now, Fraction) and stretch.approach:
                label = f"{hero.name} keeps clear of the ego"
                apart_m = APART_M if stretch.end_knot is None else VEHICLE_LENGTH_M
                kept = clearance.condition(self.situation.ego, float(now), next_position, apart_m)
                self.problem.require(kept, label)
            if isinstance(now, Fraction) and stretch.approach and stretch.end_knot is None:
                for condition, reason in readiness(
                    self.situation, self.style, side, hero.id, float(now), next_position, next_speed
                ):
                    self.problem.require(condition, f"{hero.name} {reason}")
            if clearance is not None and stretch.approach and stretch.end_knot is not None:
                self._require_opening(hero, clearance, next_speed)
            positions.append(next_position)
            speeds.append(next_speed)
            durations.append(duration)
            first = pieces.get(stretch.piece, (k, k))[0]
            pieces[stretch.piece] = (first, k)
            if stretch.end_knot is not None:
                knots[stretch.end_knot] = k + 1
        motion = SketchedMotion(start, tuple(positions), tuple(speeds), tuple(durations), (None,) * len(durations))
        past = KnownView(state.history, state.knots_s) if state else None
        return SketchedView(motion, knots, pieces, past)

    def _clearance(self, hero: Actor, state: HeroState | None, position: Value) -> Clearance | None:
        """Return how the hero keeps clear of the ego on their way; None where it need not, or no longer does."""
        clearance = Clearance.of(self.scene, self.structure, self.conditions, hero)
        if clearance is None:
            return None
        ego, now_s = self.situation.ego, self.situation.time_s
        if state is None:
            label = f"{hero.name} starts clear of the ego"
            self.problem.require(clearance.condition(ego, now_s, position), label)
            return clearance
        return clearance if clearance.is_kept(ego, now_s, state.s_m) else None

    def _require_opening(self, hero: Actor, clearance: Clearance, speed: Symbol) -> None:
        """Require that the distance between hero and ego grows at the trigger, where the style asks for it."""
        instant_s, opening_mps = self.situation.trigger_s.get(hero.id), self.style.opening_mps
        if opening_mps is None or instant_s is None or not clearance.ahead or clearance.closing:
            return
        least = pin(self.situation.ego.state(instant_s)[1] + opening_mps)
        most = least + pin(_OPENING_RANGE_MPS)
        self.problem.bound(speed, least, most, f"{hero.name} draws away from the ego at its trigger")

    def _joint_side(self, hero: Actor) -> LinearCondition | None:
        """Return the hero's side of a trigger that both decide, with the ego where it will be then."""
        instant_s = self.situation.trigger_s.get(hero.id)
        for condition in self.conditions:
            if instant_s is None or set(condition.weights) != {EGO, hero.id}:
                continue
            if condition.moments <= self.structure.triggers[hero.id]:
                return condition.given(EGO, *self.situation.ego.state(instant_s)[:2])
        return None

    def _first_state(self, hero: Actor, state: HeroState | None) -> tuple[Value, Value, Value]:
        """Return time, position and speed to go on from: what they are, or free within the route."""
        if state is not None:
            return pin(state.time_s), pin(state.s_m), pin(state.speed_mps)
        position, speed = self.problem.unknown(f"a{hero.id}x0"), self.problem.unknown(f"a{hero.id}v0")
        turn = TurnSpan.of(self.scene.routes[hero.id])
        # Who begins beyond the middle of its turn comes from where it is going.
        latest = None if turn is None else pin(0.5 * (turn.start_m + turn.end_m))
        self.problem.bound(position, pin(_START_MARGIN_M), latest, f"{hero.name} starts on its route, before its turn")
        self._bound_speed(hero, speed)
        if self.style.steps <= 3:
            self.problem.bound(speed, pin(MOVING_MPS), None, f"{hero.name} drives when the scenario begins")
        return Fraction(0), position, speed

    def _is_timed(self, hero: Actor, knot_index: int) -> bool:
        """Whether the program speaks of the hero's speed at a knot, as a time to arrival does: then it cannot stand."""
        key = (hero.id, hero.sketch.knots[knot_index])
        return any(
            condition.weights.get(hero.id, (0.0, 0.0))[1] != 0.0
            and any(self.structure.same_moment(hero.id, moment) == key[1] for moment in condition.moments)
            for condition in self.conditions
        )

    def _add_stretch(
        self, hero: Actor, stretch: Stretch, x0: Value, v0: Value, x1: Symbol, v1: Symbol, duration: Value
    ) -> None:
        self.problem.require(compare("==", 2 * (x1 - x0), (v0 + v1) * duration), "the laws of motion")
        self._bound_speed(hero, v1, after=not stretch.approach)
        self._bound_in_turn(hero, stretch, x0, v0, x1, v1)
        kind = hero.sketch.pieces[stretch.piece]
        if stretch.approach:
            self._bound_approach(hero, stretch, v1, v1 - v0, duration)
        elif kind is PieceKind.GO or stretch.cruise:
            self.problem.require(compare("==", v1, v0), f"{hero.name} holds its speed")
        elif kind is PieceKind.STOP:
            self._bound_standing(hero, stretch, v0, v1, duration)
        elif stretch.to_top:
            top = pin(min(self.style.top_speeds_mps(self.limits[hero.id])))
            self.problem.require(compare("==", v1, top), f"{hero.name} goes at {float(top):.1f} m/s")
            rate = pin(self.style.acc_mpss[1])
            self._require_rate(v1 - v0, duration, rate, rate, f"{hero.name} accelerates at {float(rate):g} m/s^2")
        else:
            self._bound_speeding(hero, stretch, v1 - v0, duration)

    def _bound_approach(self, hero: Actor, stretch: Stretch, v1: Symbol, change: Value, duration: Value) -> None:
        """Bound a stretch on the way to the trigger."""
        if stretch.waiting:
            self.problem.require(compare("==", v1, Fraction(0)), f"{hero.name} waits on its way")
        up, down = approach_rates(self.style, stretch, following_piece(hero, stretch.piece))
        self._require_rate(change, duration, -down, up, f"{hero.name}'s acceleration limits")
        if stretch.end_knot is not None:
            self._bound_trigger_speed(hero, stretch.piece, v1)

    def _bound_standing(self, hero: Actor, stretch: Stretch, v0: Value, v1: Symbol, duration: Value) -> None:
        """Bound a stretch in which the hero stands."""
        require, label = self.problem.require, f"{hero.name}'s {PieceKind.STOP} piece"
        require(compare("==", v0, Fraction(0)), label)
        require(compare("==", v1, Fraction(0)), label)
        low, high = self.style.stop_s
        require(compare(">=", duration, self._stop_rest(hero, stretch, low)), label)
        require(compare("<=", duration, pin(high)), label)

    def _bound_speeding(self, hero: Actor, stretch: Stretch, change: Value, duration: Value) -> None:
        """Bound a braking or accelerating stretch: as the style says, unless the program gives its rate."""
        braking = hero.sketch.pieces[stretch.piece] is PieceKind.DEC
        low, high = self.style.dec_mpss if braking else self.style.acc_mpss
        if rate_is_given(self.scene.program, hero, stretch.piece):
            low, high = 0.05, BRAKE_MAX_MPSS if braking else self.limits[hero.id].accel_max_mpss
        sign = -1 if braking else 1
        rates = sorted((sign * pin(low), sign * pin(high)))
        origin = f"{hero.name} {'brakes' if braking else 'accelerates'} at {low:g} to {high:g} m/s^2"
        self._require_rate(change, duration, rates[0], rates[1], origin)

    def _stop_rest(self, hero: Actor, stretch: Stretch, standing_s: float) -> Fraction:
        """Return how much longer the hero must stand: what it has stood already counts."""
        state = self.situation.heroes.get(hero.id)
        if state is None or state.piece != stretch.piece:
            return pin(standing_s)
        since = state.knots_s.get(hero.sketch.knots[stretch.piece], state.time_s)
        return max(Fraction(0), pin(standing_s) - (pin(state.time_s) - pin(since)))

    def _require_rate(self, change: Value, duration: Value, low: Fraction, high: Fraction, origin: str) -> None:
        if low == high:
            self.problem.require(compare("==", change, low * duration), origin)
            return
        self.problem.require(compare(">=", change, low * duration), origin)
        self.problem.require(compare("<=", change, high * duration), origin)

    def _bound_speed(self, hero: Actor, speed: Symbol, after: bool = False) -> None:
        limits = self.limits[hero.id]
        top = self.style.top_speed_after_mps(limits) if after else self._top_mps(hero)
        reserved = self.style.steps <= 3 and self.style.opening_mps is None
        if hero.id not in self.situation.heroes and reserved and not after:
            # Who starts as fast as it may drive can never catch up with an ego that is early.
            top = min(top, _RESERVE * limits.approach_speed_max_mps)
        self.problem.bound(speed, 0, pin(top), f"{hero.name} drives at 0 to {top:.1f} m/s")

    def _bound_in_turn(self, hero: Actor, stretch: Stretch, x0: Value, v0: Value, x1: Symbol, v1: Symbol) -> None:
        turn = TurnSpan.of(self.scene.routes[hero.id])
        turn_top = self.style.top_speeds_mps(self.limits[hero.id])[1]
        top = self.style.top_speed_after_mps(self.limits[hero.id])
        if turn is None or turn_top >= top:
            return
        if stretch.approach and stretch.end_knot is None:
            origin = f"{hero.name} turns at up to {turn_top:.1f} m/s"
            if hero.id not in self._turning:
                return
            hardest = pin(self.limits[hero.id].brake_max_mpss)
            if not (isinstance(x0, Fraction) and isinstance(v0, Fraction) and v0 > pin(turn_top)):
                self.problem.require(is_slow_in_turn(turn, turn_top, x0, v0, x1, v1), origin)
            elif v0 * v0 - pin(turn_top) ** 2 < 2 * hardest * (pin(turn.start_m) - x0):
                self.problem.require(compare("<=", x1, pin(turn.start_m)), origin)  # it slows down before its turn
            return
        braking = hero.sketch.pieces[stretch.piece] is PieceKind.DEC
        condition = keeps_to_turn_speed(turn, turn_top, x0, v0, x1, v1, braking)
        self.problem.require(condition, f"{hero.name} turns at up to {turn_top:.1f} m/s")

    def _bound_trigger_speed(self, hero: Actor, piece: int, speed: Symbol) -> None:
        clear_mps = out_of_way_mps(self.scene, self.structure, self.conditions, hero)
        least = trigger_speed_mps(self.style, hero, piece, self._is_timed(hero, piece + 1), clear_mps)
        self.problem.bound(speed, pin(least), None, f"{hero.name} moves at {least:g} m/s or more at its trigger")

    # -- the program's constraints ----------------------------------------------------------------------------------
    def _add_constraints(self) -> None:
        lowering = Lowering(self.scene, self.structure, self._views, self._parameters)
        for constraint in self.scene.program.constraints:
            if not self._concerns(constraint):
                continue
            role = self.structure.roles[constraint.id]
            margin = self._outcome_margin_s(constraint) if role is Role.OUTCOME else 0.0
            tolerance = self.tolerance if role is Role.TRIGGER else Fraction(0)
            try:
                self.problem.require(self._lower(lowering, constraint.formula, tolerance, margin), constraint.id)
                if margin >= 0:  # what is only asked for as far as it goes is no promise
                    self.asserted.append(constraint)
            except NotYet:
                continue

    def _outcome_margin_s(self, constraint: Constraint) -> float:
        """Return by how much the hero must be first (s).

        That is some time, and where asked as long as the ego takes from where the two could touch to its knot.
        """
        margin = self.style.outcome_margin_s
        keys = set(knots_of(constraint.formula))
        heroes = [actor for actor, _ in keys if actor != EGO]
        if not self.style.clear or not heroes:
            return margin
        conflict = self.scene.conflict(EGO, heroes[0])
        for actor, knot in keys:
            if actor == EGO and conflict is not None and knot in self.situation.ego_knots_s:
                s_m, speed, _ = self.situation.ego.state(self.situation.ego_knots_s[knot])
                margin += min(max(0.0, s_m - conflict.zone_a_m[0]) / max(speed, 0.1), _LONGEST_CLEARANCE_S)
        return margin

    @staticmethod
    def _lower(lowering: Lowering, formula: Formula, tolerance: Fraction, margin_s: float) -> Condition:
        match formula:
            case Compare(
                operator="<" | "<=", left=Elapsed(actor=hero) as left, right=Elapsed(actor=other) as right
            ) if hero != EGO and other == EGO and margin_s:
                first, second = lowering.term(left)[0], lowering.term(right)[0]
                return compare("<=", first + pin(margin_s), second)
            case _:
                return lowering.condition(formula, tolerance)

    def _concerns(self, constraint: Constraint) -> bool:
        """Whether `constraint` still says something about a hero's motion to come."""
        role = self.structure.roles[constraint.id]
        if role is Role.OUTCOME and not self.style.outcome and _speaks_of_ego(constraint.formula):
            return False
        if actors_of(constraint.formula) == {EGO}:
            return False  # the ego's own side is the prediction's affair: it is what sets the trigger's instant
        ahead = any(self._is_ahead(key) for key in knots_of(constraint.formula))
        for node in walk(constraint.formula):
            if isinstance(node, State) and not isinstance(node.at, Elapsed) and node.actor != EGO:
                view = self._views.get(node.actor)
                if isinstance(node.at, PieceRef) and isinstance(view, SketchedView):
                    index = self.scene.program.actor(node.actor).sketch.piece_index(node.at.name)
                    state = self.situation.heroes.get(node.actor)
                    ahead = ahead or (index in view.pieces and (state is None or state.piece != index))
        return ahead

    def _is_ahead(self, key: KnotKey) -> bool:
        """Whether a knot, or one that is the same moment, is still to come for a hero."""
        for hero in self.scene.program.heroes:
            view, own = self._views.get(hero.id), self.structure.same_moment(hero.id, key)
            if isinstance(view, SketchedView) and own in view.knots:
                return True
        return False

    # -- reading a model back ---------------------------------------------------------------------------------------
    def profiles(self, model: Mapping[str, Fraction]) -> dict[int, Profile]:
        """Return the heroes' motions that a model stands for, continued from their true states without a jump."""
        result: dict[int, Profile] = {}
        for hero in self.scene.program.heroes:
            result[hero.id] = self._profile(hero, model)
        return result

    def _profile(self, hero: Actor, model: Mapping[str, Fraction]) -> Profile:
        prefix, state = f"a{hero.id}", self.situation.heroes.get(hero.id)
        speed = float(model[f"{prefix}v0"]) if state is None else state.speed_mps
        position = float(model[f"{prefix}x0"]) if state is None else state.s_m
        now = 0.0 if state is None else state.time_s
        knots = {hero.sketch.knots[0]: 0.0} if state is None else dict(state.knots_s)
        previous = speed if state is None else float(pin(state.speed_mps))
        moves: list[tuple[float, float, int]] = []
        for k, stretch in enumerate(self._stretches[hero.id]):
            known = stretch.duration_s
            duration = float(known if known is not None else model.get(f"{prefix}d{k}", Fraction(0)))
            following = float(model.get(f"{prefix}v{k + 1}", Fraction(0)))
            accel = (following - previous) / duration if duration > 1e-9 else 0.0
            if hero.sketch.pieces[stretch.piece] is PieceKind.STOP:
                accel = 0.0
            moves.append((duration, accel, stretch.piece))
            previous = following
            now += duration
            if stretch.end_knot is not None:
                knots[stretch.end_knot] = now
        start = 0.0 if state is None else state.time_s
        return Profile(chain(start, position, speed, self._smoothed(hero, position, speed, moves)), knots)

    def _smoothed(
        self, hero: Actor, s_m: float, speed_mps: float, moves: list[tuple[float, float, int]]
    ) -> list[tuple[float, float, int]]:
        """Return the moves with the smoothest way to the trigger, where nothing but its end is asked of that way."""
        stretches = self._stretches[hero.id]
        count = next((k + 1 for k, stretch in enumerate(stretches) if stretch.end_knot is not None), 0)
        way, turn = stretches[:count], TurnSpan.of(self.scene.routes[hero.id])
        if self.style.ready or hero.id in self._led or not all(s.approach and s.duration_s for s in way):
            return moves
        if any(stretch.waiting for stretch in way):
            return moves
        if turn is not None and s_m < turn.end_m:
            rest_s = sum(duration_s for duration_s, _, _ in moves[:count])
            if Profile(chain(0.0, s_m, speed_mps, moves)).state(rest_s)[0] > turn.start_m:
                return moves
        rates = (approach_rates(self.style, stretch, following_piece(hero, stretch.piece)) for stretch in way)
        return smoothed(moves, [(-float(down), float(up)) for up, down in rates], speed_mps, self._top_mps(hero))

    def _top_mps(self, hero: Actor) -> float:
        return self.style.top_speeds_mps(self.limits[hero.id])[0]


def _turns_before_trigger(turn: TurnSpan | None, side: LinearCondition | None, hero: int) -> bool:
    if turn is None or side is None or not side.weights[hero][0]:
        return False
    return -side.constant / side.weights[hero][0] > turn.start_m


def _speaks_of_ego(formula: Formula) -> bool:
    return any(actor == EGO for actor, _ in knots_of(formula))
