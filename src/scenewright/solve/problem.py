"""What a solver is asked, and what it may answer.

What enters: named conditions over real unknowns. What leaves: SMT-LIB text for any solver, and results as data:
satisfiable with a model, unsatisfiable with a core, unknown, out of time. A result that claims a model cannot be
built without one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Protocol

from scenewright.motion.algebra import Condition, Symbol, smt


@dataclass(frozen=True, slots=True)
class Assertion:
    """One condition and where it comes from: a constraint's id, or in words a limit of the world."""

    condition: Condition
    origin: str


@dataclass(slots=True)
class Problem:
    """Unknowns and assertions, in order. Built once, solved once."""

    unknowns: list[str] = field(default_factory=list)
    assertions: list[Assertion] = field(default_factory=list)

    def unknown(self, name: str) -> Symbol:
        """Add a real unknown and return it."""
        self.unknowns.append(name)
        return Symbol(name)

    def require(self, condition: Condition, origin: str) -> None:
        """Assert `condition`; what holds anyway is left out, what is false by itself stays, to be named in the core."""
        if condition is not True:
            self.assertions.append(Assertion(condition, origin))

    def bound(self, unknown: Symbol, low: Fraction | int | None, high: Fraction | int | None, origin: str) -> None:
        """Assert ``low <= unknown <= high``."""
        if low is not None and high is not None:
            self.assertions.append(Assertion(f"(<= {smt(low)} {unknown.text} {smt(high)})", origin))
        elif low is not None:
            self.assertions.append(Assertion(f"(<= {smt(low)} {unknown.text})", origin))
        elif high is not None:
            self.assertions.append(Assertion(f"(<= {unknown.text} {smt(high)})", origin))

    def smtlib(self, named: bool) -> str:
        """Return the problem as SMT-LIB 2 text; with `named`, assertion i is called ``n<i>`` so that cores can tell."""
        lines = ["(set-option :produce-unsat-cores true)"] if named else []
        lines += [f"(declare-const {name} Real)" for name in self.unknowns]
        for index, assertion in enumerate(self.assertions):
            condition = assertion.condition
            text = condition if isinstance(condition, str) else str(condition).lower()
            lines.append(f"(assert (! {text} :named n{index}))" if named else f"(assert {text})")
        return "\n".join(lines)

    def without(self, origins: set[str]) -> Problem:
        """Return the problem less every assertion that comes from `origins`."""
        return Problem(list(self.unknowns), [a for a in self.assertions if a.origin not in origins])


@dataclass(frozen=True, slots=True)
class Satisfiable:
    """A model: a value for every unknown."""

    model: Mapping[str, Fraction]

    def __post_init__(self) -> None:
        if self.model is None:
            raise ValueError("a satisfiable result needs a model")


@dataclass(frozen=True, slots=True)
class Unsatisfiable:
    """A proof that nothing meets all assertions; `core` holds the origins of some that already clash."""

    core: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Unknown:
    """No answer: `reason` is the solver's own, ``timeout`` where time ran out."""

    reason: str


Result = Satisfiable | Unsatisfiable | Unknown


class Backend(Protocol):
    """A solver. It takes the problem as it is and answers within the time given."""

    name: str

    def solve(self, problem: Problem, timeout_s: float, want_core: bool = False, effort: int | None = None) -> Result:
        """Solve `problem`; a core is worked out only where it is wanted.

        Parameters
        ----------
        effort
            The most steps that it may take, in the solver's own measure; unlike a time it gives the same answer on a
            busy machine.
        """
        ...
