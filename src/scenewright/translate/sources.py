"""What a user hands over: a file or a text, holding a description or a program.

What enters: words from a command line. What leaves: a checked program, with its translation where it was a description.
Which translator is asked follows from a name: ``offline``, ``PROVIDER:MODEL`` or ``files:DIR``.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from scenewright.errors import InputError, Place, TranslationError
from scenewright.program.check import check_program
from scenewright.program.limits import TEXT_CHARACTERS, check_description
from scenewright.program.text import parse_program
from scenewright.program.types import DEFAULT_MAP, Program
from scenewright.roads.load import load_map
from scenewright.translate.model.settings import TranslatorSettings

if TYPE_CHECKING:
    from scenewright.roads.model import RoadMap
    from scenewright.translate.model.exchange import Model
    from scenewright.translate.translation import Translation

OFFLINE = "offline"
TRANSLATORS = "offline, openai:NAME, anthropic:NAME, google:NAME, openai-compatible:NAME or files:DIR"
BASE_URL_VARIABLE = "SCENEWRIGHT_BASE_URL"
# What an offline translation takes for granted by convention; whatever else it assumes, --strict refuses.
_CONVENTIONS = re.compile(
    r"'just before' is|is before that place, as seen by|is read as that very amount|sets no number|"
    r"inferred from the map|where it meets the road|is measured from the"
)


def read_scenario(
    source: str,
    translator: str = OFFLINE,
    map_name: str | None = None,
    settings: TranslatorSettings | None = None,
) -> tuple[Program, Translation | None]:
    """Return the program that `source` stands for: a file (`.txt`, `.scene`), a description, or the text of a program.

    Parameters
    ----------
    translator
        ``offline``, ``PROVIDER:MODEL`` or ``files:DIR``; asked only where `source` is a description.
    map_name
        The map that a description is about; the T intersection that is shipped where None.
    settings
        What a translator may do and has to keep; defaults where None.

    Raises
    ------
    TranslationError, ProgramError, InputError, MapError
        Where it cannot be read or understood.
    """
    settings = settings or TranslatorSettings()
    model = None if translator == OFFLINE else model_named(translator, settings)
    text, name = text_of(source)
    if is_program(text):
        program = parse_program(text, name)
        check_program(program, text, name)
        return program, None
    check_description(text, name)
    if model is None:
        translation = _offline(text, load_map(map_name) if map_name else None, name, settings)
    else:
        from scenewright.translate.model.translator import translate_with_model

        translation = translate_with_model(text, load_map(map_name or DEFAULT_MAP), name, model, settings)
    check_program(translation.program)
    return translation.program, translation


def model_named(translator: str, settings: TranslatorSettings) -> Model:
    """Return the model that `translator` names, recorded or replayed as `settings` say; nothing is asked of it yet.

    Raises
    ------
    InputError
        Where there is no such translator, or the settings contradict each other.
    """
    provider, colon, name = (part.strip() for part in translator.partition(":"))
    known = provider in ("openai", "anthropic", "google", "openai-compatible", "files")
    if not (known and colon and name):
        message = f"{provider} is named without a model" if known else f"there is no translator {translator}"
        fix = f"--translator {provider}:NAME" if known else "--translator offline"
        raise InputError(message, found=translator, expected=TRANSLATORS, fix=fix)
    if settings.record is not None and settings.replay is not None:
        raise InputError("exchanges are either recorded or replayed", found="--record and --replay", fix="give one")
    from scenewright.translate.model.files import FilesModel
    from scenewright.translate.model.providers import ServedModel
    from scenewright.translate.model.records import Recording, Replayed

    model: Model
    if provider == "files":
        model = FilesModel(Path(name), settings.reply_wait_s)
    else:
        base_url = settings.base_url
        if base_url is None and provider == "openai-compatible":
            base_url = os.environ.get(BASE_URL_VARIABLE, "").strip() or None
        model = ServedModel(provider, name, base_url, settings.timeout_s, settings.max_tokens, settings.say)
    if settings.replay is not None:
        return Replayed(model.name, model.settings, settings.replay)
    return model if settings.record is None else Recording(model, settings.record)


def is_program(text: str) -> bool:
    """Whether `text` is meant as a program rather than as a description: some line begins an actor."""
    begins = ("actor 0", "actor 1", 'scenario "')
    return any(line.strip().lower().startswith(begins) for line in text.splitlines())


def text_of(source: str) -> tuple[str, str]:
    """Return the text that `source` is or names, and what to call it in messages.

    Raises
    ------
    InputError
        Where it names a file that is not there or is no text.
    """
    path = Path(source)
    looks_like_file = path.suffix in (".txt", ".scene", ".md") and " " not in source.strip()
    try:
        is_file = bool(source.strip()) and path.is_file()
    except (OSError, ValueError):  # too long or too odd for a file name: a description
        is_file = False
    if is_file:
        return _read_text(path), path.name
    if looks_like_file:
        fix = "give the path of a file, or the description itself in quotes"
        raise InputError("there is no such file", place=Place(source), fix=fix)
    return source, "description"


def _read_text(path: Path) -> str:
    """Read a file of text, whatever it is: no more of it than a text may hold."""
    most = 4 * TEXT_CHARACTERS  # a character takes up to four bytes
    try:
        with path.open("rb") as file:
            read = file.read(most + 1)
        if len(read) > most:
            raise InputError(
                "the file is too large for a description or a program",
                place=Place(str(path)),
                found=f"more than {most:,} bytes",
                expected=f"a text of at most {TEXT_CHARACTERS:,} characters",
                fix="give the file that holds the text",
            )
        return read.decode("utf-8-sig")  # some editors begin a file with a mark of their own
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(
            "the file cannot be read as text",
            place=Place(str(path)),
            found=str(error),
            expected="a text in UTF-8",
            fix="save the file as text in UTF-8",
        ) from None


def _offline(text: str, road_map: RoadMap | None, name: str, settings: TranslatorSettings) -> Translation:
    from scenewright.translate.offline import translate_offline

    translation = translate_offline(text, road_map, name)
    matter = [each for each in translation.assumptions if not _CONVENTIONS.search(each)]
    if settings.strict and matter:
        raise TranslationError(
            "the description leaves something open that matters",
            place=Place(name),
            found="; ".join(matter),
            expected="a description that says it, as --strict asks",
            fix="say it in the description, or leave --strict out",
        )
    return translation
