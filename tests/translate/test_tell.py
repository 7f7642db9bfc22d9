"""What is told has no letters of code, says everything, and says it in time."""

from __future__ import annotations

import re

from random_stories import told_stories

from scenewright.program.text import parse_program
from scenewright.translate.decompile import decompile
from scenewright.translate.phrases import amount
from scenewright.translate.story import Amount, within
from scenewright.translate.tell import tell

TWO = """
Actor 0 (ego):
- W
- [t0, go, t1, go, t2]
Actor 1 (hero):
- E, N
- [t0, go, t1, dec, t2]
Actor 2 (blue_car):
- S, W
- [t0, go, t1, acc, t2]
Constraints:
A0(t1) == A1(t1)
A0x(t1) == conflict_point - 30
A1v(t2) == 0
A2(t1) == A1(t1)
A2x(t2) == A2.conflict_point(A1)
A0x(t2) == A0.conflict_point(A2)
A2(t2) < A0(t2)
"""


def test_every_amount_is_told_and_no_letters_of_code() -> None:
    for story, lines in told_stories(100):
        told = " ".join(lines)
        assert not re.search(r"\bA\d+[xva(.]|==|<=|>=|\bt\d+\b", told), told
        assert all(amount(each) in told or (each.value == 0 and "stands" in told) for each in within(story, Amount))


def test_two_who_begin_at_one_moment() -> None:
    told = tell(decompile(parse_program(TWO)))[3:]
    there = "the conflict point with"
    assert told == [
        f"When the ego is 30 m before {there} the hero, the hero begins to brake until it stands.",
        f"When the hero begins to brake, the car 'blue_car' begins to speed up until it passes {there} the hero.",
        f"The car 'blue_car' passes {there} the hero before the ego passes {there} the car 'blue_car'.",
    ]
