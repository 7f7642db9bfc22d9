"""What the simulator needs of whoever drives the heroes: the orchestrator's planner, or a rival of it.

What enters: the ego's states, step by step. What leaves: the heroes' motions. It names the contract; it drives nobody.
"""

from __future__ import annotations

from typing import Protocol

from scenewright.plan.planner import Replan
from scenewright.plan.prediction import EgoSample
from scenewright.solve.plan import Plan


class HeroDriver(Protocol):
    """Drives every hero of a scene through one run."""

    @property
    def plan(self) -> Plan:
        """The motions in force: each tells its hero's state from now on, and its knots as far as they are known.

        The simulator asks for it anew at every step, so a driver may put another in its place at any time.
        """

    @property
    def ego_knots_s(self) -> dict[str, float]:
        """When the ego passed its knots."""

    @property
    def records(self) -> list[Replan]:
        """What each tick came to."""

    def tick(self, time_s: float) -> Replan:
        """Solve again where that is needed; called at the re-solve rate of the run, but not at its very beginning."""

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state; called after every step, before the heroes' states at its end are asked for."""
