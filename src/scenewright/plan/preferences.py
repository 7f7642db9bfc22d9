"""What a plan prefers: every constant of planning. What each is and where it comes from tells docs/closed-loop.md.

What enters: a program's manner. What leaves: `Preferences`. Costs are squares of residuals; a weight is one over what
costs as much as one unit of any other, a price is the weight of one tight tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.motion.limits import ROOM, calm_mpss
from scenewright.program.manner import USUAL, Manner


@dataclass(frozen=True, slots=True)
class Preferences:
    """Comfort, manner and prices of one planner, in SI units; the values are those with the usual manner."""

    # -- comfort -----------------------------------------------------------------------------------------------------
    jerk_mpsss: float = 1.0
    accel_mpss: float = 1.5
    change_weight: float = 3.0
    lateral_mpss: float = 2.5
    lateral_weight: float = 0.7
    braking_mpss: float = 2.2
    speeding_up_mpss: float = 1.6
    natural_share: float = 0.8
    trigger_speed_weight: float = 0.15
    over_limit_weight: float = 0.5
    over_sign_most: float = 1.0
    lasts_s: float = 2.0
    lasts_weight: float = 0.3
    stands_s: float = 0.9
    stands_weight: float = 1.0
    # -- what was asked for ------------------------------------------------------------------------------------------
    price: float = 30.0
    order_s: float = 1.5
    order_price: float = 4.0
    order_most: float = 3.0
    sure_order_most: float = 30.0
    punctual_weight: float = 0.7
    everyday_weight: float = 1.0
    # -- manner ------------------------------------------------------------------------------------------------------
    least_rate_mpss: float = 0.62
    least_rate_price: float = 4.0
    beginning_mpss: float = 0.9
    beginning_s: float = 0.45
    settled_mpss: float = 0.25
    settled_s: float = 0.6
    early_mpss: float = 0.4
    early_price: float = 4.0
    shortest_s: float = 0.45
    shortest_stand_s: float = 0.45
    least_s: float = 0.33
    least_stand_s: float = 0.33
    slowest_mps: float = 1.8
    slowest_price: float = 6.0
    moves_mps: float = 0.7
    # -- the ego's way -----------------------------------------------------------------------------------------------
    out_of_way_price: float = 12.0
    out_of_way_most: float = 3.0
    waits_price: float = 6.0
    sets_off_mpss: float = 1.5
    waits_mpss: float = 3.0
    waits_s: float = 1.5
    clear_of_ego_m: float = 1.5
    clear_of_zone_m: float = 0.5
    plain_mps: float = 1.2
    plain_price: float = 2.0
    # -- each other's way --------------------------------------------------------------------------------------------
    clear_m: float = 0.6
    clear_in_lane_m: float = 1.2
    clear_price: float = 90.0


def preferences_of(manner: Manner) -> Preferences:
    """Return the preferences of one who keeps to a manner: the usual ones, or stricter where the program is."""
    kept, usual = manner.stricter(ROOM), Preferences()
    begins = max(1.0, float(manner.begins_mpss / USUAL.begins_mpss))
    return Preferences(
        least_rate_mpss=max(usual.least_rate_mpss, float(kept.begins_mpss)),
        beginning_mpss=usual.beginning_mpss * begins,
        beginning_s=max(usual.beginning_s, 1.5 * float(manner.begins_s)),
        settled_mpss=min(usual.settled_mpss, float(calm_mpss(manner))),
        early_mpss=0.8 * float(manner.begins_mpss),
        settled_s=max(usual.settled_s, float(kept.settled_s) + 0.05),
        shortest_s=max(usual.shortest_s, float(kept.begins_s)),
        shortest_stand_s=max(usual.shortest_stand_s, float(kept.stands_s)),
        least_s=float(kept.begins_s),
        least_stand_s=float(kept.stands_s),
        stands_s=max(usual.stands_s, 1.2 * float(kept.stands_s)),
        clear_of_ego_m=max(usual.clear_of_ego_m, float(kept.clear_m)),
        clear_of_zone_m=max(usual.clear_of_zone_m, float(kept.clear_m)),
        clear_in_lane_m=max(usual.clear_in_lane_m, float(kept.clear_m)),
    )
