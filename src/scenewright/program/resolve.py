"""Says once what a program leaves to be understood: whose landmark is meant, with whom, and along whose route.

What enters: a `Program`. What leaves: the same program in which every landmark has its actor and, where it may be a
conflict, its partner, and in which a comparison of several actors' places says along whose route it is made. It needs
no map: whether there is such a landmark, or such a lane, is for grounding to find out. What is resolved stays as it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from scenewright.program import expressions as ex
from scenewright.program.evaluate import landmark_owner
from scenewright.program.printer import print_expression
from scenewright.program.types import EGO, Program

_PRODUCT = Fraction(355, 113)  # how often what stands in a product counts: no sum cancels it by accident


def resolve(program: Program) -> Program:
    r"""Return `program` with nothing left to be understood; prints as before.

    Examples
    --------
    >>> from scenewright.program.text import parse_program
    >>> text = "Actor 0 (ego):\n- W\n- [t0, go, t1]\nActor 1 (hero):\n- E, N\n- [t0, go, t1]\nConstraints:\n"
    >>> formula = resolve(parse_program(text + "A0x(t1) == conflict_point - 5")).constraints[0].formula
    >>> formula.right.left.actor, formula.right.left.other
    (0, 1)
    """
    resolver = _Resolver(program)
    constraints = []
    for constraint in program.constraints:
        formula = resolver.formula(constraint.formula)
        constraints.append(constraint if formula == constraint.formula else replace(constraint, formula=formula))
    return replace(program, constraints=tuple(constraints))


def usual_partner(program: Program, actor: int) -> int | None:
    """Return with whom an actor's conflict point is where nothing says so: the ego, and for the ego the first hero."""
    if actor != EGO:
        return EGO
    return program.heroes[0].id if program.heroes else None


@dataclass(frozen=True, slots=True)
class _Resolver:
    """Resolves the parts of constraints."""

    program: Program

    def formula(self, formula: ex.Formula) -> ex.Formula:
        match formula:
            case ex.Logic(operands=operands):
                return replace(formula, operands=tuple(self.formula(operand) for operand in operands))
            case ex.Temporal(start=start, end=end, body=body):
                start, end = (
                    self._compare(ex.Compare("==", edge, ex.Number(Fraction(0)))).left for edge in (start, end)
                )
                return replace(formula, start=start, end=end, body=self.formula(body))
            case ex.Compare():
                return self._compare(formula)

    def _compare(self, compare: ex.Compare) -> ex.Compare:
        owner = landmark_owner(compare)
        left, right = (self._owned(side, owner) for side in (compare.left, compare.right))
        frame, foreign = _frame(left, right)
        return replace(compare, left=_framed(left, frame, foreign), right=_framed(right, frame, foreign))

    def _owned(self, term: ex.Term, owner: int | None) -> ex.Term:
        match term:
            case ex.Landmark():
                return self._landmark(term, owner)
            case ex.Derived(target=ex.Landmark() as target):
                owned = self._landmark(target, term.actor)
                return replace(term, target=owned if owned.actor == term.actor else replace(owned, frame=term.actor))
            case ex.Arithmetic(left=left, right=right):
                owned_left, owned_right = (self._owned(side, owner) for side in (left, right))
                return replace(term, left=owned_left, right=owned_right)
            case ex.Negate(operand=operand):
                return replace(term, operand=self._owned(operand, owner))
            case _:
                return term

    def _landmark(self, mark: ex.Landmark, owner: int | None) -> ex.Landmark:
        actor = mark.actor if mark.actor is not None else owner
        if actor is None:
            return mark  # nobody's: the checker refuses it, and so does whoever asks for its value
        other = mark.other
        if other is None and mark.name in ex.CONFLICT_LANDMARKS:
            other = usual_partner(self.program, actor)
        if (actor, other) == (mark.actor, mark.other):
            return mark
        return replace(mark, actor=actor, other=other, written=print_expression(mark))


def _frame(left: ex.Term, right: ex.Term) -> tuple[int | None, frozenset[int]]:
    """Return along whose route places are compared, and whose places have to be brought to it.

    It is the route of the first actor whose places do not cancel each other: ``A1x(t1) - A1.stop_line`` is the same
    distance along any route.
    """
    net: dict[int, Fraction] = {}
    for actor, count in (*_places(left, Fraction(1)), *_places(right, Fraction(-1))):
        net[actor] = net.get(actor, Fraction(0)) + count
    actors = [actor for actor, count in net.items() if count]
    return (actors[0], frozenset(actors[1:])) if actors else (None, frozenset())


def _places(term: ex.Term, sign: Fraction) -> Iterator[tuple[int, Fraction]]:
    """Yield the actor of every place in a term, with how often it counts."""
    match term:
        case ex.State(actor=actor, order=0) | ex.Landmark(actor=int() as actor):
            yield actor, sign
        case ex.Negate(operand=operand):
            yield from _places(operand, -sign)
        case ex.Arithmetic(operator=operator, left=left, right=right):
            inside = operator in "*/"
            yield from _places(left, sign * _PRODUCT if inside else sign)
            yield from _places(right, sign * _PRODUCT**2 if inside else -sign if operator == "-" else sign)
        case _:
            pass


def _framed(term: ex.Term, frame: int | None, foreign: frozenset[int]) -> ex.Term:
    match term:
        case ex.State(actor=actor, order=0, frame=None) | ex.Landmark(actor=int() as actor, frame=None) if (
            actor in foreign
        ):
            return replace(term, frame=frame)
        case ex.Arithmetic(left=left, right=right):
            return replace(term, left=_framed(left, frame, foreign), right=_framed(right, frame, foreign))
        case ex.Negate(operand=operand):
            return replace(term, operand=_framed(operand, frame, foreign))
        case _:
            return term
