"""Chooses the parameters that the user left open: everyday values first, and where those clash what the solver finds.

What enters: a scene with open parameters. What leaves: the same scene with every parameter set. A model of the solver
sits in a corner of what is possible (3 m, 0.05 s); a test engineer who gave no number expects an unremarkable one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from scenewright.program.types import Parameter
from scenewright.roads.grounding import Scene
from scenewright.solve.feasibility import Feasibility, Question, check_feasibility

# SI values by dimension, for words that occur in the name; the empty word is the default.
_EVERYDAY: dict[str, tuple[tuple[str, Fraction], ...]] = {
    "length": (("initial", Fraction(50)), ("end", Fraction(6)), ("", Fraction(18))),
    "time": (("initial", Fraction(8)), ("", Fraction(3))),
    "speed": (("", Fraction(8)),),
    "acceleration": (("", Fraction(3)),),
}
_DIGITS = (0, 1, 2, 3, 6)


def settle(question: Question, explain: bool = True) -> tuple[Scene, Feasibility]:
    """Return a question's scene with a value for every parameter, and whether it can happen; with `explain`, why not.

    Everyday values are taken where the scenario is possible with them; else those of a motion found with all of them
    free, rounded as far as it stays possible. Where there is none the answer is that for all values.
    """
    if not question.scene.open_parameters():
        return question.scene, check_feasibility(question, explain)
    settled = everyday(question.scene)
    answer = check_feasibility(replace(question, scene=settled), explain=False)
    if answer.answer == "feasible":
        return settled, answer
    found = check_feasibility(question, explain)
    if found.answer != "feasible":
        return settled, found
    for digits in _DIGITS:
        settled = rounded(question.scene, found.parameters, digits)
        answer = check_feasibility(replace(question, scene=settled), explain=False)
        if answer.answer == "feasible":
            return settled, answer
    return replace(settled, parameters={**settled.parameters, **found.parameters}), found


def everyday(scene: Scene) -> Scene:
    """Return a scene with everyday values for the parameters that are open."""
    values = {each.name: everyday_value(each) for each in scene.open_parameters()}
    return replace(scene, parameters={**scene.parameters, **values})


def rounded(scene: Scene, values: Mapping[str, Fraction] | Mapping[str, float], digits: int) -> Scene:
    """Return a scene with values (SI) for the parameters that are open, with so many decimals in their own units."""
    found = dict(scene.parameters)
    for each in scene.open_parameters():
        (low, high), factor = each.bounds(), each.unit.si_factor
        found[each.name] = min(max(round(Fraction(values[each.name]) / factor, digits), low), high) * factor
    return replace(scene, parameters=found)


def everyday_value(parameter: Parameter) -> Fraction:
    """Return an unremarkable value (SI) for a parameter, within its range."""
    low, high = (bound * parameter.unit.si_factor for bound in parameter.bounds())
    for word, value in _EVERYDAY[parameter.unit.dimension]:
        if word in parameter.name:
            return min(max(value, low), high)
    return (low + high) / 2
