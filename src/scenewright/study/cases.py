"""One case of the experiment: a row of the benchmark, an ego, a draw and a method, run, judged and recorded.

What enters: a `BenchCase`. What leaves: its `CaseRecord` and, where wanted, the files of its run. A success needs the
judge's word and that of the row's own criteria. Nothing is scheduled here, and no record is stored.
"""

from __future__ import annotations

import json
import re
import shlex
import shutil
import time
import zlib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from scenewright.errors import InputError, ScenewrightError
from scenewright.request import Request, Result, Take
from scenewright.study.causes import INFEASIBLE, NO_ROOM, cause_across, cause_of_take
from scenewright.study.store import PROGRAMS, RUNS, CaseRecord

if TYPE_CHECKING:
    from scenewright.judge.verdict import Condition, Verdict
    from scenewright.study.benchmark import BenchmarkRow, Criterion

OURS = "scenewright"
# Takes go on up to this tolerance, so that what is said of the best of all takes is so at every one.
_AIM: Final = "fine"


@dataclass(frozen=True, slots=True)
class BenchCase:
    """What to run.

    Attributes
    ----------
    seed
        Of the ego's random choices, and of a method's.
    parameters
        In each parameter's own unit.
    folder
        The result folder, for the command that runs the case again and for the files of its run.
    keep
        Whether the files of its run are kept.
    """

    row: int
    ego: str
    draw: int
    method: str
    seed: int
    parameters: tuple[tuple[str, float], ...]
    takes: int
    folder: Path
    keep: bool = False

    @property
    def key(self) -> str:
        """The case's name: row, ego, draw, method; also the name of its folder."""
        return f"{self.row:02d}-{_as_file_name(self.ego)}-{self.draw}-{_as_file_name(self.method)}"

    @property
    def command(self) -> str:
        """What to type to run it again: as a user would run our method, else by its key."""
        if self.method != OURS:
            return shlex.join(["scenewright", "bench", "replay", str(self.folder), self.key])
        words = ["scenewright", "run", str(self.folder / program_file(self.row))]
        for name, value in self.parameters:
            words += ["-p", f"{name}={value}"]
        words += ["--ego", self.ego, "--seed", str(self.seed), "--takes", str(self.takes), "--aim", _AIM]
        return shlex.join(words)

    def request(self, row: BenchmarkRow) -> Request:
        """Return the same request for every method."""
        return Request(
            row.program_text,
            dict(self.parameters),
            ego=self.ego,
            seed=self.seed,
            takes=self.takes,
            aim=_AIM,
        )


def program_file(row: int) -> str:
    """Return where the gold program of a row lies in a result folder."""
    return f"{PROGRAMS}/row_{row:02d}.scene"


def seed_of(row: int, draw: int, seed: int) -> int:
    """Return the seed of a case: another one for every row and draw, the same for every ego and method."""
    return seed + 1000 * draw + row


def case_of_record(record: CaseRecord, takes: int, folder: Path) -> BenchCase:
    """Return the case that a record tells of."""
    parameters = tuple(json.loads(record.parameters).items())
    return BenchCase(record.row, record.ego, record.draw, record.method, record.seed, parameters, takes, folder)


def _as_file_name(name: str) -> str:
    """Return a name that any file system takes; where it had to be changed, a sum of it keeps it apart from others."""
    plain = re.sub(r"[^A-Za-z0-9_.=-]+", "_", name)
    return plain if plain == name else f"{plain[:60]}_{zlib.crc32(name.encode()):08x}"


# -- running --------------------------------------------------------------------------------------------------------
def run_bench_case(case: BenchCase) -> CaseRecord:
    """Run one case and return what came of it; whatever a user's policy does ends as a record too."""
    from scenewright.study.benchmark import benchmark_row

    row = benchmark_row(case.row)
    try:
        record, _, _ = carry_out_case(case, row)
    except ScenewrightError as error:
        return blank_record(case, row, message=error.message + (f" ({error.found})" if error.found else ""))
    return record


def carry_out_case(case: BenchCase, row: BenchmarkRow) -> tuple[CaseRecord, Request, Result]:
    """Run one case; raises `ScenewrightError` where the request is wrong."""
    from scenewright.study.rivals import request_of, run_method

    request = request_of(case.method, case.request(row))
    started = time.perf_counter()
    result = run_method(case.method, request)
    record = replace(record_of(case, row, result), wall_s=time.perf_counter() - started)
    if case.keep and result.run is not None and result.verdict is not None:
        directory = f"{RUNS}/{case.key}"
        keep_run(case.folder / directory, request, result)
        record = replace(record, directory=directory)
    return record, request, result


def blank_record(case: BenchCase, row: BenchmarkRow, message: str = "") -> CaseRecord:
    """Return the record of a case of which nothing is known but how it failed."""
    return CaseRecord(
        case.key,
        case.row,
        case.ego,
        case.draw,
        case.seed,
        case.method,
        row.interaction,
        row.trigger,
        row.ego_state,
        row.ego_intent,
        row.hero_state,
        row.hero_intent,
        json.dumps(dict(case.parameters)),
        case.command,
        message=message,
    )


def record_of(case: BenchCase, row: BenchmarkRow, result: Result) -> CaseRecord:
    """Return the record of a result."""
    record = replace(blank_record(case, row), status=result.status, take=result.take, takes=len(result.takes))
    run = result.run
    if run is not None:
        record = replace(
            record,
            simulated_s=run.trace.duration_s,
            solve_ms=[1000.0 * tick.wall_s for tick in run.replans if tick.backend and tick.time_s > 0.0],
        )
        if run.fault is not None:
            return replace(record, message=run.fault.message)
    if result.status == "infeasible":
        cause, proof = INFEASIBLE, _clashes(result.feasibility)
        return replace(record, cause=cause, first_cause=cause, proof=proof)
    if not result.takes or result.verdict is None:
        tried = "; ".join(map(str, result.not_held))
        return replace(record, cause="gave up", first_cause="gave up", message=tried)
    return _with_takes(record, row, result)


def _with_takes(record: CaseRecord, row: BenchmarkRow, result: Result) -> CaseRecord:
    from scenewright.explain.approach import Approach, approach_of
    from scenewright.judge.tolerance import LEVELS

    takes = [judge_take(row, result, take) for take in result.takes]
    number = min(result.take, len(takes)) - 1
    kept, held = takes[number], [take.levels for take in takes]
    conditions, criteria = kept.failed
    cause = cause_across([take.cause for take in takes])
    hindsight = result.takes[number].hindsight if cause == NO_ROOM else None
    trace = result.takes[number].trace
    approach = Approach() if trace is None else approach_of(result.scene, trace, kept.verdict.facts)
    levels: dict[str, Any] = {f"first_{level}": level in held[0] for level in LEVELS}
    levels |= {f"best_{level}": any(level in each for each in held) for level in LEVELS}
    return replace(
        record,
        cause=cause,
        first_cause=takes[0].cause,
        **levels,
        kept=list(held[number]),
        criteria_disagree=any(take.disagrees for take in takes),
        failed_conditions=[each.id for each in conditions] + [f"criterion {each.id}" for each in criteria],
        proof=_clashes(hindsight),
        reverses=approach.reverses,
        stands=approach.stands,
        jerks_mpsss=approach.jerks_mpsss,
        accels_mpss=approach.accels_mpss,
        pace=approach.pace,
    )


def _clashes(proof: Any) -> str | None:
    return None if proof is None else "\n".join(str(clash) for clash in proof.clashes)


# -- judging --------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Judged:
    """What judge and criteria say of one drive."""

    verdict: Verdict
    criteria: tuple[Criterion, ...]
    no_room: bool = False

    @property
    def levels(self) -> tuple[str, ...]:
        """Where both hold, finest first."""
        from scenewright.judge.tolerance import LEVELS
        from scenewright.study.benchmark import criteria_hold

        return tuple(
            level
            for level, tolerance in LEVELS.items()
            if self.verdict.holds_at(tolerance) and criteria_hold(self.criteria, tolerance)
        )

    @property
    def disagrees(self) -> bool:
        """Whether judge and criteria differ at the tight tolerance."""
        from scenewright.judge.tolerance import TIGHT
        from scenewright.study.benchmark import criteria_hold

        return self.verdict.holds_at(TIGHT) != criteria_hold(self.criteria, TIGHT)

    @property
    def failed(self) -> tuple[list[Condition], list[Criterion]]:
        """What does not hold at the tight tolerance."""
        from scenewright.judge.tolerance import TIGHT

        conditions = [condition for condition in self.verdict.conditions if not condition.holds_at(TIGHT)]
        return conditions, [criterion for criterion in self.criteria if not criterion.holds_at(TIGHT)]

    @property
    def cause(self) -> str:
        """Under which cause the drive is counted."""
        levels = self.levels
        return cause_of_take(
            tight="tight" in levels,
            loose="loose" in levels,
            never_met=bool(self.verdict.facts.get("ego_never_met_condition")),
            no_room=self.no_room,
        )


def judge_take(row: BenchmarkRow, result: Result, take: Take) -> Judged:
    """Hold the row's criteria against a take, beside the verdict that it has."""
    from scenewright.study.benchmark import criteria_of

    if take.trace is None:
        raise InputError("a take cannot be held against the row's criteria: it has no trace")
    parameters_si = {name: float(value) for name, value in result.scene.parameters.items()}
    criteria = criteria_of(row, parameters_si, take.trace, result.scene.road_map)
    return Judged(take.verdict, criteria, take.hindsight is not None)


def judge_kept(row: int, directory: Path) -> Judged:
    """Judge a run again, from its files alone; raises `ScenewrightError` where they cannot be read."""
    from scenewright.judge.files import read_case
    from scenewright.judge.judgement import judge
    from scenewright.roads.load import load_map
    from scenewright.study.benchmark import benchmark_row, criteria_of

    case, asked = read_case(directory), benchmark_row(row)
    road_map = load_map(asked.program.map_name)
    return Judged(judge(case), criteria_of(asked, case.parameters, case.trace, road_map))


# -- keeping --------------------------------------------------------------------------------------------------------
def keep_run(directory: Path, request: Request, result: Result, page: bool = False) -> None:
    """Write the files of a run, in one step; an earlier folder of this name, finished or not, is replaced.

    The manifest names a shipped map by its name alone, so that results say nothing of the machine they came from.
    """
    from scenewright.orchestrate import write_result
    from scenewright.simulate.loop import Rates
    from scenewright.simulate.world import World

    part = directory.with_name(f".{directory.name}.part")
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    rates = Rates(replan_s=None if request.mode == "open" else 1.0 / request.replan_hz)
    world = World(result.scene, request.ego, request.seed, rates, simulator=request.simulator)
    write_result(part, request, result, world, result.timings_s, page=False)
    manifest = json.loads((part / "manifest.json").read_text(encoding="utf-8"))
    manifest["map"]["file"] = result.scene.road_map.name
    (part / "manifest.json").write_text(json.dumps(manifest, ensure_ascii=False) + "\n", encoding="utf-8")
    if page:
        from scenewright.studio.page import write_page

        write_page(part)
    shutil.rmtree(directory, ignore_errors=True)
    part.rename(directory)
