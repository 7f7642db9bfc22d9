"""Which model is asked: the one that is named, else the one that the environment or the settings file configures.

What enters: the name of a translator, settings. What leaves: a `Model` of which nothing has been asked yet; what there
is, for `scenewright models`. Keys are looked for, and never told.
"""

from __future__ import annotations

import os
import sys
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path

from scenewright.errors import InputError, Place
from scenewright.language.model.exchange import Model
from scenewright.language.model.keys import KEY_VARIABLES, key_for
from scenewright.language.model.settings import TranslatorSettings

AUTO, OFFLINE, FILES = "auto", "offline", "files"
TRANSLATORS = f"{AUTO}, {OFFLINE}, {', '.join(f'{each}:NAME' for each in KEY_VARIABLES)} or files:DIR"
TRANSLATOR_VARIABLE, BASE_URL_VARIABLE = "SCENEWRIGHT_TRANSLATOR", "SCENEWRIGHT_BASE_URL"


@dataclass(frozen=True, slots=True)
class Configured:
    """What `auto` stands for, where it comes from, and the address of its server where one is given."""

    translator: str
    source: str
    base_url: str | None = None


def settings_file() -> Path:
    """Return where the settings file lies on this platform, whether or not it is there."""
    home = Path.home()
    if sys.platform == "win32":
        folder = Path(os.environ.get("APPDATA") or home / "AppData" / "Roaming")
    elif sys.platform == "darwin":
        folder = home / "Library" / "Application Support"
    else:
        folder = Path(os.environ.get("XDG_CONFIG_HOME") or home / ".config")
    return folder / "scenewright" / "settings.toml"


def configured() -> Configured:
    """Return what `auto` stands for: the environment's translator, else that of the settings file, else offline.

    Raises
    ------
    InputError
        Where the settings file cannot be read, or holds what it should not.
    """
    path = settings_file()
    kept = _read(path)
    address = os.environ.get(BASE_URL_VARIABLE, "").strip() or kept.get("base_url")
    if named := os.environ.get(TRANSLATOR_VARIABLE, "").strip():
        return Configured(named, TRANSLATOR_VARIABLE, address)
    if "translator" in kept:
        return Configured(kept["translator"], str(path), address)
    return Configured(OFFLINE, "nothing is configured", address)


def _read(path: Path) -> dict[str, str]:
    try:
        kept = tomllib.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        return {}
    except (OSError, ValueError) as error:
        raise InputError("the settings file cannot be read", place=Place(str(path)), found=str(error)) from None
    expected = 'translator = "PROVIDER:NAME", base_url = "http://..."; keys stay in the environment or a keyring'
    if not all(name in ("translator", "base_url") and isinstance(value, str) for name, value in kept.items()):
        names = ", ".join(kept)
        raise InputError("the settings file holds something else", place=Place(str(path)), found=names, expected=expected)
    return kept


def keys_found() -> dict[str, bool]:
    """Return for each provider whether there is a key for it."""
    found = {}
    for provider in KEY_VARIABLES:
        try:
            found[provider] = key_for(provider) is not None
        except InputError:
            found[provider] = False
    return found


def model_named(translator: str, settings: TranslatorSettings) -> Model | None:
    """Return the model that `translator` names, recorded or replayed as `settings` say; None for the offline reader.

    Raises
    ------
    InputError
        Where there is no such translator, or the settings contradict each other.
    """
    if settings.record is not None and settings.replay is not None:
        raise InputError("exchanges are either recorded or replayed", found="--record and --replay", fix="give one")
    found = configured() if translator == AUTO or not settings.base_url else None
    if translator == AUTO:
        translator = found.translator if found else OFFLINE
    if translator == OFFLINE:
        return None
    provider, colon, name = (part.strip() for part in translator.partition(":"))
    known = provider in (*KEY_VARIABLES, FILES)
    if not (known and colon and name):
        message = f"{provider} is named without a model" if known else f"there is no translator {translator}"
        fix = f"--translator {provider}:NAME" if known else f"--translator {OFFLINE}"
        raise InputError(message, found=translator, expected=TRANSLATORS, fix=fix)
    if settings.base_url is None and found is not None and provider == "openai-compatible":
        settings = replace(settings, base_url=found.base_url)
    return _kept(_model(provider, name, settings), settings)


def _model(provider: str, name: str, settings: TranslatorSettings) -> Model:
    if provider == FILES:
        from scenewright.language.model.files import FilesModel

        return FilesModel(Path(name), settings.reply_wait_s)
    from scenewright.language.model.providers import ServedModel

    return ServedModel(provider, name, settings.base_url, settings.timeout_s, settings.max_tokens, settings.say)


def _kept(model: Model, settings: TranslatorSettings) -> Model:
    from scenewright.language.model.records import Recording, Replayed

    if settings.replay is not None:
        return Replayed(model.name, model.settings, settings.replay)
    return model if settings.record is None else Recording(model, settings.record)
