"""The HTTP client under every provider: it bounds what is read, waits as a busy server asks, and remembers what failed.

What enters: requests of a provider's library. What leaves: whole responses, or `Trouble` in words that any user
understands. It knows no provider and no protocol beyond HTTP.
"""

from __future__ import annotations

import asyncio
import email.utils
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import httpx2

LARGEST_BODY = 2_000_000  # bytes; a reply with its usage is some ten thousand
TRIES = 3
FIRST_WAIT_S = 0.5
_BUSY = frozenset({408, 429, 500, 502, 503, 504, 529})
_EXCERPT = 4_000  # long enough that a key in it is whole where it will be shown, and can be taken out


@dataclass(frozen=True, slots=True)
class Trouble:
    """Why no response came, or none that helps.

    Attributes
    ----------
    kind
        ``timeout``, ``connection``, ``cut off``, ``too large``, ``status``.
    status
        The HTTP status, where there is one.
    said
        What the server or the system said of it.
    retry_after_s
        How long (s) the server asks to wait, where that was too long.
    tries
        How often it was tried.
    """

    kind: str
    said: str = ""
    status: int | None = None
    retry_after_s: float | None = None
    tries: int = 1


class TroubleError(Exception):
    """Ends a request that cannot succeed; the library above wraps it, so the client remembers its trouble too."""


class PatientClient(httpx2.AsyncClient):
    """An HTTP client that tries again where that may help, until `deadline_s` seconds from now."""

    def __init__(self, deadline_s: float, say: Callable[[str], None] | None = None, **options: Any) -> None:
        super().__init__(timeout=httpx2.Timeout(deadline_s, connect=min(10.0, deadline_s)), **options)
        self.trouble: Trouble | None = None
        self._until = time.monotonic() + deadline_s
        self._say = say

    async def send(self, request: httpx2.Request, **options: Any) -> httpx2.Response:
        """Return the whole response, of bounded size."""
        options["stream"] = True
        for number in range(1, TRIES + 1):
            response: httpx2.Response | None = None
            try:
                response = await self._whole(await super().send(request, **options), request)
                self.trouble = _of_status(response, number)
            except httpx2.TimeoutException:
                self.trouble = Trouble("timeout", tries=number)
                raise TroubleError from None
            except httpx2.TransportError as error:
                kind = "connection" if isinstance(error, httpx2.ConnectError | httpx2.ProxyError) else "cut off"
                self.trouble = Trouble(kind, str(error), tries=number)
            if self.trouble is None:
                assert response is not None
                return response
            wait_s = self._wait_s(response, number)
            if wait_s is None:
                if response is not None:
                    return response
                raise TroubleError
            if wait_s >= 1.0 and self._say is not None:
                self._say(f"the server is busy; trying again in {wait_s:.0f} s")
            await asyncio.sleep(wait_s)
        raise AssertionError("the last try returns or raises")

    def _wait_s(self, response: httpx2.Response | None, number: int) -> float | None:
        """Return how long to wait before another try; None where there is to be none."""
        assert self.trouble is not None
        if number == TRIES or (response is not None and response.status_code not in _BUSY):
            return None
        asked_s = retry_after_s(response.headers.get("retry-after")) if response is not None else None
        wait_s = FIRST_WAIT_S * 4 ** (number - 1) if asked_s is None else asked_s
        if time.monotonic() + wait_s >= self._until:
            self.trouble = Trouble(
                self.trouble.kind, self.trouble.said, self.trouble.status, asked_s, tries=self.trouble.tries
            )
            return None
        return wait_s

    async def _whole(self, response: httpx2.Response, request: httpx2.Request) -> httpx2.Response:
        body = bytearray()
        try:
            async for chunk in response.aiter_bytes():
                body += chunk
                if len(body) > LARGEST_BODY:
                    self.trouble = Trouble("too large", f"more than {LARGEST_BODY} bytes")
                    raise TroubleError
        finally:
            await response.aclose()
        dropped = ("content-encoding", "content-length", "transfer-encoding")
        headers = [(name, value) for name, value in response.headers.multi_items() if name.lower() not in dropped]
        return httpx2.Response(response.status_code, headers=headers, content=bytes(body), request=request)


def retry_after_s(header: str | None) -> float | None:
    """Return the seconds that a Retry-After header asks for, which may be a number or a date; None where it says none.

    Examples
    --------
    >>> retry_after_s("7")
    7.0
    """
    if header is None:
        return None
    try:
        seconds = float(header)
    except ValueError:
        try:
            seconds = email.utils.parsedate_to_datetime(header).timestamp() - time.time()
        except ValueError:
            return None
    return max(0.0, seconds) if seconds == seconds else None  # a NaN is none


def _of_status(response: httpx2.Response, tries: int) -> Trouble | None:
    if response.status_code < 400:
        return None
    said = response.content[:_EXCERPT].decode("utf-8", errors="replace")
    return Trouble("status", said, response.status_code, tries=tries)
