"""A run directory is judged from program, trace and map facts; what is missing is named; its knots are not believed."""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from plays import BRAKES, LANDMARKS, YIELDS, Play, failed

from scenewright.errors import InputError, OutputError, ProgramError
from scenewright.judge.files import judge_run_directory, read_case, write_verdict
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.trace.files import read_trace, write_trace


def road(number: int, x_m: float, y_m: float, heading_rad: float) -> str:
    """Return a straight road of one lane, whose middle begins at a place."""
    edge = f'x="{x_m - 1.75 * np.sin(heading_rad)!s}" y="{y_m + 1.75 * np.cos(heading_rad)!s}" hdg="{heading_rad!s}"'
    return (
        f'<road id="{number}" length="300" junction="-1"><link/><planView><geometry s="0" {edge} length="300"><line/>'
        '</geometry></planView><lanes><laneSection s="0"><center>'
        '<lane id="0" type="none" level="false"/></center><right><lane id="-1" type="driving" level="false">'
        '<width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></right></laneSection></lanes></road>'
    )


def map_of(play: Play) -> str:
    roads = road(1, *play.ego_line) + (road(2, *play.hero_line) if play.hero_line != play.ego_line else "")
    return f'<OpenDRIVE><header revMajor="1" revMinor="6"/>{roads}</OpenDRIVE>'


def manifest(play: Play, road_map: Path) -> dict[str, Any]:
    file = {"file": str(road_map), "sha256": hashlib.sha256(road_map.read_bytes()).hexdigest()}
    return {
        "schema_version": 1,
        "map": {"name": road_map.stem, **file},
        "status": "finished",
        "landmarks": {**LANDMARKS, "ego": {**LANDMARKS["ego"], "turn_end": None}},
        "routes": {
            "ego": {"headings": ["E"], "lanes": ["1.0.-1"]},
            "hero": {"headings": [], "lanes": ["1.0.-1" if play.hero_line == play.ego_line else "2.0.-1"]},
        },
        "vehicles": {"ego": {"length_m": 4.5, "width_m": 1.9}, "hero": {"length_m": 4.5, "width_m": 1.9}},
        "limits": {"hero": {"speed_max_mps": 20.0, "accel_min_mpss": -8.0, "accel_max_mpss": None}},
        "shared_offsets": [{"a": "hero", "b": "ego", "offset_m": play.offset_m}],
        "knots": {"hero": {"t0": 0.0, "t1": 1.23, "t2": 99.0}, "ego": {"t1": "nonsense"}},
    }


def write_run(directory: Path, play: Play) -> Path:
    directory.mkdir(exist_ok=True)
    (road_map := directory / "roads.xodr").write_text(map_of(play), encoding="utf-8")
    (directory / "manifest.json").write_text(json.dumps(manifest(play, road_map)), encoding="utf-8")
    (directory / "program.scene").write_text(play.text, encoding="utf-8")
    units = {"gap_m": "m", "rate_mpss": "m/s^2"}
    values = {n: {"value": v, "unit": units[n], "source": "given"} for n, v in play.parameters.items()}
    (directory / "params.json").write_text(json.dumps(values), encoding="utf-8")
    write_trace(play.case().trace, directory / "trace.parquet")
    return directory


@pytest.mark.parametrize("play", [BRAKES, YIELDS])
def test_run_directory_gives_the_verdict_of_its_case(tmp_path: Path, play: Play) -> None:
    verdict = judge_run_directory(write_run(tmp_path / "run", play))
    assert verdict.holds_at(TIGHT)
    direct = judge(play.case())
    assert [c.id for c in verdict.conditions] == [c.id for c in direct.conditions]
    for condition in direct.conditions:
        assert verdict.condition(condition.id).measured == pytest.approx(condition.measured, abs=1e-9)
    assert verdict.facts["trigger_time_s"]["hero"] == pytest.approx(play.trigger_s, abs=1e-3)


def test_verdict_file_has_the_form_of_the_contract(tmp_path: Path) -> None:
    verdict = judge_run_directory(write_run(tmp_path / "run", BRAKES))
    write_verdict(verdict, tmp_path / "verdict.json")
    data = json.loads((tmp_path / "verdict.json").read_text(encoding="utf-8"))
    assert data["schema_version"] == 1
    assert data["success"] == {"tight": True, "loose": True}
    kinds = {"initial", "route", "trigger", "interaction", "outcome", "safety"}
    for condition in data["conditions"]:
        assert set(condition) == {"id", "kind", "text", "required", "measured", "error", "unit", "tight", "loose"}
        assert condition["kind"] in kinds
    assert len({condition["id"] for condition in data["conditions"]}) == len(data["conditions"])
    again = tmp_path / "again.json"
    write_verdict(judge_run_directory(tmp_path / "run"), again)
    assert again.read_bytes() == (tmp_path / "verdict.json").read_bytes()


def test_units_of_parameters_are_converted(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    values = {"gap_m": {"value": 2000.0, "unit": "cm"}, "rate_mpss": {"value": 4.0, "unit": "m/s^2"}}
    (run / "params.json").write_text(json.dumps(values), encoding="utf-8")
    assert read_case(run).parameters == {"gap_m": pytest.approx(20.0), "rate_mpss": 4.0}


@pytest.mark.parametrize("name", ["manifest.json", "program.scene", "params.json", "trace.parquet"])
def test_missing_file_is_named(tmp_path: Path, name: str) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    (run / name).unlink()
    with pytest.raises(InputError) as caught:
        judge_run_directory(run)
    assert name.split(".", maxsplit=1)[0] in str(caught.value)


def test_paths_may_be_texts(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    assert judge_run_directory(str(run)).as_dict() == judge_run_directory(run).as_dict()
    assert list(read_trace(str(run / "trace.parquet")).actors) == list(read_trace(run / "trace.parquet").actors)


def test_missing_directory(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no run directory"):
        judge_run_directory(tmp_path / "nowhere")


def edited(run: Path, **changes: Any) -> Path:
    data = json.loads((run / "manifest.json").read_text(encoding="utf-8"))
    data.update(changes)
    data = {key: value for key, value in data.items() if value != "absent"}
    (run / "manifest.json").write_text(json.dumps(data), encoding="utf-8")
    return run


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"landmarks": "absent"}, "landmarks"),
        ({"landmarks": {"ego": {"stop_line": "far"}}}, "landmarks.ego.stop_line"),
        ({"vehicles": {"ego": {"length_m": -1.0, "width_m": 2.0}}}, "vehicles.ego.length_m"),
        ({"schema_version": 2}, "schema version"),
        ({"map": {"name": "roads", "file": "roads.xodr"}}, "map.sha256"),
    ],
)
def test_faulty_manifest_is_refused(tmp_path: Path, changes: dict[str, Any], named: str) -> None:
    with pytest.raises(InputError) as caught:
        judge_run_directory(edited(write_run(tmp_path / "run", BRAKES), **changes))
    assert named in str(caught.value)


UNMAPPED = {"route_ego_map", "route_hero_map", "route_hero_directions"}


def test_a_map_that_is_not_to_be_had_is_told_and_nothing_is_skipped(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", YIELDS)
    whole = [each.id for each in judge_run_directory(run).conditions]
    (run / "roads.xodr").rename(tmp_path / "moved.xodr")
    verdict = judge_run_directory(run)
    assert [each.id for each in verdict.conditions] == whole
    assert failed(verdict, LOOSE) == UNMAPPED
    assert verdict.condition("route_hero_map").text.endswith("(not judged: the map cannot be read)")
    named = json.loads((run / "manifest.json").read_text(encoding="utf-8"))["map"]
    edited(run, map={**named, "name": str(tmp_path / "moved.xodr")})
    assert judge_run_directory(run).holds_at(TIGHT)


def test_another_map_is_not_the_one_that_was_driven_on(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", YIELDS)
    (run / "roads.xodr").write_text(map_of(replace(YIELDS, hero_line=(75.0, 100.0, -np.pi / 2))), encoding="utf-8")
    verdict = judge_run_directory(run)
    assert failed(verdict, LOOSE) == UNMAPPED
    assert "another one" in verdict.condition("route_ego_map").text


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"map": "absent"}, "names no map"),
        ({"routes": {}}, "names no route"),
        ({"routes": {name: {"headings": ["E"], "lanes": ["9.0.-1"]} for name in ("ego", "hero")}}, "has no such route"),
    ],
)
def test_a_manifest_without_map_or_routes_leaves_nothing_out(tmp_path: Path, changes: dict[str, Any], why: str) -> None:
    verdict = judge_run_directory(edited(write_run(tmp_path / "run", BRAKES), **changes))
    assert {"route_ego_map", "route_hero_map"} <= failed(verdict, LOOSE)
    assert why in verdict.condition("route_hero_map").text


def test_another_route_than_the_program_asks_for_is_not_the_one_that_was_driven(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    text = (run / "program.scene").read_text(encoding="utf-8")
    head, hero = text.split("Actor 1")
    (run / "program.scene").write_text(f"{head}Actor 1{re.sub('- [A-Z, ]+', '- N', hero, count=1)}", encoding="utf-8")
    verdict = judge_run_directory(run)
    assert failed(verdict, LOOSE) == {"route_hero_map", "route_hero_directions"}
    assert "has no such route" in verdict.condition("route_hero_map").text


@pytest.mark.parametrize("content", ["", "{", "[]", '{"gap_m": {"value": "x", "unit": "m"}}'])
def test_faulty_parameters_are_refused(tmp_path: Path, content: str) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    (run / "params.json").write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=r"params\.json"):
        judge_run_directory(run)


def test_parameter_without_a_value_or_with_a_strange_unit(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    (run / "params.json").write_text('{"gap_m": {"value": 20, "unit": "m"}}', encoding="utf-8")
    with pytest.raises(InputError, match="rate_mpss"):
        judge_run_directory(run)
    (run / "params.json").write_text('{"gap_m": {"value": 20, "unit": "parsec"}}', encoding="utf-8")
    with pytest.raises(InputError, match="parsec"):
        judge_run_directory(run)


def test_program_that_does_not_parse_and_actor_without_a_trace(tmp_path: Path) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    (run / "program.scene").write_text("nonsense", encoding="utf-8")
    with pytest.raises(ProgramError):
        judge_run_directory(run)
    (run / "program.scene").write_text(BRAKES.text.replace("(hero)", "(somebody)"), encoding="utf-8")
    with pytest.raises(InputError, match="somebody"):
        judge_run_directory(run)


def test_unwritable_verdict(tmp_path: Path) -> None:
    with pytest.raises(OutputError):
        write_verdict(judge(BRAKES.case()), tmp_path / "nowhere" / "verdict.json")


@pytest.mark.parametrize("line", ["A1x(t1) <= 500 s", "A1x(t0) >= A1v(t0)", "A1v(t9) <= 3"])
def test_a_program_that_makes_no_sense_is_not_judged(tmp_path: Path, line: str) -> None:
    run = write_run(tmp_path / "run", BRAKES)
    (run / "program.scene").write_text(f"{BRAKES.text}{line}\n", encoding="utf-8")
    with pytest.raises(ProgramError, match=r"two different things|no knot"):
        judge_run_directory(run)


def test_one_temporal_operator_inside_another_is_told_as_not_judged(tmp_path: Path) -> None:
    """Nothing is planned for it; of a run that was driven all else is told."""
    run = write_run(tmp_path / "run", BRAKES)
    nested = "nested: always[A1(t0), A1(t1)] (always[A1(t0), A1(t1)] (A1v <= 100))"
    (run / "program.scene").write_text(f"{BRAKES.text}{nested}\n", encoding="utf-8")
    verdict = judge_run_directory(run)
    assert "not judged: one temporal operator inside another" in verdict.condition("nested").text
    assert failed(verdict, TIGHT) == {"nested"}
