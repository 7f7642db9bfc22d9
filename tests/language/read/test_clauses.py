"""What a clause says of its subject: deeds, facts of a way, flags, and amounts that a use gives a unit."""

from __future__ import annotations

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.language.read.attach import read_clause
from scenewright.language.read.chunks import sentences
from scenewright.language.read.facts import Clause
from scenewright.language.read.narrative import Narrative


def clause(text: str) -> Clause:
    (chunks,) = sentences(text)
    return read_clause([chunk for chunk in chunks if chunk.kind not in ("harmless", "comma")], Narrative(text))


def test_deeds_and_flags() -> None:
    assert clause("the hero gently brakes to a stop").flags == {"standstill"}
    assert clause("the hero keeps its speed").flags == {"kept"}
    assert clause("the hero does not give way").flags == {"insists"}
    assert clause("the hero has to go").deed == "drive on"
    assert clause("the hero passes the conflict point").is_event


@pytest.mark.parametrize(
    ("text", "unit"),
    [("the hero brakes at {x}", "m/s^2"), ("the hero drives at {x}", "m/s"), ("the hero's speed is {x}", "m/s"),
     ("the hero is {x} past the stop line", "m"), ("the hero has a headway of {x} to the ego", "s")],
)  # fmt: skip
def test_the_use_of_a_parameter_tells_its_unit(text: str, unit: str) -> None:
    found = clause(text)
    amount = (found.rate or found.measures[0]).amount
    assert amount is not None
    assert (amount.unit, amount.name) == (unit, {"m/s^2": "x_mpss", "m/s": "x_mps", "m": "x_m", "s": "x_s"}[unit])


@pytest.mark.parametrize(
    "text", ["the hero is 12 m/s before the stop line", "the hero brakes with an acceleration of 3 m/s^2",
             "the hero yields to the hero", "the hero is 12 before the stop line"],
)  # fmt: skip
def test_what_does_not_go_together_is_left_over(text: str) -> None:
    with pytest.raises(UnknownWordsError):
        clause(text)
