"""A server that speaks the OpenAI protocol, models that say what a test wants, and one description with its reply.

No test needs a network: servers listen on 127.0.0.1, and every key is made up.
"""

from __future__ import annotations

import copy
import json
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler
from typing import Any

from scenewright.translate.model.exchange import Answer, Call

KEY = "sentinel-7c1f-key-of-nobody"
TEXT = (
    "The AV comes out of the driveway and turns right onto the road. A truck travels westbound along the road. "
    "When the AV is 12 m short of the stop line and the truck is 20 m short of the conflict point, "
    "the truck brakes to a stop 5 m before the conflict point."
)
TRIGGER = "the AV is 12 m short of the stop line and the truck is 20 m short of the conflict point"
STORY: dict[str, Any] = {
    "actors": [
        {"name": "ego", "called": ["The AV"], "kind": "car", "way": {
            "words": "The AV comes out of the driveway and turns right onto the road",
            "origin": "driveway", "turn": "right", "destination": "road"}},
        {"name": "truck", "called": ["A truck", "the truck"], "kind": "truck",
         "way": {"words": "A truck travels westbound", "heading": "W"}},
    ],
    "moments": [
        {"name": "start", "conditions": []},
        {"name": "trigger", "conditions": [
            {"actor": "ego", "quantity": "place", "op": "==", "place": {"name": "stop_line"},
             "amount": {"value": "12", "unit": "m", "words": "12 m"}, "words": "the AV is 12 m short of the stop line"},
            {"actor": "truck", "quantity": "place", "op": "==", "place": {"name": "conflict_point"},
             "amount": {"value": "20", "unit": "m", "words": "20 m"},
             "words": "the truck is 20 m short of the conflict point"}]},
        {"name": "stopped", "conditions": [
            {"actor": "truck", "quantity": "speed", "op": "==",
             "amount": {"value": "0", "unit": "m/s", "words": "to a stop"}, "words": "the truck brakes to a stop"},
            {"actor": "truck", "quantity": "place", "op": "==", "place": {"name": "conflict_point"},
             "amount": {"value": "5", "unit": "m", "words": "5 m"},
             "words": "the truck brakes to a stop 5 m before the conflict point"}]},
    ],
    "ego": ["trigger"],
    "deeds": [
        {"actor": "truck", "verb": "drive on", "begins": "start", "ends": "trigger",
         "words": "A truck travels westbound along the road"},
        {"actor": "truck", "verb": "brake", "begins": "trigger", "ends": "stopped",
         "words": "the truck brakes to a stop 5 m before the conflict point"},
    ],
}  # fmt: skip


def reply_to(text: str = TEXT, **more: Any) -> dict[str, Any]:
    """Return a whole reply to the text, as an object; `more` are slots of its story."""
    readings = [{"words": each, "means": "as it says"} for each in text.split(". ")]
    return {"readings": readings, "refusal": None, "story": {**copy.deepcopy(STORY), **more}}


QUESTION = {"slot": "where", "text": "Where does the truck stop?", "alternatives": ["5 m before", "at it"],
            "default": "5 m before", "words": "to a stop 5 m before"}  # fmt: skip
GOOD = json.dumps(reply_to())


@dataclass(slots=True)
class Said:
    """A model that says one text after another, and remembers what it was asked."""

    texts: list[str]
    name: str = "said:so"
    calls: list[Call] = field(default_factory=list)

    def reply(self, call: Call) -> Answer:
        self.calls.append(call)
        text = self.texts[min(len(self.calls), len(self.texts)) - 1]
        return Answer(text)


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
