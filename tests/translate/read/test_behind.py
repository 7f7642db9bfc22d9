"""Who is behind whom where the words for a distance do not say it: as it is told elsewhere, else it is asked."""

from __future__ import annotations

from itertools import product

import pytest

from scenewright.errors import UnknownWordsError
from scenewright.program.printer import print_expression
from scenewright.translate import story as st
from scenewright.translate.compile import compile_story
from scenewright.translate.decompile import decompile
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell
from scenewright.translate.understand import understand

WEST = "The ego drives west. The hero drives west. "
BEHIND = (  # the hero
    "The ego drives west. The hero drives behind it in the same lane.",
    "The ego drives west. The hero drives west behind the ego.",
    "The ego drives west. The hero drives west 30 m behind the ego.",
    "The ego drives west 30 m ahead of the hero. The hero drives west.",
    "The ego drives west. The hero follows the ego at 30 m.",
    "The ego drives west. The hero drives west 2 s behind the ego.",
    "The ego drives west. The hero drives west with a headway of 2 s to the ego.",
    "The ego drives west. The hero drives west 12 m bumper to bumper behind the ego.",
    f"{WEST}At the start, the hero is at least 30 m behind the ego.",
    f"{WEST}At the start, the hero is gap_m behind the ego.",
    f"{WEST}At the start, the hero is 150 m before the stop line and the ego is 100 m before the stop line.",
    f"{WEST}At the start, the hero is 15 m before the intersection and the ego is 15 m past the intersection.",
)
NO_WORD = (  # for who is behind, each with the kind of constraint that it becomes
    ("the gap is 20 m", "gap"),
    ("the distance between them is 20 m", "gap"),
    ("the distance between the ego and the hero is 20 m", "gap"),
    ("the distance to the ego is 20 m", "gap"),
    ("the bumper-to-bumper gap is 15 m", "freespace"),
    ("the headway is 1.5 s", "headway"),
    ("the headway is at least 1 s", "headway"),
    ("the ego's headway is 2 s", "headway"),
    ("the TTC is 3 s", "ttc"),
    ("the ego has a TTC of 3 s with the hero", "ttc"),
    ("the hero has a TTC of 3 s with the ego", "ttc"),
)


def turned(text: str) -> str:
    """Return a text in which ego and hero have changed places, so that the ego is behind."""
    return text.replace("ego", "EGO").replace("hero", "ego").replace("EGO", "hero")


def distances(text: str, *answers: str) -> list[str]:
    """Return what the program of a text says between two, but for the start; `answers` are to all that is asked."""
    found = understand(text)
    if answers:
        found = understand(text, answers=dict(zip((each.slot for each in found.questions), answers, strict=True)))
    told = [print_expression(each.formula) for each in found.program.constraints]
    return [each for each in told if each.startswith(("gap", "freespace", "headway", "ttc")) and "t0" not in each]


@pytest.mark.parametrize("is_turned", [False, True])
@pytest.mark.parametrize(("behind", "when"), [*product(BEHIND, NO_WORD)])
def test_who_is_behind_at_the_start_is_behind_later(behind: str, when: tuple[str, str], is_turned: bool) -> None:
    said, kind = when
    for order in (
        (behind, f" When {said}, the hero brakes to 5 m/s."),
        (behind, f" The hero brakes to 5 m/s when {said}."),
    ):
        start, acts = map(turned, order) if is_turned else order
        text = (start + acts).replace("the ego brakes", "the hero brakes").replace("The ego brakes", "The hero brakes")
        rear, front = ("A0", "A1") if is_turned else ("A1", "A0")
        (found,) = distances(text)
        assert found.startswith(f"{kind}({rear}, {front}, t1)"), text
        assert not [each for each in understand(text).questions if "behind" in each.text]


@pytest.mark.parametrize("said", [said for said, _ in NO_WORD if "has" not in said and "'s" not in said])
@pytest.mark.parametrize(
    "start", ["At the start, the hero is 30 m behind the ego.", "The hero drives behind it in the same lane."]
)
def test_it_may_be_told_after_the_moment(said: str, start: str) -> None:
    (found,) = distances(f"{WEST}When {said}, the hero brakes to 5 m/s. {start}")
    assert "(A1, A0, t1)" in found


@pytest.mark.parametrize(
    "start",
    [
        "",
        "At the start, the hero drives at 12 m/s. ",
        "At the start, the hero is 5 s from the stop line and the ego is 30 m before the stop line. ",
        "At the start, the hero is 60 m before the stop line and the ego is 60 m before the stop line. ",
        "At the start, the hero is at least 60 m before the stop line and the ego is 30 m before the stop line. ",
        "At the start, the hero is 60 m before the stop line and the ego is 30 m before the intersection. ",
    ],
)
def test_what_nothing_tells_is_asked_once(start: str) -> None:
    text = (
        f"{WEST}{start}When the gap is 20 m, the hero brakes to 5 m/s. When the headway is 3 s, it speeds up to 9 m/s."
    )
    (question,) = understand(text).questions
    assert (question.text, question.alternatives) == ("Who drives behind?", ("ego", "hero"))
    assert [each.partition(", t")[0] for each in distances(text, "hero")] == ["gap(A1, A0", "headway(A1, A0"]


@pytest.mark.parametrize(
    "ways",
    [
        "The ego drives west. The hero drives east. ",
        "The ego turns right out of the driveway. The hero drives west. ",
    ],
)
def test_places_of_other_roads_tell_nothing(ways: str) -> None:
    at = "At the start, the hero is 60 m before the stop line and the ego is 30 m before the stop line. "
    questions = understand(f"{ways}{at}When the gap is 20 m, the hero brakes to 5 m/s.").questions
    assert [each.text for each in questions] == ["Who drives behind?"]


@pytest.mark.parametrize(
    "passed",
    [
        "When the hero is 10 m ahead of the ego, the hero brakes to 8 m/s. ",
        "When the ego is 40 m before the stop line, the hero goes first. ",
        "When the ego is 40 m before the stop line, the hero speeds up and passes the stop line before the ego. ",
        "When the hero is 20 m before the stop line, the ego is 40 m before the stop line. The hero drives on. ",
    ],
)
def test_who_has_changed_places_is_asked_about(passed: str) -> None:
    text = (
        f"{WEST}At the start, the hero is 30 m behind the ego. {passed}Later, when the gap is 20 m, it brakes to 5 m/s."
    )
    questions = [each for each in understand(text).questions if each.text == "Who drives behind?"]
    assert [each.alternatives[each.default or 0] for each in questions] == ["ego"]
    assert distances(text)[-1].startswith("gap(A0, A1")


def test_each_two_have_their_own() -> None:
    text = (
        "The ego drives west. A truck drives west 30 m ahead of the ego. A van drives west 30 m behind the ego. When "
        "the gap between the ego and the van is 20 m, the van brakes to 5 m/s. When the headway between the ego and "
        "the truck is 1 s, the truck brakes to a stop."
    )
    assert [each.partition(", A1(")[0].partition(", t")[0] for each in distances(text)] == [
        "gap(A2, A0",
        "headway(A0, A1",
    ]


def test_what_is_told_both_ways_round_is_read_back() -> None:
    for said in ("a TTC of 3 s with", "a headway of 2 s to", "a bumper-to-bumper gap of 9 m to"):
        first = read(
            f"{WEST}At the start, the hero is 30 m behind the ego. When the hero has {said} the ego, it brakes."
        )
        start, moment, *others = first.moments
        (met,) = moment.conditions
        assert isinstance(met, st.Measure)
        other = st.Measure(0, met.quantity, "==", met.amount, other=1)
        moments = (start, st.Moment((other,)), *others)
        story = decompile(compile_story(st.Story(first.actors, moments, (1,), first.deeds)))
        lines = tell(story)
        assert any("behind the hero" in line for line in lines)
        assert st.arranged(read("\n".join(lines))) == st.arranged(story)


@pytest.mark.parametrize("lead", ["Then", "After that,", "Later,", "Finally,", "At that moment,", "Afterwards,"])
@pytest.mark.parametrize("side", ["ahead of the ego", "behind the ego"])
def test_a_side_without_a_distance_is_told_of_the_start_alone(lead: str, side: str) -> None:
    text = f"{WEST}When the ego is 30 m from the intersection, the hero brakes. {lead} the hero is {side}."
    with pytest.raises(UnknownWordsError, match="not clear when this is so"):
        understand(text)
    assert understand(
        f"{WEST}The hero is {side} at the start. When the ego is 30 m from the intersection, it brakes."
    ).program


@pytest.mark.parametrize(
    "said", ["follows it {} behind", "follows {} behind it", "follows the ego, {} behind", "drives {} behind"]
)
@pytest.mark.parametrize(("far", "told"), [("30 m", "gap(A1, A0, t0) == 30"), ("2 s", "headway(A1, A0, t0) == 2")])
def test_behind_may_be_said_without_whom_and_twice(said: str, far: str, told: str) -> None:
    when = "When the ego is 50 m before the intersection, the hero accelerates."
    found = understand(f"The ego drives west. A hero {said.format(far)}. {when}").program.constraints
    assert told in [print_expression(each.formula) for each in found]


@pytest.mark.parametrize(
    ("start", "told"),
    [
        ("The ego drives west at 12 m/s behind a hero.", {"gap(A0, A1, t0) > 0", "A0v(t0) == 12"}),
        ("The ego drives west. A hero drives at 8 m/s ahead of the ego.", {"gap(A0, A1, t0) > 0", "A1v(t0) == 8"}),
        ("The ego drives west. A hero drives in front of it, 35 m away.", {"gap(A0, A1, t0) == 35"}),
    ],
)
def test_how_fast_somebody_is_may_be_said_in_front_of_behind_whom(start: str, told: set[str]) -> None:
    found = understand(f"{start} When the ego is 50 m before the intersection, the hero brakes.").program.constraints
    assert told <= {print_expression(each.formula) for each in found}


@pytest.mark.parametrize("at_once", ["straight away", "right away"])
def test_at_once_is_no_way(at_once: str) -> None:
    text = "The ego drives west. An oncoming car{}. When the ego is 30 m before the intersection, the car brakes {}."
    found, plain = (understand(text.format(" turns left", how)).program for how in (at_once, "immediately"))
    assert [each.formula for each in found.constraints] == [each.formula for each in plain.constraints]
    assert found.actors == plain.actors
