"""What is a deed: driving told behind other deeds is one, coming to the junction is none at the start."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.types import EGO
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell

BRAKES = (
    "The ego drives west. An oncoming hero turns left. "
    "When the ego is 30 m before the conflict point, the hero brakes to 3 m/s. "
)
JOINS = "The ego turns left out of the driveway. The hero drives west. "
WHEN = JOINS + "When the ego is 12 m before the stop line, the hero "


def verbs(text: str) -> list[str]:
    """Return what the hero does, its way up to its trigger first."""
    return [str(deed.verb) for deed in read(text).deeds_of(1)]


@pytest.mark.parametrize("said", ["Then it drives.", "Then it approaches the intersection.", "Then it moves."])
def test_who_is_told_to_drive_then_drives_on(said: str) -> None:
    """It was read and held by nothing."""
    assert verbs(BRAKES + said) == ["drive on", "brake", "drive on"]


def test_how_somebody_drives_at_the_start_is_no_deed() -> None:
    assert verbs(BRAKES.replace("hero turns", "hero drives and turns")) == verbs(BRAKES) == ["drive on", "brake"]


@pytest.mark.parametrize("way", ["approaches the intersection from the north", "approaches a junction southbound"])
def test_who_approaches_the_junction_drives_there(way: str) -> None:
    story = read(f"The ego {way} and turns left. " + BRAKES.split(". ", 1)[1].replace("An oncoming hero", "A hero"))
    ego = next(each for each in story.actors if each.id == EGO)
    assert (ego.way.heading, ego.way.turn) == ("S", "left")


def test_approaching_the_junction_is_no_moment() -> None:
    with pytest.raises(TranslationError, match="not said what is so then"):
        read("The ego drives west. An oncoming hero turns left. When the ego approaches the junction, the hero brakes.")


@pytest.mark.parametrize("does", ["brakes to a stop, waits for 3 s and drives on", "brakes to 5 m/s, then speeds up"])
def test_what_stands_in_front_of_several_deeds_says_when_the_first_begins(does: str) -> None:
    """It was of the last of them, and the first was done from the start."""
    told = tell(read(f"{JOINS}2 s after the ego passes the stop line, the hero {does}."))
    assert told[-1] == "The hero begins to brake 2 s after the ego passes the stop line."
    before = read(f"{JOINS}Before the ego passes the stop line, the hero {does}.")
    assert [each.text.partition(":")[0] for each in before.questions] == ["What begins then"]  # or all of it
    told = tell(read(f"{JOINS}Until the ego passes the stop line, the hero stands still and drives on."))
    assert told[-1] == "When the ego passes the stop line, the hero begins to drive on."


@pytest.mark.parametrize("first", ["brakes to a stop", "brakes at 3 m/s^2 to a stop", "comes to a stop", "slows down"])
@pytest.mark.parametrize("then", [" and stops", ", stopping", ", coming to a standstill", " and then stops"])
def test_who_comes_to_a_stop_and_stops_does_it_once(first: str, then: str) -> None:
    told = tell(read(f"{WHEN}{first}{then} 5 m before the conflict point."))
    rate = " at 3 m/s^2" if "at 3" in first else ""
    assert told[-1].endswith(f"the hero begins to brake{rate} until it stands 5 m before the conflict point.")


def test_how_long_somebody_brakes_that_stops_then_is_not_how_long_it_stands() -> None:
    for then in ("and stops", ", then stops", ", coming to a stop"):
        assert tell(read(f"{WHEN}brakes for 3 s {then}."))[-1].endswith("begins to brake for 3 s until it stands.")
    told = tell(read(f"{WHEN}brakes for 2 s and stops for 3 s."))
    assert told[-2].endswith("begins to brake for 2 s until it stands.")
    assert told[-1] == "Then the hero stands still for 3 s."
    for first in ("brakes at 2 m/s^2", "brakes to a stop"):  # it was 3 s after the moment
        with pytest.raises(TranslationError, match="who stands does not brake"):
            read(f"{WHEN}{first} and 3 s later stops 5 m before the conflict point.")


@pytest.mark.parametrize("does", ["begins to brake 15 m before the stop line", "speeds up 2 s after the ego passes it",
                                  "sets off 2 s after the ego passes the stop line"])  # fmt: skip
def test_what_is_done_at_the_start_begins_at_no_other_time(does: str) -> None:
    """That it is at the start was held by nothing."""
    with pytest.raises(TranslationError, match="to begin at the start, and at another time"):
        read(f"{JOINS}At the start, the ego is 12 m before the stop line. At the start, the hero {does}.")
