"""What the network answers becomes a program; what it was taught is what its examples mean."""

from __future__ import annotations

import random
import tomllib
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from scenewright.program.expressions import Number, ParameterRef, walk
from scenewright.program.printer import print_expression
from scenewright.program.text import parse_program
from scenewright.study.meaning import differences
from scenewright.translate.itineraries import default_map
from scenewright.translate.learned import reader
from scenewright.translate.learned.consistency import BOTH
from scenewright.translate.learned.network import Answers, Network, load_network
from scenewright.translate.learned.pieces import Pieces
from scenewright.translate.learned.reader import Likely, read_likely

TEXTS = Path(__file__).parents[1] / "texts"
MEANINGS = load_network().meanings
SAMPLE = 250

PLAIN = (
    "At the start the ego is in the driveway, 30 m before the stop line; it turns left onto the road and heads east. "
    "The hero drives west along the road, straight on. When the ego is 12 m before the stop line and the hero is 25 m "
    "before the conflict point, the hero begins to brake and comes to a complete stop at 6 m before the conflict point."
)


def answer_with(monkeypatch: pytest.MonkeyPatch, answers: Answers) -> None:
    monkeypatch.setattr(Network, "answer", lambda self, pieces: answers)


def surely(count: int, answer: int, sure: float = 1.0) -> np.ndarray:
    likely = np.full(count, (1 - sure) / (count - 1), np.float32)
    likely[answer] = sure
    return likely


def right_answers(pieces: int, ego: int, hero: int, story: int, parts: list[int], sure: float = 1.0) -> Answers:
    likely = {
        "ego": surely(len(MEANINGS["ways"]), ego, sure),
        "hero": surely(len(MEANINGS["ways"]), hero),
        "story": surely(len(MEANINGS["stories"]), story),
        "sayable": surely(2, 1),
    }
    counted = {question: np.full(pieces, 1 / pieces, np.float32) for question in likely}
    amounts = np.stack([surely(len(MEANINGS["parts"]), part) for part in parts])
    return Answers(likely, counted, amounts)


def test_the_answers_that_are_taught_are_what_the_texts_mean(
    training: tuple[ModuleType, ModuleType], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Taken apart as the training does it, and put together as the reader does it, a program stays what it was."""
    lessons, _ = training
    stories = [(story["sketch"], *story["constraints"]) for story in MEANINGS["stories"]]
    rows = [
        row
        for name in ("paper_kind.toml", "prose.toml")
        for row in tomllib.loads((TEXTS / name).read_text(encoding="utf-8"))["text"]
        if "program" in row
    ]
    asked, of_both, unread, wrong = 0, 0, [], []
    both = [row for row in rows if row["id"].startswith("re-")]  # among them amounts that are told of both
    for row in [*random.Random(3).sample(rows, SAMPLE), *both]:
        found = lessons.amounts_in(row["text"], row["id"])
        if found is None:
            continue
        text, amounts = found
        program, told = parse_program(row["program"]), [lessons.value_of(each) for each in amounts]
        example = lessons.Example(row["id"], [], [])
        meant = lessons.meant_by(program, told)
        lessons.answer(example, meant and lessons.joined(meant, told), told, stories, MEANINGS["parts"])
        if not example.sayable or any(len(parts) > 1 for parts in example.parts):
            continue  # two parts with one value: the text alone tells which is which
        asked += 1
        parts = [each[0] for each in example.parts]
        of_both += any(BOTH in MEANINGS["parts"][part] for part in parts)
        monkeypatch.setattr(
            Network, "answer",
            lambda self, pieces, e=example, p=parts: right_answers(len(pieces.numbers), e.ego, e.hero, e.story, p),
        )  # fmt: skip
        likely = read_likely(text, row["id"], default_map())
        if likely is None or likely.probability == 0.0:  # a word of the text is taken to say otherwise
            unread.append(row["id"])
        elif differences(program, likely.program):
            wrong.append(row["id"])
    assert asked > SAMPLE / 2
    assert of_both > 3
    assert wrong == []
    assert len(unread) <= 0.04 * asked, unread


def read_plain() -> Likely:
    likely = read_likely(PLAIN, "plain", default_map())
    assert likely is not None
    return likely


def test_a_plain_text_is_read() -> None:
    likely = read_plain()
    assert likely.probability > 0.5
    assert [print_expression(each.formula) for each in likely.program.constraints] == [
        "A0x(t0) == stop_line - 30",
        "A0(t1) == A1(t1)",
        "A0x(t1) == stop_line - 12",
        "A1x(t1) == conflict_point - 25",
        "A1x(t2) == conflict_point - 6",
        "A1v(t2) == 0",
    ]


def test_every_amount_points_at_its_words() -> None:
    for constraint in read_plain().program.constraints:
        for node in walk(constraint.formula):
            if isinstance(node, Number) and node.value:
                assert node.span is not None
                assert node.span.excerpt(PLAIN).startswith(f"{float(node.value):g} m")
                assert constraint.source is not None
                assert node.span.excerpt(PLAIN) in constraint.source.excerpt(PLAIN)


def test_the_parts_cover_all_constraints() -> None:
    likely = read_plain()
    told = [identifier for part in likely.parts for identifier in part.constraint_ids]
    assert sorted(told) == sorted(constraint.id for constraint in likely.program.constraints)


def test_parameters_keep_their_names() -> None:
    text = PLAIN.replace("12 m", "ego_gap_m").replace("at 6 m", "at end_gap_m")
    likely = read_likely(text, "named", default_map())
    assert likely is not None
    names = {n.name for each in likely.program.constraints for n in walk(each.formula) if isinstance(n, ParameterRef)}
    assert names == {"ego_gap_m", "end_gap_m"} == {each.name for each in likely.program.parameters}


def test_the_probability_is_that_of_all_answers_together(monkeypatch: pytest.MonkeyPatch) -> None:
    part = MEANINGS["parts"].index("A0x(t1) == stop_line - #")
    story = next(at for at, each in enumerate(MEANINGS["stories"]) if each["constraints"] == ["A1v(t2) == 0"])
    ways = [MEANINGS["ways"].index(way) for way in (["S", "E"], ["W"])]
    text = "The ego is 12 m behind it."
    answer_with(monkeypatch, right_answers(9, *ways, story, [part], 0.6))
    monkeypatch.setattr(reader, "cut", lambda *_: Pieces((0,) * 9, (4,), (reader.Span(0, 5),) * 9))
    likely = read_likely(text, "unsure", default_map())
    assert likely is not None
    assert likely.probability == pytest.approx(0.6, abs=1e-3)


def test_two_amounts_for_one_thing_are_no_program(monkeypatch: pytest.MonkeyPatch) -> None:
    part = MEANINGS["parts"].index("A0x(t1) == stop_line - #")
    ways = [MEANINGS["ways"].index(way) for way in (["S", "E"], ["W"])]
    monkeypatch.setattr(
        Network, "answer", lambda self, pieces: right_answers(len(pieces.numbers), *ways, 0, [part] * len(pieces.marks))
    )
    assert read_likely("The ego is 12 m behind it, or 13 m.", "two", default_map()) is None
    assert read_likely("The ego is 12 m behind it, 12 m.", "twice", default_map()) is not None


@pytest.mark.parametrize("text", ["", "The ego turns left.", "The ego is a_strange_name behind it, 3 m."])
def test_a_text_without_amounts_that_can_be_read_is_left_alone(text: str) -> None:
    assert read_likely(text, "nothing", default_map()) is None


@pytest.mark.parametrize(
    ("added", "read"),
    [
        ("Two cars meet here.", True),
        ("Step 3: this is all.", True),
        ("There are three things to see.", True),
        ("The hero is at 20.", False),
        ("At 12 for the ego this begins.", False),
        ("It is three from there.", False),
        ("The ego has 3 m, the hero two and a half.", False),
    ],
)
def test_a_number_without_a_unit_counts_something_or_is_missed(
    added: str, read: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    part = MEANINGS["parts"].index("A0x(t1) == stop_line - #")
    ways = [MEANINGS["ways"].index(way) for way in (["S", "E"], ["W"])]
    monkeypatch.setattr(
        Network, "answer", lambda self, pieces: right_answers(len(pieces.numbers), *ways, 0, [part] * len(pieces.marks))
    )
    assert (read_likely(f"The ego is 3 m behind it. {added}", "counted", default_map()) is not None) is read


@pytest.mark.parametrize(
    ("text", "read"),
    [
        ("When both are 12 m from it, it brakes.", False),
        ("Each of them does 12 m/s.", False),
        ("Both turn left, and the ego is 12 m from it.", True),
        ("Both turn left. The ego is 12 m from it.", True),
    ],
)
def test_what_is_told_of_both_is_left_to_the_rules(text: str, read: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    part = MEANINGS["parts"].index("A0v(t0) == #" if "m/s" in text else "A0x(t1) == stop_line - #")
    ways = [MEANINGS["ways"].index(way) for way in (["S", "E"], ["W"])]
    monkeypatch.setattr(Network, "answer", lambda self, pieces: right_answers(len(pieces.numbers), *ways, 0, [part]))
    likely = read_likely(text, "both", default_map())
    assert likely is not None
    assert (likely.probability > 0.9) is read


def test_one_amount_may_be_told_of_both(monkeypatch: pytest.MonkeyPatch) -> None:
    part = MEANINGS["parts"].index("A0v(t0) == # & A1v(t0) == #")
    ways = [MEANINGS["ways"].index(way) for way in (["S", "E"], ["W"])]
    monkeypatch.setattr(Network, "answer", lambda self, pieces: right_answers(len(pieces.numbers), *ways, 0, [part]))
    likely = read_likely("Each of them does 12 m/s.", "both", default_map())
    assert likely is not None
    assert likely.probability > 0.9
    assert {"A0v(t0) == 12", "A1v(t0) == 12"} <= {print_expression(each.formula) for each in likely.program.constraints}


@pytest.mark.parametrize(
    "said",
    [
        "at least 12 m from it", "12 m from it at most", "no less than 12 m from it", "12 m or more from it",
        "12 m from the tree", "12 m short of the painted bar", "no farther away than 12 m from it",
        "12 m or closer to it",
    ],
)  # fmt: skip
def test_a_bound_or_a_place_that_nobody_knows_is_no_amount(said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    part = MEANINGS["parts"].index("A0x(t1) == stop_line - #")
    ways = [MEANINGS["ways"].index(way) for way in (["S", "E"], ["W"])]
    monkeypatch.setattr(Network, "answer", lambda self, pieces: right_answers(len(pieces.numbers), *ways, 0, [part]))
    likely = read_likely(f"When the ego is {said}, the hero brakes.", "bound", default_map())
    assert likely is None or likely.probability == 0.0
    plain = read_likely("When the ego is 12 m from it, the hero brakes.", "plain", default_map())
    assert plain is not None
    assert plain.probability > 0.9


def test_a_long_text_is_left_alone() -> None:
    assert read_likely(f"{PLAIN} {'It is so. ' * 100}", "long", default_map()) is None


def test_another_map_is_left_alone() -> None:
    assert read_likely(PLAIN, "elsewhere", replace(default_map(), name="elsewhere")) is None
