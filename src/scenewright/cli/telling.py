"""`tell`: what a program or a description says, in plain English that can be read again.

What enters: the options of the command. What leaves: sentences, for people or as JSON.
"""

from __future__ import annotations

from scenewright.cli.console import print_json, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson, MapName, Source


def tell(source: Source, map_name: MapName = None, as_json: AsJson = False) -> None:
    """Tell a program or a description in plain English, a text that can be read again."""
    with told(as_json):
        from scenewright.translate.decompile import decompile
        from scenewright.translate.sources import read_scenario
        from scenewright.translate.tell import tell as told_story

        program, understanding = read_scenario(source, map_name=map_name)
        sentences = told_story(understanding.story if understanding else decompile(program))
        if as_json:
            print_json({"sentences": sentences})
            return
        console = stdout()
        for sentence in sentences:
            console.print(sentence, soft_wrap=True, markup=False, highlight=False)
