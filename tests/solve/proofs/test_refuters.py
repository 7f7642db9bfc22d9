"""Solvers by entry point: which there are, what one misses, and that no two contradict each other."""

from __future__ import annotations

import sys
import tomllib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import pytest
from planted import T, lowered

from forms import FORMS, program
from posed import UNKNOWNS, X, Y, at_random, eased, named, violation
from scenewright.algebra.polynomials import Named, Unknown, compare, resting_on, some
from scenewright.errors import InputError, MissingExtraError, SolverError
from scenewright.orchestrate import orchestrate
from scenewright.program.text import parse_program
from scenewright.request import Request
from scenewright.roads.grounding import ground
from scenewright.solve.proofs.refuters import (
    GROUP,
    SOLVERS,
    Answer,
    Capabilities,
    Refuter,
    clashing,
)
from scenewright.solve.proofs.relaxation import relaxation

OTHERS = ("cvc5", "scip")
SLIGHTLY = Fraction(1, 1000)
SOLVER = """
from scenewright.solve.proofs.refuters import Answer, Capabilities

class Shy:
    name = "shy"
    capabilities = Capabilities(exact=True)
    def ask(self, unknowns, formulas, timeout_s):
        return Answer("unknown")

class Breaks(Shy):
    def ask(self, unknowns, formulas, timeout_s):
        raise MemoryError("no room")

class Mumbles(Shy):
    def ask(self, unknowns, formulas, timeout_s):
        return "refuted"
"""


@dataclass
class Slow:
    """Refutes anything, and takes long for it."""

    capabilities: Capabilities
    name: str = "slow"

    def ask(self, unknowns: Sequence[Unknown], formulas: Sequence[Named], timeout_s: float) -> Answer:
        return Answer("refuted", took_s=0.4)


def other(name: str) -> Refuter:
    missing = SOLVERS.known()[name]
    if missing is not None:
        pytest.skip(str(missing))
    return SOLVERS.called(name)


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package of somebody else's; one of its solvers needs an extra that is not there, one cannot be imported."""
    (tmp_path / "shysolver.py").write_text(SOLVER, encoding="utf-8")
    (tmp_path / "shysolver_apart.py").write_text("raise ImportError('nothing of this is to be imported')")
    about = tmp_path / "shysolver-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: shysolver\nVersion: 1.0\nProvides-Extra: deep\n"
        'Requires-Dist: no-such-library>=2; extra == "deep"\n'
    )
    (about / "entry_points.txt").write_text(
        f"[{GROUP}]\nshy = shysolver:Shy\ndeep = shysolver_apart:Deep [deep]\nbad = shysolver_apart:Bad\n"
        "breaks = shysolver:Breaks\nmumbles = shysolver:Mumbles\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    for name in ("shysolver", "shysolver_apart"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return tmp_path


def test_ours_are_registered_like_any_other() -> None:
    project = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert set(project["entry-points"][GROUP]) == set(SOLVERS.known())
    assert SOLVERS.known()["z3"] is None, "z3 is no extra"
    assert {name for name in OTHERS if name in project["optional-dependencies"]} == set(OTHERS)


def test_a_package_brings_a_solver(package: Path) -> None:
    assert {"shy", "deep", "bad", "z3"} <= set(SOLVERS.known())
    assert "shysolver" not in sys.modules, "what is listed is not imported"
    assert SOLVERS.called("shy").ask(UNKNOWNS, [], 1.0).kind == "unknown"


def test_what_is_missing_is_found_without_importing_it(package: Path) -> None:
    with pytest.raises(MissingExtraError, match=r"no-such-library.*\n.*pip install \"shysolver\[deep\]\""):
        SOLVERS.called("deep")
    assert "shysolver_apart" not in sys.modules


def test_solvers_that_fail_are_named(package: Path) -> None:
    with pytest.raises(SolverError, match="'bad' cannot be imported") as broken:
        SOLVERS.called("bad")
    assert "nothing of this" in str(broken.value.found)
    with pytest.raises(InputError, match="no such solver") as unknown:
        SOLVERS.called("z4")
    assert "z3" in str(unknown.value.expected)


@pytest.mark.parametrize(("name", "words"), [("breaks", "MemoryError: no room"), ("mumbles", "it answered 'refuted'")])
def test_one_that_fails_when_asked_is_named(package: Path, name: str, words: str) -> None:
    impossible = (Path(__file__).parents[3] / "examples" / "impossible.txt").read_text(encoding="utf-8")
    with pytest.raises(SolverError, match=f"the solver {name.title()} failed") as broken:
        orchestrate(Request(impossible, solver=name), until="check")
    assert words in str(broken.value.found)


def test_capabilities_are_told_in_words() -> None:
    assert Capabilities(exact=False).words() == "numeric: a cross-check, no proof"


@pytest.mark.parametrize("name", ["z3", *OTHERS])
def test_what_clashes_by_any_solver_clashes_and_is_no_more_than_is_needed(name: str) -> None:
    formulas = named(
        low=compare("<=", X, 3),
        high=some([compare(">=", X, 4), compare(">=", X * Y, 16)]),
        else_where=compare("==", Y, 1),
    )
    solver = other(name)
    found = clashing(solver, ["low", "high", "else_where"], lambda names: (UNKNOWNS, resting_on(formulas, names)))
    assert set(found) == {"low", "high"}, "x y is at most 15"


def test_looking_for_what_clashes_ends_and_leaves_out_nothing_that_was_not_looked_at() -> None:
    slow = Slow(Capabilities(exact=True))
    assert clashing(slow, list("abcde"), lambda _: (UNKNOWNS, [])) == list("de"), "three questions took all the work"


@pytest.mark.parametrize(("name", "count"), [("cvc5", 25), ("scip", 60)])
def test_no_two_solvers_contradict_each_other(name: str, count: int) -> None:
    z3, second = SOLVERS.called("z3"), other(name)
    answers: Counter[tuple[str, str]] = Counter()
    for seed in range(count):
        unknowns, formulas = at_random(seed)
        first, answer = z3.ask(unknowns, formulas, 2.0), second.ask(unknowns, formulas, 2.0)
        answers[first.kind, answer.kind] += 1
        if {first.kind, answer.kind} == {"met", "refuted"}:
            assert not second.capabilities.exact, f"seed {seed}: {first.kind} and {answer.kind}"
            # One that reckons with floats may err where a little more or less decides.
            close = eased(formulas, SLIGHTLY if answer.kind == "met" else -SLIGHTLY)
            assert z3.ask(unknowns, close, 2.0).kind in (answer.kind, "timeout", "unknown"), f"seed {seed}"
        for told in (first, answer):
            slack = 1e-6 if told is first else 1e-3
            assert all(violation(each.formula, told.values) < slack for each in formulas if told.values), f"seed {seed}"
    assert answers["refuted", "refuted"] > count / 5, "there was something to agree on"
    assert answers["met", "met"] > count / 5


def relaxed(text: str) -> tuple[list[Unknown], list[Named]]:
    scene = ground(parse_program(text), T)
    events, lowering = lowered(scene)
    return events.unknowns, relaxation(events, lowering.narrowings, lowering.lower(scene.program.constraints))


@pytest.mark.parametrize(("name", "every"), [("cvc5", 5), ("scip", 1)])
def test_what_no_form_of_constraint_can_ask_for_others_refute_too(name: str, every: int) -> None:
    solver = other(name)
    for form in [each for each in FORMS if each.name != "interval in interval"][::every]:
        kind = solver.ask(*relaxed(form.impossible_program()), 5.0).kind
        # One that takes "before" for "not after" finds a motion where the difference is all there is.
        assert kind == "refuted" or (not solver.capabilities.exact and " < " in form.impossible), form.name


def test_a_solver_of_ours_refutes_what_a_shared_table_calls_impossible(shared_dir: Path) -> None:
    table = shared_dir / "acceptance" / "forms.txt"
    if not table.is_file():
        pytest.skip("no table of forms beside the clone")
    rows = [line.split(" | ") for line in table.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    second = other("scip")
    for name, base, impossible, *_ in rows:
        parameter, _, formula = impossible.rpartition(": ")
        if name == "temporal in temporal" or " < " in impossible:
            continue
        assert second.ask(*relaxed(program(base, formula, parameter)), 5.0).kind == "refuted", name
