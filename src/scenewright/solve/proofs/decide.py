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

from scenewright.program.structure import Structure, actors_of
from scenewright.program.types import EGO, Constraint
from scenewright.roads.grounding import Scene
from scenewright.solve.limits import Limits
from scenewright.solve.proofs.apart import apart
from scenewright.solve.proofs.consequences import consequences
from scenewright.solve.proofs.crowding import crowded
from scenewright.solve.proofs.events import LONGEST_S, EgoBounds, EgoDrive, Events, Unknown
from scenewright.solve.proofs.guesses import carried_over, first_guess
from scenewright.solve.proofs.lowering import Lowered, Lowering
from scenewright.solve.proofs.polynomials import ZERO, Atom, Formula, Some
from scenewright.solve.proofs.refinement import Refinement
from scenewright.solve.proofs.refuters import Refuter, core, refuter_called, taken
from scenewright.solve.proofs.relaxation import Named, relaxation, resting_on
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
    "place": "where the routes end",
}
_WIDER = 1000  # a range so much wider is none
# What guesses owe of the manner, in turn: a motion that cannot be told by its looks is possible all the same.
_OWED: tuple[Owed, ...] = ("throughout", "throughout", "at first", "nothing")
_KEEN = 12  # so many guesses are made for a motion that can, where there is one that cannot


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
    """What is asked: a scene, who is bounded how; what is freed, or how the ego drove, where that matters; of whom."""

    scene: Scene
    structure: Structure
    limits: Mapping[int, Limits]
    ego: EgoBounds = field(default_factory=EgoBounds)
    freed: Mapping[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    drive: EgoDrive | None = None
    refuter: Refuter = field(default_factory=refuter_called)

    def constraints(self) -> tuple[Constraint, ...]:
        """Return the constraints to be met; what the ego did alone is a fact, where its drive is given."""
        found = self.scene.program.constraints
        return tuple(c for c in found if self.drive is None or actors_of(c.formula) != {EGO})


class _Case:
    """One scene's events with what was added to them, grown as motions show the need."""

    def __init__(self, question: Question, owed: Owed = "nothing", plan: bool = True) -> None:
        self.scene, self.structure, self.limits = question.scene, question.structure, question.limits
        self.events = Events(question.scene, question.limits, question.ego, question.drive, question.freed)
        self.lowering = Lowering(self.events, Fraction(1) if question.drive else ZERO)
        self.constraints = question.constraints()
        self._sizes = (0, 0)
        self.lowered: list[Lowered] = []
        self.lower()
        self.events.rules += apart(self.events, self.structure, self.constraints)
        self.more = Refinement(self.events, self.lowering, question.limits)
        if plan:
            self.more.lasting_rates()
        if owed != "nothing":
            self.more.manner(throughout=owed == "throughout")

    def lower(self) -> None:
        """Lower the constraints over the moments that there are now, if there are more of them."""
        sizes = len(self.events.times), len(self.events.states)
        if sizes != self._sizes:
            self.lowered, self._sizes = self.lowering.lower(self.constraints), sizes

    def formulas(self) -> list[Formula]:
        """Return all that a plan owes."""
        return [
            *(each.formula for each in self.lowered),
            *(formula for formula, _ in self.events.rules),
            *self.more.owed,
        ]

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
    asked = len(plain.events.unknowns)
    left_out = {each.constraint.id: each.refused for each in plain.lowered if each.refused}
    if question.drive is None and (clashing := crowded(plain.events, plain.lowered)):
        return Decision("infeasible", core=clashing, left_out=left_out)
    generator = np.random.default_rng(0)
    amiss: tuple[Broken, ...] = ()
    formulas: list[Named] = []
    tried, kept, turning = 0, None, False
    for guesses, proof_s in zip(_GUESSES, _PROOF_S, strict=True):
        for _ in range(0 if left_out or question.drive else guesses):
            owed = _OWED[tried % len(_OWED)] if tried < len(_OWED) or kept is not None else "nothing"
            if kept is None or owed != "nothing":
                found, amiss = _witness(_Case(question, owed), generator if tried else None, until)
                if found is not None and owed != "nothing":
                    return Decision("feasible", found)
                kept = kept or found
            tried += 1
            over = time.monotonic() > until
            if kept is not None and (over or tried >= _KEEN):
                return Decision("feasible", kept)
            if over:
                return Decision("undecided", amiss=amiss)
        if kept is not None:
            continue
        if formulas and not turning:  # it takes longer with more moments, so only where it did not without
            turning = plain.more.sure_turns()
            formulas = []
        if not formulas:
            formulas = taken(question.refuter, plain.relaxation())
            formulas += consequences(plain.events.unknowns, formulas)
        answer = question.refuter.ask(plain.events.unknowns, formulas, min(proof_s, until - time.monotonic()))
        if answer.kind == "refuted" and not question.refuter.capabilities.exact:
            return Decision("undecided", left_out=left_out, amiss=amiss, doubted_by=question.refuter.name)
        if answer.kind == "refuted":
            clashing = _core(question, plain.events.unknowns, formulas) if explain else ()
            return Decision("infeasible", core=clashing, left_out=left_out)
        if left_out or question.drive:
            continue
        if answer.kind == "met" and answer.values:
            guess = np.array(answer.values)[:asked]  # a search has moments of its own after these
            found, amiss = _mended(_Case(question), guess, until, None)
            if found is not None:
                return Decision("feasible", found)
    return Decision("undecided", left_out=left_out, amiss=amiss)


def _core(question: Question, unknowns: Sequence[Unknown], formulas: Sequence[Named]) -> tuple[str, ...]:
    """Return what clashes, and which ranges of single numbers it takes for that."""
    refuter = question.refuter
    origins = core(refuter, unknowns, formulas, 1.0)
    clashing = resting_on(formulas, origins)
    if question.drive is None and (posed := _sufficient(question, origins)) is not None:
        named, unknowns, clashing = posed
        laws = [each for each in core(refuter, unknowns, clashing, 1.0) if each not in named]
        origins, clashing = (*named, *laws), resting_on(clashing, (*named, *laws))
    ranges = []
    for kind, words in _RANGES.items():
        wider = [replace(each, high=_WIDER * each.high) if each.kind == kind else each for each in unknowns]
        if refuter.ask(wider, clashing, 0.2).kind == "met":
            ranges.append(words)
    return (*origins, *ranges)


def _sufficient(question: Question, origins: Collection[str]) -> tuple[list[str], list[Unknown], list[Named]] | None:
    """Return constraints that clash by themselves, with what is asked about them alone.

    Formulas are made with what all constraints say of the order of moments, and of who is who's moment: whether those
    that are named clash without the others is asked anew, and where they do not, they are looked for among all.
    """
    until, told = time.monotonic() + _CORE_S, [constraint.id for constraint in question.constraints()]
    named = [name for name in told if name in origins]
    posed = _posed(question, named)
    if posed is None:
        named = told
        for each in sorted(told, key=lambda name: name in origins):  # those that were named are looked at last
            fewer = [other for other in named if other != each]
            if time.monotonic() < until and _posed(question, fewer) is not None:
                named = fewer
        posed = _posed(question, named)
    return None if posed is None else (named, *posed)


def _posed(question: Question, kept: Collection[str]) -> tuple[list[Unknown], list[Named]] | None:
    """Return unknowns and formulas of some of the constraints alone, if these are refuted."""
    program = question.scene.program
    fewer = replace(program, constraints=tuple(c for c in program.constraints if c.id in kept))
    case = _Case(replace(question, scene=replace(question.scene, program=fewer)), plan=False)
    for turning in (False, True):
        if turning and not case.more.sure_turns():
            break
        formulas = taken(question.refuter, case.relaxation())
        formulas += consequences(case.events.unknowns, formulas)
        if question.refuter.ask(case.events.unknowns, formulas, 0.5).kind == "refuted":
            return case.events.unknowns, formulas
    return None


def _witness(
    case: _Case, generator: np.random.Generator | None, until: float
) -> tuple[Witness | None, tuple[Broken, ...]]:
    """Look for a witness from one first guess."""
    return _mended(case, first_guess(case.events, case.formulas(), generator), until, generator)


def _mended(
    case: _Case, guess: Array, until: float, generator: np.random.Generator | None
) -> tuple[Witness | None, tuple[Broken, ...]]:
    """Search from a guess, and mend what is amiss with what is found until nothing is, or nothing helps."""
    amiss: Sequence[Broken] = ()
    for _ in range(_ROUNDS):
        search = case.search()
        guess = np.append(guess, np.zeros(len(case.events.unknowns) - len(guess)))
        point = search.run(guess, generator)
        if point is None:
            return None, tuple(amiss)
        witness = realised(case.events, search, point)
        amiss = broken(case.scene, case.structure, case.limits, case.events.ego, witness)
        if not amiss:
            return witness, ()
        if time.monotonic() > until or not case.more.mend(list(amiss), witness):
            return None, tuple(amiss)
        case.lower()
        times = _times(case.events, witness)
        guess = carried_over(case.events, point, witness.profiles, times)
    return None, tuple(amiss)


def _times(events: Events, witness: Witness) -> dict[int, float]:
    """Return when each moment is in a motion, those included that were added since."""
    times = dict(witness.times_s)
    for instant, time_s in enumerate(events.times):
        if instant in times:
            continue
        constant = time_s.constant
        if constant is not None:
            times[instant] = float(constant)
        elif instant in events.defined:
            values = {
                next(iter(t.terms))[0]: times[k]
                for k, t in enumerate(events.times)
                if k in times and t.constant is None
            }
            times[instant] = max(0.0, events.defined[instant].value(values))
        else:
            times[instant] = _passing(events, witness, instant)
    return times


def _passing(events: Events, witness: Witness, instant: int) -> float:
    """Return when an actor passes the place that a moment was made for; the end of its motion where it never does."""
    actor = next(owner for owner, k in events.states if k == instant)
    number = next(iter(events.state(actor, instant).place.terms))
    for formula, _ in events.rules:
        first = formula.parts[0] if isinstance(formula, Some) and formula.parts else None
        if isinstance(first, Atom) and number in first.left.terms:
            place = -float(first.left.terms.get((), 0)) / float(first.left.terms[number])
            found = witness.profiles[actor].time_at(place)
            return witness.end_s if found is None else min(found, witness.end_s)
    return witness.end_s
