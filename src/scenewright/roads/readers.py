"""Map readers, found by the ending of a file: the one for OpenDRIVE, and those of installed packages.

What enters: an ending such as ``.xodr``. What leaves: a reader, imported then and not before. A package offers one by
an entry point of the group ``scenewright.map_readers``, named like the ending without its dot. What the reader needs
besides may be an extra of that package: ``osm = "package.module:read [osm]"``.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib.metadata import EntryPoint, PackageNotFoundError, distribution, entry_points
from pathlib import Path
from typing import cast

from scenewright.errors import MapError, MissingExtraError
from scenewright.roads.model import RoadMap

MapReader = Callable[[Path], RoadMap]
GROUP = "scenewright.map_readers"
# Registered like any other, too; but a source tree that is not installed must be able to read its own maps.
_OURS = (EntryPoint("xodr", "scenewright.roads.opendrive:load_opendrive", GROUP),)
_REQUIREMENT = re.compile(r"""(?P<name>[\w.-]+)[^;]*;\s*extra\s*==\s*['"](?P<extra>[^'"]+)['"]\s*""")


def endings() -> tuple[str, ...]:
    """Return the endings of the files that can be read, such as ``.xodr``; nothing is imported for that."""
    return tuple(sorted(f".{name}" for name in _points()))


def reader_for(ending: str) -> MapReader | None:
    """Return the reader of files with this ending, or None where nobody offers one.

    Raises
    ------
    MissingExtraError
        Where the reader needs something that is not installed.
    MapError
        Where it cannot be imported.
    """
    point = _points().get(ending.lower().removeprefix("."))
    if point is None:
        return None
    _check_extras(point)
    try:
        return cast("MapReader", point.load())
    except Exception as error:  # whatever a plug-in does at import is its fault, and the user should read it
        raise MapError(
            f"the reader of {ending} files cannot be imported",
            found=f"{type(error).__name__}: {error}".splitlines()[0],
            expected=f"a function in {point.value}",
            fix="repair or reinstall the package that offers it",
        ) from error


def _points() -> dict[str, EntryPoint]:
    """Return the entry points by ending; ours go before those of others, so that no package takes their place."""
    theirs = {point.name.lower().removeprefix("."): point for point in entry_points(group=GROUP)}
    return theirs | {point.name: point for point in _OURS}


def _check_extras(point: EntryPoint) -> None:
    package = point.dist.name if point.dist is not None else "scenewright"
    needed = (point.dist.requires if point.dist is not None else None) or []
    for requirement in filter(None, map(_REQUIREMENT.fullmatch, needed)):
        if requirement["extra"] in point.extras and not _is_installed(requirement["name"]):
            part = f"{requirement['name']}, which reads .{point.name} files,"
            raise MissingExtraError(part, requirement["extra"], package)


def _is_installed(package: str) -> bool:
    try:
        distribution(package)
    except PackageNotFoundError:
        return False
    return True
