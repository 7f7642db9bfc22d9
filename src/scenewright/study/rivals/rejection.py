"""First states sampled until a run succeeds: what sampling scenario languages do.

What enters: scripts, a seed. What leaves: scripts with other first states, one after another. It drives nothing; each
sample is a whole trigger-action run, judged like any other.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from scenewright.motion.limits import MOVING_MPS
from scenewright.solve.arrival import LinearCondition
from scenewright.study.rivals.script import Script

_START_MARGIN_M = 3.0
# What an author leaves open, both uniform: speed, in shares of what a driver would choose on the way to the junction;
# way to the hero's place, in shares of what it covers at that speed until the trigger is due.
_SPEED_SHARES, _WAY_SHARES = (0.5, 1.1), (0.7, 1.3)


def sampled_scripts(
    conditions: tuple[LinearCondition, ...], scripts: Mapping[int, Script], generator: np.random.Generator
) -> Iterator[dict[int, Script]]:
    """Yield scripts with sampled first states, without end; what the program says of a first state is kept."""
    while True:
        yield {hero: _sampled(conditions, script, generator) for hero, script in scripts.items()}


def _sampled(conditions: tuple[LinearCondition, ...], script: Script, generator: np.random.Generator) -> Script:
    hero, limits = script.hero, script.limits
    speed = limits.natural_approach_speed_mps * float(generator.uniform(*_SPEED_SHARES))
    share = float(generator.uniform(*_WAY_SHARES))
    initial = [
        c.weights[hero.id] + (c.constant,)
        for c in conditions
        if c.moments == {(hero.id, hero.sketch.knots[0])} and set(c.weights) == {hero.id}
    ]
    for per_metre, per_speed, constant in initial:
        if not per_metre:
            speed = -constant / per_speed
    speed = min(max(speed, MOVING_MPS), limits.approach_speed_max_mps)
    s_m = max(_START_MARGIN_M, script.place_at_m(speed) - share * speed * script.trigger_s)
    for per_metre, per_speed, constant in initial:
        if per_metre:
            s_m = -(constant + per_speed * speed) / per_metre
    return script.begun_at(s_m, speed)
