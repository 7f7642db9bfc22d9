"""The command `scenewright`: what is typed comes in, text for people or JSON for programs and an exit status leave.

`main` is the way in; `app` names the commands. Commands import what they need when they run, so that a start is quick.
Nothing here translates, solves, simulates or judges: it asks `orchestrate` and prints what came of it.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

INTERRUPTED = 130
BROKEN_PIPE = 141


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and leave the process with its exit status.

    Parameters
    ----------
    arguments
        What is typed after the command's name; those of the process where None.
    """
    try:
        from scenewright.cli.app import app

        words = list(sys.argv[1:] if arguments is None else arguments)
        try:
            app(args=_debug_first(words), prog_name="scenewright")
        except SystemExit as leaving:
            if "--json" in words:
                _tell_misuse(leaving)
            raise
    except KeyboardInterrupt:  # while the command itself was starting; commands say more about what they kept
        sys.exit(INTERRUPTED)
    except BrokenPipeError:
        from scenewright.cli.console import drop_output

        drop_output()
        sys.exit(BROKEN_PIPE)


def _tell_misuse(leaving: SystemExit) -> None:
    """Print as JSON, for programs, what was wrong with the words typed; whatever a command says it has said itself."""
    message = getattr(leaving.__context__, "format_message", None)
    if message is None:
        return
    from scenewright.cli.console import print_json

    fault = {"error": "UsageError", "message": message()}
    print_json({"status": "error", "exit_status": leaving.code, "error": fault})


def _debug_first(words: list[str]) -> list[str]:
    """Let ``--debug`` stand anywhere: it is an option of the whole command."""
    end = words.index("--") if "--" in words else len(words)
    if "--debug" not in words[:end]:
        return words
    return ["--debug", *(word for word in words[:end] if word != "--debug"), *words[end:]]
