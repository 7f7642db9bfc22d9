"""Find a map by name or path and read it, once per process.

What enters: the name of a map that comes with Scenewright, or a file. What leaves: a `RoadMap`. Who reads which kind of
file is known to `readers`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path

import numpy as np

from scenewright.errors import MapError, Place, ScenewrightError, told_by
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
        A name from `shipped_maps`, or the path of a file that a map reader is there for (see `readers`).

    Returns
    -------
    RoadMap
        The same object for the same unchanged file, as long as the process lives.

    Raises
    ------
    MapError
        If there is no such map, or its file is broken.
    MissingExtraError
        If its reader needs something that is not installed.

    Examples
    --------
    >>> load_map("t_intersection").lanes["3.0.1"].kind
    'driveway'
    """
    text = str(name_or_path)
    source = _MAPS / f"{text}.xodr" if text in shipped_maps() else Path(name_or_path)
    if not _answers(source.is_file):
        raise _no_such_map(text, source)
    return _load(source.resolve(), source.stat().st_mtime_ns)


@lru_cache(maxsize=32)
def _load(source: Path, modified_ns: int) -> RoadMap:
    """Read a file; `modified_ns` is part of the key, so that an edited map is read anew."""
    from scenewright.roads.readers import endings, reader_for

    reader = reader_for(source.suffix)
    if reader is None:
        raise MapError(
            f"{source.name!r} is not a kind of map that can be read",
            found=f"a file that ends in {source.suffix or 'nothing'!r}",
            expected=f"a file that ends in {', '.join(endings())}, or one of " + ", ".join(shipped_maps()),
            fix="convert the map to OpenDRIVE (.xodr), or rename it if it is OpenDRIVE",
        )
    try:
        road_map = reader(source)
    except (ScenewrightError, OSError):
        raise
    except (Exception, SystemExit) as error:  # a reader may be anybody's, and a file anything
        raise _reader_broke(source, told_by(error)) from error
    if not isinstance(road_map, RoadMap):
        raise _reader_broke(source, f"it returned a {type(road_map).__name__}")
    for wrong in _wrong_in(road_map):
        raise _reader_broke(source, wrong)
    return road_map


def _wrong_in(road_map: RoadMap) -> Iterator[str]:
    """Yield what no lane graph can be."""
    for lane_id, lane in road_map.lanes.items():
        beside = (each for each in (lane.left_neighbor, lane.right_neighbor) if each is not None)
        for other in (*lane.successors, *lane.predecessors, *beside):
            if other not in road_map.lanes:
                yield f"lane {lane_id} is linked to {other}, which is not there"
        for line in (lane.centerline_xy, lane.left_edge_xy, lane.right_edge_xy):
            if line.ndim != 2 or line.shape[1] != 2 or len(line) < 2 or not np.isfinite(line).all():
                yield f"lane {lane_id} is not drawn by two finite points or more: {line}"


def _answers(question: Callable[[], bool]) -> bool:
    try:
        return question()
    except (OSError, ValueError):  # too long or too odd for the name of a file
        return False


def _reader_broke(source: Path, what: str) -> MapError:
    return MapError(
        f"the reader of {source.suffix} files failed on this one",
        place=Place(source.name),
        found=what,
        expected="a map, or a message that says what is wrong with the file",
        fix="tell those who offer the reader, with the file",
    )


def _no_such_map(text: str, source: Path) -> MapError:
    close = get_close_matches(text, shipped_maps(), n=1)
    is_folder = _answers(source.is_dir)
    found = f"the folder {text!r}" if is_folder else f"{text!r}, which is neither a file nor a shipped map"
    return MapError(
        "there is no such map",
        found=found,
        expected="an OpenDRIVE file, or one of " + ", ".join(shipped_maps()),
        fix=f"did you mean {close[0]!r}?" if close else "check the path, or take a shipped map",
    )
