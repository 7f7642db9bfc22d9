"""Parts of installed packages: listed by entry point, and what they miss is found without importing them."""

from __future__ import annotations

import sys
from importlib.metadata import EntryPoint

import pytest

from scenewright.errors import InputError, MissingExtraError, ScenewrightError
from scenewright.plugins import Kind, missing_extra, named, points

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


# -- kinds ------------------------------------------------------------------------------------------------------------
class PlotError(ScenewrightError):
    """The fault of a plot."""


class Can:
    """What a plot says that it can do."""

    def words(self) -> str:
        return "lines"


class Plot:
    capabilities = Can()

    def draw(self) -> None:
        raise ZeroDivisionError("no\npaper")


def kind(**points: str) -> Kind[Plot]:
    return Kind(GROUP, points, "plot", "draws", PlotError, Can, {"deep": "no-such-library"})


def test_parts_of_a_kind_are_listed_with_what_they_miss_and_made_by_name() -> None:
    plots = kind(line="test_plugins_plot:Plot", deep="nowhere:nothing [deep]")
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "test_plugins_plot", sys.modules[__name__])
        assert isinstance(plots.called("LINE"), Plot)
        assert plots.called("line") is not plots.called("line")
    known = plots.known()
    assert known["line"] is None
    assert "no-such-library, which draws" in str(known["deep"])
    with pytest.raises(MissingExtraError):
        plots.called("deep")


def test_a_part_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(InputError, match=r"no such plot(.|\n)*line, pie(.|\n)*scenewright plots lists them"):
        kind(line="nowhere:a", pie="nowhere:b").called("bar")


def test_a_part_that_cannot_be_imported_is_a_fault_of_its_kind() -> None:
    with pytest.raises(PlotError, match="'line' cannot be imported") as broken:
        kind(line="nowhere:nothing").called("line")
    assert "No module named 'nowhere'" in str(broken.value.found)


class SaysNothing(Plot):
    capabilities = None


class Leaves(Plot):
    def __init__(self) -> None:
        raise SystemExit(3)


def test_one_that_is_wrong_is_listed_with_what_is_wrong_beside_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "test_plugins_plot", sys.modules[__name__])
    offered = {name.lower(): f"test_plugins_plot:{name}" for name in ("Plot", "SaysNothing", "Leaves")}
    told = kind(**offered, deep="nowhere:nothing [deep]").words()
    assert told["plot"] == "lines"
    assert told["saysnothing"] == "the plot 'saysnothing' does not say what it can do: None"
    assert told["leaves"].startswith("the plot 'leaves' cannot be imported: SystemExit: 3 (line ")
    assert "no-such-library" in told["deep"]


def test_whose_fault_it_is_is_told() -> None:
    with pytest.raises(PlotError, match="the plot Plot failed") as broken, kind().blamed(Plot()):
        Plot().draw()
    assert str(broken.value.found).startswith("ZeroDivisionError: no (line ")
    with pytest.raises(PlotError, match="the plot Plot failed"), kind().blamed(Plot()):
        raise SystemExit(3)
    with pytest.raises(InputError), kind().blamed(Plot()):
        raise InputError("is told already")
    with pytest.raises(KeyboardInterrupt), kind().blamed(Plot()):
        raise KeyboardInterrupt
