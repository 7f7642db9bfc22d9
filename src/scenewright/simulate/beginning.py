"""How a run begins: the ego's first state and the heroes' first plan, chosen together.

What enters: a `World`, and how the ego drove in the last take. What leaves: the best first plan over the ego's possible
starts.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import product

from scenewright.errors import PolicyError
from scenewright.motion.limits import Limits, Signs
from scenewright.motion.profile import Profile
from scenewright.plan.planner import GOOD, Attempt, Planner
from scenewright.plan.prediction import ConstantSpeed, Predictor, Rehearsed
from scenewright.plan.preferences import Preferences
from scenewright.program.expressions import Compare, Derived, DerivedKind, Knot, Number, State
from scenewright.program.starts import AT_ONCE_S, HARD_MPSS, TAILGATES_S, says_how_near
from scenewright.program.structure import read_structure
from scenewright.program.types import EGO, Constraint
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.conflicts import shared_offset_m
from scenewright.roads.grounding import Scene
from scenewright.simulate.builtin import BuiltIn
from scenewright.simulate.ego_start import SHIFTS, EgoFirstState, drives_alone, ego_starts, usual_lead_s
from scenewright.simulate.loop import HeroDriver
from scenewright.simulate.port import Start
from scenewright.simulate.world import World
from scenewright.solve.arrival import linear_conditions, of_ego
from scenewright.solve.holding import not_held
from scenewright.solve.parameters import everyday, rounded
from scenewright.solve.proofs.decide import Question, shown
from scenewright.solve.proofs.forms import TIGHT, compared_dimension
from scenewright.units import pin

# Who is further off than along a shared road by so much is not on it yet; chosen, lanes are 3 m apart.
_SAME_ROAD_M = 1.0
# Newton steps after which nothing but a last resort is tried: of 160 cases of the benchmark none did well after more.
_MOST_STEPS = 700
_DIGITS = 0, 1, 2  # of values that are chosen anew: as round as they can be
_GUESSES = 12  # from which a witness is sought in which the ego holds its speed; of what can happen 29 in 30 take six


def first_plan(
    world: World,
    drive: Profile | None = None,
    slower_than_mps: float = math.inf,
    pace: float = 1.0,
    anew: bool = False,
) -> tuple[Planner, EgoFirstState, Attempt] | None:
    """Choose the ego's first state and plan from it; where several states may be chosen, the first that plans well.

    Where none does, parameters that were left open are unknowns of a plan, and take the values that it comes to.
    None where the ego cannot start slower than it must. In the last take, if there was one, it drove as in `drive`, and
    with `anew` values missed of which a plan promised that they would do. Heroes come to their triggers at a share
    `pace` of their speed.
    """
    limits = {actor: own if actor == EGO else own.at_pace(pace) for actor, own in world.limits.items()}
    best_plan = partial(_best_plan, world, partial(_Planned, world, limits, drive), slower_than_mps)
    best, chosen, left_open = best_plan(), world.scene.parameters, replace(world.planned, parameters=world.given)
    if best is not None and left_open.open_parameters() and (anew or not best.promises):
        try:
            world.choose(everyday(left_open).parameters)
            free = best_plan(left_open) or best
            for digits in _DIGITS:
                world.choose(rounded(left_open, free.attempt.plan.parameters, digits).parameters)
                again = best_plan()
                if again is not None and (again.rank < best.rank or (anew and again.promises)):
                    best, chosen = again, world.scene.parameters
                if again is best and best.promises:
                    break
        finally:
            world.choose(chosen)
    return None if best is None else (best.planner, best.start, best.attempt)


def _best_plan(
    world: World,
    plan: Callable[[Scene, EgoFirstState], _Planned],
    slower_than_mps: float,
    scene: Scene | None = None,
) -> _Planned | None:
    """Return the first plan that does all, else the best one, for the scene planned in the world or another."""
    steps, best = 0, None
    for start in first_states(world):
        # An ego that does not hold its speed may still let come about what no plan promises.
        if start.last_resort and best is not None and best.is_good and not world.ego_bounds.holds_speed:
            break
        if start.speed_mps >= slower_than_mps or (steps > _MOST_STEPS and not start.last_resort):
            continue
        found = _plan_from(world, start, scene or world.planned, plan)
        steps += found.attempt.steps
        if best is None or found.rank < best.rank:
            best = found
        if found.promises:
            break
    return best


class _Planned:
    """What is planned from a start, whom only hard braking saves the ego from, and whether it touches a hero.

    And whether a trigger comes too soon for what is to be seen before it, or the ego breaks what it is asked for.
    """

    def __init__(
        self, world: World, limits: Mapping[int, Limits], drive: Profile | None, scene: Scene, start: EgoFirstState
    ) -> None:
        structure, (alone, behind, signs) = read_structure(scene.program), _foreseen(world, start, drive)
        conditions = linear_conditions(scene, structure)
        self.planner = Planner(scene, structure, limits, alone, conditions, world.witness, behind, signs)
        self.start = start
        self.attempt = self.planner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        seen_s, motions = float(scene.program.manner.settled_s), self.attempt.plan.profiles
        triggers = {hero: structure.trigger_knot(hero) or "" for hero in structure.triggers}
        self.too_soon = any(motions[hero].knot_times_s[knot] < seen_s for hero, knot in triggers.items())
        self.saved_from, self.touches = _saved_and_touched(world, start, self.attempt)
        # Of an ego that holds its speed the start decides what it does at any moment.
        broken = not_held(scene, motions, compared_dimension, lambda dimension: float(TIGHT[dimension or "time"]))
        self.breaks = world.ego_bounds.holds_speed and not scene.open_parameters() and any(True for _ in broken)

    @property
    def is_good(self) -> bool:
        """Whether it does what was asked, nobody is saved or touched, and all is seen."""
        return self.attempt.is_good and not (self.saved_from or self.touches or self.too_soon or self.breaks)

    @property
    def promises(self) -> bool:
        """Whether it leads to the outcome too."""
        return self.is_good and self.attempt.promises_outcome

    @property
    def rank(self) -> tuple[bool, bool, float, float]:
        """How it compares with others: nobody is saved or touched, it does what it should, misses little."""
        missed = 0.0 if self.attempt.is_good else round(self.attempt.missed.by / GOOD)
        late_s = round(max(0.0, self.attempt.missed.late_s), 1)
        falls_short = self.too_soon or self.breaks or not self.attempt.is_good
        return bool(self.saved_from) or self.touches, falls_short, late_s, missed


def _plan_from(
    world: World, start: EgoFirstState, scene: Scene, plan: Callable[[Scene, EgoFirstState], _Planned]
) -> _Planned:
    """Plan from a start; where the ego would begin too near to somebody and brake hard, from further away.

    Likewise where its outcome would come too soon, as far as neither the ego's start nor the trigger of a hero tells
    where the ego is.
    """
    found, first = plan(scene, start), {(EGO, world.scene.program.ego.sketch.knots[0])}
    late_s, told = found.attempt.missed.late_s, first.union(*world.structure.triggers.values())
    if late_s > 0.0 and found.attempt.is_good:
        conditions = linear_conditions(world.scene, world.structure)
        if not any(EGO in each.weights and each.moments & told for each in conditions):
            sooner_m = (late_s + Preferences().order_s) * start.speed_mps
            later = plan(scene, replace(start, s_m=max(0.0, start.s_m - sooner_m)))
            found = min(found, later, key=lambda each: each.rank)
    if not found.saved_from:
        return found
    return plan(_kept_apart(scene, found.saved_from, start.speed_mps), found.start)


def _foreseen(world: World, start: EgoFirstState, drive: Profile | None) -> tuple[Predictor, Predictor, Signs]:
    """Return how the ego is foreseen where it follows nobody, and where it does; and how fast it drives if it can.

    To drive as in the last take, else, unless it follows, as it does alone each time, else as the road has it. Behind
    somebody it is no faster than alone.
    """
    road = alone = world.predictor
    signs = Signs.of(world.scene.routes[EGO], world.scene.road_map)
    if not (isinstance(road, ConstantSpeed) or world.simulator.capabilities.drives_ego):
        if start not in world.alone:  # a slow policy is not driven again for every plan and take
            once, again = (drives_alone(world.ego, start, world.rates.step_s) for _ in range(2))
            seen = Rehearsed(once, road)
            world.alone[start] = seen if seen.repeats(again) else None
        if (rehearsed := world.alone[start]) is not None:
            alone, signs = rehearsed, signs.as_driven(rehearsed.drive)
    return (alone, road, signs) if drive is None else (Rehearsed(drive, alone), Rehearsed(drive, road), signs)


def _saved_and_touched(world: World, start: EgoFirstState, attempt: Attempt) -> tuple[list[int], bool]:
    """Return the heroes ahead of it, if the ego's policy brakes hard at once, and whether it touches one.

    Or is on the other side of it at its trigger. Nobody is saved from those that the program asks to begin so.
    """
    scene, ahead, touches, motions = world.scene, list[int](), False, attempt.plan.profiles
    heroes = {hero.id: motions[hero.id] for hero in scene.program.heroes}
    begins = Start.of(scene, world.ego, (start.s_m, start.speed_mps), heroes)
    ego = begins.first[EGO]
    for hero in heroes:
        offset_m, there = shared_offset_m(scene.routes[EGO], scene.routes[hero]), begins.first[hero]
        if offset_m is None:
            continue
        ahead_m = there.s_m + offset_m - ego.s_m
        # Who is still on another road is further away than along the road that the two will share.
        if math.hypot(there.x_m - ego.x_m, there.y_m - ego.y_m) >= abs(ahead_m) + _SAME_ROAD_M:
            continue
        acts_s = motions[hero].knot_times_s.get(world.structure.trigger_knot(hero) or "", 0.0)
        then_m = motions[hero].state(acts_s)[0] + offset_m - motions[EGO].state(acts_s)[0]
        if abs(ahead_m) < VEHICLE_LENGTH_M or then_m * ahead_m < 0.0:
            touches = True
        elif ahead_m > 0.0 and not says_how_near(scene.program, world.structure, EGO, hero):
            ahead.append(hero)
    return (ahead if ahead and _brakes_hard(begins, heroes, world.rates.step_s) else []), touches


def _brakes_hard(start: Start, heroes: Mapping[int, Profile], step_s: float) -> bool:
    """Whether the policy, shown the heroes as they are planned, brakes hard in the first second."""
    drive = BuiltIn()
    with suppress(PolicyError):  # the run itself will tell
        drive.reset(start, step_s)
        for _ in range(round(AT_ONCE_S / step_s)):
            drive.apply(heroes)
            if drive.observe().actors[EGO].accel_mps2 < -HARD_MPSS:
                return True
            drive.step()
    return False


def _kept_apart(scene: Scene, heroes: Iterable[int], speed_mps: float) -> Scene:
    """Return a scene whose program says besides that an ego of this speed begins further behind some heroes.

    Nobody closes in faster than it drives: that long before a collision, even braking is enough a second later.
    """
    knot, meets_s = Knot(scene.program.ego.sketch.knots[0]), TAILGATES_S + speed_mps / (2.0 * HARD_MPSS)
    kinds: tuple[tuple[DerivedKind, float], ...] = ("headway", TAILGATES_S), ("ttc", meets_s)
    return scene.besides(
        *(
            Constraint(f"begins_{kind}_{hero}", Compare(">=", Derived(kind, EGO, hero, knot), Number(pin(least_s))))
            for hero, (kind, least_s) in product(heroes, kinds)
        )
    )


def _at_speed(scene: Scene, speed_mps: float) -> Scene:
    """Return a scene whose program says besides that the ego begins at this speed."""
    begins = State(EGO, 1, Knot(scene.program.ego.sketch.knots[0]))
    return scene.besides(Constraint("begins_as_usual", Compare("==", begins, Number(pin(speed_mps)))))


def first_plan_of_smt(world: World) -> tuple[HeroDriver, EgoFirstState, Attempt] | str:
    """Plan by an SMT solver from the first of the ego's possible starts that it finds a plan from; else say why not."""
    from scenewright.plan.smt import SmtPlanner

    why = ""
    for start in first_states(world):
        planner = SmtPlanner(world.scene, world.limits, world.ego_bounds)
        if planner.refused:
            return f"the SMT planner cannot take {planner.refused}"
        attempt = planner.begin((0.0, start.s_m, start.speed_mps, start.accel_mpss))
        if attempt is not None:
            return planner, start, attempt
        why = planner.why
    return f"the SMT planner found no first plan, wherever the ego starts; from the last start: {why}"


def is_timed_by_ego(world: World) -> bool:
    """Whether a trigger waits for the ego to be some time from a place: one that is still speeding up is there sooner.

    An ego that starts slower then leaves less time for what follows, not more.
    """
    triggers = {key for instant in world.structure.triggers.values() for key in instant}
    conditions = linear_conditions(world.scene, world.structure)
    return any(each.weights.get(EGO, (0.0, 0.0))[1] and each.moments & triggers for each in conditions)


def first_states(world: World) -> Iterator[EgoFirstState]:
    """Yield what the policy would hold, and at last first states in which an ego that holds its speed makes it.

    First at the speed that it holds by itself, then at any. These are shifted, unless the program says where it begins,
    for an ego that does not hold its speed to be on time too. Where there are none such, one that is nearer in time to
    a place than it is to be later: it may slow down.
    """
    told, found = linear_conditions(world.scene, world.structure), list[EgoFirstState]()
    conditions = tuple(of_ego(told, world.structure))
    lead_s = usual_lead_s(world.scene, world.structure, world.limits, told)
    limits = world.limits[EGO].no_faster(world.ego_bounds.speed_max_mps)  # it is not made to break its promise
    for start in ego_starts(world.scene, world.ego, limits, conditions, lead_s):
        found.append(start)
        if not start.last_resort:
            yield start
    first, name = {(EGO, world.scene.program.ego.sketch.knots[0])}, world.structure.trigger_knot(EGO)
    is_placed = any(each.moments == first and each.weights[EGO][0] for each in conditions)
    bounds, is_late = replace(world.ego_bounds, holds_speed=True), True
    for scene in (*(_at_speed(world.scene, start.speed_mps) for start in found[:1]), world.scene):
        witness = world.witness if scene is world.scene and world.ego_bounds.holds_speed else None
        if witness is None:  # that there is none is no matter here: a proof is not looked for
            witness, _ = shown(Question(scene, read_structure(scene.program), world.limits, bounds), _GUESSES)
        if witness is None:
            continue
        motion, is_late = witness.profiles[EGO], False
        start = EgoFirstState(*motion.state(0.0)[:2], last_resort=True)
        if name is not None and not is_placed:
            there_m = motion.state(then_s := motion.knot_times_s[name])[0]
            for _ in range(SHIFTS):
                alone = drives_alone(world.ego, start, world.rates.step_s, then_s)
                start = replace(start, s_m=max(0.0, start.s_m + there_m - alone.state(then_s)[0]))
        yield start
    yield from (start for start in found if start.last_resort and is_late)
