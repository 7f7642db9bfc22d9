"""Evidence: right replies hold; wrong ones, made from them slot by slot, do not."""

from __future__ import annotations

import copy
import json
import random
import re
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from corruptions import AMOUNTS_AND_ORDERS, corruptions
from random_stories import random_story
from replies import told_reply
from talk import STORY, TEXT, Said, reply_to

from scenewright.errors import ScenewrightError, TranslationError
from scenewright.program.manner import USUAL
from scenewright.program.types import DEFAULT_MAP
from scenewright.roads.load import load_map
from scenewright.translate.model import prompt
from scenewright.translate.model.evidence import check_evidence
from scenewright.translate.model.exchange import TranslatorSettings
from scenewright.translate.model.schema import claim_of, read_reply
from scenewright.translate.model.translator import understand_by_model
from scenewright.translate.tell import tell

MAP = load_map("t_intersection")
FREE = tomllib.loads((Path(__file__).parent / "free_texts.toml").read_text(encoding="utf-8"))["case"]
REPLIES = [*prompt.examples(), *((each["text"], json.loads(each["reply"])) for each in FREE)]
STORIES = [(text, reply) for text, reply in REPLIES if reply.get("story") and "pedestrian" not in text]
TOLD, MOST = 12, 30


def fault_of(reply: dict[str, Any], text: str) -> ScenewrightError | None:
    """Return what is wrong with a reply, from its form to the program that it makes."""
    try:
        understand_by_model(text, MAP, "mine", Said([json.dumps(reply)]), TranslatorSettings(repairs=0))
    except ScenewrightError as error:
        return error
    return None


def fault_of_words(reply: dict[str, Any], text: str) -> ScenewrightError | None:
    """Return what the words say against a reply: random stories are on no map."""
    try:
        check_evidence(claim_of(read_reply(json.dumps(reply)), text), text)
    except ScenewrightError as error:
        return error
    return None


def told() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield told stories with right replies; random ones contradict themselves, or tell a time apart, now and then."""
    for seed in range(TOLD):
        story = replace(random_story(seed), title=None, map_name=DEFAULT_MAP, manner=USUAL)
        try:
            lines = tell(story)
        except TranslationError:
            continue
        reply, text = told_reply(lines)
        fault = fault_of_words(reply, text)
        if fault is None:
            yield text, reply
        else:
            assert re.search("before the first|say it as an order", str(fault.found)), (text, str(fault))


@pytest.mark.parametrize(("text", "reply"), STORIES, ids=range(len(STORIES)))
def test_right_replies_hold(text: str, reply: dict[str, Any]) -> None:
    assert fault_of(reply, text) is None


def test_wrong_replies_are_caught() -> None:
    """At least 95 in 100 of all, and all wrong amounts and orders."""
    tried, caught = Counter[str](), Counter[str]()
    for seed, (text, reply) in enumerate(STORIES):
        for kind, wrong in corruptions(reply, seed):
            tried[kind] += 1
            caught[kind] += (fault_of_words(wrong, text) or fault_of(wrong, text)) is not None
    texts = list(told())
    assert len(texts) >= TOLD // 2
    for seed, (text, reply) in enumerate(texts):
        wrong_ones = list(corruptions(reply, seed))
        for kind, wrong in random.Random(seed).sample(wrong_ones, min(MOST, len(wrong_ones))):
            tried[kind] += 1
            caught[kind] += fault_of_words(wrong, text) is not None
    assert {kind for kind in AMOUNTS_AND_ORDERS if caught[kind] < tried[kind]} == set()
    assert caught.total() >= 0.95 * tried.total(), {kind: (caught[kind], tried[kind]) for kind in tried}
    assert tried.total() > 500


def test_two_distances_exchanged() -> None:
    """The reply that a check of numbers alone believes."""
    for with_words in (False, True):
        reply = reply_to()
        one, two = (each["amount"] for each in reply["story"]["moments"][1]["conditions"])
        slots = ("value", "words") if with_words else ("value",)
        for slot in slots:
            one[slot], two[slot] = two[slot], one[slot]
        assert fault_of(reply, TEXT) is not None


def test_who_is_under_test_is_not_taken_for_another() -> None:
    """With the names exchanged all else of the reply would be said of the right one."""
    reply = reply_to()
    ego, truck = reply["story"]["actors"]
    ego["called"], truck["called"] = truck["called"], ego["called"]
    assert fault_of_words(reply_to(), TEXT) is None
    fault = fault_of_words(reply, TEXT)
    assert fault is not None
    assert "truck is under test: ['The AV']" in (fault.found or "")


def test_relations_of_an_ego_that_is_we_are_held_against_their_words() -> None:
    text = "We drive west. A truck drives ahead of us in the same lane. When we are 20 m behind the truck, it brakes."
    actors = [
        {"name": "ego", "called": [], "way": {"words": "We drive west", "heading": "W"},
         "relations": [{"kind": "oncoming", "of": "truck", "words": "ahead of us in the same lane"}]},
        {"name": "truck", "called": ["A truck", "the truck"], "kind": "truck", "way": {}},
    ]  # fmt: skip
    story = {"actors": actors, "moments": [{"name": "start"}], "ego": [], "deeds": [], "asides": [text]}
    assert "does not say 'oncoming'" in str(
        fault_of_words({"readings": [{"words": text, "means": "all"}], "story": story}, text)
    )


@pytest.mark.parametrize(
    ("slots", "told"),
    [
        ({"asides": []}, "'12 m' of the text"),
        ({"deeds": [{**STORY["deeds"][0], "ends": "stopped"}]}, "'brakes'"),
    ],
)
def test_what_carries_meaning_must_be_used_up(slots: dict[str, Any], told: str) -> None:
    reply = reply_to(**slots)
    reply["story"]["moments"][1]["conditions"][0].update(
        {"amount": None, "words": "the AV is 12 m short of the stop line"}
    )
    assert told in str(fault_of_words(reply, TEXT)) or told in str(fault_of(reply, TEXT))


def test_silence_is_owned_to_by_an_assumption_that_names_it() -> None:
    text = "The ego drives west. An oncoming truck yields to it."
    story = {
        "actors": [
            {"name": "ego", "called": ["The ego"], "kind": "car",
             "way": {"words": "The ego drives west", "heading": "W"}},
            {"name": "truck", "called": ["oncoming truck"], "kind": "truck", "way": {},
             "relations": [{"kind": "oncoming", "of": "ego", "words": "An oncoming truck"}]}],
        "moments": [{"name": "start"}, {"name": "stands", "conditions": [
            {"actor": "truck", "quantity": "speed", "op": "==", "words": "An oncoming truck yields",
             "amount": {"value": "0", "unit": "m/s", "words": "yields"}}]}],
        "deeds": [{"actor": "truck", "verb": "brake", "begins": "start", "ends": "stands",
                   "words": "oncoming truck yields"}],
    }  # fmt: skip
    reply: dict[str, Any] = {"readings": [], "story": story}
    assert "an assumption that quotes these words says" in str(fault_of_words(reply, text))
    story["assumptions"] = [{"words": "yields", "says": "To yield is to look out."}]
    assert fault_of_words(reply, text) is not None
    story["assumptions"] = [{"words": "yields", "says": "To yield is to brake to a standstill."}]
    assert fault_of_words(reply, text) is None


def test_unknown_words_are_no_fault() -> None:
    """What the offline vocabulary does not know leaves a right story as it is."""
    strange = TEXT.replace("A truck travels", "A truck, shiny and zorbled, travels").replace("brakes", "duly brakes")
    reply = json.loads(json.dumps(reply_to(strange)).replace("A truck travels", "A truck, shiny and zorbled, travels")
                       .replace("truck brakes", "truck duly brakes"))  # fmt: skip
    assert fault_of(reply, strange) is None


def test_corruptions_leave_the_right_reply_alone() -> None:
    reply = reply_to()
    before = copy.deepcopy(reply)
    kinds = {kind for kind, wrong in corruptions(reply) if wrong != before}
    assert reply == before
    assert {"number", "unit", "two amounts", "actor", "place", "operator", "deed", "doer", "heading", "turn"} <= kinds


ORDERS = [  # who is first, the words of the ego's passing and of the hero's, the text
    (1, "the ego", "The hero passes", "The hero passes the conflict point before the ego does."),
    (0, "the ego has passed", "The hero passes", "The hero passes only after the ego has passed."),
    (0, "the ego has gone through", "the hero proceeds", "After the ego has gone through, the hero proceeds."),
    (
        0,
        "the ego has cleared",
        "The hero waits",
        "The hero waits until the ego has cleared the conflict point, then goes.",
    ),
    (0, "the ego is through", "the hero sets off", "Once the ego is through, the hero sets off."),
    (1, "the ego after it", "The hero goes first", "The hero goes first, the ego after it."),
    (0, "the ego go first", "The hero lets", "The hero lets the ego go first."),
    (0, "the ego pass", "it proceeds", "The hero lets the ego pass before it proceeds."),
    (0, "The ego must be through", "the hero", "The ego must be through ahead of the hero."),
    (1, "the ego", "The hero crosses", "The hero crosses in front of the ego."),
    (
        0,
        "the ego has left it",
        "The hero does not enter",
        "The hero does not enter the junction until the ego has left it.",
    ),
    (0, "the ego has passed", "the hero move", "Not before the ego has passed does the hero move."),
    (1, "the ego", "The hero gets there", "The hero gets there no later than the ego."),
    (1, "The ego follows", "the hero has crossed", "The ego follows once the hero has crossed."),
]


@pytest.mark.parametrize(("first", "ego", "hero", "text"), ORDERS, ids=range(len(ORDERS)))
def test_order_in_many_words(first: int, ego: str, hero: str, text: str) -> None:
    """The right order is in the words, and the other is not."""
    there = {"quantity": "place", "op": "==", "place": {"name": "conflict_point"}}
    known = "'At the conflict point' is where both of them, ego and hero, pass."
    moments = [
        {"name": "start"},
        {"name": "ego there", "conditions": [{**there, "actor": "ego", "words": ego}]},
        {"name": "hero there", "conditions": [{**there, "actor": "hero", "words": hero}]},
    ]
    names = ["ego there", "hero there"] if first == 0 else ["hero there", "ego there"]
    for early, late in (names, names[::-1]):
        story = {
            "actors": [
                {"name": "ego", "called": [text[at : at + 7] for at in (text.lower().index("the ego"),)], "way": {}},
                {"name": "hero", "called": [text[at : at + 8] for at in (text.lower().index("the hero"),)], "way": {}},
            ],
            "moments": moments,
            "ego": ["ego there"],
            "deeds": [{"actor": "hero", "verb": "drive on", "begins": "start", "ends": "hero there", "words": hero}],
            "orders": [{"first": early, "second": late, "words": text}],
            "asides": [text],
            "assumptions": [{"words": text, "says": known}],
        }
        fault = str(fault_of_words({"readings": [], "story": story}, text))
        assert ("says it in the other order" in fault) is (early != names[0])
        assert "which moment is first" not in fault
