"""Solves problems with z3, through SMT-LIB text.

What enters: a `Problem`. What leaves: a `Result`. z3 parses text faster than Python builds its expressions one by one;
a fresh solver each time stays on the fast path (push and pop leave it). Equations are used up and bounds carried over
before the algebra begins: that is most of what a motion's problem consists of. Algebraic numbers in models are rounded
to rationals.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import z3

from scenewright.solve.problem import Problem, Result, Satisfiable, Unknown, Unsatisfiable

z3.set_param("ctrl_c", False)  # its own handler would take Ctrl-C for an answer

_ALGEBRAIC_DIGITS = 12
_STEPS = ("simplify", "solve-eqs", "simplify", "propagate-ineqs", "qfnra-nlsat")


class Z3Backend:
    """The z3 solver. Deterministic: the same problem gives the same model."""

    name = "z3"

    def solve(self, problem: Problem, timeout_s: float, want_core: bool = False, effort: int | None = None) -> Result:
        """Solve `problem` within `timeout_s`; unsatisfiable results carry a minimal core where `want_core` is set."""
        # What was asked before stays behind in a context and sways the models of what comes next: a fresh one, for a
        # millisecond, keeps an answer the same whatever else the process has solved.
        context = z3.Context()
        solver = z3.Solver(ctx=context) if want_core else z3.Then(*_STEPS, ctx=context).solver()
        solver.set("timeout", max(1, int(timeout_s * 1000)))
        if effort is not None:
            solver.set("rlimit", effort)
        solver.from_string(problem.smtlib(named=want_core))
        answer = solver.check()
        if answer == z3.sat:
            return Satisfiable(_model(solver.model()))
        if answer == z3.unsat:
            return Unsatisfiable(self._core(problem, solver, timeout_s) if want_core else ())
        reason = solver.reason_unknown()
        return Unknown("timeout" if reason in ("timeout", "canceled", "max. resource limit exceeded") else reason)

    def _core(self, problem: Problem, solver: z3.Solver, timeout_s: float) -> tuple[str, ...]:
        """Return the origins of a core in which every one is needed: z3's own cores are not minimal."""
        indices = {int(str(name)[1:]) for name in solver.unsat_core()}
        origins = list(dict.fromkeys(problem.assertions[index].origin for index in sorted(indices)))
        kept = list(origins)
        for origin in origins:
            trial = [other for other in kept if other != origin]
            part = Problem(problem.unknowns, [a for a in problem.assertions if a.origin in trial])
            if isinstance(self.solve(part, timeout_s), Unsatisfiable):
                kept = trial
        return tuple(kept)


def _model(model: Any) -> dict[str, Fraction]:
    values: dict[str, Fraction] = {}
    for declaration in model.decls():
        value = model[declaration]
        if z3.is_rational_value(value):
            values[declaration.name()] = value.as_fraction()
        elif z3.is_algebraic_value(value):
            values[declaration.name()] = value.approx(_ALGEBRAIC_DIGITS).as_fraction()
    return values
