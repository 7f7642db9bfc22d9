"""Words that could point at either vehicle are refused, or listed where only one of them makes sense."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.expressions import State, walk
from scenewright.translate.offline import translate_offline

FOLLOWS = " Both come out of the driveway and turn right. When the ego is 9 m behind the car, the car brakes to a stop."
MEETS = " When the ego is 30 m and the hero is 20 m before the conflict point, the hero brakes to a stop."


@pytest.mark.parametrize(
    "owner",
    [
        "The ego follows a car on the driveway, which is 20 m from the stop line at the start.",
        "The ego follows a car on the driveway, whose distance to the stop line is 20 m at the start.",
        "The ego follows a car on the driveway, whose initial speed is 5 m/s.",
    ],
)
def test_what_either_vehicle_may_own_is_refused(owner: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(owner + FOLLOWS)


@pytest.mark.parametrize(
    "owner",
    [
        "The ego follows a car, whose initial distance to the stop line is 20 m.",
        "The ego follows a car, which is 20 m from the stop line at the start.",
    ],
)
def test_who_was_named_just_before_owns_it(owner: str) -> None:
    program = translate_offline(owner + FOLLOWS).program
    placed = [
        node.actor
        for constraint in program.constraints
        for node in walk(constraint.formula)
        if isinstance(node, State) and "t0" in str(node.at)
    ]
    assert placed == [1]


@pytest.mark.parametrize(
    "way",
    [
        "The ego goes west and starts 80 m before the intersection. The hero comes towards it and goes straight on.",
        "The ego goes west and starts 80 m before the intersection. The hero comes towards it and turns right.",
        "The hero is 80 m before the intersection. The ego comes towards it.",
    ],
)
def test_what_one_comes_towards_may_be_the_intersection(way: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(way + MEETS)


def test_comes_towards_the_ego_is_oncoming() -> None:
    intro = "The ego goes west and starts 80 m before the intersection."
    way = " The hero comes towards the ego and turns left into the driveway."
    assert translate_offline(intro + way + MEETS).program.actors[1].route.headings == ("E", "N")
