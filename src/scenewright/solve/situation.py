"""Where everybody is when a re-solve begins, and when the triggers should come.

What enters: states, history, a prediction of the ego. What leaves: nothing but these, as data.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from scenewright.motion.profile import Profile

# How soon a trigger may come (s): nobody can tell what begins sooner from what has begun.
SHORTEST_LEAD_S = 0.02


@dataclass(frozen=True, slots=True)
class HeroState:
    """Where a hero is: exactly, at `time_s`, within piece `piece` of its sketch; `knots_s` are the knots behind it."""

    time_s: float
    s_m: float
    speed_mps: float
    piece: int
    knots_s: Mapping[str, float]
    history: Profile


@dataclass(frozen=True, slots=True)
class Situation:
    """All that a re-solve starts from.

    Attributes
    ----------
    time_s
        Now.
    ego
        The ego's past and predicted motion, with the times of its knots, past and predicted, in `ego_knots_s`.
    heroes
        The state of every hero by id; one that has not started yet (its first state is still free) is absent.
    trigger_s
        For each hero that has a trigger ahead: the instant at which it should come now.
    planned_trigger_s
        The instant that the plan in force has for it.
    hero_there_s
        When the hero is at its own side, as it goes on by that plan: what took a tolerance is not there when planned.
    ego_slack_s
        By how much the instant may move until the ego is one tight tolerance off its own side.
    earliest_s
        For each hero that waits for the ego's side: ``(instant, arrival)`` pairs, in order: when the ego would be at
        its side at the earliest if it made haste from that instant on. Empty where it does not look like that.
    coasting
        Whether heroes that hold their speed meet the trigger at that instant.
    pressed
        Whether an ego in haste might be first where a hero is to be.
    """

    time_s: float
    ego: Profile
    ego_knots_s: Mapping[str, float]
    heroes: Mapping[int, HeroState]
    trigger_s: Mapping[int, float]
    planned_trigger_s: Mapping[int, float] = field(default_factory=dict)
    hero_there_s: Mapping[int, float] = field(default_factory=dict)
    ego_slack_s: float = 0.0
    earliest_s: Mapping[int, tuple[tuple[float, float], ...]] = field(default_factory=dict)
    coasting: bool = False
    pressed: bool = False
