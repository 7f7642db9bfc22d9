"""Ways of saying that free texts use: each tells one fact, and what is close to it is not taken for it."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline

OUT = "The AV leaves the driveway with a left turn. A bus goes straight on along the road, westbound. "
IN = "The AV goes west, straight on. An oncoming van is to turn left into the driveway. "
LINE = "The AV goes east along the road, straight on. A van comes out of the driveway and turns left. "
STOPS = "the van brakes and halts just before the stop line"


def formulas(text: str) -> list[str]:
    return [print_expression(each.formula) for each in translate_offline(text).program.constraints]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param(
            OUT + "The AV is 9 s from the stop line at first. Once that time has dropped to 3 s, with the bus 5 s from "
            "the conflict point, the bus brakes and stops 6 m before the conflict point.",
            "tta(A0, stop_line, t1) == 3",
            id="that time",
        ),
        pytest.param(
            OUT + "The AV starts 7 s from the stop line; when it is 2.2 s from there and the bus 3.6 s from the "
            "conflict point, the bus brakes and halts 9 m before the conflict point.",
            "tta(A0, stop_line, t1) == 2.2",
            id="from there",
        ),
        pytest.param(
            OUT + "When the AV's time to the stop line is 2 s and the bus's to the conflict point 3 s, the bus "
            "decelerates, and 8 m before the conflict point it stops.",
            "A1x(t2) == conflict_point - 8",
            id="a place before its verb",
        ),
        pytest.param(
            IN + "When the AV is 40 m (AV) and 22 m (the oncoming van) from the conflict point, the van brakes and "
            "stops 6 m before the conflict point. It stays there and not until the AV has passed the conflict point "
            "does the van move again, to complete its turn.",
            "A1(t3) > A0(t2)",
            id="not until",
        ),
        pytest.param(
            LINE + "When it is 12 m from the stop line and the AV is 45 m from the conflict point, " + STOPS + ".",
            "A1x(t1) == stop_line - 12",
            id="it is the one that is not named",
        ),
        pytest.param(
            LINE + "When the AV is 4 s from the conflict point and the van, then doing 5 m/s, is 2 s from its stop "
            "line, " + STOPS + ".",
            "A1v(t1) == 5",
            id="a speed within the condition",
        ),
        pytest.param(
            LINE + "Being 12 m from the stop line while the AV is 45 m from the conflict point is the van's cue to "
            "brake. It stops just before the stop line.",
            "A1x(t1) == stop_line - 12",
            id="a cue",
        ),
        pytest.param(
            LINE
            + "No sooner is the AV 45 m from the conflict point, with the van 12 m from the stop line, than "
            + STOPS
            + ".",
            "A0x(t1) == conflict_point - 45",
            id="no sooner than",
        ),
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point and the van 12 m from the stop line, the van brakes "
            "to a stop just before the stop line. It waits there for at least 2 s, then it accelerates and passes the "
            "conflict point before the AV does.",
            "A1(t3) - A1(t2) >= 2",
            id="the least wait",
        ),
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point and the van 12 m from the stop line, the van "
            "accelerates and passes the conflict point at least 1.5 s before the AV passes it.",
            "A0(t2) - A1(t2) >= 1.5",
            id="the least margin",
        ),
        pytest.param(
            "Car A, which is the ego, drives east and is to turn left into the driveway. Car B drives west and turns "
            "right into it. When A is 24 m and B 38 m from the conflict point, car B accelerates and passes the "
            "conflict point before car A begins its turn.",
            "A1x(t1) == conflict_point - 38",
            id="A and B",
        ),
        pytest.param(
            "We come out of the driveway and go left. Ahead of us is another car doing the same. The moment we have "
            "closed up to 8 m behind it, it hits the brakes at 4 m/s² until it no longer moves.",
            "gap(A0, A1, t1) == 8",
            id="we and it",
        ),
        pytest.param(
            IN + "When the AV is 4 s (AV) and the van 3 s from the conflict point, the van yields in that it brakes, "
            "and it stops 5 m before that point.",
            "A1x(t2) == conflict_point - 5",
            id="in that",
        ),
        pytest.param(
            LINE + "The AV comes up from 90 m before the intersection. When it is 45 m from the conflict point and the "
            "van 12 m from the stop line, " + STOPS + ".",
            "A0x(t0) == intersection - 90",
            id="comes from a distance",
        ),
        pytest.param(
            LINE + "We start when the AV is 6.5 s from the intersection. When the AV is 45 m from the conflict point "
            "and the van 12 m from the stop line, " + STOPS + ".",
            "tta(A0, intersection, t0) == 6.5",
            id="we start when",
        ),
    ],
)
def test_a_fact_is_read_however_it_is_said(text: str, expected: str) -> None:
    assert expected in formulas(text)


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point, the van, if its driver has noticed the AV by then, "
            "brakes and halts 3 m before the stop line.",
            id="a condition that nobody can see",
        ),
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point, the van is 12 m from the stop line and the AV's "
            "computer has understood the sign, " + STOPS + ".",
            id="one of three conditions",
        ),
        pytest.param(
            LINE + "Trigger: AV 45 m from the conflict point, van 12 m from the stop line. At the trigger the van "
            "brakes to a stop just before the stop line. At the trigger the van accelerates and completes its turn "
            "before the AV passes the conflict point.",
            id="two deeds at one trigger",
        ),
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point and the van 12 m from the stop line, the van brakes "
            "and halts just before the stop line. It simply does not bother to complete its nice turn.",
            id="a denial of the turn",
        ),
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point and the van 12 m from the stop line, the van usually "
            "brakes and halts just before the stop line.",
            id="a habit",
        ),
        pytest.param(
            LINE + "When the AV is 3 s from the conflict point and the van 2 s from its stop line, the van slows down "
            "to a speed of 0.2 g.",
            id="a speed in g",
        ),
        pytest.param(
            LINE + "When the AV is 45 m from the conflict point and the van 12 m from the stop line, the van stops "
            "just before the stop line, 3 m before the stop line.",
            id="two places to stop",
        ),
    ],
)
def test_what_is_only_close_to_it_is_refused(text: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(text)
