"""Descriptions in many voices: each is read as a person reads it."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from scenewright.program.expressions import Number, ParameterRef, walk
from scenewright.program.printer import print_expression, print_program
from scenewright.program.structure import Role, read_structure
from scenewright.program.text import parse_program
from scenewright.translate.offline import translate_offline
from scenewright.translate.translation import explain

CASES = tomllib.loads(Path(__file__).with_name("paraphrases.toml").read_text(encoding="utf-8"))["case"]
SYNCHRONISED = "A0(t1) == A1(t1)"


def test_there_are_many_voices() -> None:
    assert len(CASES) >= 60


@pytest.mark.parametrize("case", CASES, ids=[case["text"][:40] for case in CASES])
def test_reading(case: dict[str, Any]) -> None:
    program = translate_offline(case["text"]).program
    assert "".join(program.ego.route.headings) == case["ego"]
    assert "".join(program.actor(1).route.headings) == case["hero"]
    assert " ".join(map(str, program.actor(1).sketch.pieces)) == case["pieces"]
    formulas = [print_expression(constraint.formula) for constraint in program.constraints]
    assert sorted(formulas) == sorted([*case["constraints"], SYNCHRONISED])


@pytest.mark.parametrize("case", CASES, ids=[case["text"][:40] for case in CASES])
def test_account(case: dict[str, Any]) -> None:
    """Every constraint comes from words of the text, every reading says what it gave, and the text form is lossless."""
    translation = translate_offline(case["text"])
    program = translation.program
    assert parse_program(print_program(program)) == program
    assert program.description == case["text"]
    for constraint in program.constraints:
        assert constraint.source is not None
        assert program.words_of(constraint)
    explained = {identifier for reading in translation.readings for identifier in reading.constraint_ids}
    assert explained == {constraint.id for constraint in program.constraints}
    for reading in translation.readings:
        assert reading.text == reading.span.excerpt(case["text"])
        assert reading.understood
    assert len(explain(translation)) == len(translation.readings)
    assert all(row[0] and row[1] for row in explain(translation))


@pytest.mark.parametrize("case", CASES, ids=[case["text"][:40] for case in CASES])
def test_structure(case: dict[str, Any]) -> None:
    """The program's structure shows one trigger, and declares every parameter as an open one."""
    program = translate_offline(case["text"]).program
    structure = read_structure(program)
    assert structure.trigger_knot(1) == structure.trigger_knot(0) == "t1"
    roles = set(structure.roles.values())
    assert Role.TRIGGER in roles
    used = {n.name for c in program.constraints for n in walk(c.formula) if isinstance(n, ParameterRef)}
    assert {parameter.name for parameter in program.parameters} == used
    assert all(parameter.value is None for parameter in program.parameters)
    assert all(
        isinstance(n.value.numerator, int)
        for c in program.constraints
        for n in walk(c.formula)
        if isinstance(n, Number)
    )
