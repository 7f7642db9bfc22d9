"""What the page is told: rounded, thinned, without NaN, and honest about what is missing."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scenewright.errors import InputError
from scenewright.studio.page_data import MAX_SAMPLES, collect
from scenewright.trace.files import read_trace, write_trace
from scenewright.trace.model import ActorTrace, Trace

Edit = Callable[[Path, Callable[[Any], None]], None]


def actor_named(data: dict[str, Any], name: str) -> dict[str, Any]:
    return next(actor for actor in data["actors"] if actor["name"] == name)


def test_samples_are_those_of_the_trace(run_dir: Path) -> None:
    data, trace = collect(run_dir), read_trace(run_dir / "trace.parquet")
    np.testing.assert_allclose(data["time"], trace.time_s, atol=1e-4)
    for name, states in trace.actors.items():
        actor = actor_named(data, name)
        for key, values in (("x", states.x_m), ("y", states.y_m), ("s", states.s_m), ("v", states.speed_mps)):
            np.testing.assert_allclose(actor[key], values, atol=6e-4)


def test_long_traces_are_thinned_but_keep_their_ends(run_dir: Path) -> None:
    trace = read_trace(run_dir / "trace.parquet")
    count = 3 * MAX_SAMPLES
    columns = {field.name: np.linspace(0.0, 60.0, count) for field in dataclasses.fields(ActorTrace)}
    write_trace(Trace({name: ActorTrace(**columns) for name in trace.actors}), run_dir / "trace.parquet")
    data = collect(run_dir)
    assert len(data["time"]) <= MAX_SAMPLES
    assert (data["time"][0], data["time"][-1]) == (0, 60)
    assert all(len(actor["x"]) == len(data["time"]) for actor in data["actors"])


def test_clauses_join_to_the_description_and_name_their_conditions(run_dir: Path) -> None:
    data = collect(run_dir)
    manifest = json.loads((run_dir / "manifest.json").read_text(encoding="utf-8"))
    assert "".join(clause["text"] for clause in data["description"]) == manifest["description"]
    by_text = {clause["text"]: clause["ids"] for clause in data["description"]}
    assert by_text["it is 40 m behind the stop line"] == ["c1"]
    # The words of one side of the trigger lie within those of the whole trigger.
    assert by_text["the ego is 12 m behind the stop line"] == ["c2", "c3"]


def test_the_trigger_carries_the_distances_that_define_it(run_dir: Path) -> None:
    (trigger,) = collect(run_dir)["triggers"]
    manifest = json.loads((run_dir / "manifest.json").read_text(encoding="utf-8"))
    assert trigger["time_s"] == 4
    assert trigger["hero"] == "hero"
    assert {(m["kind"], m["actor"], m["name"], m["s_m"]) for m in trigger["measures"]} == {
        ("landmark", "ego", "stop_line", manifest["landmarks"]["ego"]["stop_line"]),
        ("landmark", "hero", "conflict_point", manifest["landmarks"]["hero"]["conflict_point"]),
    }


def test_a_trigger_that_never_came_is_no_moment_to_jump_to(run_dir: Path, edit: Edit) -> None:
    edit(run_dir / "verdict.json", lambda v: v["facts"].update(trigger_came={"hero": False}))
    assert collect(run_dir)["triggers"] == []


def test_times_measured_by_the_judge_come_before_recorded_ones(run_dir: Path, edit: Edit) -> None:
    edit(run_dir / "verdict.json", lambda v: v["facts"]["knot_times_s"].update(hero={"t1": 4.07}, ego={"t1": 4.07}))
    data = collect(run_dir)
    assert data["triggers"][0]["time_s"] == pytest.approx(4.07)
    assert {name: time for name, time, _ in actor_named(data, "hero")["knots"]}["t1"] == pytest.approx(4.07)
    assert {name: time for name, time, _ in actor_named(data, "hero")["knots"]}["t2"] == pytest.approx(7.75)


def test_moments_are_told_by_what_happens_at_them(run_dir: Path) -> None:
    told = {name: words for name, _, words in actor_named(collect(run_dir), "hero")["knots"]}
    assert told == {"t0": "start", "t1": "the hero begins to brake", "t2": "the hero finishes braking"}


def test_where_a_trigger_never_came_nothing_begins_and_at_the_end_nothing_is_over(run_dir: Path, edit: Edit) -> None:
    def nearest(verdict: Any) -> None:
        times = {"t0": 0.0, "t1": 4.0, "t2": collect(run_dir)["time"][-1]}
        verdict["facts"].update(trigger_came={"hero": False}, knot_times_s={"hero": times, "ego": times})

    edit(run_dir / "verdict.json", nearest)
    data = collect(run_dir)
    assert {name: words for name, _, words in actor_named(data, "hero")["knots"]} == {"t0": "start", "t1": "", "t2": ""}
    assert {name: words for name, _, words in actor_named(data, "ego")["knots"]}["t1"] == ""


def test_what_was_understood_is_that_of_the_manifest_or_what_the_program_says(run_dir: Path, edit: Edit) -> None:
    said = [line["sentence"] for line in collect(run_dir)["understood"]]
    assert said[:2] == ["The ego is headed south and turns right.", "The hero is headed west and goes straight on."]
    kept = [{"sentence": "The ego drives.", "words": "ego"}]
    edit(run_dir / "manifest.json", lambda manifest: manifest.update(understood=kept))
    assert collect(run_dir)["understood"] == kept


def test_conditions_know_their_moment_and_their_words_once(run_dir: Path) -> None:
    conditions = {condition["id"]: condition for condition in collect(run_dir)["conditions"]}
    assert conditions["c1"]["text"] == "the ego is 40 m before the stop line at the start"
    assert conditions["c1"]["words"] == "it is 40 m behind the stop line"
    assert (conditions["c1"]["time"], conditions["c3"]["time"], conditions["c5"]["time"]) == (0, 4, 7.75)
    assert conditions["c8"]["time"] > 7.75, "an order is decided when the later of the two happens"
    assert conditions["hero_onset"]["time"] == 4
    assert conditions["no_collision"]["time"] is None


def test_landmarks_lie_on_the_road_where_the_route_says(run_dir: Path) -> None:
    data = collect(run_dir)
    for name in ("ego", "hero"):
        actor = actor_named(data, name)
        mark = next(each for each in actor["landmarks"] if each["name"] == "conflict_point")
        assert (mark["x"], mark["y"]) == pytest.approx((-14.0, 1.75), abs=0.6)
        near = min(actor["route"], key=lambda p: math.hypot(p[0] - mark["x"], p[1] - mark["y"]))
        assert abs(near[2] - mark["s"]) < 60.0
    assert {lane["kind"] for lane in data["map"]["lanes"]} == {"road", "driveway"}
    assert len(data["map"]["stop_lines"]) == 1


def test_route_points_carry_the_arc_length_of_the_trace(run_dir: Path) -> None:
    data, trace = collect(run_dir), read_trace(run_dir / "trace.parquet")
    for name, states in trace.actors.items():
        route = np.array(actor_named(data, name)["route"])
        x, y = (np.interp(states.s_m, route[:, 2], route[:, axis]) for axis in (0, 1))
        assert np.hypot(x - states.x_m, y - states.y_m).max() < 0.1


def test_the_first_plan_carries_how_its_accelerations_change(run_dir: Path) -> None:
    """Without it the page could draw no plan but one of even accelerations."""
    pieces = actor_named(collect(run_dir), "hero")["plan"]
    assert [piece[:2] for piece in pieces] == [[0.0, 3.6], [3.6, 4.0]]
    assert [piece[3:] for piece in pieces] == [[13.0, 0.0, 0.0], [13.0, -2.25, -0.5]]


def test_what_came_of_it_is_in_the_words_of_the_judge(run_dir: Path, edit: Edit) -> None:
    came = collect(run_dir)["aftermath"]
    assert came == {"text": "no collision; closest 5.4 m, the ego did not brake", "collision_s": None}
    hit = {"text": "the ego hit hero at 7.3 s", "collision": {"time_s": 7.3125, "actors": ["ego", "hero"]}}
    edit(run_dir / "verdict.json", lambda v: v.update(aftermath=hit))
    assert collect(run_dir)["aftermath"] == {"text": "the ego hit hero at 7.3 s", "collision_s": 7.3125}
    edit(run_dir / "verdict.json", lambda v: v.pop("aftermath"))
    assert collect(run_dir)["aftermath"] is None, "a verdict of an earlier version does not tell"


def test_facts_are_sentences_with_their_moments(run_dir: Path) -> None:
    told = dict(collect(run_dir)["facts"])
    assert told["The trigger of the hero came at 4.00 s."] == 4.0
    assert "The ego and the hero came within 5.4 m of each other, body to body, and never touched." in told


def test_replans_are_summed_up(run_dir: Path) -> None:
    replans = collect(run_dir)["replans"]
    assert (replans["summary"]["count"], replans["summary"]["solved"]) == (100, 36)
    assert len(replans["rows"]) == 100
    assert sum(replans["summary"]["statuses"].values()) == 100
    walls = [row["wall_ms"] for row in replans["rows"] if row["status"] == "sat"]
    assert replans["summary"]["p50_ms"] == pytest.approx(np.percentile(walls, 50), abs=0.01)
    assert replans["summary"]["max_ms"] == pytest.approx(50.0)


@pytest.mark.parametrize("name", ["program.scene", "params.json", "plan.json", "replans.parquet", "verdict.json"])
def test_a_missing_file_is_named_and_no_more(run_dir: Path, name: str) -> None:
    (run_dir / name).unlink()
    data = collect(run_dir)
    assert len(data["missing"]) == 1
    assert name in data["missing"][0]
    assert data["actors"]


@pytest.mark.parametrize("name", ["program.scene", "params.json", "plan.json", "replans.parquet", "verdict.json"])
def test_a_broken_file_is_named_and_no_more(run_dir: Path, name: str) -> None:
    (run_dir / name).write_text("}{", encoding="utf-8")
    (sentence,) = collect(run_dir)["missing"]
    assert name in sentence
    assert "cannot be read" in sentence


def test_a_fault_that_broke_the_run_off_is_told(run_dir: Path, edit: Edit) -> None:
    edit(run_dir / "manifest.json", lambda m: m.update(status="failed", fault="the policy raised ValueError"))
    assert collect(run_dir)["missing"] == ["the run broke off: the policy raised ValueError"]


@pytest.mark.parametrize("name", ["manifest.json", "trace.parquet"])
def test_without_manifest_or_trace_there_is_no_page(run_dir: Path, name: str) -> None:
    (run_dir / name).unlink()
    with pytest.raises(InputError):
        collect(run_dir)


def test_an_unknown_map_leaves_the_rest(run_dir: Path, edit: Edit) -> None:
    edit(run_dir / "manifest.json", lambda m: m.update(map={"name": "elsewhere", "file": "elsewhere.xodr"}))
    data = collect(run_dir)
    assert data["map"] is None
    assert "the map could not be read" in data["missing"][0]
    assert len(data["actors"]) == 2


@pytest.mark.parametrize(
    ("status", "success", "level"),
    [
        ("finished", {"tight": True, "loose": True}, "tight"),
        ("finished", {"tight": False, "loose": True}, "loose"),
        ("finished", {"tight": False, "loose": False}, "failed"),
        ("interrupted", {"tight": False, "loose": False}, "interrupted"),
        ("failed", {"tight": False, "loose": False}, "failed"),
        ("finished", None, "unjudged"),
        ("interrupted", None, "interrupted"),
    ],
)
def test_the_outcome_in_one_word(
    run_dir: Path, edit: Edit, status: str, success: dict[str, bool] | None, level: str
) -> None:
    edit(run_dir / "manifest.json", lambda m: m.update(status=status))
    if success is None:
        (run_dir / "verdict.json").unlink()
    else:
        edit(run_dir / "verdict.json", lambda v: v.update(success=success))
    assert collect(run_dir)["outcome"]["level"] == level


def test_what_is_not_a_number_becomes_null(run_dir: Path, edit: Edit) -> None:
    trace = read_trace(run_dir / "trace.parquet")
    broken = {}
    for name, states in trace.actors.items():
        accel, x = states.accel_mps2.copy(), states.x_m.copy()
        accel[10], x[20] = np.nan, np.inf
        broken[name] = dataclasses.replace(states, accel_mps2=accel, x_m=x)
    write_trace(Trace(broken), run_dir / "trace.parquet")
    edit(run_dir / "verdict.json", lambda v: v["conditions"][0].update(measured=math.nan, error=math.inf))
    data = collect(run_dir)
    json.dumps(data, allow_nan=False)
    hero = actor_named(data, "hero")
    assert hero["a"][10] is None
    assert hero["x"][20] is None
    assert hero["route"], "the other samples still say where the route begins"
    assert data["conditions"][0]["measured"] is None


def test_an_actor_that_is_nowhere_leaves_the_others(run_dir: Path) -> None:
    trace = read_trace(run_dir / "trace.parquet")
    nowhere = dataclasses.replace(trace.actors["hero"], x_m=np.full(len(trace.time_s), np.nan))
    write_trace(Trace({"ego": trace.actors["ego"], "hero": nowhere}), run_dir / "trace.parquet")
    data = collect(run_dir)
    assert actor_named(data, "hero")["route"] == []
    assert actor_named(data, "ego")["route"]


def test_coordinates_far_from_zero_are_moved_near_it(run_dir: Path) -> None:
    trace = read_trace(run_dir / "trace.parquet")
    moved = {name: dataclasses.replace(a, x_m=a.x_m + 4e5, y_m=a.y_m + 5e6) for name, a in trace.actors.items()}
    write_trace(Trace(moved), run_dir / "trace.parquet")
    data = collect(run_dir)
    assert abs(np.array(actor_named(data, "ego")["x"])).max() < 1000
    np.testing.assert_allclose(np.array(actor_named(data, "ego")["y"]) + data["origin"][1], moved["ego"].y_m, atol=1e-3)


def test_a_run_of_a_text_without_a_title_is_called_as_its_folder(run_dir: Path, edit: Edit) -> None:
    assert collect(run_dir)["name"] == "right turn, hero yields"
    edit(run_dir / "manifest.json", lambda manifest: manifest.update(name="description"))
    assert collect(run_dir)["name"] == run_dir.name


def test_a_take_that_knew_the_ego_is_told_and_a_first_one_is_not(run_dir: Path, edit: Edit) -> None:
    assert "Take" not in dict(collect(run_dir)["about"])
    edit(run_dir / "manifest.json", lambda manifest: manifest.update(take=2))
    assert dict(collect(run_dir)["about"])["Take"].startswith("2, which knew")
