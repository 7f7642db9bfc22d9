"""How large vehicles are: the one table that zones, simulation, judge and drawings read.

What enters: nothing. What leaves: a `Body`. How a vehicle moves is not its matter.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Body:
    """A vehicle's outline: a box around the point that its position speaks of."""

    length_m: float = 4.5
    width_m: float = 1.9

    def reach_m(self) -> float:
        """Return the distance from the centre to a corner."""
        return 0.5 * float((self.length_m**2 + self.width_m**2) ** 0.5)


CAR = Body()
VEHICLE_LENGTH_M, VEHICLE_WIDTH_M = CAR.length_m, CAR.width_m
