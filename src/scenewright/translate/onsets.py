"""Reads what begins at the trigger when it is named apart from the deed: "its braking is initiated when".

What enters: the reader's state at the beginning of a clause. What leaves: True where such words were read. They are
stepped over where a moment follows; what kind of deed they name is kept, and the translation is refused where the hero
does another. Words between the noun and its verb ("braking, at 2 m/s^2, is commanded at") make it a deed of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.anaphora import AnaphoraReader
from scenewright.translate.events import EGO_ID, HERO_ID

_BEGINNINGS = ("from", "as", "upon", "by")
_DEEDS = {"brake": ("dec",), "accelerate": ("acc",), "turn": ("turn", "acc", "go")}


@dataclass(slots=True)
class OnsetReader(AnaphoraReader):
    """Reads onsets."""

    def _onset(self) -> bool:
        if self.subject_span is not None:
            return False
        return (
            self._moment_word()
            or self._onset_proform()
            or self._onset_named()
            or self._onset_nominal()
            or self._triggered()
            or self._own_moment()
        )

    def _moment_word(self) -> bool:
        """Read "as", "at" and "given" in front of a vehicle whose place is told as "when"."""
        word = self.phrases.tokens[self.at].text.lower()
        if word not in ("as", "at", "given") or "when" in self.links or set(self.links) - {"comma", "and"}:
            return False
        phrase = self.phrases.noun_phrase(self.at + 1)
        if phrase is None or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        if word == "given" and (self.current is not None or self.links):
            return False
        if word == "as" and not self._finite(phrase.end):
            return False
        if word == "at" and not (
            self.phrases.tokens[phrase.end].quantity or self.phrases.tag(phrase.end, "preposition") == "at"
        ):
            return False
        if not self._amount_near(phrase.end):
            return False
        self.links = [link for link in self.links if link != "and"] + ["when"]
        self.at += 1
        return True

    def _finite(self, at: int) -> bool:
        while self.phrases.tag(at, "adverb"):
            at += 1
        token = self.phrases.tokens[at]
        return bool(token.tags.keys() & {"be", "auxiliary", "falls"}) or bool(token.forms & {"s", "ed", "base"})

    def _amount_near(self, at: int) -> bool:
        """Whether a length or a time follows before the next comma."""
        while not self.phrases.tokens[at].tags.keys() & {"comma", "end"}:
            quantity = self.phrases.tokens[at].quantity
            if quantity is not None and quantity.dimension in ("length", "time"):
                return True
            at += 1
        return False

    def _opens_moment(self, at: int) -> bool:
        """Whether a moment is told from here: "when ...", "with the ego 12 m from ...", "at a gap of 9 m"."""
        word = self.phrases.tokens[at].text.lower()
        if self.phrases.tag(at, "link") == "when" or (word in _BEGINNINGS and self._amount_before_end(at)):
            return True
        if word == "by":  # "is started by the ego being 6 m from ..."
            phrase = self.phrases.noun_phrase(at + 1)
            return phrase is not None and self.phrases.tokens[phrase.end].text.lower() == "being"
        return word in ("at", "with", "on") and self._amount_before_end(at)

    def _amount_before_end(self, at: int) -> bool:
        while "end" not in self.phrases.tokens[at].tags:
            quantity = self.phrases.tokens[at].quantity
            if quantity is not None and quantity.dimension in ("length", "time"):
                return True
            at += 1
        return False

    def _onset_proform(self) -> bool:
        """Step over "it does this", "this happens", "namely" in front of a moment."""
        at = self.at + (self._tag("onset") is not None)
        bare = self.phrases.tokens[self.at].text.lower() == "this" and self.phrases.tag(self.at + 1, "link") == "when"
        at = self.at + 1 if bare else at
        if self._tag("onset") == "defined" and self._amount_before_end(at):
            self._step_to(at)
            self.links = [link for link in self.links if link not in ("moment", "that")] + ["when"]
            return True
        if self._tag("onset") and self.phrases.tag(at, "link") == "until" and self._hero_acts():
            self._set_subject(HERO_ID, None)
            self.at, self.current, self.links = at, None, []
            return True  # "It does so until it is at rest"
        if at == self.at or not self._opens_moment(at):
            return False
        told = any(event.sentence <= self.sentence for event in self.events)
        if not told or (set(self.links) - {"comma", "and"}):
            return False
        self._step_to(at)
        return True

    def _hero_acts(self) -> bool:
        """Whether the last thing that was told to be done is what the hero does."""
        told = [event for event in self.events if event.verb in ("brake", "accelerate", "wait", "stop", "go")]
        return bool(told) and told[-1].actor == HERO_ID and not self.links

    def _step_to(self, at: int) -> None:
        self.at, self.current = at, None
        self.links = [link for link in self.links if link not in ("comma", "and")]
        if self.phrases.tokens[at].text.lower() in _BEGINNINGS:
            self.links.append("when")
            self.at += 1

    # -- the deed named by a noun -----------------------------------------------------------------------------------
    def _deed_noun(self, at: int) -> tuple[str, int, int | None] | None:
        """Read "the hero's braking", "its turn", "the manoeuvre of the van"; kind, position after it, whose it is."""
        whose: int | None = None
        if self.phrases.tag(at, "possessive"):
            at += 1
            whose = self.phrases.subject
        elif (owner := self.phrases.possessor(at)) is not None:
            whose, at = owner
        else:
            at = self.phrases.skip_determiner(at)
        while self.phrases.tag(at, "actor_adjective") == "plain":
            at += 1
        kind = self.phrases.tag(at, "onset_noun")
        if kind is None:
            return None
        at += 1
        if whose is None and self.phrases.tag(at, "preposition") in ("of", "by"):
            phrase = self.phrases.noun_phrase(at + 1)
            if phrase is None or self.phrases.tag(phrase.end, "genitive") is not None:
                return None
            whose, at = self.phrases.resolve(phrase), phrase.end
        return kind, at, whose

    def _onset_verb(self, at: int) -> int | None:
        """Return the position after "is initiated", "shall begin", "comes on"; None where there is none."""
        helped = False
        while self.phrases.tokens[at].tags.keys() & {"be", "auxiliary", "adverb"} or (
            helped and self.phrases.tag(at, "link") == "to"
        ):
            helped, at = True, at + 1
        return at + 1 if self.phrases.tag(at, "onset_verb") else None

    def _begins_clause(self) -> bool:
        return self.current is None or bool(set(self.links) & {"comma", "and"})

    def _onset_named(self) -> bool:
        """Read "the hero's manoeuvre is initiated when", "its brakes come on when", "that turn begins the instant"."""
        if not self._begins_clause() or set(self.links) - {"comma", "and", "then_label", "then"}:
            return False
        if not self._onset_ahead():
            return False
        found = self._deed_noun(self.at)
        if found is None:
            return False
        kind, at, whose = found
        after = self._onset_verb(at)
        if whose == EGO_ID and self.phrases.tag(self.at, "possessive") and self._hero_spoken_of():
            whose = HERO_ID
        if whose == EGO_ID:
            return False
        colon = after is not None and self.phrases.tag(after, "colon") is not None
        if after is not None and (colon or self._opens_moment(after)):
            self._note_deed(kind, self.at, after)
            if kind == "turn":
                self._open_deed("turn", self.at, after)
                self.links = []
            self._step_to(after + colon)
            self.links += ["when"] if colon else []
            return True
        if after is not None and self.phrases.tokens[after].tags.keys() & {"end", "comma", "colon"}:
            return self._deed_begins(kind, after)
        return self._deed_with_adjuncts(kind, at)

    def _deed_begins(self, kind: str, after: int) -> bool:
        """Read "..., braking of the hero begins" where the moment was told before."""
        if "comma" not in self.links or not any(e.sentence == self.sentence for e in self.events):
            return False
        self._open_deed("attitude" if kind == "action" else kind, self.at, after)
        if kind != "action":
            self.events[-1].begins = True
        return True

    def _onset_ahead(self) -> bool:
        """Whether a noun of deed and a verb of beginning stand in this sentence; a quick look without side effects."""
        at, noun = self.at, False
        while "end" not in self.phrases.tokens[at].tags:
            noun = noun or (self.phrases.tag(at, "onset_noun") is not None and at - self.at < 6)
            if noun and self.phrases.tag(at, "onset_verb"):
                return True
            if not noun and at - self.at >= 6:
                return False
            at += 1
        return False

    def _hero_spoken_of(self) -> bool:
        """Whether this sentence told of the hero: "the truck stops ..., its brakes come on when ..."."""
        return any(event.actor == HERO_ID and event.sentence == self.sentence for event in self.events)

    def _open_deed(self, verb: str, start: int, end: int) -> None:
        self._set_subject(HERO_ID, self.phrases.span(start, end))
        self.at = start
        event = self._open(verb, start)
        event.begins = verb == "turn"
        event.notes.append("nominal")
        self.at = end
        self._grow()

    def _deed_with_adjuncts(self, kind: str, at: int) -> bool:
        """Read "braking of the hero, at 2 m/s^2 to a standstill, is to be commanded at ..." up to its first comma."""
        if kind not in ("brake", "accelerate"):
            return False
        end = at
        while "end" not in self.phrases.tokens[end].tags:
            after = self._onset_verb(end)
            if after is not None and self._opens_moment(after):
                break
            if self.phrases.verb(end) is not None and self.phrases.tag(end, "onset_verb") is None:
                return False
            end += 1
        else:
            return False
        self._open_deed(kind, self.at, at)
        self.links = []
        self.at += self._tag("comma") is not None
        return True

    def _onset_nominal(self) -> bool:
        """Step over the verb of a deed with adjuncts: "..., is to be commanded at"."""
        event = self.current
        if event is None or "nominal" not in event.notes or set(self.links) - {"comma", "and"}:
            return False
        after = self._onset_verb(self.at)
        if after is None or not self._opens_moment(after):
            return False
        self._step_to(after)
        return True

    def _note_deed(self, kind: str, start: int, end: int) -> None:
        if kind in _DEEDS:
            self.phrases.onsets.append((_DEEDS[kind], self.phrases.span(start, end)))

    # -- the trigger as a verb --------------------------------------------------------------------------------------
    def _triggered(self) -> bool:
        """Read "Trigger the hero at 30 m ..., the ego at ..." and "the hero is triggered when"."""
        if self.current is not None or self.links or any(e.sentence == self.sentence for e in self.events):
            return False
        asked = self._tag("label") == "when" and self.phrases.tokens[self.at].text.lower() == "trigger"
        defined = self.at + 1 + (self.phrases.tag(self.at + 1, "comma") is not None)
        if asked and self.phrases.tag(defined, "onset") == "defined":
            self._step_to(defined)
            return True
        if asked and self._opens_moment(self.at + 1):
            self._step_to(self.at + 1)
            return True
        phrase = self.phrases.noun_phrase(self.at + asked)
        if phrase is None or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        after = phrase.end if asked else self._onset_verb(phrase.end)
        if after is None or not self._opens_moment(after):
            return False
        words = "trigger" if asked else self.phrases.tokens[after - 1].text.lower()
        if not words.startswith(("trigger", "activat", "launch", "releas")) or self.phrases.resolve(phrase) != HERO_ID:
            return False
        if asked and self.phrases.tag(after, "preposition") == "at" and self.phrases.place(after) is not None:
            self.links.append("when")  # the place is the hero's own
            self._take_subject(phrase)
            return True
        self._set_subject(HERO_ID, None)
        self._step_to(after)
        return True

    # -- the hero's own amount, before its clause -------------------------------------------------------------------
    def _own_moment(self) -> bool:
        """Read "At 3 s to the conflict point, with the ego 8 m from ..., the bus brakes": the place is the bus's."""
        if self.current is not None or self.links or any(e.sentence == self.sentence for e in self.events):
            return False
        opens = self.phrases.tokens[self.at].text.lower() in ("at", "with") or self._tag("link") == "when"
        if not opens or (self.phrases.tokens[self.at + 1].quantity is None):
            return False
        whose = self._clause_of_whom()
        if whose != HERO_ID:
            return False  # what the ego does is not told; a place of it would be no moment
        subject, self.phrases.subject = self.phrases.subject, whose
        found = self.phrases.place(self.at + (self._tag("link") == "when"))
        self.phrases.subject = subject
        if found is None or found[0].amount is None or not isinstance(found[0].target, str):
            return False
        place, end = found
        both = self.phrases.tag(end, "preposition") == "for" and self.phrases.tag(end + 1, "pair") is not None
        closes = self.phrases.tag(end, "comma") is not None or self.phrases.noun_phrase(end) is not None
        closes = closes or (
            self.phrases.tag(end, "link") == "and" and self.phrases.tokens[end + 1].text.lower() == "with"
        )
        if not (closes or both):
            return False  # "At 32 m from it for the AV and ...": dealt out
        if place.of_whom not in (None, whose) or (both and place.target == "stop_line"):
            return False
        start = self.at
        for actor in (EGO_ID, HERO_ID) if both else (whose,):
            self._set_subject(actor, None)
            self.links = ["and"] if both and actor == HERO_ID else ["when"]
            self.at = start
            self._open("be", start).places.append(place)
        self.at = end + 2 * both
        self._grow()
        return True

    def _clause_of_whom(self) -> int | None:
        """Return whose clause follows an amount in front: of the first vehicle that a finite verb follows."""
        at = self.at + 1
        while "end" not in self.phrases.tokens[at].tags:
            phrase = self.phrases.noun_phrase(at)
            if phrase is not None and phrase.kind != "pronoun":
                token = self.phrases.tokens[phrase.end]
                begins = self.phrases.tokens[at - 1].tags.keys() & {"comma", "landmark"}
                if begins and (token.tags.keys() & {"be", "auxiliary"} or token.forms & {"s", "base"}):
                    return self.phrases.resolve(phrase)
                at = phrase.end
            else:
                at += 1
        return None
