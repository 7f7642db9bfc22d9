"""First guesses of a first plan: everybody comes evenly to where a condition at its trigger wants it.

What enters: what is asked, what tells when triggers come, the ego as it is foreseen. What leaves: motions; who goes
first where heroes meet is read off them. They need not do what is asked: Newton steps begin there.
"""

from __future__ import annotations

from collections.abc import Mapping

from scenewright.motion.profile import Profile, chain
from scenewright.plan.asked import Asked
from scenewright.plan.triggers import TriggerTimes
from scenewright.program.structure import Structure, placed_at
from scenewright.program.types import EGO, Actor, Program
from scenewright.roads.conflicts import shared_offset_m
from scenewright.solve.proofs.witness import Witness

JOINT_S = 3.5  # when a trigger comes of which both decide; chosen, plans move it


def even_motions(
    asked: Asked, times: TriggerTimes, prediction: Profile, witness: Witness | None, pace: float
) -> tuple[dict[int, Profile], bool]:
    """Return a motion for each hero, and whether a condition tells the place of each: so that they tell who goes first.

    They come at a share `pace` of the speed that is natural on their way. Where no condition tells a place, it is so
    far from the ego as in the witness, if there is one.
    """
    found: dict[int, Profile] = {}
    times_s: dict[int, float] = {}
    told = True
    for hero in asked.scene.program.heroes:
        instant, at_s = asked.until(hero.id), JOINT_S
        share = asked.wanted.natural_share if instant is None else pace  # who acts at no moment would just stay slow
        speed_mps = share * asked.limits[hero.id].natural_approach_speed_mps
        if hero.id in times.sides:
            at_s = times.instant_s(hero, 0.0, prediction, None)
        elif hero.id not in asked.structure.triggers and instant is not None:  # it hangs on others that came before
            at_s = max((then_s + asked.least_s[then, instant] for then, then_s in times_s.items()), default=0.0)
        else:
            told = False
        if instant is not None:
            times_s[instant] = at_s
        states = {EGO: prediction.state(at_s)[:2]} | {other: each.state(at_s)[:2] for other, each in found.items()}
        there_m = _place_m(asked, times, hero, states, speed_mps)
        told &= there_m is not None
        if there_m is None and witness is not None:
            own, ego = (witness.profiles[actor] for actor in (hero.id, EGO))
            then_s = own.knot_times_s[asked.adapts_until[hero.id]] if instant is not None and at_s > 0.0 else 0.0
            beside = shared_offset_m(asked.scene.routes[EGO], asked.scene.routes[hero.id]) is not None
            there_m = own.state(then_s)[0] + (states[EGO][0] - ego.state(then_s)[0] if beside else 0.0)
        elif there_m is None:
            there_m = 0.5 * asked.scene.routes[hero.id].landmarks["route_end"]
        moves = [(at_s, 0.0, 0)]
        found[hero.id] = Profile(chain(0.0, there_m - speed_mps * at_s, speed_mps, moves), {hero.sketch.knots[0]: 0.0})
    return found, told


def meet_later(program: Program, structure: Structure) -> bool:
    """Whether a program says of several heroes where they are at one moment that is no trigger."""
    instants = set(structure.instants) - set(structure.triggers.values())
    return any(len(placed_at(program, instant) - {EGO}) > 1 for instant in instants)


def _place_m(
    asked: Asked, times: TriggerTimes, hero: Actor, states: Mapping[int, tuple[float, float]], speed_mps: float
) -> float | None:
    """Return where a hero that is so fast is at its trigger, if a condition there, on others so placed, tells."""
    name = asked.adapts_until.get(hero.id)
    instant = asked.structure.triggers.get(hero.id, frozenset() if name is None else frozenset({(hero.id, name)}))
    for condition in times.conditions:
        here = condition.moments <= instant and set(condition.weights) <= {hero.id, *states}
        if here and hero.id in condition.weights and (per_metre := condition.weights[hero.id][0]):
            there_m = -condition.value({**states, hero.id: (0.0, speed_mps)}) / per_metre
            meets = asked.scene.conflict(EGO, hero.id)
            merges = meets is not None and meets.kind == "merging" and EGO in condition.weights
            return max(there_m, meets.s_b_m) if merges and meets else there_m  # how far apart is told on one lane
    return None
