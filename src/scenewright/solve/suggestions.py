"""Suggests what would make an infeasible scenario possible: the nearest other value of one number that clashes.

What enters: a scene that is proven infeasible, and the core of the proof. What leaves: suggestions, each tried: with
that value there is a witness.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.program.expressions import Compare, Formula, Number, ParameterRef, Term, exchanged, walk
from scenewright.program.printer import print_expression
from scenewright.program.types import Constraint, Program
from scenewright.roads.grounding import Scene
from scenewright.solve.proofs.decide import Question, shown
from scenewright.solve.proofs.witness import Witness
from scenewright.solve.tolerances import compared_dimension
from scenewright.translate.lines import in_words
from scenewright.units import SI_SYMBOL, Dimension, decimal_fraction, format_fraction

# For one value, and for all, in the seconds of a search, which counts its work: a busy machine proposes the same. Of
# 160 values that do half are seen to with one first guess, and one in thirty takes more than six. Chosen.
_GUESSES, _ALL_S = 12, 3.0
_BISECTIONS = 10
_SUGGESTIONS = 4
_DECIMALS = 2, 3, 1  # of what is easy to read, tried in turn
_FROM_ZERO = ("length", "time")  # a speed or a rate of nothing is another thing than a small one


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A change that makes the scenario possible: another value of one number."""

    what: str
    value: float
    nearest: float
    unit: str

    def __str__(self) -> str:
        return f"{self.what}: {self.nearest:.9g} {self.unit} instead of {self.value:.4g} {self.unit}"


@dataclass(frozen=True, slots=True)
class Lever:
    """One number of a program that could be another: a parameter, or one that is written in a constraint.

    Attributes
    ----------
    value
        In SI units.
    name
        That of the parameter; for a written number one that it can be given.
    constraint, number
        Where a written number stands; None for a parameter.
    """

    what: str
    value: Fraction
    dimension: Dimension
    name: str
    constraint: Constraint | None = None
    number: Number | None = None

    @property
    def unit(self) -> str:
        """The symbol of its SI unit."""
        return SI_SYMBOL[self.dimension]

    def put(self, program: Program, term: Term) -> Program:
        """Return the program with `term` in place of the written number; the same one for a parameter."""
        if self.constraint is None or self.number is None:
            return program
        formula = exchanged(self.constraint.formula, lambda node: node is self.number, term)
        changed = replace(self.constraint, formula=formula)
        constraints = tuple(changed if c.id == changed.id else c for c in program.constraints)
        return replace(program, constraints=constraints)


@dataclass(slots=True)
class _Budget:
    """What is left of the work that proposals may take."""

    left_s: float = _ALL_S

    def witness(self, question: Question) -> Witness | None:
        """Look for a witness, and count it. What has none so soon is not proposed: no proof is needed for that."""
        found, took_s = shown(question, _GUESSES)
        self.left_s -= took_s
        return found


def suggest(question: Question, core: set[str]) -> Iterator[Suggestion]:
    """Yield a few changes of one number, each with the value nearest to the present one that is possible.

    Parameters
    ----------
    core
        Ids of the constraints that clash; only their numbers are tried.
    """
    found, budget = 0, _Budget()
    for lever in levers(question.scene, core):
        if found >= _SUGGESTIONS or budget.left_s <= 0.0:
            return
        nearest = _nearest(question, lever, budget)
        if nearest is not None:
            found += 1
            yield Suggestion(lever.what, float(lever.value), float(nearest), lever.unit)


def levers(scene: Scene, constraints: Container[str]) -> Iterator[Lever]:
    """Yield the numbers of a scene's program that stand in the named constraints, each once."""
    program = scene.program
    seen: set[str] = set()
    for constraint in program.constraints:
        if constraint.id not in constraints:
            continue
        for node, dimension in _numbers(constraint.formula):
            if isinstance(node, ParameterRef) and node.name in scene.parameters and node.name not in seen:
                seen.add(node.name)
                parameter = next(p for p in program.parameters if p.name == node.name)
                yield Lever(node.name, scene.parameters[node.name], parameter.unit.dimension, node.name)
            elif isinstance(node, Number):
                if node.value == 0 and dimension not in _FROM_ZERO:
                    continue
                is_code = program.description is None  # whoever wrote the program looks for its line
                said = print_expression(constraint.formula) if is_code else f'"{in_words(program, constraint)}"'
                what = f"{format_fraction(node.value)} in {said}"
                yield Lever(what, node.value, dimension, f"free_{constraint.id}", constraint, node)


def _numbers(formula: Formula) -> Iterator[tuple[ParameterRef | Number, Dimension]]:
    """Yield numbers and parameters that a formula compares, with the dimension of what they are compared with."""
    for part in walk(formula):
        if isinstance(part, Compare):
            yield from ((n, compared_dimension(part)) for n in walk(part) if isinstance(n, ParameterRef | Number))


def _nearest(question: Question, lever: Lever, budget: _Budget) -> Fraction | None:
    """Return the value nearest to the lever's own with which there is a witness, rounded to a readable number."""
    freed = replace(question, scene=_changed(question.scene, lever, None))

    def does(value: Fraction) -> bool:
        """Whether it can happen with a number in the lever's place."""
        return budget.witness(replace(question, scene=_changed(question.scene, lever, value))) is not None

    def possible(low: Fraction, high: Fraction) -> Fraction | None:
        witness = budget.witness(replace(freed, freed={lever.name: (low, high)}))
        if witness is not None:
            return decimal_fraction(f"{witness.parameters[lever.name]:.6f}")
        # As a number it bounds a law of motion, where that is what it does; as an unknown it cannot.
        furthest = max(low, high, key=lambda each: abs(each - lever.value))
        return furthest if does(furthest) else None

    value, sign = lever.value, -1 if lever.value < 0 else 1
    ends = (sign * 10 * abs(value) + 20 * sign, Fraction(0) if value else Fraction(-20))
    found = [nearest for end in ends if (nearest := _nearest_towards(value, end, possible, budget)) is not None]
    if not found:
        return None
    best = min(found, key=lambda candidate: abs(candidate - value))
    readable = dict.fromkeys(each for digits in _DECIMALS for each in _rounded(best, value, digits) if each != value)
    return next((each for each in readable if budget.left_s > 0.0 and does(each)), best)


def _changed(scene: Scene, lever: Lever, value: Fraction | None) -> Scene:
    """Return the scene in which the lever's number is another, or one that is to be found."""
    if lever.number is not None:
        term = ParameterRef(lever.name) if value is None else Number(value)
        return replace(scene, program=lever.put(scene.program, term))
    others = {name: known for name, known in scene.parameters.items() if name != lever.name}
    return replace(scene, parameters=others if value is None else {**others, lever.name: value})


def _nearest_towards(
    value: Fraction, end: Fraction, possible: Callable[[Fraction, Fraction], Fraction | None], budget: _Budget
) -> Fraction | None:
    """Bisect between `value`, which does not work, and what works on the way to `end`; None where nothing does."""
    far = possible(min(value, end), max(value, end)) if budget.left_s > 0.0 else None
    if far is None:
        return None
    near = value
    for _ in range(_BISECTIONS):
        if budget.left_s < 0.5 * _ALL_S:  # what is found is to be rounded, too
            break
        middle = (near + far) / 2
        better = possible(min(middle, value), max(middle, value))
        if better is None:
            near = middle
        else:
            far = better
    return far


def _rounded(found: Fraction, origin: Fraction, digits: int) -> tuple[Fraction, Fraction]:
    """Return a number with so many decimals: the nearest, and the next one away from the value that did not work."""
    scaled = found * 10**digits
    floor = scaled.numerator // scaled.denominator
    away = floor if found < origin else floor + 1
    return Fraction(round(scaled), 10**digits), Fraction(away, 10**digits)
