"""Random motions within an actor's limits, exact: what is true of them must never be called impossible."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from hypothesis import strategies as st

from scenewright.motion.profile import Profile, chain

Move = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Exact:
    """A motion of constant accelerations as rationals; `times`, `positions`, `speeds` are at the ends of its moves."""

    times: tuple[Fraction, ...]
    positions: tuple[Fraction, ...]
    speeds: tuple[Fraction, ...]
    accelerations: tuple[Fraction, ...]

    def profile(self, knots: dict[str, int]) -> Profile:
        moves = [
            (float(self.times[k + 1] - self.times[k]), float(accel), k) for k, accel in enumerate(self.accelerations)
        ]
        segments = chain(float(self.times[0]), float(self.positions[0]), float(self.speeds[0]), moves)
        return Profile(segments, {name: float(self.times[index]) for name, index in knots.items()})

    def shifted(self, by_m: Fraction) -> Exact:
        return Exact(self.times, tuple(x + by_m for x in self.positions), self.speeds, self.accelerations)


def motion(speed: Fraction, steps: list[tuple[Fraction, Fraction]]) -> Exact:
    """Return the motion from 0 m at 0 s through ``(duration, speed at its end)``."""
    times, positions, speeds, accelerations = [Fraction(0)], [Fraction(0)], [speed], []
    for duration, end_speed in steps:
        times.append(times[-1] + duration)
        positions.append(positions[-1] + (speeds[-1] + end_speed) * duration / 2)
        accelerations.append((end_speed - speeds[-1]) / duration)
        speeds.append(end_speed)
    return Exact(tuple(times), tuple(positions), tuple(speeds), tuple(accelerations))


def tenths(low: float, high: float) -> st.SearchStrategy[Fraction]:
    return st.integers(round(low * 10), round(high * 10)).map(lambda n: Fraction(n, 10))


@st.composite
def wandering(
    draw: st.DrawFn, fastest: float, accel: float, brake: float, slowest: float = 0.0, most: int = 3
) -> tuple[Fraction, list[Move]]:
    """Draw a first speed and moves that keep within limits."""
    first = speed = draw(tenths(slowest, fastest))
    steps: list[Move] = []
    for _ in range(draw(st.integers(1, most))):
        duration = draw(tenths(0.5, 5.0))
        low = max(Fraction(round(slowest * 10), 10), speed - Fraction(str(brake)) * duration)
        high = min(Fraction(round(fastest * 10), 10), speed + Fraction(str(accel)) * duration)
        speed = low + (high - low) * draw(st.integers(0, 20)) / 20
        steps.append((duration, speed))
    return first, steps
