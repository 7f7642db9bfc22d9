"""Which model is asked."""

from __future__ import annotations

from typing import Any

from scenewright.language.model.settings import TranslatorSettings


def model_named(translator: str, settings: TranslatorSettings) -> Any:
    """Return the model that `translator` names; None for the offline reader."""
    return None
