"""What people put beside what they tell changes nothing; what only looks like it is not stepped over."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.gist.idioms import without_idioms
from scenewright.translate.offline import translate_offline

WAYS = (
    "The ego drives west along the road, straight on, and begins 90 m before the intersection. A hero comes towards it "
    "and is going to turn left into the driveway. "
)
BEGINS = "When the ego is 40 m and the hero 20 m from the conflict point, "
STOPS = "the hero brakes and stops 6 m before the conflict point."
GOES = "the hero accelerates and completes its turn before the ego passes the conflict point."


def formulas(text: str) -> list[str]:
    return [print_expression(each.formula) for each in translate_offline(text).program.constraints]


def routes(text: str) -> list[tuple[str, ...]]:
    return [each.route.headings for each in translate_offline(text).program.actors]  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("aside", "plain"),
    [
        (f"Not sure if this is the right place, but: {WAYS}{BEGINS}{STOPS}", WAYS + BEGINS + STOPS),
        (f"{WAYS}The ego closes in, and {BEGINS.lower()}{STOPS}", WAYS + BEGINS + STOPS),
        (f"{WAYS}{BEGINS}{STOPS[:-1]} so that the ego can go first.", WAYS + BEGINS + STOPS),
        (f"{WAYS}{BEGINS}the hero, although it should not, accelerates{GOES[20:]}", WAYS + BEGINS + GOES),
        (f"{WAYS}{BEGINS}{STOPS} It then revokes this, accelerates and goes through.", None),
        (f"{WAYS}The hero behaves badly: {BEGINS.lower()}{GOES}", WAYS + BEGINS + GOES),
        (f"{WAYS}Everything here is in metres.\n{BEGINS}{STOPS}", WAYS + BEGINS + STOPS),
        (f"{WAYS}{BEGINS.replace('is 40 m', 'is located 40 m')}{STOPS}", WAYS + BEGINS + STOPS),
        (f"{WAYS}{BEGINS}{STOPS} Thanks a lot!", WAYS + BEGINS + STOPS),
    ],
)
def test_an_aside_changes_nothing(aside: str, plain: str | None) -> None:
    expected = plain or f"{WAYS}{BEGINS}{STOPS} It then accelerates and goes through."
    if plain is None:
        with pytest.raises(TranslationError):
            translate_offline(aside.replace("revokes this", "revokes that promise of the van"))
    assert formulas(aside) == formulas(expected)


@pytest.mark.parametrize(
    "addition",
    [
        "Given a wave by the ego, it then goes on.",
        "No, halve one of the two distances.",
        "One of these distances is wrong.",
        "Then it goes back where it started.",
        "All of this happens the other way round on Sundays.",
        "It stops next to the letter box.",
        "It does so as hard as the car in front of it does.",
        "In most cases it then goes on.",
        "The ego pulls out round the hero.",
        "Then, without moving again, it passes the conflict point.",
    ],
)
def test_what_only_looks_like_one_is_refused(addition: str) -> None:
    assert formulas(WAYS + BEGINS + STOPS)
    with pytest.raises(TranslationError):
        translate_offline(f"{WAYS}{BEGINS}{STOPS} {addition}")


def test_a_fronted_participle_belongs_to_who_follows() -> None:
    told = WAYS.replace(
        "The ego drives west along the road, straight on, and begins 90 m before the intersection. ", ""
    )
    text = f"Being 90 m from the intersection, the ego drives west along the road, straight on. {told}{BEGINS}{STOPS}"
    assert formulas(text) == formulas(WAYS + BEGINS + STOPS)


@pytest.mark.parametrize(
    "trigger",
    [
        "When for the ego it is 4 s to the conflict point and for the hero it is 3 s to the conflict point, ",
        "At 4 s from the conflict point (ego) and 3 s from the conflict point (hero), ",
        "At four seconds from the conflict point for the ego and three for the hero, ",
        "Once 4 s remain to the ego before the conflict point and 3 s remain to the hero before the conflict point, ",
    ],
)
def test_whose_time_it_is(trigger: str) -> None:
    expected = {"tta(A0, conflict_point, t1) == 4", "tta(A1, conflict_point, t1) == 3"}
    assert expected <= set(formulas(WAYS + trigger + STOPS))


def test_a_vehicle_that_is_positioned_somewhere_does_not_stop_there() -> None:
    ways = (
        "The ego is positioned on the road, 90 m before the intersection, and goes straight on to the west. A hero is "
        "positioned on the same road at a distance of 60 m from the intersection, and goes straight on to the west. "
    )
    found = formulas(ways + "When the ego is 20 m behind the hero, the hero brakes at 3 m/s^2 to a standstill.")
    assert "A1x(t0) == intersection - 60" in found
    assert not any(each.startswith("A1x(t2)") for each in found)


def test_who_is_put_somewhere_standing_sets_off() -> None:
    text = (
        "The ego goes straight on to the west and begins 90 m from the intersection. The hero is initialised at a "
        "standstill at the stop line of the driveway and is to turn right. When the ego is 40 m from the "
        "conflict point, the hero sets off and completes its turn before the ego passes the conflict point."
    )
    assert {"A1v(stop) == 0", "A1x(t0) == stop_line"} <= set(formulas(text))


def test_a_speed_of_the_ego_that_is_told_last_is_its_own() -> None:
    last = " Start with the ego travelling at 12 m/s."
    assert "A0v(t0) == 12" in formulas(WAYS + BEGINS + GOES + last)


def test_whose_initial_speed_it_is() -> None:
    ways = WAYS.replace(", and begins 90 m before the intersection", "")
    told = "The initial distance of the ego to the intersection is 90 m and its initial speed is 12 m/s. "
    assert {"A0x(t0) == intersection - 90", "A0v(t0) == 12"} <= set(formulas(ways + told + BEGINS + GOES))


def test_who_comes_first_as_a_note() -> None:
    note = "Order: hero first, then ego."
    plain = (
        WAYS + BEGINS + "the hero accelerates and passes the conflict point before the ego passes the conflict point."
    )
    assert formulas(f"{WAYS}{BEGINS}the hero accelerates and passes the conflict point. {note}") == formulas(plain)


def test_all_of_this_has_an_order() -> None:
    order = "All of this is done before the ego passes the conflict point. "
    with pytest.raises(TranslationError):
        translate_offline(f"{order}{WAYS}{BEGINS}{STOPS} Then it drives on.")


def test_both_go_in_the_driveway() -> None:
    text = (
        "Both want to go in the driveway. The ego drives west and turns right, the hero drives east and turns left. "
        + BEGINS
        + STOPS
    )
    assert routes(text) == [("W", "N"), ("E", "N")]


def test_a_hero_that_yields_does_not_go_first() -> None:
    with pytest.raises(TranslationError):
        translate_offline(f"{WAYS}In this test the hero yields to the ego. {BEGINS}{GOES}")


def test_vehicles_in_single_file_come_the_same_way() -> None:
    with pytest.raises(TranslationError):
        translate_offline(f"Both come along the road in single file. {WAYS}{BEGINS}{STOPS}")


def test_a_dictated_text_has_its_full_stops_in_words() -> None:
    plain = (
        "the ego drives west and goes straight on. the hero drives east and wants to turn left into the driveway. "
        "when the ego is 40 m and the hero is 20 m from the conflict point the hero brakes to a stop 6 m before the "
        "conflict point."
    )
    assert formulas(plain.replace(".", " full stop")) == formulas(plain)


def test_what_stands_instead_of_a_turn_of_phrase_is_as_long() -> None:
    """Else excerpts in messages, and what is said of each clause, would stand a few letters off."""
    folder = Path(__file__).parent.parent / "texts"
    for name in ("paper_kind", "prose"):
        texts = [row["text"] for row in tomllib.loads((folder / f"{name}.toml").read_text("utf-8"))["text"]]
        assert [text for text in texts[::40] if len(without_idioms(text)) != len(text)] == []
