"""What a text says of its own purpose is set aside and listed; more ways of telling orders, places and who yields."""

from __future__ import annotations

import contextlib

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate.offline import translate_offline
from scenewright.translate.purposes import take_purposes
from scenewright.translate.steps import in_sentences

ROUTES = "The ego drives west and goes straight. An oncoming car turns left into the driveway. "
WHEN = "When the ego is 30 m and the car 20 m from the conflict point, "
FIRST = ROUTES + WHEN + "the car accelerates and passes the conflict point before the ego does"
STOPS = ROUTES + WHEN + "the car brakes to a stop 6 m before the conflict point"


def formulas(text: str) -> list[str]:
    return [print_expression(each.formula) for each in translate_offline(text).program.constraints]


@pytest.mark.parametrize(
    "purpose",
    [
        ". This scenario evaluates how the ego responds to an accelerating oncoming vehicle.",
        ", which creates a challenging cut-across situation for the ego.",
        ", testing the ego's ability to handle an aggressive left turn.",
        ". This setup assesses whether the ego brakes in time.",
        ". The test is designed to probe the planner's patience.",
    ],
)
def test_a_purpose_changes_nothing_and_is_listed(purpose: str) -> None:
    assert formulas(FIRST + purpose) == formulas(FIRST + ".")
    words = purpose.strip(" .,")
    assert any(words in each for each in translate_offline(FIRST + purpose).assumptions)


@pytest.mark.parametrize(
    "purpose",
    [
        ". This scenario tests how the ego responds to a cyclist.",  # who would be a third
        ", testing the ego's ability to handle an aggressive right turn.",  # nobody turns right
        ". The test examines a hero that brakes hard.",  # it accelerates
        ". This test evaluates a hero that stops at 5 m.",  # which is an amount
    ],
)
def test_a_purpose_that_tells_another_test_is_refused(purpose: str) -> None:
    assert formulas(FIRST + ".")
    with pytest.raises(TranslationError):
        translate_offline(FIRST + purpose)


@pytest.mark.parametrize(
    "text",
    [
        "This scenario tests an ego that drives west.",  # where it drives is told here
        "This test creates a gap of 12 m.",
        "This case examines the ego once it is dark.",
        "The ego tests its brakes.",
    ],
)
def test_what_tells_facts_is_no_purpose(text: str) -> None:
    assert take_purposes(text, "text") == (text, ())


def test_every_other_character_stays_in_its_place() -> None:
    text = FIRST + ", creating a conflict. This test examines the planner. The car has 12 m/s."
    rest, spans = take_purposes(text, "text")
    assert len(rest) == len(text)
    assert rest.index("The car has") == text.index("The car has")
    assert [each.excerpt(text).strip(" ,") for each in spans] == [
        "creating a conflict",
        "This test examines the planner.",
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (ROUTES + WHEN + "the car simply drives on, and it passes the conflict point before the ego.", "go, t1, go"),
        (ROUTES + WHEN + "the car does not yield but carries on, passing the conflict point before the ego does.",
         "go, t1, go"),
        (ROUTES + WHEN + "the car sets off and passes the conflict point before the ego does.", "go, t1, acc"),
    ],
)  # fmt: skip
def test_who_drives_on_does_not_speed_up(text: str, expected: str) -> None:
    hero = translate_offline(text).program.heroes[0]
    told = [str(each) for pair in zip(hero.sketch.pieces, hero.sketch.knots[1:], strict=True) for each in pair]
    assert expected in ", ".join(each.split(".")[-1].lower() for each in told)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (STOPS + ". Then it accelerates and passes the conflict point, and only after that does the ego get to it.",
         "A1(t4) < A0(t2)"),
        (STOPS + ". Then it accelerates and passes the conflict point; the ego does not pass it before the car has "
         "done so.", "A1(t4) < A0(t2)"),
        (STOPS + ". Once stationary, it accelerates again, and the conflict point is passed first by the car and only "
         "afterwards by the ego.", "A1(t4) < A0(t2)"),
        (STOPS + ". After a short pause it accelerates and brings its turn to an end before the ego passes the "
         "conflict point.", "A1x(t4) == turn_end"),
        ("The ego drives west towards the intersection, which is 7 s away at first, and goes straight. An oncoming car "
         "turns left into the driveway. " + WHEN + "the car brakes to a stop 6 m before the conflict point.",
         "tta(A0, intersection, t0) == 7"),
        ("The ego nears the stop line of the driveway, from which it is initially 25 m away, and turns right. A car "
         "drives west, straight on. When the ego is 8 m from the stop line and the car 30 m from the conflict point, "
         "the car brakes to a stop 6 m before the conflict point.", "A0x(t0) == stop_line - 25"),
        (ROUTES + "As soon as thirty metres remain to the conflict point for the ego and twenty metres for the car, "
         "the car brakes to a stop 6 m before the conflict point.", "A1x(t1) == conflict_point - 20"),
        (ROUTES + "Position of the ego at time zero: 80 m before the intersection. " + WHEN + "the car brakes to a "
         "stop 6 m before the conflict point.", "A0x(t0) == intersection - 80"),
        ("An oncoming car must give way to the ego, a car going straight along the road to the west. The oncoming car "
         "turns left into the driveway. When the ego is 30 m and the oncoming car 20 m from the conflict point, the "
         "oncoming car brakes to a stop 6 m before the conflict point.", "A0x(t1) == conflict_point - 30"),
        (ROUTES + "The car brakes when its own distance to the conflict point is 20 m and that of the ego 30 m, and "
         "stops 6 m before the conflict point.", "A1x(t1) == conflict_point - 20"),
    ],
)  # fmt: skip
def test_it_is_read(text: str, expected: str) -> None:
    assert expected in formulas(text)


def test_an_order_that_is_not_understood_is_not_lost() -> None:
    text = STOPS + ". Then it accelerates and passes the conflict point, and only after that does the ego reach {}."
    assert "A1(t4) < A0(t2)" in formulas(text.format("it"))
    with pytest.raises(TranslationError):
        translate_offline(text.format("the kiosk"))


@pytest.mark.parametrize(
    "added",
    [
        " Draw me a chart of the speeds.",
        " Halfway round, the car swings back into its lane.",
        " The ego runs into the back of it.",
        " They go in side by side.",
    ],
)
def test_what_no_program_says_is_refused(added: str) -> None:
    assert formulas(STOPS + ".")
    with pytest.raises(TranslationError):
        translate_offline(STOPS + "." + added)


def test_it_after_both_is_not_clear() -> None:
    text = ROUTES + "Both approach the intersection; {} is 80 m from the intersection at first. " + WHEN
    rest = "the car brakes to a stop 6 m before the conflict point."
    assert formulas(text.format("the ego") + rest)
    with pytest.raises(TranslationError):
        translate_offline(text.format("it") + rest)


@pytest.mark.parametrize(
    "text",
    [
        "The ego drives east, straight on. A van is in the driveway, stopped at the stop line, and is going to turn "
        "left. When the ego is 45 m from the conflict point, the van takes off and finishes its turn before the ego "
        "gets to the conflict point.",
        "There is a van stopped at the stop line in the driveway, and it is going to turn left. The ego drives east "
        "and turns left into the driveway. When the ego is 3 s from the conflict point, the van takes off and gets "
        "through the conflict point before the ego does.",
    ],
)
def test_a_vehicle_that_is_stopped_at_its_line_stands_there(text: str) -> None:
    read = formulas(text)
    assert "A1x(t0) == stop_line" in read
    assert "A1v(stop) == 0" in read
    assert len(translate_offline(text).program.heroes[0].sketch.pieces) == 2


def test_who_brakes_to_a_stop_after_the_trigger_did_not_stand_before() -> None:
    assert "A1v(t2) == 0" in formulas(STOPS + ".")
    assert "A1v(stop) == 0" not in formulas(STOPS + ".")


def test_a_stop_may_be_ordered_before_the_turn_of_the_ego() -> None:
    text = (
        "The ego leaves the driveway to the left. A car drives west, straight on. When the ego is 2 s from the stop "
        "line and the car 4 s from the conflict point, the car brakes and has come to a complete stop 7 m before the "
        "conflict point before the ego begins to turn."
    )
    assert {"A1x(t2) == conflict_point - 7", "A0x(t2) == turn_start", "A1(t2) < A0(t2)"} <= set(formulas(text))


@pytest.mark.parametrize(
    "added",
    [
        ", skating over ice",
        ", as the street lamps go out,",
        ", astride the centre line,",
        ", cutting the corner,",
        " in the outer lane",
        ", weaving a little,",
    ],
)
def test_what_goes_with_a_deed_is_known(added: str) -> None:
    text = ROUTES + WHEN + "the car brakes{} to a stop 6 m before the conflict point."
    assert formulas(text.format(""))
    with pytest.raises(TranslationError):
        translate_offline(text.format(added))


def test_braking_that_continues_until_it_stands_is_one_deed() -> None:
    text = ROUTES + WHEN + "the car starts to brake. The braking continues until, 6 m before the conflict point, it {}."
    hero = translate_offline(text.format("stands still")).program.heroes[0]
    assert len(hero.sketch.pieces) == 2


STEPS = (
    "Given the ego drives west, straight on, and is 100 m before the intersection at the start\n"
    "And a van comes out of the driveway to turn left\n"
    "When the ego is 48 m from the conflict point\n"
    "And the van is 13 m from its stop line\n"
    "Then the van brakes to a stop 2 m before its stop line\n"
    "And the van stands there for 2 s\n"
    "And then it accelerates and completes its turn before the ego passes the conflict point"
)


@pytest.mark.parametrize(
    "text", [STEPS, STEPS.replace("Given", "GIVEN").replace("And ", "AND "), f"Scenario: a\n{STEPS}"]
)
def test_steps_are_sentences(text: str) -> None:
    told = {"A0x(t0) == intersection - 100", "A1x(t1) == stop_line - 13", "A1x(t2) == stop_line - 2", "A1(t4) < A0(t2)"}
    assert told <= set(formulas(text))
    assert "A1x(t0) == stop_line - 13" not in formulas(text)


def test_what_only_begins_like_a_step_is_left_alone() -> None:
    text = "Given that it is late, the ego drives west.\nAnd a van brakes.\nThen it stops when the ego has passed."
    assert in_sentences(text) == text
    assert len(in_sentences(STEPS)) == len(STEPS)


@pytest.mark.parametrize("who", ["the ego", "the other one"])
def test_one_and_a_half_is_no_name(who: str) -> None:
    """After a name that may end in "one": the ego one."""
    text = (
        "The ego leaves the driveway to the right. A van goes west, straight on. When the van is {} from the conflict "
        "point and the ego {} from the stop line, the van accelerates and is past the conflict point before the ego "
        "begins to turn."
    )
    assert "tta(A0, stop_line, t1) == 1.5" in formulas(text.format("four seconds", "one and a half seconds"))
    other = text.replace("the ego {}", f"{who} {{}}")
    read = []
    with contextlib.suppress(TranslationError):
        read = formulas(other.format("four seconds", "one and a half seconds"))
    assert not any("== 0.5" in each or "== 1/2" in each for each in read)


def test_a_title_above_steps_is_listed() -> None:
    text = f"Scenario: a courteous van\n{STEPS}"
    assert formulas(text) == formulas(STEPS)
    assert any("a courteous van" in each for each in translate_offline(text).assumptions)
    with pytest.raises(TranslationError):
        translate_offline(f"Scenario: a van in the fog\n{STEPS}")


def test_the_former_from_one_place_and_the_latter_from_another() -> None:
    text = (
        "The ego drives east, straight on. A van comes out of the driveway to turn left. When the ego is 4 s and the "
        "van 2 s away, the former from the conflict point and the latter from its stop line, the van accelerates and "
        "completes its turn before the ego passes the conflict point."
    )
    assert {"tta(A0, conflict_point, t1) == 4", "tta(A1, stop_line, t1) == 2"} <= set(formulas(text))


def test_a_whole_sentence_that_begins_with_when_is_no_step() -> None:
    text = f"{WHEN}the car brakes to a stop 6 m before the conflict point.\nThen it accelerates."
    assert in_sentences(text) == text


def test_who_stands_and_drives_on_sets_off() -> None:
    text = (
        "The ego drives east, straight on. A van is standing at the stop line of the driveway, to turn left. When the "
        "ego is 30 m from the conflict point, the van drives on and passes the conflict point before the ego does."
    )
    assert "A1v(stop) == 0" in formulas(text)


def test_whom_the_right_of_way_is_conceded_to_is_not_lost() -> None:
    text = STOPS + ", precedence being conceded to {}."
    assert formulas(text.format("the ego")) == formulas(STOPS + ".")
    with pytest.raises(TranslationError):
        translate_offline(text.format("the car"))


def test_what_is_tied_to_a_deed_of_the_ego_is_refused() -> None:
    assert formulas(FIRST + ".")
    with pytest.raises(TranslationError):
        translate_offline(FIRST.replace("accelerates and", "accelerates as the ego does and") + ".")
