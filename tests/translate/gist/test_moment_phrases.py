"""Turns of phrase for amounts and moments say what plain words say; what no program says is refused."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline

WAYS = (
    "The ego drives east along the road and is to turn left into the driveway; it begins 7 s from the intersection. "
    "A van comes the other way, westbound, and goes straight on. "
)
STOPS = "the van brakes and stops 9 m before the conflict point."
PLAIN = WAYS + "When the ego is 3 s and the van 4 s from the conflict point, " + STOPS


def formulas(text: str) -> set[str]:
    return {print_expression(each.formula) for each in translate_offline(text).program.constraints}


@pytest.mark.parametrize(
    "trigger",
    [
        "In response to the ego being 3 s from the conflict point and the van being 4 s from the conflict point, ",
        "Once the ego is at a temporal distance of 3 s and the van at one of 4 s to the conflict point, ",
        "Once the ego is at a distance of 3 s and the van at a distance of 4 s to the conflict point, ",
        "What sets it off is the ego being 3 s from the conflict point while the van is 4 s from it. At that moment ",
    ],
)
def test_a_moment_in_other_words(trigger: str) -> None:
    assert formulas(WAYS + trigger + STOPS) == formulas(PLAIN)


def test_given_and_given_when_then() -> None:
    text = (
        "Given the ego on the road, 7 s ahead of the intersection, heading east and about to turn left into the "
        "driveway, and given a van on the road that keeps to its lane westbound: when the ego is 3 s and the van "
        f"4 s from the conflict point, then {STOPS}"
    )
    assert formulas(text) == formulas(PLAIN)


def test_a_gap_that_somebody_follows_with() -> None:
    ways = "The ego goes west along the road, and a van goes the same way ahead of it. "
    brakes = "the van brakes at 3 m/s^2 to a standstill."
    said = f"{ways}When the time gap with which the ego follows the van has fallen to 2 s, {brakes}"
    assert formulas(said) == formulas(f"{ways}When the headway is 2 s, {brakes}")


def test_whose_time_it_is_after_somebody_ahead() -> None:
    text = (
        "The vehicle under test drives straight on along the eastbound lane behind a van that is about to turn left "
        "into the driveway. Its time to the intersection is 8 s at the beginning. When it is 2 s behind the van, the "
        "van brakes at 3 m/s^2 to a standstill."
    )
    assert "tta(A0, intersection, t0) == 8" in formulas(text)


def test_starting_condition_is_the_trigger_where_nothing_else_is() -> None:
    condition = "Starting condition: ego 3 s from the conflict point, van 4 s from the conflict point. "
    text = f"{WAYS}{condition}Behaviour: {STOPS}"
    assert formulas(text) == formulas(PLAIN)


@pytest.mark.parametrize(
    ("words", "instead"),
    [
        ("from the conflict point, the van", "from the conflict point and the light is green, the van"),
        ("9 m before the conflict point", "9 m before the petrol station"),
        ("stops 9 m before the conflict point", "stops at the same place as last time"),
        ("When the ego", "The second time that the ego"),
        ("brakes and stops", "brakes, backs up and stops"),
        ("When the ego is 3 s", "When the ego has honked and is 3 s"),
        ("goes straight on. ", "goes straight on. This scenario only applies when it rains. "),
    ],
)
def test_what_no_program_says_is_refused(words: str, instead: str) -> None:
    assert words in PLAIN
    with pytest.raises(TranslationError):
        translate_offline(PLAIN.replace(words, instead))
