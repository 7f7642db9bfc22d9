"""Conditions that the sketch itself makes: the hero begins what it should at its trigger, stops, stays, goes again.

What enters: a `Case` and what was measured. What leaves: conditions of kind interaction, and facts about how it was
done.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from scenewright.judge.case import Case
from scenewright.judge.knots import SIGN_OF, Measured, demands_standstill
from scenewright.judge.phases import Phase, move_off_after, phase_at, rest_after
from scenewright.judge.terms import Span
from scenewright.judge.tolerance import TIGHT, Every, Leaf
from scenewright.judge.verdict import Condition, bounded, unjudged
from scenewright.program.types import Actor, PieceKind
from scenewright.translate.phrases import called, does

_VERBS = {PieceKind.DEC: "brake", PieceKind.ACC: "speed up"}


def interaction_conditions(case: Case, measured: Measured) -> list[Condition]:
    """Judge what each sketch says of the order of its moments, and a hero's of all its pieces."""
    conditions = [_in_order(case, measured)]
    for hero in case.program.heroes:
        trigger = case.structure.trigger_knot(hero.id)
        for index, kind in enumerate(hero.sketch.pieces):
            if kind in SIGN_OF and hero.sketch.knots[index] == trigger:
                conditions += _beginning(case, measured, hero, kind)
            elif kind in SIGN_OF:
                conditions += _seen(case, measured, hero, index)
            conditions += _piece(case, measured, hero, index)
    return conditions


def interaction_facts(case: Case, measured: Measured) -> dict[str, Any]:
    """Return how evenly each hero did what began at its trigger."""
    facts: dict[str, Any] = {}
    for hero_id, phase in measured.onsets.items():
        if phase is None:
            continue
        knot = case.structure.trigger_knot(hero_id)
        span = measured.moments.spans.get((hero_id, case.program.actor(hero_id).sketch.knot_index(knot or "")))
        if span is None:
            continue
        timeline = case.timelines[hero_id]
        times = timeline.time_s
        inside = (times[:-1] >= span[0]) & (times[1:] <= min(span[1], phase.end_s))
        speeds = timeline.speed(np.array(span))
        mean = float(speeds[1] - speeds[0]) / max(span[1] - span[0], 1e-9)
        spread = np.abs(timeline.slopes()[inside] - mean)
        facts[case.name(hero_id)] = {
            "onset_s": phase.start_s,
            "end_s": span[1],
            "mean_acceleration_mpss": mean,
            "max_deviation_mpss": float(np.max(spread)) if len(spread) else 0.0,
        }
    return facts


def _in_order(case: Case, measured: Measured) -> Condition:
    """Judge that what a sketch has one after another came so; what never came is judged elsewhere."""
    worst_s, whose = 0.0, ""
    for actor in case.program.actors:
        known = [measured.moments.knots.get((actor.id, knot), np.inf) for knot in actor.sketch.knots]
        times = np.array([time_s for time_s in known if np.isfinite(time_s)], dtype=np.float64)
        late_s = float(np.max(np.maximum.accumulate(times) - times, initial=0.0))
        if late_s > worst_s:
            worst_s, whose = late_s, f" (not what {called(actor.name)} does)"
    text = f"what everybody does comes in the order in which it is told{whose}"
    return bounded("order_of_moments", "outcome", text, required=0.0, measured=worst_s, error=worst_s, dimension="time")


def _beginning(case: Case, measured: Measured, hero: Actor, kind: PieceKind) -> Iterator[Condition]:
    moment, phase, verb = measured.triggers[hero.id], measured.onsets.get(hero.id), _VERBS[kind]
    manner = case.program.manner
    settled_mpss, settled_s = float(manner.settled_mpss), float(manner.settled_s)
    seen = f"by {float(manner.begins_mpss):g} m/s^2 or half of its most, for {float(manner.begins_s):g} s"
    begins = f"{called(hero.name)} begins to {verb} at the trigger ({seen})"
    if phase is None or not np.isfinite(moment):
        reason = f"{called(hero.name)} never began to {verb}" if np.isfinite(moment) else "there was no trigger"
        yield unjudged(f"{hero.name}_onset", "interaction", begins, reason)
        return
    yield bounded(
        f"{hero.name}_onset", "interaction", begins,
        required=moment, measured=phase.start_s, error=phase.start_s - moment, dimension="time",
    )  # fmt: skip
    timeline = case.timelines[hero.id]
    times = timeline.time_s
    until = min(moment, phase.start_s)
    before = (times[:-1] >= until - settled_s) & (times[1:] <= until + 1e-9)
    pull = SIGN_OF[kind] * timeline.slopes()[before]
    worst = max(0.0, float(np.max(pull, initial=0.0)))
    text = f"in the {settled_s:g} s before, {called(hero.name)} does not {verb} by more than {settled_mpss:g} m/s^2"
    unseen_s = max(0.0, settled_s - (phase.start_s - case.start_s))
    if unseen_s > TIGHT.time_s:
        text += f" (of these, {unseen_s:.2f} s are not seen: the run had not begun)"
    over = max(0.0, worst - settled_mpss)
    miss = Every((Leaf(over, "acceleration"), Leaf(unseen_s, "time")))
    yield Condition(f"{hero.name}_settled", "interaction", text, settled_mpss, worst, over, "m/s^2", miss)


def _seen(case: Case, measured: Measured, hero: Actor, index: int) -> Iterator[Condition]:
    """Judge that a piece of braking or speeding up that begins at no trigger is one, from its beginning on."""
    span, manner, timeline = measured.moments.spans.get((hero.id, index)), case.program.manner, case.timelines[hero.id]
    if span is None or _brakes_from_rest(hero, index):
        return  # that it never came to it is told of the piece
    name, verb = hero.sketch.piece_names()[index], _VERBS[hero.sketch.pieces[index]]
    begins_s = float(manner.begins_s)
    text = f"{called(hero.name)} begins to {verb} where it is to, and goes on for {begins_s:g} s, or until it stands"
    phase = _phase_in(case, hero, index, span)
    if phase is None:
        reason = f"{called(hero.name)} did not {verb} then"
        yield unjudged(f"{hero.name}_{name}_onset", "interaction", text, reason)
        return
    late_s = max(0.0, phase.start_s - span[0])
    last_s = min(phase.end_s, span[1])
    stands = float(timeline.speed(np.array([last_s]))[0]) < float(manner.stands_mps) or last_s >= case.end_s - 1e-9
    short_s = 0.0 if stands else max(0.0, begins_s - (last_s - max(phase.start_s, span[0])))
    yield bounded(
        f"{hero.name}_{name}_onset", "interaction", text,
        required=span[0], measured=span[0] + late_s, error=max(late_s, short_s), dimension="time",
    )  # fmt: skip


def _piece(case: Case, measured: Measured, hero: Actor, index: int) -> Iterator[Condition]:
    kind = hero.sketch.pieces[index]
    name, doing = hero.sketch.piece_names()[index], does(kind, hero.sketch.pieces[:index].count(kind))
    span = measured.moments.spans.get((hero.id, index))
    if span is None:
        yield unjudged(f"{hero.name}_{name}", "interaction", f"{called(hero.name)} {doing}", "it never came to it")
        return
    timeline, ends = case.timelines[hero.id], (hero.id, hero.sketch.knots[index + 1])
    if kind in SIGN_OF and not _did(case, measured, hero, index, span):
        reason = f"{called(hero.name)} did not {_VERBS[kind]} then"
        yield unjudged(f"{hero.name}_{name}", "interaction", f"{called(hero.name)} {doing}", reason)
    elif kind in SIGN_OF:
        speeds = timeline.speed(timeline.instants(*span))
        # The largest change against the sense of the piece, between any two of its instants.
        best = np.minimum.accumulate(speeds) if kind is PieceKind.DEC else np.maximum.accumulate(speeds)
        against = float(np.max(np.abs(speeds - best)))
        verb = "speeds up" if kind is PieceKind.DEC else "slows down"
        yield bounded(
            f"{hero.name}_{name}", "interaction", f"{called(hero.name)} never {verb} while it {doing}",
            required=0.0, measured=against, error=against, dimension="speed",
        )  # fmt: skip
    if kind is PieceKind.STOP:
        top = float(np.max(np.abs(timeline.speed(timeline.instants(*span)))))
        yield bounded(
            f"{hero.name}_{name}", "interaction", f"{called(hero.name)} does not move while it {doing}",
            required=0.0, measured=top, error=top, dimension="speed",
        )  # fmt: skip
        if set(hero.sketch.pieces[index + 1 : index + 2]) & {PieceKind.GO, PieceKind.ACC}:
            yield _goes_again(case, hero, span)
    elif kind is PieceKind.DEC and demands_standstill(case, ends, measured.moments.knots):
        yield _stands(case, hero, span[0])


def _did(case: Case, measured: Measured, hero: Actor, index: int, span: Span) -> bool:
    """Whether somebody braked or sped up at all in a piece that is to be that."""
    if hero.sketch.knots[index] == case.structure.trigger_knot(hero.id):
        return measured.onsets.get(hero.id) is not None
    return _brakes_from_rest(hero, index) or _phase_in(case, hero, index, span) is not None


def _brakes_from_rest(hero: Actor, index: int) -> bool:
    """Whether a piece is one of braking behind one of standing: who stands is not asked to brake."""
    return hero.sketch.pieces[max(0, index - 1) : index + 1] == (PieceKind.STOP, PieceKind.DEC)


def _phase_in(case: Case, hero: Actor, index: int, span: Span) -> Phase | None:
    """Return how somebody brakes or speeds up within the span of a piece that is to be that; None where it does not."""
    sign = SIGN_OF[hero.sketch.pieces[index]]
    phase = phase_at(case.timelines[hero.id], span[0], sign, case.program.manner)
    return phase if phase is not None and phase.start_s < span[1] else None


def _stands(case: Case, hero: Actor, since_s: float) -> Condition:
    manner = case.program.manner
    stands_s = float(manner.stands_s)
    who = called(hero.name)
    text = f"{who} comes to a standstill (slower than {float(manner.stands_mps):g} m/s) that lasts {stands_s:g} s"
    rest = rest_after(case.timelines[hero.id], since_s, manner)
    if rest is None:
        return unjudged(f"{hero.name}_standstill", "interaction", text, f"{who} never stood still")
    lasted = rest.end_s - rest.start_s
    to_the_end = rest.end_s >= case.end_s - 1e-9
    return bounded(
        f"{hero.name}_standstill", "interaction", f"{text}, or to the end of the run" if to_the_end else text,
        required=stands_s, measured=lasted, error=0.0 if to_the_end else max(0.0, stands_s - lasted), dimension="time",
    )  # fmt: skip


def _goes_again(case: Case, hero: Actor, span: Span) -> Condition:
    """Judge that somebody moves off where it is to stand no longer."""
    who, manner = called(hero.name), case.program.manner
    text = f"{who} moves off again after standing (faster than {float(manner.stands_mps):g} m/s)"
    moved = move_off_after(case.timelines[hero.id], span[0], manner)
    if moved is None:
        return unjudged(f"{hero.name}_goes_again", "interaction", text, f"{who} stood to the end of the run")
    late_s = max(0.0, moved - span[1])
    return bounded(
        f"{hero.name}_goes_again", "interaction", text, required=span[1], measured=moved, error=late_s, dimension="time"
    )
