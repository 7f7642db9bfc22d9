"""What a model's reply may say, and how it is read: as data, bounded, never carried out.

What enters: the text of a reply. What leaves: a `Reply`, or a `TranslationError` that can go back to the model. Whether
the program in it makes sense is for `verify` to find out.
"""

from __future__ import annotations

import json
import re
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, Field, ValidationError, model_validator

from scenewright.errors import TranslationError
from scenewright.translate.model.exchange import CUT_OFF, LONGEST_REPLY

LONGEST_PROGRAM = 20_000
LONGEST_SENTENCE = 2_000
MOST_ENTRIES = 200
_EXCERPT = 160


def _plain(value: object) -> object:
    """Return a text without characters that could steer a terminal."""
    if not isinstance(value, str):
        return value
    return "".join(c if c.isprintable() else " " for c in value).strip()


def _lines(value: object) -> object:
    """Let a program be one text or a list of its lines."""
    if isinstance(value, list) and all(isinstance(line, str) for line in value):
        return "\n".join(value)
    return value


Sentence = Annotated[str, BeforeValidator(_plain), Field(max_length=LONGEST_SENTENCE)]


class SentenceReading(BaseModel):
    """How one stretch of the description was understood."""

    words: Sentence = Field(description="the words of the description, copied letter by letter")
    understood: Sentence = Field(description="what they mean, in plain words")
    constraints: list[Sentence] = Field(
        default_factory=list,
        max_length=MOST_ENTRIES,
        description="names of the constraints they gave (c1, c2, ...: the order in the program); empty for routes",
    )


class OpenQuestion(BaseModel):
    """Something the description leaves open and that matters."""

    question: Sentence = Field(description="what is open, as a question")
    alternatives: list[Sentence] = Field(min_length=2, max_length=10, description="what it could mean")
    default: Sentence = Field(description="the alternative that the program takes, letter by letter")
    words: Sentence = Field(default="", description="the words that leave it open; empty where something is unsaid")

    @model_validator(mode="after")
    def _default_is_an_alternative(self) -> OpenQuestion:
        if self.default not in self.alternatives:
            raise ValueError(f"the default {self.default!r} is none of the alternatives")
        return self


class Refusal(BaseModel):
    """Why the description cannot be translated."""

    reason: Sentence = Field(description="why, in one sentence")
    words: Sentence = Field(default="", description="the words at fault, copied letter by letter")
    fix: Sentence = Field(default="", description="one thing the user can do about it")


class Reply(BaseModel):
    """A whole reply: a program with the account of it, or a refusal."""

    program: Annotated[str, BeforeValidator(_lines), Field(max_length=LONGEST_PROGRAM)] | None = Field(
        default=None, description="the program: one text with line breaks, or a list of its lines; null in a refusal"
    )
    readings: list[SentenceReading] = Field(default_factory=list, max_length=MOST_ENTRIES)
    assumptions: list[Sentence] = Field(default_factory=list, max_length=MOST_ENTRIES)
    questions: list[OpenQuestion] = Field(default_factory=list, max_length=20)
    refusal: Refusal | None = Field(default=None, description="null where there is a program")

    @model_validator(mode="after")
    def _one_of_both(self) -> Reply:
        if bool(self.program and self.program.strip()) == (self.refusal is not None):
            raise ValueError("give either a program or a refusal, and not both")
        return self


def reply_schema() -> dict[str, Any]:
    """Return the JSON schema of a reply."""
    return Reply.model_json_schema()


def read_reply(text: str) -> Reply:
    """Read the one JSON object in `text`; what stands around it (a code fence, a greeting) does no harm.

    Raises
    ------
    TranslationError
        Where there is none, or it is not a reply.

    Examples
    --------
    >>> read_reply('Here you are: {"refusal": {"reason": "It is a recipe."}}').refusal.reason
    'It is a recipe.'
    """
    if len(text) > LONGEST_REPLY:
        raise TranslationError(
            "the reply is too long",
            found=f"{len(text)} characters",
            expected=f"one JSON object of at most {LONGEST_REPLY} characters",
        )
    if text.endswith(CUT_OFF):
        raise TranslationError(
            "the reply is cut off",
            found="more tokens than --max-tokens allows",
            expected="a shorter reply: the JSON object alone, each reading in a few words",
        )
    data = _object_in(text)
    try:
        return Reply.model_validate(data)
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        raise TranslationError(
            "the reply is not in the form asked for",
            found=f"{where + ': ' if where else ''}{first['msg'].removeprefix('Value error, ')}",
            expected="the fields program, readings, assumptions, questions, refusal as described",
        ) from None


def _object_in(text: str) -> dict[str, Any]:
    decoder = json.JSONDecoder()
    fault = "no JSON object"
    for start in [match.start() for match in re.finditer(r"\{", text)][:50]:
        try:
            value, _ = decoder.raw_decode(text, start)
        except json.JSONDecodeError as error:
            if fault == "no JSON object":
                fault = f"{error.msg} at character {error.pos} of the reply"
            continue
        except RecursionError:
            fault = "an object nested without end"
            break
        except ValueError:  # a number with more digits than Python converts
            fault = "a number that is too long"
            break
        if isinstance(value, dict) and value.keys() & Reply.model_fields.keys():
            return value
    begins = _plain(text[:_EXCERPT])
    raise TranslationError(
        "the reply holds no JSON object that can be read",
        found=f"{fault}; it begins: {begins}" if begins else "an empty reply",
        expected="one JSON object and nothing else",
    )
