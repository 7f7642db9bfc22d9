"""What the tests of the model translator share: a server, made-up keys, and `talk`, which says things."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from functools import cache
from http.server import ThreadingHTTPServer
from pathlib import Path

import pytest

# Helpers of these tests alone; import mode `importlib` does not put their folders on the path.
sys.path.insert(0, str(Path(__file__).parent.parent))
sys.path.insert(0, str(Path(__file__).parent))

from talk import KEY, Handler, Server

from scenewright.translate.model import schema, translator


@pytest.fixture
def server() -> Iterator[Server]:
    http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    http.daemon_threads = True
    http.block_on_close = False
    http.handle_error = lambda *_: None  # type: ignore[method-assign]  # a client that hangs up is part of the tests
    state = Server(f"http://127.0.0.1:{http.server_address[1]}/v1")
    http.state = state  # type: ignore[attr-defined]
    thread = threading.Thread(target=http.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
    thread.start()
    yield state
    http.shutdown()
    http.server_close()
    thread.join()


# The form of replies is the same in every request, and takes longer to make than most requests to answer.
form = cache(schema.reply_schema)


@pytest.fixture(autouse=True)
def form_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the form of replies be made once for all tests."""
    monkeypatch.setattr(translator, "reply_schema", form)


@pytest.fixture(autouse=True)
def keys(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Every key is made up, no address comes from outside, and no settings of the user."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.delenv("SCENEWRIGHT_TRANSLATOR", raising=False)
    for name in ("OPENAI_API_KEY", "ANTHROPIC_API_KEY", "GOOGLE_API_KEY", "GEMINI_API_KEY", "SCENEWRIGHT_API_KEY"):
        monkeypatch.setenv(name, KEY)
    for name in ("SCENEWRIGHT_BASE_URL", "OPENAI_BASE_URL", "ANTHROPIC_BASE_URL", "HTTP_PROXY", "http_proxy"):
        monkeypatch.delenv(name, raising=False)
