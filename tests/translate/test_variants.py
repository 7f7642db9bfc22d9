"""Other ways to say one part of a plain description mean the same, or are refused: never something else.

`variants.toml` holds frames with one part left open, what is plainly said there, and over a hundred ways to say it.
`unread` is how many of them are refused today; it may only become less.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from scenewright.errors import ScenewrightError
from scenewright.program.printer import print_expression
from scenewright.program.types import Program
from scenewright.translate.offline import translate_offline

PARTS = tomllib.loads((Path(__file__).parent / "variants.toml").read_text(encoding="utf-8"))["part"]


def meaning(program: Program) -> tuple[list[str], frozenset[str]]:
    ways = [f"{actor.route} {actor.sketch}" for actor in program.actors]
    return ways, frozenset(print_expression(each.formula) for each in program.constraints)


def read(text: str) -> tuple[list[str], frozenset[str]] | None:
    try:
        return meaning(translate_offline(text).program)
    except ScenewrightError:
        return None


def test_there_are_many() -> None:
    assert sum(len(part["said"]) for part in PARTS) > 2500


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part["name"].replace(" ", "_"))
def test_no_other_way_to_say_it_means_something_else(part: dict[str, Any]) -> None:
    plain = read(part["frame"].replace("{}", part["plain"]))
    assert plain is not None
    meanings = {said: read(part["frame"].replace("{}", said)) for said in part["said"]}
    assert [said for said, found in meanings.items() if found not in (None, plain)] == []
    assert sum(found is None for found in meanings.values()) <= part["unread"]
