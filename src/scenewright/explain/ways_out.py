"""What would do: other values of one number with which a run that missed happens after all, each of them tried.

What enters: the scene, how its run was judged, and a way to drive another program or other parameters. What leaves: the
value that led to a success. It reckons nothing out: what is tried first is what was measured, then other values of
each number that what failed, the trigger and the start speak of: more where it is the ego's, for that comes later then,
and less where it is a hero's, which has less to do then; at last the other way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite

from scenewright.judge.tolerance import TIGHT, Tolerance
from scenewright.judge.verdict import Verdict, WayOut
from scenewright.program.expressions import Number
from scenewright.program.structure import Role, actors_of, read_structure
from scenewright.program.types import EGO, Program
from scenewright.roads.grounding import Scene
from scenewright.solve.suggestions import Lever, levers

# No more runs than this, of no more simulated seconds than this in all, nor in each: who waits for an answer waits for
# them, too, and one that waits for a minute is no reason to try none of the others. Measured (docs/evaluation.md): 11
# of 20 runs that missed have a number that would do within 60 s, 15 within 120, 17 within 150.
_TRIES, _ALL_S, _EACH_S = 6, 120.0, 50.0
_ENOUGH = 1  # who waits is helped by one
_SAME = 1e-6  # a number that was written and one that is required of it
# Tried of each number: half and twice it, and a step between; whoever wants the edge asks `check`.
_MORE, _LESS = (Fraction(3, 2), Fraction(2)), (Fraction(2, 3), Fraction(1, 2))

Drive = Callable[[Program, Mapping[str, float], Callable[[float], None]], bool]


class _LongEnough(Exception):  # noqa: N818 - the end of a try, not an error
    """All that may be simulated in it has been."""


@dataclass(frozen=True, slots=True)
class _Trial:
    """Another value of a lever, in the unit that the user knows it in."""

    lever: Lever
    value: Fraction

    @property
    def is_parameter(self) -> bool:
        return self.lever.number is None

    def way_out(self) -> WayOut:
        name = self.lever.name if self.is_parameter else None
        instead_of = float(self.lever.value / self.lever.si_factor)
        return WayOut(self.lever.what, float(self.value), instead_of, self.lever.unit, name)

    def in_si(self) -> Fraction:
        return self.value * self.lever.si_factor


def ways_out(
    scene: Scene, verdict: Verdict, tolerance: Tolerance, succeeds: Drive, report: Callable[[str], None]
) -> tuple[tuple[WayOut, ...], int]:
    """Return other values of single numbers with which it happens, and how many were tried.

    Parameters
    ----------
    verdict
        With the run's cause: what it names is varied first.
    succeeds
        Drives a program with some parameters set (in their own units) with the same ego and seed, and returns whether
        it was judged a success. It is given what to call with the simulated time as it goes on. Who interrupts it
        wants no more tries.
    report
        Called with what is tried next.
    """
    found: dict[str, WayOut] = {}
    tries, driven_s, last_s = 0, 0.0, 0.0

    def goes_on(time_s: float) -> None:
        nonlocal driven_s, last_s
        driven_s, last_s = driven_s + max(0.0, time_s - last_s), time_s
        if driven_s > _ALL_S or time_s > _EACH_S:
            raise _LongEnough

    for trial in _trials(scene, verdict, tolerance):
        if tries >= _TRIES or len(found) >= _ENOUGH or driven_s > _ALL_S:
            break
        program = trial.lever.put(scene.program, Number(trial.in_si()))
        if trial.lever.what in found or not (trial.is_parameter or program != scene.program):
            continue
        report(f"trying what would do: {trial.way_out()}")
        try:
            happens = succeeds(program, {trial.lever.name: float(trial.value)} if trial.is_parameter else {}, goes_on)
        except _LongEnough:
            continue
        tries += 1
        if happens:
            found[trial.lever.what] = trial.way_out()
    return tuple(found.values()), tries


def _trials(scene: Scene, verdict: Verdict, tolerance: Tolerance) -> Iterator[_Trial]:
    """Yield values to try, those first that are nearest to what was seen."""
    roles = read_structure(scene.program).roles
    failed = [each.id for each in verdict.conditions if not each.holds_at(tolerance)]
    told = [constraint.id for constraint in scene.program.constraints]
    named = verdict.cause.evidence.get("condition") if verdict.cause is not None else None
    if named is not None and named not in told:  # what is owed in any run no number of the program asks for
        return
    groups: list[Sequence[str]] = [
        [name for name in told if name == named],
        [name for name in told if name in failed],
        [name for name in told if roles[name] is Role.TRIGGER],
        [name for name in told if roles[name] is Role.INITIAL],
    ]
    known: dict[str, tuple[Lever, bool]] = {}
    for name in dict.fromkeys(name for group in groups for name in group):
        of_ego = EGO in actors_of(scene.program.constraint(name).formula)
        if of_ego or named is None:  # where it is the ego's doing no hero's number helps
            for lever in levers(scene, [name]):
                known.setdefault(lever.what, (lever, of_ego))
    seen: set[tuple[str, Fraction]] = set()
    shares = [*zip(_MORE, _LESS, strict=True), *zip(_LESS, _MORE, strict=True)]
    steps = [
        (lever, lever.value * (egos if of_ego else heros)) for egos, heros in shares for lever, of_ego in known.values()
    ]
    for lever, value in [*_measured(scene, verdict, failed), *steps]:
        trial = _readable(lever, value)
        key = (lever.what, trial.value)
        if trial.value * lever.value > 0 and trial.in_si() != lever.value and key not in seen:
            seen.add(key)
            yield trial


def _measured(scene: Scene, verdict: Verdict, failed: Sequence[str]) -> Iterator[tuple[Lever, Fraction]]:
    """Yield what was measured for numbers that were required, what was named first; else what was off, either way."""
    named = verdict.cause.evidence if verdict.cause is not None else {}
    conditions = {condition.id: condition for condition in verdict.conditions if condition.id in failed}
    if not all(verdict.facts["trigger_came"].values()):  # of one that never came only how near two came to it says much
        both = {each.id for each in scene.program.constraints if len(actors_of(each.formula)) > 1}
        conditions = {name: each for name, each in conditions.items() if each.kind != "trigger" or name in both}
    for name in sorted(conditions, key=lambda name: name != named.get("condition")):
        condition = conditions[name]
        for lever in levers(scene, [name]):
            if condition.required is not None and condition.measured is not None and isfinite(condition.measured):
                for sign in (1, -1):  # a rate of slowing down is often written without its sign
                    if abs(sign * float(lever.value) - condition.required) < _SAME:
                        yield lever, Fraction(sign * condition.measured)
            elif name == named.get("condition"):
                off = named.get("off") or TIGHT.of(lever.dimension) * (named.get("off_tolerances") or 0.0)
                for sign in (1, -1) if isfinite(off) else ():
                    yield lever, lever.value + sign * Fraction(off)


def _readable(lever: Lever, value: Fraction) -> _Trial:
    """Return a value (SI) as people would write it, in the unit that they know it in."""
    inside = value / lever.si_factor
    digits = 1 if abs(inside) >= 1 else 2
    return _Trial(lever, Fraction(round(inside * 10**digits), 10**digits))
