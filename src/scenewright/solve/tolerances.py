"""The tight tolerances of the contract as exact numbers, and which of them applies to a comparison.

What enters: an expression. What leaves: the dimension that it compares.
"""

from __future__ import annotations

from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.units import Dimension

# One unit of tolerance by what is compared (m, s, m/s, m/s^2).
TIGHT: dict[Dimension, Fraction] = {
    "length": Fraction(1, 2),
    "time": Fraction(1, 10),
    "speed": Fraction(1, 4),
    "acceleration": Fraction(1, 4),
}
_OF_ORDER: tuple[Dimension, ...] = ("length", "speed", "acceleration")
_OF_DERIVED: dict[str, Dimension] = {"gap": "length", "tta": "time", "ttc": "time", "headway": "time"}


def compared_dimension(formula: ex.Node) -> Dimension:
    """Return the dimension of what a comparison compares, told from the first state or derived quantity in it."""
    for node in ex.walk(formula):
        if isinstance(node, ex.State):
            return _OF_ORDER[node.order]
        if isinstance(node, ex.Derived):
            return _OF_DERIVED[node.kind]
    return "time"
