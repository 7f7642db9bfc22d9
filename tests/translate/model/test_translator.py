"""The conversation with a model: repairs, refusals, questions, second opinions."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest
from talk import GOOD, QUESTION, STORY, TEXT, Said, reply_to

from scenewright.errors import InputError, TranslationError
from scenewright.roads.load import load_map
from scenewright.translate import story as st
from scenewright.translate.model.exchange import TranslatorSettings
from scenewright.translate.model.translator import understand_by_model
from scenewright.translate.understand import OpenQuestionsError, Understanding

MAP = load_map("t_intersection")


def told(model: Said, text: str = TEXT, **options: Any) -> Understanding:
    return understand_by_model(text, MAP, "mine", model, TranslatorSettings(**options))


def left(result: Understanding) -> list[str]:
    """Return what is open but for the way of the truck, which the map asks about."""
    return [each.slot for each in result.questions if each.slot != "way of truck"]


def choose(number: int) -> Callable[[st.Question], str]:
    """Return somebody who takes the alternative of this number, but lets the truck go straight on."""
    return lambda question: question.alternatives[0 if question.slot == "way of truck" else number]


def given(result: Understanding) -> dict[str, str]:
    return {slot: answer for slot, answer in result.answers.items() if slot != "way of truck"}


def said(**more: Any) -> str:
    return json.dumps(reply_to(**more))


def test_story_makes_a_program_whose_parts_point_at_their_words() -> None:
    result = told(Said([GOOD]))
    sources = [each.source.excerpt(TEXT) for each in result.program.constraints if each.source]
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
    model = Said([said(questions=[QUESTION])])
    result = told(model)
    assert left(result) == ["where"]
    assert result.all_answers["where"] == "5 m before"
    assert len(model.calls) == 1


@pytest.mark.parametrize("how", [{"ask": choose(1)}, {"answers": {"where": "at it"}}])
def test_other_answer_goes_back_to_the_model(how: dict[str, Any]) -> None:
    model = Said([said(questions=[QUESTION]), GOOD])
    result = told(model, **how)
    assert "- Where does the truck stop? at it" in model.calls[1].messages[-1].content
    assert (given(result), left(result), len(model.calls)) == ({"where": "at it"}, [], 2)


def test_answer_that_the_story_took_already_needs_no_call() -> None:
    asked: list[st.Question] = []

    def ask(question: st.Question) -> str:
        asked.append(question)
        return question.alternatives[0]

    model = Said([said(questions=[QUESTION])])
    result = told(model, ask=ask)
    assert [each.quote and each.quote.text for each in asked] == ["to a stop 5 m before"]
    assert (given(result), left(result), len(model.calls)) == ({"where": "5 m before"}, [], 1)


MORE = {**QUESTION, "slot": "when", "text": "When does it stop?", "alternatives": ["soon", "late"], "default": "soon"}


def test_all_answers_go_back_at_once_and_are_asked_for_no_more() -> None:
    """Whether they come one by one or together; a reply that repeats a question does not ask it again."""
    both = {"where": "at it", "when": "late"}
    for how in ({"ask": choose(1)}, {"answers": both}):
        model = Said([said(questions=[QUESTION, MORE]), said(questions=[QUESTION])])
        result = told(model, **how)
        assert "? at it\n- When does it stop? late\n" in model.calls[1].messages[-1].content
        assert [message.role for message in model.calls[1].messages] == ["system", "user", "assistant", "user"]
        assert (given(result), left(result), len(model.calls)) == (both, [], 2)


def test_one_of_two_questions_answered_leaves_the_other_open() -> None:
    model = Said([said(questions=[QUESTION, MORE]), said(questions=[MORE])])
    result = told(model, answers={"where": "at it"})
    assert (left(result), len(model.calls)) == (["when"], 2)
    result = told(Said([said(questions=[QUESTION, MORE])]), answers={"where": "5 m before"})
    assert left(result) == ["when"]


def test_question_that_an_answer_opens_is_asked_too() -> None:
    model = Said([said(questions=[QUESTION]), said(questions=[MORE]), GOOD])
    result = told(model, ask=choose(1))
    assert given(result) == {"where": "at it", "when": "late"}
    assert "late" in model.calls[2].messages[-1].content


@pytest.mark.parametrize(("answers", "fault"), [({"where": "elsewhere"}, "no answer to"), ({"x": "y"}, "no question")])
def test_answer_that_is_none_is_told(answers: dict[str, str], fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        told(Said([said(questions=[QUESTION])]), answers=answers)


def test_strictness_refuses_what_is_open() -> None:
    with pytest.raises(OpenQuestionsError):
        told(Said([said(questions=[QUESTION])]), strict=True)


# -- second opinion -------------------------------------------------------------------------------------------------
def test_second_opinion_is_blind_and_agrees() -> None:
    model = Said([GOOD, '{"differences": []}'])
    result = told(model, second_opinion=True)
    system, user = model.calls[1].messages
    assert TEXT in user.content
    assert "When the ego is 12 m before the stop line" in user.content
    assert "story" not in system.content + user.content
    assert any("no differences" in note for note in result.notes)
    assert left(result) == []


def test_difference_is_a_question_and_a_no_goes_back() -> None:
    differs = '{"differences": ["The first has a truck, the other a car."]}'
    result = told(Said([GOOD, differs]), second_opinion=True)
    assert "The first has a truck" in result.questions[0].text
    model = Said([GOOD, differs, GOOD])
    result = told(model, second_opinion=True, ask=choose(1))
    assert "The first has a truck" in model.calls[2].messages[-1].content
    assert len(model.calls) == 3
    assert left(result) == []


@pytest.mark.parametrize("reply", ["I agree.", '{"differences": 3}', "{}", "[" * 9999])
def test_second_opinion_that_is_none_is_noted(reply: str) -> None:
    result = told(Said([GOOD, reply]), second_opinion=True)
    assert any("could not be read" in note for note in result.notes)
