"""What a plan prefers: every constant of planning, with where it comes from.

What enters: nothing. What leaves: numbers. Weights are per the unit named; a residual of one of its unit costs as much
as a residual of one of another's.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Preferences:
    """Comfort, manner and prices of one planner.

    Attributes
    ----------
    jerk_mpsss, accel_mpss
        What is as unpleasant as one unit of cost a second (m/s^3, m/s^2): drivers seldom exceed 1 and 1.5.
    braking_mpss, speeding_up_mpss
        The rates of pieces for which the program names none: usual in town.
    least_rate_mpss
        Less is hardly seen to be braking or speeding up.
    beginning_mpss, beginning_s
        How hard and for how long a piece is begun, so that it can be seen.
    settled_mpss, settled_s
        How much of what is to begin may be done before it, and for how long it may not be more.
    stands_s, lasts_s
        How long one stands, or does another piece, of which the program does not say it.
    price
        Of one tight tolerance by which something that was asked for is missed.
    order_s, order_price
        By how much one that is to be first is to be it, and the price of a second less.
    """

    jerk_mpsss: float = 1.0
    accel_mpss: float = 1.5
    braking_mpss: float = 2.2
    speeding_up_mpss: float = 1.6
    least_rate_mpss: float = 0.62
    beginning_mpss: float = 0.9
    beginning_s: float = 0.45
    settled_mpss: float = 0.3
    settled_s: float = 0.6
    stands_s: float = 0.9
    lasts_s: float = 2.0
    shortest_s: float = 0.45
    shortest_stand_s: float = 0.45
    price: float = 30.0
    order_s: float = 1.5
    order_price: float = 4.0
    order_most: float = 3.0
    punctual: float = 0.7
    out_of_way_price: float = 12.0
    out_of_way_most: float = 3.0
    waits_price: float = 6.0
    sets_off_mpss: float = 1.5
    waits_mpss: float = 3.0
    waits_s: float = 1.5
    plain_mps: float = 1.2
    plain_price: float = 2.0
    lateral_mpss: float = 2.5
    slowest_mps: float = 1.8
    slowest_price: float = 6.0
    closeness: float = 0.02


PREFERENCES = Preferences()
