"""One slip in a long word is corrected; what may be a word of its own is not."""

from __future__ import annotations

import pytest

from scenewright.language.read.chunks import vocabulary
from scenewright.language.read.spelling import LONG, corrected, nearest

KNOWN = frozenset({"intersection", "driveway", "accelerates", "accelerate", "brakes"})


@pytest.mark.parametrize(
    ("word", "meant"),
    [("intersecton", "intersection"), ("drivveway", "driveway"), ("dirveway", "driveway"), ("driveqay", "driveway"),
     ("driveway", None), ("braeks", None), ("drivwy", None), ("interjection", None)],
)  # fmt: skip
def test_what_is_corrected(word: str, meant: str | None) -> None:
    assert corrected(word, KNOWN, frozenset({"interjection"})) == meant


def test_a_word_that_may_be_two_is_none_of_them() -> None:
    assert corrected("accelerat", frozenset({"accelerate", "accelerata"}), frozenset()) is None
    assert nearest("braeks", KNOWN) == ["brakes"]


def test_real_words_that_look_like_ours_are_known_and_every_one_is_needed() -> None:
    known = vocabulary()
    for word in known.lookalikes - known.words:
        assert len(word) >= LONG - 1
    assert {"interjection", "collisions", "deceased"} & known.lookalikes
