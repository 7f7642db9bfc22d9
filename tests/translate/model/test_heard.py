"""Who is spoken of, and which place; amounts and measures against their words: one fault at a time."""

from __future__ import annotations

from fractions import Fraction

import pytest

from scenewright.errors import Span
from scenewright.translate import story as st
from scenewright.translate.model.heard import Heard, Measured, read_amounts
from scenewright.translate.model.schema import Claim, locate

NAMES = {0: ("the ego", "The ego", "ego"), 1: ("the van", "A van", "van")}


@pytest.mark.parametrize(
    ("text", "at", "who"),
    [
        ("When the ego is 25 m and the van is 15 m before the stop line, it waits.", "25", {0}),
        ("When the ego is 25 m and the van is 15 m before the stop line, it waits.", "15", {1}),
        ("When the ego is 25 m and the van is 15 m before the stop line, it waits.", "waits", {0, 1}),
        ("The ego drives west. A van comes. It stops 5 m before it.", "5 m", {1}),
        ("25 m before the conflict point the van brakes at 3 m/s^2.", "3 m", {1}),
        ("The van brakes and stops 5 m before the stop line of the ego.", "5 m", {1}),
        ("The distance of the ego to the stop line is 12 m.", "12", {0}),
        ("With the ego 4 s short of the stop line the van goes.", "4 s", {0}),
        ("With the ego 4 s short of the stop line the van goes.", "goes", {1}),
        ("After waiting for 2 s the van goes on.", "2 s", {1}),
    ],
)
def test_who_is_spoken_of(text: str, at: str, who: set[int]) -> None:
    assert Heard(text, NAMES).subjects(text.index(at)) == who


@pytest.mark.parametrize(
    ("text", "at", "place"),
    [
        ("When the ego is 25 m and the van is 15 m before the stop line.", "25", "stop_line"),
        ("The ego is 25 m before the stop line and the van 15 m before the turn.", "15", "turn"),
        ("The ego is 25 m before the stop line and 40 m before the intersection.", "25", "stop_line"),
        ("The stop line is 8 m ahead of the van.", "8", "stop_line"),
        ("The ego is 8 m away.", "8", None),
    ],
)
def test_to_which_place_an_amount_is_counted(text: str, at: str, place: str | None) -> None:
    assert Heard(text, NAMES).place(text.index(at)) == place


def test_longest_name_is_heard_and_a_name_of_two_is_of_both() -> None:
    heard = Heard("The car under test sees the car.", {0: ("The car under test",), 1: ("the car",), 2: ("car",)})
    assert [each.value for each in heard.said[0] if each.kind == "who"] == ["0", "1"]
    both = Heard("A car waits.", {1: ("A car",), 2: ("A car",)})
    assert both.subjects(6) == {1, 2}


def test_clause_of_a_place() -> None:
    text = "The ego is 25 m and the van is 15 m before the stop line."
    told = [each.text for each in Heard(text, NAMES).clause(text.index("15"))]
    assert told == ["the van", "is", "15 m", "before", "the stop line"]


def test_text_without_any_word_of_meaning_is_heard_too() -> None:
    heard = Heard("the a", {0: ("the",)})
    assert heard.subjects(0) == {0}
    assert heard.place(4) is None


CALLED = {0: ("The ego", "the ego"), 1: ("the van", "A van")}
ACTORS = (st.Actor(0, "ego"), st.Actor(1, "van", kind="van"))


def quote(words: str, text: str) -> st.Quote:
    span = locate(words, text)[0]
    return st.Quote(span.start, span.end, span.excerpt(text))


def faults(text: str, value: str, unit: str, words: str, owned: str = "", **slots: object) -> str:
    """Return what the words of a whole text say against a measure of it."""
    amount = st.Amount(Fraction(value), unit, None, quote(words, text)) if value else None
    claim = Claim(st.Story(ACTORS), CALLED, owned=[(Span(0, len(text)), owned)])
    given = {
        "actor": 1,
        "quantity": st.Quantity.PLACE,
        "op": "==",
        "amount": amount,
        "quote": quote(text, text),
        **slots,
    }
    checked = Measured(claim, text, Heard(text, CALLED))
    found = [] if amount is None else [*checked.amount(amount, quote(words, text))]
    return "; ".join([*found, *checked.measure(st.Measure(**given), quote(text, text))])  # type: ignore[arg-type]


SPEED, GAP = st.Quantity.SPEED, st.Quantity.GAP
STOP_LINE = {"place": st.Place("stop_line")}
NEAR = "The ego is 25 m and the van is 15 m before the stop line"


@pytest.mark.parametrize(
    ("text", "value", "unit", "words", "slots", "fault"),
    [
        (NEAR, "15", "m", "15 m", STOP_LINE, ""),
        (NEAR, "25", "m", "25 m", STOP_LINE, "is said of ego, not of van"),
        (NEAR, "15", "m", "15 m", {"place": st.Place("turn")}, "does not name the turn"),
        (NEAR, "15", "ft", "15 m", STOP_LINE, "'15 m' is not 15 ft"),
        (NEAR, "15", "m", "15 m", {**STOP_LINE, "op": ">="}, "no bound"),
        (NEAR, "15", "m", "15 m", {**STOP_LINE, "opposite": True}, "`opposite` is true for past it alone"),
        ("the van is at least 15 m before the stop line", "15", "m", "15 m", STOP_LINE, "says >=, not =="),
        ("the van must not exceed 20 km/h", "20", "km/h", "20 km/h", {"quantity": SPEED, "op": "<="}, ""),
        ("the van drives at 20 km/h", "20", "km/h", "20 km/h", {"quantity": SPEED, "op": ">="}, "no bound"),
        ("the van passes the stop line", "", "m", "", STOP_LINE, ""),
        ("the van passes the stop line", "", "m", "", {**STOP_LINE, "op": ">"}, "`op` is =="),
        ("the van brakes at 3 m/s^2", "3", "m/s^2", "3 m/s^2", {"quantity": st.Quantity.RATE}, "slowing alone"),
        ("the van is 20 m behind the ego", "20", "m", "20 m", {"quantity": GAP, "other": 0}, ""),
        ("the van is 20 m ahead of the ego", "20", "m", "20 m", {"quantity": GAP, "other": 0}, "the other way"),
        ("the van has a time to collision of 2 s with the ego", "2", "s", "2 s",
         {"quantity": st.Quantity.HEADWAY, "other": 0}, "does not speak of a headway"),
        ("the van is 2 s behind the ego", "2", "s", "2 s",
         {"quantity": st.Quantity.COLLISION, "other": 0}, "does not speak of a time to collision"),
        ("the van drives faster than the ego", "", "s", "", {"quantity": SPEED, "other": 0, "op": "<"}, "says faster"),
        ("the van is 15 m before the stop line of the ego", "15", "m", "15 m", {"place": st.Place("stop_line", 0)}, ""),
    ],
)  # fmt: skip
def test_measure_against_its_words(
    text: str, value: str, unit: str, words: str, slots: dict[str, object], fault: str
) -> None:
    found = faults(text, value, unit, words, **slots)
    assert fault in found if fault else found == ""


def test_assumption_owns_to_a_unit_that_is_unsaid() -> None:
    text = "the van is 15 before the stop line"
    assert "does not say 15 m" in faults(text, "15", "m", "15", **STOP_LINE)
    assert faults(text, "15", "m", "15", owned="15 is in metres", **STOP_LINE) == ""
    assert faults(text, "16", "m", "15", owned="16 is in metres", **STOP_LINE) != ""


@pytest.mark.parametrize("said", ["when the gap is 20 m", "when the distance between both is 20 m"])
def test_who_was_ahead_at_the_start_is_behind_only_where_that_is_said_or_owned_to(said: str) -> None:
    text = f"A van drives 30 m behind the ego, and {said}, the van brakes"
    amount = st.Amount(Fraction(20), "m", None, quote("20 m", text))
    start = st.Measure(1, GAP, "==", st.Amount(Fraction(30), "m"), other=0)

    def found(rear: int, quantity: st.Quantity, owned: str = "") -> str:
        claim = Claim(st.Story(ACTORS, (st.Moment((start,)),)), CALLED, owned=[(Span(0, len(text)), owned)])
        measure = st.Measure(rear, quantity, "==", amount, other=1 - rear, quote=quote(said, text))
        return "; ".join(Measured(claim, text, Heard(text, CALLED)).measure(measure, quote(said, text)))

    for quantity in (GAP, st.Quantity.FREE_SPACE):
        assert "does not say that ego is behind van" in found(0, quantity)
        assert "as it was not at the start" not in found(0, quantity, "the ego is behind by then")
        assert "as it was not at the start" not in found(1, quantity)


@pytest.mark.parametrize(
    ("words", "value", "unit"),
    [
        ("25 m", "25", "m"), ("sixty feet", "60", "ft"), ("sixty-five metres", "65", "m"), ("1.5 m/s²", "3/2", "m/s^2"),
        ("half a second", "1/2", "s"), ("two and a half seconds", "5/2", "s"), ("a hundred and twenty m", "120", "m"),
        ("2½ s", "5/2", "s"), ("½ s", "1/2", "s"), ("1,200 m", "1200", "m"), ("2,5 s", "5/2", "s"),
        ("30-mph", "30", "mph"), ("50 kilometres per hour", "50", "km/h"), ("-3 m/s^2", "3", "m/s^2"),
        ("4 metres per second squared", "4", "m/s^2"), ("10/3 min", "10/3", "min"), ("just before", "5", "m"),
        ("a second", "1", "s"),
    ],
)  # fmt: skip
def test_numbers_and_units_in_many_words(words: str, value: str, unit: str) -> None:
    assert (Fraction(value), unit) in read_amounts(words)


def test_parameters_numbers_without_units_and_nothing() -> None:
    assert set(read_amounts("{hero_gap_m}")) == {("hero_gap_m", "m")}
    assert set(read_amounts("about 20")) == {(Fraction(20), None)}
    assert list(read_amounts("brakes")) == []
    assert (Fraction(4), "m/s") not in read_amounts("4 metres per second squared")
