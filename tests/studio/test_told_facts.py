"""What else a verdict knows is told in sentences; of what is missing nothing is."""

from __future__ import annotations

import json
import re

import pytest

from scenewright.studio.told_facts import told_facts
from stories import driven


@pytest.mark.parametrize(
    ("story", "ego"), [("yields, distance", "idm"), ("stops and goes", "constant"), ("brakes at a rate", "constant")]
)
def test_a_real_verdict_is_told_without_the_names_of_its_fields(story: str, ego: str) -> None:
    verdict = driven(story, ego).verdict
    assert verdict is not None
    told = told_facts(json.loads(json.dumps(verdict.as_dict()))["facts"])
    text = " ".join(sentence for sentence, _ in told)
    assert not re.search(r"[a-z]_[a-z]|None|nan|inf\b|[{}]", re.sub(r": [^.]*?[<=>].*?\.", ".", text))
    assert all(sentence.endswith(".") for sentence, _ in told)
    trigger_s = next(iter(verdict.facts["trigger_time_s"].values()))
    assert (f"The trigger of the hero came at {trigger_s:.2f} s.", trigger_s) in told


def test_what_went_wrong_is_told() -> None:
    told = told_facts(
        {
            "trigger_time_s": {"hero": None},
            "closest": [
                {"who": "ego", "side": "A0v(t1) == 9", "met": False, "error": -1.25, "unit": "m/s", "time_s": 3.0}
            ],
            "interaction": {"hero": {"onset_s": None, "end_s": None}},
            "pairs": {"ego, hero": {"collision_time_s": 4.5, "min_ttc_s": 0.4, "min_ttc_time_s": 4.0}},
        }
    )
    assert [sentence for sentence, _ in told] == [
        "The trigger of the hero never came.",
        "The ego, by itself, came to within 1.2 m/s: A0v(t1) == 9.",
        "The hero was not seen to begin what it was to do.",
        "The ego and the hero collided at 4.50 s.",
        "Their time to collision was 0.4 s at least.",
    ]
    assert [moment for _, moment in told] == [None, 3.0, None, 4.5, 4.0]


def test_who_came_near_is_named_and_nothing_is_told_of_nothing() -> None:
    side = {"side": "the van is 5 m behind the hero", "met": False, "error": 14.0, "unit": "m", "time_s": 3.0}
    even = {"onset_s": 1.0, "end_s": 3.0, "mean_acceleration_mpss": -2.0, "max_deviation_mpss": 0.001}
    told = told_facts(
        {
            "closest": [{"who": "hero", "actors": ["van"], **side}, {"who": "pair", "actors": ["hero", "van"], **side}],
            "interaction": {"hero": even},
            "kinematics": {"ego": {"speed": 9.0, "acceleration": -0.0, "deceleration": 0.1, "lateral": 0.0}},
        }
    )
    assert [sentence for sentence, _ in told] == [
        "The van, by itself, came to within 14.0 m: the van is 5 m behind the hero.",
        "The hero and the van, together, came to within 14.0 m: the van is 5 m behind the hero.",
        "The hero did what it was to do from 1.00 to 3.00 s, at −2.00 m/s² throughout.",
        "At most the ego drove at 9.0 m/s, sped up by 0.0 m/s², braked by 0.0 m/s², and felt 0.0 m/s² sideways.",
    ]


def test_sides_that_came_apart_are_told_only_where_the_trigger_never_came() -> None:
    facts = {"trigger_time_s": {"hero": 4.0}, "trigger_sides_apart_s": 5.13}
    assert len(told_facts({**facts, "trigger_came": {"hero": True}})) == 1
    assert any("5.13 s apart" in told for told, _ in told_facts({**facts, "trigger_came": {"hero": False}}))


def test_nothing_known_is_nothing_told() -> None:
    assert told_facts({}) == []
    missed = {"trigger_time_s": {"hero": 4.0}, "trigger_came": {"hero": False}}
    assert told_facts(missed) == [("The trigger of the hero never came; it was nearest at 4.00 s.", 4.0)]
    assert told_facts({"pairs": {}, "kinematics": {"ego": {}}, "trigger_time_s": {"hero": float("inf")}}) == [
        ("The trigger of the hero never came.", None)
    ]


def test_no_time_to_collision_is_one_beyond_what_is_looked_at() -> None:
    pair = {"collision_time_s": None, "min_distance_m": 0.043, "min_distance_time_s": 3.0, "min_ttc_s": None}
    assert [sentence for sentence, _ in told_facts({"pairs": {"ego, hero": pair}})] == [
        "The ego and the hero came within 0.04 m of each other, body to body, and never touched.",
        "They were never within 8 s of a collision, as their motion stood.",
    ]


def test_two_were_where_one_was() -> None:
    side = {"side": "the van is 5 m behind the hero", "met": True, "error": 0.1, "unit": "m", "time_s": 3.0}
    assert [sentence for sentence, _ in told_facts({"closest": [{"actors": ["hero", "van"], **side}]})] == [
        "The hero and the van, together, were there: the van is 5 m behind the hero."
    ]


def test_names_stand_as_they_were_given() -> None:
    """A name in capitals stays in them, at the beginning of a sentence, too."""
    pair = {"collision_time_s": 4.5, "min_ttc_s": None, "post_encroachment_time_s": None}
    told = told_facts({"trigger_time_s": {"LeadTruck": 1.0}, "pairs": {"LeadTruck, blue_Van": pair}})
    assert [sentence for sentence, _ in told][:2] == [
        "The trigger of the car 'LeadTruck' came at 1.00 s.",
        "The car 'LeadTruck' and the car 'blue_Van' collided at 4.50 s.",
    ]


def test_who_was_at_a_place_second_is_left_open_where_the_number_does_not_tell() -> None:
    pair = {"min_distance_m": 5.0, "min_ttc_s": 2.0, "post_encroachment_time_s": 1.3}
    *_, last = (sentence for sentence, _ in told_facts({"pairs": {"ego, hero": pair}}))
    assert last == "One came to a place that the other had been at 1.3 s after that had left it."


def test_how_far_off_somebody_was_reads_as_a_number_beyond_a_hundred_too() -> None:
    side = {"side": "the ego is 12 m before the stop line", "met": False, "error": 115.2, "unit": "m", "time_s": 3.0}
    ((sentence, _),) = told_facts({"closest": [{"actors": ["ego"], **side}]})
    assert sentence == "The ego, by itself, came to within 115.2 m: the ego is 12 m before the stop line."
