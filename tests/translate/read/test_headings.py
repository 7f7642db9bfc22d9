"""What a heading says is said of each item of the list below it."""

from __future__ import annotations

import pytest
from readings import reading_of

from scenewright.errors import TranslationError
from scenewright.translate import story as st
from scenewright.translate.read.sentences import read

WAYS = "Ego: headed west, straight on.\nHero: headed west, straight on.\n"
SAID = "At the start, the ego drives at 8 m/s. At the start, the hero drives at 9 m/s. "
WHEN = (
    "When the gap is 20 m and the ego drives at 7 m/s, the hero brakes to a stop. Then the hero stands still for 2 s."
)
LISTS = [  # the same, in lists
    "Initial state:\n- the ego drives at 8 m/s.\n- the hero drives at 9 m/s.\n"
    "Trigger:\n- the gap is 20 m.\n- the ego drives at 7 m/s.\n"
    "Action:\n- the hero brakes to a stop.\n- Then the hero stands still for 2 s.",
    "Initial state:\n1. Ego: drives at 8 m/s\n2. Hero: drives at 9 m/s\n"
    "Trigger:\n1) the gap is 20 m\n2) the ego drives at 7 m/s\n"
    "Action:\n1) The hero brakes to a stop\n2) It then stands still for 2 s",
    "Initial conditions:\n\n* The ego drives at 8 m/s\n\n* The hero drives at 9 m/s\n\n"
    "When:\n\n* the gap is 20 m\n* the ego drives at 7 m/s\n\nThen:\n\n* the hero brakes to a stop\n"
    "* then the hero stands still for 2 s\n",
    "1. Initial state:\n   - the ego drives at 8 m/s\n   - the hero drives at 9 m/s\n"
    "2. Trigger:\n   - when the gap is 20 m\n   - and the ego drives at 7 m/s\n"
    "3. Reaction:\n   - the hero brakes to a stop\n   - then the hero stands still for 2 s",
    "    Initial state:\n    - Ego:\n      - drives at 8 m/s\n    - Hero:\n      - drives at 9 m/s\n"
    "    Trigger:\n    - the gap is 20 m\n    - Ego:\n      - drives at 7 m/s\n"
    "    The hero brakes to a stop. Then the hero stands still for 2 s.",
    "Trigger: when the gap is 20 m and the ego drives at 7 m/s\nAction: the hero brakes to a stop. "
    "Then the hero stands still for 2 s.\nInitial state:\n- The ego drives at 8 m/s.\n- The hero drives at 9 m/s.",
    "Hero:\n- drives at 9 m/s\nEgo:\n- it drives at 8 m/s\n"
    "Trigger:\n- the gap is 20 m.\n- the ego drives at 7 m/s.\nAction: the hero brakes to a stop.\n"
    "Then:\n- the hero stands still for 2 s.",
]


@pytest.mark.parametrize("listed", LISTS)
def test_lists_under_headings_mean_what_sentences_do(listed: str) -> None:
    assert st.arranged(read(WAYS + listed)) == st.arranged(read(WAYS + SAID + WHEN))


def test_a_list_of_somebody_is_of_nobody_else() -> None:
    story = read(f"{WAYS}Ego:\n- drives at 8 m/s.\n- 60 m before the stop line.\nHero: drives at 5 m/s.")
    (start,) = story.moments
    assert [each.actor for each in start.conditions if isinstance(each, st.Measure)] == [0, 0, 1]


def test_quotes_of_items_are_the_very_words() -> None:
    text = WAYS + LISTS[0]
    for moment in read(text).moments:
        for quote in st.within(moment, st.Quote):
            assert text[quote.start : quote.end] == quote.text


def test_an_error_of_an_item_is_placed_at_the_item() -> None:
    with pytest.raises(TranslationError) as caught:
        read(f"{WAYS}Ego:\n- drives at 8 m/s.\n- 60 before the stop line.")
    assert str(caught.value).startswith("description:5:3:")


@pytest.mark.parametrize(
    "text",
    ["Trigger:\nAction:\n- the hero brakes.",
     "Trigger:\n- the gap is 20 m\n- or the ego drives at 5 m/s\nAction: the hero brakes.",
     "Trigger:\n- the gap is 20 m, the hero brakes to a stop\n- the gap is 10 m, the hero speeds up.",
     "Trigger:\n- the gap is 20 m.\n- the hero stops and sings.\nAction:\n- the hero brakes."],
)  # fmt: skip
def test_what_a_heading_cannot_keep_is_not_taken(text: str) -> None:
    assert reading_of(WAYS + text).kind in ("refused", "asked")
