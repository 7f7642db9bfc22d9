"""Words become typed chunks: the longest phrase, amounts with their units, offsets into the text."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.translate.read.chunks import nearest_words, sentences, vocabulary, word_as


@pytest.mark.parametrize(
    ("text", "value", "unit", "name"),
    [
        ("12 m", 12, "m", None), ("12m", 12, "m", None), ("-2.5 m/s^2", Fraction(-5, 2), "m/s^2", None),
        ("1/3 s", Fraction(1, 3), "s", None), ("thirty mph", 30, "mph", None), ("50 km/h", 50, "km/h", None),
        ("40-ft", 40, "ft", None), ("gap_m", None, "m", "gap_m"), ("{gap} m", None, "m", "gap_m"),
        ("{first_speed_mps}m/s", None, "m/s", "first_speed_mps"),
    ],
)  # fmt: skip
def test_amounts(text: str, value: Fraction | None, unit: str, name: str | None) -> None:
    ((chunk,),) = sentences(text)
    assert chunk.amount is not None
    assert (chunk.amount.value, chunk.amount.unit, chunk.amount.name) == (value, unit, name)


@pytest.mark.parametrize("text", ["12", "12 kg", "{gap}", "some_name", "{gap_m} s"])
def test_amounts_without_a_unit_are_told_apart(text: str) -> None:
    assert sentences(text)[0][0].kind == "no unit"


def test_the_longest_phrase_wins() -> None:
    kinds = {
        text: sentences(text)[0][0].value
        for text in ("begins to turn", "at the start of the turn", "drives on the road")
    }
    assert kinds == {"begins to turn": "turn_start", "at the start of the turn": "at", "drives on the road": "drives"}


def test_sentences_and_offsets() -> None:
    text = "The car 'blue' follows the lanes 1.0.-1, 14.0.-1. It's 2.5 m away; done."
    found = sentences(text)
    assert len(found) == 3
    for chunk in (chunk for chunks in found for chunk in chunks):
        assert text[chunk.start : chunk.end] == chunk.text
    assert found[0][1].value == "1.0.-1, 14.0.-1"


def test_a_phrase_is_one_thing() -> None:
    seen: dict[tuple[str, ...], tuple[str, str]] = {}
    for phrases in vocabulary().phrases.values():
        for words, kind, value in phrases:
            assert seen.setdefault(words, (kind, value)) == (kind, value), words


def test_words_that_nobody_knows() -> None:
    (chunk,) = sentences("raod")[0]
    assert chunk.kind == "unknown"
    assert "road" in nearest_words("raod")
    assert word_as(chunk, "road").kind == "area"


def test_a_slip_of_a_long_word_is_kept_with_what_it_means() -> None:
    (chunk,) = sentences("drivway")[0]
    assert (chunk.kind, chunk.text, chunk.slips) == ("area", "drivway", ("driveway",))


def test_labels_numbers_and_lines_part_what_they_name() -> None:
    found = sentences("1. Ego: westbound\n- Trigger: gap 20 m\nAction: the oncoming red car brakes")
    assert [[chunk.kind for chunk in chunks] for chunks in found] == [
        ["actor", "heading"], ["link", "quantity", "amount"], ["actor", "deed"],
    ]  # fmt: skip
    assert [trait.kind for trait in found[2][0].traits] == ["relation", "quality"]
