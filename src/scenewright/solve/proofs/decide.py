"""Proof, witness or undecided: whether a scenario can happen with any ego that keeps its promises.

What enters: a scene and bounds on everybody's motion. What leaves: a `Decision`. Search and proof are two engines over
one lowering: Newton steps find nearly all witnesses in a few milliseconds, a solver is left with refutations. What is
found is realised and looked at by an evaluator of its own before it is called feasible.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scenewright.motion.profile import Profile
from scenewright.program.structure import Structure, actors_of
from scenewright.program.types import EGO, Constraint
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import Limits
from scenewright.solve.proofs.apart import apart
from scenewright.solve.proofs.crowding import crowded
from scenewright.solve.proofs.events import LONGEST_S, EgoBounds, Events, Unknown
from scenewright.solve.proofs.guesses import carried_over, first_guess
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.polynomials import ZERO, Formula, Named, resting_on
from scenewright.solve.proofs.refinement import Refinement
from scenewright.solve.proofs.refuters import SOLVERS, Refuter, core
from scenewright.solve.proofs.relaxation import relaxation
from scenewright.solve.proofs.search import Search
from scenewright.solve.proofs.witness import Broken, Witness, broken, realised

Array = NDArray[np.float64]
Owed = Literal["throughout", "at first", "nothing"]
_ROUNDS = 14  # how often one motion is mended before another is looked for
_GUESSES = (4, 12, 1000)  # how many first guesses are tried before each time that a proof is looked for
_PROOF_S = (0.15, 0.4, 0.1)
_CORE_S = 2.0  # for looking for what clashes among all constraints: as long as for the answer itself
_RANGES = {
    "time": f"everything happens within {float(LONGEST_S):g} s of the start",
    "speed": "how fast anybody may be",
    "place": "where the routes begin and end",
}
_WIDER = 1000  # a range so much wider is none
# What guesses owe of the manner, in turn; later ones owe nothing: a motion that looks like nothing is possible, too.
_OWED: tuple[Owed, ...] = ("throughout", "throughout", "at first")
_KEEN = 12  # so many guesses are made for one that does, where there is one that does not


@dataclass(frozen=True, slots=True)
class Decision:
    """Whether a scenario can happen.

    Attributes
    ----------
    answer
        ``feasible`` with a `witness`, ``infeasible`` with a `core` of origins that clash, or ``undecided``.
    left_out
        Constraints that the answer does not rest on, by id, and why.
    amiss
        What was still amiss with the best motion found, where undecided.
    doubted_by
        The solver that found it infeasible, where undecided because what that solver refutes is no proof.
    """

    answer: Literal["feasible", "infeasible", "undecided"]
    witness: Witness | None = None
    core: tuple[str, ...] = ()
    left_out: Mapping[str, str] = field(default_factory=dict)
    amiss: tuple[Broken, ...] = ()
    doubted_by: str = ""

    def __post_init__(self) -> None:
        if (self.answer == "feasible") != (self.witness is not None):
            raise ValueError("what is feasible has a witness, nothing else has one")


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked: a scene, who is bounded how; what is freed, or how the ego drove, where that matters; of whom.

    Of those who are `bending` proofs take into account how fast their bends can be driven.
    """

    scene: Scene
    structure: Structure
    limits: Mapping[int, Limits]
    ego: EgoBounds = field(default_factory=EgoBounds)
    freed: Mapping[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    drive: Profile | None = None
    refuter: Refuter = field(default_factory=lambda: SOLVERS.called("z3"))
    bending: frozenset[int] = frozenset()

    def constraints(self) -> tuple[Constraint, ...]:
        """Return the constraints to be met; what the ego did alone is a fact, where its drive is given."""
        found = self.scene.program.constraints
        return tuple(c for c in found if self.drive is None or actors_of(c.formula) != {EGO})


class _Case:
    """One scene's events with what was added to them, grown as motions show the need."""

    def __init__(self, question: Question, owed: Owed = "nothing", plan: bool = True) -> None:
        self.events = Events(question.scene, question.limits, question.ego, question.drive, question.freed)
        self.lowering = Lowering(self.events, Fraction(1) if question.drive else ZERO)
        self.constraints = question.constraints()
        self._sizes = (0, 0)
        self.lowered: list[Named] = []
        self.lower()
        self.events.rules += apart(self.events, question.structure, self.constraints)
        self.more = Refinement(self.events, self.lowering, question.limits)
        if plan:
            self.more.lasting_rates()
        for actor in question.bending:
            self.more.bound_in_bend(actor, [each.formula for each in self.lowered])
        if owed != "nothing":
            self.more.manner(throughout=owed == "throughout")

    def lower(self) -> None:
        """Lower the constraints over the moments that there are now, if there are more of them."""
        sizes = len(self.events.times), len(self.events.states)
        if sizes != self._sizes:
            self.lowered, self._sizes = self.lowering.lower(self.constraints), sizes

    def formulas(self) -> list[Formula]:
        """Return all that a plan owes."""
        return [*(each.formula for each in (*self.lowered, *self.events.rules)), *self.more.owed]

    def search(self) -> Search:
        """Return a search over what there is now."""
        self.lower()
        return Search(self.events, self.formulas(), [*self.lowering.narrowings, *self.more.narrowings])

    def relaxation(self) -> list[Named]:
        """Return what a refutation rests on."""
        self.lower()
        return relaxation(self.events, [*self.lowering.narrowings, *self.more.narrowings], self.lowered)


def decide(question: Question, limit_s: float = 2.0, explain: bool = True) -> Decision:
    """Look for a witness and for a proof in turn until there is one of them, or the time is over.

    Open parameters are free within their ranges. With `explain` a proof comes with its core. Against one drive of the
    ego only a proof is looked for: what might have been is nobody's plan.
    """
    until = time.monotonic() + limit_s
    plain = _Case(question, plan=False)
    left_out = {each.origin: each.refused for each in plain.lowered if each.refused}
    if question.drive is None and (clashing := crowded(plain.events, plain.lowered)):
        return Decision("infeasible", core=clashing, left_out=left_out)
    cases: dict[frozenset[int], tuple[Sequence[Unknown], list[Named]]] = {}
    hunt = _Hunt(question, until)
    for guesses, proof_s in zip(_GUESSES, _PROOF_S, strict=True):
        if not left_out and question.drive is None and (found := hunt.witness(guesses)) is not None:
            return Decision("feasible", found)
        turning = frozenset(each.actor for each in hunt.amiss if each.what == "turn")
        for bending in dict.fromkeys((question.bending, question.bending | turning)):  # what needs no bends is easier
            bent = replace(question, bending=bending)
            if cases and time.monotonic() > until:
                break
            if bending not in cases:  # most witnesses need none
                case = plain if bending == question.bending else _Case(bent, plan=False)
                cases[bending] = case.events.unknowns, case.relaxation()
            answer = question.refuter.ask(*cases[bending], min(proof_s, until - time.monotonic()))
            if answer.kind == "refuted" and not question.refuter.capabilities.exact:
                return Decision("undecided", left_out=left_out, amiss=hunt.amiss, doubted_by=question.refuter.name)
            if answer.kind == "refuted":
                clashing = _core(bent, *cases[bending]) if explain else ()
                return Decision("infeasible", core=clashing, left_out=left_out)
    return Decision("undecided", left_out=left_out, amiss=hunt.amiss)


@dataclass(slots=True)
class _Hunt:
    """Looks for a witness from one guess after another: `tried` so many so far; `amiss` is what was with the last."""

    question: Question
    until: float
    tried: int = 0
    amiss: tuple[Broken, ...] = ()
    generator: np.random.Generator = field(default_factory=lambda: np.random.default_rng(0))

    def witness(self, guesses: int) -> Witness | None:
        """Return a witness, if that can be had one that keeps to the manner; None where so many guesses find none."""
        kept, last = None, self.tried + guesses
        while self.tried < (last if kept is None else _KEEN) and time.monotonic() < self.until:
            keen = self.tried < len(_OWED) or kept is not None
            found = self._mended(_Case(self.question, _OWED[self.tried % len(_OWED)] if keen else "nothing"))
            self.tried += 1
            if found is not None and keen:
                return found
            kept = kept or found
        return kept

    def _mended(self, case: _Case) -> Witness | None:
        """Search from a guess, and mend what is amiss with what is found until nothing is, or nothing helps."""
        generator = self.generator if self.tried else None
        guess = first_guess(case.events, case.formulas(), generator)
        for _ in range(_ROUNDS):
            search = case.search()
            guess = np.append(guess, np.zeros(len(case.events.unknowns) - len(guess)))  # rates at new moments
            point = search.run(guess, generator)
            if point is None:
                return None
            witness = realised(case.events, search, point)
            asked = self.question
            self.amiss = tuple(broken(asked.scene, asked.structure, asked.limits, asked.ego, witness))
            if not self.amiss:
                return witness
            if time.monotonic() > self.until or not case.more.mend(self.amiss, witness):
                return None
            case.lower()
            guess = carried_over(case.events, point, witness)
        return None


def _core(question: Question, unknowns: Sequence[Unknown], formulas: Sequence[Named]) -> tuple[str, ...]:
    """Return what clashes, and which ranges of single numbers it takes for that.

    Formulas are made with what all constraints say of the order of moments, and of who is who's moment: whether some
    of them clash is asked about these alone.
    """
    refuter, until = question.refuter, time.monotonic() + _CORE_S
    first = refuter.ask(unknowns, formulas, 1.0, want_core=True).core
    told = [constraint.id for constraint in question.constraints()]
    kept = [name for name in told if name in first]
    if (posed := _posed(question, kept)) is None:
        kept, posed = told, (unknowns, formulas)
    for name in list(kept):
        fewer = [other for other in kept if other != name]
        if time.monotonic() < until and (easier := _posed(question, fewer)) is not None:
            kept, posed = fewer, easier
    laws = [each for each in core(refuter, *posed, 1.0) if each not in kept]
    clashing = resting_on(posed[1], (*kept, *laws))
    ranges = []
    for kind, words in _RANGES.items():
        wide = (replace(each, low=-_WIDER * each.high, high=_WIDER * each.high) for each in posed[0])
        wider = [new if old.kind == kind else old for old, new in zip(posed[0], wide, strict=True)]
        if refuter.ask(wider, clashing, 0.2).kind == "met":
            ranges.append(words)
    return (*kept, *laws, *ranges)


def _posed(question: Question, kept: Collection[str]) -> tuple[Sequence[Unknown], Sequence[Named]] | None:
    """Return unknowns and formulas of some of the constraints alone, if these are refuted."""
    program = question.scene.program
    fewer = replace(program, constraints=tuple(c for c in program.constraints if c.id in kept))
    case = _Case(replace(question, scene=replace(question.scene, program=fewer)), plan=False)
    formulas = case.relaxation()
    if question.refuter.ask(case.events.unknowns, formulas, 0.5).kind == "refuted":
        return case.events.unknowns, formulas
    return None
