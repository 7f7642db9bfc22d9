"""Files of JSON lines that outlive a kill: each line goes out in one write, and one that was torn is dropped.

What enters: plain data, line by line. What leaves: the lines that are whole. What they mean is the reader's affair.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from scenewright.errors import OutputError, Place


def read_lines(path: Path) -> list[bytes]:
    """Return the lines of a file, none where there is no file; what follows the last line break was torn by a kill."""
    return path.read_bytes().split(b"\n")[:-1] if path.exists() else []


class LineLog:
    """Appends to a file of JSON lines, which is made where there is none; a torn last line is cut off first."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        os.truncate(self._file, path.read_bytes().rfind(b"\n") + 1)

    def append(self, data: Mapping[str, Any]) -> None:
        """Write one line; it is with the system when this returns."""
        line = (json.dumps(data, ensure_ascii=False, allow_nan=False) + "\n").encode()
        if os.write(self._file, line) != len(line):
            raise OutputError("a line could not be written whole", place=Place(str(self._path)), fix="make room")

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)
