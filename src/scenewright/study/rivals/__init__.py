"""Other ways to stage a scenario, run on the same cases, against the same egos, before the same judge.

What enters: the name of a method and a `Request`. What leaves: a `Result`, as `orchestrate` returns it. Importing this
package loads nothing; the methods are loaded when one is run.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scenewright.request import Request, Result

METHODS: dict[str, str] = {
    "scenewright": "plans, and re-solves in closed loop; may rehearse",
    "open-loop": "carries out the first plan whatever the ego does",
    "smt": "the paper's own loop: an SMT solver at every tick, one rate a piece, tolerances that give way",
    "trigger-action": "distance and time conditions start a fixed manoeuvre, as OpenSCENARIO engines do it",
    "synchronise": "sets the hero's speed so that it arrives when the ego does, as SynchronizeAction does",
    "rejection": "samples the hero's first state until a run succeeds",
    "follower": "a driver model follows the waypoint that the plan gives 4 s ahead, re-issued once a second",
}

# Those that ask `orchestrate` for something else than it does by itself.
_ASKS: dict[str, dict[str, Any]] = {"open-loop": {"mode": "open"}, "smt": {"mode": "closed", "planner": "smt"}}


def request_of(method: str, request: Request) -> Request:
    """Return what a method makes of a request before it carries it out."""
    return replace(request, **_ASKS.get(method, {}))


def check_method(method: str) -> None:
    """Raise `InputError` or `PolicyError` where there is no such method, or where it takes no such option."""
    from scenewright.study.rivals.methods import check

    check(method)


def run_method(method: str, request: Request) -> Result:
    """Carry out `request` by one of `METHODS`.

    Parameters
    ----------
    method
        A key of `METHODS`. ``rejection:N`` draws N samples at most; ``follower:module:Class[:k=v,...]`` puts one's own
        driver model in the follower's place.

    Returns
    -------
    Result
        ``infeasible`` where the same check that `orchestrate` makes has refuted the scenario, whatever the method.

    Raises
    ------
    InputError
        Where there is no such method.
    ScenewrightError
        Where the request is wrong, as `orchestrate` does.
    """
    from scenewright.study.rivals.methods import run

    return run(method, request)
