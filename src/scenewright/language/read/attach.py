"""Reads one clause: amounts attach by dimension to what they may be counted to, and what carries meaning is used up.

What enters: the chunks of a clause, its neighbour, and who its people are. What leaves: the `Clause`, or the words that
nothing could be made of. An amount belongs to the nearest place or actor after it, else before it, else to that of its
neighbour.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from scenewright.language import story as st
from scenewright.language.read.cast import Cast
from scenewright.language.read.chunks import Chunk
from scenewright.language.read.clauses import IT, Taken, Target
from scenewright.language.read.facts import Clause
from scenewright.program.types import EGO

_BARE: dict[str, st.Operator] = {  # a side and a place, without an amount
    "at": "==", "to": "==", "at or past": ">=", "past": ">", "at or before": "<=", "before": "<", "behind": "<",
}  # fmt: skip
_TO_PLACE = ("before", "behind", "from", "to", "ahead", "of")
# What is asked for, and the side on which the other actor stands: the quantity, by whether the amount is a time.
_TO_ACTOR = {
    (None, "behind", False): st.Quantity.GAP, ("gap", "behind", False): st.Quantity.GAP,
    (None, "ahead", False): st.Quantity.GAP, ("gap", "ahead", False): st.Quantity.GAP,
    ("gap", "to", False): st.Quantity.GAP, (None, "behind", True): st.Quantity.HEADWAY,
    ("headway", "behind", True): st.Quantity.HEADWAY, ("headway", "to", True): st.Quantity.HEADWAY,
    ("time to collision", "with", True): st.Quantity.COLLISION,
    ("time to collision", "to", True): st.Quantity.COLLISION,
}  # fmt: skip
_JUNCTIONS = (st.Place("intersection"), st.Place("conflict_point"))
_OF_A_PLACE = {True: (None, "time to arrival"), False: (None, "gap")}  # what may be asked for, by whether it is a time
_OF_ITS_OWN = {"speed": (None, "speed"), "acceleration": (None, "rate", "acceleration", "deceleration")}
_CONTRARY = ((st.Verb.BRAKE, "acceleration"), ("stop", "acceleration"), (st.Verb.SPEED_UP, "deceleration"))
_OF_A_PAIR = {
    ("gap", False): st.Quantity.GAP, (None, False): st.Quantity.GAP, ("headway", True): st.Quantity.HEADWAY,
    ("time to collision", True): st.Quantity.COLLISION,
}  # fmt: skip


def read_clause(
    chunks: Sequence[Chunk], people: Cast, neighbour: Clause | None = None, subject: int | None = None
) -> Clause:
    """Return what `chunks` say of whom they name, else of `subject`; a lone amount takes the place of its neighbour.

    Raises
    ------
    UnknownWordsError
        Where something that carries meaning is left over.
    """
    taken = Taken(list(chunks), people)
    taken.take_all()
    _attach(taken, neighbour, subject)
    return taken.clause


def _attach(taken: Taken, neighbour: Clause | None, subject: int | None) -> None:
    """Give amounts their targets, make measures of what stands alone, and say of whom all of it is."""
    clause, last = taken.clause, taken.chunks[-1]
    _find_subject(taken, subject)
    for at, side, chunk in taken.later:
        taken.targets.append(Target(at, side, chunk, other=taken.people.whom(chunk, clause.subject)))
    if "stands" in taken.states:
        taken.measure(last, st.Measure(IT, st.Quantity.SPEED, "==", st.Amount(Fraction(0), "m/s")))
    if taken.yields_to is not None and taken.yields_to == clause.subject:
        raise taken.left_over(last)
    for name in ("turn_start", "turn_end"):
        if name in taken.states:
            if taken.turn and clause.subject is not None:
                taken.people.tell_way(clause.subject, {"turn": taken.turn}, clause.quote)
            taken.measure(last, st.Measure(IT, st.Quantity.PLACE, "==", None, st.Place(name)))
    for at, op, chunk in taken.amounts:
        _give(taken, at, op, chunk, neighbour)
    for target in taken.targets:
        if not target.used:
            _stand_alone(taken, target)
    if taken.quantity and not (taken.amounts or "kept" in clause.flags):
        raise taken.left_over(last)
    fast = taken.quantity == "speed" or any(each.quantity is st.Quantity.SPEED for each in clause.measures)
    if "kept" in clause.flags and clause.rate is not None:  # "brakes at a constant rate of 3 m/s^2"
        clause.flags.discard("kept")
    elif "kept" in clause.flags and not fast:
        raise taken.left_over(last)  # "keeps a gap of 20 m"
    places = [each for each in clause.measures if each.quantity is st.Quantity.PLACE]
    passed = [each for each in places if each.amount is None]
    if ("pass" in taken.states and not passed) or ("reach" in taken.states and not places):
        raise taken.left_over(last)
    if "goes" in taken.states and clause.deed is None and not (clause.facts or clause.measures or clause.flags):
        clause.deed = st.Verb.DRIVE
    if clause.subject is None and (clause.measures or clause.rate):
        raise taken.left_over(taken.chunks[0])
    clause.measures = [_of(each, clause.subject) for each in clause.measures]
    clause.rate = clause.rate and _of(clause.rate, clause.subject)


def _find_subject(taken: Taken, subject: int | None) -> None:
    """Say of whom a clause is that names nobody in front."""
    clause = taken.clause
    ahead = next((each for each in taken.targets if each.side == "ahead" and each.other is not None), None)
    place = next((each for each in taken.targets if each.place is not None and each.side == "at"), None)
    # "There is a driveway 100 m in front of the ego."
    if clause.subject is None and taken.amounts and ahead is not None and place is not None:
        clause.subject, ahead.used, place.side = ahead.other, True, "before"
    if clause.subject is None and taken.pair is None and taken.quantity in ("gap", "headway", "time to collision"):
        to = [each for each in taken.targets if each.other is not None]
        if not taken.targets and len(taken.people.heroes) == 1:  # "when the gap is 20 m"
            taken.pair = taken.people.pair(taken.chunks[0])
        elif len(to) == len(taken.targets) == 1 and to[0].other:  # "when the distance to the van is 20 m"
            taken.pair, to[0].used = (EGO, to[0].other), True
    if taken.pair is not None:
        if taken.pair[0] == taken.pair[1]:
            raise taken.left_over(taken.chunks[-1])
        rear = taken.people.rear(*taken.pair)
        if rear is None:
            names = [taken.people.actor(each).name for each in taken.pair]
            told = taken.people.ask(f"behind {clause.quote.start}", "Who drives behind?", names, 0, clause.quote)
            rear = taken.pair[names.index(told)]
        clause.subject = rear
    clause.subject = subject if clause.subject is None else clause.subject


def _of(measure: st.Measure, subject: int | None) -> st.Measure:
    """Return a measure of `IT` as one of the subject."""
    actor, other = (subject if each == IT else each for each in (measure.actor, measure.other))
    assert actor is not None
    place = measure.place
    place = replace(place, of=None) if place is not None and place.of == actor else place
    return replace(measure, actor=actor, other=other, place=place)


def _stand_alone(taken: Taken, target: Target) -> None:
    """Make of a target without an amount what it says: how two ways lie, or where somebody is."""
    clause = taken.clause
    if target.other is not None and taken.states & {"pass", "reach"} and target.side in ("before", "ahead", "after"):
        clause.rival = ("after" if target.side == "after" else "before", target.other)
    elif target.other is not None and target.side in ("ahead", "behind") and clause.deed is None:
        clause.relations.append(st.Relation(target.side, target.other, target.chunk.quote))
    elif target.place in _JUNCTIONS and target.side == "at" and clause.facts.get("turn", "straight") != "straight":
        pass  # "turns left at the junction"
    elif target.side == "at" and target.at < taken.subject_at and not taken.states & {"pass", "reach"}:
        raise taken.left_over(target.chunk)  # "at the junction, the ego ...": it is what follows that is there
    elif target.place is not None and target.side in _BARE:
        taken.measure(target.chunk, st.Measure(IT, st.Quantity.PLACE, _BARE[target.side], None, target.place))
    else:
        raise taken.left_over(target.chunk)


def _give(taken: Taken, at: int, op: st.Operator, chunk: Chunk, neighbour: Clause | None) -> None:
    """Make a measure of an amount, with the nearest free target after it, else before it, else its neighbour's."""
    amount, clause = chunk.amount, taken.clause
    assert amount is not None
    if taken.quantity not in _OF_ITS_OWN.get(amount.dimension, (taken.quantity,)):
        raise taken.left_over(chunk)
    if amount.dimension == "speed":
        taken.measure(chunk, st.Measure(IT, st.Quantity.SPEED, op, amount))
        return
    if amount.dimension == "acceleration":
        slowing = taken.quantity == "deceleration" or clause.deed in (st.Verb.BRAKE, "stop")
        if (clause.deed, taken.quantity) in _CONTRARY:
            raise taken.left_over(chunk)  # nobody brakes with an acceleration
        taken.measure(chunk, st.Measure(IT, st.Quantity.RATE, op, amount, opposite=slowing))
        if clause.deed is not None:
            clause.rate = clause.measures.pop()
        return
    if taken.pair is not None and clause.subject is not None:
        quantity = _OF_A_PAIR.get((taken.quantity, amount.dimension == "time"))
        if quantity is None:
            raise taken.left_over(chunk)
        other = next(each for each in taken.pair if each != clause.subject)
        taken.measure(chunk, st.Measure(IT, quantity, op, amount, other=other))
        return
    free = [target for target in taken.targets if not target.used]
    target = next((each for each in free if each.at > at), free[-1] if free else None)
    if target is None and neighbour is not None and neighbour.target is not None:
        target = Target(at, neighbour.target[0], chunk, neighbour.target[1])
    if target is None:
        clause.waiting.append(chunk)
        return
    target.used = True
    _to_target(taken, target, op, amount, chunk)


def _to_target(taken: Taken, target: Target, op: st.Operator, amount: st.Amount, chunk: Chunk) -> None:
    is_time, side, place = amount.dimension == "time", target.side, target.place
    past = side in ("past", "after") and not is_time
    if place is not None:
        taken.clause.target = (side, place)
        quantity = st.Quantity.ARRIVAL if is_time else st.Quantity.PLACE
        fits = past or side in _TO_PLACE or (side == "at" and taken.quantity == "time to arrival")
        if not fits or taken.quantity not in _OF_A_PLACE[is_time]:
            raise taken.left_over(target.chunk)
        taken.measure(chunk, st.Measure(IT, quantity, op, amount, place, opposite=past))
        return
    asked = _TO_ACTOR.get((taken.quantity, side, is_time))
    if asked is None or target.other is None:
        raise taken.left_over(target.chunk)
    if side == "ahead":  # the other one is behind
        taken.measure(chunk, st.Measure(target.other, asked, op, amount, other=IT))
    elif taken.quantity == "gap" and side == "to":
        rear = taken.people.rear(taken.clause.subject or 0, target.other)
        one, other = (target.other, IT) if rear == target.other else (IT, target.other)
        taken.measure(chunk, st.Measure(one, asked, op, amount, other=other))
    else:
        taken.measure(chunk, st.Measure(IT, asked, op, amount, other=target.other))
