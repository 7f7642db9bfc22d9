"""A server that speaks the OpenAI protocol, models that say what a test wants, and one description with its reply.

No test needs a network: servers listen on 127.0.0.1, and every key is made up.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler
from typing import Any

from scenewright.translate.model.exchange import Answer, Call, estimated_usage

KEY = "sentinel-7c1f-key-of-nobody"
TEXT = (
    "The AV comes out of the driveway and turns right onto the road. A truck travels westbound along the road. "
    "When the AV is 12 m short of the stop line and the truck is 20 m short of the conflict point, "
    "the truck brakes to a stop 5 m before the conflict point."
)
PROGRAM = """Actor 0 (ego):
- S, W
- [t0, go, t1, go, t2]

Actor 1 (hero):
- W
- [t0, go, t1, dec, t2]

Constraints:
A0(t1) == A1(t1)
A0x(t1) == stop_line - 12 m
A1x(t1) == conflict_point - 20 m
A1x(t2) == conflict_point - 5 m
A1v(t2) == 0
"""
READINGS = [
    ("The AV comes out of the driveway and turns right onto the road.", []),
    ("A truck travels westbound along the road.", []),
    ("When the AV is 12 m short of the stop line and the truck is 20 m short", ["c1", "c2", "c3"]),
    ("the truck brakes to a stop 5 m before the conflict point", ["c4", "c5"]),
]


def reply_to(
    program: str | None = PROGRAM, readings: list[tuple[str, list[str]]] = READINGS, **more: Any
) -> dict[str, Any]:
    """Return a whole reply, as an object."""
    told = [{"words": words, "understood": "as it says", "constraints": ids} for words, ids in readings]
    return {"program": program, "readings": told, "assumptions": [], "questions": [], "refusal": None, **more}


GOOD = json.dumps(reply_to())


@dataclass(slots=True)
class Said:
    """A model that says one text after another, and remembers what it was asked."""

    texts: list[str]
    name: str = "said:so"
    calls: list[Call] = field(default_factory=list)
    settings: dict[str, Any] = field(default_factory=dict)

    def reply(self, call: Call) -> Answer:
        self.calls.append(call)
        text = self.texts[min(len(self.calls), len(self.texts)) - 1]
        return Answer(text, estimated_usage(call, text))


Act = Callable[["Handler"], None]


@dataclass(slots=True)
class Server:
    """A server that carries out one act for each request, the last one again and again."""

    address: str
    acts: list[Act] = field(default_factory=list)
    asked: list[dict[str, Any]] = field(default_factory=list)
    paths: list[str] = field(default_factory=list)
    headers: list[dict[str, str]] = field(default_factory=list)

    def does(self, *acts: Act) -> None:
        self.acts = list(acts)


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    server: Any

    def do_POST(self) -> None:
        state: Server = self.server.state
        body = self.rfile.read(int(self.headers.get("content-length", 0)))
        state.asked.append(json.loads(body))
        state.paths.append(self.path)
        state.headers.append(dict(self.headers))
        state.acts[min(len(state.asked), len(state.acts)) - 1](self)

    def answer(self, status: int, body: bytes, **headers: str) -> None:
        self.send_response(status)
        self.send_header("content-type", "application/json")
        for name, value in {"content_length": str(len(body)), **headers}.items():
            self.send_header(name.replace("_", "-"), value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *arguments: Any) -> None:
        pass


def completion(text: str | None, **message: Any) -> bytes:
    """Return a response of the OpenAI protocol that says `text`."""
    finish = message.pop("finish", "stop")
    usage = message.pop("usage", {"prompt_tokens": 7000, "completion_tokens": 300, "total_tokens": 7300})
    data: dict[str, Any] = {
        "id": "chatcmpl-1",
        "object": "chat.completion",
        "created": 1700000000,
        "model": "tiny",
        "choices": [
            {"index": 0, "finish_reason": finish, "message": {"role": "assistant", "content": text, **message}}
        ],
    }
    if usage is not None:
        data["usage"] = usage
    return json.dumps(data).encode()


def says(text: str | None = GOOD, **message: Any) -> Act:
    return lambda handler: handler.answer(200, completion(text, **message))


def fails(status: int, said: str = "no", **headers: str) -> Act:
    body = json.dumps({"error": {"message": said, "type": "error", "code": status}}).encode()
    return lambda handler: handler.answer(status, body, **headers)


def breaks_off(handler: Handler) -> None:
    """Promise more than is sent, and hang up."""
    body = completion(GOOD)
    handler.answer(200, body[: len(body) // 2], content_length=str(len(body)))
    handler.close_connection = True


def breaks_off_in_a_stream(handler: Handler) -> None:
    handler.send_response(200)
    handler.send_header("transfer-encoding", "chunked")
    handler.end_headers()
    half = completion(GOOD)[:100]
    handler.wfile.write(b"%x\r\n%s\r\n" % (len(half), half))
    handler.close_connection = True


def is_silent(handler: Handler) -> None:
    time.sleep(3.0)
    handler.close_connection = True


def drips(handler: Handler) -> None:
    """Send a byte at a time for ever: no single wait is long."""
    handler.send_response(200)
    handler.send_header("content-length", "100000")
    handler.end_headers()
    for _ in range(40):
        try:
            handler.wfile.write(b" ")
            handler.wfile.flush()
        except OSError:
            return
        time.sleep(0.1)
