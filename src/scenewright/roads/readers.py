"""Map readers, found by the ending of a file: the one for OpenDRIVE, and those of installed packages.

What enters: an ending such as ``.xodr``. What leaves: a reader, imported then and not before. A package offers one by
an entry point of the group ``scenewright.map_readers``, named like the ending without its dot. What the reader needs
besides may be an extra of that package: ``osm = "package.module:read [osm]"``.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import cast

from scenewright.errors import MapError, told_by
from scenewright.plugins import missing_extra, named, points
from scenewright.roads.model import RoadMap

MapReader = Callable[[Path], RoadMap]
GROUP = "scenewright.map_readers"
_OURS = (EntryPoint("xodr", "scenewright.roads.opendrive:load_opendrive", GROUP),)


def endings() -> tuple[str, ...]:
    """Return the endings of the files that can be read, such as ``.xodr``; nothing is imported for that."""
    return tuple(sorted(f".{name}" for name in points(GROUP, _OURS)))


def reader_for(ending: str) -> MapReader | None:
    """Return the reader of files with this ending, or None where nobody offers one.

    Raises
    ------
    MissingExtraError
        Where the reader needs something that is not installed.
    MapError
        Where it cannot be imported.
    """
    point = named(ending.lower().removeprefix("."), GROUP, _OURS)
    if point is None:
        return None
    missing = missing_extra(point, f"reads .{point.name} files")
    if missing is not None:
        raise missing
    try:
        return cast("MapReader", point.load())
    except (Exception, SystemExit) as error:  # whatever a plug-in does at import is its fault
        raise MapError(
            f"the reader of {ending} files cannot be imported",
            found=told_by(error),
            expected=f"a function in {point.value}",
            fix="repair or reinstall the package that offers it",
        ) from error
