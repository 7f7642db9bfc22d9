"""Driving policies for the ego and reference driver models.

What enters: a policy's name, or a user's class, and what the ego sees at each step. What leaves: what the ego does.
Nothing here knows of programs, plans or solvers. Names are imported on first use.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scenewright.drive.guarded import GuardedPolicy
    from scenewright.drive.loading import LoadedPolicy, load_policy, policy_descriptions
    from scenewright.drive.protocol import EgoMotion, EgoPolicy, EgoStart, Envelope, Observation, VehicleState

_HOME = {
    "EgoMotion": "protocol",
    "EgoPolicy": "protocol",
    "EgoStart": "protocol",
    "Envelope": "protocol",
    "GuardedPolicy": "guarded",
    "LoadedPolicy": "loading",
    "Observation": "protocol",
    "VehicleState": "protocol",
    "load_policy": "loading",
    "policy_descriptions": "loading",
}

__all__ = [
    "EgoMotion",
    "EgoPolicy",
    "EgoStart",
    "Envelope",
    "GuardedPolicy",
    "LoadedPolicy",
    "Observation",
    "VehicleState",
    "load_policy",
    "policy_descriptions",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
