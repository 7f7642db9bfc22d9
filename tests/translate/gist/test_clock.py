"""A time since the start is a trigger of its own."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline

APPROACH = (
    "The ego drives west, going straight. The hero is ahead of it on the road, also going straight west, 40 m ahead of "
    "it at first. "
)


@pytest.mark.parametrize(
    ("told", "seconds"),
    [
        ("Five seconds after the start the hero brakes at 4 m/s^2 to a stop.", "5"),
        ("When 2.5 s have elapsed since the start, the hero brakes at 4 m/s^2 to a stop.", "2.5"),
        ("3 s into the run, it brakes at 4 m/s^2 to a stop.", "3"),
        ("Trigger: 4.0 s after start. The hero brakes at 4 m/s^2 to a standstill.", "4"),
        ("The hero begins to brake 5 s after the start of the test, at 4 m/s^2, and comes to a stop.", "5"),
    ],
)
def test_time_since_the_start(told: str, seconds: str) -> None:
    read = translate_offline(APPROACH + told)
    formulas = {print_expression(each.formula) for each in read.program.constraints}
    assert {f"A1(t1) == {seconds}", "gap(A0, A1, t0) == 40", "A1a(dec) == -4", "A1v(t2) == 0"} <= formulas
    assert not any("clock" in assumed for assumed in read.assumptions)


@pytest.mark.parametrize(
    "told",
    [
        "Five seconds after the start the ego brakes at 4 m/s^2 to a stop.",
        "Trigger: 4.0 s after start. The hero slows to 20 km/h, this speed reached 12 m before the conflict point.",
        "When the clock strikes, the hero brakes to a stop.",
    ],
)
def test_refused(told: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(APPROACH + told)
