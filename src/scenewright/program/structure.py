"""What a program's constraints are for: which knots are one instant, which one is the trigger, which role each plays.

What enters: a `Program`. What leaves: instants (sets of knots at the same moment) and a role for every constraint. It
only reads the structure of the formulas; values and maps play no part.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum

from scenewright.program.expressions import (
    Compare,
    Derived,
    Elapsed,
    Formula,
    Knot,
    Logic,
    Node,
    Number,
    PieceRef,
    State,
    Temporal,
    walk,
)
from scenewright.program.types import EGO, Constraint, PieceKind, Program

KnotKey = tuple[int, str]


class Role(StrEnum):
    """What part a constraint plays in the story."""

    INITIAL = "initial"
    TRIGGER = "trigger"
    INTERACTION = "interaction"
    OUTCOME = "outcome"


@dataclass(frozen=True, slots=True)
class Structure:
    """The reading of one program.

    Attributes
    ----------
    triggers
        For each hero id that has one, the instant at which ego and hero meet the trigger: knots of several actors;
        of a hero alone where the clock decides (``A1(t1) == 5 s``).
    roles
        Role of every constraint, by constraint id.
    instants
        Sets of knots that the program says are the same moment.
    starts
        The first knot of each actor, by actor id: all of them are the start.
    """

    triggers: dict[int, frozenset[KnotKey]]
    roles: dict[str, Role]
    instants: tuple[frozenset[KnotKey], ...]
    starts: dict[int, str]

    def trigger_knot(self, actor_id: int) -> str | None:
        """Return the actor's own knot at its trigger (the ego's: at the first trigger); None where it has none."""
        for hero, instant in self.triggers.items():
            if actor_id in (hero, EGO):
                for owner, knot in sorted(instant):
                    if owner == actor_id:
                        return knot
        return None


def read_structure(program: Program) -> Structure:
    """Find the instants, the triggers and the role of each constraint."""
    instants = _instants(program)
    triggers: dict[int, frozenset[KnotKey]] = {}
    for hero in program.heroes:
        instant = _trigger_of(program, hero.id, instants)
        if instant is not None:
            triggers[hero.id] = instant
    roles = {constraint.id: _role(constraint, program, triggers) for constraint in program.constraints}
    starts = {actor.id: actor.sketch.knots[0] for actor in program.actors}
    return Structure(triggers, roles, tuple(instants), starts)


def knots_of(formula: Node) -> Iterator[KnotKey]:
    """Yield every knot that `formula` speaks of, with the actor it belongs to."""
    for node in walk(formula):
        match node:
            case Elapsed(actor=actor, knot=knot):
                yield actor, knot
            case State(actor=actor, at=Knot(name=knot)) | Derived(actor=actor, at=Knot(name=knot)):
                yield actor, knot
            case _:
                pass


def actors_of(formula: Formula) -> set[int]:
    """Return the ids of all actors that `formula` speaks of."""
    actors = {actor for actor, _ in knots_of(formula)}
    for node in walk(formula):
        if isinstance(node, State | Derived):
            actors.add(node.actor)
        if isinstance(node, Derived) and isinstance(node.target, int):
            actors.add(node.target)
    return actors


def placed_at(program: Program, instant: frozenset[KnotKey]) -> set[int]:
    """Return the actors of whom a program says where they are on the road at an instant.

    How far one is ahead of another says nothing of the kind: who asks for a distance does not ask for contact.
    """
    found: set[int] = set()
    for formula in (constraint.formula for constraint in program.constraints):
        if isinstance(formula, Compare) and formula.operator == "==" and set(knots_of(formula)) <= instant:
            placed = {node.actor for node in walk(formula) if isinstance(node, State) and node.order == 0}
            found |= placed if len(placed) == 1 else set()
    return found


def speeds_told_at(program: Program, instant: frozenset[KnotKey]) -> set[int]:
    """Return the actors of whom a program says how fast they are at an instant, or how fast at most or least."""
    formulas = (constraint.formula for constraint in program.constraints)
    told = [formula for formula in formulas if isinstance(formula, Compare) and set(knots_of(formula)) <= instant]
    return {node.actor for each in told for node in walk(each) if isinstance(node, State) and node.order == 1}


def standstills(program: Program, actor: int) -> set[str]:
    """Return the knots at which a program says that somebody is 0 m/s fast."""
    found = set()
    for formula in (constraint.formula for constraint in program.constraints):
        match formula:
            case Compare("==", State(actor=who, order=1, at=Knot(name=knot)), Number(value=value)) | Compare(
                "==", Number(value=value), State(actor=who, order=1, at=Knot(name=knot))
            ) if who == actor and value == 0:
                found.add(knot)
    return found


def stands_at_end(program: Program, actor: int) -> bool:
    """Whether a program ends with somebody standing: its last piece, or the speed that it is to have there, says so."""
    sketch = program.actor(actor).sketch
    return sketch.pieces[-1:] == (PieceKind.STOP,) or sketch.knots[-1] in standstills(program, actor)


def synchronised(formula: Formula) -> Iterator[tuple[KnotKey, KnotKey]]:
    """Yield the pairs of knots that `formula` says are the same moment."""
    if isinstance(formula, Compare) and formula.operator == "==":
        left, right = formula.left, formula.right
        if isinstance(left, Elapsed) and isinstance(right, Elapsed):
            yield (left.actor, left.knot), (right.actor, right.knot)
    elif isinstance(formula, Logic) and formula.operator == "and":
        for operand in formula.operands:
            yield from synchronised(operand)


def _instants(program: Program) -> list[frozenset[KnotKey]]:
    groups: list[set[KnotKey]] = []
    for constraint in program.constraints:
        for pair in synchronised(constraint.formula):
            touching = [group for group in groups if group & set(pair)]
            merged = set(pair).union(*touching)
            groups = [group for group in groups if not group & merged] + [merged]
    return [frozenset(group) for group in groups]


def _trigger_of(program: Program, hero: int, instants: list[frozenset[KnotKey]]) -> frozenset[KnotKey] | None:
    for knot in program.actor(hero).sketch.knots[1:]:
        found = with_ego(program, instants, hero, knot)
        if found is not None or any(_at_time(each.formula, hero, knot) for each in program.constraints):
            return found or frozenset({(hero, knot)})
    return None


def with_ego(
    program: Program, instants: Iterable[frozenset[KnotKey]], hero: int, knot: str
) -> frozenset[KnotKey] | None:
    """Return the instant of a hero's knot where the ego has one then too, or something is asked of it; else None."""
    for instant in instants:
        if (hero, knot) in instant and any(actor == EGO for actor, _ in instant):
            return instant
    tied = any(_ties_to_ego(each.formula, hero, knot) for each in program.constraints)
    return frozenset({(hero, knot)}) if tied else None


def _ties_to_ego(formula: Formula, hero: int, knot: str) -> bool:
    """Whether `formula` asks for something of the ego at the hero's knot: ``gap(A0, A1, A1(t1)) == 12``."""
    then = Elapsed(hero, knot)
    for node in walk(formula):
        if isinstance(node, State | Derived) and node.actor == EGO and node.at == then:
            return True
        if isinstance(node, Derived) and (node.actor, node.target) == (hero, EGO) and node.at in (Knot(knot), then):
            return True
    return False


def _at_time(formula: Formula, hero: int, knot: str) -> bool:
    """Whether `formula` says when the hero's knot is, since the start: ``A1(t1) == 5 s``."""
    return (
        isinstance(formula, Compare)
        and formula.operator == "=="
        and Elapsed(hero, knot) in (formula.left, formula.right)
        and set(knots_of(formula)) == {(hero, knot)}
    )


def _role(constraint: Constraint, program: Program, triggers: dict[int, frozenset[KnotKey]]) -> Role:
    formula = constraint.formula
    knots = set(knots_of(formula))
    starts = {(actor.id, actor.sketch.knots[0]) for actor in program.actors}
    if knots and knots <= starts:
        return Role.INITIAL
    if list(synchronised(formula)) and any(knots <= instant for instant in triggers.values()):
        return Role.TRIGGER
    if knots and any(knots <= instant for instant in triggers.values()) and not _lasts(formula):
        return Role.TRIGGER
    actors = {actor for actor, _ in knots} | {node.actor for node in walk(formula) if isinstance(node, State | Derived)}
    return Role.OUTCOME if EGO in actors else Role.INTERACTION


def _lasts(formula: Node) -> bool:
    """Whether it speaks of more than a moment: of a whole piece, or of what holds, or comes, within some time."""
    return any(
        isinstance(node, Temporal) or (isinstance(node, State) and isinstance(node.at, PieceRef))
        for node in walk(formula)
    )
