"""Where keys come from, and how they are kept out of everything that is said.

What enters: a provider's name. What leaves: its key, from the environment or a keyring, and `scrubbed` texts. Keys are
in no option, no file of ours, no message.
"""

from __future__ import annotations

import os
import re
from importlib import import_module

from scenewright.errors import InputError

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
