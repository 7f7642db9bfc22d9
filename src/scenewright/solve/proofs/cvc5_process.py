"""Asks cvc5 in a process of its own, which can be stopped: its time limit is not always kept.

What enters: SMT-LIB text on the standard input. What leaves: what cvc5 prints, on the standard output. It is run as a
file and imports nothing of ours, so that it starts fast.
"""

from __future__ import annotations

import sys


def carry_out(text: str) -> str:
    """Return what cvc5 prints for SMT-LIB commands."""
    import cvc5

    solver = cvc5.Solver(cvc5.TermManager())
    parser = cvc5.InputParser(solver)
    parser.setStringInput(cvc5.InputLanguage.SMT_LIB_2_6, text, "question")
    said = []
    while not (command := parser.nextCommand()).isNull():
        said.append(command.invoke(solver, parser.getSymbolManager()))
    return "".join(said)


if __name__ == "__main__":
    sys.stdout.write(carry_out(sys.stdin.read()))
