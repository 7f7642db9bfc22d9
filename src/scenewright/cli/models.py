"""`models`: which language model is configured, whether it answers, and what to set where none is.

What enters: the environment and the settings file. What leaves: what was found, never a key; the exit status is that of
the one call, 0 where nothing is configured.
"""

from __future__ import annotations

import os
from typing import Any

from scenewright.cli.console import print_json, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson


def models(as_json: AsJson = False) -> None:
    """Show which language model reads descriptions, and try it with one call."""
    with told(as_json):
        from scenewright.cli import tables
        from scenewright.translate.model import choose

        found = choose.configured()
        keys = [name for names in choose.KEY_VARIABLES.values() for name in names if os.environ.get(name, "").strip()]
        facts: dict[str, Any] = {
            "translator": found.translator,
            "from": found.source,
            "address": found.base_url,
            "keys in the environment": keys,
            "settings file": str(choose.settings_file()),
        }
        if found.translator == choose.OFFLINE:
            facts["to set"] = f"{choose.TRANSLATOR_VARIABLE}=PROVIDER:NAME, or translator in the settings file"
        else:
            answer = choose.tried(found)
            facts["one call"] = str(answer.usage) if answer else "not tried: whoever answers by files is no server"
        if as_json:
            print_json(facts)
        else:
            shown = {name: ", ".join(value) if isinstance(value, list) else value for name, value in facts.items()}
            stdout().print(tables.facts((name, str(value)) for name, value in shown.items() if value))
