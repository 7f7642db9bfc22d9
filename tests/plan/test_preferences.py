"""What plans prefer: more of it where a program's manner is stricter, never less."""

from __future__ import annotations

from dataclasses import fields, replace
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.motion.limits import ROOM, calm_mpss
from scenewright.plan.preferences import Preferences, preferences_of
from scenewright.program.manner import NUMBERS, USUAL, Manner

# Which way is stricter; what a manner says nothing of is what it is.
MORE = ("least_rate_mpss", "beginning_mpss", "beginning_s", "settled_s", "shortest_s", "shortest_stand_s", "stands_s")
CLEAR = ("clear_of_ego_m", "clear_of_zone_m", "clear_in_lane_m")
LESS = ("settled_mpss",)
REST = [
    each.name
    for each in fields(Preferences)
    if each.name not in (*MORE, *CLEAR, *LESS, "early_mpss", "least_s", "least_stand_s")
]
manners = st.builds(
    Manner, **{name: st.fractions(of.low, of.high, max_denominator=900) for name, of in NUMBERS.items()}
)


@given(manner=manners)
def test_no_manner_is_asked_for_less_than_usual_and_none_is_done_less_than_it_asks(manner: Manner) -> None:
    found, usual = preferences_of(manner), Preferences()
    for name in (*MORE, *CLEAR):
        assert getattr(found, name) >= getattr(usual, name)
    for name in LESS:
        assert getattr(found, name) <= getattr(usual, name)
    assert {name: getattr(found, name) for name in REST} == {name: getattr(usual, name) for name in REST}
    kept = manner.stricter(ROOM)
    assert found.least_rate_mpss >= float(kept.begins_mpss) - 1e-9
    assert found.beginning_mpss >= float(manner.begins_mpss) - 1e-9
    assert found.beginning_s >= float(kept.begins_s) - 1e-9
    assert (found.least_s, found.least_stand_s) == (float(kept.begins_s), float(kept.stands_s))
    assert all(getattr(found, name) >= float(kept.clear_m) for name in CLEAR)
    assert found.early_mpss <= float(manner.begins_mpss)
    assert found.settled_s >= float(kept.settled_s) - 1e-9
    assert found.settled_mpss <= float(calm_mpss(manner)) + 1e-9
    assert found.shortest_stand_s >= float(kept.stands_s) - 1e-9
    assert found.stands_s >= found.shortest_stand_s - 1e-9


@pytest.mark.parametrize(
    ("stricter", "changed"),
    [
        ({"begins_mpss": Fraction(3)}, {"least_rate_mpss", "beginning_mpss"}),
        ({"begins_s": Fraction(1)}, {"beginning_s", "shortest_s"}),
        ({"settled_s": Fraction(2)}, {"settled_s"}),
        ({"settled_mpss": Fraction(1, 10)}, {"settled_mpss"}),
        ({"clear_m": Fraction(1)}, {"clear_of_zone_m"}),
        ({"clear_m": Fraction(3)}, set(CLEAR)),
        ({"stands_s": Fraction(3)}, {"shortest_stand_s", "stands_s"}),
    ],
)
def test_each_number_of_a_manner_has_its_own_say(stricter: dict[str, Fraction], changed: set[str]) -> None:
    found, usual = preferences_of(replace(USUAL, **stricter)), preferences_of(USUAL)
    assert {name for name in (*MORE, *CLEAR, *LESS) if getattr(found, name) != getattr(usual, name)} == changed
