"""The whole way of a text, on the map that it names or is given."""

from __future__ import annotations

import pytest

from scenewright.errors import MapError, TranslationError
from scenewright.language.understand import translate, understand
from scenewright.roads.grounding import ground
from scenewright.roads.load import load_map

TEXT = (
    "The ego drives west and goes straight on. An oncoming hero turns left into the driveway. When the ego is 25 m "
    "before the conflict point and the hero is 15 m before the conflict point, the hero brakes to a stop 8 m before it."
)


def test_a_text_becomes_a_program_that_fits_its_map() -> None:
    program = translate(TEXT)
    assert ground(program, load_map(program.map_name)).routes[1].headings == ("E", "N")
    assert program.description == TEXT
    assert [program.words_of(each) for each in program.constraints][1] == "25 m"


def test_a_map_that_is_named_and_a_text_that_is_too_long() -> None:
    assert understand(f"Map: t_intersection\n{TEXT}").map_name == "t_intersection"
    with pytest.raises(MapError):
        understand(f"Map: nowhere\n{TEXT}")
    with pytest.raises(TranslationError, match="too many characters"):
        understand("The ego stands. " * 1000)


@pytest.mark.parametrize("vague", ["about 30 m before", "roughly 30 m before", "within 30 m of"])
def test_a_vague_amount_is_asked_about_and_not_taken_for_an_exact_one(vague: str) -> None:
    text = (
        "The ego is headed west and goes straight on. The hero is headed east and turns left. "
        f"When the ego is {vague} the conflict point, the hero brakes to a stop."
    )
    if "within" in vague:  # it gets there
        assert not understand(text).questions
        return
    assert [each.default for each in understand(text).questions] == [0]
    with pytest.raises(TranslationError, match="leaves something open"):
        understand(text, strict=True)
