"""Formulas ready for a search: values and slopes of all their comparisons at once, and which of them count at a point.

What enters: formulas over numbered unknowns. What leaves: arrays over their comparisons, in the order of `atoms`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from scenewright.solve.proofs.polynomials import All, Atom, Formula, Some

Array = NDArray[np.float64]


@dataclass(slots=True)
class _Tree:
    """A formula with the numbers of its comparisons at its leaves."""

    kind: str
    atom: int = -1
    parts: list[_Tree] = field(default_factory=list)


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
    ruled_out
        Tells of an alternative whether it is never to be taken, while there is another.
    """

    def __init__(
        self, formulas: Sequence[Formula], size: int, ruled_out: Callable[[Formula], bool] = lambda _: False
    ) -> None:
        self.atoms: list[Atom] = []
        self._ruled_out = ruled_out
        self._trees = [self._tree(formula) for formula in formulas]
        owner, factor, left, right = [], [], [], []
        for number, atom in enumerate(self.atoms):
            for key, coefficient in atom.left.terms.items():
                owner.append(number)
                factor.append(float(coefficient))
                left.append(key[0] if key else size)
                right.append(key[1] if len(key) > 1 else size)
        self._owner, self._factor = np.array(owner, dtype=np.intp), np.array(factor)
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

    def chosen(self, errors: Array) -> list[int]:
        """Return the comparisons that are to hold; of alternatives those of the one that is nearest to holding."""
        found: list[int] = []
        for tree in self._trees:
            _choose(tree, errors, found)
        return list(dict.fromkeys(found))

    def _tree(self, formula: Formula) -> _Tree:
        match formula:
            case Atom():
                self.atoms.append(formula)
                return _Tree("atom", len(self.atoms) - 1)
            case All(parts=parts):
                return _Tree("all", parts=[self._tree(part) for part in parts])
            case Some(parts=parts):
                possible = [part for part in parts if not self._ruled_out(part)]
                return _Tree("some", parts=[self._tree(part) for part in possible or parts])


def _choose(tree: _Tree, errors: Array, chosen: list[int]) -> None:
    if tree.kind == "atom":
        chosen.append(tree.atom)
    elif tree.kind == "all":
        for part in tree.parts:
            _choose(part, errors, chosen)
    elif tree.parts:
        _choose(min(tree.parts, key=lambda part: _error(part, errors)), errors, chosen)


def _error(tree: _Tree, errors: Array) -> float:
    if tree.kind == "atom":
        return max(0.0, float(errors[tree.atom]))
    if tree.kind == "all":
        return max((_error(part, errors) for part in tree.parts), default=0.0)
    return min((_error(part, errors) for part in tree.parts), default=np.inf)
