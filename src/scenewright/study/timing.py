"""Times re-solves as they occur in runs: how long a tick takes, everything counted, and what share of a core runs need.

What enters: scenarios and egos that make much re-solving necessary. What leaves: percentiles and sums. Times are for
comparing within one machine and one session.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scenewright.orchestrate import orchestrate
from scenewright.request import Request, Result

# One scenario of each kind: yield, stop and go, go first, brake at a rate; distances and times to arrival.
SCENARIOS: tuple[str, ...] = (
    "The ego drives westbound and is 90 m before the intersection. An oncoming hero turns left into the driveway. "
    "When the ego is 30 m before the conflict point and the hero is 18 m before the conflict point, the hero brakes to "
    "a stop 6 m before the conflict point.",
    "The ego is on the driveway, 50 m behind the stop line, and turns right onto the road. A hero drives westbound on "
    "the road. When the ego is 14 m behind the stop line and the hero is 22 m behind the conflict point, the hero "
    "brakes to a stop 6 m before the conflict point. Then the hero accelerates to pass the conflict point before the "
    "ego begins to turn.",
    "The ego drives westbound and is 9 s from the intersection. A hero is on the driveway and turns right onto the "
    "road. When the ego is 4 s from the conflict point and the hero is 2 s from the stop line, the hero brakes to a "
    "stop just before the stop line.",
)
EGOS: tuple[str, ...] = ("constant", "idm", "noisy", "stop-and-go")


@dataclass(frozen=True, slots=True)
class Timing:
    """Wall times of one set of runs.

    Attributes
    ----------
    tick_ms
        Of every tick at which the solver was asked, all counted, sorted.
    busy_s_in_20_s
        The most that re-planning took in any run, scaled to 20 s of simulated time.
    """

    tick_ms: tuple[float, ...]
    busy_s_in_20_s: float
    runs: int
    ticks: int

    def percentile_ms(self, percent: float) -> float:
        """Return a percentile of `tick_ms`; 0 where the solver was never asked."""
        if not self.tick_ms:
            return 0.0
        return self.tick_ms[min(len(self.tick_ms) - 1, int(len(self.tick_ms) * percent / 100.0))]


def time_resolves(seeds: Sequence[int]) -> Timing:
    """Run every scenario against every ego with every seed, and time the re-solves."""
    asked: list[float] = []
    busiest, runs, ticks = 0.0, 0, 0
    for seed in seeds:
        for ego in EGOS:
            for text in SCENARIOS:
                result: Result = orchestrate(Request(text, ego=ego, seed=seed))
                if result.run is None:
                    continue
                runs += 1
                records = [record for record in result.run.replans if record.time_s > 0.0]
                ticks += len(records)
                asked += [1000.0 * record.wall_s for record in records if record.backend]
                busy = sum(record.wall_s for record in records)
                busiest = max(busiest, busy * 20.0 / max(20.0, result.run.trace.duration_s))
    return Timing(tuple(sorted(asked)), busiest, runs, ticks)
