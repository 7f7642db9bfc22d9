"""Values of a program's terms in a trace.

What enters: a `Case`, a term, and the moments of knots. What leaves: numbers, or arrays over instants. This is
written apart from the planner's evaluator on purpose: a mistake there must not hide itself here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from scenewright.judge.case import CannotJudge, Case, NotReached
from scenewright.judge.tolerance import FloatArray, Values
from scenewright.program import expressions as ex
from scenewright.program.structure import KnotKey
from scenewright.translate.phrases import called

Span = tuple[float, float]
STANDING_MPS = 1e-3  # below this a time to arrive means nothing
_PARTS = 64  # of a piece, of which each is to have its rate: of up to some 20 s without a gap between them


@dataclass(frozen=True, slots=True)
class Moments:
    """When things are.

    Attributes
    ----------
    knots
        Time (s) of each measured knot; infinite where the actor never got there. An array tries many instants at once.
    spans
        Start and end (s) of each measured piece, by actor and index in its sketch.
    now
        The instants that states without a moment of their own speak of.
    """

    knots: Mapping[KnotKey, Values]
    spans: Mapping[tuple[int, int], Span] = field(default_factory=dict)
    now: Values | None = None


def sides(case: Case, compare: ex.Compare, moments: Moments) -> tuple[Values, Values]:
    """Return the values of both sides of a comparison.

    Raises
    ------
    CannotJudge
        If a landmark, a knot or a shared lane is missing.
    """
    reader = _Reader(case, moments)
    return reader.value(compare.left), reader.value(compare.right)


@dataclass(frozen=True, slots=True)
class _Reader:
    case: Case
    moments: Moments

    def value(self, term: ex.Term) -> Values:
        match term:
            case ex.Number(value=value):
                return float(value)
            case ex.ParameterRef(name=name):
                return self._parameter(name)
            case ex.Landmark():
                return self._place(term)
            case ex.Elapsed(actor=actor, knot=knot):
                return self._knot(actor, knot) - self.case.start_s
            case ex.State():
                return self._state(term)
            case ex.Derived():
                return self._derived(term)
            case ex.Negate(operand=operand):
                return -self.value(operand)
            case ex.Arithmetic(operator=operator, left=left, right=right):
                return _combine(operator, self.value(left), self.value(right))

    def _parameter(self, name: str) -> float:
        if name not in self.case.parameters:
            raise CannotJudge(f"the parameter {name} has no value")
        return float(self.case.parameters[name])

    def _knot(self, actor: int, knot: str) -> Values:
        if (actor, knot) not in self.moments.knots:
            raise CannotJudge(f"nothing in the trace says when {self.case.name(actor)}'s {knot} was")
        return self.moments.knots[actor, knot]

    def _time(self, actor: int, at: ex.At) -> Values:
        match at:
            case ex.Knot(name=knot):
                owner, time_s = actor, self._knot(actor, knot)
            case ex.Elapsed(actor=owner, knot=knot):
                time_s = self._knot(owner, knot)
            case ex.Number(value=value):
                if float(value) > self.case.end_s - self.case.start_s + 1e-9:
                    raise CannotJudge(f"the run ended before {float(value):g} s")
                return self.case.start_s + float(value)
            case _:
                if self.moments.now is None:
                    raise CannotJudge("nothing says at which moment")
                return self.moments.now
        if not np.all(np.isfinite(time_s)):
            raise NotReached(self.case.name(owner), owner)
        return time_s

    def _state(self, term: ex.State) -> Values:
        timeline = self.case.timelines[term.actor]
        if isinstance(term.at, ex.PieceRef) and term.order == 2:
            return self._rates(term.actor, term.at)
        time_s = self._time(term.actor, term.at)
        if term.order == 0:
            return timeline.position(time_s) + (0.0 if term.frame is None else self._offset(term.frame, term.actor))
        if term.order == 1:
            return timeline.speed(time_s)
        if isinstance(term.at, ex.Knot | ex.Elapsed):
            # An acceleration steps at a knot: that of the piece which begins there is meant, or of the last one's end.
            if self._is_last_knot(term.actor, term.at):
                sample = np.searchsorted(timeline.time_s, time_s, side="left") - 1
            else:
                sample = np.searchsorted(timeline.time_s, time_s, side="right")
            time_s = timeline.time_s[np.clip(sample, 0, len(timeline.time_s) - 1)]
        return timeline.acceleration(time_s)

    def _is_last_knot(self, actor: int, at: ex.Knot | ex.Elapsed) -> bool:
        owner, knot = (actor, at.name) if isinstance(at, ex.Knot) else (at.actor, at.knot)
        return owner == actor and knot == self.case.program.actor(actor).sketch.knots[-1]

    def _span(self, actor: int, piece: ex.PieceRef) -> Span:
        return piece_span(self.case, self.moments, actor, piece)

    def _rates(self, actor: int, piece: ex.PieceRef) -> Values:
        """Return what the rate of a piece was: its mean, and where it is long enough that of each short part of it.

        What it does in its ramps, where it begins and where it ends, is looked at in its mean alone.
        """
        timeline, (start, end) = self.case.timelines[actor], self._span(actor, piece)
        mean = mean_acceleration(timeline.speed(np.array([start, end])), end - start)
        ramp_s = float(self.case.program.manner.ramp_s)
        if end - start < 3.0 * ramp_s:
            return mean
        instants = np.size(self.moments.now) if self.moments.now is not None else 1
        parts = np.linspace(start + ramp_s, end - 2.0 * ramp_s, (instants if instants > 1 else _PARTS) - 1)
        return np.append((timeline.speed(parts + ramp_s) - timeline.speed(parts)) / ramp_s, mean)

    def _derived(self, term: ex.Derived) -> Values:
        time_s = self._time(term.actor, term.at)
        timeline = self.case.timelines[term.actor]
        speed = timeline.speed(time_s)
        if isinstance(term.target, ex.Landmark):
            return _over(self._place(term.target) - timeline.position(time_s), speed)
        gap = self._gap(term.actor, term.target, time_s)
        if term.kind == "gap":
            return gap
        bodies = 0.5 * (self.case.box(term.actor).length_m + self.case.box(term.target).length_m)
        if term.kind == "freespace":
            return gap - bodies
        if term.kind == "headway":
            return _over(gap - bodies, speed)
        closing = (speed - self.case.timelines[term.target].speed(time_s)) * np.sign(gap)
        return _over(np.abs(gap) - bodies, np.maximum(closing, 0.0))

    def _gap(self, actor: int, other: int, time_s: Values) -> FloatArray:
        ahead: FloatArray = self.case.timelines[other].position(time_s) + self._offset(actor, other)
        return ahead - self.case.timelines[actor].position(time_s)

    def _place(self, mark: ex.Landmark) -> float:
        if mark.actor is None:
            raise CannotJudge(f"nothing says on whose route {mark.name} is meant")
        place = self.case.landmark_m(mark.name, mark.actor, mark.other)
        return place + (0.0 if mark.frame is None else self._offset(mark.frame, mark.actor))

    def _offset(self, actor: int, other: int) -> float:
        offset = self.case.offset_m(actor, other)
        if offset is None:
            names = f"{self.case.name(actor)} and {self.case.name(other)}"
            raise CannotJudge(f"{names} share no lane on which to compare their places")
        return offset


def divisor(case: Case, compare: ex.Compare, moments: Moments) -> Values | None:
    """Return what is divided by where one side of a comparison is a quotient, else None."""
    for side in (compare.left, compare.right):
        if isinstance(side, ex.Arithmetic) and side.operator == "/":
            return _Reader(case, moments).value(side.right)
    return None


def piece_span(case: Case, moments: Moments, actor: int, piece: ex.PieceRef) -> Span:
    """Return start and end (s) of a piece as measured.

    Raises
    ------
    CannotJudge
        If the piece does not exist or was never reached.
    """
    try:
        index = case.program.actor(actor).sketch.piece_index(piece.name)
    except KeyError:
        raise CannotJudge(f"{case.name(actor)} has no piece {piece.name}") from None
    if (actor, index) not in moments.spans:
        raise CannotJudge(f"{called(case.name(actor))} never got so far")
    return moments.spans[actor, index]


def mean_acceleration(speeds_mps: FloatArray, duration_s: float) -> float:
    """Return the mean acceleration between the first and the last of the speeds; 0 for no time at all."""
    return float(speeds_mps[-1] - speeds_mps[0]) / duration_s if duration_s > 0 else 0.0


def _over(distance_m: Values, speed_mps: Values) -> FloatArray:
    distance, speed = np.asarray(distance_m, dtype=np.float64), np.asarray(speed_mps, dtype=np.float64)
    moving = speed > STANDING_MPS
    standing = np.where(distance == 0, 0.0, np.copysign(np.inf, distance))
    return np.where(moving, distance / np.where(moving, speed, 1.0), standing)


def _combine(operator: str, left: Values, right: Values) -> Values:
    with np.errstate(all="ignore"):
        match operator:
            case "+":
                return left + right
            case "-":
                return left - right
            case "*":
                return left * right
            case _:
                return np.asarray(left, dtype=np.float64) / right
