"""`judge` and `view`: a run that is there already, judged again or looked at.

What enters: a run directory. What leaves: a verdict and its file, or the run's page in a browser.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli.console import print_json, stdout
from scenewright.cli.directories import run_status
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson, FailOnOption, RunDirectory, ToleranceOption

if TYPE_CHECKING:
    from rich.console import Console


def judge(
    directory: RunDirectory,
    tolerance: ToleranceOption = "tight",
    fail_on: FailOnOption = None,
    as_json: AsJson = False,
) -> None:
    """Judge a run again, from its trace and program alone, and rewrite its verdict.json and the page that shows it."""
    with told(as_json):
        from scenewright.cli.running import fails_on, report_verdict, tell_fails_on
        from scenewright.judge.files import VERDICT_FILE, cause_told, read_case, write_verdict
        from scenewright.judge.judgement import judge as judge_case
        from scenewright.judge.tolerance import TIGHT
        from scenewright.studio.page import PAGE_FILE, write_page

        case = read_case(directory)
        verdict = judge_case(case)
        if not verdict.holds_at(TIGHT):  # why it missed was found by driving, which is not done again
            verdict = replace(verdict, cause=cause_told(directory))
        write_verdict(verdict, directory / VERDICT_FILE)
        if (directory / PAGE_FILE).is_file():
            write_page(directory)
        data = verdict.as_dict()
        success = data["success"][tolerance]
        status = 0 if success and not fails_on(verdict, fail_on) else 1
        if as_json:
            print_json(data)
        else:
            report_verdict(stdout(), verdict, tolerance, run_status(directory))
            tell_fails_on(stdout(), status, success)
        raise typer.Exit(status)


def view(
    directory: RunDirectory,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page, or only say where it is.")] = (
        True
    ),
) -> None:
    """Open a run's page in the browser; it is written first where it is missing."""
    with told():
        from scenewright.studio.page import PAGE_FILE, write_page

        page = directory / PAGE_FILE
        if not page.is_file():
            _must_be_a_folder(directory)
            write_page(directory)
        console = stdout()
        console.print(str(page), soft_wrap=True)
        if browser:
            open_in_browser(page, console)


def open_in_browser(page: Path, console: Console) -> None:
    """Open a page, or say that there is no browser to open it with."""
    import webbrowser

    if not webbrowser.open(page.resolve().as_uri()):
        console.print("no browser could be started: open that file in one yourself")


def _must_be_a_folder(directory: Path) -> None:
    from scenewright.errors import InputError, Place

    if not directory.is_dir():
        raise InputError(
            "there is no run directory here",
            place=Place(str(directory)),
            expected="a folder that `scenewright run` wrote",
            fix="give the folder that `scenewright run` named, such as runs/001-demo",
        )
