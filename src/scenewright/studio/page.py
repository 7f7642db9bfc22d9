"""Writes a run's page: one self-contained `index.html` that opens offline in any browser.

What enters: a run directory. What leaves: its `index.html`, with styles, scripts and data inside and nothing to fetch.
The page's content security policy allows exactly the one script and the one style sheet by their hashes. The same run
directory gives the same bytes.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

from scenewright.errors import OutputError, Place
from scenewright.studio.page_data import collect

PAGE_FILE = "index.html"
# In this order they make one script: each file uses only what stands before it.
SCRIPTS = ("tools.js", "run.js", "plan_view.js", "charts.js", "replans.js", "tables.js", "page.js")


def write_page(run_dir: Path) -> Path:
    """Write the page of a run.

    Parameters
    ----------
    run_dir
        A run directory; the manifest and the trace must be there, what else is missing the page says.

    Returns
    -------
    Path
        The page's file, ``run_dir / "index.html"``.

    Raises
    ------
    InputError
        If the manifest or the trace is missing or broken.
    OutputError
        If the page cannot be written.
    """
    path = run_dir / PAGE_FILE
    text = render(collect(run_dir))
    try:
        path.write_text(text, encoding="utf-8", errors="replace", newline="\n")
    except OSError as error:
        raise OutputError("the page cannot be written", place=Place(str(path)), found=error.strerror) from None
    return path


def render(data: dict[str, Any]) -> str:
    """Return the page's HTML for data as `page_data.collect` gives it."""
    style = _asset("page.css")
    script = "(() => {\n'use strict';\n" + "\n".join(_asset(name) for name in SCRIPTS) + "\n})();\n"
    policy = f"default-src 'none'; style-src '{_hash(style)}'; script-src '{_hash(script)}'; base-uri 'none'"
    return Template(_asset("page.html")).substitute(
        title=html.escape(str(data.get("name", "run"))),
        policy=policy,
        style=style,
        script=script,
        data=embed_json(data),
    )


def embed_json(data: object) -> str:
    r"""Return `data` as JSON that is safe inside a ``<script>`` element.

    No text in it can close the element or open a comment: ``<``, ``>``, ``&`` and all that is not ASCII are written as
    escapes, which JSON reads back unchanged.

    Raises
    ------
    ValueError
        If the data holds NaN or infinity, which JSON cannot.

    Examples
    --------
    >>> embed_json("</script>")
    '"\\u003c/script\\u003e"'
    """
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def _asset(name: str) -> str:
    return files("scenewright.studio").joinpath("assets", name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"
