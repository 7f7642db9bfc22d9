"""`models`: which language model is configured, whether it answers, and what to set where none is.

What enters: the environment and the settings file. What leaves: what was found, never a key, and an honest exit status.
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
        from scenewright.language.model import choose
        from scenewright.language.model.keys import KEY_VARIABLES

        found = choose.configured()
        keys = [name for names in KEY_VARIABLES.values() for name in names if os.environ.get(name, "").strip()]
        facts: dict[str, Any] = {
            "translator": found.translator,
            "from": found.source,
            "address": found.base_url,
            "keys in the environment": keys,
            "settings file": str(choose.settings_file()),
        }
        if found.translator == choose.OFFLINE:  # nothing is wrong with that: it is told what to set
            facts["to set"] = (
                f"{choose.TRANSLATOR_VARIABLE}=PROVIDER:NAME in the environment, or translator = "
                '"PROVIDER:NAME" in the settings file, and the key of the provider; see docs/language-models.md'
            )
            answer, call = None, "not tried: descriptions are read offline"
        else:
            answer, call = choose.tried(found), "not tried: whoever answers by files is no server"
        facts["one call"] = str(answer.usage) if answer else call
        if as_json:
            print_json(facts)
        else:
            shown = {name: ", ".join(value) if isinstance(value, list) else value for name, value in facts.items()}
            stdout().print(tables.facts((name, str(value)) for name, value in shown.items() if value))
