"""A run directory is judged from program, trace and map facts; what is missing is named; its knots are not believed."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from plays import BRAKES, LANDMARKS, YIELDS, Play

from scenewright.errors import InputError, OutputError, ProgramError
from scenewright.judge.files import judge_run_directory, read_case, write_verdict
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import TIGHT
from scenewright.trace.files import write_trace


def manifest(play: Play) -> dict[str, Any]:
    return {
        "schema_version": 1,
        "status": "finished",
        "landmarks": {**LANDMARKS, "ego": {**LANDMARKS["ego"], "turn_end": None}},
        "routes": {"ego": {"headings": ["E"], "lanes": []}, "hero": {"headings": [], "lanes": []}},
        "vehicles": {"ego": {"length_m": 4.5, "width_m": 1.9}, "hero": {"length_m": 4.5, "width_m": 1.9}},
        "limits": {"hero": {"speed_max_mps": 20.0, "accel_min_mpss": -8.0, "accel_max_mpss": None}},
        "shared_offsets": [{"a": "hero", "b": "ego", "offset_m": play.offset_m}],
        "knots": {"hero": {"t0": 0.0, "t1": 1.23, "t2": 99.0}, "ego": {"t1": "nonsense"}},
    }


def write_run(directory: Path, play: Play) -> Path:
    directory.mkdir(exist_ok=True)
    (directory / "manifest.json").write_text(json.dumps(manifest(play)), encoding="utf-8")
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
    assert {c.id: c.measured for c in direct.conditions}.items() <= {
        c.id: c.measured for c in verdict.conditions
    }.items()
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
    ],
)
def test_faulty_manifest_is_refused(tmp_path: Path, changes: dict[str, Any], named: str) -> None:
    with pytest.raises(InputError) as caught:
        judge_run_directory(edited(write_run(tmp_path / "run", BRAKES), **changes))
    assert named in str(caught.value)


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
