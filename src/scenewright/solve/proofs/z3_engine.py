"""z3: exact, and always there.

What enters: named formulas over unknowns. What leaves: an answer, with values where there are some.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from scenewright.algebra.polynomials import Named, Unknown, smtlib
from scenewright.solve.proofs.refuters import Answer, Capabilities

if TYPE_CHECKING:
    import z3

_STUCK = 10  # times as long by the clock as a question may take
_STEPS = ("simplify", "solve-eqs", "simplify", "propagate-ineqs", "qfnra-nlsat")


class Z3:
    """z3, afresh for each question: what it keeps between two makes the second slow.

    A question is given up by z3's own count of its work, `work_per_s` (measured, in 898 questions: 2 to 4 million): so
    answers are the same however busy a machine is. Only one that is stuck in a single step is given up by the clock.
    """

    name = "z3"
    capabilities = Capabilities(exact=True)

    def __init__(self, work_per_s: int = 3_000_000) -> None:
        self._work_per_s = work_per_s

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        """Ask whether all `formulas` can hold at once."""
        import z3  # slow to import, and a witness needs none

        z3.set_param("ctrl_c", False)  # its own handler would take Ctrl-C for an answer
        context = z3.Context()
        solver = z3.Then(*_STEPS, ctx=context).solver()
        solver.set("timeout", max(1, int(_STUCK * timeout_s * 1000)))
        solver.set("rlimit", max(1, int(timeout_s * self._work_per_s)))
        solver.from_string(smtlib(unknowns, formulas))
        answer = solver.check()
        took_s = sum(count for what, count in solver.statistics() if what == "rlimit count") / self._work_per_s
        if answer == z3.unsat:
            return Answer("refuted", took_s=took_s)
        if answer == z3.sat:
            return Answer("met", values=_values(solver.model(), len(unknowns)), took_s=took_s)
        return Answer("timeout" if solver.reason_unknown() in ("timeout", "canceled") else "unknown", took_s=took_s)


def _values(model: z3.ModelRef, count: int) -> tuple[float, ...]:
    import z3

    found = [0.0] * count
    for declaration in model.decls():
        if declaration.arity():  # z3 tells also how it divides by zero
            continue
        value = model[declaration]
        if z3.is_algebraic_value(value):
            value = value.approx(12)
        found[int(declaration.name()[1:])] = float(value.as_fraction())
    return tuple(found)
