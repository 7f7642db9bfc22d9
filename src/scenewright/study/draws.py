"""Draws parameters for descriptions, as a test engineer would vary them: by what a name says, seeded, repeatable.

What enters: parameters of a program. What leaves: values in each parameter's own unit. Nothing is rejected: a draw
that cannot happen is for the solver to prove.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scenewright.program.types import Parameter

# (low, high) in SI by dimension and words of the name; the first whose words all occur counts.
# On a 50 km/h road an ego is some 2 to 6 s away when something begins that it is to react to.
_RANGES: tuple[tuple[str, tuple[str, ...], float, float], ...] = (
    ("length", ("initial", "ego", "stop_line"), 45.0, 90.0),
    ("length", ("initial", "ego"), 90.0, 150.0),
    ("length", ("initial",), 20.0, 35.0),
    ("length", ("end",), 5.5, 8.0),
    ("length", ("ego", "hero"), 12.0, 30.0),
    ("length", ("ego", "stop_line"), 8.0, 30.0),
    ("length", ("ego",), 30.0, 80.0),
    ("length", (), 10.0, 35.0),
    ("time", ("initial",), 9.0, 13.0),
    ("time", ("ego",), 3.5, 6.5),
    ("time", (), 1.0, 3.0),
    ("speed", (), 4.0, 10.0),
    ("acceleration", (), 1.5, 6.0),
)
# An ego starts this much before its trigger, or the draw says nothing about orchestration.
_LEAD = {"length": 15.0, "time": 2.5}


def draw_parameters(parameters: Sequence[Parameter], seed: Sequence[int]) -> dict[str, float]:
    """Return a value for each parameter, in the unit of its name, rounded to two decimals.

    Parameters
    ----------
    seed
        Anything that names the draw, such as ``(seed, description, draw)``.

    Examples
    --------
    >>> draw_parameters([Parameter("ego_tta_s")], (1, 2)) == draw_parameters([Parameter("ego_tta_s")], (1, 2))
    True
    """
    generator = np.random.default_rng(list(seed))
    values: dict[str, float] = {}
    for parameter in parameters:
        low, high = _range_of(parameter)
        values[parameter.name] = float(generator.uniform(low, high))
    for parameter in parameters:
        if "initial" in parameter.name and "ego" in parameter.name:
            values[parameter.name] = max(values[parameter.name], _last_trigger(parameter, parameters, values))
    return {p.name: _within(p, round(values[p.name] / float(p.unit.si_factor), 2)) for p in parameters}


def _range_of(parameter: Parameter) -> tuple[float, float]:
    """Return what to draw from (SI): where the program says so, that, for what it leaves open what the name says."""
    for dimension, words, low, high in _RANGES:
        if dimension == parameter.unit.dimension and all(word in parameter.name for word in words):
            si = parameter.unit.si_factor
            low = low if parameter.low is None else float(parameter.low * si)
            high = high if parameter.high is None else float(parameter.high * si)
            return (low, max(low, high)) if parameter.high is None else (min(low, high), high)
    raise KeyError(parameter.name)


def _within(parameter: Parameter, value: float) -> float:
    """Return a value of a parameter, in its own unit, brought into its range where the program gives one."""
    value = value if parameter.low is None else max(value, float(parameter.low))
    return value if parameter.high is None else min(value, float(parameter.high))


def _last_trigger(start: Parameter, parameters: Sequence[Parameter], values: dict[str, float]) -> float:
    dimension = start.unit.dimension
    own = [
        values[p.name]
        for p in parameters
        if p.name.startswith("ego") and "hero" not in p.name and p.unit.dimension == dimension
    ]
    return max(own, default=0.0) + _LEAD.get(dimension, 0.0)
