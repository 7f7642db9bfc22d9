"""What a user hands over: a file or a text, holding a description or a program.

What enters: words from a command line. What leaves: a checked program, with its translation where it was a description.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from scenewright.errors import InputError, Place
from scenewright.program.check import check_program
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from scenewright.roads.load import load_map

if TYPE_CHECKING:
    from scenewright.translate.offline import Translation


def read_scenario(
    source: str, translator: str = "offline", map_name: str | None = None
) -> tuple[Program, Translation | None]:
    """Return the program that `source` stands for: a file (`.txt`, `.scene`), a description, or the text of a program.

    Raises
    ------
    TranslationError, ProgramError, InputError
        Where it cannot be read or understood.
    """
    text, name = _text_of(source)
    if is_program(text):
        program = parse_program(text, name)
        check_program(program, text, name)
        return program, None
    if translator != "offline":
        raise InputError(
            f"there is no translator {translator}", found=translator, expected="offline", fix="--translator offline"
        )
    from scenewright.translate.offline import translate_offline

    translation = translate_offline(text, load_map(map_name) if map_name else None, name)
    check_program(translation.program)
    return translation.program, translation


def is_program(text: str) -> bool:
    """Whether `text` is meant as a program rather than as a description: some line begins an actor."""
    return any(line.strip().lower().startswith(("actor 0", "actor 1", "scenario ")) for line in text.splitlines())


def _text_of(source: str) -> tuple[str, str]:
    """Return the text that `source` is or names, and what to call it in messages."""
    path = Path(source)
    looks_like_file = path.suffix in (".txt", ".scene", ".md") and " " not in source.strip()
    try:
        is_file = bool(source.strip()) and path.is_file()
    except (OSError, ValueError):  # too long or too odd for a file name: a description
        is_file = False
    if is_file:
        try:
            return path.read_text(encoding="utf-8"), path.name
        except (OSError, UnicodeDecodeError) as error:
            raise InputError("the file cannot be read as text", place=Place(source), found=str(error)) from None
    if looks_like_file:
        fix = "give the path of a file, or the description itself in quotes"
        raise InputError("there is no such file", place=Place(source), fix=fix)
    return source, "description"
