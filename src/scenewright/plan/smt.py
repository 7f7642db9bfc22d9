"""The paper's own loop: an SMT solver at every tick, over motions of one rate a piece, with tolerances that give way.

What enters: the ego's states, step by step. What leaves: the heroes' motions, and a record of every re-solve. The ego
is foreseen as in the paper: by the solver, which chooses a rate for each of its pieces within what it may do. Where
nothing is found the plan in force goes on.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from scenewright.motion.profile import Profile, Segment
from scenewright.plan.one_rate import OneRate, Past, Question
from scenewright.plan.planner import Attempt, Replan
from scenewright.plan.prediction import EgoSample
from scenewright.plan.problem import Missed
from scenewright.plan.situation import SeenAndForeseen
from scenewright.program.printer import print_expression
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import Limits
from scenewright.solve.plan import Plan
from scenewright.solve.proofs.events import EgoBounds
from scenewright.solve.proofs.refuters import Answer
from scenewright.solve.proofs.z3_engine import Z3

# What reactive constraints are weakened by in turn, in tight tolerances: the paper names no numbers; the last is the loose
# tolerance of places and speeds.
TOLERANCES = tuple(map(Fraction, (0, 1, 2, 4)))
# z3's own count of its work in one question, which does not depend on the machine; and the paper's limit (s), beyond it.
EVEN=(True,False)
ORDER=[(t,e) for t in TOLERANCES for e in (True,False)]
MOST_WORK, LIMIT_S = 2_000_000, 10.0


class NoPlan(Exception):  # noqa: N818 - not a fault, but an answer
    """There is no first plan; the message says why."""


@dataclass(slots=True)
class SmtPlanner:
    """Plans and re-plans the heroes of one scene over one run; `simulate.heroes.HeroDriver` says what is asked of it."""

    scene: Scene
    limits: Mapping[int, Limits]
    ego: EgoBounds
    plan: Plan = field(init=False)
    ego_knots_s: dict[str, float] = field(init=False, default_factory=dict)
    records: list[Replan] = field(init=False, default_factory=list)
    _motions: OneRate = field(init=False)
    _solver: Z3 = field(init=False)
    _samples: list[EgoSample] = field(init=False, default_factory=list)
    _moments_s: dict[int, float] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self._motions, self._solver = OneRate(self.scene, self.limits, self.ego), Z3(MOST_WORK)

    @property
    def is_alarmed(self) -> bool:
        """Return that nothing alarms it: it is asked at every tick."""
        return False

    def begin(self, ego: EgoSample) -> Attempt:
        """Plan from the ego's first state; the plan is kept.

        Raises
        ------
        NoPlan
            Where a constraint cannot be lowered, or the solver finds nothing.
        """
        started = time.perf_counter()
        if self._motions.refused:
            raise NoPlan("no solver takes " + self._words([each.constraint.id for each in self._motions.refused]))
        self._samples = [ego]
        for even in EVEN:
            question = self._motions.first(ego[1:3], even=even)
            answer = self._ask(question)
            if answer.kind == "met":
                break
        if answer.kind != "met":
            raise NoPlan(self._why(question, answer))
        self._keep(question, answer, 0.0)
        wall_s = time.perf_counter() - started
        self.records = [Replan(0.0, "sat", "z3", wall_s, 0.0, "")]
        return Attempt(self.plan, Missed(), wall_s, 1)

    def tick(self, time_s: float) -> Replan:
        """Ask at one tolerance after another until there is a plan; the one in force goes on where there is none."""
        started = time.perf_counter()
        last_s = max(max(self.plan.profiles[hero.id].knot_times_s.values()) for hero in self.scene.program.heroes)
        if last_s <= time_s:
            self.records.append(Replan(time_s, "frozen", "", 0.0, self.plan.tolerance, "all pieces are over"))
            return self.records[-1]
        now_s, s_m, speed_mps, accel_mpss = self._samples[-1]
        ego = SeenAndForeseen(self._samples, Profile((Segment(now_s, 0.0, s_m, speed_mps, accel_mpss),)))
        states = {actor: profile.state for actor, profile in self.plan.profiles.items()} | {EGO: ego}
        past, told = Past(time_s, self._moments_s, states), list[str]()
        status, reached = "unsat", self.plan.tolerance
        for tolerance, even in ORDER:
            question = self._motions.again(past, tolerance, even=even)
            answer = self._ask(question)
            if answer.kind == "met":
                status, reached = "relaxed" if tolerance else "sat", float(tolerance)
                self._keep(question, answer, reached)
                break
            told.append(f"{_SAYS[answer.kind]} at {tolerance}")
        else:
            status = "kept" if "timed out" in " ".join(told) else status
        if question.broken:
            told.append("it has not happened as asked in " + ", ".join(question.broken))
        wall_s = time.perf_counter() - started
        self.records.append(Replan(time_s, status, "z3", wall_s, reached, "; ".join(told)))
        return self.records[-1]

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step; its knots come when the plan in force says."""
        self._samples.append(sample)
        for name, at_s in self.plan.profiles[EGO].knot_times_s.items():
            if at_s <= sample[0]:
                self.ego_knots_s.setdefault(name, at_s)

    def ego_stood_s(self, time_s: float) -> float:
        """Return for how long the ego has not moved (s)."""
        return time_s - next((sample[0] for sample in reversed(self._samples) if sample[2] > 0.1), 0.0)

    # -- asking -------------------------------------------------------------------------------------------------------
    def _ask(self, question: Question) -> Answer:
        return self._solver.ask(question.unknowns, question.formulas, LIMIT_S)

    def _keep(self, question: Question, answer: Answer, tolerance: float) -> None:
        values, profiles = question.values(answer.values), dict[int, Profile]()
        for actor in self.scene.program.actors:
            driven = self.plan.profiles[actor.id] if self.records and actor.id != EGO else None
            profiles[actor.id] = self._motions.profile(actor, question, values, driven)
        self._moments_s = self._motions.moments_s(values)
        style = "relaxed" if tolerance else "sat"
        parameters = {name: float(value) for name, value in self.scene.parameters.items()}
        self.plan = Plan(profiles, tolerance, style, parameters)

    def _why(self, question: Question, answer: Answer) -> str:
        if answer.kind != "refuted":
            return f"the SMT solver gave up on a first plan ({_SAYS[answer.kind]})"
        core = self._solver.ask(question.unknowns, question.formulas, LIMIT_S, want_core=True).core
        return f"no motion of one rate a piece, from where the ego starts, holds {self._words(core)}"

    def _words(self, origins: tuple[str, ...] | list[str]) -> str:
        formulas = {each.id: print_expression(each.formula) for each in self.scene.program.constraints}
        return "; ".join(f"{name}: {formulas[name]}" if name in formulas else name for name in origins)


_SAYS = {"refuted": "unsat", "timeout": "timed out", "unknown": "unknown"}
