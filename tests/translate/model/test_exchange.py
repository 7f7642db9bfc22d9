"""Exchanges: keys that are the same for the same words, tokens that are counted, settings that need no library."""

from __future__ import annotations

import subprocess
import sys

from scenewright.translate.model.exchange import Call, Message, TranslatorSettings, Usage, key_of

CALL = Call((Message("user", "a" * 8),), "a", 1, "m")


def test_key_is_of_the_model_and_the_words_alone() -> None:
    again = Call(CALL.messages, "another", 2, "n", {"type": "object"})
    assert key_of("said:so", CALL) == key_of("said:so", again)
    assert key_of("said:so", CALL) != key_of("other", CALL)
    assert key_of("said:so", CALL) != key_of("said:so", Call((Message("system", "a" * 8),), "a", 1, "m"))


def test_tokens_add_up_where_they_are_counted() -> None:
    assert str(Usage()) == "1 call"
    assert str(Usage() + Usage(1, 5, 7)) == "2 calls, 5 tokens in and 7 out"


def test_usual_settings_ask_nobody_twice_for_nothing() -> None:
    usual = TranslatorSettings()
    assert (usual.strict, usual.second_opinion, usual.record, usual.replay, usual.ask) == (
        False,
        False,
        None,
        None,
        None,
    )
    assert usual.answers == {}


def test_settings_need_no_library() -> None:
    code = (
        "import sys, scenewright.translate.model.exchange; sys.exit('pydantic' in sys.modules or 'z3' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
