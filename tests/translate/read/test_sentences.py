"""The reader: ordinary variation means the same, and what carries meaning is used up, asked about or refused."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from changes import changes
from random_stories import told_stories

from scenewright.errors import ScenewrightError, TranslationError, UnknownWordsError
from scenewright.roads.load import load_map
from scenewright.translate import story as st
from scenewright.translate.read.sentences import read
from scenewright.translate.ways import put_on_map

WAYS = "The ego is headed south and turns left. The hero is headed west and goes straight on. "
PLAIN = WAYS + (
    "At the start, the ego drives at 5 m/s. When the ego is 12 m before the stop line and the hero is 20 m before the "
    "conflict point, the hero begins to brake at 3 m/s^2 until it stands 5 m before the conflict point. Then the hero "
    "stands still for 2 s. Then the hero speeds up until it passes the conflict point. The hero passes the conflict "
    "point before the ego begins to turn."
)
MAP = load_map("t_intersection")
PAGE = (Path(__file__).resolve().parents[3] / "docs" / "english.md").read_text(encoding="utf-8")
VARIED = [
    (plain, varied)
    for plain, several in re.findall(r"^\| `([^`]+)` \| (`.+`) \|$", PAGE, flags=re.MULTILINE)
    for varied in re.findall(r"`([^`]+)`", several)
]
REFUSED = (  # what is said after the ways, and a word of it that the message names
    ("When the ego is 12 from the stop line, the hero begins to brake.", "12"),
    ("When the ego is 12 kg before the stop line, the hero begins to brake.", "kg"),
    ("When the ego is 12 m/s from the stop line, the hero begins to brake.", "stop line"),
    ("The hero does not brake.", "does"),
    ("The hero brakes not.", "not"),
    ("The ego brakes.", "ego"),
    ("The ego goes first.", "first"),
    ("The hero brakes to a stop. The hero is 5 m before the conflict point.", "when"),
    ("When the hero begins to stand still, the hero begins to brake.", "stand still"),
    ("The hero brakes until it stands for a while.", "condition"),
    ("When the ego is 20 m behind the hero and the hero brakes, the hero speeds up.", "told"),
    ("The hero brakes at 8 m/s.", "fast"),
    ("The hero stops. So does the truck.", "does the truck"),
    ("The hero brakes for 3 s to a stop.", "3 s"),
    ("The hero keeps a gap of 20 m to the ego.", "keeps"),
    ("The hero holds at the stop line.", "holds"),
    ("The hero gets to 10 m/s.", "10 m/s"),
    ("The hero is to the left.", "left"),
    ("The hero accelerates when the ego does.", "when the ego does"),
    ("When the ego is at the stop line, the hero, which was braking, accelerates.", "which"),
    ("When the hero keeps its distance, the hero brakes.", "keeps"),
)


def read_or_error(text: str) -> tuple[st.Story | None, TranslationError | None]:
    try:
        return read(text), None
    except TranslationError as error:
        return None, error


@pytest.mark.parametrize(("plain", "varied"), VARIED, ids=[varied[:40] for _, varied in VARIED])
def test_what_the_page_says_is_also_read_means_the_same(plain: str, varied: str) -> None:
    assert plain in PLAIN
    found, meant = (put_on_map(read(text), MAP) for text in (PLAIN.replace(plain, varied), PLAIN))
    assert not found.questions
    assert not found.asides
    assert st.arranged(found) == st.arranged(meant)


@pytest.mark.parametrize(("text", "named"), REFUSED, ids=[text[:40] for text, _ in REFUSED])
def test_what_cannot_be_read_is_refused_or_asked_in_the_words_of_the_text(text: str, named: str) -> None:
    story, error = read_or_error(WAYS + text)
    if error is not None:
        assert named in f"{error.message} {error.found}"
        quoted = re.match(r"'([^']+)' could not", error.message)
        assert quoted is None or quoted[1] in WAYS + text
    else:
        assert story is not None
        assert any(question.default is None and named in question.text for question in story.questions)


def test_a_message_has_its_place() -> None:
    with pytest.raises(UnknownWordsError) as caught:
        read(WAYS + "The hero brakes not.")
    assert str(caught.value).startswith("description:1:91:")


def test_what_is_no_part_of_the_scenario_is_set_aside_and_listed() -> None:
    story = read(f"Hello world!\n{PLAIN}\nLorem ipsum dolor.")
    assert [aside.text for aside in story.asides] == ["Hello world", "Lorem ipsum dolor"]
    assert st.arranged(story) == st.arranged(read(PLAIN))


def test_quotes_are_the_very_words() -> None:
    for moment in read(PLAIN).moments:
        for condition in moment.conditions:
            assert condition.quote is not None
            assert PLAIN[condition.quote.start : condition.quote.end] == condition.quote.text


def test_brakes_alone_is_to_a_standstill_and_told_as_assumed() -> None:
    story = read(WAYS + "The hero brakes.")
    assert story.assumptions == ("hero brakes to a standstill",)
    assert len(story.moments[1].conditions) == 1


def test_who_stops_and_goes_on_has_stood_in_between() -> None:
    story = read(WAYS + "The hero brakes to a stop. Then it speeds up until it drives at 5 m/s.")
    assert [deed.verb for deed in story.deeds] == ["brake", "stand still", "speed up"]
    at_once = read(WAYS + "The hero brakes to a stop. Then at once it speeds up until it drives at 5 m/s.")
    assert [deed.verb for deed in at_once.deeds] == ["brake", "speed up"]


def test_a_text_without_an_ego_is_refused() -> None:
    with pytest.raises(TranslationError, match="who is under test"):
        read("The hero brakes to a stop.")


EVERY = 3  # of so many changes one is tried, beginning with another for each text


def test_every_change_of_meaning_is_noticed() -> None:
    """Of what the teller wrote: one word exchanged changes the story, is asked about, or is refused."""
    for number, (_, lines) in enumerate(told_stories(6)):
        text = "\n".join(lines)
        base = st.arranged(read(text))
        for what, changed in list(changes(text))[number % EVERY :: EVERY]:
            try:
                story = read(changed)
            except ScenewrightError:
                continue
            assert story.questions or st.arranged(story) != base, f"{what}\n{changed}"


def test_what_comes_after_an_event_may_stand_in_front() -> None:
    for text in ("2 s after the ego passes the stop line, the hero brakes.",
                 "The hero brakes 2 s after the ego passes the stop line."):  # fmt: skip
        story = read(WAYS + text)
        ((order,), (driving, braking)) = story.orders, story.deeds
        assert (order.first, order.second, driving.verb) == (story.ego[0], braking.begins, "drive on")
