"""What is told is read back, and what is compiled is found again: random stories over all constructs and actors."""

from __future__ import annotations

from dataclasses import fields

import pytest
from random_stories import random_story, told_stories

from forms import FORMS
from scenarios import BRAKES, EXAMPLE_TABLE
from scenewright.errors import ProgramError, TranslationError
from scenewright.program.printer import print_program
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from scenewright.study.benchmark import benchmark_row
from scenewright.translate.compile import compile_story
from scenewright.translate.decompile import decompile
from scenewright.translate.read.sentences import read
from scenewright.translate.story import Story, arranged
from scenewright.translate.tell import tell

STORIES = 120


def programs() -> list[Program]:
    """Return the programs that others share: the benchmark, every form of constraint, whole scenarios."""
    found = [example.program() for example in EXAMPLE_TABLE]
    found += [parse_program(benchmark_row(number).program_text) for number in range(1, 81)]
    for form in FORMS:
        try:
            found.append(parse_program(form.binding_program(), form.name))
        except ProgramError:
            continue  # a form that shows what is refused
    return found


def story_of(program: Program) -> Story | None:
    try:
        return decompile(program)
    except TranslationError:
        return None


def differing(story: Story, other: Story) -> list[str]:
    return [
        each.name for each in fields(Story) if each.compare and getattr(story, each.name) != getattr(other, each.name)
    ]


def test_what_is_told_is_read_back() -> None:
    count = 0
    for story, told in told_stories(STORIES):
        count += 1
        found = read("\n".join(told))
        assert differing(story, arranged(found)) == [], "\n".join(told)
        assert not found.questions, found.questions
        assert not found.asides
    assert count > 0.98 * STORIES  # the rest have two moments at which the same is so


def test_what_is_compiled_is_found_again() -> None:
    for seed in range(STORIES):
        story = random_story(seed, si=True)
        program = compile_story(story)
        assert parse_program(print_program(program)) == program
        found = decompile(program)
        assert differing(story, found) == [], print_program(program)
        assert compile_story(found) == program


def test_what_a_program_says_is_told_and_read_back() -> None:
    told = 0
    for program in programs():
        story = story_of(program)
        if story is None:
            continue
        assert compile_story(arranged(read("\n".join(tell(story))))) == compile_story(story)
        told += 1
    assert told >= 150


@pytest.mark.parametrize(
    "line",
    [
        "gap(A0, A1, A1(t1)) > 0",
        "gap(A1, A0, A1(t2)) > 0",
        "gap(A1, A0, 2.5) > 0",
        "always[0, 3] (gap(A0, A1) > 0)",
        "never[0, 3] (gap(A0, A1) > 0 or A0v > 9)",
    ],
)
def test_who_is_behind_whom_is_read_back_wherever_it_is_told(line: str) -> None:
    story = decompile(parse_program(f"{BRAKES.text}{line}\n"))
    assert compile_story(arranged(read("\n".join(tell(story))))) == compile_story(story)
