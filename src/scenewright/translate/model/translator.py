"""Asks a model for a program until what it says holds: ask, read, verify, send the fault back, ask again.

What enters: a description, a map, a model, settings. What leaves: a `ModelTranslation`, or a `TranslationError` that
says what was wrong with the last reply. Nothing that a model wrote is executed, and nothing is written to disk here.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from scenewright.errors import Place, ScenewrightError, TranslationError
from scenewright.program.types import Program
from scenewright.roads.grounding import ground
from scenewright.roads.model import RoadMap
from scenewright.translate.model import prompt
from scenewright.translate.model.exchange import Answer, Call, Message, Model, Usage
from scenewright.translate.model.questions import ask, questions_of, refuse_open
from scenewright.translate.model.reply import Refusal, Reply, read_reply
from scenewright.translate.model.settings import TranslatorSettings
from scenewright.translate.model.translation import ModelTranslation
from scenewright.translate.model.verify import Verified, place_of, verify
from scenewright.translate.offline import translate_offline

LONGEST_DESCRIPTION = 20_000
_KEPT_OF_A_REPLY = 20_000


def translate_with_model(
    text: str, road_map: RoadMap, name: str, model: Model, settings: TranslatorSettings
) -> ModelTranslation:
    """Translate a description with `model`.

    Parameters
    ----------
    text
        The description.
    road_map
        The map it is about; the model is told what is on it, and the program is held against it.
    name
        What to call the program, and the text in messages.

    Returns
    -------
    ModelTranslation
        With spans into `text`.

    Raises
    ------
    TranslationError
        Where the model refuses, where no reply holds after `settings.repairs` repairs, where something is left open and
        ``strict`` is asked for, or where no reply is to be had at all (then also with exit status 4).
    """
    _sane(text, name)
    return _Conversation(text, road_map, name, model, settings).translate()


@dataclass(slots=True)
class _Conversation:
    """All that is said about one description."""

    text: str
    road_map: RoadMap
    name: str
    model: Model
    settings: TranslatorSettings
    messages: tuple[Message, ...] = ()
    calls: tuple[Usage, ...] = ()
    attempt: int = 0

    def translate(self) -> ModelTranslation:
        self.messages = prompt.opening(self.road_map, self.text)
        reply, verified = self._until_it_holds()
        questions = questions_of(reply)
        answers: dict[str, str] = {}
        if self.settings.strict:
            refuse_open(questions, self.text, self.name)
        else:
            answers = ask(questions, self.settings)
        if answers:
            self._say(Message("assistant", reply.model_dump_json()), prompt.answered(answers))
            reply, verified = self._until_it_holds()
            questions = tuple(each for each in questions_of(reply) if each.question not in answers)
        assumptions = [*reply.assumptions, *(each.as_assumption() for each in questions if self.settings.ask is None)]
        assumptions += [f"{question} You answered: {answer}." for question, answer in answers.items()]
        return ModelTranslation(
            verified.program,
            verified.readings,
            tuple(dict.fromkeys(assumptions)),
            questions,
            self._disagreements(verified.program),
            self._impossible(verified.program),
            self.model.name,
            f"{prompt.PROMPT_VERSION} ({prompt.fingerprint(self.road_map)})",
            self.calls,
        )

    def _until_it_holds(self) -> tuple[Reply, Verified]:
        """Ask until a reply holds; raises what was wrong with the last one after so many repairs."""
        for left in range(self.settings.repairs, -1, -1):
            answer = self._ask()
            try:
                reply = read_reply(answer.text)
                if reply.refusal is None:
                    return reply, verify(reply, self.text, self.name, self.road_map)
            except ScenewrightError as fault:
                if not left:
                    raise self._no_program(fault) from None
                self._say(Message("assistant", answer.text[:_KEPT_OF_A_REPLY]), prompt.refused(fault))
                continue
            raise self._refused(reply.refusal)
        raise AssertionError("the loop returns or raises")

    def _ask(self) -> Answer:
        self.attempt += 1
        if self.settings.say is not None:
            self.settings.say(f"asking {self.model.name}" + (f", attempt {self.attempt}" if self.attempt > 1 else ""))
        answer = self.model.reply(Call(self.messages, self.text, self.attempt, self.road_map.name))
        self.calls = (*self.calls, answer.usage)
        return answer

    def _say(self, *messages: Message) -> None:
        self.messages = (*self.messages, *messages)

    # -- ends -------------------------------------------------------------------------------------------------------
    def _refused(self, refusal: Refusal) -> TranslationError:
        return TranslationError(
            f"{self.model.name} refuses the description: {refusal.reason}",
            place=place_of(refusal.words, self.text, self.name),
            found=refusal.words or None,
            fix=refusal.fix or "say it in other words, or try --translator offline",
        )

    def _no_program(self, fault: ScenewrightError) -> TranslationError:
        replies = "1 reply" if self.attempt == 1 else f"{self.attempt} replies"
        place = f"{fault.place}: " if fault.place else ""
        last = f"{place}{fault.message}" + (f" ({fault.found})" if fault.found else "")
        return TranslationError(
            f"{self.model.name} gave no program that holds in {replies}: {sum(self.calls, Usage()).tokens()}",
            found=f"in the last reply: {last}",
            expected="a program that parses, makes sense, fits the map and says what the description says",
            fix="say it in plainer sentences, try another model or more of --repairs, or --translator offline",
        )

    # -- second opinions --------------------------------------------------------------------------------------------
    def _disagreements(self, program: Program) -> tuple[str, ...]:
        """Return how the offline translator differs; where it does not understand the text it has no opinion."""
        if self.settings.compare is None:
            return ()
        try:
            offline = translate_offline(self.text, self.road_map, self.name).program
        except ScenewrightError:
            return ()
        same_map = str(self.road_map.source)
        return tuple(self.settings.compare(replace(offline, map_name=same_map), replace(program, map_name=same_map)))

    def _impossible(self, program: Program) -> str | None:
        """Return why the scenario cannot happen. That is told to the user, not to the model, which might bend it."""
        if self.settings.verify is None or ground(program, self.road_map).open_parameters():
            return None
        return self.settings.verify(program)


def _sane(text: str, name: str) -> None:
    if not text.strip():
        raise TranslationError("the description is empty", place=Place(name), fix="say what should happen")
    if len(text) > LONGEST_DESCRIPTION:
        raise TranslationError(
            "the description is too long for a model",
            place=Place(name),
            found=f"{len(text)} characters",
            expected=f"at most {LONGEST_DESCRIPTION}",
            fix="describe one scenario at a time",
        )
