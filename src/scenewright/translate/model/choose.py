"""Which model is asked, and with which key: what is named, else what the environment or the settings file configures.

What enters: the name of a translator, settings. What leaves: a `Model` of which nothing has been asked yet; what there
is, for `scenewright models`; keys, from the environment or a keyring, and `scrubbed` texts. Keys are in no option, no
file of ours, no message.
"""

from __future__ import annotations

import os
import re
import tomllib
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from scenewright.errors import InputError, Place
from scenewright.translate.model.exchange import Answer, Call, Message, Model, TranslatorSettings

# By provider: where its key is looked for, in this order. `openai-compatible` has one of its own: the key of a provider
# never goes to another server because both speak one protocol.
KEY_VARIABLES: dict[str, tuple[str, ...]] = {
    "openai": ("OPENAI_API_KEY",),
    "anthropic": ("ANTHROPIC_API_KEY",),
    "google": ("GOOGLE_API_KEY", "GEMINI_API_KEY"),
    "openai-compatible": ("SCENEWRIGHT_API_KEY",),
}
_SHORTEST = 4  # a shorter "key", such as the "x" of a local server, would blot out half of every message
_SEEN: set[str] = set()  # the keys that were given out
_LOOKS_LIKE_A_KEY = re.compile(r"\b(?:sk|pk|AIza|gsk|xai)[-_][\w-]{6,}|\bAIza[\w-]{20,}|(?i:\bbearer\s+[\w.~+/=-]{6,})")
AUTO, OFFLINE, FILES = "auto", "offline", "files"
TRANSLATORS = f"{AUTO}, {OFFLINE}, {', '.join(f'{each}:NAME' for each in KEY_VARIABLES)} or files:DIR"
TRANSLATOR_VARIABLE, BASE_URL_VARIABLE = "SCENEWRIGHT_TRANSLATOR", "SCENEWRIGHT_BASE_URL"
_TRIAL_TOKENS = 1000  # for one word; models that think before they write count that too


@dataclass(frozen=True, slots=True)
class Configured:
    """What `auto` stands for, where it comes from, and the address of its server where one is given."""

    translator: str
    source: str
    base_url: str | None = None


def settings_file() -> Path:
    """Return where the settings file lies on this platform, whether or not it is there."""
    from typer import get_app_dir

    return Path(get_app_dir("scenewright")) / "settings.toml"


def configured() -> Configured:
    """Return what `auto` stands for: the environment's translator, else that of the settings file, else offline.

    Raises InputError where the settings file cannot be read, or holds what it should not.
    """
    path = settings_file()
    try:
        kept = tomllib.loads(path.read_text(encoding="utf-8"))
        if not all(name in ("translator", "base_url") and isinstance(value, str) for name, value in kept.items()):
            raise ValueError(f"it holds {', '.join(kept)}")
    except (FileNotFoundError, NotADirectoryError):
        kept = {}
    except (OSError, ValueError) as error:
        expected = 'translator = "PROVIDER:NAME", base_url = "http://..."; keys stay in the environment or a keyring'
        message, place = "the settings file cannot be read", Place(str(path))
        raise InputError(message, place=place, found=str(error), expected=expected) from None
    address = os.environ.get(BASE_URL_VARIABLE, "").strip() or kept.get("base_url")
    if named := os.environ.get(TRANSLATOR_VARIABLE, "").strip():
        return Configured(named, TRANSLATOR_VARIABLE, address)
    source = str(path) if "translator" in kept else "nothing is configured"
    return Configured(kept.get("translator", OFFLINE), source, address)


def model_named(translator: str, settings: TranslatorSettings) -> Model | None:
    """Return the model that `translator` names, recorded or replayed as `settings` say; None for the offline reader.

    Raises InputError where there is no such translator, or the settings contradict each other.
    """
    if settings.record is not None and settings.replay is not None:
        raise InputError("exchanges are either recorded or replayed", found="--record and --replay", fix="give one")
    if translator == AUTO:
        translator = configured().translator
    if translator == OFFLINE:
        return None
    provider, _, name = (part.strip() for part in translator.partition(":"))
    known = provider in (*KEY_VARIABLES, FILES)
    if not (known and name):
        message = f"{provider} is named without a model" if known else f"there is no translator {translator}"
        raise InputError(message, found=translator, expected=TRANSLATORS, fix=f"--translator {OFFLINE}")
    from scenewright.translate.model.files import answering_by_files, recording, replayed
    from scenewright.translate.model.providers import ServedModel

    address = settings.base_url or (configured().base_url if provider == "openai-compatible" else None)
    served = ServedModel(provider, name, address, settings.timeout_s, settings.max_tokens)
    by_files = provider == FILES
    model = answering_by_files(Path(name), settings.reply_wait_s) if by_files else Model(served.name, served.reply)
    if settings.replay is not None:
        return replayed(model.name, settings.replay)
    return model if settings.record is None else recording(model, settings.record)


def tried(found: Configured) -> Answer | None:
    """Return what the configured model says to one short call; None for files. Raises as the model does."""
    model = model_named(found.translator, TranslatorSettings(max_tokens=_TRIAL_TOKENS))
    if model is None or model.name == FILES:
        return None
    said = Message("system", "This is a trial of the connection."), Message("user", "Reply with the word: ready")
    return model.reply(Call(said, "", 1, ""))


# -- keys -------------------------------------------------------------------------------------------------------------
def key_for(provider: str) -> str | None:
    """Return the key of `provider`: from the environment, else from a keyring; None where a local server needs none.

    Raises InputError where there is no key and one is needed.
    """
    names = KEY_VARIABLES[provider]
    found = next(filter(None, (os.environ.get(name, "").strip() for name in names)), None) or _from_keyring(provider)
    if found is None and provider != "openai-compatible":
        expected = f"{' or '.join(names)} in the environment, or {provider} under scenewright in a keyring"
        fix = f"export {names[0]}=..., or translate with --translator offline"
        raise InputError(f"there is no key for {provider}", expected=expected, fix=fix)
    _SEEN.add(found or "")
    return found


def scrubbed(text: str) -> str:
    """Return `text` without any key: neither those that were given out nor what looks like one."""
    for value in _SEEN:
        text = text.replace(value, "[key]") if len(value) >= _SHORTEST else text
    return _LOOKS_LIKE_A_KEY.sub("[key]", text)


def _from_keyring(provider: str) -> str | None:
    """Return the key from the system's keyring, where the package `keyring` is installed and has one."""
    try:
        return import_module("keyring").get_password("scenewright", provider) or None
    except Exception:  # no such package, no keyring on this machine, a locked one: no key from there
        return None
