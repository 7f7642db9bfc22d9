"""Asks of every form of constraint what each stage does with it, and writes `docs/forms.md`.

    python tools/forms_table.py              writes the page (two minutes)
    python tools/forms_table.py "x ==" gap   prints the rows of these forms

The forms are those of `tests/forms.py`. A cell is what came out, never what should: where a stage falls short its cell
says so, and nothing here decides what is acceptable.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from scenewright.errors import ScenewrightError
from scenewright.judge.judgement import judge
from scenewright.judge.tolerance import LOOSE, TIGHT
from scenewright.judge.verdict import Verdict
from scenewright.orchestrate import case_of, orchestrate, set_up
from scenewright.program.evaluate import violation
from scenewright.request import Request, Result, Stages
from scenewright.roads.grounding import Scene
from scenewright.simulate.loop import Rates
from scenewright.simulate.witnessed import run_of_witness
from scenewright.simulate.world import World
from scenewright.solve.plan import PlanWorld
from scenewright.solve.proofs.decide import Question, decide
from scenewright.solve.proofs.witness import Witness

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))
from forms import FORMS, PROBE, Form  # noqa: E402 - the tests' own table

PAGE = ROOT / "docs" / "forms.md"
EGOS = ("constant", "idm")
YES = "yes"
STAGES = ("resolved", "proven", "witnessed", "judged", *(f"planned, `{ego}`" for ego in EGOS))
_HEAD = """# Forms of constraint

What each stage does with every form that a constraint can take. `make forms` writes this page anew, and
`tests/test_forms.py` holds a part of it to what comes out.

| column | says *yes* where |
| --- | --- |
| resolved | it parses, its dimensions fit, and all that it leaves open is filled in |
| proven | `check` refutes the impossible one, and names it among what clashes |
| witnessed | `check` finds a motion in which the possible one holds, which the scenario alone does not ask for |
| judged | the judge finds that it holds in that motion, and does not grant another that breaks it alone |
| planned | it holds within the tight tolerance where it is driven in closed loop against an ego, in the first take |

*Refused by name*: nothing is driven, and the message says which constraint the planner cannot hold yet: this one, or
one that this one leaves no room for. *Missed*: it was driven, and the verdict says that it was not held.

"""


@dataclass(frozen=True)
class Row:
    """What came out of each stage, in the order of `STAGES`."""

    form: Form
    cells: tuple[str, ...]

    def line(self) -> str:
        words = (self.form.name, *(f"`{_declared(self.form, k)}`" for k in (0, 1)), *self.cells)
        return "| " + " | ".join(word.replace("|", "\\|") for word in words) + " |"


def row(form: Form) -> Row:
    """Carry a form through every stage."""
    cells = [resolved(form)]
    if cells[0] != YES:
        return Row(form, (cells[0], *["-"] * (len(STAGES) - 1)))
    cells += [proven(form), witnessed(form), judged(form), *(planned(form, ego) for ego in EGOS)]
    return Row(form, tuple(cells))


def resolved(form: Form) -> str:
    try:
        _checked(form.binding_program())
    except ScenewrightError as error:
        return f"refused: {error.message}"
    return YES


def proven(form: Form) -> str:
    world, _ = set_up(Request(form.impossible_program()), Stages(None))
    # What `check` asks before it looks for numbers that would do, which nobody here looks at.
    found = decide(Question(world.scene, world.structure, world.limits, world.ego_bounds))
    if found.answer != "infeasible":
        return found.answer
    return YES if PROBE in found.core else "not by its name"


def witnessed(form: Form) -> str:
    found = _checked(form.binding_program()).feasibility
    return YES if found is not None and found.witness is not None else "undecided"


def judged(form: Form) -> str:
    """Judge the witness, and one of the scenario with the contrary, by the program that has the binding constraint."""
    binding, contrary = (_checked(text) for text in (form.binding_program(), form.contrary_program()))
    kept, broken = _witness(binding), _witness(contrary)
    if kept is None or broken is None:
        return "no witness"
    scene = binding.scene
    formula = scene.program.constraint(PROBE).formula
    values = {name: float(value) for name, value in scene.parameters.items()}
    if not violation(formula, PlanWorld(scene, broken.profiles, values)) > 0:
        return "nothing breaks it"
    said = []
    if not _judged(scene, kept).condition(PROBE).holds_at(TIGHT):
        said.append("a witness is rejected")
    if _judged(scene, broken).holds_at(TIGHT):  # a moment at which it holds is not one at which all else does
        said.append("a breach is accepted")
    return ", ".join(said) or YES


def planned(form: Form, ego: str) -> str:
    result = orchestrate(Request(form.binding_program(), ego=ego, takes=1))
    if result.status == "infeasible":
        return "cannot happen with it"
    if result.not_held:
        return "refused by name"
    if result.verdict is None:
        return "no plan"
    condition = result.verdict.condition(PROBE)
    return YES if condition.holds_at(TIGHT) else "loosely" if condition.holds_at(LOOSE) else "missed"


@cache
def _checked(text: str) -> Result:
    return orchestrate(Request(text), until="check")


def _witness(result: Result) -> Witness | None:
    return result.feasibility.witness if result.feasibility is not None else None


def _judged(scene: Scene, witness: Witness) -> Verdict:
    limits = World(scene, "idm", 0, Rates()).limits
    return judge(case_of(scene, run_of_witness(scene, limits, witness), limits))


def _declared(form: Form, which: int) -> str:
    parameter, formula = form.parameter[which], (form.impossible, form.binding)[which]
    return f"{parameter}: {formula}" if parameter else formula


def page(rows: list[Row]) -> str:
    """Return the page: how many forms each stage takes, and every row."""
    counts = [
        f"| {stage} | {sum(each.cells[number] == YES for each in rows)} of {len(rows)} |"
        for number, stage in enumerate(STAGES)
    ]
    columns = ("form", "impossible", "possible", *STAGES)
    lines = [f"| {' | '.join(columns)} |", "|" + " --- |" * len(columns), *(each.line() for each in rows)]
    return "\n".join([_HEAD + "| stage | forms |\n| --- | --- |", *counts, "", *lines, ""])


def main(names: list[str], say: Callable[[str], None] = print) -> None:
    chosen = [form for form in FORMS if form.name in names or not names]
    rows = []
    for form in chosen:
        rows.append(row(form))
        say(rows[-1].line())
    if not names:
        PAGE.write_text(page(rows), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
