"""Exchanges: keys that are the same for the same words, tokens that are counted or said to be estimated."""

from __future__ import annotations

from talk import Said

from scenewright.language.model.exchange import Call, Message, Usage, estimated_usage, key_of

CALL = Call((Message("user", "a" * 8),), "a", 1, "m")


def test_key_is_of_the_model_and_the_words_alone() -> None:
    again = Call(CALL.messages, "another", 2, "n", {"type": "object"})
    assert key_of(Said([]), CALL) == key_of(Said([]), again)
    assert key_of(Said([]), CALL) != key_of(Said([], name="other"), CALL)
    assert key_of(Said([]), CALL) != key_of(Said([]), Call((Message("system", "a" * 8),), "a", 1, "m"))


def test_tokens_add_up_and_an_estimate_is_called_one() -> None:
    estimate = estimated_usage(CALL, "abc")
    assert estimate == Usage(1, 2, 1, estimated=True)
    assert str(Usage(1, 5, 7)) == "1 call, 5 tokens in and 7 out, as the provider counts"
    assert str(estimate + Usage(1, 5, 7)) == "2 calls, 7 tokens in and 8 out, estimated from the length of the texts"
