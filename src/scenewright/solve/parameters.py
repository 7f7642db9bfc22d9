"""Chooses the parameters that the user left open: everyday values first, and where those clash what the solver finds.

What enters: a scene with open parameters. What leaves: the same scene with every parameter set. A model of the solver
sits in a corner of what is possible (3 m, 0.05 s); a test engineer who gave no number expects an unremarkable one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from scenewright.program.structure import Structure
from scenewright.program.types import Parameter
from scenewright.roads.grounding import Scene
from scenewright.solve.feasibility import EgoBounds, check_feasibility
from scenewright.solve.limits import Limits
from scenewright.solve.problem import Backend

# SI values by dimension, for words that occur in the name; the empty word is the default.
_EVERYDAY: dict[str, tuple[tuple[str, Fraction], ...]] = {
    "length": (("initial", Fraction(50)), ("end", Fraction(6)), ("", Fraction(18))),
    "time": (("initial", Fraction(8)), ("", Fraction(3))),
    "speed": (("", Fraction(8)),),
    "acceleration": (("", Fraction(3)),),
}


def choose_open_parameters(
    scene: Scene, structure: Structure, limits: Mapping[int, Limits], backend: Backend, ego: EgoBounds | None = None
) -> Scene:
    """Return `scene` with a value for every parameter.

    Everyday values are taken where the scenario is possible with them; else those of a solution with all of them free;
    where there is none, the everyday ones (and the proof that it is infeasible will say so).
    """
    open_parameters = scene.open_parameters()
    if not open_parameters:
        return scene
    everyday = replace(scene, parameters={**scene.parameters, **{p.name: everyday_value(p) for p in open_parameters}})
    if check_feasibility(everyday, structure, limits, backend, ego, explain=False).answer != "infeasible":
        return everyday
    found = check_feasibility(scene, structure, limits, backend, ego, explain=False)
    if found.answer != "feasible":
        return everyday
    return replace(scene, parameters={**scene.parameters, **found.parameters})


def everyday_value(parameter: Parameter) -> Fraction:
    """Return an unremarkable value (SI) for a parameter, within its range."""
    low, high = (bound * parameter.unit.si_factor for bound in parameter.bounds())
    for word, value in _EVERYDAY[parameter.unit.dimension]:
        if word in parameter.name:
            return min(max(value, low), high)
    return (low + high) / 2
