"""Roads: lane graph, map readers, routes with Frenet coordinates and landmarks, conflict points.

What enters: a map's name or file. What leaves: `RoadMap`, `Route`, `Path` and `Conflict`. Nothing here knows of
actors, programs or time. Names are imported on first use, so that importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scenewright.roads.conflicts import Conflict, find_conflict, shared_offset_m
    from scenewright.roads.load import load_map, shipped_maps
    from scenewright.roads.model import Lane, RoadMap
    from scenewright.roads.path import Path
    from scenewright.roads.readers import MapReader
    from scenewright.roads.routes import Route, all_routes, find_route, find_routes

_HOME = {
    "Conflict": "conflicts",
    "find_conflict": "conflicts",
    "shared_offset_m": "conflicts",
    "load_map": "load",
    "shipped_maps": "load",
    "Lane": "model",
    "MapReader": "readers",
    "RoadMap": "model",
    "Path": "path",
    "Route": "routes",
    "all_routes": "routes",
    "find_route": "routes",
    "find_routes": "routes",
}

__all__ = [
    "Conflict",
    "Lane",
    "MapReader",
    "Path",
    "RoadMap",
    "Route",
    "all_routes",
    "find_conflict",
    "find_route",
    "find_routes",
    "load_map",
    "shared_offset_m",
    "shipped_maps",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
