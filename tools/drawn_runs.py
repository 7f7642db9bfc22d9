"""Drives programs that are read off drawn motions, against an ego that drives what was drawn: all of them can happen.

python tools/drawn_runs.py FOLDER constant 0 150         the ego holds its speed; seeds 0 to 149
python tools/drawn_runs.py FOLDER gentle 0 150 3         it brakes by up to 1.5 m/s^2, speeds up by up to 1; 3 takes
python tools/drawn_runs.py FOLDER wild 0 150             it brakes by up to 6 m/s^2, speeds up by up to 1.4

FOLDER holds the generator of such programs (`motions.py`, `truths.py`, `planted.py`, `product.py`), which is no part of
the project. The ego knows nobody, and its first state is part of the program. A program of which the judge does not
accept what was drawn is left out. What does not succeed is told with why, and can be drawn again by its seed.
"""

from __future__ import annotations

import random
import sys
import tempfile
from collections import Counter
from fractions import Fraction
from pathlib import Path
from typing import Any

from scenewright.drive.protocol import EgoStart, Observation
from scenewright.errors import ScenewrightError
from scenewright.orchestrate import orchestrate
from scenewright.request import Request, Result

RATES_MPSS = {"constant": (0, 0), "gentle": (Fraction(-3, 2), 1), "wild": (-6, Fraction(7, 5))}


class Replays:
    """Drives so long with each of these accelerations (s, m/s^2), and then holds its speed."""

    moves: tuple[tuple[float, float], ...] = ()

    def reset(self, start: EgoStart) -> None:
        """Begin."""

    def step(self, observation: Observation, dt_s: float) -> float:
        """Return an acceleration (m/s^2)."""
        left_s = observation.time_s
        for lasts_s, accel_mpss in self.moves:
            if left_s < lasts_s - 1e-6:
                return max(accel_mpss, -observation.ego.speed_mps / dt_s)
            left_s -= lasts_s
        return 0.0


def drive(text: str, takes: int) -> Result | ScenewrightError:
    """Run a program against `Replays`."""
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "drawn.scene"
        program.write_text(text, encoding="utf-8")
        try:
            return orchestrate(Request(str(program), ego=f"{__name__}:Replays", takes=takes))
        except ScenewrightError as error:
            return error


def why(result: Result | ScenewrightError) -> str:
    """Say in one line what came of a run that is no success."""
    if isinstance(result, ScenewrightError):
        return f"refused: {result}"
    cause = result.verdict.cause.text if result.verdict is not None and result.verdict.cause is not None else ""
    return " ".join([result.status, cause, result.no_plan, *map(str, result.not_held)])


def drawn(seed: int, generator: Any, places: list[Any]) -> tuple[str, tuple[tuple[float, float], ...]] | None:
    """Return a program and the ego's accelerations; None where the judge does not accept what was drawn."""
    rng = random.Random(seed)
    case = generator.draw(rng, places, generator.SKETCHES[seed % len(generator.SKETCHES)])
    case.constraints = generator.Truths(rng, case).all(rng.choice((0, 0, 1, 2)))
    ego = case.actors[0]
    begins_m, begins_mps = ego.motion.x[0], ego.motion.v[0]
    place = f"A0x(t0) == {ego.zero} {'-' if begins_m < 0 else '+'} {generator.num(abs(begins_m))}"
    case.constraints += [("", place), ("", f"A0v(t0) == {generator.num(begins_mps)}")]
    with tempfile.TemporaryDirectory() as folder:
        if generator.failing(case, Path(folder)):
            return None
    return case.text(), tuple((float(lasts_s), float(accel)) for lasts_s, accel in ego.motion.moves[:-1])


def main(folder: str, rates: str, first: str, end: str, takes: str = "1") -> None:
    """Draw, drive and count."""
    sys.path.insert(0, folder)
    import motions
    import planted
    import product

    motions.EGO_RATES = RATES_MPSS[rates]
    outside = product.Product(str(Path(sys.executable).with_name("scenewright")), True)
    places = product.places(outside)
    planted.WORLD.update(product=outside, places=places, extras=0)
    planted.SKETCHES, planted.num = motions.SKETCHES, motions.num
    counts: Counter[str] = Counter()
    for seed in range(int(first), int(end)):
        found = drawn(seed, planted, places)
        if found is None:
            counts["not accepted"] += 1
            continue
        text, Replays.moves = found
        result = drive(text, int(takes))
        status = "refused" if isinstance(result, ScenewrightError) else result.status
        counts[status] += 1
        if isinstance(result, Result) and result.hindsight is not None:
            counts["of these called impossible after the run"] += 1
        if status != "success":
            print(f"{seed}: {why(result)}", flush=True)
    print(", ".join(f"{status}: {count}" for status, count in counts.items()))


if __name__ == "__main__":
    main(*sys.argv[1:])
