"""Parts that packages bring by entry point: listed without importing anything, and without what they miss.

What enters: the name of a group, and our own parts in it. What leaves: entry points by name, and whether an extra of
the package that offers one is missing. A part says what it needs besides as an extra: ``osm = "package.module:read
[osm]"``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from importlib.metadata import EntryPoint, PackageNotFoundError, distribution, entry_points
from types import MappingProxyType

from scenewright.errors import MissingExtraError

_REQUIREMENT = re.compile(r"""(?P<name>[\w.-]+)[^;]*;\s*extra\s*==\s*['"](?P<extra>[^'"]+)['"]\s*""")
_OUR_PACKAGE = "scenewright"


def named(name: str, group: str, ours: Iterable[EntryPoint]) -> EntryPoint | None:
    """Return the entry point of a name; nothing that is installed is looked through for ours, which takes its time."""
    return next((point for point in ours if point.name == name), None) or points(group, ours).get(name)


def points(group: str, ours: Iterable[EntryPoint]) -> dict[str, EntryPoint]:
    """Return the entry points of a group by name; ours go before those of others, so that no package takes their place.

    Ours are registered like any other, too; but a source tree that is not installed must have its own parts.
    """
    theirs = {point.name.lower().removeprefix("."): point for point in entry_points(group=group)}
    return theirs | {point.name: point for point in ours}


def missing_extra(
    point: EntryPoint, does: str, libraries: Mapping[str, str] = MappingProxyType({})
) -> MissingExtraError | None:
    """Return the error that names the extra to install; None where the part has all that it needs.

    Parameters
    ----------
    does
        What the missing library does here, such as ``reads .osm files``.
    libraries
        The library of each extra of ours: where we are no installed package, nothing else tells.
    """
    if not point.extras:
        return None
    package = point.dist.name if point.dist is not None else _OUR_PACKAGE
    found = filter(None, map(_REQUIREMENT.fullmatch, _requirements(package)))
    needed = [(each["extra"], each["name"]) for each in found]
    needed += [] if point.dist is not None else list(libraries.items())
    for extra, library in needed:
        if extra in point.extras and not _is_installed(library):
            return MissingExtraError(f"{library}, which {does},", extra, package)
    return None


def _requirements(package: str) -> list[str]:
    return (distribution(package).requires or []) if _is_installed(package) else []


def _is_installed(package: str) -> bool:
    try:
        distribution(package)
    except PackageNotFoundError:
        return False
    return True
