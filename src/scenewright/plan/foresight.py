"""How the ego will drive, as far as can be told: alone by a predictor, behind a hero as people follow.

What enters: what was seen of the ego, and what heroes are to do. What leaves: how it goes on, and what it would make of
heroes that do otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from scenewright.motion.limits import Signs
from scenewright.motion.profile import Profile
from scenewright.plan.clearance import Clearance
from scenewright.plan.following import Leader, foresee_follower
from scenewright.plan.prediction import ConstantSpeed, EgoSample, Predictor
from scenewright.plan.situation import Answer, Lanes, Otherwise, SeenAndForeseen
from scenewright.program.structure import Structure, placed_at
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition

_SHORTEST_S = 0.1  # in less time nothing can be answered
_LITTLE = 0.1  # by so many metres, or metres a second, heroes are foreseen otherwise to ask for an answer

Motions = Mapping[int, Profile]


@dataclass(slots=True)
class Foresight:
    """Foresees one ego over one run.

    Attributes
    ----------
    predictor, behind
        Foresee it where it follows nobody, and if it followed nobody where it does.
    signs
        How fast it drives on its way where it can.
    samples
        What was seen of it, in time order.
    """

    scene: Scene
    structure: Structure
    conditions: Sequence[LinearCondition]
    predictor: Predictor
    behind: Predictor
    signs: Signs
    samples: list[EgoSample] = field(default_factory=list)
    _on_lane: dict[int, Clearance] = field(init=False)

    def __post_init__(self) -> None:
        heroes = self.scene.program.heroes
        lanes = {hero.id: Clearance.of(self.scene, self.structure, self.conditions, hero) for hero in heroes}
        self._on_lane = {hero: lane for hero, lane in lanes.items() if lane is not None}

    def take_sides(self, motions: Motions, until: Mapping[int, str]) -> bool:
        """Let whoever is on its lane, and nothing tells the side of, keep to that on which it is at a knot of its own.

        Or that on which it begins, where the program says where. Return whether that is anybody.
        """
        found: dict[int, Clearance] = {}
        for hero, knot in until.items():
            conflict = self.scene.conflict(EGO, hero)
            if hero not in self._on_lane and conflict is not None and conflict.kind == "following":
                start = frozenset({(hero, self.scene.program.actor(hero).sketch.knots[0])})
                at_s = 0.0 if hero in placed_at(self.scene.program, start) else motions[hero].knot_times_s[knot]
                offset_m = self.scene.offset_m(EGO, hero)
                ahead = motions[hero].state(at_s)[0] + offset_m > motions[EGO].state(at_s)[0]
                found[hero] = Clearance(ahead, offset_m, of_distance=False)
        self._on_lane |= found
        return bool(found)

    def keeps_behind(self, hero: int) -> bool:
        """Whether a hero is behind it on its lane all along."""
        return hero in self._on_lane and not self._on_lane[hero].ahead and not self._on_lane[hero].since_m

    @property
    def _distances(self) -> dict[int, Clearance]:
        return {hero: lane for hero, lane in self._on_lane.items() if lane.of_distance}

    @property
    def is_sure(self) -> bool:
        """Whether it drives as foreseen, as its policy promises."""
        return isinstance(self.predictor, ConstantSpeed)

    def leaders(self, motions: Motions) -> dict[int, Clearance]:
        """Return the heroes that drive ahead of it now, where it is not known to hold its speed."""
        now_s, found = self.samples[-1][0], dict[int, Clearance]()
        for hero, lane in self._distances.items():
            if lane.ahead and not self.is_sure and motions[hero].state(now_s)[0] >= lane.since_m:
                found[hero] = lane
        return found

    def at_first(self) -> Profile:
        """Return how it will go on, before it is known how heroes move."""
        led = any(lane.ahead for lane in self._distances.values())
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
        return self.signs.at_mps(leader.motion.state(self.samples[-1][0])[0] + leader.offset_m)

    def states(self, prediction: Profile) -> SeenAndForeseen:
        """Return its states, past and foreseen."""
        return SeenAndForeseen(self.samples, prediction)

    def lanes(self, motions: Motions, time_s: float, prediction: Profile, *, first: bool) -> Lanes:
        """Return who keeps on which side of it on its lane, and what it makes of heroes that do not move just so."""
        apart = {hero: (1.0 if lane.ahead else -1.0, lane.offset_m) for hero, lane in self._on_lane.items()}
        found: dict[int, Answer] = {}
        for hero, clearance in self.leaders(motions).items():
            trigger_s = motions[hero].knot_times_s.get(self.structure.trigger_knot(hero) or "", time_s)
            if trigger_s > time_s:
                found[hero] = self._answer(motions[hero], clearance, (time_s, trigger_s), prediction, first=first)
        return Lanes(apart, found, frozenset(self._distances), frozenset(filter(self.keeps_behind, apart)))

    def _answer(
        self, motion: Profile, clearance: Clearance, span_s: tuple[float, float], prediction: Profile, *, first: bool
    ) -> Answer:
        """Return how it answers a hero by the end of a span: from what it makes of one that moves otherwise."""
        now_s, then_s = span_s
        alone, (place_m, speed_mps, _) = self.behind.predict(self.samples), prediction.state(then_s)

        def answered(otherwise: Otherwise) -> tuple[float, float]:
            leader = Leader(otherwise, clearance.offset_m)
            then = foresee_follower(alone, self.samples, leader, self._cruise_mps(leader)).state(then_s)
            return (then[0] - place_m) / _LITTLE, (then[1] - speed_mps) / _LITTLE

        if first:
            further, faster = Otherwise(motion, 0.0, further_m=_LITTLE), Otherwise(motion, 0.0, faster_mps=_LITTLE)
            return Answer(motion, then_s, answered(further), answered(faster))
        lasts_s = max(then_s - now_s, _SHORTEST_S)
        return Answer(motion, then_s, answered(Otherwise(motion, now_s, ever_faster_mpss=_LITTLE * 2.0 / lasts_s**2)))
