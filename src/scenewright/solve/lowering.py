"""Lowers a program's constraints, on a scene, to conditions over the actors' motions.

What enters: formulas of a program and a view of every actor's motion. What leaves: conditions for a solver, or truth
values where everything is known. Divisions are multiplied out (accelerations, times to arrival), so that what is
linear stays so.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import TypeGuard

from scenewright.motion.algebra import (
    Condition,
    Symbol,
    Value,
    compare,
    conjunction,
    disjunction,
    negation,
    pin,
)
from scenewright.motion.sketched import ONE, Ratio
from scenewright.program import expressions as ex
from scenewright.program.structure import Structure
from scenewright.roads.bodies import VEHICLE_LENGTH_M
from scenewright.roads.grounding import Scene
from scenewright.solve.views import MotionView, SketchedView

# One unit of tolerance by what is compared: the tight tolerances of the contract (m, s, m/s, m/s^2).
TIGHT = {"length": Fraction(1, 2), "time": Fraction(1, 10), "speed": Fraction(1, 4), "acceleration": Fraction(1, 4)}
_OF_ORDER = ("length", "speed", "acceleration")
_OF_DERIVED = {"gap": "length", "tta": "time", "ttc": "time", "headway": "time"}


class NotYet(Exception):  # noqa: N818 - a signal between passes, no fault of anybody
    """A formula speaks of a moment that is not known in the motions given (the ego is not predicted to get there)."""


def compared_dimension(formula: ex.Node) -> str:
    """Return the dimension of what a comparison compares, told from the first state or derived quantity in it."""
    for node in ex.walk(formula):
        if isinstance(node, ex.State):
            return _OF_ORDER[node.order]
        if isinstance(node, ex.Derived):
            return _OF_DERIVED[node.kind]
    return "time"


class Lowering:
    """Lowers formulas over one set of motions.

    Parameters
    ----------
    scene, structure
        For landmarks and offsets, and for which knots are the same moment.
    motions
        A view of every actor, by id.
    parameters
        Values of parameters, known or unknown, by name.
    """

    def __init__(
        self,
        scene: Scene,
        structure: Structure,
        motions: Mapping[int, MotionView],
        parameters: Mapping[str, Value],
    ) -> None:
        self.scene = scene
        self.structure = structure
        self.motions = motions
        self.parameters = parameters
        self._now: tuple[int, int] | None = None
        self._sides: dict[ex.Derived, int] = {}  # of a time to collision: -1 while its first actor is the one in front

    def condition(self, formula: ex.Formula, tolerance: Fraction = Fraction(0)) -> Condition:
        """Return `formula` as a condition; equalities may be off by `tolerance` units of `TIGHT`.

        Raises
        ------
        NotYet
            Where a moment in it is not known.
        """
        match formula:
            case ex.Compare():
                return self._compare(formula, tolerance)
            case ex.Logic(operator="and", operands=operands):
                return conjunction([self.condition(operand, tolerance) for operand in operands])
            case ex.Logic(operator="or", operands=operands):
                return disjunction([self.condition(operand, tolerance) for operand in operands])
            case ex.Logic(operator="not", operands=operands):
                return negation(self.condition(operands[0]))
            case ex.Logic(operands=(left, right)):
                return disjunction([negation(self.condition(left)), self.condition(right, tolerance)])
            case ex.Temporal():
                return self._temporal(formula)
            case _:
                raise TypeError(f"not a formula: {formula!r}")

    def _compare(self, formula: ex.Compare, tolerance: Fraction) -> Condition:
        """Lower a comparison; one of a time to collision as the two cases of who is behind whom."""
        open_sides = [n for n in ex.walk(formula) if _is_time_to_collision(n) and n not in self._sides]
        if not open_sides:
            return self._compared(formula, tolerance)
        node, cases = open_sides[0], []
        gap = self.term(replace(node, kind="gap"))[0]
        for relation, side in ((">=", 1), ("<", -1)):
            self._sides[node] = side
            cases.append(conjunction([compare(relation, gap, Fraction(0)), self._compare(formula, tolerance)]))
        del self._sides[node]
        return disjunction(cases)

    def _compared(self, formula: ex.Compare, tolerance: Fraction) -> Condition:
        left_num, left_den = self._side(formula.left)
        right_num, right_den = self._side(formula.right)
        left, right = left_num * right_den, right_num * left_den
        positive = [compare(">", den, Fraction(0)) for den in (left_den, right_den)]
        if formula.operator == "==" and tolerance:
            slack = TIGHT[compared_dimension(formula)] * tolerance * left_den * right_den
            bounds = [compare("<=", left, right + slack), compare(">=", left, right - slack)]
            return conjunction([*positive, *bounds])
        finite = conjunction([*positive, compare(formula.operator, left, right)])
        # A time to arrival of one that stands, or to a collision of two that part, is longer than any time.
        if formula.operator in (">", ">=") and _may_be_endless(formula.left):
            return disjunction([negation(positive[0]), finite])
        if formula.operator in ("<", "<=") and _may_be_endless(formula.right):
            return disjunction([negation(positive[1]), finite])
        return finite

    def _side(self, term: ex.Term) -> Ratio:
        """Return one side of a comparison; a quotient by a known negative number is written with a positive one."""
        numerator, denominator = self.term(term)
        if not isinstance(denominator, Symbol) and denominator < 0 and not _may_be_endless(term):
            return -numerator, -denominator
        return numerator, denominator

    def term(self, term: ex.Term) -> Ratio:
        """Return a term as numerator and denominator."""
        match term:
            case ex.Number(value=value):
                return value, ONE
            case ex.ParameterRef(name=name):
                return self.parameters[name], ONE
            case ex.Landmark():
                return self._landmark(term), ONE
            case ex.Elapsed(actor=actor, knot=knot):
                return _known(self.motions[actor].time(knot)), ONE
            case ex.State(actor=actor, order=order, at=ex.PieceRef(name=name)):
                piece = self.scene.program.actor(actor).sketch.piece_index(name)
                ratio = self.motions[actor].on_piece(piece, order)
                if ratio is None:
                    raise NotYet
                return ratio
            case ex.State(actor=actor, order=order, at=at):
                numerator, denominator = self._state(actor, order, at, actor)
                return numerator + self._shift(term) * denominator, denominator
            case ex.Derived():
                return self._derived(term)
            case ex.Negate(operand=operand):
                numerator, denominator = self.term(operand)
                return -numerator, denominator
            case ex.Arithmetic():
                return self._arithmetic(term)
            case _:
                raise TypeError(f"not a term: {term!r}")

    def _state(self, actor: int, order: int, at: ex.At, knot_owner: int) -> Ratio:
        """Return the state of `actor` at a moment; a bare knot in `at` is a knot of `knot_owner`."""
        motion = self.motions[actor]
        if at is None:
            return self._state_now(actor, order)
        if isinstance(at, ex.Knot | ex.Elapsed):
            named = (at.actor, at.knot) if isinstance(at, ex.Elapsed) else (knot_owner, at.name)
            own = self.structure.same_moment(actor, named)
            if own is not None:
                ratio = motion.at_knot(own, order)
                if ratio is None:
                    raise NotYet
                return ratio
        return _known(motion.at_time(self._moment(at, knot_owner), order)), ONE

    def _moment(self, at: ex.At, knot_owner: int) -> Value:
        match at:
            case ex.Knot(name=name):
                return _known(self.motions[knot_owner].time(name))
            case ex.Elapsed(actor=actor, knot=knot):
                return _known(self.motions[actor].time(knot))
            case ex.Number(value=value):
                return value
            case _:
                raise ValueError("a state without a moment stands only inside always, never or eventually")

    def _derived(self, term: ex.Derived) -> Ratio:
        position = self._state(term.actor, 0, term.at, term.actor)[0]
        if isinstance(term.target, ex.Landmark):
            distance = self._landmark(term.target) - position
            return distance, self._state(term.actor, 1, term.at, term.actor)[0]
        offset = pin(self.scene.offset_m(term.actor, term.target))
        gap = self._state(term.target, 0, term.at, term.actor)[0] + offset - position
        if term.kind == "gap":
            return gap, ONE
        speed = self._state(term.actor, 1, term.at, term.actor)[0]
        body = pin(VEHICLE_LENGTH_M)
        if term.kind == "headway":
            return gap - body, speed
        closing = speed - self._state(term.target, 1, term.at, term.actor)[0]
        side = self._sides.get(term, 1)
        return side * gap - body, side * closing

    def _landmark(self, mark: ex.Landmark) -> Fraction:
        if mark.actor is None:
            raise ValueError(f"landmark {mark.name} belongs to no one")
        return pin(self.scene.landmark_m(mark.actor, mark.name, mark.other)) + self._shift(mark)

    def _shift(self, place: ex.State | ex.Landmark) -> Fraction:
        """Return what brings a place to the route that it is meant along."""
        if place.frame is None or place.actor is None:
            return Fraction(0)
        return pin(self.scene.offset_m(place.frame, place.actor))

    def _arithmetic(self, term: ex.Arithmetic) -> Ratio:
        left_num, left_den = self.term(term.left)
        right_num, right_den = self.term(term.right)
        match term.operator:
            case "+":
                return left_num * right_den + right_num * left_den, left_den * right_den
            case "-":
                return left_num * right_den - right_num * left_den, left_den * right_den
            case "*":
                return left_num * right_num, left_den * right_den
            case _:
                return left_num * right_den, left_den * right_num

    def _temporal(self, formula: ex.Temporal) -> Condition:
        """Lower a condition over an interval to the knots within it, between two knots of one sketched actor.

        Speed is linear and acceleration constant between knots, so a bound on either holds throughout where it holds at
        the ends of every stretch. Whatever else the body says is checked on the finished plan.
        """
        start, end = formula.start, formula.end
        if not (isinstance(start, ex.Elapsed) and isinstance(end, ex.Elapsed) and start.actor == end.actor):
            raise NotYet
        view = self.motions[start.actor]
        if not isinstance(view, SketchedView) or start.knot not in view.knots or end.knot not in view.knots:
            raise NotYet
        conditions = []
        for index in range(view.knots[start.knot], view.knots[end.knot] + 1):
            self._now = (start.actor, index)
            conditions.append(self.condition(formula.body))
        self._now = None
        if formula.operator == "always":
            return conjunction(conditions)
        anywhere = disjunction(conditions)
        return anywhere if formula.operator == "eventually" else negation(anywhere)

    def _state_now(self, actor: int, order: int) -> Ratio:
        view = self.motions[actor]
        if self._now is None or self._now[0] != actor or not isinstance(view, SketchedView):
            raise NotYet
        return view.motion.state_at_knot(self._now[1], order)


def _is_time_to_collision(node: ex.Node) -> TypeGuard[ex.Derived]:
    return isinstance(node, ex.Derived) and node.kind == "ttc" and not isinstance(node.target, ex.Landmark)


def _may_be_endless(term: ex.Term) -> bool:
    return any(isinstance(node, ex.Derived) and node.kind != "gap" for node in ex.walk(term))


def _known(value: Value | None) -> Value:
    if value is None:
        raise NotYet
    return value
