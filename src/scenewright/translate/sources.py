"""What a user hands over: a file or a text, holding a description or a program.

What enters: words from a command line. What leaves: a checked program, with how it was understood where it was a
description. Who reads a description follows from a name: ``auto``, ``offline``, ``PROVIDER:MODEL`` or ``files:DIR``.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from scenewright.errors import InputError, Place
from scenewright.program.check import check_program
from scenewright.program.limits import TEXT_CHARACTERS
from scenewright.program.types import DEFAULT_MAP, Program
from scenewright.roads.load import load_map
from scenewright.translate.model.exchange import TranslatorSettings

if TYPE_CHECKING:
    from scenewright.translate.understand import Understanding


def read_scenario(
    source: str,
    translator: str = "auto",
    map_name: str | None = None,
    settings: TranslatorSettings | None = None,
) -> tuple[Program, Understanding | None]:
    """Return the program that `source` stands for: a file (`.txt`, `.scene`), a description, or the text of a program.

    A description is read by `translator`: ``auto`` (the model that is configured, else offline), ``offline``,
    ``PROVIDER:MODEL`` or ``files:DIR``. It is about the map `map_name`; where that is None about the one that it names,
    or the T intersection that is shipped. `settings` say what a translator may do and has to keep.

    Raises `TranslationError`, `ProgramError`, `InputError` or `MapError` where it cannot be read or understood.
    """
    text, name = text_of(source)
    if is_program(text):
        from scenewright.program.text import parse_program  # its grammar takes longer to load than a text to read

        program = parse_program(text, name)
        check_program(program, text, name)
        return program, None
    from scenewright.translate.understand import OFFLINE, understand  # a program needs no reader

    settings = settings or TranslatorSettings()
    on = load_map(map_name) if map_name else None
    if translator != OFFLINE:
        from scenewright.translate.model.choose import model_named

        if (model := model_named(translator, settings)) is not None:
            from scenewright.translate.model.translator import understand_by_model

            found = understand_by_model(text, on or load_map(DEFAULT_MAP), name, model, settings)
            return found.program, found
    found = understand(text, on, settings.answers, settings.strict, name, settings.ask)
    return found.program, found


def is_program(text: str) -> bool:
    """Whether `text` is meant as a program rather than as a description: some line begins an actor."""
    begins = ("actor 0", "actor 1", 'scenario "')
    return any(line.strip().lower().startswith(begins) for line in text.splitlines())


def text_of(source: str) -> tuple[str, str]:
    """Return the text that `source` is or names, and what to call it in messages; raises `InputError`."""
    path = Path(source)
    with suppress(OSError, ValueError):  # too long or too odd for a file name: a description
        if source.strip() and path.is_file():
            if path.suffix == ".py":
                expected, fix = "a description, or the text form of a program", "run it, and give what `text()` returns"
                raise InputError("this is Python", place=Place(source), expected=expected, fix=fix)
            return _read_text(path), path.name
    if path.suffix in (".txt", ".scene", ".md") and " " not in source.strip():
        fix = "give the path of a file, or the description itself in quotes"
        raise InputError("there is no such file", place=Place(source), fix=fix)
    return source, "description"


def _read_text(path: Path) -> str:
    """Read a file of text, whatever it is: no more of it than a text may hold."""
    most, place = 4 * TEXT_CHARACTERS, Place(str(path))  # a character takes up to four bytes
    try:
        with path.open("rb") as file:
            read = file.read(most + 1)
        if len(read) > most:
            found, expected = f"more than {most:,} bytes", f"a text of at most {TEXT_CHARACTERS:,} characters"
            message, fix = "the file is too large for a description or a program", "give the file that holds the text"
            raise InputError(message, place=place, found=found, expected=expected, fix=fix)
        return read.decode("utf-8-sig")  # some editors begin a file with a mark of their own
    except (OSError, UnicodeDecodeError) as error:
        message, expected, fix = "the file cannot be read as text", "a text in UTF-8", "save the file as text in UTF-8"
        raise InputError(message, place=place, found=str(error), expected=expected, fix=fix) from None
