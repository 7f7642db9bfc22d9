"""SCIP as a cross-check: global and quick with many products, but numeric; what it refutes is no proof.

What enters: named formulas over unknowns with ranges. What leaves: an answer, to within its tolerance. A disjunction is
a sum of binaries, a comparison under one is let off by as much as its polynomial can fail by within the ranges.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from typing import Any

import pyscipopt

from scenewright.algebra.polynomials import All, Atom, Formula, Named, Polynomial, Some, Unknown
from scenewright.solve.proofs.refuters import Answer, Capabilities


class Scip:
    """SCIP, afresh for each question."""

    name = "scip"
    capabilities = Capabilities(exact=False)

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        """Ask whether all `formulas` can hold at once; a strict comparison is taken for one that is not."""
        posed = _Posed(unknowns)
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
        terms, most = list[Any](), 0.0  # the most that it can be, at corners of the ranges
        for key, value in left.terms.items():
            terms.append(float(value) / scale * math.prod((self.variables[number] for number in key), start=1))
            ends = product(*((self.unknowns[number].low, self.unknowns[number].high) for number in key))
            most += float(max(value * math.prod(corner) for corner in ends))
        free = 0 if chosen is None else max(0.0, most / scale) * (1 - chosen)
        self.model.addCons(pyscipopt.quicksum(terms) <= free)
