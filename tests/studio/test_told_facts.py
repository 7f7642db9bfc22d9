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
    assert (f"The trigger of hero came at {trigger_s:.2f} s.", trigger_s) in told


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
        "The trigger of hero never came.",
        "Ego, by itself, came to within 1.2 m/s: A0v(t1) == 9.",
        "Hero was not seen to begin what it was to do.",
        "Ego and hero collided at 4.50 s.",
        "Their time to collision was 0.4 s at least.",
    ]
    assert [moment for _, moment in told] == [None, 3.0, None, 4.5, 4.0]


def test_nothing_known_is_nothing_told() -> None:
    assert told_facts({}) == []
    missed = {"trigger_time_s": {"hero": 4.0}, "trigger_came": {"hero": False}}
    assert told_facts(missed) == [("The trigger of hero never came; it was nearest at 4.00 s.", 4.0)]
    assert told_facts({"pairs": {}, "kinematics": {"ego": {}}, "trigger_time_s": {"hero": float("inf")}}) == [
        ("The trigger of hero never came.", None)
    ]
