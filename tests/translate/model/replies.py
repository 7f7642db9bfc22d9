"""Replies made from stories: what a model that reads everything right would say."""

from __future__ import annotations

import re
from dataclasses import fields, is_dataclass, replace
from enum import StrEnum
from fractions import Fraction
from typing import Any

from scenewright.translate import story as st
from scenewright.translate.model import schema
from scenewright.translate.phrases import Phrases
from scenewright.translate.read.sentences import read
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
            ours = schema.OURS.get(type(value), set())
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
            return (self.people if slot in schema.PEOPLE else self.moments)[value]
        return format_fraction(value) if isinstance(value, Fraction) else value


# -- told stories ---------------------------------------------------------------------------------------------------
_CUTS = re.compile(
    r", | and (?=the )|\. |\.\n|\n|\.$|\b[Ww]hen |\buntil |: |\bif |\beither |\bboth |\bthen | or (?=the |it )|so that "
    r"|(?:before|after) (?=the (?:ego|hero|car|truck|van|bus|taxi)\b)|no later than "
)


def told_reply(lines: list[str]) -> tuple[dict[str, Any], str]:
    """Return the right reply to a story that was told, with that text: each slot quotes its clause or its sentence."""
    text = "\n".join(lines)
    story = read(text)
    quoted = replace(
        story,
        moments=tuple(
            replace(
                moment, conditions=tuple(_clause(_implied(story, number, each), text) for each in moment.conditions)
            )
            for number, moment in enumerate(story.moments)
        ),
        deeds=tuple(
            replace(_whole(each, text), throughout=tuple(_clause(part, text) for part in each.throughout))
            for each in story.deeds
        ),
        orders=tuple(_whole(each, text) for each in story.orders),
        holds=tuple(replace(_whole(each, text), condition=_clause(each.condition, text)) for each in story.holds),
    )
    names = Phrases(story)
    reply = reply_of(quoted, {actor.id: [names.name(actor.id)] for actor in story.actors})
    for actor, made in zip(story.actors, reply["story"]["actors"], strict=True):
        made["way"]["words"] = next(
            (line.rstrip(".") for line in lines if line.lower().startswith(names.name(actor.id).lower())), ""
        )
    reply["readings"] = [{"words": line, "means": "as it says"} for line in lines]
    reply["story"]["asides"] = [line.rstrip(".") for line in lines if line.startswith("In the ego's order")]
    reply["story"]["assumptions"] = []
    return reply, text


def _whole(part: Any, text: str) -> Any:
    """Return a part that quotes its whole sentence."""
    start = text.rfind("\n", 0, part.quote.start) + 1
    end = min(at for at in (text.find("\n", part.quote.end), len(text)) if at >= 0)
    return replace(part, quote=st.Quote(start, end - 1, text[start : end - 1]))


def _clause(condition: Any, text: str) -> Any:
    """Return a condition whose measures quote their clauses."""
    if isinstance(condition, st.Compound):
        return replace(condition, parts=tuple(_clause(each, text) for each in condition.parts))
    line = _whole(condition, text).quote
    starts = [cut.end() for cut in _CUTS.finditer(text) if line.start <= cut.end() <= condition.quote.start + 1]
    ends = [cut.start() for cut in _CUTS.finditer(text) if condition.quote.end - 1 <= cut.start() <= line.end]
    start, end = max(starts, default=line.start), min(ends, default=line.end)
    return replace(condition, quote=st.Quote(start, end, text[start:end]))


def _implied(story: st.Story, moment: int, condition: Any) -> Any:
    """Return a condition with the words of the deed that it ends, where the reader quotes none."""
    if isinstance(condition, st.Compound) or condition.quote is not None:
        return condition
    deed = next(deed for deed in story.deeds if moment in (deed.ends, deed.begins))
    words = deed.quote
    assert words is not None
    amount = condition.amount and replace(condition.amount, quote=words)
    return replace(condition, quote=words, amount=amount)
