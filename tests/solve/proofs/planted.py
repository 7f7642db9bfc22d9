"""Scenarios planted by legal motions: programs that are true of motions of everybody, and those motions, exactly.

Nobody is kept from touching others, and no distance is asked for: only then may a proof rest on that. Whoever turns
too fast has limits of its own that just admit it.
"""

from __future__ import annotations

import random
import re
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.motion.limits import Limits, limits_on
from scenewright.program.structure import read_structure
from scenewright.program.text import parse_program
from scenewright.roads import load_map
from scenewright.roads.grounding import Scene, ground
from scenewright.solve.proofs.decide import Question
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.lowering import Lowering
from scenewright.units import format_fraction

T = load_map("t_intersection")
EGO = EgoBounds(20.0, 2.0, 6.0)
PAIRS = (("W", "E, N"), ("S, E", "W"), ("W", "W"), ("E, N", "S, E"), ("S, W", "W"))
SKETCHES = ("go dec", "go acc", "go dec stop acc", "go dec go", "acc go", "go go", "dec stop go")
RATES = {"go": (-4, 3), "dec": (-6, 0), "acc": (0, 3), "stop": (0, 0)}
NICE = [Fraction(n, 10) for n in (16, 20, 25, 32, 40, 50)]  # what is divided by these stays a decimal
Move = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Motion:
    """Moves one after another from a first place and speed; exact."""

    place: Fraction
    speed: Fraction
    moves: tuple[Move, ...]

    def rounded(self) -> Motion:
        """Return the motion in floats, which are a hundred times as fast."""
        moves = tuple((float(lasts), float(rate)) for lasts, rate in self.moves)
        return Motion(float(self.place), float(self.speed), moves)  # type: ignore[arg-type]

    def state(self, time_s: Fraction) -> tuple[Fraction, Fraction, Fraction]:
        place, speed, rate = self.place, self.speed, Fraction(0)
        for lasts, rate in self.moves:
            done = min(lasts, time_s)
            if time_s < lasts:
                return place + speed * done + rate * done * done / 2, speed + rate * done, rate
            place, speed, time_s = (
                place + speed * lasts + rate * lasts * lasts / 2,
                speed + rate * lasts,
                time_s - lasts,
            )
        return place + speed * time_s, speed, Fraction(0)


@dataclass(frozen=True)
class Planted:
    """A program and the motions that it is true of."""

    text: str
    motions: dict[int, Motion]
    knots: dict[tuple[int, str], Fraction]

    def scene(self) -> Scene:
        return ground(parse_program(self.text), T)

    def question(self) -> Question:
        scene = self.scene()
        return Question(scene, read_structure(scene.program), self.limits(), EGO)

    def limits(self) -> dict[int, Limits]:
        """Return limits within which the motions just are."""
        scene, found = self.scene(), {}
        end_s = max(*self.knots.values(), *map(Fraction, re.findall(r"\d+(?:\.\d+)?(?= s\b|\])", self.text)))
        for actor, limits in limits_of(scene).items():
            path, sideways, motion = scene.routes[actor].path, 0.0, self.motions[actor].rounded()
            for k in range(int(50 * end_s) + 1):
                place, speed, _ = motion.state(k / 50)
                sideways = max(sideways, abs(path.curvature(place)) * speed**2)
            found[actor] = replace(limits, lateral_max_mpss=max(limits.lateral_max_mpss, 1.02 * sideways))
        return found


def limits_of(scene: Scene) -> dict[int, Limits]:
    return {actor: limits_on(route, T) for actor, route in scene.routes.items()}


def lowered(scene: Scene, ego: EgoBounds = EGO) -> tuple[Events, Lowering]:
    """Return events and a lowering of a scene, its constraints lowered."""
    events = Events(scene, limits_of(scene), ego)
    lowering = Lowering(events)
    lowering.lower(scene.program.constraints)
    return events, lowering


def plant(seed: int, begin_m: tuple[int, int] = (40, 90)) -> Planted:
    """Draw motions that begin within some places, and constraints that are true of them."""
    chance = random.Random(seed)
    routes, sketch = chance.choice(PAIRS), SKETCHES[seed % len(SKETCHES)].split()
    hero, hero_times = _drive(chance, sketch, begin_m)
    trigger = 1
    when = hero_times[trigger]
    ego, ego_times = _drive(chance, ["go", "go"], begin_m, when, (-4, 2))
    head = "".join(
        f"Actor {number} ({name}):\n- {route}\n- [{_knots(pieces)}]\n\n"
        for number, name, route, pieces in ((0, "ego", routes[0], ["go", "go"]), (1, "hero", routes[1], sketch))
    )
    knots = {(0, f"t{k}"): t for k, t in enumerate(ego_times)} | {(1, f"t{k}"): t for k, t in enumerate(hero_times)}
    motions = {0: ego, 1: hero}
    facts = ["A0(t1) == A1(t1)", *chance.sample(_facts(chance, motions, knots, sketch), 7)]
    return Planted(f"{head}Constraints:\n" + "\n".join(facts) + "\n", motions, knots)


def _knots(pieces: list[str]) -> str:
    return ", ".join(["t0", *(word for k, piece in enumerate(pieces, 1) for word in (piece, f"t{k}"))])


def _drive(
    chance: random.Random,
    sketch: list[str],
    begin_m: tuple[int, int],
    first_lasts: Fraction | None = None,
    go: tuple[int, int] = RATES["go"],
) -> tuple[Motion, list[Fraction]]:
    """Draw a motion piece by piece: several rates in each, never backwards, a `stop` from and at a standstill."""
    first = speed = Fraction(chance.randint(30, 110), 10)
    moves: list[Move] = []
    times = [Fraction(0)]
    for number, kind in enumerate(sketch):
        left = first_lasts if number == 0 and first_lasts is not None else Fraction(chance.randint(8, 40), 10)
        ahead = sketch[number + 1] if number + 1 < len(sketch) else ""
        begun = times[-1]
        if ahead == "stop":
            rate = chance.choice(NICE)
            moves.append((speed / rate, -rate))
            times.append(begun + speed / rate)
            speed = Fraction(0)
            continue
        for share in (Fraction(1, 4), Fraction(1, 2), Fraction(1, 4)):
            lasts = left * share
            low, high = go if kind == "go" else RATES[kind]
            slowest, fastest = max(Fraction(low), -speed / lasts), min(Fraction(high), (16 - speed) / lasts)
            drawn = slowest + (fastest - slowest) * Fraction(chance.randint(0, 4), 4)
            rate = Fraction(int(drawn * 100), 100)  # rounded towards zero, which is always within
            moves.append((lasts, rate))
            speed += lasts * rate
        times.append(begun + left)
    return Motion(Fraction(chance.randint(*begin_m)), first, tuple(moves)), times


def _facts(
    chance: random.Random, motions: dict[int, Motion], knots: dict[tuple[int, str], Fraction], sketch: list[str]
) -> list[str]:
    """Return facts in many forms, each true of the motions."""
    facts = []
    end = max(knots.values())
    for (actor, knot), time_s in knots.items():
        place, speed, _ = motions[actor].state(time_s)
        other = 1 - actor
        facts += [
            f"A{actor}x({knot}) == {_said(place)}",
            f"A{actor}v({knot}) <= {_said(speed + chance.choice((0, 1)))}",
            f"A{actor}({knot}) == {_said(time_s)} s",
            f"A{other}v(A{actor}({knot})) >= {_said(motions[other].state(time_s)[1])}",
            f"not (A{actor}v({knot}) >= {_said(speed + 1)})",
            f"A{actor}x({knot}) >= {_said(place)} implies A{actor}v({knot}) == {_said(speed)}",
        ]
    half = end / 2
    facts += [f"A{actor}x({_said(half)}) == {_said(motions[actor].state(half)[0])}" for actor in motions]
    facts.append(f"A1(t2) - A0(t1) == {_said(knots[1, 't2'] - knots[0, 't1'])}")
    for actor, motion in motions.items():
        last = max(t for (owner, _), t in knots.items() if owner == actor)
        speeds = [
            motion.state(sum((d for d, _ in motion.moves[:k]), Fraction(0)))[1] for k in range(len(motion.moves) + 1)
        ]
        rates = [rate for _, rate in motion.moves]
        facts += [
            f"always[A{actor}(t0), A{actor}(t2)] (A{actor}v <= {_said(max(speeds))})",
            f"never[0, {_said(last)}] (A{actor}v < {_said(min(speeds))})",
            f"always[A{actor}(t0), {_said(last)}] (A{actor}a <= {_said(max(rates))})",
            f"always[A{actor}(t0), A{actor}(t1) + 1] (A{actor}x >= {_said(motion.place)})",
            f"always[A{actor}(t0), A{actor}(t1)] (A{actor}x <= {_said(motion.place - 5)} implies A{actor}v <= 1)",
            f"always[A{actor}(t0), A{actor}(t1)] (A{actor}x < {_said(motion.place)} implies A{actor}v <= 1)",
            f"always[A{actor}(t0), A{actor}(t2)] (A{actor}x >= {_said(motion.place + 200)} implies A{actor}v <= 1)",
            f"always[A1(t1) - {_said(knots[1, 't1'] + 3)}, A1(t1) - {_said(knots[1, 't1'] + 1)}] (A{actor}v <= 1)",
        ]
    first, last = knots[1, "t1"], knots[1, "t2"]
    mean = (motions[1].state(last)[1] - motions[1].state(first)[1]) / (last - first)
    if sketch.count(sketch[1]) == 1:
        facts.append(f"A1a({sketch[1]}) == {_said(mean)}")
    return facts


def _said(value: Fraction | int) -> str:
    value = Fraction(value)
    text = format_fraction(value)
    return f"({text})" if "/" in text else text
