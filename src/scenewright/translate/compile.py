"""From a story to a program: one piece of code, whoever filled the story.

What enters: a `Story`. What leaves: a checked `Program`, or a `TranslationError` that names what the program language
does not know. It needs no map; `ways` has put the routes in where a text left them to the map.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal

from scenewright.errors import Span, TranslationError
from scenewright.program import expressions as ex
from scenewright.program import types as pt
from scenewright.program.arithmetic import combine, negate
from scenewright.program.check import check_program
from scenewright.translate import story as st

PIECES = {
    st.Verb.DRIVE: pt.PieceKind.GO,
    st.Verb.SPEED_UP: pt.PieceKind.ACC,
    st.Verb.BRAKE: pt.PieceKind.DEC,
    st.Verb.STAND: pt.PieceKind.STOP,
}
COMPASS = "NESW"
TURNS = {"straight": 0, "right": 1, "left": 3}  # quarters of the compass
DRIVEN = ("car", "truck", "van", "bus", "taxi")  # the kinds that the program language can drive, all of them as cars
UNNAMED = ("description", "program")  # what programs are called that nobody gave a name
ORDERS: dict[st.Quantity, ex.Order] = {st.Quantity.PLACE: 0, st.Quantity.SPEED: 1, st.Quantity.RATE: 2}
DERIVED: dict[st.Quantity, ex.DerivedKind] = {
    st.Quantity.GAP: "gap",
    st.Quantity.FREE_SPACE: "freespace",
    st.Quantity.HEADWAY: "headway",
    st.Quantity.COLLISION: "ttc",
    st.Quantity.ARRIVAL: "tta",
}
_BOUNDARY = re.compile(  # of a clause
    r"[.;!?,](?=\s|$)|\n\s*\n|\n\s*[-*]\s|\b(?:and|but|when|while|until|then|as soon as|(?<!at )once)\b", re.IGNORECASE
)


def compile_story(story: st.Story, description: str | None = None) -> pt.Program:
    """Return the program that `story` is; its quotes point into `description`, where there is one.

    Raises `TranslationError` for what the program language does not know, by name, and `ProgramError` where the story
    contradicts itself, such as a speed in metres.
    """
    _check_known(story)
    compiler = _Compiler(story, description, {actor.id: _sketch(story, actor.id) for actor in story.actors})
    compiler.constrain()
    parameters = {each.name: each for each in story.parameters}
    for amount in st.within(story, st.Amount):
        if amount.name is not None:
            parameters.setdefault(amount.name, pt.Parameter(amount.name))
    program = pt.Program(
        story.title or UNNAMED[0],
        tuple(pt.Actor(each.id, each.name, route_of(each.way), compiler.sketches[each.id]) for each in story.actors),
        tuple(pt.Constraint(f"c{number}", *each) for number, each in enumerate(compiler.formulas, start=1)),
        tuple(parameters.values()),
        story.map_name,
        description,
        story.manner,
    )
    check_program(program)
    return program


def route_of(way: st.Way) -> pt.RouteSpec:
    """Return the route that the facts of a way make: a whole one where they are whole, else what is wanted."""
    if way.lanes:
        return pt.LanesRoute(way.lanes)
    if way.headings:
        return pt.HeadingsRoute(way.headings)
    if way.heading and way.turn and not (way.origin or way.destination or way.destination_heading):
        turned = COMPASS[(COMPASS.index(way.heading) + TURNS[way.turn]) % 4]
        return pt.HeadingsRoute((way.heading,) if way.turn == "straight" else (way.heading, turned))
    return pt.IntentRoute(way.origin, way.turn, way.destination, way.heading, way.destination_heading)  # type: ignore[arg-type]


def refused(what: str, fix: str, quote: st.Quote | None = None) -> TranslationError:
    """Return the error that names what the program language does not know, and the nearest thing that it does."""
    return TranslationError(f"{what} cannot be said in a program yet", found=quote.text if quote else None, fix=fix)


def refused_kind(kind: str, quote: st.Quote | None) -> TranslationError:
    """Return the error that names a road user whom no program drives."""
    return refused(f"a {kind}", f"there may be any number of: {', '.join(DRIVEN)}", quote)


def refused_deed(verb: str, quote: st.Quote | None) -> TranslationError:
    """Return the error that names a deed that no program knows."""
    return refused(f"'{verb}'", f"what somebody may do: {', '.join(st.Verb)}", quote)


def _check_known(story: st.Story) -> None:
    if not story.heroes:
        fix = "for example: An oncoming hero turns left."
        raise TranslationError("there is nobody but the ego", expected="somebody else, and what they do", fix=fix)
    for actor in story.actors:
        if actor.kind not in DRIVEN:
            raise refused_kind(actor.kind, actor.quote)
        for relation in actor.relations:
            fix = "say which way each drives; who is ahead, behind, oncoming or comes from a side can be said"
            raise refused(f"that somebody is {relation.kind}", fix, relation.quote)
    for deed in story.deeds:
        if deed.verb not in set(st.Verb):
            raise refused_deed(deed.verb, deed.quote)
        if deed.actor == pt.EGO:
            raise refused("a deed of the ego", "the policy under test drives it; say what the others do", deed.quote)
    for hero in story.heroes:
        own = [deed for deed in story.deeds if deed.actor == hero.id]
        if len(story.deeds_of(hero.id)) != len(own):
            fix = "let each deed begin where the one before it ends"
            raise refused(f"two deeds of {hero.name} at one time", fix, own[-1].quote)


def _sketch(story: st.Story, actor: int) -> pt.Sketch:
    knots = story.knots_of(actor)
    pieces = [pt.PieceKind.GO] * (len(knots) - 1)
    if actor != pt.EGO:
        pieces = [PIECES[st.Verb(deed.verb)] for deed in story.deeds_of(actor)]
    # The ego, and whoever does nothing of its own, drives on after the last moment that it shares.
    if not pieces or (actor == pt.EGO and len(story.owners(knots[-1])) > 1):
        pieces.append(pt.PieceKind.GO)
    return pt.Sketch(tuple(f"t{number}" for number in range(len(pieces) + 1)), tuple(pieces))


@dataclass(slots=True)
class _Compiler:
    """Gathers the formulas of a story, each with where it came from."""

    story: st.Story
    text: str | None
    sketches: dict[int, pt.Sketch]
    formulas: list[tuple[ex.Formula, Span | None]] = field(default_factory=list)

    def constrain(self) -> None:
        for number, moment in enumerate(self.story.moments):
            self._moment(number, moment)
            for deed in self.story.deeds:
                if deed.begins == number:
                    self._throughout(deed)
        for order in self.story.orders:
            self._add(self._order(order), order.quote)
        for hold in self.story.holds:
            start, end = self._point(hold.start), self._point(hold.end)
            how: Literal["always", "never", "eventually"] = "eventually" if hold.how == "at some time" else hold.how
            self._add(ex.Temporal(how, start, end, self._condition(hold.condition, None)), hold.quote)

    def _add(self, formula: ex.Formula, quote: st.Quote | None) -> None:
        span = None if quote is None or self.text is None else clause_around(self.text, quote.span)
        self.formulas.append((formula, span))

    def _knot(self, actor: int, moment: int) -> str:
        return self.sketches[actor].knots[self.story.knots_of(actor).index(moment)]

    def _moment(self, number: int, moment: st.Moment) -> None:
        owners = self.story.owners(number)
        if number != st.START:
            instants = [ex.Elapsed(actor, self._knot(actor, number)) for actor in owners]
            for other in instants[1:]:
                self._add(ex.Compare("==", instants[0], other), moment.quote)
            if instants and moment.time is not None:
                self._add(ex.Compare("==", instants[-1], _term(moment.time)), moment.time.quote)
        for condition in moment.conditions:
            self._add(self._condition(condition, number), condition.quote or moment.quote)

    def _throughout(self, deed: st.Deed) -> None:
        sketch = self.sketches[deed.actor]
        piece = ex.PieceRef(sketch.piece_names()[self.story.deeds_of(deed.actor).index(deed)])
        if deed.verb == st.Verb.STAND:
            self._add(ex.Compare("==", ex.State(deed.actor, 1, piece), ex.Number(Fraction(0))), deed.quote)
        for measure in deed.throughout:
            if measure.quantity in ORDERS and measure.other is None and measure.actor == deed.actor:
                self._add(self._measure(measure, piece), measure.quote)
            else:  # a piece is asked for nothing but its own place, speed and acceleration
                start, end = (self._point(st.Point(moment)) for moment in (deed.begins, deed.ends))
                self._add(ex.Temporal("always", start, end, self._condition(measure, None)), measure.quote)

    def _condition(self, condition: st.Condition, moment: int | None) -> ex.Formula:
        if isinstance(condition, st.Compound):
            joint: Literal["and", "or", "not", "implies"] = "implies" if condition.joint == "if" else condition.joint
            return ex.Logic(joint, tuple(self._condition(part, moment) for part in condition.parts))
        return self._measure(condition, self._at(condition.actor, moment), moment)

    def _at(self, actor: int, moment: int | None) -> ex.At:
        if moment is None:
            return None
        if actor in self.story.owners(moment):
            return ex.Knot(self._knot(actor, moment))
        return self._instant(moment)

    def _instant(self, moment: int) -> ex.Elapsed | ex.Number:
        owners = self.story.owners(moment)
        if owners:
            return ex.Elapsed(owners[-1], self._knot(owners[-1], moment))
        time = self.story.moments[moment].time
        if time is None or time.si is None:
            raise refused("a moment that is nobody's", "say what begins or ends then, or what the ego does")
        return ex.Number(time.si)

    def _measure(self, measure: st.Measure, at: ex.At, moment: int | None = None) -> ex.Compare:
        actor, quantity, other = measure.actor, measure.quantity, measure.other
        amount = None if measure.amount is None else _term(measure.amount)
        place = None if measure.place is None else _landmark(measure.place, actor)
        target = place if quantity is st.Quantity.ARRIVAL else other
        if quantity in DERIVED and target is not None and amount is not None:
            return ex.Compare(measure.op, ex.Derived(DERIVED[quantity], actor, target, at), amount)
        origin: ex.Term | None = place if quantity is st.Quantity.PLACE else None  # what the amount is counted from
        if quantity is st.Quantity.SPEED and other is not None:
            origin = ex.State(other, 1, self._at(other, moment))
        if quantity in DERIVED or (origin is None and (amount is None or quantity is st.Quantity.PLACE)):
            raise refused(f"half of a {quantity}", "say of whom, to what, and how much", measure.quote)
        left, op = ex.State(actor, ORDERS[quantity], at), measure.op
        if amount is None:
            assert origin is not None
            return ex.Compare(op, left, origin)
        if not counted_down(quantity, measure.opposite):
            return ex.Compare(op, left, amount if origin is None else combine("+", origin, amount))
        return ex.Compare(ex.FLIPPED[op], left, negate(amount) if origin is None else combine("-", origin, amount))

    def _order(self, order: st.Order) -> ex.Formula:
        if order.first == st.START and order.margin is not None:
            return ex.Compare(order.op, self._instant(order.second), _term(order.margin))
        first, second = self._instant(order.first), self._instant(order.second)
        if order.margin is None:
            return ex.Compare(ex.FLIPPED[order.op], first, second)
        return ex.Compare(order.op, combine("-", second, first), _term(order.margin))

    def _point(self, point: st.Point) -> ex.Term:
        if point.offset is None:
            return self._instant(point.moment)
        if point.moment == st.START and not point.earlier:
            return _term(point.offset)
        return combine("-" if point.earlier else "+", self._instant(point.moment), _term(point.offset))


def clause_around(text: str, span: Span) -> Span:
    """Return the clause that `span` stands in: people quote "the ego is 25 m before the stop line", not "25 m".

    >>> text = "When the ego is 25 m before the stop line, the hero brakes."
    >>> clause_around(text, Span(16, 20)).excerpt(text)
    'the ego is 25 m before the stop line'
    """
    begins = [match.end() for match in _BOUNDARY.finditer(text, 0, span.start)]
    after = _BOUNDARY.search(text, span.end)
    return Span(begins[-1] if begins else 0, after.start() if after else len(text)).trimmed(text)


def counted_down(quantity: st.Quantity, opposite: bool) -> bool:
    """Whether an amount is taken away: the way to a place, unless past it; slower than somebody; slowing.

    The same tells from whether it is taken away whether it is counted the `opposite` way.
    """
    return opposite is not (quantity is st.Quantity.PLACE)


def _landmark(place: st.Place, actor: int) -> ex.Landmark:
    """Return the landmark; its owner is named where it is not who is measured, or where there are partners to tell."""
    owner = place.of if place.of is not None else actor if place.partner is not None else None
    return ex.Landmark(place.name, owner, place.partner)


def _term(amount: st.Amount) -> ex.Term:
    if amount.name is not None:
        return ex.ParameterRef(amount.name)
    assert amount.si is not None
    return ex.Number(amount.si, None, amount.dimension)
