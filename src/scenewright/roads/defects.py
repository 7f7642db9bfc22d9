"""Small defects of a map, told in one line for each kind.

What enters: a kind of defect and where it was found, as often as it was. What leaves: the notes of a `RoadMap`. What is
done about a defect is the reader's to decide; what cannot be mended is a `MapError`.
"""

from __future__ import annotations

_SHOWN = 5


class Defects:
    """What a reader mended or left out.

    Examples
    --------
    >>> defects = Defects()
    >>> defects.add("roads without lanes are left out", "road 3")
    >>> defects.add("roads without lanes are left out", "road 8")
    >>> defects.notes()
    ('roads without lanes are left out: road 3; road 8',)
    """

    def __init__(self) -> None:
        self._found: dict[str, dict[str, None]] = {}

    def add(self, what_is_done: str, where: str) -> None:
        """Remember one defect; `what_is_done` names its kind and is the same for all of a kind."""
        self._found.setdefault(what_is_done, {})[where] = None

    def notes(self) -> tuple[str, ...]:
        """Return one line for each kind, in the order in which they were met."""
        return tuple(f"{what}: {_listed(list(places))}" for what, places in self._found.items())


def _listed(places: list[str]) -> str:
    more = len(places) - _SHOWN
    return "; ".join(places[:_SHOWN]) + (f"; and {more} more" if more > 0 else "")
