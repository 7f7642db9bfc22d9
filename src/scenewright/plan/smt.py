"""The paper's own loop: an SMT solver at every tick, over motions of one rate a piece, with tolerances that give way.

What enters: the ego's states, step by step. What leaves: the heroes' motions, and a record of every re-solve. The
solver foresees the ego, too: it holds its speed, or else has any rate in each piece that it may have. Where nothing is
found the plan in force goes on.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product

from scenewright.algebra.polynomials import origins_of, resting_on
from scenewright.motion.limits import Limits
from scenewright.motion.profile import Profile, Segment
from scenewright.plan.one_rate import OneRate, Past, Question
from scenewright.plan.planner import Attempt, Replan
from scenewright.plan.prediction import EgoSample
from scenewright.plan.problem import Missed
from scenewright.plan.situation import SeenAndForeseen
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.solve.plan import Plan
from scenewright.solve.proofs.events import EgoBounds
from scenewright.solve.proofs.refuters import Answer, answer_of, clashing
from scenewright.solve.proofs.z3_engine import Z3
from scenewright.translate.lines import told_constraints

# By how many tight tolerances reactive constraints give way in turn: the paper has "various" and names none; 4 is the
# loose tolerance of places and speeds.
TOLERANCES = tuple(map(Fraction, (0, 1, 2, 4)))
# The paper's limit for a question (s), in z3's own count of its work: here it counts 1.5 million in a second of these
# questions, and the longest of rows 1, 4, 20 and 60 against `idm` took 0.76 million.
LIMIT_S, WORK_PER_S = 10.0, 500_000
_EVEN_FIRST = (True, False)


@dataclass(slots=True)
class SmtPlanner:
    """Plans and re-plans the heroes of one scene over one run; `simulate.loop.HeroDriver` says what is asked of it.

    What the last first plan failed for is `why`.
    """

    scene: Scene
    limits: Mapping[int, Limits]
    ego: EgoBounds
    plan: Plan = field(init=False)
    ego_knots_s: dict[str, float] = field(init=False, default_factory=dict)
    records: list[Replan] = field(init=False, default_factory=list)
    why: str = field(init=False, default="")
    _motions: OneRate = field(init=False)
    _solver: Z3 = field(init=False)
    _samples: list[EgoSample] = field(init=False, default_factory=list)
    _moments_s: dict[int, float] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self._motions, self._solver = OneRate(self.scene, self.limits, self.ego), Z3(WORK_PER_S)

    @property
    def refused(self) -> str:
        """Name the constraints that no solver takes, with what is wrong with them; nothing where there are none."""
        return "; ".join(f"{self._words([each.origin])} ({each.refused})" for each in self._motions.refused)

    def begin(self, ego: EgoSample) -> Attempt | None:
        """Plan from the ego's first state, and keep the plan; None where there is none, and `why` says why."""
        started = time.perf_counter()
        self._samples = [ego]
        for even in _EVEN_FIRST:
            question = self._motions.first(ego[1:3], even=even)
            answer = self._ask(question)
            if answer.kind == "met":
                self._keep(question, answer, 0.0)
                wall_s = time.perf_counter() - started
                self.records = [Replan(0.0, "sat", "z3", wall_s, 0.0, "", self.plan.profiles[EGO])]
                return Attempt(self.plan, Missed(), 1)
        self.why = self._clash(question) if answer.kind == "refuted" else f"z3 gave up ({answer.kind})"
        return None

    def tick(self, time_s: float) -> Replan:
        """Ask at one tolerance after another until there is a plan; the one in force goes on where there is none."""
        started = time.perf_counter()
        last_s = max(max(self.plan.profiles[hero.id].knot_times_s.values()) for hero in self.scene.program.heroes)
        if last_s <= time_s:
            record = Replan(time_s, "frozen", "", 0.0, self.plan.tolerance, "all pieces are over")
        else:
            status, reason = self._planned_again(self._past(time_s))
            wall_s, plan = time.perf_counter() - started, self.plan.profiles if status in ("sat", "relaxed") else {}
            record = Replan(time_s, status, "z3", wall_s, self.plan.tolerance, reason, plan.get(EGO))
        self.records.append(record)
        return record

    def observe(self, sample: EgoSample) -> None:
        """Take note of the ego's state after a step; its knots come when the plan in force says."""
        self._samples.append(sample)
        for name, at_s in self.plan.profiles[EGO].knot_times_s.items():
            if at_s <= sample[0]:
                self.ego_knots_s.setdefault(name, at_s)

    # -- asking -------------------------------------------------------------------------------------------------------
    def _past(self, time_s: float) -> Past:
        now_s, s_m, speed_mps, accel_mpss = self._samples[-1]
        ego = SeenAndForeseen(self._samples, Profile((Segment(now_s, 0.0, s_m, speed_mps, accel_mpss),)))
        states = {actor: profile.state for actor, profile in self.plan.profiles.items()} | {EGO: ego}
        return Past(time_s, self._moments_s, states)

    def _planned_again(self, past: Past) -> tuple[str, str]:
        """Put a new plan in force where there is one, and return status and reason."""
        told = dict[str, None]()
        for tolerance, even in product(TOLERANCES, _EVEN_FIRST):
            question = self._motions.again(past, tolerance, even=even)
            answer = self._ask(question)
            if answer.kind == "met":
                status = "relaxed" if tolerance else "sat"
                self._keep(question, answer, float(tolerance))
                break
            told[f"{answer.kind} at {tolerance}"] = None
        else:
            status = "unsat" if all(each.startswith("refuted") for each in told) else "unknown"
        if question.broken:
            told["it has not happened as asked in " + ", ".join(question.broken)] = None
        return status, "; ".join(told)

    def _ask(self, question: Question) -> Answer:
        return answer_of(self._solver, question.unknowns, question.formulas, LIMIT_S)

    def _keep(self, question: Question, answer: Answer, tolerance: float) -> None:
        values, profiles = question.values(answer.values), dict[int, Profile]()
        for actor in self.scene.program.actors:
            driven = self.plan.profiles[actor.id] if self.records and actor.id != EGO else None
            profiles[actor.id] = self._motions.profile(actor, question, values, driven)
        self._moments_s = self._motions.moments_s(values)
        parameters = {name: float(value) for name, value in self.scene.parameters.items()}
        self.plan = Plan(profiles, tolerance, parameters)

    def _clash(self, question: Question) -> str:
        formulas = question.formulas
        core = clashing(
            self._solver, origins_of(formulas), lambda kept: (question.unknowns, resting_on(formulas, kept))
        )
        return f"no motion of one rate a piece holds all of: {self._words(core)}"

    def _words(self, origins: Sequence[str]) -> str:
        told = told_constraints(self.scene.program)
        return "; ".join(told.get(name, name) for name in origins)
