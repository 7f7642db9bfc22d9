"""Proof, witness or undecided: whether a scenario can happen with any ego that keeps its promises.

What enters: a question. What leaves: a `Decision`. Search and proof are two engines over one lowering: Newton steps
find nearly all witnesses in a few milliseconds, a solver is left with refutations.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import Named, Unknown, origins_of, resting_on
from scenewright.program.magnitudes import LONGEST_S
from scenewright.program.structure import actors_of
from scenewright.program.types import EGO
from scenewright.solve.proofs.apart import crowded
from scenewright.solve.proofs.guesses import carried_over, first_guess
from scenewright.solve.proofs.refinement import Case, Question
from scenewright.solve.proofs.refuters import answer_of, clashing
from scenewright.solve.proofs.witness import Broken, Witness, broken, realised

__all__ = ["Decision", "Question", "decide", "shown"]

Array = NDArray[np.float64]
_ROUNDS = 14  # how often one motion is mended before another is looked for
# How many first guesses are tried, and how long (s) a proof is looked for, in turn; chosen.
_TRIES = (4, 0.15), (12, 0.4), (1000, 0.1)
# How much a search does in what is called a second here. No clock is asked: answers are the same on any machine.
_WORK_PER_S = 4_000_000
_RANGES = {
    "time": f"everything happens within {float(LONGEST_S):g} s of the start",
    "speed": "how fast anybody may be: {speeds}",
    "rate": "how hard anybody may brake and speed up: {rates}",
    "place": "where the routes begin and end",
}
_WIDER = 1000  # a range so much wider is none
_PLAIN = 4  # so many guesses owe the manner; a motion that looks like nothing is possible, too


@dataclass(frozen=True, slots=True)
class Decision:
    """Whether a scenario can happen.

    It is ``feasible`` with a `witness`, ``infeasible`` with a `core` of origins that clash, or ``undecided``: then
    `amiss` tells what still was with the best motion found, and `doubted_by` which solver refutes it, to which that is
    no proof. It does not rest on the constraints that are `left_out`, by id, and why.
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


def decide(question: Question, limit_s: float = 2.0, explain: bool = True) -> Decision:
    """Look for a witness and for a proof in turn until there is one of them, or enough has been done.

    Open parameters are free within their ranges. With `explain` a proof comes with its core. Against one drive of the
    ego only a proof is looked for: what might have been is nobody's plan.
    """
    plain = Case(question)
    left_out = {each.origin: each.refused for each in plain.lowered if each.refused}
    if question.drive is None and (crowd := crowded(plain.events, plain.lowered)):
        return Decision("infeasible", core=crowd, left_out=left_out)
    hunt, asked, posed = _Hunt(question, int(limit_s * _WORK_PER_S)), question, None  # most witnesses need none posed
    for guesses, proof_s in _TRIES:
        if not left_out and question.drive is None and (found := hunt.witness(guesses)) is not None:
            return Decision("feasible", found)
        turning = question.bending.union(each.actor for each in hunt.amiss if each.what == "turn")
        if posed is not None and turning != asked.bending:  # what needs no bends is easier
            asked = replace(question, bending=turning)
            posed = Case(asked).posed()
        posed = posed or plain.posed()
        refuter = question.refuter
        if answer_of(refuter, *posed, min(proof_s, limit_s)).kind == "refuted":
            if not refuter.capabilities.exact:
                return Decision("undecided", left_out=left_out, amiss=hunt.amiss, doubted_by=refuter.name)
            return Decision("infeasible", core=_core(asked) if explain else (), left_out=left_out)
    return Decision("undecided", left_out=left_out, amiss=hunt.amiss)


def shown(question: Question, guesses: int) -> tuple[Witness | None, float]:
    """Look for a witness alone, from so many guesses at most; return it, and how long that took (s, by its work)."""
    hunt = _Hunt(question, most := guesses * _WORK_PER_S)
    return hunt.witness(guesses), (most - hunt.left) / _WORK_PER_S


@dataclass(slots=True)
class _Hunt:
    """Looks for a witness from one guess after another, as long as there is work `left`.

    It `tried` so many so far; `amiss` is what was with the last.
    """

    question: Question
    left: int
    tried: int = 0
    amiss: tuple[Broken, ...] = ()
    generator: np.random.Generator = field(default_factory=lambda: np.random.default_rng(0))

    def witness(self, guesses: int) -> Witness | None:
        """Return a witness, at first only one in the program's manner; None where so many guesses find none."""
        last = self.tried + guesses
        while self.tried < last and self.left > 0:
            found = self._mended(Case(self.question, plan=True, manner=self.tried < _PLAIN))
            self.tried += 1
            if found is not None:
                return found
        return None

    def _mended(self, case: Case) -> Witness | None:
        """Search from a guess, and mend what is amiss with what is found until nothing is, or nothing helps."""
        generator = self.generator if self.tried else None
        guess = first_guess(case.events, case.formulas(), generator)
        for _ in range(_ROUNDS):
            search = case.search()
            point = search.run(guess, generator)
            self.left -= search.work
            if point is None:
                return None
            witness = realised(case.events, search, point)
            asked = self.question
            self.amiss = tuple(broken(asked.scene, asked.structure, asked.limits, asked.ego, witness))
            if not self.amiss:
                return witness
            if self.left <= 0 or not case.mend(self.amiss, witness):
                return None
            guess = carried_over(case.events, point, witness)
        return None


def _core(question: Question) -> tuple[str, ...]:
    """Return what clashes, and which ranges of single numbers it takes for that.

    Formulas are made with what all constraints say of the order of moments, and of who is who's moment: whether some
    of them clash is asked about these alone.
    """
    refuter, told = question.refuter, [constraint.id for constraint in question.constraints()]
    kept = clashing(refuter, told, lambda names: _posed(question, names))
    unknowns, formulas = _posed(question, kept)
    origins = [origin for origin in origins_of(formulas) if origin not in kept]
    laws = clashing(refuter, origins, lambda laws: (unknowns, resting_on(formulas, (*kept, *laws))))
    rests_on, ranges = resting_on(formulas, (*kept, *laws)), []
    for kind, words in _RANGES.items():
        wide = (replace(each, low=-_WIDER * each.high, high=_WIDER * each.high) for each in unknowns)
        wider = [new if old.kind == kind else old for old, new in zip(unknowns, wide, strict=True)]
        if answer_of(refuter, wider, rests_on, 0.2).kind == "met":
            ranges.append(words.format(**_free(question, kept)))
    return (*kept, *laws, *ranges)


def _free(question: Question, kept: Collection[str]) -> dict[str, str]:
    """Return between which speeds and rates those are of whom the constraints that clash speak."""
    program = question.scene.program
    told = {actor for each in kept for actor in actors_of(program.constraint(each).formula)}
    laws = {EGO: question.ego.law()} | {hero.id: question.limits[hero.id].law() for hero in program.heroes}
    free = {program.actor(actor).name: laws[actor] for actor in sorted(told or laws)}
    speeds = ", ".join(f"{who} 0 to {float(law.speed_high):.4g} m/s" for who, law in free.items())
    rates = (f"{who} {float(law.rate_low):.4g} to {float(law.rate_high):.4g} m/s^2" for who, law in free.items())
    return {"speeds": speeds, "rates": ", ".join(rates)}


def _posed(question: Question, kept: Collection[str]) -> tuple[list[Unknown], list[Named]]:
    """Return unknowns and formulas of some of the constraints alone."""
    program = question.scene.program
    fewer = replace(program, constraints=tuple(c for c in program.constraints if c.id in kept))
    return Case(replace(question, scene=replace(question.scene, program=fewer))).posed()
