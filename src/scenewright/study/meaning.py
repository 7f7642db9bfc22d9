"""Compares two programs by what they mean: same routes, same story, and constraints that a solver finds equivalent.

What enters: two programs and a map. What leaves: how they differ, in sentences; nothing where they mean the same. It
compares no motion and no layout: knots may be named otherwise, constraints be written in another way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from scenewright.errors import ScenewrightError
from scenewright.motion.algebra import Condition, Symbol, Value, compare, negation, smt
from scenewright.motion.sketched import ONE, Ratio
from scenewright.program.printer import print_expression
from scenewright.program.structure import knots_of, read_structure
from scenewright.program.types import Actor, Constraint, PieceKind, Program, Sketch
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.lowering import Lowering, NotYet
from scenewright.solve.problem import Backend, Problem, Unsatisfiable

_TIMEOUT_S = 2.0


def differences(asked: Program, read: Program, backend: Backend | None = None) -> list[str]:
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
        worlds = [_World.of(_essential(program)) for program in (asked, read)]
    except ScenewrightError as error:
        return [f"it does not fit the map: {error.message}"]
    found = _of_actors(*worlds)
    if found:
        return found
    if backend is None:
        from scenewright.solve.backends.z3_backend import Z3Backend

        backend = Z3Backend()
    return _of_constraints(worlds[0], worlds[1], backend)


# -- what the programs say ------------------------------------------------------------------------------------------
def _essential(program: Program) -> Program:
    """Return `program` without pieces at the end of sketches that nothing speaks of and that say nothing themselves."""
    used: dict[int, set[str]] = {}
    for constraint in program.constraints:
        for actor, knot in knots_of(constraint.formula):
            used.setdefault(actor, set()).add(knot)
    actors = tuple(_trimmed(actor, used.get(actor.id, set()), program) for actor in program.actors)
    return replace(program, actors=actors)


def _trimmed(actor: Actor, used: set[str], program: Program) -> Actor:
    knots, pieces = list(actor.sketch.knots), list(actor.sketch.pieces)
    text = " ".join(print_expression(constraint.formula) for constraint in program.constraints)
    # The ego's pieces are its own affair; a hero that stands at the end, or goes on as it is, does nothing new.
    idle = (PieceKind.STOP, PieceKind.GO)
    while len(pieces) > 1 and pieces[-1] in idle and knots[-1] not in used:
        name = actor.sketch.piece_names()[len(pieces) - 1]
        if f"({name})" in text and not actor.is_ego and pieces[-1] is not PieceKind.STOP:
            break
        pieces.pop()
        knots.pop()
    return replace(actor, sketch=Sketch(tuple(knots), tuple(pieces)))


@dataclass(frozen=True, slots=True)
class _World:
    """One program, on its map, with a name of its own for every unknown that does not depend on how knots are named."""

    scene: Scene
    lowering: Lowering

    @classmethod
    def of(cls, program: Program) -> _World:
        names = {parameter.name: parameter for parameter in program.parameters}
        free = program.with_parameters(tuple(replace(parameter, value=None) for parameter in program.parameters))
        scene = ground(free, load_map(program.map_name))
        views = {actor.id: _Free(actor) for actor in program.actors}
        symbols: dict[str, Value] = {}
        for name, parameter in names.items():
            given = parameter.value
            symbols[name] = Symbol(f"p_{name}") if given is None else given * parameter.unit.si_factor
        return cls(scene, Lowering(scene, read_structure(program), views, symbols))

    def condition(self, constraint: Constraint) -> Condition | None:
        """Return a constraint over the unknowns; None where only its text can be compared."""
        try:
            return self.lowering.condition(constraint.formula)
        except (NotYet, KeyError):
            return None


@dataclass(frozen=True, slots=True)
class _Free:
    """A motion of which nothing is known: an unknown for every state that is spoken of (a `MotionView`)."""

    actor: Actor

    def time(self, knot: str) -> Value | None:
        return Symbol(f"t_{self.actor.id}_{self.actor.sketch.knot_index(knot)}")

    def at_knot(self, knot: str, order: int) -> Ratio | None:
        return Symbol(f"s_{self.actor.id}_{self.actor.sketch.knot_index(knot)}_{order}"), ONE

    def at_time(self, time: Value, order: int) -> Value | None:
        moment = smt(time).translate(str.maketrans("() ./-", "______"))
        return Symbol(f"s_{self.actor.id}_at_{moment}_{order}")

    def on_piece(self, piece: int, order: int) -> Ratio | None:
        return Symbol(f"s_{self.actor.id}_on_{piece}_{order}"), ONE


# -- how they differ ------------------------------------------------------------------------------------------------
def _of_actors(asked: _World, read: _World) -> list[str]:
    found = []
    for actor, other in zip(asked.scene.program.actors, read.scene.program.actors, strict=True):
        wanted, got = asked.scene.routes[actor.id], read.scene.routes[other.id]
        if wanted.lanes != got.lanes:
            headings = (", ".join(route.headings) for route in (got, wanted))
            found.append("{}: route {} instead of {}".format(actor.name, *headings))
        ours, theirs = actor.sketch.pieces, other.sketch.pieces
        if not actor.is_ego and ours != theirs:
            found.append(f"{actor.name}: {', '.join(theirs)} instead of {', '.join(ours)}")
        elif actor.is_ego and len(ours) != len(theirs):
            found.append(f"{actor.name}: {len(theirs)} moments of its own instead of {len(ours)}")
    return found


def _of_constraints(asked: _World, read: _World, backend: Backend) -> list[str]:
    background = _background(asked.scene.program)
    ours, theirs = _conditions(asked), _conditions(read)
    lost = _not_implied(background, theirs, ours, backend)
    added = _not_implied(background, ours, theirs, backend)
    told = [f"lost: {_told(asked, constraint)}" for constraint in lost]
    return told + [f"added: {_told(read, constraint)}" for constraint in added]


_Pairs = Sequence[tuple[Constraint, Condition | None]]


def _conditions(world: _World) -> _Pairs:
    return [(constraint, world.condition(constraint)) for constraint in world.scene.program.constraints]


def _not_implied(background: Sequence[Condition], known: _Pairs, wanted: _Pairs, backend: Backend) -> list[Constraint]:
    """Return what of `wanted` does not follow from `known`."""
    given = [condition for _, condition in known if condition is not None]
    texts = {print_expression(constraint.formula) for constraint, _ in known}
    missing = []
    for constraint, condition in wanted:
        if print_expression(constraint.formula) in texts and condition is None:
            continue
        if condition is None or not (condition in given or _follows([*background, *given], condition, backend)):
            missing.append(constraint)
    return missing


def _follows(given: Sequence[Condition], wanted: Condition, backend: Backend) -> bool:
    """Whether `wanted` holds wherever all of `given` do; no answer in time counts as no."""
    problem = Problem()
    for condition in (*given, negation(wanted)):
        problem.require(condition, "meaning")
    problem.unknowns.extend(_unknowns(problem))
    return isinstance(backend.solve(problem, _TIMEOUT_S), Unsatisfiable)


def _unknowns(problem: Problem) -> list[str]:
    text = " ".join(str(assertion.condition) for assertion in problem.assertions)
    words = text.replace("(", " ").replace(")", " ").split()
    return sorted({word for word in words if word[:2] in ("t_", "s_", "p_")})


def _background(program: Program) -> list[Condition]:
    """Return what holds of all motions: times in order, nobody reverses, and what the pieces themselves say."""
    zero, conditions = Fraction(0), []
    for actor in program.actors:
        view, sketch = _Free(actor), actor.sketch
        for (before, after), kind in zip(pairwise(sketch.knots), sketch.pieces, strict=True):
            x0, v0, x1, v1 = (_state(view, knot, order) for knot in (before, after) for order in (0, 1))
            earlier, later = view.time(before), view.time(after)
            assert earlier is not None
            assert later is not None
            conditions += [compare("<", earlier, later), compare("<=", x0, x1), compare(">=", v0, zero)]
            conditions.append(compare(">=", v1, zero))
            if not actor.is_ego:
                conditions += _of_piece(view, sketch.knot_index(before), kind, (x0, v0), (x1, v1))
    return conditions


def _of_piece(
    view: _Free, piece: int, kind: PieceKind, begin: tuple[Value, Value], end: tuple[Value, Value]
) -> list[Condition]:
    speed, accel = (_on_piece(view, piece, order) for order in (1, 2))
    zero = Fraction(0)
    match kind:
        case PieceKind.STOP:
            still = [compare("==", value, zero) for value in (speed, accel, begin[1], end[1])]
            return [*still, compare("==", begin[0], end[0])]
        case PieceKind.DEC:
            return [compare("<", end[1], begin[1]), compare("<", accel, zero)]
        case PieceKind.ACC:
            return [compare(">", end[1], begin[1]), compare(">", accel, zero)]
        case _:
            return []


def _state(view: _Free, knot: str, order: int) -> Value:
    ratio = view.at_knot(knot, order)
    assert ratio is not None
    return ratio[0]


def _on_piece(view: _Free, piece: int, order: int) -> Value:
    ratio = view.on_piece(piece, order)
    assert ratio is not None
    return ratio[0]


def _told(world: _World, constraint: Constraint) -> str:
    words = world.scene.program.words_of(constraint)
    text = print_expression(constraint.formula)
    return f"{text} ({words!r})" if words else text
