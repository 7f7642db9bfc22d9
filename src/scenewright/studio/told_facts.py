"""What else a verdict knows of a run, in sentences.

What enters: the facts of a `verdict.json`, of which any may be missing. What leaves: sentences, each with the moment
that it speaks of (s).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from scenewright.translate.phrases import called
from scenewright.units import in_tenths

Told = tuple[str, float | None]
_STEADY_MPSS = 0.005  # what is less reads as nothing


def told_facts(facts: Mapping[str, Any]) -> list[Told]:
    """Return the sentences: triggers, manoeuvres, pairs, then how the ego moved."""
    return [
        *_triggers(facts),
        *_manoeuvres(facts.get("interaction") or {}),
        *(told for pair, values in (facts.get("pairs") or {}).items() for told in _pair(pair, values)),
        *(told for name, values in (facts.get("kinematics") or {}).items() for told in _motion(name, values)),
    ]


def _triggers(facts: Mapping[str, Any]) -> Iterator[Told]:
    came = facts.get("trigger_came") or {}
    for hero, time_s in (facts.get("trigger_time_s") or {}).items():
        moment = _number(time_s)
        if moment is None:
            yield f"The trigger of {called(hero)} never came.", None
        elif came.get(hero, True):
            yield f"The trigger of {called(hero)} came at {moment:.2f} s.", moment
        else:
            yield f"The trigger of {called(hero)} never came; it was nearest at {moment:.2f} s.", moment
    for side in facts.get("closest") or ():
        error, moment = _number(side.get("error")), _number(side.get("time_s"))
        if error is None or moment is None:
            continue
        off = f"came to within {in_tenths(abs(error))} {side.get('unit') or ''}".rstrip()
        there = "was there" if len(side.get("actors") or ()) < 2 else "were there"
        held = there if side.get("met") else off
        names = [str(name) for name in side.get("actors") or [side.get("who")]]
        alone = "by itself" if len(names) == 1 else "together"
        yield f"{_people(names)}, {alone}, {held}: {side.get('side')}.", moment
    apart = _number(facts.get("trigger_sides_apart_s"))
    if apart is not None and not all(came.values()):  # who was there at the trigger may have been there before, too
        yield f"All that a trigger waits for was there, but not at once: {apart:.2f} s apart.", None


def _manoeuvres(interaction: Mapping[str, Any]) -> Iterator[Told]:
    for hero, values in interaction.items():
        onset, end = _number(values.get("onset_s")), _number(values.get("end_s"))
        mean, deviation = (_number(values.get(f"{name}_mpss")) for name in ("mean_acceleration", "max_deviation"))
        if onset is None or end is None:
            yield f"{_people([hero])} was not seen to begin what it was to do.", None
            continue
        steady = deviation is not None and deviation < _STEADY_MPSS
        even = "" if deviation is None else " throughout" if steady else f" (at most {deviation:.2f} m/s² from that)"
        at = "at" if steady else "on average at"
        rate = "" if mean is None else f", {at} {mean:.2f} m/s²{even}".replace("-", "−")
        yield f"{_people([hero])} did what it was to do from {onset:.2f} to {end:.2f} s{rate}.", onset


def _pair(pair: str, values: Mapping[str, Any]) -> Iterator[Told]:
    two = _people(pair.split(", "))
    crash, moment = _number(values.get("collision_time_s")), _number(values.get("min_distance_time_s"))
    nearest = _number(values.get("min_distance_m"))
    if crash is not None:
        yield f"{two} collided at {crash:.2f} s.", crash
    elif nearest is not None:
        apart = f"within {in_tenths(nearest)} m of each other, body to body"
        yield f"{two} came {apart}, and never touched.", moment
    least, when = _number(values.get("min_ttc_s")), _number(values.get("min_ttc_time_s"))
    yield (
        (f"Their time to collision was {in_tenths(least)} s at least.", when)
        if least is not None
        else (
            "They were never within 8 s of a collision, as their motion stood.",
            None,
        )
    )
    after = _number(values.get("post_encroachment_time_s"))
    if after is not None:
        yield f"One came to a place that the other had been at {in_tenths(after)} s after that had left it.", None


def _motion(name: str, values: Mapping[str, Any]) -> Iterator[Told]:
    seen = {key: number for key, value in values.items() if (number := _number(value)) is not None}
    if {"speed", "acceleration", "deceleration", "lateral"} <= seen.keys():
        yield (
            f"At most {called(name)} drove at {seen['speed']:.1f} m/s, "
            f"sped up by {max(0.0, seen['acceleration']):.1f} m/s², "
            f"braked by {max(0.0, -seen['deceleration']):.1f} m/s², and felt {seen['lateral']:.1f} m/s² sideways.",
            None,
        )
    if {"position_drift", "map_drift", "speed_jump"} <= seen.keys():
        drift_mm = 1000.0 * max(seen["position_drift"], seen["map_drift"])
        yield (
            f"Its trace agrees with itself: places, speeds and the map to {drift_mm:.1f} mm, "
            f"speeds and accelerations to {1000 * seen['speed_jump']:.1f} mm/s.",
            None,
        )


def _people(names: Sequence[str]) -> str:
    """Return what people are called, at the beginning of a sentence."""
    told = " and ".join(map(called, names))
    return told[:1].upper() + told[1:]


def _number(value: object) -> float | None:
    """Return a finite number, None for anything else."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value) if math.isfinite(value) else None
