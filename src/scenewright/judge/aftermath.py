"""What came of a run: a collision, how near it came to one, how hard the ego braked.

What enters: a `Case`, and what `safety` measured of every pair of actors. What leaves: an `Aftermath`, with its words.
It decides nothing: whether a collision is a failure or a finding is for the conditions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from itertools import combinations
from typing import Any

import numpy as np

from scenewright.judge.boxes import moving_box
from scenewright.judge.case import Case
from scenewright.judge.tolerance import TIGHT
from scenewright.program.types import EGO
from scenewright.translate.phrases import called
from scenewright.units import in_tenths

_MEASURES = {
    "closest_m": "min_distance_m",
    "min_ttc_s": "min_ttc_s",
    "post_encroachment_s": "post_encroachment_time_s",
}  # by the names that pairs have for them
_BRAKES_MPS2 = 0.05  # less than what is told as 0.1 m/s^2 is no braking


@dataclass(frozen=True, slots=True)
class Collision:
    """Two actors at the first instant at which their boxes overlap.

    `actors` has the one that drove into the other first, and speeds are in the same order. The relative speed is the
    length of the difference of their velocities.
    """

    time_s: float
    actors: tuple[str, str]
    speeds_mps: tuple[float, float]
    relative_speed_mps: float

    def in_words(self) -> str:
        """Return who hit whom, when and how fast."""
        first, second = (called(name) for name in self.actors)
        own, other = self.speeds_mps
        return f"{first} hit {second} at {self.time_s:.1f} s, {own:.1f} m/s against {other:.1f} m/s"


@dataclass(frozen=True, slots=True)
class Aftermath:
    """What came of a run.

    Attributes
    ----------
    collision
        The first one between any two actors.
    closest_m, min_ttc_s, post_encroachment_s
        Between the ego and whoever it was least for. None where there is no such number: nobody was on a collision
        course, or no place was covered by one after the other.
    ego_hardest_braking_mps2, ego_hardest_braking_time_s
        How hard and when; until the first collision, after which the simulation drives the bodies through each other.
    acts_s, end_s
        When the first trigger came, None where none did; and the last instant of the run.
    whom
        Of several heroes the one that a measure between the ego and another was least for, by the measure's name.
    several_triggers
        Whether there is more than one moment at which somebody acts.
    """

    collision: Collision | None
    closest_m: float | None
    min_ttc_s: float | None
    post_encroachment_s: float | None
    ego_hardest_braking_mps2: float
    ego_hardest_braking_time_s: float
    acts_s: float | None
    end_s: float
    whom: Mapping[str, str] = field(default_factory=dict)
    several_triggers: bool = False

    def in_words(self) -> str:
        """Return what came of it, in one line without a full stop."""
        rate = self.ego_hardest_braking_mps2
        braked = f"the ego braked with {rate:.1f} m/s^2 at most" if rate >= _BRAKES_MPS2 else "the ego did not brake"
        early_s = 0.0 if self.acts_s is None else self.acts_s - self.ego_hardest_braking_time_s
        if rate >= _BRAKES_MPS2 and early_s > TIGHT.time_s:  # not in answer to what was done at the trigger
            braked += f", {early_s:.1f} s before the {'first ' if self.several_triggers else ''}trigger"
        if self.collision is not None:
            on = self.end_s - self.collision.time_s > TIGHT.time_s
            then = "; the run goes on as if they had not touched, for what was still to come" if on else ""
            return f"{self.collision.in_words()}; until then {braked}{then}"
        measures = [
            ("closest_m", self.closest_m, "closest {} m"),
            ("min_ttc_s", self.min_ttc_s, "time to collision at least {} s"),
            ("post_encroachment_s", self.post_encroachment_s, "passed {} s apart"),
        ]
        told = [
            words.format(in_tenths(value)) + (f" ({called(self.whom[name])})" if name in self.whom else "")
            for name, value, words in measures
            if value is not None
        ]
        return "no collision; " + ", ".join([*told, braked])

    def as_dict(self) -> dict[str, Any]:
        """Return what came of it in the form of `verdict.json`, its words as `text`."""
        of_words = ("acts_s", "end_s", "whom", "several_triggers")
        told = {name: value for name, value in asdict(self).items() if name not in of_words}
        return {**told, "text": self.in_words()}


def aftermath(case: Case, acts_s: float | None, pairs: Mapping[str, Mapping[str, Any]]) -> Aftermath:
    """Return what came of a run whose first trigger came at `acts_s`; `pairs` as `safety.safety_facts` has them."""
    collision = min(_collisions(case, pairs), key=lambda hit: hit.time_s, default=None)
    least = {measure: _least(case, pairs, name) for measure, name in _MEASURES.items()}
    states = case.timelines[EGO].states
    before = states.time_s < (np.inf if collision is None else collision.time_s)
    rates = np.where(before, states.accel_mps2, 0.0)
    return Aftermath(
        collision,
        least["closest_m"][0],
        least["min_ttc_s"][0],
        least["post_encroachment_s"][0],
        0.0 - float(np.min(rates, initial=0.0)),  # and not -0.0
        float(states.time_s[np.argmin(rates)]),
        acts_s,
        case.end_s,
        {measure: whom for measure, (_, whom) in least.items() if whom and len(case.program.heroes) > 1},
        len(set(case.structure.triggers.values())) > 1,
    )


def _least(case: Case, pairs: Mapping[str, Mapping[str, Any]], name: str) -> tuple[float | None, str]:
    """Return the least value of a measure between the ego and another, and whom it is of."""
    of_ego = ((pairs[f"{case.name(EGO)}, {hero.name}"][name], hero.name) for hero in case.program.heroes)
    known = ((value, whom) for value, whom in of_ego if value is not None and np.isfinite(value))
    return min(known, default=(None, ""))


def _collisions(case: Case, pairs: Mapping[str, Mapping[str, Any]]) -> Iterator[Collision]:
    for a, b in combinations(sorted(actor.id for actor in case.program.actors), 2):
        time_s = pairs[f"{case.name(a)}, {case.name(b)}"]["collision_time_s"]
        if time_s is not None:
            yield collision_at(case, a, b, time_s)


def collision_at(case: Case, a: int, b: int, time_s: float) -> Collision:
    """Return the collision of two actors whose boxes first overlap at an instant."""
    boxes = [moving_box(case.timelines[each].states, case.box(each), np.array([time_s])) for each in (a, b)]
    places = [np.array([box.x_m[0], box.y_m[0]]) for box in boxes]
    ways = [box.speed_mps[0] * np.array([np.cos(box.heading_rad[0]), np.sin(box.heading_rad[0])]) for box in boxes]
    between = places[1] - places[0]
    # Who closes the distance of the centres faster drove into the other.
    order = (0, 1) if ways[0] @ between >= -ways[1] @ between else (1, 0)
    names, speeds = (case.name(a), case.name(b)), [float(box.speed_mps[0]) for box in boxes]
    relative_mps = float(np.hypot(*(ways[0] - ways[1])))
    return Collision(time_s, (names[order[0]], names[order[1]]), (speeds[order[0]], speeds[order[1]]), relative_mps)
