"""Texts that were once accepted and understood wrongly: what they say now, or that they are asked about or refused."""

from __future__ import annotations

from dataclasses import replace

import pytest
from readings import formulas, reading_of

from scenewright.program.printer import print_expression
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell

ALONG = "The ego drives west along the road. The hero is ahead of the ego and goes straight on. "
ONCOMING = "The ego drives west. An oncoming hero turns left into the driveway. "
JOINS = "The ego turns right out of the driveway. A car drives westbound along the road. "
LEFT_AND_RIGHT = "The ego turns left out of the driveway. A car comes from its left and a truck comes from its right. "
BRAKES = LEFT_AND_RIGHT + "When the ego is 10 m before its stop line, the car brakes at 3 m/s^2 to a stop. "


def told_in(text: str) -> str:
    """Return what is told of a text, with what is asked; ways do not matter here."""
    story = read(text)
    plain = replace(story, actors=tuple(replace(each, relations=()) for each in story.actors))
    return "\n".join([*tell(plain), *(each.text for each in story.questions)])


def test_when_somebody_begins_to_turn_is_of_that_and_not_of_when_it_has_turned() -> None:
    for said in ("begins to turn", "drives on at 5 m/s and begins to turn"):
        told = told_in(f"{ONCOMING}When the ego is 40 m before the conflict point, the hero {said} 3 s before the ego "
                       "passes the conflict point.")  # fmt: skip
        assert "The ego passes the conflict point 3 s after the hero begins to turn." in told
    turns = told_in(f"{ONCOMING}When the ego is 40 m before the conflict point, the hero turns 1 s before the ego "
                    "passes the conflict point.")  # fmt: skip
    assert "When is this: hero turns" in turns
    for when, told in (
        ("after the truck stops", "The car begins to brake 2 s after the truck finishes braking."),
        ("before the truck begins to brake", "The truck begins to brake 2 s after the car finishes braking."),
    ):
        text = f"{LEFT_AND_RIGHT}When the ego is 10 m before its stop line, the truck brakes to a stop. The car brakes "
        text = told_in(f"{text}to a stop 2 s {when}.")
        assert told in text
        assert "When is this: car brakes to a stop" in text


@pytest.mark.parametrize(
    ("said", "then"),
    [
        ("waits for 3 s and passes the conflict point", "drives on until it passes the conflict point"),
        ("stands for 2 s and completes its turn", "drives on until it completes its turn"),
        ("stops 3 m before the conflict point, waits for 4 s and then completes its turn", "drives on until it compl"),
    ],
)
def test_who_stands_passes_nothing_until_it_has_stood(said: str, then: str) -> None:
    told = told_in(f"{ONCOMING}When the ego is 40 m before the conflict point, the hero {said}.")
    first, _, rest = told.partition("still for")
    assert rest
    assert then in rest
    assert "passes the conflict point" not in first
    assert "completes" not in first


@pytest.mark.parametrize("then", ["Then the truck", "2 s later the truck"])
def test_who_acts_after_another_has_stood_for_so_long_waits_for_that(then: str) -> None:
    told = told_in(f"{BRAKES}The car stands for 6 s. {then} brakes to 5 m/s.")
    assert "the car finishes standing still" in told.lower()
    assert "When is this:" in told


@pytest.mark.parametrize(
    ("when", "told"),
    [
        ("At most 2 s before it stops", "The car finishes braking at most 2 s after the truck begins to brake."),
        ("After it has stopped", "The car finishes braking before the truck begins to brake."),
        ("Once it has stopped", "When the car finishes braking, the truck begins to brake"),
    ],
)
def test_it_in_front_is_who_was_spoken_of_and_else_it_is_asked(when: str, told: str) -> None:
    assert told in told_in(f"{BRAKES}{when}, the truck brakes to 5 m/s.")
    assert "Who is 'it'?" in told_in(f"{BRAKES}Until it stops, the truck drives at 10 m/s.")


@pytest.mark.parametrize("said", ["has been driving at 10 m/s for 3 s", "has braked to a stop", "has slowed to 5 m/s"])
def test_what_somebody_has_done_by_then_is_nothing_that_it_does_then(said: str) -> None:
    assert reading_of(f"{JOINS}When the ego is 10 m before its stop line, the car {said}.").kind == "refused"


@pytest.mark.parametrize(
    ("when", "told"),
    [
        ("As soon as the ego has passed its stop line", "When the ego passes the stop line,"),
        ("As soon as the ego is past its stop line", "When the ego passes the stop line,"),
        ("The moment the car drives at less than 9 m/s", "When the car drives at 9 m/s,"),
        ("Once the ego has passed its stop line", "When the ego is at or past the stop line,"),
    ],
)
def test_as_soon_as_something_is_so_is_the_moment_when_it_comes_to_be(when: str, told: str) -> None:
    assert told in told_in(f"{JOINS}{when}, the car brakes to a stop.")


def test_as_soon_as_two_bounds_hold_is_no_moment_that_can_be_told() -> None:
    both = "the ego is less than 20 m before its stop line and the car drives at less than 9 m/s"
    assert reading_of(f"{JOINS}As soon as {both}, the car brakes to a stop.").kind == "refused"


def test_at_most_so_far_before_a_place_is_not_past_it_unless_that_is_said() -> None:
    when = f"{JOINS}When the ego is 12 m before its stop line, the car is at most 5 m before the conflict point"
    near = {"A1x(t1) >= conflict_point - 5", "A1x(t1) <= conflict_point"}
    assert near <= formulas(reading_of(f"{when} and brakes to a stop."))
    open_ended = formulas(reading_of(f"{when} or past it and brakes to a stop."))
    assert near & open_ended == {"A1x(t1) >= conflict_point - 5"}
    assert reading_of(f"{when} or before it and brakes to a stop.").kind == "refused"
    timed = f"{JOINS}When the ego is 12 m before its stop line and the car is less than 3 s from the conflict point, "
    assert "A1x(t1) <= conflict_point" in formulas(reading_of(f"{timed}the car brakes to a stop."))


def test_what_is_so_while_something_is_done_is_asked_and_held_all_the_while() -> None:
    told = told_in(f"{JOINS}When the ego is 12 m before its stop line, the car brakes at 3 m/s^2 to 5 m/s while the "
                   "ego drives at no less than 2 m/s.")  # fmt: skip
    assert "until the car finishes braking, always: the ego drives at a speed of at least 2 m/s." in told
    assert "How long is this so" in told


@pytest.mark.parametrize(
    "said",
    [
        "the car and the truck brake to a stop, the car at 3 m/s^2, the truck at 4 m/s^2",
        "the car brakes to a stop, waits until the ego is 5 m before it and then passes it",
        "the car brakes to a stop before the truck does",
    ],
)
def test_what_is_left_to_guess_is_refused(said: str) -> None:
    assert reading_of(f"{LEFT_AND_RIGHT}When the ego is 10 m before its stop line, {said}.").kind in (
        "asked",
        "refused",
    )


@pytest.mark.parametrize(
    "when",
    [
        "the bumper-to-bumper gap is 15 m",
        "the ego is 15 m bumper to bumper behind the hero",
        "the bumper-to-bumper distance to the hero falls to 15 m",
        "the hero has a bumper-to-bumper gap of 15 m to the ego",
    ],
)
def test_a_gap_from_bumper_to_bumper_is_between_bodies(when: str) -> None:
    assert "freespace(A0, A1, t1) == 15" in formulas(reading_of(f"{ALONG}When {when}, the hero brakes."))


WEST_EAST = (
    "The ego turns left out of the driveway. A car drives west along the road. A truck drives east along the road. "
)
AT_LINE = f"{WEST_EAST}When the ego is 12 m before the stop line, "


@pytest.mark.parametrize(
    ("said", "so"),
    [
        ("the car, 30 m before the conflict point, brakes to a stop", "the car is 30 m before the conflict point"),
        ("the car (30 m before the conflict point) brakes to a stop", "the car is 30 m before the conflict point"),
        (
            "the car that is 30 m before the conflict point brakes to a stop",
            "the car is 30 m before the conflict point",
        ),
        ("30 m before the conflict point the car brakes to a stop", "the car is 30 m before the conflict point"),
        ("the car, driving at 8 m/s, brakes to a stop", "the car drives at 8 m/s"),
        ("the car drives at 8 m/s, brakes to a stop, and waits for 2 s", "the car drives at 8 m/s"),
    ],
)
def test_what_is_put_between_somebody_and_its_deed_parts_them_not(said: str, so: str) -> None:
    told = told_in(f"{AT_LINE}{said}.")
    assert f"before the stop line and {so}, the car begins to brake until it stands." in told
    assert "the truck" not in told.partition("When")[2]


@pytest.mark.parametrize(
    "said",
    [
        "the car brakes to a stop, as does the truck",
        "the car brakes to a stop and so does the truck",
        "the car brakes to a stop, then the truck",
        "the car brakes to a stop. Then the truck",
        "the truck drives on at 12 m/s and the car at 10 m/s",
        "the car passes the conflict point at least 2 s before the ego, at 12 m/s",
        "the car brakes to a stop 8 m before the conflict point, and the truck is then 20 m before the conflict point",
        "the car wants to brake to a stop but speeds up to 12 m/s",
        "the car should brake to a stop, but it drives on",
        "the car brakes to a stop until the ego stands, then drives on",
        "the car brakes to a stop before the ego's turn",
        "the car drives at 5 m/s to 10 m before the conflict point",
    ],
)
def test_whom_or_what_a_text_leaves_half_said_is_not_dropped(said: str) -> None:
    assert reading_of(f"{AT_LINE}{said}.").kind == "refused"


@pytest.mark.parametrize("when", ["the ego exits the driveway", "the ego leaves the driveway at 5 m/s"])
def test_a_way_is_no_moment(when: str) -> None:
    assert (
        reading_of(f"{WEST_EAST}When {when} and the car is 30 m before the stop line, the car brakes.").kind
        == "refused"
    )


def test_as_many_amounts_as_places_go_together_in_their_order() -> None:
    for said in ("distance to the hero is 20 m and to the intersection 15 m",
                 "distance to the hero is 20 m, 15 m before the intersection"):  # fmt: skip
        found = formulas(reading_of(f"{ALONG}When the ego's {said}, the hero brakes to a stop."))
        assert {"gap(A0, A1, t1) == 20", "A0x(t1) == intersection - 15"} <= found


ONE_BEHIND = {
    "The hero brakes to 5 m/s at a headway of 2 s.": "headway(A0, A1, t1) == 2",
    "The hero is braked to a standstill at a TTC of 2.5 s.": "ttc(A0, A1, t1) == 2.5",
    "When the hero is 30 m before the turn with the ego 20 m behind it, it brakes.": "gap(A0, A1, t1) == 20",
    "When the ego is 30 m before the turn with the hero 20 m ahead of it, the hero brakes.": "gap(A0, A1, t1) == 20",
}


@pytest.mark.parametrize(("said", "formula"), ONE_BEHIND.items())
def test_who_drives_behind_is_known_whoever_acts(said: str, formula: str) -> None:
    assert formula in formulas(reading_of(ALONG + said))


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("drives on to 5 m past the conflict point", "drive on until it is 5 m past the conflict point."),
        ("drives on up to 5 m before the conflict point", "drive on until it is 5 m before the conflict point."),
        ("continues past the conflict point", "drive on until it is past the conflict point."),
        ("brakes to 4 m/s 5 m before the conflict point", "brake until it is 5 m before the conflict point and it dr"),
    ],
)
def test_where_a_deed_ends_is_no_place_where_it_begins(said: str, told: str) -> None:
    assert told in told_in(f"{AT_LINE}the car {said}.")


def test_what_two_do_before_or_until_something_is_held_of_both() -> None:
    told = told_in(f"{AT_LINE}the car and the truck brake to a stop 2 s before the ego begins to turn.")
    assert "The ego begins to turn 2 s after the car finishes braking." in told
    assert "The ego begins to turn 2 s after the truck finishes braking." in told
    told = told_in(f"{AT_LINE}the car and the truck brake until the ego begins to turn.")
    assert told.count("until the ego begins to turn.") == 2


def test_what_is_asked_of_a_deed_in_a_list_is_asked_as_in_a_sentence() -> None:
    told = told_in(f"{AT_LINE}the car brakes to a stop and 2 s later the truck brakes to a stop.")
    assert "When is this" in told
    between = told_in(f"{AT_LINE}the car brakes 30 m before the conflict point to a stop.")
    assert "What is '30 m'?" in between


BEHIND = "when the ego is 12 m before the stop line"
ROAD = "The ego turns left out of the driveway. The hero drives west along the road. "


@pytest.mark.parametrize(
    ("said", "told"),
    [
        (f"brakes {BEHIND} and stops 5 m before the conflict point", "until it stands 5 m before the conflict point."),
        (f"brakes {BEHIND}, coming to a stop 5 m before the turn", "until it stands 5 m before the turn."),
        (
            f"accelerates {BEHIND} and passes the conflict point",
            "begins to speed up until it passes the conflict point.",
        ),
        (f"brakes {BEHIND} at 3 m/s^2", "begins to brake at 3 m/s^2 until it stands."),
        ("has to brake to a stop", "the hero brakes until it stands."),
    ],
)
def test_what_is_told_behind_a_moment_is_of_who_acts(said: str, told: str) -> None:
    assert told in told_in(f"{ROAD}The hero {said}.")


@pytest.mark.parametrize(
    "said",
    [
        f"brakes to a stop {BEHIND} with a deceleration of 3 m/s^2",
        f"stops {BEHIND}, 5 m before the conflict point",
        f"stops {BEHIND} at the conflict point",
        f"is braking at 3 m/s^2 {BEHIND}",
    ],
)
def test_what_could_be_of_either_behind_a_moment_is_refused(said: str) -> None:
    assert reading_of(f"{ROAD}The hero {said}.").kind == "refused"


def test_a_moment_behind_several_deeds_is_of_the_last_which_is_asked() -> None:
    told = told_in(f"{ROAD}The hero stops 5 m before the conflict point, waits and drives on {BEHIND}.")
    assert "When the ego is 12 m before the stop line, the hero begins to drive on." in told
    assert "What begins then" in told


@pytest.mark.parametrize(
    "when",
    [
        "the ego is 50 m before the intersection with the hero at 10 m/s",
        "the hero is 5 m/s slower than the ego at 15 m/s",
        "the ego is 12 m before the turn, so is the hero",
    ],
)
def test_what_stands_behind_a_second_name_is_not_given_to_the_first(when: str) -> None:
    assert reading_of(f"{ALONG}When {when}, the hero brakes.").kind == "refused"


@pytest.mark.parametrize(
    ("first", "told"),
    [
        ("The ego drives west, 40 m behind a van that stands at the stop line.", "the van stands"),
        ("The ego is 40 m behind a van that drives west at 10 m/s.", "the van drives at 10 m/s"),
        ("The ego is 40 m behind a van heading west at 10 m/s.", "the van drives at 10 m/s"),
        ("The ego is 40 m behind a van driving west at 10 m/s.", "the van drives at 10 m/s"),
        ("The ego drives west, 40 m behind a van which drives at 10 m/s.", "the van drives at 10 m/s"),
        (
            "The ego turns right out of the driveway, 40 m behind a van that drives at 10 m/s.",
            "the van drives at 10 m/s",
        ),
    ],
)
def test_what_is_told_right_behind_a_second_name_is_of_that_one(first: str, told: str) -> None:
    meaning = told_in(f"{first} When the ego is 30 m behind the van, the van speeds up to 12 m/s.")
    assert told in meaning
    assert "the ego stands" not in meaning
    assert "the ego drives at" not in meaning


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ("When the ego is 40 m before the turn, the hero turns left, accelerating at 2 m/s^2.", "then or meanwhile"),
        ("The hero brakes to a stop 3 m before it. It begins braking when the ego is 40 m from it.", "told before"),
        ("When the ego is 40 m before the turn, the hero brakes to 5 m/s, starting 60 m before it.", "starts there"),
        ("When the ego is 40 m before the turn, the hero sets off with 2 m/s^2 up to 8 m/s.", "to be so fast"),
    ],
)
def test_what_may_be_meant_otherwise_is_named(said: str, why: str) -> None:
    reading = reading_of(f"{ALONG}{said.replace('before it', 'before the turn').replace('from it', 'from the turn')}")
    assert reading.kind == "refused"
    assert why in reading.told[0]


def test_what_both_have_to_each_other_is_of_who_is_behind() -> None:
    both = "Both drive at 10 m/s with a headway of 2 s. When the gap is 15 m, the hero brakes."
    program = reading_of(f"{ALONG}{both}").program
    assert program is not None
    assert [t for t in map(print_expression, (c.formula for c in program.constraints)) if t.startswith("headway")] == [
        "headway(A0, A1, t0) == 2"
    ]
    assert reading_of(f"The ego and the hero drive west. {both}").kind == "refused"


@pytest.mark.parametrize(
    ("start", "told"),
    [
        ("A stopped van is 60 m ahead of the ego.", "the van stands"),
        ("A van, stopped 60 m ahead of the ego, is headed west.", "the van stands"),
    ],
)
def test_who_is_stopped_stands(start: str, told: str) -> None:
    meaning = told_in(f"The ego drives west. {start} When the ego is 30 m behind the van, the van drives on.")
    assert told in meaning
    assert "brakes" not in meaning


@pytest.mark.parametrize(
    ("does", "told"),
    [
        ("brakes at 2 m/s^2 down to 3 m/s", "begins to brake at 2 m/s^2 until it drives at 3 m/s"),
        ("reduces its speed to 3 m/s", "begins to brake until it drives at 3 m/s"),
        ("increases its speed to 13 m/s", "begins to speed up until it drives at 13 m/s"),
        ("brakes with a constant deceleration of 3 m/s^2", "begins to brake at 3 m/s^2"),
        ("stops for 3 s and starts driving", "Then the hero stands still for 3 s."),
        ("brakes to 5 m/s, then accelerating to 13 m/s", "Then the hero speeds up until it drives at 13 m/s"),
        ("drives on, speeding up to 13 m/s", "begins to speed up until it drives at 13 m/s"),
    ],
)
def test_ordinary_ways_to_say_it(does: str, told: str) -> None:
    assert told in told_in(f"{ALONG}When the ego is 20 m behind the hero, the hero {does}.")


def test_whose_it_is_that_follows_a_pronoun_is_not_guessed() -> None:
    text = "The ego is followed by a van 15 m behind it that drives at 12 m/s."
    assert (
        reading_of(f"{text} The ego drives west. When the van is 9 m behind the ego, the van brakes.").kind == "refused"
    )


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("brakes to a headway of 1 s", "begins to brake until the ego has a headway of 1 s to the hero."),
        ("accelerates past the turn", "begins to speed up until it is past the turn."),
        (
            "brakes 30 m before the turn to 4 m/s",
            "the hero is 30 m before the turn, the hero begins to brake until",
        ),
        ("passes the turn at 12 m/s", "begins to drive on until it passes the turn and it drives at 12 m/s."),
    ],
)
def test_what_a_deed_is_done_to_is_its_end(said: str, told: str) -> None:
    assert told in told_in(f"{ALONG}When the ego is 50 m before the intersection, the hero {said}.")


def test_as_in_front_tells_a_moment() -> None:
    assert "When the ego passes the stop line, the hero" in told_in(
        f"{ROAD}As the ego passes the stop line, the hero brakes."
    )
    assert reading_of(f"{ROAD}As the ego leaves the driveway, the hero brakes.").kind == "refused"
    beside = reading_of(f"{ROAD}When the ego, leaving the driveway, is 12 m before the stop line, the hero brakes.")
    assert "A0x(t1) == stop_line - 12" in formulas(beside)


@pytest.mark.parametrize(
    "said",
    [
        "stands until the ego passes the stop line and drives on",
        "drives at 8 m/s until it is 20 m before the conflict point and brakes at 3 m/s^2 to a stop",
        f"slows to 5 m/s and accelerates to 12 m/s {BEHIND} and stops 5 m before the conflict point",
        f"brakes {BEHIND} at 5 m/s",
    ],
)
def test_what_goes_on_in_the_words_of_a_moment_is_refused_where_it_is_not_clear_when(said: str) -> None:
    assert reading_of(f"{ROAD}The hero {said}.").kind == "refused"


def test_a_headway_of_who_leads_is_the_others_and_nothing_else_of_it_is() -> None:
    found = formulas(reading_of(f"{ALONG}When the hero has a TTC of 3 s and drives at 12 m/s, it brakes."))
    assert {"ttc(A0, A1, t1) == 3", "A1v(t1) == 12"} <= found


@pytest.mark.parametrize(
    ("said", "formula"),
    [
        ("The hero drives 20 m ahead of the ego at 10 m/s.", "A1v(t0) == 10"),
        ("The ego follows the hero at 12 m/s.", "A0v(t0) == 12"),
        ("When both drive at 12 m/s and the gap is 20 m, the hero brakes.", "gap(A0, A1, t1) == 20"),
    ],
)
def test_whose_a_speed_is_the_verb_tells(said: str, formula: str) -> None:
    then = "" if said.startswith("When") else " When the gap is 15 m, the hero brakes."
    assert formula in formulas(reading_of(ALONG + said + then))


def test_two_who_act_when_it_is_told_last_act_then() -> None:
    told = told_in(f"{WEST_EAST}The car brakes to a stop, and the truck brakes to 5 m/s, {BEHIND}.")
    assert "When the ego is 12 m before the stop line, the car begins to brake until it stands." in told
    told = told_in(f"{WEST_EAST}When the ego is 12 m before the stop line, the car drives past the conflict point.")
    assert "the car begins to drive on until it is past the conflict point." in told


@pytest.mark.parametrize("gap", [" ", "\n", "  "])
def test_a_line_break_changes_no_meaning(gap: str) -> None:
    soon = f"As soon{gap}as the ego is past its stop line, the hero brakes."
    assert "When the ego passes the stop line," in told_in(ROAD + soon)
    up_to = told_in(
        f"{ROAD}When the ego is 12 m before the stop line, the hero drives on up{gap}to 5 m before the turn."
    )
    assert "drive on until it is 5 m before the turn." in up_to


def test_as_soon_as_a_bound_before_a_place_holds_it_is_so_far_from_it() -> None:
    found = formulas(reading_of(f"{ROAD}As soon as the ego is less than 12 m before the stop line, the hero brakes."))
    assert "A0x(t1) == stop_line - 12" in found
    either = "either the ego is past the stop line or the hero is past the turn"
    assert reading_of(f"{ROAD}As soon as {either}, the hero brakes.").kind == "refused"


def test_two_who_go_on_later_both_do_so_then() -> None:
    found = formulas(reading_of(f"{AT_LINE}the car and the truck brake to a stop and drive on 3 s later."))
    assert "A2(t3) - A1(t3) == 3" not in found
    assert len([each for each in found if each.endswith(" == 3")]) == 2


@pytest.mark.parametrize(
    "said",
    [
        "brakes to a stop about 2 s after the ego passes the stop line",
        "brakes to a stop when the ego reaches its stop line and passes the conflict point",
    ],
)
def test_what_is_vague_or_of_another_is_refused(said: str) -> None:
    assert reading_of(f"{ROAD}The hero {said}.").kind == "refused"


def test_up_to_is_a_bound_but_of_where_one_drives() -> None:
    found = formulas(reading_of(f"{AT_LINE}the car comes to a stop up to 5 m before the turn."))
    assert {"A1x(t2) >= turn - 5", "A1x(t2) <= turn"} <= found


def test_who_does_what_stands_behind_a_moment_is_asked() -> None:
    told = told_in(f"{ROAD}The hero speeds up to 15 m/s {BEHIND} and brakes.")
    assert "Of whom is 'brakes'" in told


def test_a_clause_of_commas_or_of_an_amount_alone_is_no_crash() -> None:
    bound = read("The ego drives west. The hero drives west. 5 m/s or more.")
    assert "At the start, the hero drives at a speed of at least 5 m/s." in tell(bound)
    for text in (BRAKES + "5 m/s or more.", ALONG + "When the hero stops, if , , the hero brakes at 5 m/s."):
        assert reading_of(text).kind == "refused"
