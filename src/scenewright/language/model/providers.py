"""Asks the server of a provider, through pydantic-ai; every fault becomes a message in house form.

What enters: calls. What leaves: the text of a reply with its tokens. Where a model takes a JSON schema, the reply keeps
to it. No tool and no code of a model has any effect here. Imported only where a server is asked.
"""

from __future__ import annotations

import asyncio
import threading
import time
import warnings
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from scenewright.errors import InputError, MissingExtraError, ScenewrightError, TranslationError
from scenewright.language.model.exchange import CUT_OFF, Answer, Call, GaveUpError, Usage, estimated_usage
from scenewright.language.model.keys import KEY_VARIABLES, key_for, scrubbed, without_known_keys
from scenewright.language.model.settings import DEFAULT_MAX_TOKENS, DEFAULT_TIMEOUT_S

if TYPE_CHECKING:
    from pydantic_ai.exceptions import ModelAPIError
    from pydantic_ai.messages import ModelMessage, ModelResponse
    from pydantic_ai.models import Model as LibraryModel

TRIES = 3
FIRST_WAIT_S = 0.5
OFFLINE = "translate with --translator offline"


@dataclass(frozen=True, slots=True)
class ServedModel:
    """A model behind a server.

    Attributes
    ----------
    provider, model
        A provider that there are key variables for, and its own name of the model.
    base_url
        Another address than the provider's own; needed for ``openai-compatible``.
    timeout_s
        How long (s) one reply may take, all waits included.
    """

    provider: str
    model: str
    base_url: str | None = None
    timeout_s: float = DEFAULT_TIMEOUT_S
    max_tokens: int = DEFAULT_MAX_TOKENS
    say: Callable[[str], None] | None = None

    @property
    def name(self) -> str:
        """Return what the user calls it."""
        return f"{self.provider}:{self.model}"

    @property
    def settings(self) -> Mapping[str, Any]:
        """Return what else decides on the reply."""
        return {"max_tokens": self.max_tokens}

    def reply(self, call: Call) -> Answer:
        """Ask the server.

        Raises
        ------
        GaveUpError
            Where it is silent, busy or out of reach.
        TranslationError
            Where it refuses the key, the model or the text, or sends what is no reply.
        InputError, MissingExtraError
            Where the key, the address or the library is missing.
        """
        check_address(self.provider, self.base_url)
        key = key_for(self.provider)
        try:
            answer: Answer = _run(lambda: self._ask(call, key))
        except ScenewrightError as error:
            fault = error
        except ImportError:
            fault = MissingExtraError(f"the library that speaks to {self.provider}", "models")
        except TimeoutError:
            fault = self._timed_out()
        except Exception as error:  # whatever a library makes of a server's fault; never with its own traceback
            fault = self._told(error)
        else:
            return answer
        raise fault

    async def _ask(self, call: Call, key: str | None) -> Answer:
        from pydantic_ai.exceptions import ModelAPIError, ModelHTTPError

        until = time.monotonic() + self.timeout_s
        model, form, tries = self._library_model(key), call.schema or None, 0
        if not model.profile.get("supports_json_schema_output"):
            form = None
        async with asyncio.timeout(self.timeout_s):
            while True:
                tries += 1
                try:
                    return self._answer(call, await self._request(model, call, form))
                except ModelAPIError as error:
                    status = error.status_code if isinstance(error, ModelHTTPError) else None
                    if status in (400, 422) and form is not None:  # a server or a model that takes no schema
                        form, tries = None, 0
                        continue
                    wait_s = error.retry_after if error.retry_after is not None else FIRST_WAIT_S * 4 ** (tries - 1)
                    passes = status is None or status in (408, 429) or status >= 500
                    if tries == TRIES or not passes or time.monotonic() + wait_s >= until:
                        raise
                    if wait_s >= 1.0 and self.say is not None:
                        self.say(f"the server is busy; trying again in {wait_s:.0f} s")
                    await asyncio.sleep(wait_s)

    async def _request(self, model: LibraryModel, call: Call, form: Mapping[str, Any] | None) -> ModelResponse:
        from pydantic_ai.direct import model_request
        from pydantic_ai.models import ModelRequestParameters
        from pydantic_ai.output import OutputObjectDefinition

        # Trying again is our own affair, for all providers alike. What a model does not have is left out.
        options: Any = {"max_tokens": self.max_tokens, "temperature": 0.0, "timeout": self.timeout_s, "max_retries": 0}
        options["cache"] = True
        shape = ModelRequestParameters()
        if form is not None:
            defined = OutputObjectDefinition(dict(form), "reply", strict=True)
            shape = ModelRequestParameters(output_mode="native", output_object=defined)
        with warnings.catch_warnings(action="ignore"):
            return await model_request(
                model, _history(call), model_settings=options, model_request_parameters=shape
            )

    def _library_model(self, key: str | None) -> LibraryModel:
        address: dict[str, Any] = {"base_url": self.base_url}
        if self.provider == "anthropic":
            from pydantic_ai.models.anthropic import AnthropicModel
            from pydantic_ai.providers.anthropic import AnthropicProvider

            return AnthropicModel(self.model, provider=AnthropicProvider(api_key=key or "", **address))
        if self.provider == "google":
            from pydantic_ai.models.google import GoogleModel
            from pydantic_ai.providers.google import GoogleProvider

            return GoogleModel(self.model, provider=GoogleProvider(api_key=key or "", **address))
        from pydantic_ai.models.openai import OpenAIChatModel

        if self.provider == "openai":
            from pydantic_ai.providers.openai import OpenAIProvider

            return OpenAIChatModel(self.model, provider=OpenAIProvider(api_key=key, **address))
        from pydantic_ai.providers.openai_compatible import OpenAICompatibleProvider

        provider = OpenAICompatibleProvider("openai-compatible", api_key=key or "none", base_url=self.base_url or "")
        return OpenAIChatModel(self.model, provider=provider)

    def _answer(self, call: Call, response: ModelResponse) -> Answer:
        text = without_known_keys(response.text or "")
        if response.finish_reason == "content_filter":
            raise self._declined(text or str((response.provider_details or {}).get("refusal") or ""))
        if response.finish_reason == "length" and not text.rstrip().endswith("}"):
            # Said within the text, so that it goes back to the model like any other reply that does not hold.
            text += f"\n{CUT_OFF}"
        used = response.usage
        if used.input_tokens or used.output_tokens:
            return Answer(text, Usage(1, used.input_tokens, used.output_tokens))
        return Answer(text, estimated_usage(call, text))

    # -- faults -----------------------------------------------------------------------------------------------------
    def _timed_out(self) -> GaveUpError:
        found = f"no whole reply after {self.timeout_s:g} s"
        return GaveUpError(
            f"{self.name} did not answer in time", found=found, fix=f"allow more with --timeout SECONDS, or {OFFLINE}"
        )

    def _declined(self, said: str) -> TranslationError:
        found = _line(said) or "a content filter of the provider"
        fix = f"say it in other words, or try another model, or {OFFLINE}"
        return TranslationError(f"{self.name} declined to answer", found=found, fix=fix)

    def _told(self, error: Exception) -> ScenewrightError:
        """Return the fault in words of the user for what the library raised, by the kinds that it tells apart."""
        from pydantic_ai import exceptions as library

        if isinstance(error, library.ContentFilterError):
            return self._declined(str(error))
        if isinstance(error, library.ModelTimeoutError | library.ModelRequestTimeout):
            return self._timed_out()
        if not isinstance(error, library.ModelAPIError):
            expected, fix = "a response in the provider's own protocol", "check the address and the model"
            found = f"{type(error).__name__}: {_line(str(error))}"
            return TranslationError(f"what {self.name} sent is no reply", found=found, expected=expected, fix=fix)
        status = error.status_code if isinstance(error, library.ModelHTTPError) else None
        found = " ".join(filter(None, (f"HTTP {status}:" if status else "", _line(str(error.body or error)))))
        asked = f"; it asks to wait {error.retry_after:.0f} s" if error.retry_after is not None else ""
        where = "the server at --base-url" if self.base_url else f"the server of {self.provider}"
        wait = "wait and run it again, or allow a longer wait with --timeout SECONDS"
        keys = f"check the key in {' or '.join(KEY_VARIABLES[self.provider])}"
        name = "check the model's name, and the address where --base-url gives one (most end in /v1)"
        kinds: list[tuple[Any, type[TranslationError], str, str]] = [
            (library.ModelAuthenticationError, TranslationError, "the server does not accept the key", keys),
            (library.ModelNotFoundError, TranslationError, f"the server knows no {self.name}", name),
            (library.ModelRateLimitError, GaveUpError, f"{where} is busy{asked}", wait),
            (library.ModelConnectionError, GaveUpError, f"{where} is out of reach, or broke off",
             f"check that it runs and that its address is right, or {OFFLINE}"),
        ]  # fmt: skip
        for kind, made, message, fix in kinds:
            if isinstance(error, kind):
                return made(message, found=found, fix=fix)
        if status is None or status >= 500:
            return GaveUpError(f"{where} is at fault", found=found, fix=f"run it again later, or {OFFLINE}")
        fix = "check the model's name and limits, or try another model"
        return TranslationError(f"the server does not take the request to {self.name}", found=found, fix=fix)


def check_address(provider: str, base_url: str | None) -> None:
    """Raise InputError where an address is missing, is none, or holds a password."""
    if base_url is None:
        if provider == "openai-compatible":
            raise InputError(
                "there is no address for openai-compatible",
                expected="the address of a server that speaks the OpenAI protocol",
                fix="--base-url http://127.0.0.1:8000/v1, SCENEWRIGHT_BASE_URL, or base_url in the settings file",
            )
        return
    try:
        parts = urlsplit(base_url)
        sane = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
        secret = bool(parts.username or parts.password)
    except ValueError:
        sane = secret = False
    if secret:
        fix = f"put the key into {KEY_VARIABLES[provider][0]}"
        raise InputError("an address must not hold a key or a password", expected="http://HOST:PORT/v1", fix=fix)
    if not sane:
        raise InputError("this is no address", found=scrubbed(base_url), expected="http://HOST:PORT/v1")


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


def _run(ask: Callable[[], Any]) -> Any:
    """Run a coroutine to its end, also where the caller is inside an event loop already (a notebook)."""
    running = False
    with suppress(RuntimeError):
        asyncio.get_running_loop()
        running = True
    if not running:
        return asyncio.run(ask())
    ended: list[tuple[Any, BaseException | None]] = []

    def work() -> None:
        try:
            ended.append((asyncio.run(ask()), None))
        except BaseException as error:
            ended.append((None, error))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    result, failed = ended[0]
    if failed is not None:
        raise failed
    return result


def _line(text: str) -> str:
    """Return a server's words on one line, short, without keys and without signs that could steer a terminal."""
    clean = "".join(c if c.isprintable() else " " for c in scrubbed(text))
    return " ".join(clean.split())[:300]
