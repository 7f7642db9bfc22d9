"""What is put in beside a name, a place or a moment changes nothing of what a text means, or the text is refused."""

from __future__ import annotations

import random
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline

FOLDER = Path(__file__).with_name("texts")
BESIDE_NAMES = (
    ", which is on its way,", ", whose driver is attentive,", ", still under way,", ", by now,", ", for its part,",
    ", having seen nothing,", ", coming along,", ", unaware of this,", ", which nobody has seen,", " (still under way)",
)  # fmt: skip
BESIDE_PLACES = (", which is marked in yellow,", " (marked in yellow)", ", a place known to everybody,")
MOMENTS = ("as soon as ", "once ", "at the very moment when ", "the moment ", "exactly when ")
NAME = re.compile(
    r"\b(?:[Tt]he|[Oo]ur) (?:ego|hero|AV|SUT|NPC|POV|van|car|other (?:car|vehicle))(?= (?:is|has|passes|begins|starts"
    r"|brakes|accelerates|gets|comes|reaches|stops|drives|turns|completes|wants|yields|slows|goes)\b)"
)
PLACE = re.compile(r"\bthe (?:conflict point|stop line|intersection)(?=[,.;])")
MOMENT = re.compile(r"\b[Ww]hen (?=the |it )")
SAMPLE = 90


def texts() -> list[tuple[str, str]]:
    found = []
    for name in ("paper_kind.toml", "prose.toml"):
        rows = tomllib.loads((FOLDER / name).read_text(encoding="utf-8"))["text"]
        found += [(row["id"], row["text"]) for row in rows if "program" in row]
    return found


def meaning(text: str) -> tuple[list[tuple[str, str]], frozenset[str]]:
    program = translate_offline(text).program
    return (
        [(str(actor.route), str(actor.sketch)) for actor in program.actors],
        frozenset(print_expression(each.formula) for each in program.constraints),
    )


def beside(pattern: re.Pattern[str], said: tuple[str, ...]) -> Callable[[str, random.Random], str | None]:
    def put_in(text: str, chance: random.Random) -> str | None:
        places = list(pattern.finditer(text))
        if not places:
            return None
        at, added = chance.choice(places).end(), chance.choice(said)
        added = added.removesuffix(",") if text[at] in ",.;" else added
        return text[:at] + added + text[at:]

    return put_in


def another_moment(text: str, chance: random.Random) -> str | None:
    places = list(MOMENT.finditer(text))
    if not places:
        return None
    found = chance.choice(places)
    moment = chance.choice(MOMENTS)
    moment = moment.capitalize() if found.group()[0].isupper() else moment
    return text[: found.start()] + moment + text[found.end() :]


@pytest.mark.parametrize(
    "change",
    [beside(NAME, BESIDE_NAMES), beside(PLACE, BESIDE_PLACES), another_moment],
    ids=["name", "place", "moment"],
)
def test_what_is_put_in_changes_nothing(change: Callable[[str, random.Random], str | None]) -> None:
    chance = random.Random(20)
    told, same, other = texts(), 0, []
    chance.shuffle(told)
    for identifier, text in told[: 3 * SAMPLE]:
        changed = change(text, chance)
        if changed is None or same >= SAMPLE:
            continue
        try:
            plain, put_in = meaning(text), meaning(changed)
        except TranslationError:
            continue
        same += plain == put_in
        if plain != put_in:
            other.append((identifier, changed))
    assert other == []
    assert same > SAMPLE / 2


def test_a_bound_goes_on_after_what_is_put_in() -> None:
    """The ego's "passes" was once the hero's, and the goal of the hero's turn was lost."""
    told = (
        "The hero comes out of the driveway and turns left, heading east. The ego is at first 80 m from the junction. "
        "When the ego is 40 m from the conflict point and the hero is 9 m from the stop line, the hero accelerates and "
        "completes its turn before the westbound ego{} passes the conflict point."
    )
    plain = meaning(told.format(""))
    assert "A1x(t2) == turn_end" in plain[1]
    for put_in in (
        ", which continues straight,",
        ", westbound and going straight,",
        ", still on its way,",
        " (no turn)",
    ):
        assert meaning(told.format(put_in)) == plain
