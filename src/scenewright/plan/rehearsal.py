"""Foresees an ego that has been seen to drive: a simulation can be run again, and the last drive tells how it drives.

What enters: how the ego drove in an earlier take. What leaves: a predictor for the next one. Where the ego no longer
drives as it did, another predictor takes over: a rehearsal is a better guess, never knowledge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from scenewright.motion.profile import Profile, chain
from scenewright.plan.prediction import EgoSample, Predictor

_HORIZON_S = 15.0
_STANDING_MPS = 0.3


@dataclass(frozen=True, slots=True)
class Rehearsed:
    """The ego goes on as it did when it was last where it is now.

    Attributes
    ----------
    drive
        How it drove.
    base
        What is believed of it where it is elsewhere, or faster or slower by more than `alike_mps`.
    """

    drive: Profile
    base: Predictor
    alike_mps: float = 1.0

    def predict(self, history: Sequence[EgoSample]) -> Profile:
        """Return the rest of the drive from where the ego is, beginning with the speed that it has."""
        time_s, s_m, speed_mps, _ = history[-1]
        then_s = self._when(history)
        if then_s is None or abs(self.drive.state(then_s)[1] - speed_mps) > self.alike_mps:
            return self.base.predict(history)
        moves: list[tuple[float, float, int]] = []
        for segment in self.drive.cut(then_s).segments:
            if segment.start_s > then_s + _HORIZON_S:
                break
            if moves and abs(moves[-1][1] - segment.accel_mpss) < 1e-3:
                moves[-1] = (moves[-1][0] + segment.duration_s, moves[-1][1], 0)
            else:
                moves.append((segment.duration_s, segment.accel_mpss, 0))
        return Profile(chain(time_s, s_m, speed_mps, moves or [(1.0, 0.0, 0)]))

    def _when(self, history: Sequence[EgoSample]) -> float | None:
        """Return the moment of the drive that is like now: as long at this place as the ego has been by now."""
        time_s, s_m, speed_mps, _ = history[-1]
        if speed_mps >= _STANDING_MPS:
            when_s = self.drive.time_at(s_m)
            return when_s if when_s is not None and when_s <= self.drive.end_s else None
        place_m = s_m - 0.05
        came_s = next((sample[0] for sample in history if sample[1] >= place_m), time_s)
        arrived_s = self.drive.time_at(place_m)
        if arrived_s is None or arrived_s + time_s - came_s > self.drive.end_s:
            return None
        return arrived_s + time_s - came_s
