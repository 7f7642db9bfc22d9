"""Replies made from stories: what a model that reads everything right would say."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from scenewright.language import story as st
from scenewright.language.model import schema
from scenewright.units import format_fraction


def reply_of(story: st.Story, called: dict[int, list[str]] | None = None, **more: Any) -> dict[str, Any]:
    """Return the reply that says `story`, with the words that its parts quote."""
    told = _Writer(story, called or {}).story()
    told["assumptions"] = [{"words": "", "says": each} for each in story.assumptions]
    return {"readings": [], "refusal": None, "story": {**told, **more}}


class _Writer:
    def __init__(self, story: st.Story, called: dict[int, list[str]]) -> None:
        self.whole, self.called = story, called
        self.people = [actor.name for actor in story.actors]
        self.moments = ["start", *(f"m{number}" for number in range(1, len(story.moments)))]

    def story(self) -> dict[str, Any]:
        made: dict[str, Any] = self.of(self.whole)
        for number, actor in enumerate(made["actors"]):
            own = self.whole.actors[number].quote
            actor["called"] = self.called.get(number, [own.text] if own else [])
        for name, moment in zip(self.moments, made["moments"], strict=True):
            moment["name"] = name
        for question in made["questions"]:
            place = question["default"]
            question["default"] = None if place is None else question["alternatives"][int(place)]
        return made

    def of(self, value: Any, slot: str = "", owner: object = None) -> Any:
        if isinstance(value, st.Quote):
            return value.text
        if is_dataclass(value):
            ours = schema._OURS.get(type(value), set())
            return {
                "words" if each.name == "quote" else each.name: self.of(getattr(value, each.name), each.name, value)
                for each in fields(value)
                if each.name not in ours and not (each.name == "quote" and value.quote is None)  # type: ignore[attr-defined]
            }
        if isinstance(value, tuple):
            return [self.of(each, slot, owner) for each in value]
        if isinstance(value, bool | StrEnum) or value is None:
            return value
        if isinstance(value, int) and not isinstance(owner, st.Question):
            return (self.people if slot in schema._PEOPLE else self.moments)[value]
        return format_fraction(value) if isinstance(value, Fraction) else value
