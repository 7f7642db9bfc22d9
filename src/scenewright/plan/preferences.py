"""What a plan prefers: every constant of planning, with where it comes from. The page is docs/closed-loop.md.

What enters: a program's manner. What leaves: `Preferences`. Costs are squares of residuals; a weight is one over what
costs as much as one unit of any other, a price is the weight of one tight tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.motion.limits import ROOM, calm_mpss
from scenewright.program.manner import USUAL, Manner


@dataclass(frozen=True, slots=True)
class Preferences:
    """Comfort, manner and prices of one planner; "measured" means: on the 80 rows against six egos, other values."""

    # -- comfort -----------------------------------------------------------------------------------------------------
    # Passengers notice a jerk from about 1 m/s^3 on, and an acceleration from 1.5 m/s^2 on (Hoberock 1977).
    jerk_mpsss: float = 1.0
    accel_mpss: float = 1.5
    # What a metre a second squared costs by which a plan begins otherwise than is driven: as if it took a tick.
    change_weight: float = 3.0
    # Lateral acceleration that drivers choose in town (as the predictor takes it of the ego).
    lateral_mpss: float = 2.5
    lateral_weight: float = 0.7
    # Usual rates of braking and of setting off in town, for pieces of which the program names none.
    braking_mpss: float = 2.2
    speeding_up_mpss: float = 1.6
    # Which share of the speed limit people drive at a trigger; what a metre a second off costs there.
    natural_share: float = 0.8
    trigger_speed_weight: float = 0.15
    over_limit_weight: float = 0.5
    # From when on a metre a second over what is posted costs evenly: a program may ask for it.
    over_sign_most: float = 1.0
    # How long pieces last of which nothing says it, and what a second more or less costs.
    lasts_s: float = 2.0
    lasts_weight: float = 0.3
    stands_s: float = 0.9
    stands_weight: float = 1.0
    # -- what was asked for ------------------------------------------------------------------------------------------
    # Of a tight tolerance. Measured: dearer, corrections get harsh; cheaper, misses creep in.
    price: float = 30.0
    # Who is to be first: by this much (s), and a second less costs so; where a forecast denies it, what is in the
    # hero's own hands is not spoilt for it: from this cost on it grows evenly.
    order_s: float = 1.5
    order_price: float = 4.0
    order_most: float = 3.0
    sure_order_most: float = 30.0
    # A trigger of which both decide when it comes: what a second off its planned instant costs.
    punctual_weight: float = 0.7
    # What it costs to take twice an everyday value, or none of it, for a parameter that is left open; chosen.
    everyday_weight: float = 1.0
    # -- manner ------------------------------------------------------------------------------------------------------
    # More than the program's manner asks for, so that samples and rounding do not decide.
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
    # What the program's manner asks for, with the room that the proofs leave: shorter than this no piece is.
    least_s: float = 0.33
    least_stand_s: float = 0.33
    # Slower at its trigger than this, a hero does hardly drive; and nobody does who is slower than the second.
    slowest_mps: float = 1.8
    slowest_price: float = 6.0
    moves_mps: float = 0.7
    # -- the ego's way -----------------------------------------------------------------------------------------------
    # What a metre within a conflict zone costs before the trigger, and from when on evenly: a program may ask for it.
    out_of_way_price: float = 12.0
    out_of_way_most: float = 3.0
    # Who waits for an ego does so where it could stop (at this rate) and set off again (at this one) in time; while the
    # trigger is further off than that takes by this much.
    waits_price: float = 6.0
    sets_off_mpss: float = 1.5
    waits_mpss: float = 3.0
    waits_s: float = 1.5
    # Between the bodies of two on the ego's lane, and of one before a conflict zone and one in it.
    clear_of_ego_m: float = 1.5
    clear_of_zone_m: float = 0.5
    # On the ego's lane a distance that hardly changes cannot be told from what it is a moment later.
    plain_mps: float = 1.2
    plain_price: float = 2.0
    # -- each other's way --------------------------------------------------------------------------------------------
    # Between the boxes of two heroes, where their ways cross and in one lane; what a metre less costs.
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
