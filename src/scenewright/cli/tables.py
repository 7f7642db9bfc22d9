"""What people read of a scenario, a plan and a verdict: tables and lines for a console.

What enters: scenes, plans, verdicts. What leaves: rich renderables. Nothing is decided here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from rich import box
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from scenewright.cli.console import marks

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console

    from scenewright.judge.verdict import Condition, Verdict
    from scenewright.program.types import Program
    from scenewright.roads.grounding import Scene
    from scenewright.solve.plan import Plan
    from scenewright.translate.understand import Understanding

# Conditions of these kinds are the same in every run; they are shown one by one only where one fails.
ROUTINE = ("route", "safety")
_NEAR_M = 0.05


def table(*columns: str, right: Sequence[str] = ()) -> Table:
    """Return an empty table in the house's look; columns named in `right` hold numbers."""
    made = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 1, 0, 0), header_style="bold")
    for name in columns:
        made.add_column(name, justify="right" if name in right else "left", no_wrap=name in right)
    return made


def facts(rows: Iterable[tuple[str, str | Text]]) -> Table:
    """Return names and what is to be said of each, one below the other."""
    made = Table(box=None, pad_edge=False, show_header=False, padding=(0, 2, 0, 0))
    made.add_column(style="bold", no_wrap=True)
    made.add_column(overflow="fold")
    for name, value in rows:
        made.add_row(name, value if isinstance(value, Text) else Text(value))
    return made


# -- the scenario ---------------------------------------------------------------------------------------------------
def tell_understood(console: Console, program: Program, understanding: Understanding | None) -> None:
    """Print what was understood, sentence by sentence with the words it came from, and what was taken for granted."""
    from scenewright.translate.lines import lines_of_program

    if understanding is None:
        lines, heads = lines_of_program(program), ("what the program says", "the words beside it")
    else:
        who = "offline" if understanding.translator == "offline" else f"by {understanding.translator}"
        lines, heads = understanding.lines, (f"understood {who}", "from your words")
    with_words = any(line.words for line in lines)
    made = table(*heads if with_words else heads[:1])
    for line in lines:
        made.add_row(Text(line.sentence), *([Text(line.words, style="dim")] if with_words else []))
    console.print(made)
    if understanding is not None and understanding.remarks:
        console.print(facts(understanding.remarks))


def understanding_data(program: Program, understanding: Understanding | None) -> dict[str, Any]:
    """Return what was understood as plain data; of a program what it says."""
    from scenewright.translate.lines import lines_of_program

    if understanding is not None:
        return understanding.as_data()
    lines = [{"sentence": line.sentence, "words": line.words} for line in lines_of_program(program)]
    return {"translator": "none", "understood": lines}


def parameters(scene: Scene, given: Iterable[str]) -> list[tuple[str, str]]:
    """Return every parameter's value and who chose it, in words."""
    words = {"given": "given", "program": "in the program", "solver": "chosen: you left it open"}
    return [
        (name, f"{data['value']:g} {data['unit']} ({words[str(data['source'])]})")
        for name, data in parameter_data(scene, given).items()
    ]


def parameter_data(scene: Scene, given: Iterable[str]) -> dict[str, dict[str, float | str]]:
    """Return every parameter's value, unit and source, as `params.json` has them."""
    names = set(given)
    data: dict[str, dict[str, float | str]] = {}
    for parameter in scene.program.parameters:
        value = float(scene.parameters[parameter.name] / parameter.unit.si_factor)
        source = "solver" if parameter.value is None else "program"
        source = "given" if parameter.name in names else source
        data[parameter.name] = {"value": value, "unit": parameter.unit.symbol, "source": source}
    return data


# -- the plan -------------------------------------------------------------------------------------------------------
def knots(scene: Scene, plan: Plan) -> Table:
    """Return when and where each actor is at its moments, and how it goes on from there."""
    from scenewright.translate.lines import told_knots

    numbers = ("time s", "position m", "speed m/s", "then m/s^2")
    made = table("actor", "when", "time s", "position m", "place", "speed m/s", "then m/s^2", right=numbers)
    told = told_knots(scene.program)
    for actor_id, profile in sorted(plan.profiles.items()):
        actor = scene.program.actor(actor_id)
        for knot, time_s in profile.knot_times_s.items():
            s_m, speed_mps, _ = profile.state(time_s)
            accel_mpss = profile.state(time_s + 1e-6)[2]
            place = relative_to(s_m, scene.landmarks_m[actor_id])
            made.add_row(
                actor.name,
                told.get((actor_id, knot), "the end"),
                f"{time_s:.2f}",
                f"{s_m:.2f}",
                place,
                f"{speed_mps:.2f}",
                f"{accel_mpss:.2f}",
            )
        made.add_section()
    return made


def relative_to(s_m: float, landmarks_m: Mapping[str, float]) -> str:
    """Return a position in terms of a landmark: the conflict point where there is one, else the stop line or junction.

    >>> relative_to(40.0, {"stop_line": 52.0, "route_end": 90.0})
    '12.00 m before stop line'
    """
    for name in ("conflict_point", "stop_line", "junction_start", "route_end"):
        if name in landmarks_m:
            ahead_m = landmarks_m[name] - s_m
            words = name.replace("_", " ")
            if abs(ahead_m) < _NEAR_M:
                return f"at {words}"
            return f"{abs(ahead_m):.2f} m {'before' if ahead_m > 0 else 'past'} {words}"
    return ""


# -- the verdict ----------------------------------------------------------------------------------------------------
def verdict(judged: Verdict) -> Table:
    """Return the conditions with required and measured values; routine ones only where they fail."""
    numbers = ("required", "measured", "error")
    made = table("condition", *numbers, "tight", "loose", right=numbers)
    kind = ""
    for condition in judged.conditions:
        row = condition.as_dict()
        if condition.kind in ROUTINE and row["tight"] and row["loose"]:
            continue
        if condition.kind != kind:
            kind = condition.kind
            made.add_row(Text(kind, style="bold"))
        made.add_row(
            Padding(Text(condition.text), (0, 0, 0, 2)),
            _quantity(condition.required, condition.unit),
            _quantity(condition.measured, condition.unit),
            "-" if condition.error is None else _signed(condition.error),
            mark(row["tight"]),
            mark(row["loose"]),
        )
    return made


def routine(judged: Verdict) -> str:
    """Return one line on the conditions that the table leaves out."""
    held = [c for c in judged.conditions if c.kind in ROUTINE and (d := c.as_dict())["tight"] and d["loose"]]
    return f"{len(held)} routine checks of routes, motion and room before the trigger hold too."


def aftermath(judged: Verdict) -> Text:
    """Return one line on what came of the run; a collision stands out."""
    came = judged.aftermath
    return Text(f"What came of it: {came.in_words()}.", style="bold yellow" if came.collision else "")


def cause(judged: Verdict) -> Iterator[Text]:
    """Yield lines on why the run missed and what would do, where that is known."""
    if judged.cause is not None:
        yield Text(f"Why: {judged.cause.text}")
        if judged.cause.way_out():
            yield Text(judged.cause.way_out())


def missed(judged: Verdict, tolerance: str) -> list[Condition]:
    """Return the conditions that do not hold at a tolerance."""
    return [condition for condition in judged.conditions if not condition.as_dict()[tolerance]]


def mark(holds: bool) -> Text:
    """Return a sign for yes or no."""
    yes, no = marks()
    return Text(yes, style="green") if holds else Text(no, style="bold red")


def _quantity(value: float | None, unit: str) -> str:
    if value is None or not math.isfinite(value):
        return "-" if value is None else "never"
    return f"{_number(value)} {unit}".strip()


def _number(value: float) -> str:
    return f"{value + 0.0:.2f}" if abs(value) < 1e4 else f"{value:.4g}"


def _signed(value: float) -> str:
    if not math.isfinite(value):
        return "-"
    text = f"{value:+.3f}"
    return text[1:] if float(text) == 0.0 else text
