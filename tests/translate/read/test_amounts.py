"""Nothing that is said of one thing takes the place of something else that is: it is held beside it, or refused."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from random_stories import told_stories
from readings import reading_of

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate import story as st
from scenewright.translate.read.chunks import sentences
from scenewright.translate.read.sentences import read
from scenewright.translate.understand import understand

ALONG = "The ego drives west along the road. The hero is ahead of the ego and goes straight on. "
WHEN = ALONG + "When the gap is 30 m, the hero "
TWO = [  # what is said, and the two amounts that the message names
    ("brakes at 2 m/s^2 to 3 m/s^2.", "2 m/s^2 and 3 m/s^2"),
    ("brakes at 2 m/s^2 at 3 m/s^2.", "2 m/s^2 and 3 m/s^2"),
    ("brakes at 2 m/s^2 and with at most 4 m/s^2.", "2 m/s^2 and 4 m/s^2"),
    ("brakes with at least 4 m/s^2 and at least 6 m/s^2.", "4 m/s^2 and 6 m/s^2"),
    ("brakes at 2 m/s^2 and stops at 3 m/s^2.", "2 m/s^2 and 3 m/s^2"),
    ("brakes for 2 s for 3 s.", "2 s and 3 s"),
    ("waits for 2 s and for 3 s.", "2 s and 3 s"),
    ("speeds up to 5 m/s to 6 m/s.", "5 m/s and 6 m/s"),
    ("accelerates to 30 km/h to 40 km/h.", "30 km/h and 40 km/h"),
    ("speeds up until it drives at 5 m/s to 6 m/s.", "5 m/s and 6 m/s"),
    ("speeds up to 5 m/s until it drives at 6 m/s.", "5 m/s and 6 m/s"),
    ("brakes to 5 m/s to a stop.", "0 m/s and 5 m/s"),
    ("drives on at 5 m/s at 6 m/s.", "5 m/s and 6 m/s"),
    ("drives on, 2 m/s faster than the ego, 3 m/s faster than the ego.", "2 m/s and 3 m/s"),
    ("brakes to a stop 5 m before the junction 6 m before the junction.", "5 m and 6 m"),
    ("brakes until it is 5 m before the junction 3 m past the junction.", "5 m and 3 m"),
]
TWO_FACTS = [
    ("The hero drives at 8 m/s to 10 m/s.", "8 m/s and 10 m/s"),
    ("The hero drives at 8 m/s and at 10 m/s.", "8 m/s and 10 m/s"),
    ("The hero stands at 5 m/s.", "0 m/s and 5 m/s"),
    ("The hero has a deceleration of 1 m/s^2 and of 2 m/s^2.", "1 m/s^2 and 2 m/s^2"),
]
BOUNDS = [  # what is said, and the two constraints
    ("brakes with at least 4 m/s^2 and with at most 6 m/s^2 until it stands.", "A1a(dec) <= -4", "A1a(dec) >= -6"),
    ("slows down with no more than 2 m/s^2 and at least 1 m/s^2.", "A1a(dec) <= -1", "A1a(dec) >= -2"),
    ("speeds up with at least 1 m/s^2 and at most rate_mpss.", "A1a(acc) >= 1", "A1a(acc) <= rate_mpss"),
    ("brakes for at least 6 s and for at most 8 s until it stands.", "A1(t2) - A1(t1) >= 6", "A1(t2) - A1(t1) <= 8"),
    ("brakes for at least 6 s and at most 8 s until it stands.", "A1(t2) - A1(t1) >= 6", "A1(t2) - A1(t1) <= 8"),
    ("speeds up until it drives at at least 8 m/s and at most 10 m/s.", "A1v(t2) >= 8", "A1v(t2) <= 10"),
]
OTHERS = (  # what else was overwritten: the last of two was kept
    WHEN + "brakes until it stands until it passes the junction.",
    WHEN + "brakes at at least about 3 m/s^2.",
    ALONG + "When the gap is less than about 20 m, the hero brakes.",
    ALONG + "The hero has a gap between the ego and a truck of 20 m.",
    ALONG + "When the gap between the ego and the hero between the ego and a truck is 20 m, the hero brakes.",
    WHEN + "stops. After turning left, it then drives on.",
    WHEN + "stops. Then it speeds up for 2 s. Then it brakes. The hero begins to brake for the first time for the "
    "second time 9 s after the ego passes the junction.",
    "Title: one\nTitle: another\n" + ALONG,
    "Parameter gap_m is 20 m.\nParameter gap_m is 30 m.\n" + ALONG + "When the gap is gap_m, the hero brakes.",
    WHEN.replace(", the hero ", ". ") + "The ego drives at 8 m/s. The hero brakes.",  # and the moment was lost
)  # fmt: skip

AMOUNT = re.compile(r"(?:\b(at|with|for|of) )?(?:at least |at most )?\d+(?:\.\d+)? (m/s\^2|m/s|m|s)\b(?! before|/)")
LABELS = ("Title:", "Map:", "Manner:", "Parameter ")


def formulas(text: str) -> list[str]:
    return [print_expression(each.formula) for each in understand(text).program.constraints]


@pytest.mark.parametrize(("text", "both"), [*((WHEN + one, two) for one, two in TWO),
                                            *((ALONG + one, two) for one, two in TWO_FACTS)])  # fmt: skip
def test_two_amounts_for_one_thing_are_refused_by_name(text: str, both: str) -> None:
    reading = reading_of(text)
    assert (reading.kind, reading.told[0]) == ("refused", f"two amounts for one thing: {both}")


@pytest.mark.parametrize(("said", "one", "other"), BOUNDS)
def test_a_lower_and_an_upper_bound_both_hold(said: str, one: str, other: str) -> None:
    assert {one, other} <= set(formulas(WHEN + said))


def test_bounds_are_told_so_that_they_are_read_again() -> None:
    for said, one, other in BOUNDS:
        told = "\n".join(each.sentence for each in understand(WHEN + said).lines)
        assert {one, other} <= set(formulas(told)), told


def test_what_is_said_twice_is_said_once() -> None:
    found = formulas(WHEN + "brakes at 3 m/s^2 and stops at 3 m/s^2.")
    assert found.count("A1a(dec) == -3") == 1


@pytest.mark.parametrize("text", OTHERS, ids=[text[-50:] for text in OTHERS])
def test_nothing_else_is_overwritten(text: str) -> None:
    assert reading_of(text).kind == "refused"


def test_a_bound_that_is_reached_is_that_bound() -> None:
    assert "gap(A0, A1, t1) < 20" in formulas(ALONG + "When the gap drops to less than 20 m, the hero brakes.")


EVERY = 3  # of so many places for a second amount one is tried, beginning with another for each text


def with_one_more(text: str) -> Iterator[str]:
    """Yield a text with a second amount behind each of its amounts."""
    for match in AMOUNT.finditer(text):
        lead = f"{match[1]} " if match[1] else ""
        for more in (f" and {lead}at most", f" {lead}", f" {lead}at least", " to", " and at least"):
            yield f"{text[: match.end()]}{more} 77 {match[2]}{text[match.end() :]}"


def test_a_second_amount_put_in_anywhere_is_in_the_story_or_refused() -> None:
    """Of what the teller wrote: nothing that is said of the first amount is lost either."""
    held = 0
    for number, (_, lines) in enumerate(told_stories(60)):
        told = "\n".join(each for each in lines if not each.startswith(LABELS))
        for text in list(with_one_more(told))[number % EVERY :: EVERY]:
            try:
                story = read(text)
            except TranslationError:
                continue
            if any(each.default is None for each in story.questions):
                continue  # it is asked about
            said = {each.amount for chunks in sentences(text) for each in chunks if each.amount is not None}
            assert said <= set(st.within(story, st.Amount)), text
            held += 1
    assert held > 20
