"""The text form: the paper's blocks as they stand, and what each construct says."""

from __future__ import annotations

import re
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from small_programs import formula

from scenarios import EXAMPLES, example
from scenewright.errors import Span
from scenewright.program import text as text_form
from scenewright.program.expressions import (
    Arithmetic,
    Compare,
    Derived,
    Elapsed,
    Knot,
    Landmark,
    Number,
    ParameterRef,
    PieceRef,
    State,
)
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.program.types import HeadingsRoute, IntentRoute, LanesRoute, Parameter, PieceKind


def test_the_papers_blocks_are_the_examples_word_for_word(shared_dir: Path) -> None:
    paper = (shared_dir / "paper" / "paper.tex").read_text(encoding="utf-8")
    blocks = [b.strip("\n") for b in re.findall(r"\\begin{verbatim}(.*?)\\end{verbatim}", paper, re.DOTALL)]
    programs = [block for block in blocks if block.startswith("Actor 0:")]
    files = [EXAMPLES / "lead_turns_into_driveway.scene", EXAMPLES / "hesitates_and_goes.scene"]
    assert len(programs) == len(files)
    for block, file in zip(programs, files, strict=True):
        assert block in file.read_text(encoding="utf-8")
        assert parse_program(block).constraints == parse_program(file.read_text(encoding="utf-8")).constraints


def test_what_the_papers_first_block_says() -> None:
    text = (EXAMPLES / "lead_turns_into_driveway.scene").read_text(encoding="utf-8")
    program = parse_program(text, "lead")
    ego, hero = program.actors
    assert (ego.id, ego.name, ego.route) == (0, "ego", HeadingsRoute(("W",)))
    assert (hero.id, hero.name, hero.route) == (1, "hero", HeadingsRoute(("W", "N")))
    assert hero.sketch.knots == ("t0", "t1", "t2")
    assert hero.sketch.pieces == (PieceKind.GO, PieceKind.DEC)
    assert program.name == "lead"
    assert [p.name for p in program.parameters] == [
        "ego_initial_speed_mps",
        "initial_speed_mps",
        "distance_ahead_of_ego_m",
    ]
    assert all(p.value is None for p in program.parameters)
    turn = Arithmetic("-", Landmark("turn"), Number(Fraction(100)))
    assert program.constraint("c2").formula == Compare("==", State(0, 0, Knot("t0")), turn)
    gap = Arithmetic("-", State(1, 0, Knot("t1")), State(0, 0, Knot("t1")))
    assert program.constraint("c4").formula == Compare("==", gap, ParameterRef("distance_ahead_of_ego_m"))
    assert program.constraint("c7").formula == Compare("==", Elapsed(0, "t1"), Elapsed(1, "t1"))


def test_pieces_and_knots_are_told_apart_by_their_names() -> None:
    assert formula("A1a(dec2) == 0") == Compare("==", State(1, 2, PieceRef("dec2")), Number(Fraction(0)))
    assert formula("A1v(stop) == 0") == Compare("==", State(1, 1, PieceRef("stop")), Number(Fraction(0)))
    assert formula("A1v(rest) == 0") == Compare("==", State(1, 1, Knot("rest")), Number(Fraction(0)))


def test_derived_quantities() -> None:
    left = Derived("gap", 0, 1, Elapsed(1, "t1"))
    assert formula("gap(A0, A1, A1(t1)) == 12") == Compare("==", left, Number(Fraction(12)))


def test_headers_parameters_and_sources() -> None:
    text = (
        'scenario "a \\"b\\" \\\\ c"\nmap fabriksgatan\ndescription: "one\ntwo three"\n\nparameters:\n'
        "- a_m = 10 ft in [1 m, 20 m]\n- b_mps in [-1/3, 2]\n\n# a remark\n"
        "Actor 0 (av):\n- lanes 1.0.-1, 10.0.-1\n- [t0, go, t1]  # another\n\n"
        "Actor 1 (van):\n- from driveway headed S, left into road headed E\n- [t0, go, t1]\n\n"
        "Constraints:\nfirst: A0v(t0) == 5  @4..7\n\nA1v(t0) == 5\nA0x(t0) == a_m - c_m\n"
    )
    program = parse_program(text)
    assert (program.name, program.map_name, program.description) == ('a "b" \\ c', "fabriksgatan", "one\ntwo three")
    assert program.parameters == (
        Parameter("a_m", Fraction("3.048"), Fraction(1), Fraction(20)),
        Parameter("b_mps", None, Fraction(-1, 3), Fraction(2)),
        Parameter("c_m"),
    )
    assert program.ego.route == LanesRoute(("1.0.-1", "10.0.-1"))
    assert program.actor(1).route == IntentRoute("driveway", "left", "road", "S", "E")
    assert [c.id for c in program.constraints] == ["first", "c2", "c3"]
    first = program.constraint("first")
    assert first.source == Span(4, 7)
    assert program.words_of(first) == "two"
    assert parse_program(print_program(program)) == program


@pytest.mark.parametrize(
    ("route", "spec"),
    [
        ("from road, left", IntentRoute("road", "left")),
        ("from road headed W, right into driveway", IntentRoute("road", "right", "driveway", "W")),
        ("from driveway", IntentRoute("driveway")),
        ("from, straight headed E", IntentRoute(turn="straight", destination_heading="E")),
        ("from road, into driveway", IntentRoute("road", destination="driveway")),
    ],
)
def test_intents(route: str, spec: IntentRoute) -> None:
    program = parse_program(example("W", "t0, go, t1", "A0v(t0) == 1", ego_route=route))
    assert program.ego.route == spec
    assert parse_program(print_program(program)).ego.route == spec


def test_a_file_may_end_without_a_line_break_and_use_foreign_ones() -> None:
    text = example("W", "t0, go, t1", "A0v(t0) == 1")
    assert parse_program(text.rstrip("\n")) == parse_program(text)
    assert parse_program(text.replace("\n", "\r\n")) == parse_program(text)
    assert parse_program(text + "\n\n  # the end") == parse_program(text)


def test_two_lists_of_parameters_are_one() -> None:
    text = example("W", "t0, go, t1", "A0v(t0) == slow_mps")
    program = parse_program("parameters:\n- slow_mps = 3\nparameters:\n- fast_mps = 9\n" + text)
    assert {each.name: each.value for each in program.parameters} == {"slow_mps": 3, "fast_mps": 9}


@pytest.mark.parametrize("found", ["nothing", "garbage", "no folder"])
def test_what_was_built_before_is_a_matter_of_time_only(
    found: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = tmp_path / "scenewright" / f"scene-{sys.version_info.major}.{sys.version_info.minor}.lark"
    if found == "garbage":
        kept.parent.mkdir()
        kept.write_bytes(b"garbage")
    elif found == "no folder":
        (tmp_path / "scenewright").write_text("a file", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    programs = []
    for _ in range(2):
        text_form._parser.cache_clear()
        programs.append(parse_program(example("W", "t0, go, t1", "A0v(t0) == 1")))
    text_form._parser.cache_clear()
    assert programs[0] == programs[1]
    assert kept.is_file() is (found != "no folder")
