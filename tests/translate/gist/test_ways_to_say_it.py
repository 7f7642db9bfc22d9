"""More ways of saying that free texts use: names, limits, headings, functions; and what no program says is refused."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.aliases import without_aliases, without_short_names
from scenewright.translate.offline import translate_offline
from scenewright.translate.unsayable import refuse_unsayable

ROUTES = "The AV goes west, straight on. A van comes out of the driveway and turns left. "
ACTS = "When the AV is 40 m from the conflict point and the van 10 m from the stop line, "
STOPS = ACTS + "the van brakes to a stop 2 m before the stop line. "


def formulas(text: str) -> list[str]:
    return [print_expression(each.formula) for each in translate_offline(text).program.constraints]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("V1 (vehicle under test) goes west, straight on. V2 comes out of the driveway and turns left. When V1 was "
         "40 m from the conflict point and V2 10 m from its stop line, V2 braked to a stop 2 m before it.",
         "A1x(t1) == stop_line - 10"),
        ("An interacting vehicle (IV) is on the driveway and will turn left. The subject vehicle (SV) drives west, "
         "straight on. When SV is 40 m from the conflict point and IV 10 m from the stop line, IV brakes to a stop 2 m "
         "before the stop line.", "A1x(t1) == stop_line - 10"),
        ("Initial condition. The SV goes west and does not turn. The POV leaves the driveway to the left.\n"
         "Triggering event. The SV is 40 m and the POV 12 m from the conflict point.\n"
         "POV response. The POV brakes to a stop 8 m before the conflict point.", "A0x(t1) == conflict_point - 40"),
        (ROUTES + "When TTA(AV, conflict point) = 4 s and TTA(van, stop line) = 2 s, the van brakes to a stop 2 m "
         "before the stop line.", "tta(A1, stop_line, t1) == 2"),
        (ROUTES + ACTS + "the van accelerates. The van's passage of the conflict point precedes that of the AV.",
         "A1(t2) < A0(t2)"),
        (ROUTES + "When the AV is nine tenths of a second from the conflict point and the van 10 m from the stop line, "
         "the van brakes to a stop 2 m before the stop line.", "tta(A0, conflict_point, t1) == 9/10"),
        (ROUTES + "The AV starts a hundred and twenty feet from the intersection. " + STOPS,
         "A0x(t0) == intersection - 36.576"),
        (ROUTES + "When the AV has 40 m left to the conflict point and the van has got 10 to the stop line, the van "
         "brakes to a stop 2 m before the stop line.", "A1x(t1) == stop_line - 10"),
        (ROUTES + "The AV gets to 40 m from the conflict point, the van is 10 m from the stop line, and it brakes to a "
         "stop 2 m before the stop line.", "A0x(t1) == conflict_point - 40"),
        ("The AV leaves the driveway to the left. A van goes west, straight on. When the AV is 8 m from the stop line "
         "and the van 30 m from the conflict point, the van accelerates. It passes the conflict point first; the AV "
         "begins its turn only after that.", "A0x(t2) == turn_start"),
        (ROUTES + "When the AV is 40 m from the conflict point and the van 10 m from the driveway's stop line, the van "
         "brakes to a stop 2 m before the stop line.", "A1x(t1) == stop_line - 10"),
        (ROUTES + STOPS + "From the start until it has stopped, the van shall not exceed 8 m/s.",
         "always[A1(t0), A1(t2)](A1v <= 8)"),
        (ROUTES + STOPS + "Its deceleration must not exceed 3 m/s² at any time.", "A1a(dec) >= -3"),
        (ROUTES + STOPS + "At no moment from the trigger until it stands does the van go faster than 9 m/s.",
         "always[A1(t1), A1(t2)](A1v <= 9)"),
    ],
)  # fmt: skip
def test_it_is_read(text: str, expected: str) -> None:
    assert expected in [each.replace("0.9", "9/10") for each in formulas(text)]


@pytest.mark.parametrize(
    "text",
    [
        "The hero brakes at a rate sampled from a normal distribution.",
        "There is no hero vehicle on the driveway.",
        "The hero accelerates at an unchanging speed of 6 m/s.",
        "Scrap that about the van stopping, though.",
        "When, for the second time, the ego is 12 m from the stop line, the hero brakes.",
        "Then, waved on by the ego's driver, the hero accelerates.",
        "The hero sets off again on green.",
        "Tail first, a hatchback comes out of the driveway.",
        "It brakes to a stop just before the zebra crossing.",
    ],
)
def test_what_no_program_says_is_refused(text: str) -> None:
    with pytest.raises(TranslationError):
        refuse_unsayable(text, "text")


@pytest.mark.parametrize(
    "text",
    [
        "The hero vehicle brakes to a stop 5 m before the conflict point.",
        "Nobody overtakes here, and there is no other vehicle on the road.",
        "A green car and a red van are on the road. The van is green.",
        "The ego is 12 m from the stop line for a start.",
    ],
)
def test_what_a_program_may_say_is_not(text: str) -> None:
    assert refuse_unsayable(text, "text") is None


@pytest.mark.parametrize(
    "added",
    [
        "its left indicator has come on and ",  # a condition that is not known
        "the football is in the street and ",
    ],
)
def test_a_condition_that_is_not_known_is_refused(added: str) -> None:
    text = ROUTES + STOPS
    assert formulas(text)
    with pytest.raises(TranslationError):
        translate_offline(text.replace("and the van", f", {added}the van"))


@pytest.mark.parametrize(
    "last",
    [
        "The ego must not exceed 9 m/s at any time.",  # nobody tells the ego
        "The van shall not exceed 9 m/s until the bell rings.",  # a window that is not known
    ],
)
def test_a_limit_that_cannot_be_kept_is_refused(last: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline(ROUTES + STOPS + last)


def test_a_bound_within_a_condition_is_no_limit() -> None:
    asked = ACTS.replace("from the stop line, ", "from the stop line and its speed is at most 8 m/s, ")
    with pytest.raises(TranslationError):
        translate_offline(ROUTES + asked + "the van brakes to a stop 2 m before the stop line.")


@pytest.mark.parametrize("part", ["front bumper", "nose"])
def test_another_end_of_a_vehicle_is_not_its_centre(part: str) -> None:
    with pytest.raises(TranslationError):
        translate_offline((ROUTES + STOPS).replace("and the van", f"and the {part} of the van"))


def test_a_place_that_is_not_known_is_no_moment_of_the_ego() -> None:
    text = ROUTES + ACTS + "the van accelerates to complete its turn before the AV passes the {}."
    assert "A0x(t2) == conflict_point" in formulas(text.format("conflict point"))
    with pytest.raises(TranslationError):
        translate_offline(text.format("bus shelter"))


@pytest.mark.parametrize("names", [("V1", "V2"), ("Car A", "Car B"), ("Unit one", "Unit two")])
def test_aliases_keep_every_character_in_its_place(names: tuple[str, str]) -> None:
    text = f"{names[0]} (vehicle under test) goes west. {names[1]} turns left."
    read = without_aliases(text)
    assert len(read) == len(text)
    assert read.index("goes west") == text.index("goes west")
    assert names[0] not in read
    assert names[1] not in read


def test_what_is_no_alias_is_left_alone() -> None:
    for text in (
        "The ego is 12 m from it at t1.",
        "Route A1 is closed.",
        "The van (white) brakes.",
        "The van (red) brakes.",
        "A car (grey).",
    ):
        assert without_aliases(text) == text == without_short_names(text)
