"""SCIP as a cross-check: global and quick with many products, but numeric; what it refutes is no proof.

What enters: named formulas over unknowns with ranges. What leaves: that it finds nothing that meets them all, to within
its tolerance; values; or that neither was found. A disjunction is a sum of binaries, a comparison under one is let off
by as much as its polynomial can fail by within the ranges.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import pyscipopt

from scenewright.algebra.polynomials import All, Atom, Formula, Monomial, Named, Polynomial, Some, Unknown
from scenewright.solve.proofs.order import tightened
from scenewright.solve.proofs.refuters import Answer, Capabilities


class Scip:
    """SCIP, afresh for each question."""

    name = "scip"
    capabilities = Capabilities(exact=False)

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        """Ask whether all `formulas` can hold at once; a strict comparison is taken for one that is not."""
        ranges = tightened(unknowns, (each.formula for each in formulas))
        if any(each.low > each.high for each in ranges):
            return Answer("refuted")
        posed = _Posed(ranges)
        for each in formulas:
            posed.require(each.formula)
        posed.model.setParam("limits/time", max(0.001, timeout_s))
        posed.model.optimize()
        status = posed.model.getStatus()
        took_s = posed.model.getSolvingTime()
        if posed.model.getNSols():
            values = tuple(float(posed.model.getVal(each)) for each in posed.variables)
            return Answer("met", values=values, took_s=took_s)
        if status == "infeasible":
            return Answer("refuted", took_s=took_s)
        return Answer("timeout" if status == "timelimit" else "unknown", took_s=took_s)


class _Posed:
    """The problem as SCIP takes it."""

    def __init__(self, unknowns: Sequence[Unknown]) -> None:
        self.model = pyscipopt.Model()
        self.model.hideOutput()
        self.unknowns = unknowns
        self.variables = [
            self.model.addVar(f"u{number}", lb=float(each.low), ub=float(each.high))
            for number, each in enumerate(unknowns)
        ]

    def require(self, formula: Formula, chosen: Any = None) -> None:
        """Require `formula`; where a binary is given, only if it is one."""
        match formula:
            case Atom(left=left, relation=relation):
                self._compare(left, chosen)
                if relation == "==":
                    self._compare(-left, chosen)
            case All(parts=parts):
                for part in parts:
                    self.require(part, chosen)
            case Some(parts=parts):
                binaries = [self.model.addVar(vtype="B") for _ in parts]
                self.model.addCons(pyscipopt.quicksum(binaries) >= (1 if chosen is None else chosen))
                for part, binary in zip(parts, binaries, strict=True):
                    self.require(part, binary)

    def _compare(self, left: Polynomial, chosen: Any) -> None:
        """Require ``left <= 0``, unless `chosen` is zero; scaled, so that a tolerance means the same everywhere."""
        scale = max(abs(float(value)) for value in left.terms.values())
        terms = [float(value) / scale * self._product(key) for key, value in left.terms.items()]
        most = sum(max(value * math.prod(ends) for ends in self._ends(key)) for key, value in left.terms.items())
        free = 0 if chosen is None else max(0.0, float(most) / scale) * (1 - chosen)
        self.model.addCons(pyscipopt.quicksum(terms) <= free)

    def _product(self, key: Monomial) -> Any:
        return math.prod((self.variables[number] for number in key), start=1)

    def _ends(self, key: Monomial) -> Iterator[tuple[Fraction, ...]]:
        """Yield what the unknowns of a product are at the corners of their ranges."""
        return product(*((self.unknowns[number].low, self.unknowns[number].high) for number in key))
