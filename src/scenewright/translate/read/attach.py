"""Reads one clause: amounts attach by dimension to what they may be counted to, and what carries meaning is used up.

What enters: the chunks of a clause, and who its people are. What leaves: the `Clause`, or the words that nothing could
be made of. An amount belongs to the nearest place or actor after it, else before it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from scenewright.errors import UnknownWordsError
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.phrases import SIDES
from scenewright.translate.read.cast import Cast
from scenewright.translate.read.chunks import Chunk
from scenewright.translate.read.clauses import IT, PEOPLE, Clause, Taken, Target

_BARE = {side: op for op, side in SIDES.items()} | {"to": "==", "behind": "<"}  # a side and a place, without an amount
# What says something of somebody: an amount beside a bare name does not.
_VERBS = ("be", "state", "event", "deed", "phase", "turn", "kept", "order", "quantity", "possessive")
_TO_PLACE = ("before", "behind", "from", "to", "ahead", "of")
_CONTRARY = ((st.Verb.BRAKE, "acceleration"), ("stop", "acceleration"), (st.Verb.SPEED_UP, "deceleration"))


def read_clause(chunks: Sequence[Chunk], people: Cast, subject: int | None = None) -> Clause:
    """Return what `chunks` say of whom they name, else of `subject`; what carries meaning must be used up."""
    taken = Taken(list(chunks), people, subject)
    while taken.at < len(taken.chunks):
        taken.take(taken.chunks[taken.at])
        taken.at += 1
    _attach(taken)
    taken.clause.notes |= {"said"} if any(chunk.kind in _VERBS for chunk in chunks) else set()
    taken.clause.notes |= {"distance"} if taken.quantities.get("length") else set()
    return taken.clause


def _attach(taken: Taken) -> None:
    """Give amounts their targets, make measures of what stands alone, and say of whom all of it is."""
    clause, last = taken.clause, taken.chunks[-1]
    _find_subject(taken)
    bare = "shall" not in clause.notes and not clause.says_more_than("deed")
    if (clause.deed, clause.subject) == (st.Verb.STAND, EGO) and bare:
        clause.deed, taken.states = None, taken.states | {"stands"}  # nobody tells the ego to: "the ego waits"
    if "in" in clause.times and clause.deed != "stop" and not clause.flags & {"to", "standstill"}:
        raise taken.left_over(last)  # "brakes within 4 s": until then, or for so long?
    if "stands" in taken.states:
        taken.measure(last, st.standstill(IT))
    passes_by = "pass" in taken.states and "has" in clause.notes and not (taken.targets or taken.amounts)
    taken.people.assumptions += [f"'{clause.quote.text}' is of the conflict point"] * passes_by
    for name in [*sorted(taken.states & {"turn_start", "turn_end"}), *["conflict_point"] * passes_by]:
        taken.measure(last, st.Measure(IT, st.Quantity.PLACE, "==", None, st.Place(name)))
    pairs = _in_pairs(taken)
    for at, op, chunk in taken.amounts:
        _placed(taken, at, partial(_give, taken, at, op, chunk, pairs.get(at)))
    if taken.beyond:
        raise taken.left_over(next(iter(taken.beyond.values())))
    for target in taken.targets:
        if not target.used:
            _placed(taken, target.at, partial(_stand_alone, taken, target))
    _refuse_unused(taken)
    if "goes" in taken.states and clause.deed is None and not (clause.facts or clause.measures or clause.flags):
        clause.deed = st.Verb.DRIVE
    _say_of_whom(taken)
    clause.agree()
    begin, end = ([each.amount.si for each in said if each.quantity is st.Quantity.SPEED and each.amount is not None]
                  for said in (clause.begins, clause.measures))  # fmt: skip
    sense = {st.Verb.BRAKE: -1, "stop": -1, st.Verb.SPEED_UP: 1}.get(clause.deed or "", 0)
    if begin and end and begin[0] is not None and end[0] is not None and sense * (end[0] - begin[0]) < 0:
        raise taken.left_over(last)  # nobody brakes from 5 m/s to 10 m/s


def _refuse_unused(taken: Taken) -> None:
    """Refuse a passing of nothing, a quantity without an amount, and a gap that is kept: that is no speed."""
    clause, last = taken.clause, taken.chunks[-1]
    places = [each for each in clause.measures if each.quantity is st.Quantity.PLACE]
    passes_nothing = "pass" in taken.states and all(each.amount is not None for each in places)
    fast = "speed" in taken.quantities or any(each.quantity is st.Quantity.SPEED for each in clause.measures)
    # "It continues at this speed": who drives at it without such a deed may drive as another one does.
    fast |= clause.deed == st.Verb.DRIVE and any(each.kind == "kept" and "speed" in each.text for each in taken.chunks)
    told = [chunk.dimension for _, _, chunk in taken.amounts] + ["speed"] * ("kept" in clause.flags)
    unused = ("reach" in taken.states and not places) or taken.quantities.keys() - {*told}
    if passes_nothing or unused or ("kept" in clause.flags and not fast):  # "keeps a gap of 20 m"
        raise taken.left_over(last)


def _say_of_whom(taken: Taken) -> None:
    """Say of the subject what is told of `IT`."""
    clause, people = taken.clause, taken.people
    if clause.subject is None and (clause.measures or clause.rates or clause.begins):
        raise taken.left_over(taken.chunks[0])
    for some in (clause.measures, clause.rates, clause.begins):
        some[:] = [_of(each, clause.subject, people) for each in some]
    if any(each.of == clause.subject for each in clause.relations):  # "the ego follows a bus in the same lane"
        other = people.whom(clause.quote, clause.subject)
        clause.relations = [replace(each, of=other) for each in clause.relations]
    if any(each.place is not None and each.place.partner == each.actor for each in clause.measures):
        raise taken.left_over(taken.chunks[-1])  # "it" of a conflict point with somebody, said of that one


def _in_pairs(taken: Taken) -> dict[int, Target]:
    """Return what each amount is counted to where there are as many of both: in their order."""
    far = [at for at, _, chunk in taken.amounts if chunk.dimension in ("length", "time")]
    counted = [at for at in far if at not in taken.ranges]
    free = [target for target in taken.targets if not target.used]
    return dict(zip(counted, free, strict=True)) if len(counted) == len(free) > 1 else {}


def _placed(taken: Taken, at: int, make: Callable[[], None]) -> None:
    """Make measures of what stands at `at`: in front of a deed it is so when that begins."""
    clause, known = taken.clause, len(taken.clause.measures)
    make()
    if clause.deed is None or at < 0:
        return
    made = [each for each in clause.measures[known:] if each.quantity is not st.Quantity.SPEED]
    between = taken.deed_at < at < taken.stands_at
    if between and made and clause.rests:
        clause.notes.add("between")  # "brakes 30 m before it to a stop"
    elif between or at < taken.deed_at:  # "brakes 30 m before it to 4 m/s", "the car that is 30 m before it brakes"
        clause.measures = [each for each in clause.measures if each not in made]
        clause.begins += made


def _find_subject(taken: Taken) -> None:
    """Say of whom a clause is that names nobody in front, and which place or who "it" is."""
    clause, people = taken.clause, taken.people
    ahead = next((each for each in taken.targets if each.side == "ahead" and each.other is not None), None)
    place = next((each for each in taken.targets if each.place is not None and each.side == "at"), None)
    # "There is a driveway 100 m in front of the ego."
    if clause.subject is None and taken.amounts and ahead is not None and place is not None:
        clause.subject, ahead.used, place.side = ahead.other, True, "before"
    if taken.pair is None and {*st.BETWEEN} & {*taken.quantities.values()}:
        others = [each.other for each in taken.targets if each.side in ("to", "with") and each.other is not None]
        if clause.subject is not None and not taken.targets:  # "the ego's headway is 2 s"
            other = people.whom(clause.quote, clause.subject)
            taken.targets.append(Target(0, "to", taken.chunks[-1], other=other))
        elif clause.subject is None and not taken.targets:
            taken.pair = people.pair(taken.chunks[0])  # "when the gap is 20 m"
        elif clause.subject is None and len(others) == len(taken.targets) == 1:  # "the headway to the hero is 2 s"
            taken.pair, taken.targets = (people.whom(clause.quote, others[0]), others[0]), []
    if taken.pair is not None:
        if clause.subject not in (None, *taken.pair):
            raise taken.left_over(taken.chunks[taken.subject_at])  # "the van has a gap between the ego and the hero"
        rear = people.rear(*taken.pair, clause.quote)
        clause.subject, front = rear, next((each for each in taken.pair if each != rear), rear)
        taken.targets.append(Target(0, "behind", taken.chunks[-1], other=front))
    clause.subject = taken.subject if clause.subject is None else clause.subject
    for target in taken.targets:
        if target.place is not None and target.chunk.kind == "pronoun":
            target.place = people.seen_by(target.place, clause.subject)
            if target.place.of not in (None, clause.subject) and target.side == "at":
                raise taken.left_over(target.chunk)  # nobody passes a stop line of another's way
        elif target.place is None and target.other is None:
            target.other = people.whom(target.chunk.quote, clause.subject)
            people.meant.append(target.other)


def _of(measure: st.Measure, subject: int | None, people: Cast) -> st.Measure:
    """Return a measure of `IT` as one of the subject."""
    actor, other = (subject if each == IT else each for each in (measure.actor, measure.other))
    assert actor is not None
    place = measure.place
    place = replace(place, of=None) if place is not None and place.of == actor else place
    if place is not None and place.name == "conflict_point" and EGO in (place.of, actor if place.of is None else None):
        place = replace(place, partner=people.partner(place.partner, measure.quote or people.quote))
    if place is not None and place.name not in ("turn_start", "turn_end"):  # who turns names no place
        people.place = replace(place, of=actor if place.of is None else place.of)
    return replace(measure, actor=actor, other=other, place=place)


def _stand_alone(taken: Taken, target: Target) -> None:
    """Make of a target without an amount what it says: how two ways lie, or where somebody is."""
    clause = taken.clause
    is_which = target.at > 0 and taken.chunks[target.at - 1].kind in PEOPLE  # "a car ahead of it brakes"
    acts = clause.deed or "event" in clause.notes
    if target.other is not None and target.side in ("ahead", "behind") and (is_which or not acts):
        if clause.turns and not is_which:
            fix = "say who passes first, or that it 'turns left across the path of the ego'"
            raise UnknownWordsError("it is not clear whether it goes first", found=clause.quote.text, fix=fix)
        clause.relations.append(st.Relation(target.side, target.other, target.chunk.quote))
    elif clause.deed and target.place is not None and target.place.name == "turn" and target.place.of is not None:
        raise taken.left_over(target.chunk)  # "brakes before the ego's turn": that is a time
    elif target.side == "at" and not acts and any(each.quantity is st.Quantity.PLACE for each in clause.measures):
        raise taken.left_over(target.chunk)  # "12 m before the stop line at the conflict point"
    elif target.side == "at" and "turn" in clause.facts and not (acts or "wanted" in clause.notes):
        if target.place != st.Place("intersection"):  # that is where a way turns
            raise taken.left_over(target.chunk)
    elif target.side == "at" and target.at < taken.subject_at and not taken.states & {"pass", "reach"}:
        raise taken.left_over(target.chunk)  # "at the junction, the ego ...": it is what follows that is there
    elif target.place is not None and target.side in _BARE:
        drives = bool(clause.facts or taken.states & {"drives", "goes"})
        drives |= (clause.deed, clause.subject) == (st.Verb.DRIVE, EGO)
        clause.notes |= {"comes"} if target.side == "to" or (target.side in ("past", "at") and drives) else set()
        if target.side == "to" and clause.deed is None and clause.subject != EGO:  # where it is headed it is not yet
            clause.deed = st.Verb.DRIVE
        taken.measure(target.chunk, st.Measure(IT, st.Quantity.PLACE, _BARE[target.side], None, target.place))
    else:
        raise taken.left_over(target.chunk)


def line_up(clause: Clause) -> None:
    """Take whom a clause says to be ahead or behind as what is so at its moment, not as a way of driving."""
    gaps = [st.in_line(clause.subject, each) for each in clause.relations if clause.subject is not None]
    found = [gap for gap in gaps if gap is not None]
    if len(found) == len(clause.relations):
        clause.measures, clause.relations = [*clause.measures, *found], []


def _give(taken: Taken, at: int, op: st.Operator, chunk: Chunk, paired: Target | None) -> None:
    """Make a measure of an amount, with its own target, the nearest free one after it, else before it."""
    clause = taken.clause
    if chunk.dimension == "speed":
        taken.measure(chunk, st.Measure(IT, st.Quantity.SPEED, op, chunk.amount))
    elif chunk.dimension == "acceleration":
        _give_rate(taken, op, chunk)
    else:
        free = [target for target in taken.targets if not target.used]
        target = paired or next((each for each in free if each.at > at), free[-1] if free else None)
        if at in taken.ranges:
            target = next((each for each in taken.targets if each.at > at), None) or taken.last
        if target is None and chunk.dimension == "length" and clause.deed is not None:
            fix = "say where it ends, as in '... 5 m before the conflict point'"
            raise UnknownWordsError("how far a deed goes cannot be said yet", found=clause.quote.text, fix=fix)
        if target is None:
            raise taken.left_over(chunk)
        target.used, taken.last = True, target
        if target.place is not None:
            _count_to_place(taken, at, op, chunk, target, target.place)
        else:
            _count_to_other(taken, op, chunk, target)


def _give_rate(taken: Taken, op: st.Operator, chunk: Chunk) -> None:
    """Make a measure of an acceleration; that of a deed is of the deed throughout."""
    clause, amount, named = taken.clause, chunk.amount, taken.quantities.get("acceleration")
    assert amount is not None
    if (clause.deed is None and named is None) or (clause.deed, named) in _CONTRARY:
        raise taken.left_over(chunk)  # "brake to a stop, the car at 3 m/s^2", "brakes with an acceleration of 3 m/s^2"
    slowing = named == "deceleration" or clause.deed in (st.Verb.BRAKE, "stop")
    if slowing and amount.value is not None and amount.value < 0:  # "brakes at -3 m/s^2": the sign says it again
        amount = replace(amount, value=-amount.value)
    if clause.deed == st.Verb.SPEED_UP and amount.value is not None and amount.value <= 0:
        raise taken.left_over(chunk)
    taken.measure(chunk, st.Measure(IT, st.Quantity.RATE, op, amount, opposite=slowing))
    if clause.deed is not None:
        clause.rates.append(clause.measures.pop())


def _count_to_place(taken: Taken, at: int, op: st.Operator, chunk: Chunk, target: Target, place: st.Place) -> None:
    """Make a measure of how far it is to a place, or how long until it is there."""
    named, side, is_time = taken.quantities.get(chunk.dimension), target.side, chunk.dimension == "time"
    past = side in ("past", "after") and not is_time
    fits = past or side in _TO_PLACE or (side == "at" and named == "time to arrival")
    if not fits or named not in (None, "time to arrival", "gap"):
        raise taken.left_over(target.chunk)
    quantity = st.Quantity.ARRIVAL if is_time else st.Quantity.PLACE
    measure = st.Measure(IT, quantity, op, chunk.amount, place, opposite=past)
    taken.measure(chunk, measure)
    near, beyond = st.not_beyond(measure), taken.beyond.pop(at, None)
    if beyond is not None and (near is None or (beyond.value == "before") is not past):
        raise taken.left_over(beyond)
    if near is not None and beyond is None and at not in taken.ranges:
        taken.measure(target.chunk, near)


def _count_to_other(taken: Taken, op: st.Operator, chunk: Chunk, target: Target) -> None:
    """Make a measure of the gap, the headway or the time to collision between two."""
    clause, named, side = taken.clause, taken.quantities.get(chunk.dimension), target.side
    is_time = chunk.dimension == "time"
    asked = named or ("headway" if is_time else "gap")
    # "Passes it 1 s ahead of the ego": before it, or at a headway?
    either_way = named is None and is_time and "event" in clause.notes
    fits = side in ("behind", "ahead") or (named is not None and side in ("to", "with"))
    if either_way or target.other is None or not fits or asked not in st.BETWEEN:
        raise taken.left_over(target.chunk)
    behind, both = side == "ahead", (clause.subject or EGO, target.other)  # it is the other one that is behind
    # Who has one is behind, unless it was said to lead; of a gap, and of "brakes at a headway of 2 s", either may be.
    either = asked == "gap" or clause.deed is not None or (not target.at and clause.subject != EGO)
    if side in ("to", "with") and (either or target.other in taken.people.told_rears(*both)):
        behind = taken.people.rear(*both, chunk.quote) == target.other
    one, other = (target.other, IT) if behind else (IT, target.other)
    taken.measure(chunk, st.Measure(one, st.Quantity(asked), op, chunk.amount, other=other))
