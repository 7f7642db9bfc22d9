"""Solvers that refute, or find values: what each can do, and how it is found by name.

What enters: a name. What leaves: a solver that answers whether formulas can hold at once, imported then and not before.
What clashes is found by asking about fewer: for a core of its own z3 needs another, slower way, which often gets stuck.
A package offers one by an entry point of the group ``scenewright.solvers``, a class without arguments.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from scenewright.algebra.polynomials import Named, Unknown, needed
from scenewright.errors import SolverError
from scenewright.plugins import Kind
from scenewright.solve.proofs.order import tightened

GROUP = "scenewright.solvers"
_OURS = {
    "z3": "scenewright.solve.proofs.z3_engine:Z3",
    "cvc5": "scenewright.solve.proofs.cvc5_engine:Cvc5 [cvc5]",
    "scip": "scenewright.solve.proofs.scip_engine:Scip [scip]",
}
_CORE_S, _SHRINK_S = 1.0, 0.15  # for looking for what clashes in all, and for each question whether fewer do

Found = Literal["refuted", "met", "timeout", "unknown"]


@dataclass(frozen=True, slots=True)
class Answer:
    """What a solver says: ``refuted`` (nothing meets all formulas), ``met``, ``timeout``, ``unknown`` where it gave up.

    Where met `values` are those of all unknowns, as near as floats come, if it tells; `took_s` is by its own count of
    its work if it has one.
    """

    kind: Found
    values: tuple[float, ...] = ()
    took_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What can be expected of a solver: ``refuted`` is a proof only where it is `exact`, as rationals are."""

    exact: bool

    def words(self) -> str:
        """Say it in a line."""
        return "exact: what it refutes is proven" if self.exact else "numeric: a cross-check, no proof"


class Refuter(Protocol):
    """A solver of named formulas, of second degree at most, over unknowns with ranges."""

    name: str
    capabilities: Capabilities

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        """Ask whether all `formulas` can hold at once; timeouts are answers, never exceptions.

        What takes longer than `timeout_s` is given up: by a count of work, not by the clock, if the solver has one.
        """
        ...


SOLVERS: Kind[Refuter] = Kind(
    GROUP, _OURS, "solver", "refutes", SolverError, Capabilities, {"cvc5": "cvc5", "scip": "pyscipopt"}
)


def answer_of(refuter: Refuter, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
    """Return what a solver answers, asked with the ranges that are left; raises `SolverError` where it fails."""
    ranges = tightened(unknowns, (each.formula for each in formulas))
    if any(each.low > each.high for each in ranges):
        return Answer("refuted")
    with SOLVERS.blamed(refuter):
        if isinstance(answer := refuter.ask(ranges, formulas, timeout_s), Answer):
            return answer
        raise TypeError(f"it answered {answer!r}")


def clashing(
    refuter: Refuter, names: Sequence[str], posed: Callable[[list[str]], tuple[Sequence[Unknown], Sequence[Named]]]
) -> list[str]:
    """Return which of `names`, which clash as they are `posed`, are needed for that, as far as little work tells."""
    left_s = _CORE_S

    def clash(fewer: list[str]) -> bool:
        nonlocal left_s
        if left_s <= 0.0:
            return False
        answer = answer_of(refuter, *posed(fewer), _SHRINK_S)
        left_s -= answer.took_s
        return answer.kind == "refuted"

    return needed(names, clash)
