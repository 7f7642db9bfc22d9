"""How a run stands: what is known of the ego, the plan in force, and what the next plan starts from.

What enters: the ego's states, tick by tick. What leaves: `Situation`s. History is fixed; a hero freezes at its trigger,
but for later pieces that react to the ego. Nothing is planned here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import InitVar, dataclass, field
from itertools import pairwise

import numpy as np

from scenewright.motion.limits import Limits, Signs
from scenewright.motion.profile import Profile, chain
from scenewright.plan.asked import Asked
from scenewright.plan.foresight import Foresight, Motions
from scenewright.plan.guesses import JOINT_S
from scenewright.plan.prediction import EgoSample, Predictor
from scenewright.plan.situation import Drive, SeenAndForeseen, Situation
from scenewright.plan.triggers import SHORTEST_LEAD_S, TriggerTimes
from scenewright.plan.unknowns import LEAST_S
from scenewright.program import expressions as ex
from scenewright.program.structure import Role, Structure, actors_of, knots_of, with_ego
from scenewright.program.types import EGO, Actor, PieceKind
from scenewright.roads.grounding import Scene
from scenewright.solve.arrival import LinearCondition, linear_conditions
from scenewright.solve.parameters import everyday
from scenewright.solve.plan import Plan
from scenewright.solve.proofs.forms import free_actors, lasting_places
from scenewright.solve.proofs.witness import Witness

# By how much a trigger of several heroes moves in a tick at most (s), unless it is so far off and comes so soon that it
# has to: then by so much (s) of what is missing, for each second that is left. Steps from far off are slow. Measured
# (docs/many-heroes.md): the longest ticks, with an ego that stops and goes, take a third as long, and as many are met;
# with 0.25 s, with 0.3 s of what is missing, or with neither fewer are.
_MOVES_S, _SOON_S = 0.5, 0.5
# The share of the time left at which a look comes, of even ones, as a power; chosen.
_SOONER = 1.5


@dataclass(slots=True)
class Standing:
    """One scene over one run, as it stands.

    `limits` are those of every actor, by id; `conditions` the scene's linear ones; `witness` tells how it can happen,
    if that is known. The ego is foreseen by `predictor` where it follows nobody, by `behind` where it follows a hero,
    on top of what that makes of it (None: as elsewhere); `signs` tell how fast it drives where it can (None: as its
    road is signed). `plan` is being carried out; `ego_knots_s` tell when the ego passed its knots.
    """

    scene: Scene
    structure: Structure
    limits: Mapping[int, Limits]
    predictor: InitVar[Predictor]
    conditions: tuple[LinearCondition, ...]
    witness: Witness | None = None
    behind: InitVar[Predictor | None] = None
    signs: InitVar[Signs | None] = None
    plan: Plan = field(init=False)
    ego_knots_s: dict[str, float] = field(init=False, default_factory=dict)
    _asked: Asked = field(init=False)
    _times: TriggerTimes = field(init=False)
    _moments_s: Mapping[int, float] = field(init=False, default_factory=dict)  # of the plan, by instant
    _others: Mapping[int, float] = field(init=False, default_factory=dict)  # its other unknowns, by number
    _ego: Foresight = field(init=False)
    _reactive: dict[int, list[int]] = field(init=False, default_factory=dict)  # pieces after the trigger
    _joint_s: dict[int, float] = field(init=False, default_factory=dict)  # first planned, where both decide when

    def __post_init__(self, predictor: Predictor, behind: Predictor | None, signs: Signs | None) -> None:
        self._asked = Asked(self.scene, self.structure, self.limits)
        for hero, until in self._asked.adapts_until.items():
            actor = self.scene.program.actor(hero)
            self._reactive[hero] = [*self._reactive_pieces(actor, actor.sketch.knot_index(until))]
        self._times = TriggerTimes(self.scene, self.structure, self.conditions)
        signs = signs or Signs.of(self.scene.routes[EGO], self.scene.road_map)
        told = linear_conditions(everyday(self.scene), self.structure, with_bounds=True)  # sides, as with any values
        self._ego = Foresight(self.scene, self.structure, told, predictor, behind or predictor, signs)

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step, and of the knots that it passed in it."""
        previous = self._ego.samples[-1]
        self._ego.samples.append(sample)
        knots, passed_s = self.scene.program.ego.sketch.knots, self.plan.profiles[EGO].knot_times_s
        for instant in (*self.structure.triggers.values(), *self.structure.instants):
            planned = min(
                (self.plan.profiles[o].knot_times_s.get(k, np.inf) for o, k in instant if o != EGO), default=np.inf
            )
            for owner, name in instant if planned <= sample[0] else ():
                if owner == EGO:
                    self.ego_knots_s.setdefault(name, planned)  # the moment is the same
        for condition in self._times.ego_alone:
            knot = next(iter(condition.moments))[1]
            earlier = [k for k in knots[: knots.index(knot)] if k not in self.ego_knots_s]
            if knot in self.ego_knots_s or not self._times.told.isdisjoint(earlier):
                continue
            before, after = (condition.value({EGO: state[1:3]}) for state in (previous, sample))
            if before != after and before * after <= 0:
                self.ego_knots_s[knot] = now_s = previous[0] + before / (before - after) * (sample[0] - previous[0])
                for k in earlier:  # nothing tells when
                    self.ego_knots_s[k] = min(passed_s.get(k, now_s), now_s)

    # -- what a plan starts from --------------------------------------------------------------------------------------
    def _now(self, time_s: float, prediction: Profile, guesses: Motions | None = None) -> Situation:
        """Return a situation in which no moment is known yet, but the ego, and what it makes of how heroes move.

        They move as in the plan in force; before the first plan so as is guessed.
        """
        motions, first = (self.plan.profiles, False) if guesses is None else (guesses, True)
        answers = self._ego.answers(motions, time_s, prediction, first=first)
        ego = SeenAndForeseen(self._ego.samples, prediction)
        return Situation(time_s, ego, self._ego.is_sure, self._ego.on_lane, answers, guesses or {}, self._others)

    def _first_situation(self, prediction: Profile, guesses: Motions) -> Situation:
        now = self._now(0.0, prediction, guesses)
        knots, expected, least_s = now.knots_s, now.expected_s, self._asked.least_s
        for hero in self._heroes:
            if (name := self.structure.trigger_knot(hero.id)) is not None:
                instant = self._asked.knot(hero.id, name)
                if hero.id in self._times.sides:
                    now.triggers_s[hero.id] = knots[instant] = self._times.instant_s(hero, 0.0, prediction, None)
                else:
                    expected[instant] = now.planned_s[instant] = guesses[hero.id].knot_times_s.get(name, JOINT_S)
        self._foresee_knots(now, prediction)
        for actor in self.scene.program.actors:
            then_s, told = 0.0, guesses[actor.id].knot_times_s if actor.id in guesses else {}
            before = self._asked.knot(actor.id, actor.sketch.knots[0])
            for name in actor.sketch.knots:
                instant = self._asked.knot(actor.id, name)
                if instant not in knots:
                    soonest_s = [at_s + least_s[known, instant] for known, at_s in knots.items()]
                    chained = self.structure.trigger_knot(actor.id) is None and actor.id in self._asked.adapts_until
                    lasts_s = max(self._asked.wanted.lasts_s, least_s[before, instant])
                    usual_s = max([then_s + lasts_s, *(soonest_s if chained else ())])
                    expected.setdefault(instant, told.get(name, usual_s))
                then_s, before = knots.get(instant, expected.get(instant, then_s)), instant
        for instant, at_s in self._moments_s.items():
            if instant not in knots:
                expected.setdefault(instant, at_s)
        for (first, last, _), made in self._asked.lowering.happens.items():
            ends_s = [knots.get(end, expected.get(end, 0.0)) for end in (first, last)]
            expected.setdefault(made, 0.5 * sum(ends_s))
        self._look(now)
        return now

    def _situation(self, time_s: float, prediction: Profile) -> tuple[Situation, float]:
        """Return what to plan from now, and by how much triggers have moved of which the ego decides (s)."""
        now, moved_s = self._now(time_s, prediction), 0.0
        knots, expected = now.knots_s, now.expected_s
        for hero in self._heroes:
            profile, names = self.plan.profiles[hero.id], hero.sketch.knots
            piece = self._open_piece(hero, time_s)
            first = len(hero.sketch.pieces) if piece is None else piece
            begin_s = max(time_s, profile.knot_times_s.get(names[first], time_s))
            now.heroes[hero.id] = Drive(begin_s, first, profile)
            for number, name in enumerate(names):
                (knots if number <= first else expected)[self._asked.knot(hero.id, name)] = profile.knot_times_s[name]
            trigger = self.structure.trigger_knot(hero.id)
            if trigger is None or (instant := self._asked.knot(hero.id, trigger)) in knots:
                continue
            before_s = profile.knot_times_s[trigger]
            if hero.id not in self._times.sides:
                now.planned_s[instant] = self._joint_s[hero.id]
                if (sooner_s := self._comes_true_s(hero, time_s, prediction, before_s)) is not None:
                    expected[instant] = now.planned_s[instant] = sooner_s
                continue
            then_s = self._times.instant_s(hero, time_s, prediction, before_s)
            if len(self.scene.program.heroes) > 1:
                most_s = max(_MOVES_S, abs(then_s - before_s) * _SOON_S / (then_s - time_s))
                then_s = min(max(then_s, before_s - most_s), before_s + most_s)
            now.triggers_s[hero.id] = knots[instant] = then_s
            moved_s = max(moved_s, abs(then_s - before_s))
            for later in names[names.index(trigger) + 1 :]:  # what follows keeps its place in time after it
                expected[self._asked.knot(hero.id, later)] += then_s - before_s
        self._foresee_knots(now, prediction)
        for instant, at_s in self._moments_s.items():  # places that were passed, and what happened, are history too
            if instant not in knots and instant not in expected:
                (knots if at_s <= time_s else expected)[instant] = at_s
        self._look(now)
        return now, moved_s

    def _comes_true_s(self, hero: Actor, time_s: float, prediction: Profile, planned_s: float) -> float | None:
        """Return when a condition on both comes true before it is planned to, if the hero goes on as it is.

        An ego that follows a hero answers whatever that does: the less it does, the better the ego is foreseen.
        """
        here = [c for c in self.conditions if c.moments <= self.structure.triggers[hero.id]]
        if len(here) != 1 or set(here[0].weights) != {EGO, hero.id}:
            return None
        s_m, speed_mps, _ = self.plan.profiles[hero.id].state(time_s)
        even = Profile(chain(time_s, s_m, speed_mps, [(1.0, 0.0, 0)]))
        found = here[0].first_time({EGO: prediction, hero.id: even}, time_s + SHORTEST_LEAD_S)
        return found if found is not None and found < planned_s else None

    def _look(self, now: Situation) -> None:
        """Add when to look at what has to last, from now to where the last of it ends: the sooner, the more often.

        What is further off is looked at again, and an ego that is foreseen to change its speed may do so between two.
        """
        asked, last_s = self._asked, now.time_s
        for _, instant in asked.stretches:
            constant, moments_s = asked.events.times[instant].constant, now.expected_s | now.knots_s
            last_s = max(last_s, moments_s.get(instant, last_s) if constant is None else float(constant))
        shares = np.linspace(0.0, 1.0, len(asked.looks) + 1)[1:] ** _SOONER
        looks_s = (now.time_s + (last_s - now.time_s) * shares).tolist()
        now.knots_s.update(zip(asked.looks, looks_s, strict=True))

    # -- what is known ------------------------------------------------------------------------------------------------
    @property
    def _heroes(self) -> Iterable[Actor]:
        return self.scene.program.heroes

    def _foresee_knots(self, now: Situation, prediction: Profile) -> None:
        """Add when the ego passes its knots, by instant, as far as they are not known.

        What would come before a hero has done what is to be done before is put off: it cannot act sooner.
        """
        knots = now.knots_s
        for name, at_s in self._times.ego_knots_s(now.time_s, prediction, self.ego_knots_s, now.triggers_s).items():
            knots.setdefault(self._asked.knot(EGO, name), at_s)
        for hero in self._heroes:
            soonest_s = 0.0
            for instant in (self._asked.knot(hero.id, name) for name in hero.sketch.knots):
                if instant in knots:
                    knots[instant] = max(knots[instant], soonest_s)
                    soonest_s = knots[instant] + LEAST_S

    def _open_piece(self, hero: Actor, time_s: float) -> int | None:
        """Return the piece from which on a hero is still solved for, or None once it only carries out.

        Before its trigger (or what hangs on another's) that is the piece it is in. After it, that in which it answers
        the ego, or just drives on behind it.
        """
        times, sketch = self.plan.profiles[hero.id].knot_times_s, hero.sketch
        soon_s = time_s + SHORTEST_LEAD_S  # what comes sooner could only be put off
        current = sum(1 for knot in sketch.knots[1:] if times.get(knot, float("inf")) < soon_s)
        trigger = self._asked.adapts_until.get(hero.id)
        if trigger is None:
            return None
        if current < sketch.knot_index(trigger):
            return current
        answers = set(self._reactive[hero.id])
        if self._ego.keeps_behind(hero.id):  # who stands sets off as planned: it is that which sets it off
            kinds = enumerate(pairwise((None, *sketch.pieces)))
            answers |= {n for n, (before, kind) in kinds if kind is PieceKind.GO and before is not PieceKind.STOP}
        later = range(max(current, sketch.knot_index(trigger)), len(sketch.pieces))
        return next((piece for piece in later if piece in answers), None)

    def _reactive_pieces(self, hero: Actor, trigger: int) -> Iterator[int]:
        """Yield the pieces after the trigger in which a hero answers the ego.

        It stands until something that is compared with the ego's; or what it does ends at a moment of the ego's or so
        long after one, or it has to be somewhere beside it meanwhile.
        """
        knots, pieces, constraints = hero.sketch.knots, hero.sketch.pieces, self.scene.program.constraints
        outcomes = (each.formula for each in constraints if self.structure.roles[each.id] is Role.OUTCOME)
        orders = [set(knots_of(formula)) for formula in outcomes if EGO in actors_of(formula)]
        beside = [node.start for node in lasting_places(self.scene.program) if EGO in free_actors(node.body)]
        least_s = self._asked.least_s
        for piece in range(trigger, len(pieces)):
            later = {(hero.id, name) for name in knots[piece + 1 :]}
            waits = any(keys & later for keys in orders)
            goes_on = ex.Elapsed(hero.id, knots[piece]) in beside
            goes_on |= with_ego(self.scene.program, self.structure.instants, hero.id, knots[piece + 1]) is not None
            begins, ends = (self._asked.knot(hero.id, name) for name in knots[piece : piece + 2])
            goes_on |= any(least_s[at, ends] > 0.0 > least_s[at, begins] for at in self._asked.of_ego)
            if (pieces[piece] is PieceKind.STOP and waits) or goes_on:
                yield piece
