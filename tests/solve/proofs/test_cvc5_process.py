"""cvc5 in a process of its own."""

from __future__ import annotations

import pytest

from scenewright.solve.proofs.cvc5_process import carry_out


def test_commands_are_answered_in_order() -> None:
    pytest.importorskip("cvc5", reason="the extra cvc5 is not installed")
    lines = [
        "(set-logic QF_NRA)",
        "(set-option :produce-unsat-cores true)",
        "(declare-const x Real)",
        "(assert (! (< (* x x) 0.0) :named n0))",
        "(assert (! (< x 0.0) :named n1))",
        "(check-sat)",
        "(get-unsat-core)",
    ]
    answer, *core = carry_out("\n".join(lines)).split()
    assert answer == "unsat"
    assert "n0" in core
