"""What the page needs of a program: clauses of the description, the moment each condition is about, the triggers.

What enters: a resolved `Program`, the times at which knots were really passed, the landmarks. What leaves: plain data
for the page. It judges nothing: required and measured values come from the verdict.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any

from scenewright.program import expressions as ex
from scenewright.program.structure import Role, knots_of, read_structure
from scenewright.program.types import EGO, Program

Json = dict[str, Any]
KnotTimes = Mapping[str, Mapping[str, float]]
Landmarks = Mapping[str, Mapping[str, float]]


def clauses(program: Program) -> list[Json]:
    """Cut the description into stretches; each names the conditions that came from it.

    Returns
    -------
    list of dict
        ``{"text": str, "ids": [constraint id, ...]}``; the texts joined give the description back.
    """
    description = program.description or ""
    sources = [(c.id, c.source) for c in program.constraints if c.source is not None]
    cuts = {0, len(description)}
    for _, source in sources:
        cuts |= {min(source.start, len(description)), min(source.end, len(description))}
    edges = sorted(cuts)
    return [
        {
            "text": description[start:end],
            "ids": [identifier for identifier, source in sources if source.start <= start and end <= source.end],
        }
        for start, end in pairwise(edges)
    ]


def condition_times(program: Program, knot_times: KnotTimes) -> dict[str, float]:
    """Return for each constraint the moment it is about (s), by constraint id, where the run reached it.

    Of several knots the last one counts: an order is decided when the later of the two happens.
    """
    found = {}
    for constraint in program.constraints:
        moments = list(_moments(constraint.formula, program, knot_times))
        if moments:
            found[constraint.id] = max(moments)
    return found


def triggers(program: Program, knot_times: KnotTimes, landmarks: Landmarks) -> list[Json]:
    """Return the trigger moments that the run reached, with the distances that define them.

    Returns
    -------
    list of dict
        ``{"time_s", "hero", "measures"}``, by time. A measure is ``{"kind", "actor", "name", "s_m"}``, with kind
        ``"landmark"`` or ``"tta"`` (from the actor to a place on its route), or ``{"kind": "gap", "actor", "target"}``.
    """
    structure = read_structure(program)
    names = {actor.id: actor.name for actor in program.actors}
    result = []
    for hero, instant in structure.triggers.items():
        passed = [_knot_time(names.get(actor), knot, knot_times) for actor, knot in sorted(instant)]
        times = [time for time in passed if time is not None]
        if not times:
            continue
        measures = []
        for constraint in program.constraints:
            if structure.roles[constraint.id] == Role.TRIGGER and set(knots_of(constraint.formula)) <= instant:
                measures += list(_measures(constraint.formula, names, landmarks))
        result.append({"time_s": max(times), "hero": names[hero], "measures": measures})
    return sorted(result, key=lambda trigger: float(trigger["time_s"]))


def places(program: Program) -> dict[str, list[str]]:
    """Return the landmarks that the program speaks of, by the name of the actor on whose route they lie."""
    names = {actor.id: actor.name for actor in program.actors}
    found: dict[str, list[str]] = {name: [] for name in names.values()}
    for constraint in program.constraints:
        for mark in (node for node in ex.walk(constraint.formula) if isinstance(node, ex.Landmark)):
            if mark.actor in names and (name := _name(mark, names)) not in found[names[mark.actor]]:
                found[names[mark.actor]].append(name)
    return found


def _name(mark: ex.Landmark, names: Mapping[int, str]) -> str:
    """Return what the manifest calls a landmark: a conflict with another than the usual partner has its name beside."""
    usual = min((actor for actor in names if actor != EGO), default=None) if mark.actor == EGO else EGO
    return mark.name if mark.other in (None, usual) else f"{mark.name}({names.get(mark.other)})"


def _moments(formula: ex.Formula, program: Program, knot_times: KnotTimes) -> Iterator[float]:
    names = {actor.id: actor.name for actor in program.actors}
    for actor, knot in knots_of(formula):
        time = _knot_time(names.get(actor), knot, knot_times)
        if time is not None:
            yield time
    for node in ex.walk(formula):
        match node:
            case ex.State(actor=owner, at=ex.PieceRef(name=piece)) if owner in names:
                sketch = program.actor(owner).sketch
                try:
                    begins = sketch.knots[sketch.piece_index(piece)]
                except KeyError:
                    continue
                time = _knot_time(names[owner], begins, knot_times)
                if time is not None:
                    yield time
            case ex.State(at=ex.Number(value=value)) | ex.Derived(at=ex.Number(value=value)):
                yield float(value)
            case ex.Temporal(start=ex.Number(value=value)):
                yield float(value)
            case _:
                pass


def _knot_time(actor: str | None, knot: str, knot_times: KnotTimes) -> float | None:
    time = knot_times.get(actor or "", {}).get(knot)
    return float(time) if isinstance(time, int | float) else None


def _measures(formula: ex.Formula, names: Mapping[int, str], landmarks: Landmarks) -> Iterator[Json]:
    for node in ex.walk(formula):
        match node:
            case ex.Compare(left=left, right=right):
                yield from _distance(left, right, names, landmarks)
                yield from _distance(right, left, names, landmarks)
            case ex.Derived(kind="tta", actor=actor, target=ex.Landmark() as mark) if actor in names:
                s_m = _arc_length(mark, actor, names, landmarks)
                if s_m is not None:
                    yield {"kind": "tta", "actor": names[actor], "name": mark.name, "s_m": s_m}
            case ex.Derived(actor=actor, target=int(target)) if {actor, target} <= set(names):
                yield {"kind": "gap", "actor": names[actor], "target": names[target]}
            case _:
                pass


def _distance(state: ex.Node, place: ex.Node, names: Mapping[int, str], landmarks: Landmarks) -> Iterator[Json]:
    """Yield the measure of ``A0x(t1) == stop_line - p``, where that is what is compared."""
    if not isinstance(state, ex.State) or state.order != 0 or state.actor not in names:
        return
    if not isinstance(state.at, ex.Knot | ex.Elapsed) or not isinstance(place, ex.Landmark | ex.Arithmetic):
        return
    marks = [node for node in ex.walk(place) if isinstance(node, ex.Landmark)]
    if len(marks) == 1 and (s_m := _arc_length(marks[0], state.actor, names, landmarks)) is not None:
        yield {"kind": "landmark", "actor": names[state.actor], "name": marks[0].name, "s_m": s_m}


def _arc_length(mark: ex.Landmark, actor: int, names: Mapping[int, str], landmarks: Landmarks) -> float | None:
    if mark.actor not in (None, actor):
        return None  # it lies on another actor's route: there is no stretch of this route to draw
    known = landmarks.get(names[actor], {})
    # In a program `turn` means the same place as `intersection`.
    aliases = (mark, replace(mark, name="intersection")) if mark.name == "turn" else (mark,)
    place = next((known[name] for name in (_name(alias, names) for alias in aliases) if name in known), None)
    return float(place) if isinstance(place, int | float) else None
