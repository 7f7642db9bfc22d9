"""What lies between deeds and moments: orders with bounds, breaks, what is so all the while, what is told later."""

from __future__ import annotations

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.translate import story as st
from scenewright.translate.compile import compile_story
from scenewright.translate.read.sentences import read
from scenewright.translate.tell import tell
from scenewright.translate.understand import understand

WAYS = "The ego turns left out of the driveway. The hero drives west. "
MEETS = WAYS + "When the ego is 12 m before the stop line, the hero "
TURNS = "The ego drives west. An oncoming hero turns left. "


def verbs(story: st.Story, actor: int = 1) -> list[str]:
    return [str(deed.verb) for deed in story.deeds_of(actor)]


def margins(story: st.Story) -> list[tuple[str, float | None]]:
    return sorted((each.op, None if each.margin is None else float(each.margin.si or 0)) for each in story.orders)


@pytest.mark.parametrize(
    ("said", "meant", "told"),
    [
        ("at most 2 s after", [("<=", 2), (">=", None)], "at most 2 s after"),
        ("less than 2 s after", [("<", 2), (">=", None)], "less than 2 s after"),
        ("within 2 s after", [("<=", 2), (">=", None)], "at most 2 s after"),
        ("no later than 2 s after", [("<=", 2)], "no later than 2 s after"),
        ("earlier than 2 s after", [("<", 2)], "earlier than 2 s after"),
        ("no earlier than 2 s after", [(">=", 2)], "at least 2 s after"),
        ("between 1 s and 2 s after", [("<=", 2), (">=", 1)], "no later than 2 s after"),
        ("1-2 s after", [("<=", 2), (">=", 1)], "at least 1 s after"),
        ("no later than 2 s before", [(">=", 2)], "at least 2 s after"),
    ],
)
def test_a_bound_on_how_much_later_has_as_many_sides_as_its_words(
    said: str, meant: list[tuple[str, float | None]], told: str
) -> None:
    story = read(f"{WAYS}The hero brakes {said} the ego passes the stop line.")
    assert margins(story) == meant
    lines = tell(story)
    assert any(told in line for line in lines)
    assert st.arranged(read("\n".join(lines))) == st.arranged(story)


def test_what_is_tied_to_another_moment_does_not_begin_where_the_deed_before_ends() -> None:
    story = read(f"{MEETS}brakes to 5 m/s. It finishes braking before the ego passes the stop line. "
                 "It begins to speed up after the ego passes the stop line.")  # fmt: skip
    assert verbs(story) == ["drive on", "brake", "drive on", "speed up"]
    assert len({each for order in story.orders for each in (order.first, order.second)}) == 3


def test_who_brakes_again_has_not_come_to_a_standstill_unless_told() -> None:
    text = f"{MEETS}brakes at 2 m/s^2. Later it brakes to a stop 5 m before the conflict point."
    story = read(text)
    assert verbs(story) == ["drive on", "brake", "drive on", "brake"]
    (question,) = story.questions
    stood = read(text, {question.slot: "to a standstill"})
    assert verbs(stood) == ["drive on", "brake", "stand still", "brake"]


def test_what_is_done_after_a_turn_is_told_is_asked_about() -> None:
    text = f"{TURNS}When the ego is 12 m before the conflict point, the hero turns left. It accelerates at 1.5 m/s^2."
    story = read(text)
    assert verbs(story) == ["drive on", "drive on", "speed up"]
    assert verbs(read(text, {story.questions[0].slot: "while it turns"})) == ["drive on", "speed up"]


def test_a_turn_that_starts_at_a_moment_starts_then() -> None:
    story = read(f"{TURNS}When the ego is 40 m before the conflict point, the hero starts its turn.")
    begins = story.moments[story.deeds_of(1)[1].begins]
    assert {each.place.name for each in begins.conditions if isinstance(each, st.Measure) and each.place} == {
        "conflict_point", "turn_start"}  # fmt: skip


def test_while_holds_all_the_while_or_where_that_is_answered_when_it_begins() -> None:
    text = f"{WAYS}While the ego stands at the stop line, the hero speeds up to 12 m/s."
    story = read(text)
    assert [(hold.how, hold.condition) for hold in story.holds] == [("always", st.standstill(0))]
    assert not read(text, {story.questions[0].slot: "when it begins"}).holds
    assert not read(f"{WAYS}While the ego is 12 m before the stop line, the hero brakes.").holds
    with pytest.raises(TranslationError, match="how long"):
        read(f"{WAYS}While the ego is at least 12 m before the stop line, the hero drives at 5 m/s.")


def test_a_deed_lasts_until_some_time_after_a_moment() -> None:
    story = read(f"{MEETS}brakes to a stop. It stands until 1 s after the ego passes the conflict point.")
    assert verbs(story) == ["drive on", "brake", "stand still"]
    assert margins(story) == [("==", 1)]


@pytest.mark.parametrize(
    ("said", "does"),
    [
        ("speeds up. It passes", ["drive on", "speed up"]),
        ("speeds up to 12 m/s. It passes", ["drive on", "speed up", "drive on"]),
        ("speeds up to 12 m/s so that it passes", ["drive on", "speed up", "drive on"]),
        ("brakes to a stop. It passes", ["drive on", "brake", "stand still", "drive on"]),
        ("brakes. It passes", ["drive on", "brake", "drive on"]),  # it is asked how far
    ],
)
def test_who_passes_first_may_be_told_after_what_it_does(said: str, does: list[str]) -> None:
    story = read(f"{MEETS}{said} the conflict point before the ego.")
    assert verbs(story) == does
    assert [(each.first, each.op) for each in story.orders] == [(story.deeds_of(1)[-1].ends, ">")]


def test_what_the_ego_does_then_lies_between() -> None:
    for lead in ("Later, the ego passes", "Then the ego passes"):
        story = read(f"{MEETS}brakes to a stop. {lead} the conflict point. Then the hero drives on.")
        passes = next(at for at, each in enumerate(story.moments) if any(map(st.is_event, each.conditions)))
        assert (passes, story.deeds_of(1)[-1].begins) in [(each.first, each.second) for each in story.orders]


@pytest.mark.parametrize(
    ("said", "named"),
    [
        ("brakes to half its speed.", "half"),
        ("brakes twice as hard.", "twice"),
        ("brakes harder.", "harder"),
        ("brakes. The ego drives half as fast as the hero.", "half"),
        ("speeds up. It brakes when the ego starts to turn, but only to 10 m/s.", "to"),
        ("speeds up. It stops before the ego begins to turn, at 5 m/s.", "not one event"),
        ("brakes to a stop. It stands at most until the ego passes the stop line.", "at most"),
    ],
)
def test_what_changes_a_number_is_never_set_aside(said: str, named: str) -> None:
    with pytest.raises(TranslationError) as caught:
        read(MEETS + said)
    assert named in caught.value.message


@pytest.mark.parametrize(
    ("said", "amount"),
    [("half a second", "1/2"), ("a third of a second", "1/3"), ("one and a half seconds", "3/2"), ("0.5 s", "1/2"),
     ("three quarters of a second", "3/4")],
)  # fmt: skip
def test_parts_of_a_unit_are_amounts(said: str, amount: str) -> None:
    story = read(f"{MEETS}brakes to a stop and waits for {said}.")
    assert [str(each.margin.si) for each in story.orders if each.margin is not None] == [amount]


@pytest.mark.parametrize(
    "said",
    ["20-25 m", "20 – 25 m", "20 m - 25 m", "20 to 25 m", "between 20 and 25 m", "at least 20 m and at most 25 m"],
)
def test_a_range_is_a_lower_and_an_upper_bound(said: str) -> None:
    plain = read(f"{WAYS}When the ego is between 20 m and 25 m before the stop line, the hero brakes.")
    story = read(f"{WAYS}When the ego is {said} before the stop line, the hero brakes.")
    assert st.arranged(story) == st.arranged(plain)


def test_it_of_a_place_keeps_whose_it_is() -> None:
    story = read(f"{MEETS}brakes to a stop 5 m before it.")
    assert st.Place("stop_line", 0) in [each.place for each in st.within(story.moments, st.Measure)]
    meets = read(
        f"{WAYS}When the ego is 12 m before the conflict point and the hero is 20 m before it, the hero brakes."
    )
    assert {each.place for each in st.within(meets.moments, st.Measure) if each.place} == {st.Place("conflict_point")}


def test_people_have_numbers() -> None:
    story = read("The ego turns left out of the driveway. POV1 drives west, POV 2 drives east. When the ego is 12 m "
                 "before the stop line, POV 2 brakes.")  # fmt: skip
    assert [actor.name for actor in story.heroes] == ["hero 1", "hero 2"]
    assert verbs(story, 2) == ["drive on", "brake"]


LINE = "The ego drives west. A hero drives ahead of it at 12 m/s. When "


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        (f"{LINE}the TTC of the ego and the hero is 3 s, it brakes.", f"{LINE}the TTC is 3 s, it brakes."),
        (f"{LINE}the time to collision with the hero is 3 s, it brakes.", f"{LINE}the TTC is 3 s, it brakes."),
        (f"{LINE}the headway to the hero is 2 s, it brakes.", f"{LINE}the headway is 2 s, it brakes."),
        (f"{LINE}the headway of the ego to the hero is 2 s, it brakes.", f"{LINE}the headway is 2 s, it brakes."),
        (f"{LINE}the ego's headway is 2 s, it brakes.", f"{LINE}the headway is 2 s, it brakes."),
        (f"{LINE}the speed of the hero is 9 m/s, it brakes.", f"{LINE}the hero drives at 9 m/s, it brakes."),
        (f"{LINE}the ego has a speed of 9 m/s and a headway of 2 s to the hero, the hero brakes.",
         f"{LINE}the ego drives at 9 m/s and the headway is 2 s, the hero brakes."),
        (f"{LINE}the gap is 20 m, it brakes from 12 m/s to 8 m/s.",
         f"{LINE}the gap is 20 m and the hero drives at 12 m/s, it brakes to 8 m/s."),
        (f"{LINE}the gap is 20 m, it brakes from 12 to 8 m/s.",
         f"{LINE}the gap is 20 m and the hero drives at 12 m/s, it brakes to 8 m/s."),
        (f"{LINE}the gap is 20 m, it brakes to a stop in 4 s.",
         f"{LINE}the gap is 20 m, it begins to brake for 4 s until it stands."),
        (f"{LINE}the gap is 20 m, it brakes to a stop in 3 to 4 s.",
         f"{LINE}the gap is 20 m, it begins to brake for at least 3 s and at most 4 s until it stands."),
        (f"{LINE}the ego has a gap of 20 m and drives at 9 m/s, the hero brakes.",
         f"{LINE}the gap is 20 m and the ego drives at 9 m/s, the hero brakes."),
        (f"{LINE}the gap is 20 m, it brakes to 5 m/s within 4 s.",
         f"{LINE}the gap is 20 m, it begins to brake for at most 4 s until it drives at 5 m/s."),
        (f"{LINE}the gap is 20 m, it brakes at 2 m/s^2 to a speed of 5 m/s.",
         f"{LINE}the gap is 20 m, it brakes at 2 m/s^2 to 5 m/s."),
        (f"{LINE}the gap is 20 m, the hero brakes 1 s later to 5 m/s.",
         f"{LINE}the gap is 20 m. 1 s later, the hero brakes to 5 m/s."),
        (f"{WAYS}When the ego is 3 s and the hero 4 s from the conflict point, the hero brakes.",
         f"{WAYS}When the ego is 3 s from the conflict point and the hero is 4 s from the conflict point, it brakes."),
        (f"{WAYS}When the ego waits at its stop line, the hero brakes.",
         f"{WAYS}When the ego stands at its stop line, the hero brakes."),
        (f"{WAYS}When the ego stops at its stop line, the hero brakes.",
         f"{WAYS}When the ego stands at its stop line, the hero brakes."),
        (f"{WAYS}The hero keeps its speed until the ego is 12 m before the stop line, then it brakes.",
         f"{WAYS}The hero continues at a constant speed until the ego is 12 m before the stop line, then it brakes."),
        ("The ego drives west. A hero ahead of it brakes to a stop when the gap is 20 m.",
         "The ego drives west. A hero drives ahead of it. When the gap is 20 m, the hero brakes to a stop."),
        (f"{LINE}the gap is 20 m, it brakes to 5 m/s and 1 s later it speeds up.",
         f"{LINE}the gap is 20 m, it brakes to 5 m/s. 1 s later, it speeds up."),
        ("The ego proceeds west at 9 m/s. A hero drives ahead of it. When the gap is 20 m, the hero brakes.",
         "The ego drives west at 9 m/s. A hero drives ahead of it. When the gap is 20 m, the hero brakes."),
        ("The ego drives west behind a bus. When the gap is 20 m, it brakes.",
         "The ego follows a bus west in the same lane. When the gap is 20 m, it brakes."),
    ],
)  # fmt: skip
def test_what_is_said_otherwise_is_the_same(said: str, plain: str) -> None:
    assert st.arranged(understand(said).story) == st.arranged(understand(plain).story)


@pytest.mark.parametrize(
    ("said", "named"),
    [
        (f"{LINE}the gap is 20 m, it brakes to a stop within 30 m.", "how far a deed goes"),
        (f"{LINE}the gap is 20 m, it brakes within 3 s.", "'3 s'"),
        (f"{LINE}the gap is 20 m, it stands still in 3 s.", "'3 s'"),
        (f"{LINE}the gap is 20 m, it brakes to 5 m/s. It passes the conflict point before it.", "before itself"),
        ("The ego drives west. A hero turns right out of the driveway in front of the ego.", "goes first"),
        ("The ego and the hero drive west. When it is 20 m before the stop line, it brakes.", "who is meant"),
        ("The traffic light turns red when the ego is 30 m before the stop line.", "leaves something open"),
        ("The ego drives north. The hero zonks.", "leaves something open"),
    ],
)
def test_what_is_not_clear_is_named(said: str, named: str) -> None:
    with pytest.raises(TranslationError) as caught:
        understand(said)
    assert named in caught.value.message


def test_it_is_of_whom_a_moment_was_told_last() -> None:
    story = read("The ego drives west. An oncoming truck and an oncoming van turn left. When the ego is 30 m before "
                 "the stop line, the truck is 20 m before its stop line. It brakes.")  # fmt: skip
    assert (verbs(story, 1), verbs(story, 2)) == (["drive on", "brake"], [])
    story = read(f"{WAYS}When the hero is 30 m before the stop line, the ego is 12 m before its stop line. It brakes.")
    assert verbs(story, 1) == ["drive on", "brake"]


def test_a_bare_car_beside_a_truck_is_another_one() -> None:
    story = read("The ego turns left out of the driveway. Truck from the left, car from the right. When the ego is 12 "
                 "m before the stop line, the truck brakes. Then the car brakes.")  # fmt: skip
    assert [actor.name for actor in story.heroes] == ["truck", "car"]
    story = read("The ego turns right out of the driveway. Car A drives west. Car B follows car A. When the ego is 12 "
                 "m before the stop line, car B brakes.")  # fmt: skip
    assert [actor.name for actor in story.heroes] == ["car a", "car b"]
    assert verbs(story, 2) == ["drive on", "brake"]


CROSSES = "The ego drives west. An oncoming hero turns left. "
NEAR = "When the ego is 35 m before the conflict point, "


def test_what_a_stop_comes_after_is_its_end_where_its_beginning_is_told() -> None:
    story = read(CROSSES + NEAR + "the hero brakes to a stop within 2 s after the ego passes the conflict point.")
    braking = story.deeds_of(1)[1]
    assert {each.first for each in story.orders} | {each.second for each in story.orders} >= {braking.ends}
    assert braking.begins not in {each.first for each in story.orders} | {each.second for each in story.orders}


@pytest.mark.parametrize(
    "said",
    [
        NEAR + "the hero brakes from 5 m/s to 10 m/s.",
        NEAR + "the hero speeds up from 10 m/s to 5 m/s.",
        "While the ego is at least 9 m from the conflict point, the hero brakes to 5 m/s and speeds up to 10 m/s.",
    ],
)
def test_what_cannot_be_meant_is_refused(said: str) -> None:
    with pytest.raises(TranslationError):
        read(CROSSES + said)


@pytest.mark.parametrize("car", ["(the car is 20 m from it), the truck", "the car", "its car"])
def test_the_car_is_the_only_one_there_is(car: str) -> None:
    story = read(
        "The ego drives west. A truck turns left, headed east. " + NEAR.rstrip(", ") + f", {car} brakes to a stop."
    )
    assert len(story.actors) == 2


LEAD = "The ego is headed west and goes straight on. The hero is headed west and goes straight on. "
BRAKES = "When the ego is 30 m before the stop line, the hero brakes to 3 m/s. "
BEHIND = "always[A1(t0), A1(t1)](gap(A0, A1) {})"


@pytest.mark.parametrize(
    ("said", "held"),
    [
        ("The hero stays at least 20 m ahead of the ego until it brakes.", [BEHIND.format(">= 20")]),
        ("The hero remains 20 to 30 m ahead of the ego until it begins to brake.",
         [BEHIND.format(">= 20"), BEHIND.format("<= 30")]),
        ("Until the hero brakes, the ego is more than 20 m behind it.", [BEHIND.format("> 20")]),
        ("The hero drives at most 30 m ahead of the ego until it brakes.", [BEHIND.format("<= 30")]),
        ("The ego has a headway of at least 1 s to the hero until 2 s before the hero brakes.",
         ["always[A1(t0), A1(t1) - 2](headway(A0, A1) >= 1)"]),
    ],
)  # fmt: skip
def test_what_is_so_until_a_moment_holds_from_the_start(said: str, held: list[str]) -> None:
    for text in (f"{LEAD}{BRAKES}{said}", f"{LEAD}{said} {BRAKES}"):
        program = compile_story(read(text))
        formulas = [print_expression(each.formula) for each in program.constraints]
        assert sorted(each for each in formulas if each.startswith("always")) == sorted(held)


@pytest.mark.parametrize(
    ("said", "message"),
    [
        ("The hero is at least 20 m ahead of the ego until it speeds up.", "nothing was told of this deed before"),
        (
            "The hero is at least 20 m ahead of the ego until it brakes at 5 m/s.",
            "nothing was told of this deed before",
        ),
        ("The hero until it brakes.", "not said what is done"),
        ("The hero stays 20 m ahead of the ego.", "until when"),
        ("The hero stays at 10 m/s.", "until when"),
        ("The hero stays 20 m ahead of the ego and brakes until it stands.", "until when"),
    ],
)
def test_until_which_moment_something_is_so_is_told_somewhere(said: str, message: str) -> None:
    with pytest.raises(TranslationError, match=message):
        read(f"{LEAD}{BRAKES}{said}")


def test_what_stays_so_is_not_taken_for_what_is_so_at_the_start() -> None:
    for said in ("The hero stays 20 m ahead of the ego. ", "The hero remains below 10 m/s. "):
        with pytest.raises(TranslationError, match="until when"):
            read(f"{LEAD}{said}{BRAKES}")


def test_from_when_something_is_so_until_a_later_moment_is_asked() -> None:
    text = f"{LEAD}{BRAKES}The hero is at least 5 m ahead of the ego until the ego is 10 m before the stop line."
    (question,) = read(text).questions
    starts = [hold.start.moment for hold in read(text).holds]
    later = [hold.start.moment for hold in read(text, {question.slot: question.alternatives[1]}).holds]
    assert starts == [st.START]
    assert later == [read(text).deeds_of(1)[-1].ends]


def test_a_moment_of_the_ego_until_which_something_is_so_comes_where_it_is_told() -> None:
    """It is 40 m before the line before it is 30 m before it: told the other way round nothing could happen."""
    program = compile_story(read(f"{LEAD}The hero is at least 20 m ahead of the ego until the ego is 40 m before the "
                                 f"stop line. {BRAKES}"))  # fmt: skip
    assert "A0x(t1) == stop_line - 40" in [print_expression(each.formula) for each in program.constraints]
