"""A first sentence that sums up the rest is set aside and listed where the rest agrees, else refused."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline

REST = (
    "The ego, coming along the road from the east, is to turn right into the driveway and begins 9 s from the "
    "intersection. Towards it, eastbound, comes a taxi that is to turn left into the driveway. "
)
WHEN = "As soon as the ego is 4 s and the taxi 3 s from the conflict point, "
FIRST = REST + WHEN + "the taxi accelerates and passes the conflict point before the ego begins to turn."
YIELDS = REST + WHEN + "the taxi brakes and stops 7 m before the conflict point."


def formulas(text: str) -> list[str]:
    return [print_expression(each.formula) for each in translate_offline(text).program.constraints]


@pytest.mark.parametrize(
    "lead",
    [
        "A rude one from the planner people's collection.",
        "My boss asked me to check what happens when a taxi cuts in from the other side.",
        "We keep getting complaints about people who drive like that, and here is one of them.",
        "Need a scenario for the planner people.",
        "Validation objective: the ego is not surprised by a taxi that fails to yield.",
        "The purpose of this test is to see how the ego copes with a vehicle that cuts in.",
    ],
)
def test_a_summary_is_set_aside_and_listed(lead: str) -> None:
    read = translate_offline(f"{lead} {FIRST}")
    assert [print_expression(each.formula) for each in read.program.constraints] == formulas(FIRST)
    assert any(lead.rstrip(".")[:40] in each for each in read.assumptions)


@pytest.mark.parametrize(
    "lead",
    [
        "This is the case in which the taxi lets the ego go first.",
        "This one is about a taxi that brakes to a stop.",
        "Here the ego gets past the conflict point first and the taxi second.",
        "I want this in half of the runs only.",
        "This is a scenario with a taxi from the driveway that turns right and goes west.",
        "This scenario only applies when it rains.",
        "The taxi turns right.",
        "A bus drives through at 12 m/s.",
    ],
)
def test_a_summary_of_something_else_is_refused(lead: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(f"{lead} {FIRST}")


def test_a_yielding_hero_may_be_summed_up() -> None:
    read = translate_offline(f"This is a polite taxi that yields to us. {YIELDS}")
    assert [print_expression(each.formula) for each in read.program.constraints] == formulas(YIELDS)
    with pytest.raises(TranslationError):
        translate_offline(f"This is a rude taxi that does not yield. {YIELDS}")
