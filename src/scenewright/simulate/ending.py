"""When a run is over: all that the program tells of has happened, or will not happen any more.

What enters: the program, the plans in force, and where everybody is. What leaves: whether to go on.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, isfinite

from scenewright.motion.profile import Profile
from scenewright.program import expressions as ex
from scenewright.program.evaluate import term_value
from scenewright.program.magnitudes import LONGEST_S
from scenewright.program.structure import actors_of, knots_of, read_structure
from scenewright.program.types import EGO, Program
from scenewright.roads.grounding import Scene
from scenewright.simulate.port import Snapshot
from scenewright.solve.arrival import LinearCondition, linear_conditions
from scenewright.solve.plan import PlanWorld

LONGEST_RUN_S = float(LONGEST_S)  # what comes later is refuted before anything is driven
# What is shown after the last knot, and how long an ego is waited for that has yet to pass, or that stands; chosen.
_AFTER_HEROES_S, _WAIT_FOR_EGO_S, _STALLED_S = 2.0, 10.0, 20.0
_SEEN_S = 0.5  # beyond what a stand has to last, for it to be seen to; chosen
_THERE = 0.1  # so many metres, or metres a second, from what tells a moment it has come; chosen
STANDS_MPS, _MOVES_MPS = 0.1, 0.5  # that of the manner; chosen
ROUTE_END_M = 3.0  # who hardly moves so near to the end of its road has come to it: policies stop short of it; chosen


class Ending:
    """Watches one run for its end."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self._told, self._meets = scene, _told_times(scene.program), _meets_ego(scene.program)
        self._values = {name: float(value) for name, value in scene.parameters.items()}
        self._waits_until_s = 0.0  # for an ego that stands
        self._awaited = _awaited_of(scene)
        told = {name for c in scene.program.constraints for owner, name in knots_of(c.formula) if owner == EGO}
        self._ego_told = told - self._awaited.keys()  # only a plan says when these come
        self._first: dict[str, float] = {}  # by knot: the value of what is awaited when the run began

    def is_now(self, plans: Mapping[int, Profile], now: Snapshot) -> bool:
        """Whether the run is over; to be asked at every step.

        An ego that has not moved for long is not waited for, once all is over that was planned when it came to a stand,
        nor one at the end of its road, where no hero meets it.
        """
        time_s, ego, route = now.time_s, now.actors[EGO], self.scene.routes[EGO]
        # Whoever is at the end of its route does nothing more that a program asks for; others may.
        heroes = [hero.id for hero in self.scene.program.heroes]
        going = [h for h in heroes if now.actors[h].s_m < self.scene.routes[h].landmarks["route_end"]]
        last_knot_s = max((max(plans[hero].knot_times_s.values()) for hero in going), default=-_WAIT_FOR_EGO_S)
        stands_s = float(self.scene.program.manner.stands_s) + _SEEN_S
        ego_told_s = (at_s for knot, at_s in plans[EGO].knot_times_s.items() if knot in self._ego_told)
        planned_s = max(self._told_s(plans), last_knot_s + max(_AFTER_HEROES_S, stands_s), *ego_told_s)
        awaits = self._awaits(now)
        if ego.speed_mps > STANDS_MPS or time_s == 0.0:
            self._waits_until_s = max(time_s + _STALLED_S, planned_s)
        end_m = route.landmarks["route_end"]
        at_end = ego.s_m >= end_m - (ROUTE_END_M if ego.speed_mps < _MOVES_MPS else 0.0)
        waits = any(plans[hero].knot_times_s.get(knot, 0.0) > time_s for hero, knot in self._meets.items())
        if time_s >= LONGEST_RUN_S or time_s > self._waits_until_s or (at_end and waits):
            return True
        if time_s < planned_s or (awaits and not at_end):
            return False
        if time_s < last_knot_s + _WAIT_FOR_EGO_S and self._any_turning(now):
            return False
        passed = at_end or ego.s_m > route.landmarks.get("junction_end", end_m) + 5.0
        return passed or time_s >= last_knot_s + _WAIT_FOR_EGO_S

    def _awaits(self, now: Snapshot) -> bool:
        """Whether a moment of the ego has yet to come that a place, or what it has to do with others, tells."""
        for name, condition in tuple(self._awaited.items()):
            states = {actor: (now.actors[actor].s_m, now.actors[actor].speed_mps) for actor in condition.weights}
            value, per_metre = condition.value(states), condition.weights[EGO][0]
            place = per_metre if len(states) == 1 else 0.0
            passes = place or -self._first.setdefault(name, value)
            comes = place and now.actors[EGO].speed_mps > _MOVES_MPS  # who moves on will have passed it
            if value * passes >= 0.0 or (abs(value) < _THERE and not comes):
                del self._awaited[name]
        return bool(self._awaited)

    def _told_s(self, plans: Mapping[int, Profile]) -> float:
        """Return the latest time that the program tells, as planned (s)."""
        world = PlanWorld(self.scene, plans, self._values)
        return max((at_s for time in self._told if isfinite(at_s := term_value(time, world))), default=0.0)

    def _any_turning(self, now: Snapshot) -> bool:
        """Whether a hero is on its way through the junction: which way it went is part of the story."""
        for hero in self.scene.program.heroes:
            places, there = self.scene.routes[hero.id].landmarks, now.actors[hero.id]
            begins_m, ends_m = (places.get(f"junction_{end}", -inf) for end in ("start", "end"))
            if begins_m < there.s_m < ends_m and there.speed_mps > _MOVES_MPS:
                return True
        return False


def _told_times(program: Program) -> list[ex.Term]:
    """Return the times that a program tells by the clock, or as so long after a moment."""
    nodes = [node for constraint in program.constraints for node in ex.walk(constraint.formula)]
    told: list[object] = [node.at for node in nodes if isinstance(node, ex.State | ex.Derived)]
    told += [edge for node in nodes if isinstance(node, ex.Temporal) for edge in (node.start, node.end)]
    return [time for time in told if isinstance(time, ex.Number | ex.Arithmetic)]


def _awaited_of(scene: Scene) -> dict[str, LinearCondition]:
    """Return what tells when the ego is at its own moments: a place, or the edge of a bound on it; else an equality.

    A trigger that both decide has come when the hero acts.
    """
    found, structure = dict[str, LinearCondition](), read_structure(scene.program)
    told = linear_conditions(scene, structure, with_bounds=True)
    of_ego = [condition for condition in told if EGO in condition.weights]
    of_both = {key for condition in of_ego if len(condition.weights) > 1 for key in condition.moments}
    acted = of_both & {key for instant in structure.triggers.values() for key in instant}
    for condition in sorted(of_ego, key=lambda each: not each.weights[EGO][0]):  # those on its place first
        (owner, name), *others = condition.moments
        formula = scene.program.constraint(condition.constraint_id).formula
        is_equality = isinstance(formula, ex.Compare) and formula.operator == "=="
        if owner == EGO and not others and (EGO, name) not in acted and (is_equality or condition.weights[EGO][0]):
            found.setdefault(name, condition)
    return found


def _meets_ego(program: Program) -> dict[int, str]:
    """Return the trigger knot of each hero whose trigger speaks of the ego."""
    structure = read_structure(program)
    return {
        hero: structure.trigger_knot(hero) or ""
        for hero, instant in structure.triggers.items()
        if any(EGO in actors_of(c.formula) for c in program.constraints if set(knots_of(c.formula)) <= instant)
    }
