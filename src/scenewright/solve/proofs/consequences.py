"""What follows from formulas by algebra that solvers do not find: factors that cannot be zero are divided out.

What enters: unknowns with ranges, and named formulas. What leaves: more named formulas that hold wherever those do.

An ego that holds its speed ``v`` and is ``c`` seconds from a place, by ``p - x = c v``, is there ``c`` seconds later:
``p - x = v d``, hence ``v (d - c) = 0``. Solvers of products take minutes to see it; once it is said they take none.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field

from scenewright.solve.proofs.events import Unknown
from scenewright.solve.proofs.polynomials import ZERO, All, Atom, Formula, Polynomial, atom, unknown
from scenewright.solve.proofs.relaxation import Named

Origins = tuple[str, ...]


def consequences(unknowns: Sequence[Unknown], formulas: Sequence[Named]) -> list[Named]:
    """Return comparisons that follow from `formulas`, each with all that it rests on."""
    facts = [(part, each.origins) for each in formulas for part in _conjuncts(each.formula)]
    positive = {number: origins for part, origins in facts for number in _positive(part)}
    solved = _Solved(unknowns, positive)
    for part, origins in facts:
        if part.relation == "==" and part.left.degree == 1:
            solved.learn(part.left, origins)
    found = dict[Formula, Named]()
    for part, origins in facts:
        if part.left.degree < 2:
            continue
        left, rests_on = solved.put_into(part.left, origins)
        for number, why in positive.items():
            if left.terms and all(number in each for each in left.terms):
                rest = Polynomial({_without(each, number): value for each, value in left.terms.items()})
                first, *others = dict.fromkeys((*rests_on, *why))
                made = Named(atom(rest, part.relation), first, tuple(others))
                found.setdefault(made.formula, made)
    return list(found.values())


@dataclass(slots=True)
class _Solved:
    """Unknowns that linear equalities tell by others, and what each of that rests on."""

    unknowns: Sequence[Unknown]
    kept: Collection[int]
    by_others: dict[int, tuple[Polynomial, Origins]] = field(default_factory=dict)

    def learn(self, left: Polynomial, origins: Origins) -> None:
        """Solve ``left == 0`` for one unknown, if possible for one that is no time, nor to be kept."""
        left, origins = self.put_into(left, origins)
        numbers = sorted(
            (key[0] for key in left.terms if key), key=lambda n: (n in self.kept) + (self.unknowns[n].kind == "time")
        )
        if numbers:
            pivot = left.terms[numbers[0],]
            rest = Polynomial({key: -value / pivot for key, value in left.terms.items() if key != (numbers[0],)})
            self.by_others[numbers[0]] = rest, origins

    def put_into(self, left: Polynomial, origins: Origins) -> tuple[Polynomial, Origins]:
        """Return `left` without what is told by others, and what that rests on."""
        while (known := next((n for key in left.terms for n in key if n in self.by_others), None)) is not None:
            rest, why = self.by_others[known]
            total = Polynomial({})
            for key, value in left.terms.items():
                term = Polynomial({(): value})
                for number in key:
                    term = term * (rest if number == known else unknown(number))
                total += term
            left, origins = total, tuple(dict.fromkeys((*origins, *why)))
        return left, origins


def _conjuncts(formula: Formula) -> Iterator[Atom]:
    if isinstance(formula, Atom):
        yield formula
    elif isinstance(formula, All):
        for part in formula.parts:
            yield from _conjuncts(part)


def _positive(part: Atom) -> Iterator[int]:
    """Yield the unknown that a comparison calls more than zero, if it is one alone."""
    terms = [(key, factor) for key, factor in part.left.terms.items() if key]
    least = part.left.terms.get((), ZERO)
    if len(terms) == 1 and part.relation != "==" and (least > 0 or (least == 0 and part.relation == "<")):
        (key, factor), *_ = terms
        if len(key) == 1 and factor < 0:
            yield key[0]


def _without(key: tuple[int, ...], number: int) -> tuple[int, ...]:
    place = key.index(number)
    return key[:place] + key[place + 1 :]
