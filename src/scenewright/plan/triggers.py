"""When a trigger comes of which the ego decides: where it is at its side of it, as it is foreseen.

What enters: a scene's linear conditions, and what is foreseen of the ego. What leaves: instants. It plans nothing; a
trigger that a hero decides too is for the planning problem itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scenewright.motion.profile import Profile
from scenewright.program import expressions as ex
from scenewright.program.structure import Structure, actors_of, knots_of
from scenewright.program.types import EGO, Actor, Program
from scenewright.roads.conflicts import shared_offset_m
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import TIGHT_LENGTH_M, LinearCondition, of_ego, tight_of
from scenewright.solve.proofs.forms import free_actors, lasting_places

# How soon a trigger may come (s): nobody can tell what begins sooner from what has begun.
SHORTEST_LEAD_S = 0.02
# What is further off than this (s) is not foreseen: to know that it is will do; at first, that it comes at all.
_LATEST_S, _FAR_S = 12.0, 40.0
# How soon a trigger was to come (s) that the ego may have met between two ticks; how late it would come again; how far
# off (in tight tolerances) the ego is then at most.
_DUE_S, _AGAIN_S, _AS_GOOD = 0.12, 0.2, 0.8
# Who does not get nearer to its place than this before it stands is there.
_STANDS_MPS, _STANDS_THERE_M = 0.02, 0.9 * TIGHT_LENGTH_M


@dataclass(slots=True)
class TriggerTimes:
    """Tells for one scene when triggers come.

    It began at a place (m) and speed (m/s), `ego_began`. Of heroes of whose triggers the ego decides when they come,
    `sides` has the condition on it alone that each waits for. At knots that it passes by itself, not those that it
    shares with a trigger, it meets the conditions `ego_alone`; these, or others' moments, tell its knots `told`.
    """

    scene: Scene
    structure: Structure
    conditions: tuple[LinearCondition, ...]
    ego_began: tuple[float, float] = (0.0, 0.0)
    ego_alone: list[LinearCondition] = field(init=False)
    told: set[str] = field(init=False)
    sides: dict[int, LinearCondition] = field(init=False)

    def __post_init__(self) -> None:
        heroes = [hero for hero in self.scene.program.heroes if hero.id in self.structure.triggers]
        self.sides = {hero.id: side for hero in heroes if (side := self._side(hero)) is not None}
        shared = {key for instant in self.structure.triggers.values() for key in instant}
        own = {(EGO, name) for name in self.scene.program.ego.sketch.knots[1:]} - shared
        self.ego_alone = [c for c in self.conditions if set(c.weights) == {EGO} and c.moments <= own]
        moments = shared.union(*self.structure.instants, *(c.moments for c in self.ego_alone))
        self.told = {name for owner, name in moments if owner == EGO}

    def _side(self, hero: Actor) -> LinearCondition | None:
        here = [c for c in self.conditions if c.moments <= self.structure.triggers[hero.id]]
        alone = [c for c in here if set(c.weights) == {EGO}]
        known = alone if self._leads(hero, here) else of_ego(here, self.structure)
        return next((c for c in known if c.weights[EGO][0]), None)

    def _leads(self, hero: Actor, conditions: list[LinearCondition]) -> bool:
        """Whether conditions put a hero ahead of the ego on its lane: that one comes there as the hero lets it."""
        offset_m = shared_offset_m(self.scene.routes[EGO], self.scene.routes[hero.id])
        apart = [c for c in conditions if set(c.weights) == {EGO, hero.id} and c.weights[hero.id][0]]
        return offset_m is not None and any(offset_m - c.constant / c.weights[hero.id][0] > 0.0 for c in apart)

    def instant_s(self, hero: Actor, time_s: float, prediction: Profile, planned_s: float | None) -> float:
        """Return when a hero's trigger comes of which the ego decides (it is in `sides`).

        By the plan in force it comes at `planned_s`; None where nothing is planned yet.
        """
        side = self.sides[hero.id]
        arrival = self._arrival_s(side, time_s, prediction)
        arrival_s = time_s + _FAR_S if arrival is None else max(arrival, time_s + SHORTEST_LEAD_S)
        if planned_s is None:
            return arrival_s
        due_s = max(planned_s, time_s + SHORTEST_LEAD_S)
        if planned_s < time_s + _DUE_S and arrival_s > due_s + _AGAIN_S and _miss(side, prediction, due_s) <= _AS_GOOD:
            return due_s  # it was there between two ticks, a moment sooner than foreseen
        stands = _standing(side, time_s, prediction, arrival_s)
        if stands is not None:
            return min(max(planned_s, stands[0]), stands[1])
        return min(arrival_s, max(time_s + _LATEST_S, planned_s))

    def _arrival_s(self, condition: LinearCondition, after_s: float, prediction: Profile) -> float | None:
        """Return when the ego first meets a condition: at once where it is past what lay ahead when the run began."""
        arrival = condition.first_time({EGO: prediction}, after_s)
        began, then = (condition.value({EGO: state}) for state in (self.ego_began, prediction.state(after_s)))
        return after_s if arrival is None and began * then < 0.0 else arrival

    def ego_knots_s(
        self, time_s: float, prediction: Profile, past: Mapping[str, float], triggers_s: Mapping[int, float]
    ) -> dict[str, float]:
        """Return when the ego passes its knots: those behind it, its triggers, and those it is predicted to reach."""
        knots = dict(past)
        for hero, instant_s in triggers_s.items():
            for owner, name in self.structure.triggers[hero]:
                if owner == EGO:
                    knots[name] = instant_s
        order = self.scene.program.ego.sketch.knot_index
        alone = ((next(iter(condition.moments))[1], condition) for condition in self.ego_alone)
        for name, condition in sorted(alone, key=lambda each: order(each[0])):
            if name not in knots:
                latest = max([time_s, *(at_s for known, at_s in knots.items() if order(known) < order(name))])
                arrival = self._arrival_s(condition, latest, prediction)
                if arrival is None and not condition.weights[EGO][0]:
                    arrival = time_s + _LATEST_S  # how fast it will be once answers what others do until then
                if arrival is not None:
                    knots[name] = arrival
        return knots


def adapts_until(program: Program, structure: Structure, behind_ego: Mapping[int, str]) -> dict[int, str]:
    """Return the knot up to which each hero adapts: its trigger, or the first that hangs on a hero that adapts.

    So whoever brakes 1.5 s after another one began, which does so at a trigger, waits for that as well. And who has to
    be somewhere beside others all the while, or until they are somewhere, adapts up to its last one, and who has no
    trigger up to the first that is told not to come before a moment of the ego's: one that comes before it is nothing
    that the ego could be waited for.
    """
    found = {hero: structure.trigger_knot(hero) or "" for hero in structure.triggers}
    found |= {hero: program.actor(hero).sketch.knots[-1] for hero in beside_others(program, structure)}
    found = {**behind_ego, **found}
    while True:
        more: dict[int, str] = {}
        for formula in (constraint.formula for constraint in program.constraints):
            for hero in program.heroes if actors_of(formula) & set(found) else ():
                tied = {name for actor, name in knots_of(formula) if actor == hero.id}
                first = next((name for name in hero.sketch.knots[1:] if name in tied), None)
                if hero.id not in found and first is not None:
                    more[hero.id] = min(first, more.get(hero.id, first), key=hero.sketch.knot_index)
        if not more:
            return found
        found |= more


def beside_others(program: Program, structure: Structure) -> dict[int, tuple[ex.Term, ...]]:
    """Return heroes without a trigger that have to be somewhere beside others, or until others are, and until when."""
    found: dict[int, tuple[ex.Term, ...]] = {}
    for node in lasting_places(program):
        actors = free_actors(node.body)
        others = actors | {each.actor for each in ex.walk(node.end) if isinstance(each, ex.Elapsed)}
        for hero in actors - {EGO, *structure.triggers}:
            if others != {hero}:
                found[hero] = tuple(dict.fromkeys((*found.get(hero, ()), node.end)))
    return found


def _miss(side: LinearCondition, prediction: Profile, instant_s: float) -> float:
    """Return how far the ego will be off its side, in tight tolerances."""
    state = prediction.state(instant_s)
    return abs(side.value({EGO: state[:2]})) / tight_of(side, state[1])


def _standing(side: LinearCondition, time_s: float, prediction: Profile, before_s: float) -> tuple[float, float] | None:
    """Return from when to when (s) the ego stands so near to its place that it is there; None where it does not."""
    per_metre, per_speed = side.weights[EGO]
    soonest_s = time_s + SHORTEST_LEAD_S
    for segment in prediction.segments:
        begin_s = max(segment.start_s, soonest_s)
        stands = segment.speed_mps < _STANDS_MPS and segment.accel_mpss <= 0.0 and segment.end_s > soonest_s
        if stands and begin_s <= before_s and not per_speed:
            off_m = abs(side.value({EGO: (segment.s_m, 0.0)}) / per_metre)
            return (begin_s, segment.end_s) if off_m <= _STANDS_THERE_M else None
    return None
