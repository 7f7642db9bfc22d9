"""Conditions hold up to their tolerance and no further; a verdict is plain data that any reader of JSON takes."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from scenewright.judge.aftermath import Aftermath
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Cause, Condition, Verdict, WayOut, bounded, unjudged
from scenewright.units import Dimension

CALM = Aftermath(None, 3.0, None, None, 1.5, 4.0, None, 20.0)


def off(error: float, dimension: Dimension | None, exact: bool = False) -> Condition:
    return bounded(
        "c1",
        "outcome",
        "stops there",
        required=5.0,
        measured=5.0 + error,
        error=error,
        dimension=dimension,
        exact=exact,
    )


@pytest.mark.parametrize(
    ("dimension", "unit", "tight", "loose"),
    [
        ("length", "m", 0.5, 2.0),
        ("time", "s", 0.1, 0.5),
        ("speed", "m/s", 0.25, 1.0),
        ("acceleration", "m/s^2", 0.25, 1),
    ],
)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_condition_holds_up_to_its_tolerance_on_either_side(
    dimension: Dimension, unit: str, tight: float, loose: float, side: float
) -> None:
    assert off(side * 0.99 * tight, dimension).holds_at(TIGHT)
    assert not off(side * 1.01 * tight, dimension).holds_at(TIGHT)
    assert off(side * 0.99 * loose, dimension).holds_at(LOOSE)
    assert not off(side * 1.01 * loose, dimension).holds_at(LOOSE)
    assert off(0.0, dimension).unit == unit


def test_what_is_exact_has_no_tolerance() -> None:
    assert off(0.0, "time", exact=True).holds_at(TIGHT)
    assert not off(1e-3, "time", exact=True).holds_at(LOOSE)


def test_what_could_not_be_judged_fails_by_any_tolerance_and_says_why() -> None:
    condition = unjudged("c2", "trigger", "is there", "it never was")
    assert condition.normalised_error(LOOSE) == math.inf
    assert (condition.text, condition.as_dict()["tight"]) == ("is there (not judged: it never was)", False)


def test_a_verdict_holds_where_all_its_conditions_do() -> None:
    near, far = off(0.6, "length"), off(0.1, "length")
    verdict = Verdict((near, far), CALM, {})
    assert (verdict.holds_at(TIGHT), verdict.holds_at(LOOSE)) == (False, True)
    assert Verdict((far,), CALM, {}).holds_at(TIGHT)
    assert verdict.condition("c1") is near
    with pytest.raises(KeyError):
        verdict.condition("c9")


def test_a_verdict_is_plain_data_without_infinities() -> None:
    never = bounded("c3", "outcome", "comes", required=3.0, measured=math.inf, error=math.inf, dimension="time")
    ways = (WayOut("gap_m", 12.0, 8.0, "m", "gap_m"),)
    cause = Cause("ego", "the ego was slow", {"least_m": np.float64(3.5), "times_s": (1.0, math.nan)}, ways, 2)
    facts = {"when": {"hero": np.float64(2.5)}, "never": math.inf, "list": [np.float64(1.0), "a"], 3: True}
    data = Verdict((never,), CALM, facts, cause).as_dict()
    assert json.loads(json.dumps(data, allow_nan=False)) == data
    assert data["success"] == {"tight": False, "loose": False}
    assert data["conditions"][0] | {"text": ""} == {
        "id": "c3", "kind": "outcome", "text": "", "required": 3.0, "measured": None, "error": None, "unit": "s",
        "tight": False, "loose": False,
    }  # fmt: skip
    assert data["facts"] == {"when": {"hero": 2.5}, "never": None, "list": [1.0, "a"], "3": True}
    assert data["cause"]["evidence"] == {"least_m": 3.5, "times_s": [1.0, None]}
    assert data["cause"]["would_do"][0]["text"] == "gap_m = 12 instead of 8 m"
    assert Verdict((never,), CALM, {}).as_dict()["cause"] is None


@pytest.mark.parametrize(
    ("would_do", "tried", "words"),
    [
        ((), 0, ""),
        ((), 3, "Other numbers tried: 3; none would do."),
        (
            (WayOut("gap_m", 12.0, 8.0, "m", "gap_m"), WayOut('30 in "30 m before"', 41.5, 30.0, "m")),
            5,
            'It happens with gap_m = 12 instead of 8 m, or with 41.5 m instead of 30 in "30 m before".',
        ),
    ],
)
def test_what_would_do_is_told_in_words(would_do: tuple[WayOut, ...], tried: int, words: str) -> None:
    assert Cause("order", "too late", {}, would_do, tried).way_out() == words
