"""What a model's translation holds beside the program: questions, doubts, and what it took to get there.

What enters: nothing. What leaves: `ModelTranslation`, which is a `Translation` to all who need no more.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.model.exchange import Usage
from scenewright.translate.model.settings import Question
from scenewright.translate.translation import Translation


@dataclass(frozen=True, slots=True)
class ModelTranslation(Translation):
    """A translation by a model.

    Attributes
    ----------
    questions
        What the description leaves open; the program takes the defaults, which `assumptions` list too.
    disagreements
        How it differs in meaning from what the offline translator understood; empty where both agree, or where the
        offline translator understood nothing.
    impossible
        The proof that it cannot happen; None where nothing speaks against it, or parameters are open.
    translator, prompt
        Who translated, and the version and short hash of the prompt; never a key or an address.
    calls
        Tokens of each call, repairs included.
    """

    questions: tuple[Question, ...] = ()
    disagreements: tuple[str, ...] = ()
    impossible: str | None = None
    translator: str = ""
    prompt: str = ""
    calls: tuple[Usage, ...] = ()

    @property
    def usage(self) -> Usage:
        """The tokens of all calls together."""
        return sum(self.calls, Usage())

    def tokens(self) -> str:
        """Return the tokens in words, call by call where there were several."""
        if len(self.calls) < 2:
            return str(self.usage)
        return f"{self.usage} (" + ", ".join(f"{each.input_tokens} + {each.output_tokens}" for each in self.calls) + ")"

    def notes(self) -> tuple[str, ...]:
        """Return what the record of a run says of this translation."""
        return (f"translated by {self.translator} with prompt {self.prompt}: {self.tokens()}", *self.disagreements)


def notes_of(translation: Translation | None) -> tuple[str, ...]:
    """Return what the record of a run says of a translation: its assumptions, and which model made it if one did."""
    if translation is None:
        return ()
    own = translation.notes() if isinstance(translation, ModelTranslation) else ()
    return (*translation.assumptions, *own)
