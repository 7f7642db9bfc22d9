"""The verdict: conditions with required and measured values, what came of the run, facts, and why it missed.

What enters: these. What leaves: success at any tolerance, and the plain data of `verdict.json`. Why a run missed is
found by whoever drove it (`scenewright.explain`); here it only has its form.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

from scenewright.judge.aftermath import Aftermath
from scenewright.judge.tolerance import LOOSE, TIGHT, Leaf, Miss, Tolerance, normalised, unit_symbol
from scenewright.units import Dimension

SCHEMA_VERSION = 1
Kind = Literal["initial", "route", "trigger", "interaction", "outcome", "safety"]
CauseKind = Literal["ego", "way", "prediction", "authority", "order", "plan"]


@dataclass(frozen=True, slots=True)
class Condition:
    """One thing that had to hold.

    Attributes
    ----------
    id, kind, text
        Name, part in the story, and the words and formula it stands for.
    required, measured, error
        In `unit`; the error is signed (measured minus required) for equalities, and how far beyond the bound otherwise.
        None where there is nothing to state as one number.
    unit
        SI symbol; empty where what is compared has none, and where an error is of several: that is in tight tolerances.
    miss
        The error by dimension, to which tolerances are applied; None where the condition could not be judged, which
        fails.
    owed_by
        Name of the actor that owes this in any run, whatever is asked for; None where the program asks for it, or it is
        in nobody's hands alone.
    """

    id: str
    kind: Kind
    text: str
    required: float | None
    measured: float | None
    error: float | None
    unit: str
    miss: Miss | None
    owed_by: str | None = None

    def normalised_error(self, tolerance: Tolerance) -> float:
        """Return the error in units of the tolerance; infinite where the condition could not be judged."""
        return math.inf if self.miss is None else float(normalised(self.miss, tolerance))

    def holds_at(self, tolerance: Tolerance) -> bool:
        """Whether the condition holds within the tolerance."""
        return self.normalised_error(tolerance) <= 1.0

    @property
    def off_by(self) -> str:
        """By how much it is missed, in words; nothing where there is no number for it."""
        if self.error is None or not math.isfinite(self.error):
            return ""
        return f"{abs(self.error):.2f} {self.unit or ('tight tolerances' if self.required is None else '')}".rstrip()

    def as_dict(self) -> dict[str, Any]:
        """Return the condition in the form of `verdict.json`."""
        return {
            "id": self.id,
            "kind": self.kind,
            "text": self.text,
            "required": _plain(self.required),
            "measured": _plain(self.measured),
            "error": _plain(self.error),
            "unit": self.unit,
            "tight": self.holds_at(TIGHT),
            "loose": self.holds_at(LOOSE),
        }


@dataclass(frozen=True, slots=True)
class WayOut:
    """Another value of one number with which it happened, when it was tried with the same ego and seed.

    Attributes
    ----------
    what
        The parameter's name, or the number and where it stands.
    value, instead_of
        In `unit`.
    parameter
        The name to set; None for a number that is written in the description or program.
    """

    what: str
    value: float
    instead_of: float
    unit: str
    parameter: str | None = None

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        if self.parameter is not None:
            return f"{self.parameter} = {self.value:g} instead of {self.instead_of:g}{unit}"
        return f"{self.value:g}{unit} instead of {self.what}"


@dataclass(frozen=True, slots=True)
class Cause:
    """Why a run missed: one kind of cause, in words, with the numbers that it rests on (SI units, by name).

    `tried` is how many other numbers were tried, of which `would_do` did.
    """

    kind: CauseKind
    text: str
    evidence: Mapping[str, Any]
    would_do: tuple[WayOut, ...] = ()
    tried: int = 0

    def as_dict(self) -> dict[str, Any]:
        """Return the cause in the form of `verdict.json`."""
        would_do = [{**asdict(way), "text": str(way)} for way in self.would_do]
        return {**asdict(self), "would_do": would_do, "way_out": self.way_out()}

    def way_out(self) -> str:
        """Return in words what would do; empty where nothing was tried."""
        if self.would_do:
            return f"It happens with {', or with '.join(map(str, self.would_do))}."
        return f"Other numbers tried: {self.tried}; none would do." if self.tried else ""


@dataclass(frozen=True, slots=True)
class Verdict:
    """The judgement of one run: whether it happened as described, and, apart from that, what came of it.

    `cause` is why it missed, where that was asked.
    """

    conditions: tuple[Condition, ...]
    aftermath: Aftermath
    facts: Mapping[str, Any]
    cause: Cause | None = None

    def holds_at(self, tolerance: Tolerance) -> bool:
        """Whether every condition holds within the tolerance."""
        return all(condition.holds_at(tolerance) for condition in self.conditions)

    def condition(self, condition_id: str) -> Condition:
        """Return the condition with this id; raises KeyError where there is none."""
        for condition in self.conditions:
            if condition.id == condition_id:
                return condition
        raise KeyError(condition_id)

    def as_dict(self) -> dict[str, Any]:
        """Return the verdict in the form of `verdict.json`."""
        return {
            "schema_version": SCHEMA_VERSION,
            "success": {"tight": self.holds_at(TIGHT), "loose": self.holds_at(LOOSE)},
            "conditions": [condition.as_dict() for condition in self.conditions],
            "aftermath": _plain(self.aftermath.as_dict()),
            "cause": _plain(self.cause.as_dict()) if self.cause is not None else None,
            "facts": _plain(dict(self.facts)),
        }


def bounded(
    condition_id: str,
    kind: Kind,
    text: str,
    *,
    required: float | None,
    measured: float | None,
    error: float,
    dimension: Dimension | None,
    exact: bool = False,
    owed_by: str | None = None,
) -> Condition:
    """Return a condition on one quantity; `exact` where no tolerance applies to it."""
    miss = Leaf(abs(error), None if exact else dimension)
    return Condition(condition_id, kind, text, required, measured, error, unit_symbol(dimension), miss, owed_by)


def unjudged(condition_id: str, kind: Kind, text: str, reason: str) -> Condition:
    """Return a condition that fails because it cannot be judged, and says why."""
    return Condition(condition_id, kind, f"{text} (not judged: {reason})", None, None, None, "", None)


def _plain(value: Any) -> Any:
    """Return `value` as JSON knows it: no infinities, no arrays' scalars."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, bool | int | str) or value is None:
        return value
    number = float(value)
    return number if math.isfinite(number) else None
