"""Find a map by name or path and read it, once per process.

What enters: the name of a map that comes with Scenewright, or a file. What leaves: a `RoadMap`.
"""

from __future__ import annotations

from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path

from scenewright.errors import MapError
from scenewright.roads.model import RoadMap

_MAPS = Path(__file__).parent / "maps"


def shipped_maps() -> list[str]:
    """Return the names of the maps that come with Scenewright, sorted."""
    return sorted(path.stem for path in _MAPS.glob("*.xodr"))


def load_map(name_or_path: str | Path) -> RoadMap:
    """Read a map.

    Parameters
    ----------
    name_or_path
        A name from `shipped_maps`, or the path of an OpenDRIVE file.

    Returns
    -------
    RoadMap
        The same object for the same unchanged file, as long as the process lives.

    Raises
    ------
    MapError
        If there is no such map, or its file is broken.

    Examples
    --------
    >>> load_map("t_intersection").lanes["3.0.1"].kind
    'driveway'
    """
    text = str(name_or_path)
    source = _MAPS / f"{text}.xodr" if text in shipped_maps() else Path(name_or_path)
    if not source.is_file():
        raise _no_such_map(text, source)
    if source.suffix.lower() != ".xodr":
        raise MapError(
            f"{source.name!r} is not a kind of map that can be read",
            found=f"a file that ends in {source.suffix or 'nothing'!r}",
            expected="an OpenDRIVE file (.xodr), or one of " + ", ".join(shipped_maps()),
            fix="convert the map to OpenDRIVE, or rename it if it is OpenDRIVE",
        )
    return _load(source.resolve(), source.stat().st_mtime_ns)


@lru_cache(maxsize=32)
def _load(source: Path, modified_ns: int) -> RoadMap:
    """Read a file; `modified_ns` is part of the key, so that an edited map is read anew."""
    from scenewright.roads.opendrive import load_opendrive

    return load_opendrive(source)


def _no_such_map(text: str, source: Path) -> MapError:
    close = get_close_matches(text, shipped_maps(), n=1)
    found = f"the folder {text!r}" if source.is_dir() else f"{text!r}, which is neither a file nor a shipped map"
    return MapError(
        "there is no such map",
        found=found,
        expected="an OpenDRIVE file, or one of " + ", ".join(shipped_maps()),
        fix=f"did you mean {close[0]!r}?" if close else "check the path, or take a shipped map",
    )
