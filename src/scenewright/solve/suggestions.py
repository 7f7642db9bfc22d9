"""Suggests what would make an infeasible scenario possible: the nearest other value of one number that clashes.

What enters: a scene that is proven infeasible, and the core of the proof. What leaves: suggestions, each tried.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import floor

from scenewright.program.expressions import Arithmetic, Compare, Number, ParameterRef, Term, exchanged, walk
from scenewright.program.printer import print_expression
from scenewright.program.types import Program
from scenewright.roads.grounding import Scene
from scenewright.solve.proofs.decide import Question, decide, shown
from scenewright.solve.proofs.forms import compared_dimension
from scenewright.solve.proofs.witness import Witness
from scenewright.translate.decompile import in_a_unit
from scenewright.translate.lines import in_words
from scenewright.units import SI_SYMBOL, UNITS, Dimension, decimal_fraction, format_fraction

# For one value, and for all, in the seconds of a search, which counts its work: a busy machine proposes the same. Of
# 160 values that do half are seen to with one first guess, and one in thirty takes more than six. Chosen.
_GUESSES, _FEW, _ALL_S = 12, 2, 3.0
_NEARER_S, _ROUNDED_S = 1.2, 0.3  # of that for bisecting what is found, and for rounding it. Chosen
_BISECTIONS, _NEAR = 10, Fraction(1, 30)  # and how near it is to be, of the way to it. Chosen
_SUGGESTIONS = 4
_DECIMALS = 2, 3, 1  # of what is easy to read, tried in turn
_FROM_ZERO = ("length", "time")  # a speed or a rate of nothing is another thing than a small one


_Range = tuple[Fraction, Fraction]


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A change that makes the scenario possible: another value of one number."""

    what: str
    value: float
    nearest: float
    unit: str

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.what}: {self.nearest:.9g}{unit} instead of {self.value:.4g}{unit}"


@dataclass(frozen=True, slots=True)
class Lever:
    """One number of a program that could be another: a parameter, or one that is written in a constraint.

    `value` is in SI units, `unit` the one of whoever gave it, with what that is worth; `name` is the parameter's or one
    that a written number can be given; a `number` that is written is that node of the program.
    """

    what: str
    value: Fraction
    dimension: Dimension | None
    unit: str
    si_factor: Fraction
    name: str
    number: Number | None = None

    def put(self, program: Program, term: Term) -> Program:
        """Return the program with `term` in place of the written number; the same one for a parameter."""
        formulas = (exchanged(each.formula, lambda node: node is self.number, term) for each in program.constraints)
        changed = (replace(each, formula=new) for each, new in zip(program.constraints, formulas, strict=True))
        return program if self.number is None else replace(program, constraints=tuple(changed))


def suggest(question: Question, core: set[str]) -> Iterator[Suggestion]:
    """Yield a few changes of one number of the constraints in a `core`, each to the nearest value that is possible."""
    trials, found = _Trials(question), list[tuple[Lever, list[Fraction]]]()
    for lever in levers(question.scene, core):
        if len(found) >= _SUGGESTIONS or trials.left_s <= (_NEARER_S if found else 0.0):
            break
        if far_off := trials.far_off(lever):
            found.append((lever, far_off))
    for number, (lever, far_off) in enumerate(found):
        until_s = max(_ROUNDED_S, trials.left_s * (1.0 - 1.0 / (len(found) - number)))
        nearest = trials.readable(lever, trials.nearest(lever, far_off, until_s))
        if nearest is not None:
            value, nearest = lever.value / lever.si_factor, nearest / lever.si_factor
            yield Suggestion(lever.what, float(value), float(nearest), lever.unit)


def levers(scene: Scene, constraints: Container[str]) -> Iterator[Lever]:
    """Yield the numbers of a scene's program that stand in the named constraints, each once."""
    program = scene.program
    seen: set[str] = set()
    for constraint in program.constraints:
        if constraint.id not in constraints:
            continue
        multiplies = any(isinstance(node, Arithmetic) and node.operator in "*/" for node in walk(constraint.formula))
        compared = (part for part in walk(constraint.formula) if isinstance(part, Compare))
        for node, dimension in ((node, compared_dimension(part)) for part in compared for node in walk(part)):
            if isinstance(node, ParameterRef) and node.name in scene.parameters and node.name not in seen:
                seen.add(node.name)
                own = next(p for p in program.parameters if p.name == node.name).unit
                known_in = own.dimension, own.symbol, own.si_factor
                yield Lever(node.name, scene.parameters[node.name], *known_in, node.name)
            elif isinstance(node, Number):
                if node.value == 0 and dimension not in _FROM_ZERO:
                    continue
                is_code = program.description is None  # whoever wrote the program looks for its line
                said = print_expression(constraint.formula) if is_code else f'"{in_words(program, constraint)}"'
                of = node.dimension or (None if multiplies else dimension)  # a factor has none
                unit = "" if of is None else SI_SYMBOL[of] if is_code else in_a_unit(node.value, of).unit
                si_factor = UNITS[unit].si_factor if unit else Fraction(1)
                what = f"{format_fraction(node.value / si_factor)} in {said}"
                yield Lever(what, node.value, of, unit, si_factor, f"free_{constraint.id}", node)


@dataclass(slots=True)
class _Trials:
    """Other values of levers, tried as long as there is work left. What has no witness soon is not proposed."""

    question: Question
    left_s: float = _ALL_S

    def asked(self, lever: Lever, value: Fraction | _Range) -> Question:
        """Return the question with another number in the lever's place, or with any in a range."""
        scene, name = self.question.scene, lever.name
        known = {each: own for each, own in scene.parameters.items() if lever.number or each != name}
        if isinstance(value, tuple):
            freed, program = {name: value}, lever.put(scene.program, ParameterRef(name))
        else:
            freed, program = {}, lever.put(scene.program, Number(value))
            known |= {} if lever.number else {name: value}
        return replace(self.question, scene=replace(scene, program=program, parameters=known), freed=freed)

    def witness(self, lever: Lever, value: Fraction | _Range, guesses: int = _GUESSES) -> Witness | None:
        """Look for a witness with another number in the lever's place, or with any in a range."""
        found, took_s = shown(self.asked(lever, value), guesses)
        self.left_s -= took_s
        return found

    def up_to(self, lever: Lever, end: Fraction, guesses: int = _GUESSES) -> Fraction | None:
        """Return a value that does between the lever's own and another; None where none is found.

        From so many `guesses` the other is tried by itself, where none between the two is found as an unknown.
        """
        between = min(lever.value, end), max(lever.value, end)
        witness = self.witness(lever, between)
        if witness is not None:
            return decimal_fraction(f"{witness.parameters[lever.name]:.6f}")
        # As a number it bounds a law of motion, where that is what it does; as an unknown it cannot.
        return end if self.witness(lever, end, guesses) else None

    def far_off(self, lever: Lever) -> list[Fraction]:
        """Return a value in either direction that does, however far off it is."""
        value, sign = lever.value, -1 if lever.value < 0 else 1
        ends = (sign * 10 * abs(value) + 20 * sign, Fraction(0) if value else Fraction(-20))
        return [far for end in ends if self.left_s > 0.0 and (far := self.up_to(lever, end)) is not None]

    def nearest(self, lever: Lever, far_off: Sequence[Fraction], until_s: float) -> Fraction:
        """Bisect between the lever's own value and those that do, until it is near enough or so much work is left."""
        value, nearest = lever.value, []
        for far in far_off:
            near = value
            for _ in range(_BISECTIONS):
                if self.left_s <= until_s or abs(far - near) <= _NEAR * abs(far - value):
                    break
                middle = (near + far) / 2
                better = self.up_to(lever, middle, _FEW)
                near, far = (middle, far) if better is None else (near, better)
            nearest.append(far)
        return min(nearest, key=lambda candidate: abs(candidate - value))

    def readable(self, lever: Lever, best: Fraction) -> Fraction | None:
        """Return a number near to `best` that is easy to read and does, too; None where none was seen to.

        A witness may be off by rounding, a proof is not: who takes the number is not to be told that it cannot be.
        """
        steps = (lever.si_factor / 10**digits for digits in _DECIMALS)
        every = (each for step in steps for each in _rounded(best, lever.value, step))
        readable = dict.fromkeys(each for each in every if each != lever.value)
        tried = (each for each in (*readable, best) if self.left_s > 0.0)
        does = (each for each in tried if self.witness(lever, each))
        return next((e for e in does if decide(self.asked(lever, e), explain=False).answer != "infeasible"), None)


def _rounded(found: Fraction, origin: Fraction, step: Fraction) -> tuple[Fraction, Fraction]:
    """Return whole steps: the nearest to a number, and the next one away from the value that did not work."""
    away = floor(found / step) if found < origin else floor(found / step) + 1
    return round(found / step) * step, away * step
