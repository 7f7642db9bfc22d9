"""Compares the two offline readers on the texts of the tests: `python tools/compare_readers.py`.

Right, asked, refused, differs: against what a person reads in a text. Kept: of the automatic changes of meaning to
texts that a reader took without a question, how many left the program as it was.
"""

from __future__ import annotations

import json
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from scenewright.errors import ScenewrightError
from scenewright.language.compile import compile_story
from scenewright.language.understand import understand
from scenewright.program.printer import print_expression
from scenewright.program.types import Program, RouteSpec
from scenewright.roads.load import load_map
from scenewright.roads.routes import find_routes
from scenewright.translate.offline import translate_offline

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests" / "language"), str(ROOT / "tests" / "translate")]
from changes import changes  # noqa: E402 - the tests' own
from test_paper import ORACLE, Expected  # noqa: E402 - what a person reads

Facts = tuple[tuple[RouteSpec, ...], str, frozenset[str]]
Answer = tuple[str, Facts | None]  # asked or refused, or taken and what


def facts_of(program: Program) -> Facts:
    formulas = frozenset(print_expression(constraint.formula) for constraint in program.constraints)
    return tuple(actor.route for actor in program.actors), " ".join(program.actors[-1].sketch.pieces), formulas


def old(text: str) -> Answer:
    try:
        return "taken", facts_of(translate_offline(text).program)
    except ScenewrightError:
        return "refused", None


def new(text: str) -> Answer:
    try:
        story = understand(text)
        program = compile_story(story)
    except ScenewrightError as error:
        return ("asked" if "leaves something open" in error.message else "refused"), None
    return ("asked" if story.questions else "taken"), facts_of(program)


def is_right(facts: Facts, ego: str, hero: str, pieces: str, constraints: frozenset[str]) -> bool:
    """Whether it is what a person reads; setting off again may be a `go` where the old reader has an `acc`."""
    routes = tuple("".join(getattr(route, "headings", ())) for route in facts[0])
    moves = facts[1] in (pieces, pieces.replace("stop acc", "stop go"))
    return routes == (ego, hero) and moves and facts[2] == constraints | {"A0(t1) == A1(t1)"}


def main() -> None:
    find_routes(load_map("t_intersection"))  # not part of the time of the first text
    shared = ROOT.parent / "shared" / "paper" / "descriptions-dev.json"
    paper = json.loads(shared.read_text(encoding="utf-8")) if shared.is_file() else []
    texts = {entry["id"]: entry["text"] for entry in paper}
    cases = tomllib.loads((ROOT / "tests/translate/paraphrases.toml").read_text(encoding="utf-8"))["case"]
    bad = tomllib.loads((ROOT / "tests/translate/refusals.toml").read_text(encoding="utf-8"))["case"]
    sets: dict[str, list[tuple[str, Expected | None]]] = {
        "paper": [(texts[number], expected) for number, expected in ORACLE.items() if number in texts],
        "paraphrases": [(case["text"], Expected(case["ego"], case["hero"], case["pieces"], (), (),
                         tuple(case["constraints"]))) for case in cases],
        "to be refused": [(case["text"], None) for case in bad if "{" not in case["text"]],
    }  # fmt: skip
    for name, reader in (("old", old), ("new", new)):
        for label, entries in sets.items():
            print(name, label, len(entries), dict(judged(reader, entries)))


def judged(reader: Callable[[str], Answer], entries: list[tuple[str, Expected | None]]) -> Counter[str]:
    found: Counter[str] = Counter()
    begun = time.perf_counter()
    for text, expected in entries:
        kind, facts = reader(text)
        right = expected is not None and facts is not None and is_right(
            facts, expected.ego, expected.hero, expected.pieces,
            frozenset((*expected.initial, *expected.trigger, *expected.then)),
        )  # fmt: skip
        found["right" if right else "differs" if kind == "taken" else kind] += 1
        if kind == "taken" and expected is not None:
            for _, changed in changes(text):
                found["changes"] += 1
                found["kept"] += reader(changed) == (kind, facts)
    found["ms a text"] = round(1000 * (time.perf_counter() - begun) / max(1, len(entries) + found["changes"]))
    return found


if __name__ == "__main__":
    main()
