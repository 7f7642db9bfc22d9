"""Whoever drives heroes keeps the contract: planners and rivals alike."""

from __future__ import annotations

import inspect
from itertools import pairwise

import pytest

from scenewright.plan.planner import Planner
from scenewright.plan.smt import SmtPlanner
from scenewright.simulate.loop import HeroDriver
from stories import driven

MEMBERS = [name for name in vars(HeroDriver) if not name.startswith("_")]


@pytest.mark.parametrize("driver", [Planner, SmtPlanner])
def test_planners_offer_all_of_it(driver: type) -> None:
    slots = {name for each in driver.__mro__ for name in getattr(each, "__slots__", ())}
    assert all(name in slots or hasattr(driver, name) for name in MEMBERS)
    for name in ("tick", "observe"):
        asked, offered = (inspect.signature(getattr(each, name)).parameters for each in (HeroDriver, driver))
        assert list(asked) == list(offered)


@pytest.mark.parametrize("ego", ["idm", "noisy"])
def test_every_tick_is_told_in_order_and_the_egos_knots_too(ego: str) -> None:
    run = driven("yields, distance", ego).run
    assert run is not None
    assert all(before.time_s < after.time_s for before, after in pairwise(run.replans))
    times = list(run.ego_knots_s.values())
    assert times == sorted(times)
