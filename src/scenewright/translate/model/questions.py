"""What becomes of open questions: the user is asked, a default is taken and listed, or the description is refused.

What enters: the questions of a reply and what the user wants done about them. What leaves: answers, assumptions, or a
`TranslationError` that names every question.
"""

from __future__ import annotations

from collections.abc import Iterable

from scenewright.errors import TranslationError
from scenewright.translate.model.reply import Reply
from scenewright.translate.model.settings import Question, TranslatorSettings
from scenewright.translate.model.verify import place_of


def questions_of(reply: Reply) -> tuple[Question, ...]:
    """Return the open questions of a reply."""
    return tuple(
        Question(q.question, tuple(dict.fromkeys(q.alternatives)), q.default, q.words) for q in reply.questions
    )


def refuse_open(questions: Iterable[Question], description: str, name: str) -> None:
    """Raise TranslationError where there is a question at all: what ``--strict`` asks for."""
    open_ones = list(questions)
    if not open_ones:
        return
    listed = "; ".join(f"{each.question} ({' / '.join(each.alternatives)})" for each in open_ones)
    raise TranslationError(
        "the description leaves something open that matters",
        place=place_of(open_ones[0].words, description, name),
        found=listed,
        expected="a description that says it, as --strict asks",
        fix="say it in the description, or leave --strict out to take the defaults",
    )


def ask(questions: Iterable[Question], settings: TranslatorSettings) -> dict[str, str]:
    """Return the user's choices that differ from the defaults, by question; nothing where nobody can be asked."""
    if settings.ask is None:
        return {}
    answers = {each.question: (settings.ask(each), each.default) for each in questions}
    return {question: answer for question, (answer, default) in answers.items() if answer != default}
