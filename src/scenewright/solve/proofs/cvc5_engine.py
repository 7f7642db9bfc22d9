"""cvc5 as a second opinion: exact, slower here than z3.

What enters: named formulas over unknowns. What leaves: an answer without values. It never runs in our own process.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Sequence

from scenewright.algebra.polynomials import Named, Unknown, smtlib
from scenewright.errors import SolverError
from scenewright.solve.proofs.refuters import Answer, Capabilities, Found

_START_S = 1.0  # what a process may take to start, on a busy machine
# Asked in a process of its own, which imports nothing of ours and can be stopped: cvc5 does not always keep its limit.
_ASKS = """
import sys, cvc5
solver = cvc5.Solver(cvc5.TermManager())
parser = cvc5.InputParser(solver)
parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, sys.stdin.read(), "question")
while not (command := parser.nextCommand()).isNull():
    sys.stdout.write(command.invoke(solver, parser.getSymbolManager()))
"""


class Cvc5:
    """cvc5 in a process for each question, stopped where it takes too long."""

    name = "cvc5"
    capabilities = Capabilities(exact=True)

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        """Ask whether all `formulas` can hold at once."""
        lines = [
            f"(set-option :tlimit-per {max(1, int(timeout_s * 1000))})",
            "(set-logic QF_NRA)",
            smtlib(unknowns, formulas),
            "(check-sat)",
        ]
        started = time.perf_counter()
        said = _said("\n".join(lines), timeout_s + _START_S)
        took_s = time.perf_counter() - started
        if said is None:
            return Answer("timeout", took_s=took_s)
        kinds: dict[str, Found] = {"unsat": "refuted", "sat": "met"}
        return Answer(kinds.get(said.strip(), "unknown"), took_s=took_s)


def _said(text: str, limit_s: float) -> str | None:
    """Return what cvc5 prints; None where it had to be stopped."""
    command = [sys.executable, "-P", "-c", _ASKS]
    try:
        done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=limit_s, check=False)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode:
        raise SolverError("cvc5 failed", found=(done.stderr.strip().splitlines() or ["no word"])[-1])
    return done.stdout
