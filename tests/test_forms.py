"""The table of forms: it speaks of the whole language, its page is of now, and what the page says still comes out."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import get_args, get_type_hints

import pytest
from forms_table import PAGE, STAGES, YES, Row, judged, planned, proven, resolved, witnessed

from forms import FORMS, PROBE
from scenewright.errors import ProgramError
from scenewright.program import expressions as ex
from scenewright.program.text import parse_program

BY_NAME = {form.name: form for form in FORMS}
# What the page says of these is asked again at every run of the tests.
ASKED = ("a at the last knot", "v at another's knot", "quotient", "never, knots", "always gap", "always v of the ego")


def spoken_of() -> Iterator[object]:
    """Yield what the rows speak of: node types, and for each what is chosen of its alternatives."""
    for form in FORMS:
        for text in (form.impossible_program(), form.binding_program()):
            try:
                formula = parse_program(text).constraint(PROBE).formula
            except ProgramError:  # a form that is refused is a row all the same
                continue
            for node in ex.walk(formula):
                yield type(node)
                for field in ("operator", "kind", "order", "name"):
                    if hasattr(node, field):
                        yield type(node), field, getattr(node, field)
                if isinstance(node, ex.State | ex.Derived):
                    yield type(node), "at", type(node.at)


def test_every_node_operator_and_moment_of_the_language_has_a_row() -> None:
    found = set(spoken_of())
    wanted: set[object] = {*get_args(ex.Term), *get_args(ex.Formula)}
    wanted |= {(ex.Compare, "operator", each) for each in get_args(ex.ComparisonOperator)}
    for node in (ex.Logic, ex.Temporal, ex.Arithmetic):
        operators = get_args(get_type_hints(node)["operator"])
        assert operators
        wanted |= {(node, "operator", each) for each in operators}
    wanted |= {(ex.State, "order", order) for order in get_args(ex.Order)}
    wanted |= {(ex.State, "at", kind) for kind in get_args(ex.At)}
    wanted |= {(ex.Derived, "at", kind) for kind in get_args(ex.At) if kind is not ex.PieceRef}
    wanted |= {(ex.Derived, "kind", kind) for kind in get_args(ex.DerivedKind)}
    wanted |= {(ex.Landmark, "name", name) for name in ex.LANDMARKS}
    assert wanted - found == set(), "a row of tests/forms.py must speak of it"


def cells_of_page() -> dict[str, tuple[str, ...]]:
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if re.match(r"\| [^-]", line)]
    table = [re.split(r" (?<!\\)\| ", line.strip("| ")) for line in lines]
    first = next(number for number, words in enumerate(table) if words[0] == "form")
    assert table[first][3:] == list(STAGES)
    return {words[0]: tuple(words[3:]) for words in table[first + 1 :]}


def test_the_page_has_the_rows_of_the_table() -> None:
    page = cells_of_page()
    assert list(page) == list(BY_NAME), "make forms"
    text = PAGE.read_text(encoding="utf-8")
    for form in FORMS:
        assert Row(form, page[form.name]).line() in text, f"{form.name} was changed since: make forms"


@pytest.mark.parametrize("name", ASKED)
def test_what_the_page_says_still_comes_out(name: str) -> None:
    form = BY_NAME[name]
    cells = (resolved(form), proven(form), witnessed(form), judged(form), planned(form, "constant"))
    assert cells == cells_of_page()[name][: len(cells)], "make forms"


def test_what_is_refused_by_name_is_on_the_page() -> None:
    page = cells_of_page()
    assert page["interval in interval"][0] == resolved(BY_NAME["interval in interval"])
    assert all(cells[0] == YES or cells[0].startswith("refused: ") for cells in page.values())
