"""The form of a reply: every story goes through it and comes back, and what is none is told."""

from __future__ import annotations

import json
from dataclasses import fields, is_dataclass, replace
from typing import Any

import pytest
from random_stories import random_story
from replies import reply_of
from talk import GOOD, STORY, TEXT, reply_to

from scenewright.errors import Span, TranslationError
from scenewright.program.types import Parameter
from scenewright.translate import story as st
from scenewright.translate.model.exchange import CUT_OFF
from scenewright.translate.model.schema import claim_of, descriptions, form_of, locate, read_reply, reply_schema, sheet
from scenewright.translate.phrases import PLACES
from scenewright.units import UNITS


@pytest.mark.parametrize("seed", range(150))
def test_story_goes_through_a_reply_and_comes_back(seed: int) -> None:
    story = random_story(seed)
    got = claim_of(read_reply(json.dumps(reply_of(story))), "").story
    assert replace(got, title=story.title, map_name=story.map_name, manner=story.manner) == story


def test_questions_asides_and_quotes_come_back() -> None:
    question = st.Question("where", "Where?", ("here", "there"), 1)
    story = replace(random_story(1), questions=(question,), assumptions=("a",), asides=(st.Quote(4, 7, "ego"),))
    got = claim_of(read_reply(json.dumps(reply_of(story))), "The ego.").story
    assert (got.questions, got.assumptions, got.asides) == (story.questions, story.assumptions, story.asides)


def test_form_has_every_slot_of_the_story_with_a_meaning() -> None:
    """A new slot, deed, quantity, unit or place is in the form by itself; meanings are of slots that there are."""
    shown = sheet()
    own = [each for each in vars(st).values() if getattr(each, "__module__", "") == st.__name__ and is_dataclass(each)]
    parts = [each for each in own if each is not st.Quote]
    for part in [*parts, Parameter]:
        told = descriptions().get(part.__name__, {})
        for name in form_of(part).model_fields:
            assert f"\n- {name}: " in shown, f"{part.__name__}.{name}"
        assert set(told) <= {*form_of(part).model_fields, *(each.name for each in fields(part))}
    for word in (*st.Verb, *st.Quantity, *UNITS, *PLACES):
        assert f'"{word}"' in shown


def test_schema_has_no_end_of_depth() -> None:
    """Providers compile it: nothing in it holds itself, and nothing else than its slots may stand in it."""
    schema = reply_schema()
    parts: dict[str, Any] = schema["$defs"]

    def holds(name: str, seen: tuple[str, ...]) -> None:
        assert name not in seen
        for each in json.dumps(parts[name]).split("#/$defs/")[1:]:
            holds(each.split('"')[0], (*seen, name))

    for name in parts:
        holds(name, ())
    assert all(part.get("additionalProperties") is False for part in parts.values() if part["type"] == "object")


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "an empty reply"), ("no JSON at all", "no JSON object"), ('{"story": ', "Expecting value"),
        ("{" + "x" * 200_000, "characters"), ('{"a": 1}', "no JSON object"), (GOOD + CUT_OFF, "--max-tokens"),
        ('{"story": ' * 3000, "Expecting value|without end"), ('{"story": null}', ""),
        (json.dumps(reply_to(refusal=None, more=1)), "more: Extra inputs"),
        (json.dumps(reply_to(ego=["trigger"] * 101)), "at most 100"),
    ],
)  # fmt: skip
def test_what_is_no_reply_is_told(text: str, fault: str) -> None:
    with pytest.raises(TranslationError) as caught:
        read_reply(text)
    assert not fault or any(each in str(caught.value) for each in fault.split("|"))


def timed(time: dict[str, Any]) -> list[dict[str, Any]]:
    return [{"name": "start", "time": time}, *STORY["moments"][1:]]


@pytest.mark.parametrize(
    ("slot", "value", "fault"),
    [
        ("ego", ["nowhere"], "there is no moment 'nowhere'"),
        ("orders", [{"first": "start", "second": "x", "words": ""}], "there is no moment 'x'"),
        ("actors", STORY["actors"][::-1], "'ego' is the first"),
        ("actors", [*STORY["actors"], STORY["actors"][1]], "a name of its own"),
        ("asides", ["words of nobody"], "the words 'words of nobody' are not in the text"),
        ("questions", [{"slot": "s", "text": "?", "alternatives": ["a"], "default": "a"}], "two alternatives"),
        ("moments", timed({"value": "1/0", "unit": "s", "words": "12"}), "no number"),
        ("moments", timed({"value": "1e999999999", "unit": "s", "words": "12"}), "no number"),
        ("moments", timed({"value": "9" * 60, "unit": "s", "words": "12"}), "no number"),
        ("moments", timed({"value": None, "unit": "s", "words": "12"}), "either a value"),
        ("moments", timed({"value": None, "unit": "m", "name": "x_s", "words": "12"}), "it is s"),
    ],
)  # fmt: skip
def test_what_does_not_hold_together_is_told(slot: str, value: Any, fault: str) -> None:
    with pytest.raises(TranslationError) as caught:
        claim_of(read_reply(json.dumps(reply_to(**{slot: value}))), TEXT)
    assert fault in str(caught.value.found)


def test_amount_is_quoted_from_the_words_of_its_measure() -> None:
    reply = reply_to()
    reply["story"]["moments"][1]["conditions"][0]["amount"]["words"] = "20 m"
    with pytest.raises(TranslationError, match="does not hold together") as caught:
        claim_of(read_reply(json.dumps(reply)), TEXT)
    assert "'the AV is 12 m short of the stop line', the words of what it belongs to" in str(caught.value.found)


def test_start_need_not_be_listed_and_case_and_signs_do_not_matter() -> None:
    reply = reply_to(moments=STORY["moments"][1:])
    claim = claim_of(
        read_reply(f"Here it is:\n```json\n{json.dumps(reply).replace('The AV comes', 'the  av, comes')}\n```"), TEXT
    )
    assert claim.story.moments[0] == st.Moment()
    assert claim.ways[0] == st.Quote(0, 62, TEXT[:62])


def test_words_that_stand_twice_are_taken_in_turn() -> None:
    assert locate("to go", "to go or not to go") == [Span(0, 5), Span(13, 18)]
    assert locate("go", "gone to go") == [Span(8, 10)]
    assert locate("!", "!") == []
