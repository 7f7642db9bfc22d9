"""The way of a text: read, put on a map, asked about, compiled.

What enters: a text, a map, answers. What leaves: a story that may be compiled, and its program.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from scenewright.language.compile import compile_story
from scenewright.language.questions import settled
from scenewright.language.read.sentences import read
from scenewright.language.story import Story
from scenewright.language.ways import put_on_map
from scenewright.program.limits import check_description
from scenewright.program.types import DEFAULT_MAP, Program
from scenewright.roads.load import load_map
from scenewright.roads.model import RoadMap


def understand(
    text: str,
    road_map: RoadMap | None = None,
    answers: Mapping[str, str] | None = None,
    strict: bool = False,
    name: str = "description",
) -> Story:
    """Return the story of `text` on a map, the one that it names itself where it does.

    Raises
    ------
    TranslationError
        Where it cannot be read, fits no way on the map, or leaves open what has no default (with `strict`: anything).

    Examples
    --------
    >>> story = understand("The ego drives west. The hero is oncoming. The hero brakes to a stop at its stop line.")
    >>> [actor.way.heading for actor in story.actors]
    ['W', 'E']
    """
    check_description(text, name)
    answers = answers or {}
    story = read(text, answers, name)
    if road_map is None:
        road_map = load_map(story.map_name)
    elif story.map_name == DEFAULT_MAP:
        story = replace(story, map_name=road_map.name)
    return settled(put_on_map(story, road_map, answers), answers, strict)


def translate(text: str, road_map: RoadMap | None = None, answers: Mapping[str, str] | None = None) -> Program:
    """Return the program of `text`; raises as `understand` and `compile_story` do."""
    return compile_story(understand(text, road_map, answers), text)
