"""Asks the server of a provider, through pydantic-ai; every fault becomes a message in house form.

What enters: calls. What leaves: the text of a reply with its tokens. Only text comes back: no tool, no code, no
structured call of a model has any effect here. Imported only where a server is asked.
"""

from __future__ import annotations

import asyncio
import threading
import warnings
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from scenewright.errors import InputError, MissingExtraError, ScenewrightError, TranslationError
from scenewright.translate.model.exchange import CUT_OFF, Answer, Call, GaveUpError, Usage, estimated_usage
from scenewright.translate.model.keys import KEY_VARIABLES, key_for, scrubbed, without_known_keys
from scenewright.translate.model.settings import DEFAULT_MAX_TOKENS, DEFAULT_TIMEOUT_S

if TYPE_CHECKING:
    from pydantic_ai.messages import ModelMessage, ModelResponse
    from pydantic_ai.models import Model as LibraryModel

    from scenewright.translate.model.patience import PatientClient, Trouble

PROVIDERS = tuple(KEY_VARIABLES)
_EXTRA = "models"


@dataclass(frozen=True, slots=True)
class ServedModel:
    """A model behind a server.

    Attributes
    ----------
    provider, model
        One of `PROVIDERS`, and the provider's own name of the model.
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
        fault: ScenewrightError
        client: list[PatientClient] = []
        try:
            answer: Answer = _run(lambda: self._ask(call, key, client))
        except ScenewrightError as error:
            fault = error
        except ImportError:
            fault = MissingExtraError(f"the library that speaks to {self.provider}", _EXTRA)
        except TimeoutError:
            fault = self._timed_out()
        except Exception as error:  # whatever a library makes of a server's fault; never with its own traceback
            trouble = client[0].trouble if client else None
            fault = self._of_trouble(trouble) if trouble is not None else self._of_library(error)
        else:
            return answer
        raise fault

    async def _ask(self, call: Call, key: str | None, clients: list[PatientClient]) -> Answer:
        from pydantic_ai.direct import model_request

        from scenewright.translate.model.patience import PatientClient

        client = PatientClient(self.timeout_s, self.say)
        clients.append(client)
        async with asyncio.timeout(self.timeout_s), client:
            model = self._library_model(key, client)
            # Trying again is the client's affair, which knows what a server asks for; the libraries try once.
            options: Any = {"max_tokens": self.max_tokens, "max_retries": 0, "timeout": self.timeout_s}
            if self.provider == "google":
                del options["max_retries"]
            with warnings.catch_warnings(action="ignore"):  # a setting that a model does not have is left out
                response = await model_request(model, _history(call), model_settings=options)
        return self._answer(call, response)

    def _library_model(self, key: str | None, client: PatientClient) -> LibraryModel:
        if self.provider == "anthropic":
            from pydantic_ai.models.anthropic import AnthropicModel
            from pydantic_ai.providers.anthropic import AnthropicProvider

            own = AnthropicProvider(api_key=key or "", base_url=self.base_url, http_client=client)
            return AnthropicModel(self.model, provider=own)
        if self.provider == "google":
            from pydantic_ai.models.google import GoogleModel
            from pydantic_ai.providers.google import GoogleProvider

            return GoogleModel(
                self.model, provider=GoogleProvider(api_key=key or "", base_url=self.base_url, http_client=client)
            )
        from pydantic_ai.models.openai import OpenAIChatModel

        if self.provider == "openai":
            from pydantic_ai.providers.openai import OpenAIProvider

            return OpenAIChatModel(
                self.model, provider=OpenAIProvider(base_url=self.base_url, api_key=key, http_client=client)
            )
        from pydantic_ai.providers.openai_compatible import OpenAICompatibleProvider

        provider = OpenAICompatibleProvider(
            "openai-compatible", base_url=self.base_url or "", api_key=key or "none", http_client=client
        )
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
        return GaveUpError(
            f"{self.name} did not answer in time",
            found=f"no whole reply after {self.timeout_s:g} s",
            fix="allow more time with --timeout SECONDS, or translate with --translator offline",
        )

    def _declined(self, said: str) -> TranslationError:
        return TranslationError(
            f"{self.name} declined to answer",
            found=_line(said) or "a content filter of the provider",
            fix="say it in other words, or try another model or --translator offline",
        )

    def _of_trouble(self, trouble: Trouble) -> ScenewrightError:
        where = "the server at --base-url" if self.base_url else f"the server of {self.provider}"
        said = _line(trouble.said) or None
        tried = f" ({trouble.tries} tries)" if trouble.tries > 1 else ""
        if trouble.kind == "timeout":
            return self._timed_out()
        if trouble.kind == "connection":
            fix = "check that it runs and that its address is right, or translate with --translator offline"
            return GaveUpError(f"{where} is out of reach{tried}", found=said, fix=fix)
        if trouble.kind == "cut off":
            fix = "run it again; if it stays so, look into the server's own log"
            return GaveUpError(f"the reply of {self.name} broke off{tried}", found=said, fix=fix)
        if trouble.kind == "too large":
            fix = "check that the address is that of a language model, or try another model"
            return TranslationError(f"the reply of {self.name} is too large", found=said, fix=fix)
        return self._of_status(trouble, tried, said)

    def _of_status(self, trouble: Trouble, tried: str, said: str | None) -> ScenewrightError:
        found = f"HTTP {trouble.status}" + (f": {said}" if said else "")
        names = " or ".join(KEY_VARIABLES[self.provider])
        if trouble.status in (401, 403):
            fix = f"check the key in {names}"
            return TranslationError(f"the server does not accept the key for {self.name}", found=found, fix=fix)
        if trouble.status == 404:
            fix = "check the model's name, and the address where --base-url gives one (most end in /v1)"
            return TranslationError(f"the server knows no {self.name}", found=found, fix=fix)
        if trouble.status == 429:
            asked = f"; it asks to wait {trouble.retry_after_s:.0f} s" if trouble.retry_after_s is not None else ""
            fix = "wait and run it again, or allow a longer wait with --timeout SECONDS"
            return GaveUpError(f"the server of {self.name} is busy{tried}{asked}", found=found, fix=fix)
        if trouble.status is not None and trouble.status >= 500:
            fix = "run it again later, or translate with --translator offline"
            return GaveUpError(f"the server of {self.name} is at fault{tried}", found=found, fix=fix)
        return TranslationError(
            f"the server does not take the request to {self.name}",
            found=found,
            fix="check the model's name and limits, or try another model",
        )

    def _of_library(self, error: Exception) -> ScenewrightError:
        """Return the fault for what the library itself raised: a reply that is none, a filter, a limit."""
        if type(error).__name__ == "ContentFilterError":
            return self._declined(str(error))
        return TranslationError(
            f"what {self.name} sent is no reply",
            found=f"{type(error).__name__}: {_line(str(error))}",
            expected="a response in the provider's own protocol",
            fix="check the address and the model, or try another model",
        )


def check_address(provider: str, base_url: str | None) -> None:
    """Raise InputError where an address is missing, is none, or holds a password."""
    if base_url is None:
        if provider == "openai-compatible":
            raise InputError(
                "there is no address for openai-compatible",
                expected="the address of a server that speaks the OpenAI protocol",
                fix="--base-url http://127.0.0.1:8000/v1, or SCENEWRIGHT_BASE_URL in the environment",
            )
        return
    try:
        parts = urlsplit(base_url)
        sane = parts.scheme in ("http", "https") and bool(parts.hostname) and (parts.port or 1) > 0
    except ValueError:
        raise InputError("this is no address", found=scrubbed(base_url), expected="http://HOST:PORT/v1") from None
    if parts.username or parts.password:
        raise InputError(
            "an address must not hold a key or a password",
            expected="http://HOST:PORT/v1",
            fix=f"put the key into {KEY_VARIABLES[provider][0]}",
        )
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
            part = SystemPromptPart if message.role == "system" else UserPromptPart
            waiting.append(part(message.content))
    return [*history, ModelRequest(parts=waiting)]


def _run(ask: Callable[[], Any]) -> Any:
    """Run a coroutine to its end, also where the caller is inside an event loop already (a notebook)."""
    running = False
    with suppress(RuntimeError):
        asyncio.get_running_loop()
        running = True
    if not running:
        return asyncio.run(ask())
    result: list[Any] = []
    failed: list[BaseException] = []

    def work() -> None:
        try:
            result.append(asyncio.run(ask()))
        except BaseException as error:
            failed.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    if failed:
        raise failed[0]
    return result[0]


def _line(text: str) -> str:
    """Return a server's words on one line, short, without keys and without signs that could steer a terminal."""
    clean = "".join(c if c.isprintable() else " " for c in scrubbed(text))
    return " ".join(clean.split())[:300]
