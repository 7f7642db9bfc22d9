"""Exchanges: keys that are the same for the same words, tokens that are counted."""

from __future__ import annotations

from scenewright.translate.model.exchange import Call, Message, Usage, key_of

CALL = Call((Message("user", "a" * 8),), "a", 1, "m")


def test_key_is_of_the_model_and_the_words_alone() -> None:
    again = Call(CALL.messages, "another", 2, "n", {"type": "object"})
    assert key_of("said:so", CALL) == key_of("said:so", again)
    assert key_of("said:so", CALL) != key_of("other", CALL)
    assert key_of("said:so", CALL) != key_of("said:so", Call((Message("system", "a" * 8),), "a", 1, "m"))


def test_tokens_add_up_where_they_are_counted() -> None:
    assert str(Usage()) == "1 call"
    assert str(Usage() + Usage(1, 5, 7)) == "2 calls, 5 tokens in and 7 out"
