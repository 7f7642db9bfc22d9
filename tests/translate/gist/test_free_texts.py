"""Free texts give the program of the facts they tell, say what was set aside, and drop no fact."""

from __future__ import annotations

import re

import pytest

from scenewright.errors import TranslationError
from scenewright.program.printer import print_expression
from scenewright.program.types import HeadingsRoute, Program
from scenewright.translate import rules
from scenewright.translate.confidence import Basis
from scenewright.translate.itineraries import default_map
from scenewright.translate.offline import Translation, translate_offline

POLITE = (
    "My uncle drives a lorry, and he is a patient man. He is on the main road now, heading west, with no turn to make. "
    "Out of the driveway comes the ego, which is to turn left and go off eastward; as the scene opens it is 5.8 "
    "seconds from the stop line. When the ego is 1.9 seconds from the stop line, and my uncle's lorry 4.2 seconds from "
    "the conflict point, he starts to brake, and he brings the lorry to a complete stop twelve metres before the "
    "conflict point. He stands there until the ego has completed its turn. Only after that does he accelerate and "
    "drive on through the conflict point."
)
TABLE = (
    "| AV: westbound -> right into driveway | Hero: eastbound -> left into driveway |\n"
    "| Start: AV 5 s from intersection |\n"
    "| Trigger: AV 3 s from conflict point, hero 2.5 s from conflict point |\n"
    "| Hero brakes, stands 8 m before conflict point |"
)
NOTES = (
    "Ego\n- route: eastbound, straight on\n- initial distance to the intersection: 70 m\n"
    "Dustcart\n- comes out of the driveway, to the left\n"
    "Trigger\n- ego 48 m from the conflict point and the dustcart 13 m from the stop line\n"
    "Action\n- a dustcart should wait: the dustcart brakes to a stop 1 m before the stop line\n"
)
TOGETHER = (
    "Rear-end hazard. Both the SUT and a taxi in front of it come out of the driveway to turn right. Once only 9 m "
    "separate the SUT from the taxi, the latter brakes at 3.5 m/s² until it has come to a standstill."
)
FIRST_PERSON = (
    "I am driving west in the test car, straight on, 75 m before the intersection at first. Some guy in a hatchback "
    "comes out of the driveway and goes left. When I have 35 m left to the point where our paths cross and he has 12 m "
    "to his stop line, he puts his foot down, and his turn is done before I pass the conflict point."
)
STANDING = (
    "As the curtain rises a taxi is standing at the stop line of the driveway; it will go left. The car under test is "
    "eastbound on the road and goes straight on. At the moment when the car under test is 2.6 s from the conflict "
    "point the taxi pulls away, and it has completed its turn before the car under test passes the conflict point."
)


def read(text: str) -> Translation:
    return translate_offline(text)


def routes(program: Program) -> list[tuple[str, ...]]:
    return [actor.route.headings for actor in program.actors if isinstance(actor.route, HeadingsRoute)]


def formulas(program: Program) -> list[str]:
    return [print_expression(constraint.formula) for constraint in program.constraints]


@pytest.mark.parametrize(
    ("text", "ways", "told"),
    [
        (
            POLITE,
            [("S", "E"), ("W",)],
            ["tta(A0, stop_line, t0) == 5.8", "tta(A1, conflict_point, t1) == 4.2", "A1x(t2) == conflict_point - 12",
             "A1x(t4) == conflict_point", "A0x(t2) == turn_end", "A1(t3) > A0(t2)"],
        ),
        (
            TABLE,
            [("W", "N"), ("E", "N")],
            ["tta(A0, intersection, t0) == 5", "tta(A0, conflict_point, t1) == 3", "A1x(t2) == conflict_point - 8"],
        ),
        (TOGETHER, [("S", "W"), ("S", "W")], ["gap(A0, A1, t1) == 9", "A1a(dec) == -3.5", "A1v(t2) == 0"]),
        (
            FIRST_PERSON,
            [("W",), ("S", "E")],
            ["A0x(t0) == intersection - 75", "A0x(t1) == conflict_point - 35", "A1x(t1) == stop_line - 12",
             "A1x(t2) == turn_end", "A0x(t2) == conflict_point", "A1(t2) < A0(t2)"],
        ),
        (
            STANDING,
            [("E",), ("S", "E")],
            ["A1x(t0) == stop_line", "A1v(stop) == 0", "tta(A0, conflict_point, t1) == 2.6", "A1x(t2) == turn_end"],
        ),
    ],
    ids=["polite", "table", "together", "first person", "standing"],
)  # fmt: skip
def test_a_free_text_gives_its_program(text: str, ways: list[tuple[str, ...]], told: list[str]) -> None:
    program = read(text).program
    assert routes(program) == ways
    assert set(told) <= set(formulas(program))


@pytest.mark.parametrize("text", [POLITE, TABLE, TOGETHER, FIRST_PERSON, STANDING])
def test_every_fact_says_where_it_stands_and_how_sure_it_is(text: str) -> None:
    translation = read(text)
    assert all(reading.text == reading.span.excerpt(text) for reading in translation.readings)
    assert all(0 < reading.confidence <= Basis.FACTS.value.value for reading in translation.readings)
    told = {identifier for reading in translation.readings for identifier in reading.constraint_ids}
    assert told == {constraint.id for constraint in translation.program.constraints}
    assert translation.assumptions[0] == "the text was read for its facts, not clause by clause"


def test_what_was_not_understood_is_said() -> None:
    said = read(
        POLITE.replace("He stands there", "The weather is dreadful. The courtesy did not last. He stands there")
    )
    assert any("'dreadful'" in each for each in said.assumptions)
    assert any("The courtesy did not last" in each and "set aside" in each for each in said.assumptions)


NUMBERS = re.compile(r"(?<![\w.])\d+(?:\.\d+)?")


@pytest.mark.parametrize("text", [POLITE, TABLE, TOGETHER, FIRST_PERSON, STANDING])
def test_every_number_counts(text: str) -> None:
    before = formulas(read(text).program)
    found = list(NUMBERS.finditer(text))
    assert found
    for match in found:
        after = formulas(read(f"{text[: match.start()]}{match.group()}1{text[match.end() :]}").program)
        assert len(set(before) ^ set(after)) == 2, match.group()


CHANGES = {
    "left": "right", "right": "left", "west": "east", "westbound": "eastbound", "eastbound": "westbound",
    "stop line": "conflict point", "brakes": "accelerates", "accelerate": "brake", "before": "after",
    "turn": "stop", "when": "unless", "until": "unless", "and": "or", "ego": "lorry", "taxi": "ego", "lorry": "ego",
    "driveway": "road", "stop": "bicycle", "out of": "into", "into": "out of", "goes": "does not go",
    "comes": "never comes", "is": "is not", "has": "has not", "pulls away": "stays", "paths": "pasts",
}  # fmt: skip
# Words that tell nothing here: of the world, of what is said twice, or of a standstill that is a standstill anyway.
HARMLESS = ("patient", "oven", "is done before", "drives a", "until it has", "he is a", "has come to")


@pytest.mark.parametrize("text", [POLITE, TABLE, TOGETHER, FIRST_PERSON, STANDING])
def test_a_changed_word_is_refused_or_changes_the_program(text: str) -> None:
    original = read(text).program
    same = (routes(original), formulas(original), [actor.sketch for actor in original.actors])
    for word, other in CHANGES.items():
        for match in re.finditer(rf"\b{word}\b", text):
            around = text[max(0, match.start() - 12) : match.end() + 12]
            if any(each in around for each in HARMLESS):
                continue
            changed = f"{text[: match.start()]}{other}{text[match.end() :]}"
            try:
                program = read(changed).program
            except TranslationError:
                continue
            now = (routes(program), formulas(program), [actor.sketch for actor in program.actors])
            assert now != same, changed


def test_the_map_is_asked_which_routes_fit() -> None:
    with pytest.raises(TranslationError):
        translate_offline(POLITE.replace("left", "straight on"), default_map())


def test_a_list_with_headings_and_a_vehicle_of_an_unknown_kind() -> None:
    program = read(NOTES).program
    assert routes(program) == [("E",), ("S", "E")]
    assert {"A0x(t0) == intersection - 70", "A1x(t1) == stop_line - 13", "A1x(t2) == stop_line - 1"} <= set(
        formulas(program)
    )


AGREED = (
    "Ego is on the driveway exit and wants to turn left, 20 m behind the stop line. The hero travels westbound. "
    "When the ego is 12 m behind the stop line and the hero 30 m before the conflict point, the hero brakes to a stop "
    "5 m before the conflict point."
)


@pytest.mark.parametrize(
    ("said", "otherwise"),
    [("20 m", "21 m"), ("12 m", "21 m"), ("5 m", "6 m"), ("westbound", "eastbound"), ("turn left", "turn right")],
)
@pytest.mark.parametrize("more", ["", " Both travel at 10 m/s."])
def test_two_readings_that_differ_are_no_reading(
    monkeypatch: pytest.MonkeyPatch, said: str, otherwise: str, more: str
) -> None:
    """The reader of clauses is made to hear another word; the reader of facts hears what is written."""
    text = AGREED.replace("westbound.", f"westbound.{more}")
    mishear = rules._by_grammar
    monkeypatch.setattr(rules, "_by_grammar", lambda text, *rest: mishear(text.replace(said, otherwise), *rest))
    with pytest.raises(TranslationError, match="two ways"):
        read(text)
    assert read(text.replace(said, otherwise)).program.actors


@pytest.mark.parametrize(
    "ways",
    [
        "The ego comes from the east and turns right into the driveway, the hero behind it does so too.",
        "The ego drives east and turns left into the driveway, just like the hero ahead.",
        "The hero ahead of the ego, westbound, turns right off the road into the driveway, and so does the ego.",
    ],
)
def test_who_turns_like_the_other_does_not_go_straight_on(ways: str) -> None:
    """Nothing says whether "so does the ego" is about its turn, or only about its way there."""
    try:
        actors = read(f"{ways} When the ego is 2 s behind the hero, the hero brakes at 2 m/s^2.").program.actors
    except TranslationError:
        return
    assert [actor.route for actor in actors] == [actors[0].route] * 2


ROUTES = (
    "Our shuttle comes down the driveway, bound for the left. A lorry, whose hue nobody recalls, goes west along the "
    "road. "
)
ACTS = "Once the shuttle is 14 m before its stop line and the lorry 40 m from the conflict point, "


def refusal_of(text: str) -> str:
    with pytest.raises(TranslationError) as caught:
        read(text)
    return caught.value.message + (caught.value.fix or "")


@pytest.mark.parametrize(
    ("end", "last"),
    [
        ("while the shuttle has yet to begin its turn.", ["A0x(t2) == turn_start", "A1(t2) < A0(t2)"]),
        ("when the shuttle has not yet begun to turn.", ["A0x(t2) == turn_start", "A1(t2) < A0(t2)"]),
        ("while the shuttle has yet to complete its turn.", ["A0x(t2) == turn_end", "A1(t2) < A0(t2)"]),
    ],
)
def test_what_is_yet_to_come_is_an_order(end: str, last: list[str]) -> None:
    assert (
        formulas(read(f"{ROUTES}{ACTS}the lorry picks up speed and clears the conflict point {end}").program)[-2:]
        == last
    )


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (f"{ROUTES}{ACTS}the lorry speeds up and clears the conflict point while the shuttle is turning.", "meanwhile"),
        (
            f"{ROUTES}When the shuttle is level with the mailbox and the lorry 40 m from the conflict point, the lorry "
            "brakes to a stop 5 m before the conflict point.",
            "it may be a condition",
        ),
        (
            f"{ROUTES}{ACTS}the lorry brakes at 3 m/s^2 and at the same moment accelerates at 2 m/s^2 to pass the "
            "conflict point before the shuttle begins to turn.",
            "at one time",
        ),
        (f"{ROUTES}{ACTS}the lorry seems to brake.", "what the hero does"),
    ],
)
def test_what_cannot_be_told_apart_is_refused(text: str, why: str) -> None:
    assert why in refusal_of(text)


def test_what_says_that_it_changes_nothing_is_set_aside_and_listed() -> None:
    rain = "It has rained all night, which makes no difference to the test."
    plain, wet = (
        read(f"{ROUTES}{ACTS}the lorry brakes to a stop 5 m before the conflict point."),
        read(f"{rain} {ROUTES}{ACTS}the lorry brakes to a stop 5 m before the conflict point."),
    )
    assert formulas(plain.program) == formulas(wet.program)
    assert any("It has rained all night" in each for each in wet.assumptions)
    assert "not to stop" in refusal_of(
        f"The lorry does not stop, which makes no difference. {ROUTES}{ACTS}the lorry stops."
    )


KEYS = """actors:
  ego: westbound, straight
  hero: oncoming, left turn into driveway
trigger:
  ego: 3.5 s from conflict point
  hero: 2 s from conflict point
reaction: hero speeds up, has completed the turn before ego passes the conflict point"""


def test_keys_under_a_heading_are_all_of_that_heading() -> None:
    told = formulas(read(KEYS).program)
    assert {"tta(A0, conflict_point, t1) == 3.5", "tta(A1, conflict_point, t1) == 2"} <= set(told)


@pytest.mark.parametrize(
    "text",
    [
        f"{ROUTES}The lorry is 40 m from the conflict point and the shuttle 14 m before its stop line when the lorry "
        "begins to brake; it comes to a complete stop 5 m before the conflict point.",
        f"{ROUTES}The lorry drives on until the shuttle is 14 m before its stop line and the lorry 40 m from the "
        "conflict point; at that moment it begins to brake to a stop 5 m before the conflict point.",
        f"{ROUTES}{ACTS}the lorry has to brake to a stop 5 m before the conflict point; it does not "
        "drive on afterwards.",
    ],
)
def test_one_scenario_told_in_many_ways(text: str) -> None:
    plain = read(f"{ROUTES}{ACTS}the lorry brakes to a stop 5 m before the conflict point.")
    assert set(formulas(read(text).program)) == set(formulas(plain.program))
