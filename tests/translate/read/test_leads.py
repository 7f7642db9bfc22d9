"""When a sentence is: what words and times in front of it lead to."""

from __future__ import annotations

import pytest

from scenewright.translate.read.chunks import sentences
from scenewright.translate.read.leads import leads_of
from scenewright.translate.read.narrative import Narrative
from scenewright.translate.read.sentences import read

MEETS = (
    "The ego drives west. An oncoming hero turns left. When the ego is 25 m before the conflict point, the hero brakes"
)


@pytest.mark.parametrize(
    ("text", "words", "delay", "left"),
    [
        ("Then the hero brakes.", {"then"}, None, 2),
        ("The hero then brakes.", {"then"}, None, 2),
        ("After turning left, the hero brakes.", {"then"}, None, 2),
        ("Initially, the hero brakes.", {"start"}, None, 2),
        ("At the same time, the hero brakes.", {"same time"}, None, 2),
        ("2 s later the hero brakes.", {"then"}, ("==", 2), 2),
        ("At least 2 s after that, the hero brakes.", {"then"}, (">=", 2), 2),
        ("After 2 s, the hero brakes.", {"then"}, ("==", 2), 2),
        ("20 m later the hero brakes.", set(), None, 4),  # what is left over is refused
        ("The hero brakes.", set(), None, 2),
    ],
)
def test_words_in_front(text: str, words: set[str], delay: tuple[str, int] | None, left: int) -> None:
    found = leads_of(Narrative(text), sentences(text)[0])
    assert found.words == words
    assert (found.delay and (found.delay[0], found.delay[1].value)) == delay
    assert len([chunk for chunk in found.chunks if chunk.kind != "comma"]) == left
    assert found.turned == ("left" if "left" in text else "")


@pytest.mark.parametrize(
    ("said", "after"),
    [
        (". Two seconds later it drives on.", "ends"),
        (". Two seconds later a van from the right brakes.", "begins"),
        (". Then a van from the right brakes.", "ends"),
    ],
)
def test_what_a_delay_counts_from_is_asked(said: str, after: str) -> None:
    story = read(f"{MEETS} to a stop{said}")
    first = next(deed for deed in story.deeds if deed.verb == "brake")
    order = next(each for each in story.orders if each.first in (first.begins, first.ends))
    assert order.first == getattr(first, after)
    (question,) = [each for each in story.questions if each.slot.startswith("then")]
    other = next(each for number, each in enumerate(question.alternatives) if number != question.default)
    again = read(f"{MEETS} to a stop{said}", {question.slot: other})
    braked = next(deed for deed in again.deeds if deed.verb == "brake")
    assert any(each.first == getattr(braked, {"ends": "begins", "begins": "ends"}[after]) for each in again.orders)
