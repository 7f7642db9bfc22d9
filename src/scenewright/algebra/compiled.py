"""Formulas ready for a search: values and slopes of all their comparisons at once, and which of them count at a point.

What enters: formulas over numbered unknowns. What leaves: arrays over their comparisons, in the order of `atoms`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scenewright.algebra.polynomials import All, Atom, Formula, Some, atoms, conjuncts

Array = NDArray[np.float64]


class Compiled:
    """All comparisons of all formulas.

    Attributes
    ----------
    atoms
        The comparisons.
    equal, strict
        Which of them are equalities, and which strict.

    Parameters
    ----------
    size
        The number of unknowns.
    """

    def __init__(self, formulas: Sequence[Formula], size: int) -> None:
        self._formulas = formulas  # kept alive: comparisons are numbered by identity
        self.atoms = [part for formula in formulas for part in atoms(formula)]
        self._numbers = {id(part): number for number, part in enumerate(self.atoms)}
        held = list(conjuncts(formulas))
        self._always = {self._numbers[id(part)] for part in held if isinstance(part, Atom)}
        self._choices = [part for part in held if isinstance(part, Some)]
        owner, factor, left, right = [], [], [], []
        for number, atom in enumerate(self.atoms):
            for key, coefficient in atom.left.terms.items():
                owner.append(number)
                factor.append(float(coefficient))
                left.append(key[0] if key else size)
                right.append(key[1] if len(key) > 1 else size)
        self._owner, self._factor = np.array(owner, dtype=np.intp), np.array(factor)
        self._begins = np.unique(self._owner, return_index=True)  # where the terms of each begin that has any
        self._left, self._right = np.array(left, dtype=np.intp), np.array(right, dtype=np.intp)
        self.equal = np.array([atom.relation == "==" for atom in self.atoms], dtype=bool)
        self.strict = np.array([atom.relation == "<" for atom in self.atoms], dtype=bool)

    def values(self, point: Array) -> Array:
        """Return the left side of every comparison; `point` ends with a one."""
        terms = self._factor * point[self._left] * point[self._right]
        return np.bincount(self._owner, terms, minlength=len(self.atoms)).astype(np.float64, copy=False)

    def gradients(self, point: Array) -> Array:
        """Return all gradients, shape (comparisons, unknowns + 1)."""
        count, width = len(self.atoms), len(point)
        flat = np.bincount(
            self._owner * width + self._left, self._factor * point[self._right], minlength=count * width
        ) + np.bincount(self._owner * width + self._right, self._factor * point[self._left], minlength=count * width)
        return flat.astype(np.float64, copy=False).reshape(count, width)

    def along(self, point: Array, slopes: Array) -> Array:
        """Return how every left side changes with what unknowns depend on, as `slopes` say, shape (unknowns + 1, n)."""
        left, right = ((self._factor * point[k])[:, None] for k in (self._left, self._right))
        found = np.zeros((len(self.atoms), slopes.shape[1]))
        if len(self._owner):
            owners, begins = self._begins
            found[owners] = np.add.reduceat(right * slopes[self._left] + left * slopes[self._right], begins)
        return found

    def chosen(self, errors: Array) -> list[int]:
        """Return the comparisons that are to hold; of alternatives those of the one that is nearest to holding."""
        found = (number for formula in self._choices for number in self._nearest(formula, errors)[1])
        return sorted(self._always.union(found))

    def _nearest(self, formula: Formula, errors: Array) -> tuple[float, list[int]]:
        """Return by how much a formula fails, and the comparisons on which that rests."""
        match formula:
            case Atom():
                number = self._numbers[id(formula)]
                return max(0.0, float(errors[number])), [number]
            case All(parts=parts):
                found = [self._nearest(part, errors) for part in parts]
                return max((error for error, _ in found), default=0.0), [n for _, numbers in found for n in numbers]
            case Some(parts=parts):
                return min(
                    (self._nearest(part, errors) for part in parts), key=lambda each: each[0], default=(np.inf, [])
                )
