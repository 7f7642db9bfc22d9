"""Asks the server of a provider, through pydantic-ai; every fault becomes a message in house form.

What enters: calls. What leaves: the text of a reply with its tokens. Where a model takes a JSON schema, the reply keeps
to it. No tool and no code of a model has any effect here.
"""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Coroutine, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from scenewright.errors import InputError, MissingExtraError, ScenewrightError, TranslationError
from scenewright.translate.model.choose import KEY_VARIABLES, key_for, scrubbed
from scenewright.translate.model.exchange import (
    CUT_OFF,
    DEFAULT_MAX_TOKENS,
    DEFAULT_TIMEOUT_S,
    Answer,
    Call,
    GaveUpError,
    Usage,
)

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.messages import ModelMessage, ModelResponse
    from pydantic_ai.models import Model as LibraryModel

_RETRIES = 2  # where a server is busy, at fault or out of reach; waits are those that it asks for
_OFFLINE = "translate with --translator offline"


@dataclass(frozen=True, slots=True)
class ServedModel:
    """A model behind the server of a provider, or behind the one at `base_url`."""

    provider: str
    model: str
    base_url: str | None = None
    timeout_s: float = DEFAULT_TIMEOUT_S  # for one reply, all waits included
    max_tokens: int = DEFAULT_MAX_TOKENS

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
        from pydantic_ai.exceptions import ModelHTTPError

        async with asyncio.timeout(self.timeout_s), httpx2.AsyncClient(timeout=self.timeout_s) as client:
            model = self._library_model(key, client)
            form = call.schema if model.profile.get("supports_json_schema_output") else None
            try:
                response = await self._request(model, call, form)
            except ModelHTTPError as error:  # of a server or a model that takes no schema, or not this one
                if not form or error.status_code not in (400, 422):
                    raise
                response = await self._request(model, call, None)
        text, used = scrubbed(response.text or ""), response.usage
        if response.finish_reason == "content_filter":
            raise self._declined(text or str((response.provider_details or {}).get("refusal") or ""))
        if response.finish_reason == "length" and not text.rstrip().endswith("}"):
            text += f"\n{CUT_OFF}"  # within the text, so that it goes back like any other reply that does not hold
        return Answer(text, Usage(1, used.input_tokens, used.output_tokens))

    async def _request(self, model: LibraryModel, call: Call, form: Mapping[str, Any] | None) -> ModelResponse:
        from pydantic_ai.direct import model_request
        from pydantic_ai.models import ModelRequestParameters
        from pydantic_ai.output import OutputObjectDefinition

        # A setting that a model does not have is left out.
        options: Any = {"max_tokens": self.max_tokens, "temperature": 0.0, "cache": True, "max_retries": _RETRIES}
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

    def _declined(self, said: str) -> TranslationError:
        found, fix = _line(said) or "a content filter of the provider", f"say it in other words, or {_OFFLINE}"
        return TranslationError(f"{self.name} declined to answer", found=found, fix=fix)

    def _told(self, error: Exception) -> ScenewrightError:
        """Return the fault in words of the user for what the library raised, by the kinds that it tells apart."""
        from pydantic_ai import exceptions as library

        if isinstance(error, library.ContentFilterError):
            return self._declined(str(error))
        key, refused, gave_up = " or ".join(KEY_VARIABLES[self.provider]), TranslationError, GaveUpError
        kinds: tuple[tuple[Any, type[TranslationError], str, str], ...] = (
            ((TimeoutError, library.ModelTimeoutError), gave_up, "{} did not answer in time",
             f"allow more than {self.timeout_s:g} s with --timeout SECONDS, or {_OFFLINE}"),
            (library.ModelAuthenticationError, refused, "the server of {} does not accept the key",
             f"check the key in {key}"),
            (library.ModelNotFoundError, refused, "the server knows no {}",
             "check the model's name, and the address where --base-url gives one (most end in /v1)"),
            (library.ModelQuotaExceededError, refused, "what {} may cost is used up", "see what the provider says"),
            (library.ModelConnectionError, gave_up, "the server of {} is out of reach, or broke off",
             f"check that it runs and that its address is right, or {_OFFLINE}"),
            (library.ModelRequestRejectedError, refused, "the server does not take the request to {}",
             "check the model's name and limits, or try another model"),
            ((library.ModelRateLimitError, library.ModelUnavailableError, library.ModelServerError), gave_up,
             "the server of {} is busy or at fault", f"try it later, or {_OFFLINE}"),
            (Exception, refused, "what {} sent is no reply", "check the address and the model"),
        )  # fmt: skip
        _, made, message, fix = next(each for each in kinds if isinstance(error, each[0]))
        status = f"HTTP {error.status_code}: " if isinstance(error, library.ModelHTTPError) else ""
        found = status + _line(str(getattr(error, "body", None) or error))
        return made(message.format(self.name), found=found or type(error).__name__, fix=fix)


def check_address(provider: str, base_url: str | None) -> None:
    """Raise InputError where an address is missing, is none, or holds a password."""
    if base_url is None and provider != "openai-compatible":
        return
    sane, secret = False, None
    with suppress(ValueError):
        parts = urlsplit(base_url or "")
        secret = parts.username or parts.password
        sane = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
    if secret:
        fix = f"put the key into {KEY_VARIABLES[provider][0]}"
        raise InputError("an address must not hold a key or a password", fix=fix)
    if not sane:
        message, found = f"there is no address for {provider}", scrubbed(base_url or "") or None
        expected = "the address of a server that speaks the protocol, such as http://127.0.0.1:8000/v1"
        fix = "--base-url URL, SCENEWRIGHT_BASE_URL in the environment, or base_url in the settings file"
        raise InputError(message, found=found, expected=expected, fix=fix)


def _run(asked: Coroutine[Any, Any, Answer]) -> Answer:
    """Run a coroutine to its end, also where the caller is inside an event loop already (a notebook)."""
    try:
        asyncio.get_running_loop()
    except RuntimeError:
        return asyncio.run(asked)
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, asked).result()


def _history(call: Call) -> list[ModelMessage]:
    from pydantic_ai.messages import ModelRequest, ModelResponse, SystemPromptPart, TextPart, UserPromptPart

    asked = {"system": SystemPromptPart, "user": UserPromptPart}
    return [
        ModelRequest([asked[each.role](each.content)])
        if each.role in asked
        else ModelResponse([TextPart(each.content)])
        for each in call.messages
    ]


def _line(text: str) -> str:
    """Return a server's words on one line, short, without keys and without signs that could steer a terminal."""
    clean = "".join(c if c.isprintable() else " " for c in scrubbed(text))
    return " ".join(clean.split())[:300]
