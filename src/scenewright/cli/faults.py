"""What happens when something goes wrong: every fault becomes a message and an exit status, never a bare traceback.

What enters: whatever a command raises. What leaves: text on stderr, JSON on stdout where wanted, an exit status.
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

import typer

from scenewright.cli import BROKEN_PIPE, INTERRUPTED
from scenewright.cli.console import drop_output, print_json, stderr
from scenewright.errors import OutputError, ScenewrightError

OUR_FAULT = 70  # EX_SOFTWARE of sysexits.h
debug: ContextVar[bool] = ContextVar("debug", default=False)


@contextmanager
def told(as_json: bool = False) -> Iterator[None]:
    """Turn what goes wrong inside into a message and an exit status."""
    try:
        yield
        sys.stdout.flush()
    except typer.Exit:
        raise
    except ScenewrightError as error:
        tell(error)
        if as_json:
            print_json(error_data(error, error.exit_status))
        raise typer.Exit(error.exit_status) from None
    except KeyboardInterrupt:
        stderr().print("interrupted; nothing was written")
        if as_json:
            print_json({"status": "interrupted", "exit_status": INTERRUPTED})
        raise typer.Exit(INTERRUPTED) from None
    except BrokenPipeError:
        drop_output()
        raise typer.Exit(BROKEN_PIPE) from None
    except OSError as error:  # a full disk, a folder that may not be read: the system says no, and we are not at fault
        what = f"{error.strerror or error}" + (f": {error.filename}" if error.filename else "")
        tell(OutputError("the system refused something", found=what, fix="make room, or check who may write there"))
        drop_output()
        raise typer.Exit(OutputError.exit_status) from None
    except Exception as error:  # whatever else comes is a fault of ours
        _confess(error, as_json)
        raise typer.Exit(OUR_FAULT) from None


def tell(error: ScenewrightError) -> None:
    """Print an error in its house form on stderr; lines are not wrapped, so that the mark stays under its words."""
    from rich.text import Text

    stderr().print(Text.assemble(("error: ", "bold red"), str(error)), soft_wrap=True)


def error_data(error: ScenewrightError, exit_status: int) -> dict[str, object]:
    """Return an error as the JSON that a command prints."""
    return {"status": "error", "exit_status": exit_status, "error": error.as_dict()}


def _confess(error: Exception, as_json: bool) -> None:
    what = (f"{type(error).__name__}: {error}".splitlines() or ["unknown"])[0]
    if debug.get():
        traceback.print_exc()
    hint = "" if debug.get() else "; run it again with --debug for a traceback"
    line = f"a fault of Scenewright itself ({what}); please report it to the project with what you typed{hint}"
    stderr().print(line, style="bold red", soft_wrap=True)
    if as_json:
        print_json({"status": "error", "exit_status": OUR_FAULT, "error": {"error": "InternalError", "message": what}})
