"""Parts of installed packages: listed by entry point, and what they miss is found without importing them."""

from __future__ import annotations

from importlib.metadata import EntryPoint

from scenewright.plugins import missing_extra, named, points

GROUP = "scenewright.nothing_of_this"
OURS = (EntryPoint("plots", "nowhere:nothing [plots]", GROUP), EntryPoint("plain", "nowhere:nothing", GROUP))


def test_our_own_parts_are_there_without_being_registered() -> None:
    found = points(GROUP, OURS)
    assert sorted(found) == ["plain", "plots"]
    assert found["plain"].value == "nowhere:nothing"


def test_a_part_is_found_by_its_name_alone() -> None:
    assert named("plain", GROUP, OURS) is OURS[1]
    assert named("nobody", GROUP, OURS) is None


def test_what_needs_no_extra_misses_none() -> None:
    assert missing_extra(OURS[1], "does nothing") is None


def test_an_extra_is_known_by_what_the_package_says_of_itself() -> None:
    unheard_of = EntryPoint("z", "nowhere:nothing [no-such-extra]", GROUP)
    assert missing_extra(unheard_of, "does nothing") is None, "nothing belongs to an extra that nobody declares"


def test_a_library_of_ours_is_missed_where_no_installer_says_so() -> None:
    ours = EntryPoint("z", "nowhere:nothing [deep]", GROUP)
    missing = missing_extra(ours, "does nothing", {"deep": "no-such-library"})
    assert missing is not None
    assert "no-such-library, which does nothing, is not installed" in str(missing)
    assert 'pip install "scenewright[deep]"' in str(missing)
    assert missing_extra(ours, "does nothing", {"deep": "pytest"}) is None
