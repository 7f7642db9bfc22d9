"""What words mean, one test for each meaning that the reader keeps to."""

from __future__ import annotations

import pytest
from readings import FILLED, Reading, formulas, reading_of

from scenewright.program.printer import print_expression

MEETS = FILLED["DL"] + FILLED["W"]  # the ego turns left out of the driveway, the hero drives west
ALONG = "The ego drives west along the road. The hero is ahead of the ego and goes straight on. "
ONCOMING = "The ego drives west. An oncoming hero turns left into the driveway. "


def pieces(reading: Reading) -> str:
    assert reading.program is not None, reading
    return " ".join(reading.program.actors[1].sketch.pieces)


def test_who_goes_first_passes_before_the_other_and_it_is_never_lost() -> None:
    first = reading_of(FILLED["DL"] + "When the ego is 12 m from the stop line, the hero goes first.")
    assert {"A1x(t2) == conflict_point", "A0x(t2) == conflict_point", "A0(t2) > A1(t2)"} <= formulas(first)
    for text in (MEETS + "the ego goes first.", ONCOMING + "The ego passes the conflict point first.",
                 MEETS + "the hero stops, lets the ego go first and then drives on."):  # fmt: skip
        assert reading_of(text).program is None


def test_who_lets_the_ego_go_first_is_before_the_conflict_point_when_that_passes_it() -> None:
    for said in ("slows down to 3 m/s and the ego goes first", "slows down to 3 m/s. The ego passes first",
                 "slows down to 3 m/s, and the ego passes the conflict point first"):  # fmt: skip
        found = formulas(reading_of(f"{MEETS}the hero {said}."))
        assert {"A0x(t2) == conflict_point", "A1x(A0(t2)) < conflict_point"} <= found, said


def test_who_brakes_comes_to_a_standstill() -> None:
    for said in ("brakes", "brakes at 3 m/s^2", "slows down", "brakes to a stop", "comes to a halt"):
        assert "A1v(t2) == 0" in formulas(reading_of(f"{MEETS}the hero {said}.")), said


def test_only_who_speeds_up_accelerates() -> None:
    for said in ("goes", "drives on", "drives through the conflict point"):
        assert pieces(reading_of(f"{MEETS}the hero {said}.")) == "go go", said
    for said in ("sets off", "pulls out"):
        assert pieces(reading_of(f"{MEETS}the hero {said}.")) == "stop go", said
    for said in ("accelerates", "speeds up"):
        assert pieces(reading_of(f"{MEETS}the hero {said}.")) == "go acc", said


def test_a_speed_is_that_of_the_start_and_a_kept_one_is_kept() -> None:
    start = "The ego turns left out of the driveway. A truck approaches from the east at 60 km/h"
    end = " When the ego is 10 m from the stop line, the truck brakes at 3 m/s^2."
    found = formulas(reading_of(f"{start}.{end}"))
    assert "A1v(t0) == 50/3" in found
    assert "A1v(go) == 50/3" not in found
    kept = formulas(reading_of(f"{start} and keeps its speed.{end}"))
    assert {"A1v(t0) == 50/3", "A1v(go) == 50/3"} <= kept
    goes_first = formulas(reading_of(f"{start} and keeps its speed.{end.split('brakes', maxsplit=1)[0]}goes first."))
    assert {"A1v(go1) == 50/3", "A1v(go2) == 50/3"} <= goes_first
    goes_on = formulas(reading_of(f"{MEETS}the hero continues at a constant speed."))
    assert "A1a(go2) == 0" in goes_on
    assert reading_of(f"{MEETS}the hero brakes and keeps its speed.").kind in ("asked", "refused")
    assert "A1v(t1) == 8" in formulas(reading_of(MEETS.replace("hero is 20 m", "hero drives at 8 m/s and is 20 m") +
                                                 "the hero brakes."))  # fmt: skip


def test_the_junction_is_a_place_of_its_own() -> None:
    assert "A0x(t0) == intersection - 60" in formulas(reading_of("The ego is 60 m before the junction. " + ONCOMING))


def test_an_event_of_a_turn_of_somebody_who_does_not_turn_is_a_question() -> None:
    when = "When the ego is 30 m from the conflict point, the hero speeds up to pass the conflict point "
    asked = reading_of(f"{ONCOMING}{when}before the ego begins to turn.")
    assert asked.kind == "asked"
    assert "The ego does not turn" in " ".join(asked.told)


def test_bounds_are_bounds_and_what_is_reached_is_its_value() -> None:
    text = FILLED["DL"] + "When the ego is {} the stop line, the hero brakes."
    for said, formula in (("at least 12 m before", "A0x(t1) <= stop_line - 12"),
                          ("within 12 m of", "A0x(t1) == stop_line - 12")):  # fmt: skip
        assert formula in formulas(reading_of(text.format(said)))
    vague = reading_of(text.format("about 12 m before"))
    assert vague.kind == "default"
    assert "How much is 'about 12 m'?" in vague.told
    assert reading_of(MEETS + "the hero brakes to a stop within 5 m of the conflict point.").program is None


def test_places_of_braking_and_of_standing() -> None:
    assert "A1x(t2) == stop_line - 5" in formulas(reading_of(MEETS + "the hero stops just before the stop line."))
    begins = formulas(reading_of(FILLED["DL"] + "The hero brakes 15 m before the conflict point."))
    assert begins == {"A1x(t1) == conflict_point - 15", "A1v(t2) == 0"}
    assert "A1x(t2) == conflict_point - 5" in formulas(
        reading_of(MEETS + "the hero stops 5 m before the conflict point.")
    )


def test_a_time_to_collision_needs_one_lane() -> None:
    ahead = "When the time to collision is 2.5 s, the hero brakes."
    assert "ttc(A0, A1, t1) == 2.5" in formulas(reading_of(ALONG + ahead))
    crossing = reading_of(ONCOMING + ahead)
    assert (crossing.kind, "time to collision" in crossing.told[0]) == ("refused", True)


def test_ahead_is_so_at_the_start() -> None:
    reading = reading_of(ALONG + "When the gap is 12 m, the hero brakes.")
    assert reading.program is not None
    told = [print_expression(each.formula) for each in reading.program.constraints]
    assert {"gap(A0, A1, t0) > 0", "gap(A0, A1, t1) == 12"} <= set(told)


def test_a_deed_told_twice_is_one() -> None:
    assert pieces(reading_of(MEETS + "the hero brakes at 3 m/s^2 and stops 5 m before the conflict point.")) == "go dec"
    assert pieces(reading_of(MEETS + "the hero yields, stopping 5 m before the conflict point.")) == "go dec"
    assert reading_of(MEETS + "the hero does not yield and stops 5 m before the conflict point.").kind == "refused"


@pytest.mark.parametrize("who", ["They", "Both"])
def test_who_both_are_where_there_are_three_must_be_said(who: str) -> None:
    two = reading_of(f"The ego turns left out of the driveway. The hero drives west. {who} start at 5 m/s.")
    assert {"A0v(t0) == 5", "A1v(t0) == 5"} == formulas(two)
    three = reading_of(f"The ego turns left out of it. The hero drives west. A bus drives east. {who} start at 5 m/s.")
    assert three.program is None


def test_a_parameter_tells_its_unit() -> None:
    reading = reading_of(MEETS + "the hero stops {place} m before the conflict point at {rate_mpss}.")
    assert reading.program is not None
    assert {each.name for each in reading.program.parameters} == {"place_m", "rate_mpss"}
    assert "a number with a unit" in " ".join(reading_of(MEETS + "the hero stops {x} before the conflict point.").told)


def test_what_follows_a_relative_clause_is_said_of_the_noun_before_it() -> None:
    braking = (
        "The ego is on the driveway. The hero drives west along the road. The hero brakes to a stop. At the moment "
    )
    text = braking + "when it begins to brake, the ego, which wants to turn left there, is 10 m from its stop line."
    assert "A0x(t0) == stop_line - 10" in formulas(reading_of(text))
    when = "When the ego, which drives at 3 m/s, is 8 m from its stop line, the hero brakes to a stop."
    assert {"A0v(t1) == 3", "A0x(t1) == stop_line - 8"} <= formulas(reading_of(FILLED["DL"] + when))


def test_we_are_the_ego_and_carries_on_is_driving_on() -> None:
    text = FILLED["DL"].replace("The ego is", "We are").replace("and wants", "and want") + FILLED["W"]
    said = reading_of(text.replace("the ego is", "our car is") + "the hero stops and then carries on.")
    assert pieces(said) == "go dec stop go"
    assert "A0x(t1) == stop_line - 12" in formulas(said)


def test_an_amount_set_off_by_commas_before_a_standstill_is_asked_about() -> None:
    asked = reading_of(MEETS + "the hero brakes, 8 m before its stop line, to standstill.")
    assert (asked.kind, "where it stands" in " ".join(asked.told)) == ("asked", True)
    stands = reading_of(MEETS + "the hero comes to a stop, 8 m before the conflict point.")
    assert "A1x(t2) == conflict_point - 8" in formulas(stands)


@pytest.mark.parametrize("said", ["before the ego", "before the ego does"])
def test_who_is_compared_by_name_alone_does_the_same(said: str) -> None:
    found = formulas(reading_of(f"{MEETS}the hero drives on and passes the conflict point {said}."))
    assert {"A1x(t2) == conflict_point", "A0x(t2) == conflict_point", "A0(t2) > A1(t2)"} <= found


@pytest.mark.parametrize(
    ("said", "reached"),
    [
        ("brakes to a stop and then drives on at 5 m/s.", "A1v(t4) == 5"),
        ("stops, waits for 2 s and drives on at 5 m/s until it passes the junction.", "A1v(t4) == 5"),
        ("brakes to a stop. When the ego is at the junction, the hero drives on at v_mps.", "A1v(t4) == v_mps"),
        ("comes to a halt. Then at once it goes on with at least 20 km/h.", "A1v(t3) >= 50/9"),
        ("stops and then drives on at 5 m/s. When the ego is at the junction, it speeds up.", "A1v(t4) == 5"),
        ("stops and then drives on 2 m/s slower than the ego.", "A1v(t4) == A0v(t2) - 2"),
    ],
)
def test_who_sets_off_from_rest_comes_to_a_speed_and_has_none_all_through(said: str, reached: str) -> None:
    reading = reading_of(f"{ALONG}When the gap is 30 m, the hero {said}")
    assert reached in formulas(reading)
    assert not any("A1v(go2)" in each for each in formulas(reading))


def test_who_sets_off_from_rest_may_be_held_below_a_speed_but_keeps_none() -> None:
    text = ALONG + "When the gap is 30 m, the hero stops and then drives on "
    assert "A1v(go2) <= 5" in formulas(reading_of(text + "at at most 5 m/s."))
    assert reading_of(text.removesuffix("drives on ") + "continues at a constant speed of 5 m/s.").kind == "refused"
    waits = "The ego drives west. The hero is ahead of the ego. Initially, the hero stands. When the gap is 20 m, "
    assert "A1v(t2) == 5" in formulas(reading_of(waits + "the hero drives on at 5 m/s."))
    drives = ALONG + "When the gap is 30 m, the hero drives on at 5 m/s."
    assert "A1v(go2) == 5" in formulas(reading_of(drives))


@pytest.mark.parametrize("text", ["When the gap is 12 m.", "The hero brakes. Trigger: the gap is 12 m.",
                                  "When the gap is 12 m. When the ego stands, the hero brakes.",
                                  "When the gap is 12 m. Once the ego stands. The hero brakes."])  # fmt: skip
def test_a_moment_at_which_nothing_is_done_is_not_lost(text: str) -> None:
    reading = reading_of(ALONG + text)
    assert (reading.kind, reading.told[0]) == ("refused", "it is not said what happens then")


def test_what_is_said_between_a_moment_and_what_happens_then_does_not_part_them() -> None:
    found = formulas(
        reading_of(ALONG + "When the gap is 12 m. At the start, the ego drives at 8 m/s. The hero brakes.")
    )
    assert {"gap(A0, A1, t1) == 12", "A0v(t0) == 8", "A1v(t2) == 0"} <= found
    timed = formulas(reading_of(ALONG + "Trigger: 5 s after the start. Action: the hero brakes."))
    assert "A1(t1) == 5" in timed


@pytest.mark.parametrize(
    ("said", "held"),
    [
        ("does not brake and goes first", "A1a(go2) >= 0"),
        ("goes first without slowing down", "A1a(go2) >= 0"),
        ("never brakes", "A1a(go2) >= 0"),
        ("does not stop and goes first", "A1v(go2) >= 1"),
        ("keeps driving without stopping", "A1v(go2) >= 1"),
    ],
)
def test_what_somebody_does_not_do_is_held(said: str, held: str) -> None:
    assert held in formulas(reading_of(f"{MEETS}the hero {said}."))


@pytest.mark.parametrize("said", ["brakes at 3 m/s^2 but does not stop", "brakes and does not slow down"])
def test_what_somebody_does_and_does_not_is_refused(said: str) -> None:
    assert "the contrary" in str(reading_of(f"{MEETS}the hero {said}.").told)


@pytest.mark.parametrize(
    ("said", "more"),
    [
        ("brakes to a stop 8 m before the conflict point. It decelerates at no more than 4 m/s^2.",
         {"A1a(dec) >= -4", "A1x(t2) == conflict_point - 8"}),
        ("brakes at 3 m/s^2. It stops.", {"A1a(dec) == -3", "A1v(t2) == 0"}),
        ("begins to brake. It comes to a stop 8 m before the conflict point.", {"A1x(t2) == conflict_point - 8"}),
        ("brakes. It comes to a stop 2 s after it begins to brake.", {"A1(t2) - A1(t1) == 2"}),
        ("brakes. It brakes to 5 m/s.", {"A1v(t2) == 5"}),
        ("accelerates. It accelerates at 2 m/s^2 to 12 m/s.", {"A1a(acc) == 2", "A1v(t2) == 12"}),
    ],
)  # fmt: skip
def test_a_deed_told_in_two_sentences_is_one(said: str, more: set[str]) -> None:
    reading = reading_of(f"{MEETS}the hero {said}")
    assert more <= formulas(reading)
    assert pieces(reading) in ("go dec", "go acc")


def test_a_deed_told_twice_that_contradicts_itself_is_refused() -> None:
    reading = reading_of(f"{MEETS}the hero brakes to a stop 8 m before the conflict point. It brakes to 5 m/s.")
    assert "two amounts for one thing" in str(reading.told)
    assert pieces(reading_of(f"{MEETS}the hero brakes to 5 m/s. Then it brakes to a stop.")) == "go dec dec"
    for said in ("It brakes again to a stop.", "Later it brakes to a stop."):
        assert pieces(reading_of(f"{MEETS}the hero brakes to 5 m/s. {said}")) == "go dec go dec", said


def test_what_follows_an_end_is_said_of_the_end() -> None:
    found = formulas(reading_of(f"{MEETS}the hero accelerates until it passes the conflict point 2 s before the ego."))
    assert "A0(t2) - A1(t2) == 2" in found
    first = reading_of(f"{ONCOMING}2 s before the ego reaches the conflict point, the hero brakes to a stop.")
    assert "A0(t1) - A1(t1) == 2" in formulas(first)


THREE = "The ego drives west. A truck drives west 40 m ahead of the ego. An oncoming van turns left. "
TRIGGER = "When the ego is 50 m before the intersection, the truck brakes at 2 m/s^2 to a stop"


@pytest.mark.parametrize(
    ("said", "tied"),
    [
        (". At the same time the van brakes.", "A0(t1) == A2(t1)"),
        (", and at the same time the van brakes.", "A0(t1) == A2(t1)"),
        (", and the van is 20 m before the conflict point and brakes.", "A0(t1) == A2(t1)"),
        (". Then the van brakes.", "A2(t1) > A1(t2)"),
        (", and then the van goes on.", "A2(t1) > A1(t2)"),
        (". 2 s later the van brakes.", "A2(t1) - A1(t1) == 2"),
        (". At least 2 s after that, the van brakes.", "A2(t1) - A1(t1) >= 2"),
        (". 2 s later it goes on.", "A1(t3) - A1(t2) == 2"),
        (" while the van keeps its speed.", "A2a(go2) == 0"),
    ],
)
def test_what_another_does_is_tied_to_what_was_told(said: str, tied: str) -> None:
    assert tied in formulas(reading_of(f"{THREE}{TRIGGER}{said}"))


def test_what_nothing_ties_is_refused() -> None:
    for said in ("The van brakes to a stop.", "The van accelerates at 2 m/s^2."):
        assert "not clear when" in str(reading_of(f"{THREE}{TRIGGER}. {said}").told)
        assert reading_of(f"{THREE}{TRIGGER}. At the start, {said}").program is not None
    assert "not clear when" in str(reading_of(f"{ONCOMING}The hero crosses the stop line at 5 m/s.").told)


def test_a_range_is_two_bounds_and_just_past_is_as_far_as_just_before() -> None:
    reading = reading_of(f"{ALONG}When the ego is between 15 m and 20 m behind the hero, the hero brakes.")
    assert {"gap(A0, A1, t1) >= 15", "gap(A0, A1, t1) <= 20"} <= formulas(reading)
    stands = reading_of(f"{MEETS}the hero brakes to a stop just past the conflict point.")
    assert "A1x(t2) == conflict_point + 5" in formulas(stands)


def test_the_sign_of_a_deceleration_says_it_again_and_that_of_an_acceleration_contradicts_it() -> None:
    assert "A1a(dec) == -3" in formulas(reading_of(f"{MEETS}the hero brakes with a deceleration of -3 m/s^2."))
    assert reading_of(f"{MEETS}the hero accelerates at -2 m/s^2.").program is None


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("The ego drives west. A pedestrian crosses the road in front of the ego.", "a pedestrian"),
        ("The ego drives west at 40 km/h. A cyclist comes from the right and does not give way.", "a cyclist"),
        ("The ego drives west. A car merges from the driveway in front of the ego, 20 m ahead of it.", "'merges'"),
        (f"{MEETS}the hero cuts off the ego.", "'cuts off'"),
    ],
)
def test_what_no_program_says_is_named_before_what_is_unclear(text: str, named: str) -> None:
    assert f"{named} cannot be said in a program yet" in str(reading_of(text).told)


def test_what_is_not_done_from_the_start_on_is_held_from_then_on() -> None:
    text = f"{ONCOMING}The hero never stops. When the ego is 40 m before the intersection, the hero accelerates."
    assert "A1v(go) >= 1" in formulas(reading_of(text))
    late = f"{ONCOMING}When the ego is 40 m before the intersection, the hero drives on. It does not stop."
    assert {"A1v(go2) >= 1"} == {each for each in formulas(reading_of(late)) if each.startswith("A1v(go")}


@pytest.mark.parametrize("where", ["at the intersection", "5 m before the conflict point", "just before the stop line"])
def test_a_place_where_something_is_not_done_is_no_place_of_the_deed(where: str) -> None:
    assert reading_of(f"{MEETS}the hero brakes to 3 m/s without stopping {where}.").program is None


def test_then_one_does_this_and_another_that_is_at_one_moment() -> None:
    found = formulas(
        reading_of(f"{THREE}{TRIGGER}. An oncoming bus turns left. Then the van brakes and the bus goes on.")
    )
    assert "A2(t1) == A3(t1)" in found


def test_a_deed_of_so_long_has_ended_before_a_later_moment() -> None:
    said = "brakes at 2 m/s^2 for 2 s. When the ego is 5 m before the stop line, the hero brakes to a stop."
    reading = reading_of(f"{MEETS}the hero {said}")
    assert pieces(reading) == "go dec go dec"
    assert "A1(t2) - A1(t1) == 2" in formulas(reading)


@pytest.mark.parametrize("said", ["begins to brake to a stop 2 s before", "begins to brake to 4 m/s before"])
def test_what_begins_before_something_begins_before_it(said: str) -> None:
    reading = reading_of(f"{ONCOMING}The hero {said} the ego passes the conflict point.")
    assert pieces(reading) == "go dec"
    assert {"A0(t1) - A1(t1) == 2", "A0(t1) > A1(t1)"} & formulas(reading)


def test_who_goes_first_does_so_at_its_own_conflict_point() -> None:
    found = formulas(reading_of(f"{THREE}{TRIGGER}. At the same time the van goes first."))
    assert "A0x(t2) == A0.conflict_point(A2)" in found
