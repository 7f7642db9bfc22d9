"""When a sentence is: what words and times in front of it lead to."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.translate import story as st
from scenewright.translate.read.chunks import sentences
from scenewright.translate.read.leads import leads_of
from scenewright.translate.read.narrative import Narrative
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell

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
    assert found.own == ("turn left" if "left" in text else "")


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


TWO = (
    "The ego turns left out of the driveway. The hero drives west. A van drives east. When the ego is 12 m before the "
    "stop line, the hero brakes to 5 m/s. When the ego is 6 m before the stop line, the van speeds up to 12 m/s. "
)


def test_then_of_who_acted_is_an_order_to_what_another_did_in_between() -> None:
    for lead in ("Then", "Later", "After that,"):
        story = read(f"{TWO}{lead} the hero drives on until it passes the conflict point.")
        van = next(deed for deed in story.deeds if deed.actor == 2 and deed.verb == "speed up")
        (question,) = [each for each in story.questions if each.slot.startswith("then")]
        assert [(each.first, each.second) for each in story.orders] == [(van.ends, story.deeds_of(1)[-1].begins)]
        free = read(f"{TWO}{lead} the hero drives on until it passes the conflict point.",
                    {question.slot: question.alternatives[-1]})  # fmt: skip
        assert not free.orders
        told = tell(free)
        assert st.arranged(read("\n".join(told))) == st.arranged(free)


def test_after_a_deed_of_its_own_is_no_order_to_what_others_did() -> None:
    story = read(f"{TWO}After braking, the hero drives on until it passes the conflict point.")
    assert not story.orders
    assert [deed.verb for deed in story.deeds_of(1)] == ["drive on", "brake", "drive on"]
    for said in ("After speeding up, the hero drives on.", "After stopping, a truck drives on.",
                 "After braking to 4 m/s, the hero drives on."):  # fmt: skip
        with pytest.raises(TranslationError):
            read(TWO + said)
