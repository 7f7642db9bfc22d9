"""How the ego will drive, as far as can be told: alone by a predictor, behind a hero as people follow.

What enters: what was seen of the ego, and what heroes are to do. What leaves: how it goes on, on which side of it
heroes keep that share its lane, and what it would make of those that do otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.motion.limits import Signs
from scenewright.motion.profile import Profile
from scenewright.plan.following import Leader, foresee_follower
from scenewright.plan.prediction import ConstantSpeed, EgoSample, Predictor
from scenewright.program.structure import Structure, placed_at
from scenewright.program.types import EGO, Actor
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition

_SHORTEST_S = 0.1  # in less time nothing can be answered
_LITTLE = 0.1  # by so many metres, or metres a second, heroes are foreseen otherwise to ask for an answer
# Places that lie further apart than this tell who is ahead: a car and as much room as is kept from the ego.
_TELLING_M = VEHICLE_LENGTH_M + 1.5
# A difference of places may depend on speeds too: what people drive in town tells the side.
_TYPICAL_MPS = 10.0

Motions = Mapping[int, Profile]


@dataclass(frozen=True, slots=True)
class Clearance:
    """Whether the hero is ahead, what to add to its arc length to compare it with the ego's (m).

    And whether the trigger speaks of the distance itself, and from where on the hero is on that lane (m).
    """

    ahead: bool
    offset_m: float
    of_distance: bool = True
    since_m: float = 0.0

    @property
    def side(self) -> float:
        """1 where it keeps ahead of the ego, -1 behind."""
        return 1.0 if self.ahead else -1.0

    @property
    def leads(self) -> bool:
        """Whether the ego follows it, as it is to keep a distance behind it."""
        return self.ahead and self.of_distance

    @property
    def behind_all_along(self) -> bool:
        """Whether it is behind the ego on its lane from the start on."""
        return not self.ahead and not self.since_m

    @classmethod
    def of(
        cls, scene: Scene, structure: Structure, conditions: Sequence[LinearCondition], hero: Actor
    ) -> Clearance | None:
        """Return it for a hero whose trigger, or else whose start, tells where both are on their lane, else None.

        Nobody drives through anybody, so whoever is ahead at one moment is so all along.
        """
        conflict = scene.conflict(EGO, hero.id)
        if conflict is None or conflict.kind == "crossing":
            return None
        follows = conflict.kind == "following"
        since_m = 0.0 if follows else conflict.s_b_m
        start = frozenset((actor.id, actor.sketch.knots[0]) for actor in scene.program.actors)
        trigger, offset_m = structure.triggers.get(hero.id, frozenset()), scene.offset_m(EGO, hero.id)
        for instant in (trigger, start):
            told = [condition for condition in conditions if condition.moments <= instant]
            for condition in told:
                if set(condition.weights) != {EGO, hero.id}:
                    continue
                gap_m = _gap_m(condition, hero.id, offset_m)
                if gap_m:  # that one is ahead at all, a bound of 0, says nothing of the distance
                    return cls(gap_m > 0.0, offset_m, instant == trigger, since_m)
            places_m = {
                actor: -condition.constant / metre
                for condition in told
                for actor, (metre, second) in condition.weights.items()
                if len(condition.weights) == 1 and metre and not second
            }
            if follows and {EGO, hero.id} <= set(places_m):
                gap_m = places_m[hero.id] + offset_m - places_m[EGO]
                if abs(gap_m) >= _TELLING_M:
                    return cls(gap_m > 0.0, offset_m, of_distance=False)
        return None


@dataclass(frozen=True, slots=True)
class Answer:
    """How an ego that follows a hero answers what that does, to first order, at the hero's trigger.

    It was foreseen with a motion of the hero, and its trigger at a time. For each metre by which the hero is further on
    then, the ego is `per_metre` further on (m) and faster (m/s); for each metre a second by which the hero is faster
    all along, from the same place on, `per_mps`: None where it is further on only by being ever faster from now on.
    """

    motion: Profile
    trigger_s: float
    per_metre: tuple[float, float]
    per_mps: tuple[float, float] | None = None

    def then(self, time_s: float) -> tuple[float, float, float]:
        """Return the hero's state with which the ego was foreseen, had its trigger not come."""
        late_s = time_s - self.trigger_s
        if late_s <= 0.0:
            return self.motion.state(time_s)
        s_m, speed_mps, _ = self.motion.state(self.trigger_s)
        return s_m + speed_mps * late_s, speed_mps, 0.0


@dataclass(slots=True)
class Foresight:
    """Foresees one ego over one run.

    `predictor` foresees it where it follows nobody, and `behind` where it does, as if it followed nobody; `signs` tell
    how fast it drives where it can. `samples` of it were seen, in time order. Of heroes `on_lane` it is known on which
    side of it they keep.
    """

    scene: Scene
    structure: Structure
    conditions: Sequence[LinearCondition]
    predictor: Predictor
    behind: Predictor
    signs: Signs
    samples: list[EgoSample] = field(default_factory=list)
    on_lane: dict[int, Clearance] = field(init=False)

    def __post_init__(self) -> None:
        heroes = self.scene.program.heroes
        lanes = {hero.id: Clearance.of(self.scene, self.structure, self.conditions, hero) for hero in heroes}
        self.on_lane = {hero: lane for hero, lane in lanes.items() if lane is not None}

    def take_sides(self, motions: Motions, until: Mapping[int, str]) -> bool:
        """Let whoever is on its lane, and nothing tells the side of, keep to that on which it is at a knot of its own.

        Or that on which it begins, where the program says where. Return whether that is anybody.
        """
        found: dict[int, Clearance] = {}
        for hero, knot in until.items():
            conflict = self.scene.conflict(EGO, hero)
            if hero not in self.on_lane and conflict is not None and conflict.kind == "following":
                start = frozenset({(hero, self.scene.program.actor(hero).sketch.knots[0])})
                at_s = 0.0 if hero in placed_at(self.scene.program, start) else motions[hero].knot_times_s[knot]
                offset_m = self.scene.offset_m(EGO, hero)
                ahead = motions[hero].state(at_s)[0] + offset_m > motions[EGO].state(at_s)[0]
                found[hero] = Clearance(ahead, offset_m, of_distance=False)
        self.on_lane = {**self.on_lane, **found}
        return bool(found)

    def keeps_behind(self, hero: int) -> bool:
        """Whether a hero is behind it on its lane all along."""
        return hero in self.on_lane and self.on_lane[hero].behind_all_along

    @property
    def is_sure(self) -> bool:
        """Whether it drives as foreseen, as its policy promises."""
        return isinstance(self.predictor, ConstantSpeed)

    def leaders(self, motions: Motions) -> dict[int, Clearance]:
        """Return the heroes that drive ahead of it now, where it is not known to hold its speed."""
        now_s = self.samples[-1][0]
        near = {} if self.is_sure else {hero: lane for hero, lane in self.on_lane.items() if lane.leads}
        return {hero: lane for hero, lane in near.items() if motions[hero].state(now_s)[0] >= lane.since_m}

    def at_first(self) -> Profile:
        """Return how it will go on, before it is known how heroes move."""
        led = any(lane.leads for lane in self.on_lane.values())
        return (self.behind if led else self.predictor).predict(self.samples)

    def foreseen(self, motions: Motions) -> Profile:
        """Return how it will go on while heroes move so."""
        leaders = self.leaders(motions)
        prediction = (self.behind if leaders else self.predictor).predict(self.samples)
        for hero, clearance in leaders.items():
            leader = Leader(motions[hero], clearance.offset_m)
            prediction = foresee_follower(prediction, self.samples, leader, self._cruise_mps(leader))
        return prediction

    def _cruise_mps(self, leader: Leader) -> float:
        """Return how fast people drive where a leader is."""
        return self.signs.at_mps(leader.state(self.samples[-1][0])[0])

    def answers(self, motions: Motions, time_s: float, prediction: Profile, *, first: bool) -> dict[int, Answer]:
        """Return what it makes of heroes that it follows, and that do not move just so."""
        found: dict[int, Answer] = {}
        for hero, clearance in self.leaders(motions).items():
            trigger_s = motions[hero].knot_times_s.get(self.structure.trigger_knot(hero) or "", time_s)
            if trigger_s > time_s:
                span_s, offset_m = (time_s, trigger_s), clearance.offset_m
                found[hero] = self._answer(motions[hero], offset_m, span_s, prediction, first=first)
        return found

    def _answer(
        self, motion: Profile, offset_m: float, span_s: tuple[float, float], prediction: Profile, *, first: bool
    ) -> Answer:
        """Return how it answers a hero by the end of a span: from what it makes of one that moves otherwise."""
        now_s, then_s = span_s
        alone, (place_m, speed_mps, _) = self.behind.predict(self.samples), prediction.state(then_s)

        def answered(leader: Leader) -> tuple[float, float]:
            then = foresee_follower(alone, self.samples, leader, self._cruise_mps(leader)).state(then_s)
            return (then[0] - place_m) / _LITTLE, (then[1] - speed_mps) / _LITTLE

        if first:
            further, faster = Leader(motion, offset_m, further_m=_LITTLE), Leader(motion, offset_m, faster_mps=_LITTLE)
            return Answer(motion, then_s, answered(further), answered(faster))
        lasts_s = max(then_s - now_s, _SHORTEST_S)
        ever_faster = Leader(motion, offset_m, now_s, ever_faster_mpss=_LITTLE * 2.0 / lasts_s**2)
        return Answer(motion, then_s, answered(ever_faster))


def _gap_m(condition: LinearCondition, hero: int, offset_m: float) -> float | None:
    """Return how far ahead of the ego (m) the hero is where `condition` holds; None where it is about another thing."""
    hero_metre, hero_speed = condition.weights[hero]
    ego_metre, ego_speed = condition.weights[EGO]
    if hero_metre == 0.0 or abs(hero_metre + ego_metre) > 1e-9:
        return None
    rest = condition.constant + (hero_speed + ego_speed) * _TYPICAL_MPS - hero_metre * offset_m
    return -rest / hero_metre
