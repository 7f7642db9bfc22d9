"""What a user asks for, and what comes of it.

What enters: words from the command line, or a caller's. What leaves: the same as data, for `orchestrate` and for
whoever tells of it. Nothing is done here.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

from scenewright.errors import InputError
from scenewright.translate.model.exchange import TranslatorSettings

if TYPE_CHECKING:
    from scenewright.judge.verdict import Verdict
    from scenewright.plan.planner import Attempt
    from scenewright.roads.grounding import Scene
    from scenewright.simulate.loop import Run
    from scenewright.solve.feasibility import Feasibility
    from scenewright.solve.holding import NotHeld
    from scenewright.trace.model import Trace
    from scenewright.translate.understand import Understanding

Mode = Literal["closed", "open"]
PlannerName = Literal["convex", "smt"]
Tolerance = Literal["tight", "loose"]
Level = Literal["fine", "tight", "loose", "coarse"]
Explain = Literal["nothing", "cause", "ways out"]
Status = Literal["success", "failure", "infeasible", "gave up", "interrupted", "failed"]
EXIT_STATUS: dict[Status, int] = {
    "success": 0,
    "failure": 1,
    "failed": 2,
    "infeasible": 3,
    "gave up": 4,
    "interrupted": 130,
}
Stop = Literal["check", "plan", "end"]
Report = Callable[[str], None]
_WORDS: dict[str, tuple[object, ...]] = {
    "mode": get_args(Mode),
    "tolerance": get_args(Tolerance),
    "aim": (None, *get_args(Level)),
    "explain": get_args(Explain),
    "planner": get_args(PlannerName),
}
_RANGES = {"seed": (Integral, 0, math.inf), "takes": (Integral, 1, 20), "replan_hz": (Real, 0.1, 50.0)}


@dataclass(frozen=True, slots=True)
class Request:
    """What a user asks for: the command line of ``scenewright run``, as data.

    `solver` is what refutes; `explain` says what is found out about a run that misses, or about what cannot happen.
    Takes go on until one holds at the tolerance `aim`, by itself that which decides. A `simulator` may drive the ego
    itself; the policy `ego` is then only asked how it would start. The `planner` ``smt`` is the paper's own loop: it
    foresees the ego by itself, and rehearses nothing.

    Raises
    ------
    InputError
        For a word or a number that is none of those that there are.
    """

    source: str
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    map_name: str | None = None
    ego: str = "idm"
    mode: Mode = "closed"
    tolerance: Tolerance = "tight"
    aim: Level | None = None
    seed: int = 0
    translator: str = "auto"
    out: Path | None = None
    replan_hz: float = 10.0
    predictor: str = "road"
    takes: int = 3
    explain: Explain = "cause"
    solver: str = "z3"
    simulator: str = "builtin"
    planner: PlannerName = "convex"
    translation: TranslatorSettings = field(default_factory=TranslatorSettings)

    def __post_init__(self) -> None:
        """Refuse what would be taken for something else; take paths, and whole numbers, of any type."""
        for name in ("source", "map_name", "ego", "translator", "predictor", "solver", "simulator"):
            value = getattr(self, name)
            if isinstance(value, os.PathLike):
                object.__setattr__(self, name, os.fspath(value))
            elif not isinstance(value, str) and not (name == "map_name" and value is None):
                expected = "a text (of a program in Python: scene.text(), print_program(program)) or a path"
                raise InputError(f"{name} is no text", found=repr(value), expected=expected)
        for name, words in _WORDS.items():
            value = getattr(self, name)
            if value not in words:
                raise InputError(f"there is no such {name}", found=repr(value), expected=", ".join(map(repr, words)))
        for name, (kind, least, most) in _RANGES.items():
            value = getattr(self, name)
            fits = isinstance(value, kind) and least <= float(value) <= most
            if not fits:
                expected = f"{'a whole number' if kind is Integral else 'a number'} from {least:g} to {most:g}"
                raise InputError(f"{name} is out of range", found=repr(value), expected=expected)
            object.__setattr__(self, name, int(value) if kind is Integral else float(value))
        if self.out is not None:
            object.__setattr__(self, "out", Path(self.out))


@dataclass(frozen=True, slots=True)
class Take:
    """How one take was judged, and what was driven; `hindsight` as in `Result`."""

    verdict: Verdict
    hindsight: Feasibility | None
    trace: Trace | None = None


@dataclass(slots=True)
class Result:
    """What came of a request.

    Attributes
    ----------
    status
        ``success`` or ``failure`` are verdicts; ``failed`` and ``interrupted`` runs were cut short.
    not_held
        What the first plan breaks beyond the loose tolerance; nothing was driven then.
    no_plan
        Why there is no first plan; empty where there is one.
    hindsight
        For a run that missed: the proof that against the ego as it drove no hero could have done it, if there is one.
    run_directory
        Where the files are; None where nothing was driven or nothing was to be written.
    take
        Which take this is: later ones knew how the ego had driven in the one before.
    takes
        Every take that was driven to its end, in order.
    """

    status: Status
    scene: Scene
    understanding: Understanding | None = None
    feasibility: Feasibility | None = None
    attempt: Attempt | None = None
    not_held: tuple[NotHeld, ...] = ()
    no_plan: str = ""
    run: Run | None = None
    hindsight: Feasibility | None = None
    verdict: Verdict | None = None
    run_directory: Path | None = None
    take: int = 1
    takes: tuple[Take, ...] = ()
    timings_s: dict[str, float] = field(default_factory=dict)


class Stages:
    """Names and times the stages of one request."""

    def __init__(self, report: Report | None) -> None:
        self.seconds: dict[str, float] = {}
        self.say: Report = report or (lambda _: None)

    @contextmanager
    def __call__(self, name: str) -> Iterator[None]:
        """Time what is done inside as the stage `name`."""
        self.say(name)
        started = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - started
