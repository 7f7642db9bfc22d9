"""Ordinary sentences that were misread in silence: where somebody is, when something is so, and who is meant."""

from __future__ import annotations

import pytest
from readings import formulas, reading_of

from scenewright.errors import UnknownWordsError
from scenewright.translate.read.sentences import read
from scenewright.translate.understand import understand


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("The ego turns left at the stop line.", "'the stop line'"),
        ("The ego drives to the intersection.", "not clear when this is so"),
        ("The ego drives on to the intersection.", "not clear when this is so"),
        ("The ego comes to the stop line.", "not clear when this is so"),
        ("The ego drives past the intersection.", "not clear when this is so"),
        ("The ego turns left at 5 m/s.", "not clear when this is so"),
        ("The hero drives to the stop line and stops there. The ego turns left.", "'there'"),
    ],
)
def test_where_and_how_fast_somebody_will_be_is_not_told_of_the_start(text: str, told: str) -> None:
    with pytest.raises(UnknownWordsError, match=told):
        understand(f"{text} An oncoming car brakes when the ego is 30 m from the intersection.")


@pytest.mark.parametrize("way", ["turns left", "goes straight", "drives straight", "turns right"])
@pytest.mark.parametrize("where", ["at the intersection", "at the junction", "through the intersection"])
def test_where_a_way_turns_is_not_where_somebody_begins(way: str, where: str) -> None:
    rest = "An oncoming car brakes to a stop when the ego is 30 m from the intersection."
    found, told = (understand(f"The ego {each}. {rest}").program for each in (f"{way} {where}", way))
    assert [each.formula for each in found.constraints] == [each.formula for each in told.constraints]
    assert found.actors == told.actors


OUT = "The ego turns left out of the driveway. A car drives west along the road. "
LEADS = "The ego drives west. A van drives ahead of it in the same lane. "
MERGES = "The ego drives west."
TURNS = "The ego drives west. A van turns right out of the driveway. "
TWO = "The ego turns left out of the driveway. A car drives west. A truck drives east. "
AT_10 = "When the ego is 10 m before the stop line, "
AT_20 = "When the ego is 20 m behind the van, "


@pytest.mark.parametrize(
    "text",
    [
        f"{OUT}The car goes straight on past the intersection. {AT_10}the car brakes.",
        f"{OUT}The car drives west at the intersection. {AT_10}the car brakes.",
        f"{OUT}The car drives at 30 mph at the intersection. {AT_10}the car brakes.",
        f"{OUT}{AT_10}the car drives at 5 m/s to the stop line and stops.",
        f"{LEADS}{AT_20}the van accelerates at the stop line.",
        f"{LEADS}{AT_20}the van brakes at the stop line.",
        f"{LEADS}{AT_20}the van drives on at the stop line.",
        f"{LEADS}The van drives at 5 m/s. {AT_20}the van sets off.",
        f"{LEADS}{AT_20}the van brakes to 5 m/s. Then it pulls away.",
        f"{LEADS}{AT_20}the van brakes to a stop. When it sets off, the ego is 5 m behind it.",
        f"{LEADS}{AT_20}the van brakes to a stop. When the van drives on, the ego is at 5 m/s.",
        f"{LEADS}{AT_20}the van brakes to a stop. Until it sets off, the gap is at least 5 m.",
        *(
            f"{OUT}{AT_10}the car brakes to a stop. {then} the ego turns left."
            for then in ("Then", "After that", "Later", "At that moment", "Meanwhile")
        ),
        f"{MERGES} A van turns right out of the driveway, then brakes to a stop.",
        f"{OUT}The car stops at the stop line, then turns right.",
        f"{OUT}{AT_10}the car brakes to 5 m/s. It turns right. Then it accelerates.",
        *(f"{OUT}The car {way}, then stops." for way in ("drives west", "goes straight on", "comes from the east")),
        f"{LEADS}After the turn, the van brakes to a stop.",
        f"{LEADS}When the ego is 20 m behind the van after braking, the van accelerates.",
        *(
            f"{TWO}{AT_10}{which} brakes to a stop."
            for which in ("the vehicle", "that vehicle", "the heavy vehicle", "one", "the first one", "the first")
        ),
        f"{MERGES} A red car drives west. A blue car drives east. {AT_10}the blue car brakes. The car waits for 2 s.",
        *(
            f"{OUT}Trigger: {when}. Action: the car brakes to a stop."
            for when in ("the ego is 10 m before the stop line, 5 m/s", "ego at 5 m/s, 10 m before the stop line")
        ),
        *(
            f"{LEADS}{AT_20}the van brakes to a stop. When stopped, {who} is 10 m from the intersection."
            for who in ("the van", "it")
        ),
        f"{MERGES} A van approaches the driveway. {AT_10}the van brakes.",
        f"{MERGES} A van drives in the left lane. {AT_10}the van brakes.",
        f"{LEADS}The van drives off the road. {AT_20}the van brakes.",
        f"{OUT}{AT_10}the car brakes to a stop. The ego passes the conflict point directly after the car stops.",
        *(f"{OUT}{AT_10}the car stops {how} behind the stop line." for how in ("just", "right", "directly")),
        f"{LEADS}{AT_20}the van brakes to 5 m/s having passed the intersection.",
        f"{MERGES} A van is 20 m in front of it and a car 20 m behind it. {AT_10}the van brakes.",
        *(
            f"{OUT}{AT_10}the car {does}."
            for does in (
                "brakes to turn right",
                "is first at the conflict point",
                "accelerates to 9 m/s there",
                "goes first, keeping its speed",
                "keeps its speed and goes first",
            )
        ),
        f"{OUT}{AT_10}only the car brakes.",
        *(f"{LEADS}When the ego is 20 m behind the van and {so}, the van brakes." for so in ("moving", "still moving")),
        *(
            f"{MERGES} {who} is 50 m ahead. {AT_20.replace('van', 'truck')}the truck accelerates to 8 m/s."
            for who in ("A slow truck", "A braking truck", "The stopping truck", "A moving truck")
        ),
        *(
            f"{LEADS}When the ego is 20 m behind the van {where}, the van brakes."
            for where in ("at the stop line", "30 m before the intersection", "at 10 m/s or more", "with 10 m/s")
        ),
        *(
            f"{LEADS}{AT_20}the van brakes to a stop. {then}."
            for then in (
                "The van drives at 10 m/s until it brakes",
                "Meanwhile it accelerates to 8 m/s",
                "Meanwhile it waits for 3 s",
                "Meanwhile the ego passes the intersection",
                "Instead, it drives on",
                "It stops when the ego stops",
                "It brakes when the ego is at the intersection",
                "It waits until it has passed the intersection",
                "When it passes the intersection, it accelerates to 8 m/s",
            )
        ),
        *(f"{LEADS}{AT_20}the van brakes to a stop and {so}." for so in ("the gap is 5 m", "the ego is at 5 m/s")),
        *(f"{LEADS}{AT_20}the van {does} 5 m/s for 4 s." for does in ("brakes to", "slows down to")),
        f"{LEADS}The van's deceleration is 3 m/s^2. {AT_20}the van brakes to a stop.",
        f"{LEADS}The van is 40 m ahead of it, which drives at 8 m/s. {AT_20}the van brakes.",
        *(
            f"{TURNS}When the ego is 40 m before the conflict point, the van {does}."
            for does in (
                "passes the stop line 1 s ahead of the ego",
                "finishes its turn 20 m ahead of the ego",
                "is turning right",
                "wants to turn right",
                "starts its turn and stops",
                "turns right accelerating to 8 m/s",
                "turns right braking to a stop",
                "turns right, waiting for 2 s",
                "passes the stop line, driving at 5 m/s",
                "passes the stop line, keeping its speed",
            )
        ),
        f"{TURNS}The van has just turned right. {AT_10}the van brakes.",
        f"{TURNS}When the ego is about to pass the intersection, the van brakes.",
        f"{LEADS}When the ego (at 10 m/s) is 20 m behind the van (at 8 m/s), the van brakes to a stop.",
        f"{OUT}{AT_10}the car brakes to a stop. It waits 2 s after the ego has passed the conflict point.",
        f"{OUT}The ego must wait. {AT_10}the car brakes to a stop.",
        *(f"{OUT}{AT_10}the car brakes to a stop. It {way}." for way in ("drives west", "goes straight on")),
        f"{OUT}{AT_10}the car brakes. Until the ego passes the intersection, the car stays at least 20 m from it.",
        *(
            f"{TURNS}{AT_10}the van {does}."
            for does in (
                "leaves the driveway and stops",
                "comes out of the driveway and accelerates to 5 m/s",
                "stops in the driveway",
                "waits in the driveway for 3 s",
                "accelerates onto the road",
            )
        ),
    ],
)
def test_what_may_mean_two_things_is_refused_or_asked(text: str) -> None:
    assert reading_of(text).kind in ("refused", "asked")


@pytest.mark.parametrize(
    ("text", "plainer"),
    [
        *((f"{OUT}The car {to} the stop line. {AT_10}the car brakes.",
           f"{OUT}The car drives on until it passes the stop line. {AT_10}the car brakes.")
          for to in ("is headed to", "heads to", "follows the road to", "keeps its lane to", "goes straight on to")),
        *((f"{OUT}{AT_10}the car {to} the stop line and stops.", f"{OUT}{AT_10}the car stops at the stop line.")
          for to in ("goes to", "heads to", "comes to", "drives on to")),
        *((f"{LEADS}{AT_20}the van {does}.", f"{LEADS}The van stands. {AT_20}the van drives on.")
          for does in ("sets off", "starts moving", "pulls away")),
        (f"{LEADS}{AT_10}the van sets off at the stop line.",
         f"{LEADS}The van stands. {AT_10.removesuffix(', ')} and the van is at the stop line, the van drives on."),
        (f"{LEADS}{AT_20}the van begins to brake at the stop line to 5 m/s.",
         f"{LEADS}When the ego is 20 m behind the van and the van is at the stop line, the van brakes to 5 m/s."),
        *((f"{OUT}{AT_10}the car brakes to a stop. Then it {way}.",
           f"{OUT}{AT_10}the car brakes to a stop. Then it drives on.") for way in ("drives west", "goes straight on")),
        (f"{OUT}{AT_10}the car brakes to a stop, waits 2 s and goes straight on.",
         f"{OUT}{AT_10}the car brakes to a stop, waits 2 s and drives on."),
        (f"{OUT}The car stands at the stop line. {AT_10}the car drives straight on and stops at the intersection.",
         f"{OUT}The car stands at the stop line. {AT_10}the car drives on and stops at the intersection."),
        (f"{TURNS}After turning right, the van brakes to a stop.",
         f"{TURNS}When the van is at or past the end of the turn, the van brakes to a stop."),
        (f"{OUT}The car brakes {AT_10.lower().removesuffix(', ')} and stands 5 m before the conflict point.",
         f"{OUT}{AT_10}the car brakes to a stop 5 m before the conflict point."),
        *((f"{LEADS}{AT_20}the van {does}.", f"{LEADS}{AT_20}the van sets off.")
          for does in ("starts", "starts driving", "starts to move")),
        (f"The ego turns left out of the driveway. {AT_10}a car brakes to a stop. The car drives west along the road.",
         f"{OUT}{AT_10}the car brakes to a stop."),
        (f"{TURNS}A waiting van is at the stop line. {AT_10}the van drives on.",
         f"{TURNS}The van waits at the stop line. {AT_10}the van drives on."),
        (f"{TURNS}{AT_10}the van pulls out, accelerating to 8 m/s.",
         f"{TURNS}The van stands. {AT_10}the van accelerates to 8 m/s."),
        (f"{LEADS}The van stands. {AT_20}the van is still stopped.", f"{LEADS}The van stands. {AT_20}the van stands."),
        (f"{LEADS}The van drives at 15 m/s, faster than the ego. {AT_20}the van brakes.",
         f"{LEADS}The van drives faster than the ego. It drives at 15 m/s. {AT_20}the van brakes."),
        (f"{LEADS}As the ego is 20 m behind the van, the van is at 5 m/s.", f"{LEADS}{AT_20}the van is at 5 m/s."),
        (f"{MERGES} An oncoming car turns left. {AT_10}the car turns into the driveway.",
         f"{MERGES} An oncoming car turns left. {AT_10}the car turns left."),
        (f"{LEADS}{AT_20}the van brakes to 5 m/s. 3 s after it has braked, it accelerates.",
         f"{LEADS}{AT_20}the van brakes to 5 m/s. 3 s after it finishes braking, it accelerates."),
        (f"{LEADS}{AT_20}the van brakes at 2 m/s^2. It stands 10 m before the intersection.",
         f"{LEADS}{AT_20}the van brakes at 2 m/s^2 to a stop 10 m before the intersection."),
        (f"{MERGES} A van turns right out of the driveway at the intersection. {AT_10}the van brakes.",
         f"{MERGES} A van turns right out of the driveway. {AT_10}the van brakes."),
    ],
)  # fmt: skip
def test_what_is_said_otherwise_is_read_as_what_it_means(text: str, plainer: str) -> None:
    assert formulas(reading_of(text)) == formulas(reading_of(plainer))


@pytest.mark.parametrize(
    "text",
    [
        f"{OUT}{AT_10}it is 30 m from the intersection. The car brakes.",
        f"{OUT}{AT_10}its speed is 5 m/s and the car brakes to a stop.",
        f"{OUT}{AT_10}the car brakes. When the ego turns, its speed is 5 m/s.",
        f"{LEADS}{AT_20}the van brakes to a stop. When the ego passes the intersection, it is 20 m ahead.",
        f"{LEADS}A car drives behind the ego in the same lane. When it is 20 m ahead of the ego, the van brakes.",
        f"{LEADS}{AT_20}the van brakes to a stop. When it is 10 m behind it, the van drives on.",
        f"{TWO}{AT_10}the car brakes to a stop. When the truck has passed the conflict point, it drives on.",
    ],
)
def test_whose_a_state_behind_the_moment_of_another_is_is_asked(text: str) -> None:
    assert "Who is 'it'?" in reading_of(text).told


def test_when_a_turn_is_that_is_after_something_is_asked_where_a_moment_was_told() -> None:
    turns = (
        "The ego drives west. An oncoming car turns left. When the ego is 30 m before the conflict point, the car turns"
    )
    reading = reading_of(f"{turns} left after the ego has passed the conflict point.")
    assert any(each.startswith("When is this") for each in reading.told)


@pytest.mark.parametrize(
    ("does", "at_start"),
    [
        ("is 50 m ahead of it", "gap(A0, A1, t0) == 50"),
        ("drives at 10 m/s", "A1v(t0) == 10"),
        ("stands in front of it", "A1v(t0) == 0"),
    ],
)
def test_what_is_so_in_front_of_a_deed_whose_moment_is_told_last_may_be_so_at_the_start(
    does: str, at_start: str
) -> None:
    reading = reading_of(f"{LEADS}The van {does} and drives on when the ego is 20 m behind it.")
    assert any(each.startswith("When is this") for each in reading.told)
    assert at_start in formulas(reading)


def test_who_drives_behind_at_a_headway_is_asked_where_nobody_said_so() -> None:
    text = f"{MERGES} A van drives at 10 m/s at a headway of 2 s. "
    assert "Who drives behind?" in reading_of(text).told
    assert "headway(A0, A1, t0) == 2" in formulas(reading_of(f"{text}The van drives ahead of the ego."))


@pytest.mark.parametrize(
    "does",
    ["keeps its speed and does not yield", "accelerates without yielding", "brakes to 5 m/s and yields to the ego"],
)
def test_a_courtesy_that_nothing_is_held_of_is_told(does: str) -> None:
    told = read(f"{OUT}{AT_10}the car {does}.").assumptions
    assert any("asks for nothing of who passes first" in each for each in told)


def test_a_courtesy_of_who_stands_or_passes_first_is_held() -> None:
    for does in (
        "brakes to a stop, yielding to the ego",
        "does not yield and passes the conflict point before the ego",
    ):
        assert all("asks for" not in each for each in read(f"{OUT}{AT_10}the car {does}.").assumptions), does


@pytest.mark.parametrize("rest", ["standstill", "a standstill", "rest"])
def test_who_does_something_from_a_standstill_has_stood(rest: str) -> None:
    for does, kind in (("starts", "go"), ("sets off", "go"), ("accelerates", "acc"), ("accelerates to 8 m/s", "acc")):
        said = does.replace(" to", f" from {rest} to") if " to" in does else f"{does} from {rest}"
        found = understand(f"{OUT}{AT_10}the car {said}.").program
        assert [each.value for each in found.actors[1].sketch.pieces][:2] == ["stop", kind], said
    with pytest.raises(UnknownWordsError, match="brakes from"):
        understand(f"{OUT}{AT_10}the car brakes from {rest}.")


def test_at_the_same_speed_is_as_fast() -> None:
    fast, same = (formulas(reading_of(f"{LEADS}The van is {how} the ego. {AT_20}the van brakes."))
                  for how in ("as fast as", "at the same speed as"))  # fmt: skip
    assert fast == same
    assert "A1v(t0) == A0v(t0)" in fast
