"""Asks the server of a provider, through pydantic-ai; every fault becomes a message in house form.

What enters: calls. What leaves: the text of a reply with its tokens. Where a model takes a JSON schema, the reply keeps
to it. No tool and no code of a model has any effect here.
"""

from __future__ import annotations

import asyncio
import time
import warnings
from collections.abc import Callable, Coroutine, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from scenewright.errors import InputError, MissingExtraError, ScenewrightError, TranslationError
from scenewright.language.model.exchange import CUT_OFF, Answer, Call, GaveUpError, Usage, estimated_usage
from scenewright.language.model.keys import KEY_VARIABLES, key_for, scrubbed, without_known_keys
from scenewright.language.model.settings import DEFAULT_MAX_TOKENS, DEFAULT_TIMEOUT_S

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.messages import ModelMessage, ModelResponse
    from pydantic_ai.models import Model as LibraryModel

TRIES = 3
FIRST_WAIT_S = 0.5
_OFFLINE = "translate with --translator offline"


@dataclass(frozen=True, slots=True)
class ServedModel:
    """A model behind the server of a provider, or behind the one at `base_url`."""

    provider: str
    model: str
    base_url: str | None = None
    timeout_s: float = DEFAULT_TIMEOUT_S  # for one reply, all waits included
    max_tokens: int = DEFAULT_MAX_TOKENS
    say: Callable[[str], None] | None = None

    @property
    def name(self) -> str:
        """Return what the user calls it."""
        return f"{self.provider}:{self.model}"

    def reply(self, call: Call) -> Answer:
        """Ask the server.

        Raises GaveUpError where it is silent, busy or out of reach, TranslationError where it refuses the key, the
        model or the text, or sends what is no reply; InputError, MissingExtraError where key, address or library miss.
        """
        check_address(self.provider, self.base_url)
        key = key_for(self.provider)
        try:
            return _run(self._ask(call, key))
        except ScenewrightError as error:
            fault = error
        except ImportError:
            fault = MissingExtraError(f"the library that speaks to {self.provider}", "models")
        except Exception as error:  # whatever a library makes of a server's fault; never with its own traceback
            fault = self._told(error)
        raise fault from None

    async def _ask(self, call: Call, key: str | None) -> Answer:
        import httpx2
        from pydantic_ai.exceptions import ModelAPIError, ModelConnectionError, ModelHTTPError

        until, tries = time.monotonic() + self.timeout_s, 0
        async with asyncio.timeout(self.timeout_s), httpx2.AsyncClient(timeout=self.timeout_s) as client:
            model = self._library_model(key, client)
            form = call.schema if model.profile.get("supports_json_schema_output") else None
            while True:
                tries += 1
                try:
                    return self._answer(call, await self._request(model, call, form))
                except ModelAPIError as error:
                    status = error.status_code if isinstance(error, ModelHTTPError) else None
                    if status in (400, 422) and form:  # a server or a model that takes no schema, or not this one
                        form, tries = None, 0
                        continue
                    wait_s = FIRST_WAIT_S * 4 ** (tries - 1) if error.retry_after is None else error.retry_after
                    lost = isinstance(error, ModelConnectionError)
                    passes = lost or (status is not None and (status in (408, 429) or status >= 500))
                    if tries == TRIES or not passes or time.monotonic() + wait_s >= until:
                        raise
                    if wait_s >= 1.0 and self.say is not None:
                        self.say(f"the server is busy; trying again in {wait_s:.0f} s")
                    await asyncio.sleep(wait_s)

    async def _request(self, model: LibraryModel, call: Call, form: Mapping[str, Any] | None) -> ModelResponse:
        from pydantic_ai.direct import model_request
        from pydantic_ai.models import ModelRequestParameters
        from pydantic_ai.output import OutputObjectDefinition

        # Trying again is our own affair, for all providers alike. A setting that a model does not have is left out.
        options: Any = {"max_tokens": self.max_tokens, "temperature": 0.0, "cache": True, "max_retries": 0}
        shape = ModelRequestParameters()
        if form:
            defined = OutputObjectDefinition(dict(form), "reply", strict=True)
            shape = ModelRequestParameters(output_mode="native", output_object=defined)
        with warnings.catch_warnings(action="ignore"):
            return await model_request(model, _history(call), model_settings=options, model_request_parameters=shape)

    def _library_model(self, key: str | None, client: AsyncClient) -> LibraryModel:
        from pydantic_ai.models import infer_model
        from pydantic_ai.providers import infer_provider_class

        access: Any = {"api_key": key or "none", "base_url": self.base_url, "http_client": client}
        if self.provider == "openai-compatible":
            from pydantic_ai.models.openai import OpenAIChatModel
            from pydantic_ai.providers.openai_compatible import OpenAICompatibleProvider

            return OpenAIChatModel(self.model, provider=OpenAICompatibleProvider(self.provider, **access))
        kind = "openai-chat" if self.provider == "openai" else self.provider
        return infer_model(f"{kind}:{self.model}", lambda name: infer_provider_class(name)(**access))

    def _answer(self, call: Call, response: ModelResponse) -> Answer:
        text, used = without_known_keys(response.text or ""), response.usage
        if response.finish_reason == "content_filter":
            raise self._declined(text or str((response.provider_details or {}).get("refusal") or ""))
        if response.finish_reason == "length" and not text.rstrip().endswith("}"):
            # Said within the text, so that it goes back to the model like any other reply that does not hold.
            text += f"\n{CUT_OFF}"
        counted = Usage(1, used.input_tokens, used.output_tokens)
        return Answer(text, counted if used.input_tokens or used.output_tokens else estimated_usage(call, text))

    # -- faults -----------------------------------------------------------------------------------------------------
    def _declined(self, said: str) -> TranslationError:
        found, fix = _line(said) or "a content filter of the provider", f"say it in other words, or {_OFFLINE}"
        return TranslationError(f"{self.name} declined to answer", found=found, fix=fix)

    def _told(self, error: Exception) -> ScenewrightError:
        """Return the fault in words of the user for what the library raised, by the kinds that it tells apart."""
        from pydantic_ai import exceptions as library

        if isinstance(error, library.ContentFilterError):
            return self._declined(str(error))
        if isinstance(error, TimeoutError | library.ModelTimeoutError):
            found, fix = (
                f"no whole reply after {self.timeout_s:g} s",
                f"allow more with --timeout SECONDS, or {_OFFLINE}",
            )
            return GaveUpError(f"{self.name} did not answer in time", found=found, fix=fix)
        if not isinstance(error, library.ModelHTTPError | library.ModelConnectionError):
            found, fix = f"{type(error).__name__}: {_line(str(error))}", "check the address and the model"
            return TranslationError(f"what {self.name} sent is no reply", found=found, fix=fix)
        status = error.status_code if isinstance(error, library.ModelHTTPError) else 500
        where = "the server at --base-url" if self.base_url else f"the server of {self.provider}"
        asked = f"; it asks to wait {error.retry_after:.0f} s" if error.retry_after is not None else ""
        gave_up, refused = GaveUpError, TranslationError
        kinds: list[tuple[bool, type[TranslationError], str, str]] = [
            (isinstance(error, library.ModelAuthenticationError), refused, "the server does not accept the key",
             f"check the key in {' or '.join(KEY_VARIABLES[self.provider])}"),
            (isinstance(error, library.ModelNotFoundError), refused, f"the server knows no {self.name}",
             "check the model's name, and the address where --base-url gives one (most end in /v1)"),
            (isinstance(error, library.ModelRateLimitError), gave_up, f"{where} is busy{asked}",
             "wait and run it again, or allow a longer wait with --timeout SECONDS"),
            (isinstance(error, library.ModelConnectionError), gave_up, f"{where} is out of reach, or broke off",
             f"check that it runs and that its address is right, or {_OFFLINE}"),
            (status >= 500, gave_up, f"{where} is at fault", f"run it again later, or {_OFFLINE}"),
            (True, refused, f"the server does not take the request to {self.name}",
             "check the model's name and limits, or try another model"),
        ]  # fmt: skip
        _, made, message, fix = next(each for each in kinds if each[0])
        code = f"HTTP {status}: " if isinstance(error, library.ModelHTTPError) else ""
        return made(message, found=code + _line(str(error.body or error)), fix=fix)


def check_address(provider: str, base_url: str | None) -> None:
    """Raise InputError where an address is missing, is none, or holds a password."""
    expected = "the address of a server that speaks the protocol, such as http://127.0.0.1:8000/v1"
    if base_url is None:
        if provider == "openai-compatible":
            fix = "--base-url URL, SCENEWRIGHT_BASE_URL in the environment, or base_url in the settings file"
            raise InputError(f"there is no address for {provider}", expected=expected, fix=fix)
        return
    try:
        parts = urlsplit(base_url)
        sane = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
    except ValueError:
        raise InputError("this is no address", found=scrubbed(base_url), expected=expected) from None
    if parts.username or parts.password:
        fix = f"put the key into {KEY_VARIABLES[provider][0]}"
        raise InputError("an address must not hold a key or a password", expected=expected, fix=fix)
    if not sane:
        raise InputError("this is no address", found=scrubbed(base_url), expected=expected)


def _history(call: Call) -> list[ModelMessage]:
    from pydantic_ai.messages import ModelRequest, ModelResponse, SystemPromptPart, TextPart, UserPromptPart

    history: list[ModelMessage] = []
    waiting: list[Any] = []
    for message in call.messages:
        if message.role == "assistant":
            history += [ModelRequest(parts=waiting), ModelResponse(parts=[TextPart(message.content)])]
            waiting = []
        else:
            waiting.append((SystemPromptPart if message.role == "system" else UserPromptPart)(message.content))
    return [*history, ModelRequest(parts=waiting)]


def _run(asked: Coroutine[Any, Any, Answer]) -> Answer:
    """Run a coroutine to its end, also where the caller is inside an event loop already (a notebook)."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return asyncio.run(asked)
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, asked).result()


def _line(text: str) -> str:
    """Return a server's words on one line, short, without keys and without signs that could steer a terminal."""
    clean = "".join(c if c.isprintable() else " " for c in scrubbed(text))
    return " ".join(clean.split())[:300]
