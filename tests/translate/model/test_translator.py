"""The conversation with a model: repairs, refusals, questions, second opinions."""

from __future__ import annotations

import json
from typing import Any

import pytest
from talk import GOOD, QUESTION, STORY, TEXT, Said, reply_to

from scenewright.errors import TranslationError
from scenewright.roads.load import load_map
from scenewright.translate import story as st
from scenewright.translate.compile import compile_story
from scenewright.translate.model.settings import TranslatorSettings
from scenewright.translate.model.translator import NOT_AS_TOLD, Told, story_by_model
from scenewright.translate.ways import put_on_map

MAP = load_map("t_intersection")


def told(model: Said, text: str = TEXT, **options: Any) -> Told:
    return story_by_model(text, MAP, "mine", model, TranslatorSettings(**options))


def said(**more: Any) -> str:
    return json.dumps(reply_to(**more))


def test_story_makes_a_program_whose_parts_point_at_their_words() -> None:
    result = told(Said([GOOD]))
    program = compile_story(put_on_map(result.story, MAP), TEXT)
    sources = [each.source.excerpt(TEXT) for each in program.constraints if each.source]
    assert "the truck is 20 m short of the conflict point" in sources
    assert [deed.verb for deed in result.story.deeds] == ["drive on", "brake"]
    assert result.answers == {}


def test_what_does_not_hold_goes_back_with_its_fault() -> None:
    wrong = GOOD.replace('"value": "12"', '"value": "13"')
    model = Said([wrong, GOOD])
    result = told(model)
    assert [message.role for message in model.calls[1].messages] == ["system", "user", "assistant", "user"]
    assert "'12 m' is not 13 m" in model.calls[1].messages[-1].content
    assert "'12 m' is not 13 m" in result.notes[0]
    with pytest.raises(TranslationError, match="gave no story that holds: 2 calls") as caught:
        told(Said([wrong]), repairs=1)
    assert "'12 m' is not 13 m" in str(caught.value.found)


def test_way_that_does_not_fit_the_map_goes_back() -> None:
    actors = json.loads(json.dumps(STORY["actors"]))
    actors[1]["way"].update(words="A truck travels westbound along the road", origin="driveway")
    model = Said([said(actors=actors), GOOD])
    told(model)
    assert "says road, not 'driveway'" in model.calls[1].messages[-1].content


def test_refusal_is_the_users_with_its_words_and_the_nearest_thing() -> None:
    refusal = {"reason": "It cannot be said.", "words": "A truck travels", "fix": "say a car"}
    with pytest.raises(TranslationError, match="It cannot be said") as caught:
        told(Said([json.dumps({"refusal": refusal})]))
    assert caught.value.fix == "say a car"
    assert str(caught.value.place) == "mine:1:65"


def test_what_no_program_can_say_is_refused_by_name_and_never_bent() -> None:
    text = TEXT.replace("truck", "pedestrian")
    model = Said([said(text=text).replace("truck", "pedestrian")])
    with pytest.raises(TranslationError, match="a pedestrian cannot be said"):
        told(model, text)
    assert len(model.calls) == 1


def test_moment_of_the_ego_that_the_reply_forgot_is_the_egos() -> None:
    assert told(Said([said(ego=[])])).story.ego == (1,)


# -- questions ------------------------------------------------------------------------------------------------------
def test_default_is_taken_and_the_question_stays_open() -> None:
    result = told(Said([said(questions=[QUESTION])]))
    assert [(each.slot, each.default) for each in result.story.questions] == [("where", 0)]
    assert len(result.calls) == 1


@pytest.mark.parametrize("how", [{"ask": lambda question: question.alternatives[1]}, {"answers": {"where": "at it"}}])
def test_other_answer_goes_back_to_the_model(how: dict[str, Any]) -> None:
    model = Said([said(questions=[QUESTION]), GOOD])
    result = told(model, **how)
    assert "- Where does the truck stop? at it" in model.calls[1].messages[-1].content
    assert (result.answers, result.story.questions, len(result.calls)) == ({"where": "at it"}, (), 2)


def test_answer_that_the_story_took_already_needs_no_call() -> None:
    asked: list[st.Question] = []

    def ask(question: st.Question) -> str:
        asked.append(question)
        return question.alternatives[0]

    result = told(Said([said(questions=[QUESTION])]), ask=ask)
    assert [each.quote and each.quote.text for each in asked] == ["to a stop 5 m before"]
    assert (result.answers, result.story.questions, len(result.calls)) == ({"where": "5 m before"}, (), 1)


# -- second opinion -------------------------------------------------------------------------------------------------
def test_second_opinion_is_blind_and_agrees() -> None:
    model = Said([GOOD, '{"differences": []}'])
    result = told(model, second_opinion=True)
    system, user = model.calls[1].messages
    assert TEXT in user.content
    assert "When the ego is 12 m before the stop line" in user.content
    assert "story" not in system.content + user.content
    assert any("no differences" in note for note in result.notes)
    assert result.story.questions == ()


def test_difference_is_a_question_and_a_no_goes_back() -> None:
    differs = '{"differences": ["The first has a truck, the other a car."]}'
    result = told(Said([GOOD, differs]), second_opinion=True)
    assert "The first has a truck" in result.story.questions[0].text
    model = Said([GOOD, differs, GOOD])
    result = told(model, second_opinion=True, ask=lambda question: NOT_AS_TOLD)
    assert "The first has a truck" in model.calls[2].messages[-1].content
    assert len(result.calls) == 3
    assert result.story.questions == ()


@pytest.mark.parametrize("reply", ["I agree.", '{"differences": 3}', "{}", "[" * 9999])
def test_second_opinion_that_is_none_is_noted(reply: str) -> None:
    result = told(Said([GOOD, reply]), second_opinion=True)
    assert any("could not be read" in note for note in result.notes)
