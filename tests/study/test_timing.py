"""Timing of re-solves: what is counted, and that its scenarios are ones that succeed. No time is asserted."""

from __future__ import annotations

import pytest

from scenewright.orchestrate import orchestrate
from scenewright.request import Request
from scenewright.study import timing
from scenewright.study.timing import EGOS, SCENARIOS, Timing, time_resolves


@pytest.mark.parametrize("text", SCENARIOS)
def test_scenarios_can_be_orchestrated(text: str) -> None:
    assert orchestrate(Request(text, ego="constant", replan_hz=2.0)).status == "success"


def test_percentiles() -> None:
    measured = Timing(tuple(float(k) for k in range(1, 101)), 0.0, 1, 100)
    assert measured.percentile_ms(0) == 1.0
    assert measured.percentile_ms(50) == 51.0
    assert measured.percentile_ms(99) == 100.0
    assert measured.percentile_ms(100) == 100.0
    assert Timing((), 0.0, 0, 0).percentile_ms(50) == 0.0


def test_every_tick_but_the_first_plan_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = []

    def watched(request: Request) -> object:
        result = orchestrate(request)
        seen.append(result)
        return result

    monkeypatch.setattr(timing, "SCENARIOS", SCENARIOS[2:])
    monkeypatch.setattr(timing, "EGOS", EGOS[2:3])
    monkeypatch.setattr(timing, "orchestrate", watched)
    measured = time_resolves([0, 1])
    records = [record for result in seen for record in result.run.replans[1:]]
    asked = [record for record in records if record.backend]
    assert (measured.runs, measured.ticks) == (2, len(records))
    assert measured.tick_ms == tuple(sorted(1000.0 * record.wall_s for record in asked))
    assert measured.busy_s_in_20_s > 0.0
    assert [record.time_s for record in seen[0].run.replans[:3]] == pytest.approx([0.0, 0.1, 0.2])
