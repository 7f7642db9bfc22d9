"""What is a deed: driving told behind other deeds is one, coming to the junction is none at the start."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.types import EGO
from scenewright.translate.read.sentences import read

BRAKES = (
    "The ego drives west. An oncoming hero turns left. "
    "When the ego is 30 m before the conflict point, the hero brakes to 3 m/s. "
)


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
