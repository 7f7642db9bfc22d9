"""Renders a program in plain English, so that a person can hold it against the description; no model is involved.

What enters: a program, and the scene on its map where there is one. What leaves: sentences, the same ones every time.
Every constraint is in exactly one of them; nothing is said that the program does not hold.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction

from scenewright.program.expressions import Elapsed, Formula
from scenewright.program.printer import print_route
from scenewright.program.structure import KnotKey, Role, Structure, knots_of, read_structure, synchronised
from scenewright.program.types import Actor, Constraint, HeadingsRoute, IntentRoute, Parameter, PieceKind, Program
from scenewright.roads.grounding import Scene
from scenewright.roads.routes import Route
from scenewright.translate.wording import Wording, amount, listed

_COMPASS = {"N": "north", "E": "east", "S": "south", "W": "west"}
_DOES = {
    PieceKind.GO: "drives on",
    PieceKind.ACC: "speeds up",
    PieceKind.DEC: "slows down",
    PieceKind.STOP: "stands still",
}


def read_back(program: Program, scene: Scene | None = None) -> tuple[str, ...]:
    """Return what `program` says, in sentences.

    Examples
    --------
    >>> from scenewright.program.text import parse_program
    >>> text = '''Actor 0 (ego):
    ... - W
    ... - [t0, go, t1]
    ...
    ... Actor 1 (hero):
    ... - W
    ... - [t0, go, t1, dec, t2]
    ...
    ... Constraints:
    ... A0(t1) == A1(t1)
    ... gap(A0, A1, t1) == 20
    ... A1v(t2) == 0
    ... '''
    >>> for sentence in read_back(parse_program(text)):
    ...     print(sentence)
    The ego drives west and goes straight on.
    The hero drives west and goes straight on.
    The moment that counts: the hero is 20 m ahead of the ego.
    From that moment on the hero slows down until it stands still.
    """
    return _Reader(program, scene).sentences()


@dataclass(slots=True)
class _Reader:
    program: Program
    scene: Scene | None
    structure: Structure = field(init=False)
    wording: Wording = field(init=False)
    told: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.structure = read_structure(self.program)
        self.wording = Wording(self.program)

    def sentences(self) -> tuple[str, ...]:
        sentences = [self._route(actor) for actor in self.program.actors]
        sentences += self._parameters()
        sentences += self._beginning()
        sentences += self._triggers()
        for hero in self.program.heroes:
            sentences += self._script(hero)
        sentences += self._outcome()
        rest = [each for each in self.program.constraints if each.id not in self.told]
        sentences += [f"Besides: {self.wording.whole(each.formula)}." for each in self._take(rest)]
        return tuple(sentences)

    def _take(self, constraints: Iterable[Constraint]) -> list[Constraint]:
        """Return those that no sentence holds yet, and note that one does now."""
        taken = [each for each in constraints if each.id not in self.told]
        self.told |= {each.id for each in taken}
        return taken

    # -- before anything happens ------------------------------------------------------------------------------------
    def _route(self, actor: Actor) -> str:
        name = self.wording.name(actor.id)
        if self.scene is not None:
            return f"{_capital(name)} {_way(self.scene.routes[actor.id])}."
        spec = actor.route
        if isinstance(spec, HeadingsRoute):
            first, last = _COMPASS[spec.headings[0]], _COMPASS[spec.headings[-1]]
            after = "goes straight on" if len(spec.headings) == 1 else f"turns, to go {last}"
            return f"{_capital(name)} drives {first} and {after}."
        kind = "wants to go" if isinstance(spec, IntentRoute) else "takes the"
        return f"{_capital(name)} {kind} {print_route(spec)}."

    def _parameters(self) -> list[str]:
        parameters = self.program.parameters
        told = [f"{p.name} is {_in_unit(p, p.value)}" for p in parameters if p.value is not None]
        left = [_left_open(p) for p in parameters if p.value is None]
        sentences = [f"Given: {listed(told)}."] if told else []
        return [*sentences, f"Left open: {listed(left)}."] if left else sentences

    def _beginning(self) -> list[str]:
        mine = [each for each in self.program.constraints if self.structure.roles[each.id] is Role.INITIAL]
        said = [self.wording.clause(each.formula) for each in self._take(mine)]
        return [f"At the start {listed(said)}."] if said else []

    # -- the moment that counts -------------------------------------------------------------------------------------
    def _triggers(self) -> list[str]:
        moments: dict[frozenset[KnotKey], list[int]] = {}
        for hero, instant in self.structure.triggers.items():
            moments.setdefault(instant, []).append(hero)
        sentences = []
        for instant, heroes in moments.items():
            mine = [each for each in self.program.constraints if self._is_at(each, instant)]
            said = [
                self.wording.clause(each.formula)
                for each in self._take(mine)
                if next(synchronised(each.formula), None) is None
            ]
            said += self._delays(instant)
            whose = "" if len(moments) == 1 else " for " + listed([self.wording.name(hero) for hero in heroes])
            sentences.append(f"The moment that counts{whose}: {listed(said) or 'it is not said when'}.")
        return sentences

    def _delays(self, instant: frozenset[KnotKey]) -> list[str]:
        """Return "2 s after the ego is at its stop line", for a moment that comes so long after another."""
        said = []
        for actor, knot in sorted(instant):
            for each in [e for e in self.program.constraints if e.id not in self.told]:
                lasts = self.wording.lasts(each.formula, actor)
                if lasts is not None and lasts[1] == knot and (actor, lasts[0]) not in instant:
                    self._take([each])
                    how_long = self.wording.during(each.formula, PieceKind.GO).removeprefix(" for ")
                    said.append(f"{how_long} after {self._moment(Elapsed(actor, lasts[0]))}")
        return said

    def _is_at(self, constraint: Constraint, instant: frozenset[KnotKey]) -> bool:
        knots = set(knots_of(constraint.formula))
        return self.structure.roles[constraint.id] is Role.TRIGGER and bool(knots) and knots <= instant

    # -- what a hero does -------------------------------------------------------------------------------------------
    def _script(self, hero: Actor) -> list[str]:
        trigger = self.structure.trigger_knot(hero.id) if hero.id in self.structure.triggers else None
        start = hero.sketch.knot_index(trigger) if trigger in hero.sketch.knots else 0
        if start == len(hero.sketch.pieces):
            start = 0  # the trigger is the end of its script: all of the script comes before it
        steps = []
        for index, piece in enumerate(hero.sketch.pieces):
            phrase = self._step(hero, index, piece)
            if index >= start or phrase != _DOES[piece]:
                steps.append(phrase if index >= start else f"{phrase} (before that moment)")
        if not steps:
            return []
        opening = "From that moment on" if start or trigger == hero.sketch.knots[0] else "From the start"
        return [f"{opening} {self.wording.name(hero.id)} {', then '.join(steps)}."]

    def _step(self, hero: Actor, index: int, piece: PieceKind) -> str:
        """Return what happens in one piece and at the knot that ends it."""
        knot = hero.sketch.knots[index + 1]
        name = hero.sketch.piece_names()[index]
        during, at_end = [], []
        for each in self.program.constraints:
            if each.id in self.told:
                continue
            lasts = self.wording.lasts(each.formula, hero.id) == hero.sketch.knots[index : index + 2]
            if lasts or self.wording.is_about_piece(each.formula, hero.id, name, str(piece)):
                during.append(each)
            elif set(knots_of(each.formula)) == {(hero.id, knot)} and not _compares_times(each.formula):
                at_end.append(each)
        text = _DOES[piece]
        for each in self._take(during):
            text += self.wording.during(each.formula, piece)
        until = self.wording.of_one([each.formula for each in self._take(at_end)], hero.id)
        return f"{text} until {until}" if until else text

    # -- how it ends ------------------------------------------------------------------------------------------------
    def _outcome(self) -> list[str]:
        """Return who comes first: the order of two moments, each told by where its vehicle is then."""
        sentences = []
        for each in [e for e in self.program.constraints if e.id not in self.told]:
            order = self.wording.order(each.formula)
            if order is None:
                continue
            first, word, second = order
            self._take([each])
            sentences.append(f"{_capital(self._moment(first))} {word} {self._moment(second)}.")
        return sentences

    def _moment(self, elapsed: Elapsed) -> str:
        """Return "the hero is at the conflict point", from what the program says of that knot."""
        key = (elapsed.actor, elapsed.knot)
        for each in self.program.constraints:
            if set(knots_of(each.formula)) == {key} and self.wording.is_place(each.formula):
                self._take([each])
                return self.wording.clause(each.formula)
        name = self.wording.name(elapsed.actor)
        for hero in self.program.heroes:
            begun = dict(zip(hero.sketch.knots, hero.sketch.pieces, strict=False))
            if hero.id == elapsed.actor and elapsed.knot in begun:
                return f"{name} begins to {_BEGINS[begun[elapsed.knot]]}"
        return f"{name} reaches its {elapsed.knot}"


_BEGINS = {PieceKind.GO: "drive on", PieceKind.ACC: "speed up", PieceKind.DEC: "slow down", PieceKind.STOP: "stand"}


def _compares_times(formula: Formula) -> bool:
    return next(synchronised(formula), None) is not None


def _way(route: Route) -> str:
    first, last = _COMPASS[route.headings[0]], _COMPASS[route.headings[-1]]
    where = "comes out of the driveway" if route.origin_kind == "driveway" else "drives along the road"
    if route.turn == "straight":
        return f"{where}, headed {first}, and goes straight on"
    into = "into the driveway" if route.destination_kind == "driveway" else "onto the road"
    return f"{where}, headed {first}, and turns {route.turn} {into}, headed {last}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _in_unit(parameter: Parameter, value: Fraction) -> str:
    return amount(value * parameter.unit.si_factor, parameter.unit.dimension)


def _left_open(parameter: Parameter) -> str:
    """Return the name of a parameter without a value, with its bounds where it has any of its own."""
    low = None if parameter.low is None else _in_unit(parameter, parameter.low)
    high = None if parameter.high is None else _in_unit(parameter, parameter.high)
    if low is not None and high is not None:
        return f"{parameter.name} from {low} to {high}"
    bound = f" from {low}" if low is not None else f" up to {high}" if high is not None else ""
    return parameter.name + bound
