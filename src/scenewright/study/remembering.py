"""A solver that remembers: the same question asked by another method, or of another ego, is answered from memory.

What enters: problems. What leaves: what the solver beneath said to the same text before. That time ran out is no
answer, and is not remembered.
"""

from __future__ import annotations

from collections import OrderedDict
from hashlib import sha256

from scenewright.solve.problem import Backend, Problem, Result, Unknown

_REMEMBERED = 2000


class Remembering:
    """Another backend, with a memory.

    Every method begins with the same check and the same first plan, so that an experiment asks most long questions
    several times. Sound because backends are deterministic: the same problem gives the same answer. What is asked while
    the ego drives hardly ever comes twice.

    Parameters
    ----------
    beneath
        Who answers what was not asked before.
    """

    def __init__(self, beneath: Backend) -> None:
        self.name = beneath.name
        self._beneath = beneath
        self._answers: OrderedDict[bytes, Result] = OrderedDict()
        self.recalled = 0

    def solve(self, problem: Problem, timeout_s: float, want_core: bool = False, effort: int | None = None) -> Result:
        """Answer as `beneath` does."""
        key = _key(problem, want_core)
        if key in self._answers:
            self.recalled += 1
            self._answers.move_to_end(key)
            return self._answers[key]
        answer = self._beneath.solve(problem, timeout_s, want_core, effort)
        if not isinstance(answer, Unknown):
            self._answers[key] = answer
            if len(self._answers) > _REMEMBERED:
                self._answers.popitem(last=False)
        return answer


def _key(problem: Problem, want_core: bool) -> bytes:
    """Return a sum of the problem's text; where a core is wanted, of where its assertions come from too."""
    origins = "\n".join(assertion.origin for assertion in problem.assertions) if want_core else ""
    return sha256(f"{problem.smtlib(named=want_core)}\n;{origins}".encode()).digest()
