"""Asks a model for a story until what it says holds: ask, read, hold against the words, send the fault back, ask again.

What enters: a text, a map, a model, settings. What leaves: an `Understanding`, or a `TranslationError` that says what
was wrong with the last reply. Nothing that a model wrote is executed, and nothing is written to disk here.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from typing import Any

from scenewright.errors import Place, ScenewrightError, Span, TranslationError
from scenewright.program.types import EGO
from scenewright.roads.grounding import ground
from scenewright.roads.model import RoadMap
from scenewright.translate import story as st
from scenewright.translate.compile import compile_story
from scenewright.translate.model import prompt
from scenewright.translate.model.evidence import check_evidence
from scenewright.translate.model.exchange import Answer, Call, Message, Model, TranslatorSettings, Usage
from scenewright.translate.model.schema import KNOWN, claim_of, locate, read_reply, reply_schema
from scenewright.translate.tell import tell
from scenewright.translate.understand import Answers, Understanding, defaults_of, understand
from scenewright.translate.ways import put_on_map

_BOTH = ("yes, it is meant as told", "no, as in the text")
_KEPT_OF_A_REPLY = 20_000  # characters that go back: a flood is not paid for twice


def understand_by_model(
    text: str, road_map: RoadMap, name: str, model: Model, settings: TranslatorSettings
) -> Understanding:
    """Return what `model` makes of `text` on `road_map`; `name` is what to call the text in messages.

    Raises as `understand` does, and TranslationError where the model refuses, where no reply holds after
    `settings.repairs` repairs, or where no reply is to be had at all (then with exit status 4).
    """
    talk = _Conversation(text, road_map, name, model, settings)
    found = understand(text, road_map, settings.answers, settings.strict, name, settings.ask, talk.story)
    told = f"{model.name}, prompt {prompt.fingerprint(road_map)}: {talk.used}"
    return replace(found, translator=model.name, notes=(*talk.notes, told))


@dataclass(slots=True)
class _Conversation:
    text: str
    road_map: RoadMap
    name: str
    model: Model
    settings: TranslatorSettings
    messages: tuple[Message, ...] = ()
    used: Usage = field(default_factory=lambda: Usage(0))
    notes: list[str] = field(default_factory=list)
    held: st.Story | None = None  # that the last reply told
    asked: list[st.Question] = field(default_factory=list)  # what it and the second opinion leave open
    unknown: bool = False  # whether the last story has a word that the program language does not know

    def story(self, answers: Answers) -> st.Story:
        """Return the story as answered; answers that it did not take itself go back to the model, all at once."""
        if self.held is None:
            self.messages = prompt.opening(self.road_map, self.text)
            self.held = self._until_it_holds()
            self.asked = [*self.held.questions, *self._second_opinion(self.held)]
        left = [each for each in self.asked if answers.get(each.slot) not in each.alternatives]
        known = {each.slot: each for each in self.asked if each not in left}
        taken = defaults_of(replace(self.held, questions=tuple(self.asked)))
        new = {each.text: answers[slot] for slot, each in known.items() if answers[slot] != taken.get(slot)}
        if new and not (left and self.settings.ask):  # else the others are asked first
            self.messages = (*self.messages, prompt.answered(new))
            self.held = self._until_it_holds()
            again = (each for each in self.held.questions if each.slot not in known)
            self.asked = left = [*again, *(each for each in left if each.alternatives == _BOTH)]
        return replace(self.held, questions=tuple(left))

    def _until_it_holds(self) -> st.Story:
        """Ask until a reply holds; return its story. Raises what was wrong with the last one."""
        for left in range(self.settings.repairs, -1, -1):
            answer = self._ask(self.messages, reply_schema())
            self.messages = (*self.messages, Message("assistant", answer.text[:_KEPT_OF_A_REPLY]))
            try:
                reply = read_reply(answer.text)
                if reply.refusal is not None:
                    break
                return self._checked(reply)
            except ScenewrightError as fault:
                if self.unknown:  # to the program language: a model might bend it
                    raise
                last = fault.message + (f" ({fault.found})" if fault.found else "")
                if not left:
                    message = f"{self.model.name} gave no story that holds: {self.used}"
                    fix = "say it in plainer sentences, try another model or more of --repairs, or --translator offline"
                    raise TranslationError(message, found=f"in the last reply: {last}", fix=fix) from None
                self.messages = (*self.messages, prompt.refused(fault))
                self.notes.append(f"a reply went back: {last}")
        refusal = reply.refusal
        raise TranslationError(
            f"{self.model.name} refuses the text: {refusal.reason}",
            place=Place(self.name, self.text, next(iter(locate(refusal.words, self.text)), Span(0, len(self.text)))),
            found=refusal.words or None,
            fix=refusal.fix or "say it in other words, or try --translator offline",
        )

    def _checked(self, reply: Any) -> st.Story:
        """Return the story of a reply; raises where it is not in the words, not on the map, or no program."""
        claim = claim_of(reply, self.text)
        check_evidence(claim, self.text)
        story = replace(claim.story, map_name=self.road_map.name)
        # The ego comes through every moment at which something is asked of it, as the moments stand.
        asked = {number for number, moment in enumerate(story.moments) for each in moment.conditions
                 if number and isinstance(each, st.Measure) and each.actor == EGO}  # fmt: skip
        if not asked <= set(story.ego):
            story = replace(story, ego=tuple(sorted({*story.ego, *asked})))
        placed = put_on_map(story, self.road_map)
        parts = ((each, slot, known) for (kind, slot), known in KNOWN.items() for each in st.within(story, kind))
        self.unknown = any(getattr(each, slot) not in known for each, slot, known in parts)
        program = compile_story(placed, self.text)
        ground(program, self.road_map)
        return story

    def _ask(self, messages: tuple[Message, ...], schema: dict[str, Any]) -> Answer:
        number = self.used.calls + 1
        if self.settings.say is not None:
            self.settings.say(f"asking {self.model.name}" + (f", call {number}" if number > 1 else ""))
        answer = self.model.reply(Call(messages, self.text, number, self.road_map.name, schema))
        self.used += answer.usage
        return answer

    def _second_opinion(self, story: st.Story) -> list[st.Question]:
        """Return a question for each difference between the text and the story told in English, judged blind."""
        if not self.settings.second_opinion:
            return []
        try:
            told = "\n".join(tell(put_on_map(story, self.road_map)))
        except TranslationError as error:
            self.notes.append(f"no second opinion: {error.message}")
            return []
        answer = self._ask(prompt.compared(self.text, told), {})
        try:
            found = json.loads(answer.text[answer.text.index("{") : answer.text.rindex("}") + 1])["differences"]
            sentences = [" ".join(str(each).split())[:300] for each in found]
        except (ValueError, KeyError, TypeError, RecursionError):
            self.notes.append("the second opinion could not be read")
            return []
        self.notes.append(f"second opinion: {len(sentences) or 'no'} difference{'s' if len(sentences) != 1 else ''}")
        asked = (f"A second reading differs: {each} Is the story right?" for each in sentences)
        return [st.Question(f"second opinion {number}", text, _BOTH) for number, text in enumerate(asked, start=1)]
