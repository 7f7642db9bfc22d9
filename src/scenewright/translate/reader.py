"""The state of a reader of clauses: where it is, whose clause it is, and what the next verb will carry.

What enters: tokens behind `Phrases`. What leaves: events, opened and grown by `adjuncts`, `verbs` and `clauses`. It
reads no words itself.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Span, TranslationError, UnknownWordsError
from scenewright.translate.events import EGO_ID, HERO_ID, Event, Place
from scenewright.translate.phrases import Phrases
from scenewright.translate.references import NounPhrase
from scenewright.translate.tokens import Token

MOVES = ("pass", "reach", "enter", "leave", "approach")
TURNS = ("turn", "pull_out")


@dataclass(slots=True)
class ReaderState:
    """What all parts of the reader share."""

    phrases: Phrases
    at: int = 0
    sentence: int = 0
    links: list[str] = field(default_factory=list)
    flags: set[str] = field(default_factory=set)
    opening: Span | None = None  # of the first word that colours the next verb: "wants", "begins"
    current: Event | None = None
    passive_object: str | None = None
    subject: int | None = None
    subject_span: Span | None = None
    main_subject: int | None = None
    label: str | None = None
    pair: bool = False  # the subject is both vehicles
    measured_last: int = -1  # how many events there were after the last measure
    last_kind: str | None = None  # what was measured last
    pronouns: int = 0  # as subjects in this sentence
    reduced: Event | None = None  # "a truck waiting on the driveway", before its finite verb
    interrupted: tuple[int, Span] | None = None  # "the hero, once it is 12 m from it, ..." before its verb
    pending_heading: tuple[str, Span] | None = None
    place_first: Place | None = None  # "at the conflict point it is doing 40 mph"
    events: list[Event] = field(default_factory=list)

    def _stuck(self) -> TranslationError:
        tokens = self.phrases.tokens
        token = tokens[self.at]
        end = self.at
        while end + 1 < len(tokens) and not tokens[end + 1].tags.keys() & {"end", "comma"}:
            end += 1
        rest = self.phrases.span(self.at, min(end + 1, self.at + 5))
        return self.phrases.refuse(
            f"'{token.text}' could not be understood here: '{rest.excerpt(self.phrases.text)}'",
            token.span,
            "one of: who, where (12 m behind the stop line), what (brakes, stops, turns left), when, before",
            "say it in a sentence of its own; nothing is guessed and nothing is dropped",
            kind=UnknownWordsError,
        )

    def _stuck_before(self, message: str) -> TranslationError:
        span = self.phrases.tokens[max(0, self.at - 1)].span
        return self.phrases.refuse(message, span, "a verb or a place after it")

    def _tag(self, tag: str, ahead: int = 0) -> str | None:
        return self.phrases.tag(self.at + ahead, tag)

    def _check_subject_used(self) -> None:
        if self.subject_span is not None and self.pending_heading is not None and self.passive_object is None:
            self._open("be", self.at - 1)  # "Westbound ego."
        if self.subject_span is not None:
            raise self.phrases.refuse(
                f"nothing is said about '{self.subject_span.excerpt(self.phrases.text)}' here",
                self.subject_span,
                "a verb or a place after it",
                "say what each vehicle does in a clause of its own",
                kind=UnknownWordsError,
            )

    def _take_subject(self, phrase: NounPhrase) -> None:
        self._check_subject_used()
        actor = self.phrases.resolve(phrase)
        self._set_subject(actor, phrase.span)
        if phrase.heading:
            self.pending_heading = (phrase.heading, phrase.span)
        self.at = phrase.end
        self.current = None

    def _set_subject(self, actor: int, span: Span | None) -> None:
        self.subject = self.phrases.subject = actor
        self.subject_span = span
        self.passive_object = None
        self.pair, self.reduced = False, None

    def _negate(self, span: Span) -> None:
        if "negated" in self.flags:
            raise self.phrases.refuse(
                "two negations are hard to read", span, "at most one", "say what the vehicle does"
            )
        self.flags.add("negated")

    def _stop_noun_at(self, at: int) -> int | None:
        """Return the position after "to a complete stop", or None."""
        if self.phrases.tag(at, "link") in ("to", "until") or self.phrases.tag(at, "preposition") == "to":
            at = self.phrases.skip_determiner(at + 1)
        elif self.phrases.tag(at, "pronoun") and self.phrases.tokens[at].text.lower() == "itself":
            return self._stop_noun_at(at + 1)
        else:
            return None
        return at + 1 if self.phrases.tag(at, "stop_noun") else None

    def _open(self, verb: str, start: int) -> Event:
        """Begin a new event for the current subject with the links and flags gathered so far."""
        self._after_an_insertion(start)
        self._back_to_interrupted(start)
        self._back_to_who_acts(verb)
        resumes = self._resumes(verb, start)
        tokens = self.phrases.tokens
        span = tokens[start].span
        for earlier in (self.subject_span, self.opening):
            span = span.union(earlier) if earlier is not None else span
        event = Event(verb, self.subject, span, self.sentence, self.links)
        event.explicit = self.subject_span is not None
        event.negated = "negated" in self.flags
        event.begins = "begins" in self.flags
        event.wanted = "wanted" in self.flags
        event.perfect = "perfect" in self.flags
        event.initial = "initial" in self.flags or self.label == "start"
        event.both = self.pair
        if self.passive_object is not None:
            event.landmark, event.actor, self.passive_object = self.passive_object, None, None
        if self.pending_heading is not None:
            event.headings.append(self.pending_heading)
            self.pending_heading = None
        event.resumed = resumes
        event.notes += ["modal"] if "modal" in self.flags else []
        if self.place_first is not None:
            event.places.append(self.place_first)
            event.span, self.place_first = event.span.union(self.place_first.span), None
        if self.subject_span is not None and not self.flags and self._describes(verb, start):
            self.reduced = event
        self.links, self.flags, self.subject_span, self.opening = [], set(), None, None
        self.events.append(event)
        self.current = event
        return event

    def _after_an_insertion(self, start: int) -> None:
        """Let "it waits and, after the ego has passed, drives on" go on with who waits."""
        inserted, token = self.current, self.phrases.tokens[start]
        if inserted is not None and self.subject_span is None and self._leaves_a_bound(inserted, token):
            self._set_subject(HERO_ID, None)
            self.links.append("back")
            return
        if inserted is None or self.subject_span is not None or self.links != ["comma"] or "s" not in token.forms:
            return
        if "and" not in inserted.links or not {"after", "when", "before"} & set(inserted.links):
            return
        main = [
            e for e in self.events if e.sentence == self.sentence and not {"after", "when", "before"} & set(e.links)
        ]
        if main and main[-1].actor is not None and main[-1].actor != inserted.actor:
            self._set_subject(main[-1].actor, None)

    def _back_to_interrupted(self, start: int) -> None:
        """Let "the hero, once it is 12 m from it, brakes" go on with the hero."""
        token = self.phrases.tokens[start]
        finite = bool(token.forms & {"s", "ed"} or token.tags.keys() & {"be"} or self.flags)
        if self.interrupted is None or self.subject_span is not None or self.links != ["comma"] or not finite:
            return
        actor, self.interrupted = self.interrupted[0], None
        self._set_subject(actor, None)

    def _back_to_who_acts(self, verb: str) -> None:
        """Let "brakes when the ego is 12 m from it, and stops" go on with who brakes: nobody tells the ego to stop."""
        if self.subject != 0 or self.subject_span is not None or verb not in ("brake", "stop", "accelerate", "yield"):
            return
        here = [e for e in self.events if e.sentence == self.sentence]
        main = [e for e in here if not {"after", "when", "before", "until", "that", "with"} & set(e.links)]
        told = self.current is not None and bool(here) and here[-1].actor == 0 and here[-1].verb == "be"
        if told and "and" in self.links and main and main[0] is here[0] and main[0].actor == 1:
            self._set_subject(1, None)

    def _leaves_a_bound(self, inserted: Event, token: Token) -> bool:
        """Whether the main clause goes on: "it goes after the ego has passed, and drives through the point"."""
        here = [event for event in self.events if event.sentence == self.sentence and event.actor is not None]
        bounds = {"when", "until", "before", "after"}
        begun = here[0] if here else inserted
        if begun.actor != HERO_ID or bounds & set(begun.links) or inserted.actor != EGO_ID:
            return False
        if "comma" not in self.links and not self._acts_after_a_state(inserted, token):
            return False
        finite = ("s" in token.forms and "verb" in token.tags) or "modal" in self.flags
        finite = finite or ("base" in token.forms and "then_label" in begun.links)
        acting = ("complete", "stop", "come", "brake", "let", "accelerate", "pass", "yield", "wait", "reach")
        finite = finite or (
            "ing" in token.forms and token.tags.get("verb") in acting and self.links == ["comma"]
        )  # "stops when the ego is 12 m from it, coming to rest 5 m before ..."
        if {*bounds, "that"} & set(self.links) or not finite or not any(bounds & set(event.links) for event in here):
            return False
        bounded = next(at for at, event in enumerate(here) if bounds & set(event.links))
        return all(event.actor == EGO_ID for event in here[bounded:])

    def _acts_after_a_state(self, inserted: Event, token: Token) -> bool:
        """Whether "and completes its turn" after "when the ego is 48 m from it" goes on with who acts."""
        if self.links != ["and"] or inserted.verb not in ("be", "sit") or not inserted.places:
            return False
        verb = token.tags.get("verb")
        if verb in ("complete", "accelerate", "go", "stop", "brake", "yield"):
            return True
        at = self.phrases.tokens.index(token)
        compared = False
        while not self.phrases.tokens[at].tags.keys() & {"end", "comma"}:
            compared |= self.phrases.tag(at, "link") in ("before", "after")
            at += 1
        return compared and verb in ("pass", "reach", "enter")

    def _describes(self, verb: str, start: int) -> bool:
        """Whether a subject is only described so far: "the truck waiting on the driveway", "the ego, westbound,"."""
        token = self.phrases.tokens[start]
        return "ing" in token.forms or (verb == "be" and not token.tags.keys() & {"be", "genitive", "auxiliary"})

    def _turn_to_object(self) -> bool:
        """Let "behind a van doing 12 m/s" and "yields to the ego, which ..." go on with who was named just before."""
        named, comma = self.phrases.last_named, bool(self.links)
        if named is None or self.subject_span is not None or set(self.links) - {"comma"} or self.current is None:
            return False
        if named[1] != self.at - comma or named[0] == self.subject or self.subject is None:
            return False
        self._set_subject(named[0], None)
        return True

    def _check_who_is_meant(self) -> None:
        """Refuse "the ego follows a car on the driveway, which is 20 m from it": either may be there."""
        named, token = self.phrases.last_named, self.phrases.tokens[self.at]
        if token.text.lower() not in ("which", "who") or named is None or self.current is None:
            return
        between = self.phrases.tokens[named[1] : self.at]
        if named[0] != self.subject and between and not any("end" in each.tags for each in between):
            message = f"it is not clear whether '{token.text}' is the ego or the hero"
            fix = "say it in a sentence of its own"
            raise self.phrases.refuse(message, token.span, "one vehicle that it can be", fix)

    def _resumes(self, verb: str, start: int) -> bool:
        """Let a finite verb go on with the subject that was described, as after "which": "..., turns left"."""
        reduced, token = self.reduced, self.phrases.tokens[start]
        finite = bool(token.forms & {"s", "ed", "base"} or token.tags.keys() & {"be", "genitive"} or self.flags)
        if reduced is None or "ing" in token.forms or not finite or set(self.links) - {"comma"}:
            return False
        if self.subject_span is not None or self.subject != reduced.actor or verb == "sit":
            return False
        if "initial" in self.flags and len(self.flags) == 1:
            return False
        if reduced.verb == "wait" or not (reduced.places or reduced.speed or reduced.ttc):
            reduced.links.append("that")  # what it says holds anyway; it is no part of the condition
        self.reduced = None
        return True

    def _grow(self) -> None:
        """Extend the current event's span to the last token read."""
        if self.current is not None:
            self.current.span = self.current.span.union(self.phrases.tokens[self.at - 1].span)

    def _host(self) -> Event | None:
        """Return the event that an adjunct belongs to; a subject without a verb gets a verbless statement."""
        if self.current is None or (self.links and self.subject_span is not None):
            fresh = not any(event.sentence == self.sentence for event in self.events)
            if self.subject is None or (fresh and self.subject_span is None and self.label is None):
                return None  # "At 10 m/s, the car ...": not said of the vehicle of the sentence before
            return self._open("be", self.at)
        # "is on the road and 30 m behind the stop line": without a subject of its own it still belongs to the same verb
        afresh = "and" in self.links and "initial" in self.flags  # "drives west and is initially 8 s from it"
        self.links = [link for link in self.links if link not in ("comma", "and")]
        if afresh and not self.links:
            self.links = ["and"]
            return self._open("be", self.at)
        return self.current if not self.links else self._open("be", self.at)

    def _says_respectively(self, at: int) -> bool:
        while "end" not in self.phrases.tokens[at].tags:
            if self.phrases.tokens[at].text.lower() == "respectively":
                return True
            at += 1
        return False
