"""Who is spoken of in a free text: the ego, whatever it is called, and one other vehicle."""

from __future__ import annotations

import pytest

from scenewright.translate.events import EGO_ID, HERO_ID
from scenewright.translate.gist.layout import laid_out
from scenewright.translate.gist.names import find_names


def named(text: str) -> list[tuple[str, int]]:
    tokens = laid_out(text, "text")
    return [(tokens[at].text.lower(), actor) for at, actor in sorted(find_names(tokens).actors.items())]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("The AV follows a lorry.", [("av", EGO_ID), ("lorry", HERO_ID)]),
        ("My car meets my uncle's lorry.", [("car", EGO_ID), ("uncle", HERO_ID), ("lorry", HERO_ID)]),
        ("The driverless taxi waits. The taxi goes.", [("driverless taxi", EGO_ID), ("taxi", EGO_ID)]),
        ("The shuttle under test and a coach.", [("shuttle", EGO_ID), ("coach", HERO_ID)]),
        ("The robot car under test, and the robot car.", [("car under test", EGO_ID), ("car", EGO_ID)]),
        ("The one behind is the ego.", [("one behind", EGO_ID), ("ego", EGO_ID)]),
        ("The ego is an old van.", [("ego", EGO_ID), ("van", EGO_ID)]),
        ("I am in the target car, the ego is not.", [("i", HERO_ID), ("target car", HERO_ID), ("ego", EGO_ID)]),
        ("We turn; they meet us.", [("we", EGO_ID), ("they", HERO_ID), ("us", EGO_ID)]),
    ],
)
def test_every_name_stands_for_one_of_two(text: str, expected: list[tuple[str, int]]) -> None:
    assert named(text) == expected


def test_a_vehicle_of_a_kind_that_is_not_known_is_found_by_its_articles() -> None:
    tokens = laid_out("The ego goes west. A dustcart turns left. When the ego is there, the dustcart brakes.", "text")
    assert find_names(tokens).guessed == "dustcart"


@pytest.mark.parametrize(
    "text",
    [
        "The ego goes west. A dustcart turns left. A milkfloat stops. The milkfloat waits. The dustcart brakes.",
        "The ego goes west. A van turns left. The dustcart brakes.",
        "The ego goes west. The sunshine is nice.",
    ],
)
def test_nothing_is_guessed_where_it_could_be_more_than_one(text: str) -> None:
    assert find_names(laid_out(text, "text")).guessed is None


def test_two_kinds_of_vehicle_are_two_vehicles() -> None:
    assert len(find_names(laid_out("A coach meets a taxi and the ego.", "text")).kinds) == 2
    assert len(find_names(laid_out("The hero brakes. A tractor pulls out behind the hero.", "text")).kinds) == 2
    assert len(find_names(laid_out("A lorry comes. The other vehicle brakes.", "text")).kinds) == 1


def test_both_is_one_word_for_two_unless_one_of_them_is_meant() -> None:
    assert find_names(laid_out("Both turn left.", "text")).both
    assert not find_names(laid_out("Both the ego and the van turn left.", "text")).both
    assert not find_names(laid_out("The ego is the second of the two.", "text")).both
