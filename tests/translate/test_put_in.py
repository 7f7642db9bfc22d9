"""What is put in beside a name changes nothing of what a text means, or the text is refused."""

from __future__ import annotations

import random
import re
import tomllib
from pathlib import Path

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline

CASES = tomllib.loads(Path(__file__).with_name("paraphrases.toml").read_text(encoding="utf-8"))["case"]
BESIDE_NAMES = (
    ", which is on its way,", ", whose driver is attentive,", ", still under way,", ", by now,",
    ", having seen nothing,",
    ", unaware of this,", " (still under way)", ", which goes straight on,", ", which is not braking,", " (no turn)",
)  # fmt: skip
NAME = re.compile(
    r"\b(?:[Tt]he|[Oo]ur) (?:ego|hero|AV|SUT|van|car|other (?:car|vehicle))(?= (?:is|passes|begins|brakes|reaches|stops"
    r"|drives|turns|wants)\b)"
)


def meaning(text: str) -> tuple[list[tuple[str, str]], frozenset[str]]:
    program = translate_offline(text).program
    return (
        [(str(actor.route), str(actor.sketch)) for actor in program.actors],
        frozenset(print_expression(each.formula) for each in program.constraints),
    )


@pytest.mark.parametrize("added", BESIDE_NAMES)
def test_what_is_put_in_changes_nothing_or_is_refused(added: str) -> None:
    chance, tried = random.Random(20), 0
    for text in (case["text"] for case in chance.sample(CASES, 40)):
        for found in NAME.finditer(text):
            try:
                changed = meaning(text[: found.end()] + added + text[found.end() :])
            except TranslationError:
                continue
            finally:
                tried += 1
            assert changed == meaning(text), found
    assert tried > 40
