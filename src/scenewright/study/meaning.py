"""Compares two programs by what they mean: same routes, same story, and constraints that follow from each other.

What enters: two programs and a map. What leaves: how they differ, in sentences; nothing where they mean the same. It
compares no motion and no layout: knots may be named otherwise, constraints be written in another way.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any

from scenewright.algebra.polynomials import ZERO, Formula, Named, compare, every, some
from scenewright.errors import ScenewrightError
from scenewright.motion.limits import limits_on
from scenewright.program import expressions as ex
from scenewright.program.printer import print_expression
from scenewright.program.types import Actor, Constraint, PieceKind, Program, Sketch
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.proofs.events import EgoBounds, Events
from scenewright.solve.proofs.lowering import Lowering
from scenewright.solve.proofs.refuters import SOLVERS, answer_of

_TIMEOUT_S = 2.0
_FAR = Fraction(10**6)  # what two texts mean does not depend on how far a road goes or how fast a car is
_IDLE = {PieceKind.STOP, PieceKind.GO}


def differences(asked: Program, read: Program) -> list[str]:
    """Return how `read` differs in meaning from `asked`, in sentences.

    Parameters
    ----------
    asked
        What was meant.
    read
        What was understood.

    Examples
    --------
    >>> from scenewright.program.text import parse_program
    >>> from scenewright.study.benchmark import benchmark_row
    >>> text = benchmark_row(1).program_text
    >>> asked = parse_program(text)
    >>> differences(asked, parse_program(text.replace("A1v(t2) == 0", "0 == A1v(t2)")))
    []
    >>> differences(asked, parse_program(text.replace("A1v(t2) == 0", "A1v(t2) == 1")))
    ['lost: A1v(t2) == 0', 'added: A1v(t2) == 1']
    """
    if asked.map_name != read.map_name:
        return [f"another map: {read.map_name} instead of {asked.map_name}"]
    if [actor.is_ego for actor in asked.actors] != [actor.is_ego for actor in read.actors]:
        return [f"{len(read.actors)} actors instead of {len(asked.actors)}"]
    try:
        ours, theirs = (ground(program, load_map(program.map_name)) for program in (asked, read))
    except ScenewrightError as error:
        return [f"it does not fit the map: {error.message}"]
    return _of_actors(ours, theirs) or _of_constraints(ours, theirs)


# -- routes and sketches --------------------------------------------------------------------------------------------
def _of_actors(asked: Scene, read: Scene) -> list[str]:
    found = []
    for actor, other in zip(asked.program.actors, read.program.actors, strict=True):
        wanted, got = asked.routes[actor.id], read.routes[other.id]
        if wanted.lanes != got.lanes:
            headings = (", ".join(route.headings) for route in (got, wanted))
            found.append("{}: route {} instead of {}".format(actor.name, *headings))
        if not _same_story(actor, other):
            ours, theirs = actor.sketch.pieces, other.sketch.pieces
            found.append(f"{actor.name}: {', '.join(theirs)} instead of {', '.join(ours)}")
    return found


def _same_story(actor: Actor, other: Actor) -> bool:
    """Whether one sketch goes on after the other at most with what is nothing new: standing, or driving as it is."""
    ours, theirs = actor.sketch.pieces, other.sketch.pieces
    count = min(len(ours), len(theirs))
    same = ours[:count] == theirs[:count] and _IDLE.issuperset((*ours[count:], *theirs[count:]))
    return actor.is_ego or same  # the ego's pieces are its own affair


def _common(actor: Actor, other: Actor) -> Sketch:
    """Return the longer sketch of two that tell the same story; what only one of them tells binds nobody."""
    shorter, longer = sorted((actor.sketch, other.sketch), key=lambda sketch: len(sketch.pieces))
    count = len(shorter.pieces)
    return Sketch(longer.knots, (*longer.pieces[:count], *(PieceKind.GO for _ in longer.pieces[count:])))


# -- constraints ----------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class _Said:
    """A constraint as its program has it, and in the words of both: knots by position, values for their names."""

    own: Constraint
    formula: ex.Formula


def _of_constraints(asked: Scene, read: Scene) -> list[str]:
    pairs = zip(asked.program.actors, read.program.actors, strict=True)
    sketches = {actor.id: _common(actor, other) for actor, other in pairs}
    ours, theirs = (_said(scene, sketches) for scene in (asked, read))
    both = tuple({said.formula: None for said in ours if said.formula in {said.formula for said in theirs}})
    lost, added = ([said for said in each if said.formula not in both] for each in (ours, theirs))
    if not lost and not added:
        return []
    asking = _Asking(_in_common(asked, read, sketches, both), [*lost, *added])
    told = [f"lost: {_told(asked, said.own)}" for said in lost if not asking.follows(said, added)]
    return told + [f"added: {_told(read, said.own)}" for said in added if not asking.follows(said, lost)]


def _said(scene: Scene, sketches: Mapping[int, Sketch]) -> list[_Said]:
    names: dict[tuple[int, ex.At], ex.At] = {}
    for actor in scene.program.actors:
        own, common = actor.sketch, sketches[actor.id]
        names |= {(actor.id, ex.Knot(a)): ex.Knot(b) for a, b in zip(own.knots, common.knots, strict=False)}
        for name in (*own.piece_names(), *own.pieces):  # a bare kind is its first piece
            piece = common.piece_names()[own.piece_index(name)]
            names[actor.id, ex.PieceRef(name)] = ex.PieceRef(piece)
    return [_Said(each, _reworded(each.formula, names, scene.parameters)) for each in scene.program.constraints]


def _reworded(node: Any, names: Mapping[tuple[int, ex.At], ex.At], values: Mapping[str, Fraction]) -> Any:
    """Return an expression with other names for moments and pieces, and numbers for parameters that have a value."""
    match node:
        case ex.ParameterRef(name=name) if name in values:
            return ex.Number(values[name])
        case ex.Elapsed(actor=actor, knot=knot):
            moment = names[actor, ex.Knot(knot)]
            assert isinstance(moment, ex.Knot)
            return ex.Elapsed(actor, moment.name)
        case ex.State(actor=actor, at=(ex.Knot() | ex.PieceRef()) as at) | ex.Derived(actor=actor, at=ex.Knot() as at):
            return replace(node, at=names[actor, at])
        case tuple():
            return tuple(_reworded(part, names, values) for part in node)
        case _ if is_dataclass(node) and not isinstance(node, type):
            parts = {field.name: _reworded(getattr(node, field.name), names, values) for field in fields(node)}
            return replace(node, **parts)
        case _:
            return node


def _in_common(asked: Scene, read: Scene, sketches: Mapping[int, Sketch], both: Sequence[ex.Formula]) -> Scene:
    """Return a scene that says what both say, with the parameters that have no value in either."""
    open_ones = {each.name: each for scene in (asked, read) for each in scene.open_parameters()}
    program = replace(
        asked.program,
        actors=tuple(replace(actor, sketch=sketches[actor.id]) for actor in asked.program.actors),
        constraints=tuple(Constraint("", formula) for formula in both),
        parameters=tuple(open_ones.values()),
    )
    return replace(asked, program=program, parameters={})


class _Asking:
    """Asks what follows from what is said in a scene, and from more.

    Parameters
    ----------
    more
        All that may be asked about: no moment that one of them speaks of may be missing where another is lowered.
    """

    def __init__(self, scene: Scene, more: Sequence[_Said]) -> None:
        limits = {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}
        events = Events(scene, limits, EgoBounds())
        formulas = [ex.Logic("not", (said.formula,)) for said in more] + [said.formula for said in more]
        constraints = (*scene.program.constraints, *(Constraint("", formula) for formula in formulas))
        lowering = Lowering(events)
        lowering.lower(constraints)  # some of it happens at moments of its own, which the rest is about, too
        lowered = lowering.lower(constraints)
        count = len(scene.program.constraints)
        self._held = dict(zip(formulas, lowered[count:], strict=True))
        self._always = [each.formula for each in (*lowered[:count], *events.rules)] + list(_background(events))
        self._unknowns = [
            replace(each, low=ZERO if each.kind in ("time", "speed") else -_FAR, high=_FAR) for each in events.unknowns
        ]
        self._refuter = SOLVERS.called("z3")

    def follows(self, wanted: _Said, given: Sequence[_Said]) -> bool:
        """Whether `wanted` holds wherever all of `given` do; no answer in time counts as no."""
        denied = self._held[ex.Logic("not", (wanted.formula,))]
        if denied.refused:
            return False
        parts = [*self._always, *(self._held[said.formula].formula for said in given), denied.formula]
        answer = answer_of(self._refuter, self._unknowns, [Named(part, "") for part in parts], _TIMEOUT_S)
        return answer.kind == "refuted"


# -- what holds of all motions ----------------------------------------------------------------------------------------
def _background(events: Events) -> Iterator[Formula]:
    """Yield what holds of all motions: times in order, nobody reverses, and what the pieces themselves say."""
    for actor in events.scene.program.actors:
        knots = [events.knot(actor.id, name) for name in actor.sketch.knots]
        for (before, after), kind in zip(pairwise(knots), actor.sketch.pieces, strict=True):
            yield _one_after_another(events, actor.id, before, after)
            if not actor.is_ego:
                yield from _of_piece(events, actor.id, before, after, kind)
        for one, other in combinations(events.instants_of(actor.id), 2):
            if one not in knots or other not in knots:
                yield _ordered(events, actor.id, one, other)


def _ordered(events: Events, actor: int, one: int, other: int) -> Formula:
    """Return that of two moments one is later, with all that this means, or that they are the same."""
    a, b = events.state(actor, one), events.state(actor, other)
    same = [("==", events.times[one], events.times[other]), ("==", a.place, b.place), ("==", a.speed, b.speed)]
    return some(
        [
            _one_after_another(events, actor, one, other),
            _one_after_another(events, actor, other, one),
            every(compare(*each) for each in same),
        ]
    )


def _one_after_another(events: Events, actor: int, before: int, after: int) -> Formula:
    places = [events.state(actor, instant).place for instant in (before, after)]
    return every([compare("<", events.times[before], events.times[after]), compare("<=", *places)])


def _of_piece(events: Events, actor: int, before: int, after: int, kind: PieceKind) -> Iterator[Formula]:
    a, b = events.state(actor, before), events.state(actor, after)
    match kind:
        case PieceKind.STOP:
            yield every([compare("==", a.place, b.place), compare("==", a.speed, 0), compare("==", b.speed, 0)])
        case PieceKind.DEC:
            yield compare("<", b.speed, a.speed)
        case PieceKind.ACC:
            yield compare(">", b.speed, a.speed)


def _told(scene: Scene, constraint: Constraint) -> str:
    words = scene.program.words_of(constraint)
    text = print_expression(constraint.formula)
    return f"{text} ({words!r})" if words else text
