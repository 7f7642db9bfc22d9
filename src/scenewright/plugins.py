"""Parts that packages bring by entry point: listed without importing anything, and without what they miss.

What enters: the name of a group, and our own parts in it. What leaves: entry points by name, and whether an extra of
the package that offers one is missing. A part says what it needs besides as an extra: ``osm = "package.module:read
[osm]"``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib.metadata import EntryPoint, PackageNotFoundError, distribution, entry_points
from types import MappingProxyType
from typing import Any, Generic, TypeVar, cast

from scenewright.errors import InputError, MissingExtraError, ScenewrightError, shown_as, told_by

_REQUIREMENT = re.compile(r"""(?P<name>[\w.-]+)[^;]*;\s*extra\s*==\s*['"](?P<extra>[^'"]+)['"]\s*""")
_OUR_PACKAGE = "scenewright"
Part = TypeVar("Part")


@dataclass(frozen=True, slots=True)
class Kind(Generic[Part]):
    """Parts that the user names, each a class without arguments.

    Attributes
    ----------
    group, ours
        Their entry points: those of packages, and our own, by name.
    noun, does
        What messages call one, and what it does; ``scenewright NOUNs`` lists them.
    fault
        The error where one cannot be imported, or fails at its work.
    capabilities
        The kind of what each says that it can do, as its attribute of that name.
    libraries
        As in `missing_extra`.
    """

    group: str
    ours: Mapping[str, str]
    noun: str
    does: str
    fault: type[ScenewrightError]
    capabilities: type
    libraries: Mapping[str, str] = field(default_factory=dict)

    def known(self) -> dict[str, MissingExtraError | None]:
        """Return those that can be named, each with what it misses; nothing is imported for that."""
        found = points(self.group, self._our_points())
        return {name: missing_extra(point, self.does, self.libraries) for name, point in found.items()}

    def _our_points(self) -> list[EntryPoint]:
        return [EntryPoint(name, value, self.group) for name, value in self.ours.items()]

    def called(self, name: str) -> Part:
        """Return a new one.

        Raises
        ------
        InputError
            Where there is none of that name.
        MissingExtraError
            Where it needs something that is not installed.
        ScenewrightError
            Of the kind `fault`, where it cannot be imported.
        """
        point = named(name.lower(), self.group, self._our_points())
        if point is None:
            raise InputError(
                f"there is no such {self.noun}",
                found=repr(name),
                expected=", ".join(self.known()),
                fix=f"scenewright {self.noun}s lists them",
            )
        missing = missing_extra(point, self.does, self.libraries)
        if missing is not None:
            raise missing
        expected, fix = f"a class without arguments in {point.value}", "repair or reinstall the package that offers it"
        try:
            part = point.load()()
            can = getattr(part, "capabilities", None)
        except (Exception, SystemExit) as error:  # whatever a plug-in does at import is its fault
            what = f"the {self.noun} {name!r} cannot be imported"
            raise self.fault(what, found=told_by(error), expected=expected, fix=fix) from error
        if not isinstance(can, self.capabilities):
            what = f"the {self.noun} {name!r} does not say what it can do"
            expected += f", whose capabilities are {self.capabilities.__module__}.{self.capabilities.__qualname__}"
            raise self.fault(what, found=shown_as(can), expected=expected, fix=fix)
        return cast("Part", part)

    def words(self) -> dict[str, str]:
        """Return what each part can do, in words, or what it misses, or what is wrong with it."""
        told = dict[str, str]()
        for name, missing in self.known().items():
            told[name] = f"{missing.message}: {missing.fix}" if missing is not None else ""
            try:
                told[name] = told[name] or cast(Any, self.called(name)).capabilities.words()
            except ScenewrightError as error:
                told[name] = f"{error.message}: {error.found}"
        return told

    @contextmanager
    def blamed(self, part: Part) -> Iterator[None]:
        """Turn whatever a part raises inside into an error that says whose it is."""
        try:
            yield
        except (ScenewrightError, KeyboardInterrupt):
            raise
        except BaseException as error:  # a part, and what it talks to, may raise anything, and end the process
            what = f"the {self.noun} {type(part).__name__} failed"
            raise self.fault(what, found=told_by(error), fix="repair it, or ask who wrote it") from error

    @contextmanager
    def closing(self, part: Part) -> Iterator[None]:
        """Close a part in the end, whatever went wrong."""
        try:
            yield
        finally:
            with self.blamed(part):
                cast(Any, part).close()


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
