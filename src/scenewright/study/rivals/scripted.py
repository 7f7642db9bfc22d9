"""Heroes that carry out a script: an approach, then, from the step at which the conditions hold, the manoeuvre.

What enters: scripts, and the ego's state after every step. What leaves: motions, as the simulator asks for them. They
see where the ego is and how fast, as any engine's conditions do; of its policy they know nothing.
"""

from __future__ import annotations

from collections.abc import Mapping

from scenewright.motion.profile import Profile
from scenewright.plan.planner import Replan
from scenewright.plan.prediction import EgoSample
from scenewright.program.structure import Structure
from scenewright.program.types import EGO
from scenewright.solve.plan import Plan
from scenewright.study.rivals.script import Script

_NEVER_S = float("inf")


class ScriptedHeroes:
    """A trigger-action engine; `simulate.loop.HeroDriver` says what the attributes are.

    Parameters
    ----------
    scripts
        By hero id.
    first
        The plan that the scripts were written from; of it the ego's foreseen motion is kept.
    step_s
        The simulator's step: how often conditions are looked at.
    """

    def __init__(self, structure: Structure, scripts: Mapping[int, Script], first: Plan, step_s: float) -> None:
        self.scripts = scripts
        self.step_s = step_s
        self._ego = first.profiles[EGO]
        self.plan = Plan({EGO: self._ego, **{hero: script.intended() for hero, script in scripts.items()}})
        self.ego_knots_s: dict[str, float] = {}
        self.records: list[Replan] = []
        self.fired_s: dict[int, float] = {}
        self._structure = structure
        self._motions = {hero: _waiting(script) for hero, script in scripts.items()}

    def tick(self, time_s: float) -> Replan:
        """Record that nothing is solved again: all was fixed before the run."""
        record = Replan(time_s, "fixed", "", 0.0, 0.0, "the script is carried out")
        self.records.append(record)
        return record

    def observe(self, sample: EgoSample) -> None:
        """Look at the conditions, and start the manoeuvre of every hero whose group holds for the first time."""
        time_s, ego_m, ego_mps, _ = sample
        states = {hero: motion.state(time_s)[:2] for hero, motion in self._motions.items()}
        states[EGO] = (ego_m, ego_mps)
        for hero, script in self.scripts.items():
            if hero in self.fired_s:
                continue
            if script.group.holds(time_s, states):
                self.fired_s[hero] = time_s
                self._motions[hero] = script.carried_out(time_s, *states[hero])
                self._note_trigger(hero, time_s)
            else:
                self._motions[hero] = self.approach(script, self._motions[hero], sample)
        self.plan = Plan({EGO: self._ego, **self._motions})

    def approach(self, script: Script, motion: Profile, ego: EgoSample) -> Profile:
        """Return the motion of a hero whose conditions do not hold yet; here it goes on as the script says."""
        return motion

    def _note_trigger(self, hero: int, time_s: float) -> None:
        for owner, name in self._structure.triggers.get(hero, ()):
            if owner == EGO:
                self.ego_knots_s.setdefault(name, time_s)


def _waiting(script: Script) -> Profile:
    """Return the approach; the knots from the trigger on are not in sight, so that the simulator waits for them."""
    knots = dict.fromkeys(script.hero.sketch.knots, _NEVER_S) | script.approach.knot_times_s
    return Profile(script.approach.segments, knots)
