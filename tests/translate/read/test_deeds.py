"""What somebody does: when it begins, where it ends, and which of the two another moment dates."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell

WAYS = "The ego turns left out of the driveway. The hero drives west. "
WHEN = WAYS + "When the ego is 12 m before the stop line, the hero "
PASSES = WAYS + "2 s after the ego passes the stop line, the hero "


def does(text: str) -> list[str]:
    """Return what is told beside the ways, with all questions answered by default."""
    return [line for line in tell(read(text)) if "headed" not in line and "comes from" not in line]


STOPS = ["Then the hero stands still.", "Then the hero drives on until it passes the conflict point."]


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("brakes to a stop and passes the conflict point.", ["to brake until it stands.", *STOPS]),
        ("brakes to a stop in 4 s, then passes the conflict point.", ["to brake for 4 s until it stands.", *STOPS]),
        ("brakes for 3 s and passes the conflict point.", ["to brake for 3 s.", STOPS[1]]),
        ("brakes at 3 m/s^2, then passes the conflict point.", ["to brake at 3 m/s^2 for a while.", STOPS[1]]),
        ("brakes and passes the conflict point.", ["to brake until it passes the conflict point."]),
        ("speeds up, then passes the conflict point.", ["to speed up until it passes the conflict point."]),
    ],
)
def test_what_somebody_passes_ends_a_deed_only_where_that_has_no_end(said: str, told: list[str]) -> None:
    first, *others = told
    front = "When the ego is 12 m before the stop line, the hero begins "
    assert does(WHEN + said) == [front + first, *others]


def test_who_brakes_to_a_stop_passes_nothing_meanwhile() -> None:
    with pytest.raises(TranslationError, match="whether this is done then or meanwhile"):
        read(WHEN + "brakes to a stop, passing the stop line.")


@pytest.mark.parametrize(
    "said",
    ["brakes and passes the conflict point.", "brakes to pass the conflict point.",
     "brakes, passing the conflict point 1 s before the ego."],
)  # fmt: skip
def test_what_stands_in_front_of_a_deed_dates_its_beginning_whatever_it_passes(said: str) -> None:
    told = does(PASSES + said)
    assert "Then the hero brakes until it passes the conflict point." in told
    assert "The hero begins to brake 2 s after the ego passes the stop line." in told
