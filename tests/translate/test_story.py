"""The frame itself: chains of deeds, whose a moment is, and the one order that is compared."""

from __future__ import annotations

from dataclasses import replace

from random_stories import random_story

from scenewright.translate import story as st


def test_arranging_twice_changes_nothing() -> None:
    assert all(st.arranged(story) == story for story in map(random_story, range(50)))


def test_numbers_of_moments_are_only_names() -> None:
    story = st.Story(
        (st.Actor(0, "ego"), st.Actor(1, "hero")),
        (st.Moment(), st.Moment(), st.Moment()),
        deeds=(st.Deed(1, "drive on", 0, 1), st.Deed(1, "brake", 1, 2)),
    )
    other = replace(story, deeds=(st.Deed(1, "brake", 2, 1), st.Deed(1, "drive on", 0, 2)))
    assert story != other
    assert st.arranged(story) == st.arranged(other)
    assert [deed.verb for deed in other.deeds_of(1)] == ["drive on", "brake"]
    assert other.knots_of(1) == (0, 2, 1)
    assert (other.owners(0), other.owners(2)) == ((0, 1), (1,))


def test_what_is_asked_of_whom() -> None:
    gap = st.Measure(2, st.Quantity.GAP, "==", st.Amount(None, "m", "gap_m"), other=1)
    there = st.Measure(2, st.Quantity.PLACE, "==", None, st.Place("conflict_point", 3, 4))
    assert st.people_in(st.Compound("or", (gap, there))) == {1, 2, 3, 4}
    assert [st.is_event(each) for each in (there, gap, replace(there, op=">="))] == [True, False, False]
