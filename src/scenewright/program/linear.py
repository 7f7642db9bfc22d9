"""Terms of a program as sums: how often each quantity counts, and a constant.

What enters: a term. What leaves: a `Linear`, so that however a comparison was written it is read in one form.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

from scenewright.errors import ProgramError
from scenewright.program import expressions as ex
from scenewright.program.printer import print_expression

Atom = ex.State | ex.Derived | ex.Elapsed | ex.Landmark | ex.ParameterRef


@dataclass(frozen=True, slots=True)
class Linear:
    """A sum of quantities, each times a number other than zero, and a constant in SI units."""

    atoms: Mapping[Atom, Fraction] = field(default_factory=dict)
    constant: Fraction = Fraction(0)

    def scaled(self, factor: Fraction) -> Linear:
        """Return so many times this sum."""
        return Linear({atom: own * factor for atom, own in self.atoms.items()}, self.constant * factor)

    def plus(self, other: Linear) -> Linear:
        """Return the sum of both, without what cancels out."""
        atoms = dict(self.atoms)
        for atom, factor in other.atoms.items():
            atoms[atom] = atoms.get(atom, Fraction(0)) + factor
        return Linear({atom: own for atom, own in atoms.items() if own}, self.constant + other.constant)

    def minus(self, other: Linear) -> Linear:
        """Return the difference."""
        return self.plus(other.scaled(Fraction(-1)))

    def of(self, *kinds: type) -> dict[Atom, Fraction]:
        """Return the quantities of some kinds, with how often each counts."""
        return {atom: factor for atom, factor in self.atoms.items() if isinstance(atom, kinds)}


def linear(term: ex.Term) -> Linear:
    """Return `term` as a sum; raises `ProgramError` for products and quotients of quantities."""
    match term:
        case ex.Number(value=value):
            return Linear(constant=value)
        case ex.Negate(operand=operand):
            return linear(operand).scaled(Fraction(-1))
        case ex.Arithmetic(operator="+", left=left, right=right):
            return linear(left).plus(linear(right))
        case ex.Arithmetic(operator="-", left=left, right=right):
            return linear(left).minus(linear(right))
        case ex.Arithmetic(operator=operator, left=left, right=right):
            one, other = linear(left), linear(right)
            if operator == "*" and not one.atoms:
                one, other = other, one
            if other.atoms or (operator == "/" and not other.constant):
                raise ProgramError("a product or a quotient of two quantities is no sum", found=print_expression(term))
            return one.scaled(other.constant if operator == "*" else 1 / other.constant)
        case _:
            return Linear({term: Fraction(1)})
