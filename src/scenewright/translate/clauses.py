"""Reads tagged tokens clause by clause into events; every token must find a place in some event, or the text is refused.

What enters: tokens. What leaves: events in reading order, each with its mode: a main clause, a condition ("when"), or a
bound in order ("before", "after"). What the events mean for a program is decided by `interpret`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from scenewright.errors import Span, TranslationError
from scenewright.translate.events import ACTOR_NAMES, HERO_ID, Event, Place
from scenewright.translate.phrases import NounPhrase, Phrases
from scenewright.translate.tokens import Token

MOVES = ("pass", "reach", "enter", "leave", "approach")
TURNS = ("turn", "pull_out")
STATIVE = ("be", "sit", "ttc", "drive", "approach", "wait")
_UNSUPPORTED_FIX = "leave it out: the offline translator knows two vehicles that drive along their lanes"


@dataclass(slots=True)
class ClauseReader:
    """The state while reading: where we are, whose clause it is, what the next verb will carry."""

    phrases: Phrases
    at: int = 0
    sentence: int = 0
    links: list[str] = field(default_factory=list)
    flags: set[str] = field(default_factory=set)
    current: Event | None = None
    passive_object: str | None = None
    subject: int | None = None
    subject_span: Span | None = None
    main_subject: int | None = None
    label: str | None = None
    pending_relations: list[tuple[str, int, Span]] = field(default_factory=list)
    pending_heading: tuple[str, Span] | None = None
    events: list[Event] = field(default_factory=list)

    def read(self) -> list[Event]:
        """Read all tokens."""
        self._refuse_unsupported()
        while self.at < len(self.phrases.tokens):
            if not self._step():
                raise self._stuck()
        return self.events

    # -- refusals ---------------------------------------------------------------------------------------------------
    def _refuse_unsupported(self) -> None:
        found = [token for token in self.phrases.tokens if "unsupported" in token.tags or "bound" in token.tags]
        if not found:
            return
        token = found[0]
        words = ", ".join(dict.fromkeys(f"'{item.text}'" for item in found))
        if "bound" in token.tags:
            raise self.phrases.refuse(
                f"{words} gives a bound, not a value",
                token.span,
                "an exact distance, time or speed",
                "say the value itself, for example '12 m behind the stop line'",
            )
        raise self.phrases.refuse(
            f"{words}: {token.tags['unsupported']} are not supported in descriptions",
            token.span,
            "the ego and one other vehicle, each following its lane or turning",
            _UNSUPPORTED_FIX,
        )

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
        )

    # -- one step ---------------------------------------------------------------------------------------------------
    def _step(self) -> bool:
        return (
            self._stop()
            or self._label()
            or self._comma()
            or self._adverb()
            or self._existence()
            or self._measure()
            or self._adjunct()
            or self._link()
            or self._verb()
            or self._who()
            or self._bare()
        )

    def _tag(self, tag: str, ahead: int = 0) -> str | None:
        return self.phrases.tag(self.at + ahead, tag)

    def _stop(self) -> bool:
        if self._tag("end") is None:
            return False
        self._check_subject_used()
        left_over = [link for link in self.links if link not in ("comma", "then")]
        if left_over or self.flags - {"initial"} or self.passive_object:
            raise self._stuck_before("this sentence is not finished")
        resolve_modes([event for event in self.events if event.sentence == self.sentence])
        main = [e for e in self.events if e.sentence == self.sentence and e.mode == "main" and e.actor is not None]
        if main:
            self.main_subject = main[-1].actor
        self.subject = self.phrases.subject = self.main_subject
        self.subject_span = self.current = None
        self.links, self.flags, self.label = [], set(), None
        self.pending_heading = None
        self.sentence += 1
        self.at += 1
        return True

    def _stuck_before(self, message: str) -> TranslationError:
        span = self.phrases.tokens[max(0, self.at - 1)].span
        return self.phrases.refuse(message, span, "a verb or a place after it")

    def _check_subject_used(self) -> None:
        if self.subject_span is not None:
            raise self.phrases.refuse(
                f"nothing is said about '{self.subject_span.excerpt(self.phrases.text)}' here",
                self.subject_span,
                "a verb or a place after it",
                "say what each vehicle does in a clause of its own",
            )

    def _label(self) -> bool:
        if self._tag("label") and self._tag("colon", 1):
            self.label = self._tag("label")
            self.at += 2
            self.links.append({"when": "when", "main": "then_label", "start": "comma"}[self.label or "main"])
            return True
        if self._tag("colon"):
            self.at += 1
            self.links.append("comma")
            return True
        return False

    def _comma(self) -> bool:
        if self._tag("comma") is None:
            return False
        self.links.append("comma")
        self.at += 1
        return True

    def _adverb(self) -> bool:
        adverb = self._tag("adverb")
        if adverb is None or adverb in ("just", "about", "exact"):
            return False
        if adverb == "initially":
            self._mark_initial()
        elif adverb == "first":
            if self.current is None or self.current.verb not in (
                "go",
                "pass",
                "accelerate",
                "keep",
                "complete",
                "turn",
            ):
                if self.links or self.current is not None:
                    return False
            else:
                self.current.first = True
                self._grow()
        elif adverb != "filler":
            word = self.phrases.tokens[self.at].text
            self.phrases.assumptions.append(f"'{word}' sets no number; say a rate in m/s^2 to fix one")
        self.at += 1
        return True

    def _mark_initial(self) -> None:
        if self.current is not None and not self.links:
            self.current.initial = True
        else:
            self.flags.add("initial")

    # -- clauses ----------------------------------------------------------------------------------------------------
    def _existence(self) -> bool:
        """Read "there is a hero vehicle ..." and "there is a driveway 100 m in front of the ego"."""
        if self._tag("link") != "there":
            return False
        at = self.at + 1
        if not (self.phrases.tag(at, "be") or self.phrases.tag(at, "genitive") or self.phrases.verb(at, "exist")):
            return False
        at += 1
        found = self.phrases.landmark(at)
        if found is not None:
            return self._landmark_ahead(found[0], at, found[1])
        phrase = self.phrases.noun_phrase(at)
        if phrase is None:
            return False
        self.at = at
        self._take_subject(phrase)
        self._open("be", self.at - 1)
        return True

    def _landmark_ahead(self, name: str, at: int, end: int) -> bool:
        start = self.at
        place = self.phrases.place(end)
        if place is None or place[0].relation not in ("ahead", "from") or not isinstance(place[0].target, int):
            return False
        ahead, end = place
        event = Event("be", int(ahead.target), self.phrases.span(start, end), self.sentence, self.links, initial=True)
        landmark = "turn_start" if name == "mouth" else name
        event.places.append(Place("before", landmark, ahead.amount, ahead.span, vague=name == "turn"))
        self.events.append(event)
        self.links, self.at, self.current, self.subject = [], end, event, None
        if self._tag("link") == "that" and self.phrases.verb(end + 1, "pull_out"):  # "that merges into the ego's lane"
            area = self.phrases.area(end + 2)
            if area and area[0].lane_of is not None:
                event.relations.append(("driveway_joins", area[0].lane_of, self.phrases.span(end, area[1])))
                self.at = area[1]
                self._grow()
        return True

    def _measure(self) -> bool:
        """Read "the ego's distance to the stop line is 12 m", "the time to collision between A and B is 4 s"."""
        start = self.at
        owner = self.phrases.possessor(self.at)
        at = owner[1] if owner else self.phrases.skip_determiner(self.at)
        actor = owner[0] if owner else None
        if actor is None and (phrase := self.phrases.noun_phrase(at)) and self.phrases.tag(phrase.end, "measure"):
            actor, at = self.phrases.resolve(phrase), phrase.end  # "ego speed is 10 m/s"
        measure = self.phrases.tag(at, "measure")
        if owner and self.phrases.tag(at, "intent_noun") and self.phrases.tag(at + 1, "be"):
            return self._intent(owner[0], at + 2)
        if measure is None:
            return False
        at += 1
        target: str | int | None = None
        between: tuple[int, int] | None = None
        while self.phrases.tag(at, "be") is None and self.phrases.tag(at, "colon") is None:
            if self.phrases.tag(at, "preposition") == "between" and (pair := self._pair(at + 1)):
                actor, target, at = pair
                between = (actor, target) if isinstance(target, int) else None
                continue
            if self.phrases.tag(at, "preposition") in ("of", "out") and actor is None:
                phrase = self.phrases.noun_phrase(at + 1)
                if phrase is None:
                    return False
                actor, at = self.phrases.resolve(phrase), phrase.end
                continue
            if (
                self.phrases.tag(at, "preposition") in ("to", "at", "out")
                or self.phrases.tag(at, "relation")
                or self.phrases.tag(at, "link") == "to"
            ):
                if found := self.phrases.landmark(at + 1):
                    target, at = ("turn_start" if found[0] == "mouth" else found[0]), found[1]
                elif (phrase := self.phrases.noun_phrase(at + 1)) is not None:
                    target, at = self.phrases.resolve(phrase), phrase.end
                else:
                    return False
                continue
            return False
        at += 1
        while self.phrases.tag(at, "adverb") in ("about", "exact"):
            at += 1
        quantity = self.phrases.tokens[at].quantity
        if quantity is None:
            return False
        self.phrases.check_measure(measure, quantity)
        return self._measured(start, at + 1, measure, actor, target, between)

    def _measured(
        self,
        start: int,
        end: int,
        measure: str,
        actor: int | None,
        target: str | int | None,
        between: tuple[int, int] | None,
    ) -> bool:
        quantity = self.phrases.tokens[end - 1].quantity
        if isinstance(target, int) and actor is None:
            actor = 1 - target
        if actor is None:
            actor = self.subject
        if actor is None or quantity is None:
            return False
        self._set_subject(actor, None)
        self.at = start
        event = self._open("ttc" if measure == "ttc" else "be", start)
        if measure == "ttc":
            event.ttc, event.between = quantity, between
        elif measure == "speed":
            event.speed = quantity
        elif measure == "rate" or target is None:
            return False
        else:
            event.places.append(Place("from", target, quantity, self.phrases.span(start, end)))
            event.between = between
        self.at = end
        self._grow()
        return True

    def _pair(self, at: int) -> tuple[int, str | int, int] | None:
        first = self.phrases.noun_phrase(at)
        if first is None or self.phrases.tag(first.end, "link") != "and":
            return None
        actor = self.phrases.resolve(first)
        second = self.phrases.noun_phrase(first.end + 1)
        if second is not None:
            return actor, self.phrases.resolve(second), second.end
        found = self.phrases.landmark(first.end + 1)
        return (actor, found[0], found[1]) if found else None

    def _intent(self, actor: int, at: int) -> bool:
        self._set_subject(actor, self.phrases.span(self.at, at))
        self.flags.add("wanted")
        if self.phrases.tag(at, "link") == "to":
            at += 1
        self.at = at
        return True

    def _link(self) -> bool:
        link = self._tag("link")
        if link is None:
            return False
        after = self.at + 1
        if link in ("before", "after"):
            return self._order(link)
        if link == "to":
            if self.phrases.tokens[self.at].text.lower() == "to" and not self.phrases.tag(after, "verb"):
                return False
        if link == "only" and self.phrases.tag(after, "link") not in ("when", "after", "then"):
            return False
        if link == "there":
            return False
        if self.phrases.tokens[self.at].text.lower() in ("with", "as well as", "plus"):
            if self.phrases.noun_phrase(after) is None:
                return False
            link = "when" if self.phrases.tokens[self.at].text.lower() == "with" else "and"
        if link == "by":
            phrase = self.phrases.noun_phrase(after)
            if phrase is not None:
                return self._agent(phrase)
            if "ing" not in self.phrases.tokens[after].forms:
                return False
        if link == "that" and self.current is None and self.subject_span is None:
            return False
        self.links.append(link)
        self.at = after
        return True

    def _agent(self, phrase: NounPhrase) -> bool:
        """Read "by the hero" after a passive."""
        event = self.current
        if event is None or event.actor is not None:
            return False
        self._set_subject(self.phrases.resolve(phrase), None)
        event.actor = self.subject
        self.at = phrase.end
        self._grow()
        return True

    def _order(self, link: str) -> bool:
        """Read "before": a clause, or "before the ego" alone."""
        phrase = self.phrases.noun_phrase(self.at + 1)
        after = self.phrases.tokens[self.at + 1]
        if phrase is None:
            if "ing" in after.forms or self._passive_follows(self.at + 1):
                self.links.append(link)
                self.at += 1
                return True
            return False
        token = self.phrases.tokens[phrase.end]
        if token.tags.keys() & {"verb", "be", "auxiliary", "negation"} and not (
            token.tags.get("auxiliary") == "do" and self.phrases.tokens[phrase.end + 1].tags.keys() & {"end", "comma"}
        ):
            self.links.append(link)
            self.at += 1
            return True
        if self.phrases.tag(phrase.end, "genitive") is not None or self.current is None:
            return False
        if link == "after" or self.current.verb not in (
            "pass",
            "complete",
            "go",
            "accelerate",
            "keep",
            "turn",
            "reach",
            "enter",
        ):
            return False
        self.current.than_actor = self.phrases.resolve(phrase)
        self.at = phrase.end + (token.tags.get("auxiliary") == "do")
        self._grow()
        return True

    def _passive_follows(self, at: int) -> bool:
        found = self.phrases.landmark(at)
        return found is not None and bool(self.phrases.tag(found[1], "be") or self.phrases.tag(found[1], "auxiliary"))

    # -- who --------------------------------------------------------------------------------------------------------
    def _who(self) -> bool:
        if self._tag("landmark") or (self._tag("determiner") and self._tag("landmark", 1)):
            return self._passive_subject()
        phrase = self.phrases.noun_phrase(self.at)
        if phrase is None or self.phrases.tag(phrase.end, "genitive") is not None:
            return False
        if self.current is not None and not self.links:
            return self._object(phrase)
        self._take_subject(phrase)
        return True

    def _passive_subject(self) -> bool:
        if not self._passive_follows(self.at) or (self.current is not None and not self.links):
            return False
        found = self.phrases.landmark(self.at)
        assert found is not None
        self._check_subject_used()
        self.passive_object = "turn_start" if found[0] == "mouth" else found[0]
        self.subject = self.phrases.subject = None
        self.subject_span = self.phrases.span(self.at, found[1])
        self.at = found[1]
        self.current = None
        return True

    def _object(self, phrase: NounPhrase) -> bool:
        """Read an actor as the object of a verb: "yields to the ego", "lets"."""
        event = self.current
        if event is None or event.verb != "yield" or event.to_actor is not None:
            return False
        event.to_actor = self.phrases.resolve(phrase)
        self.at = phrase.end
        self._grow()
        return True

    def _take_subject(self, phrase: NounPhrase) -> None:
        self._check_subject_used()
        actor = self.phrases.resolve(phrase)
        self._set_subject(actor, phrase.span)
        for relation in phrase.adjectives & {"lead", "oncoming"}:
            self.pending_relations.append((relation, actor, phrase.span))
        if phrase.heading:
            self.pending_heading = (phrase.heading, phrase.span)
        self.at = phrase.end
        self.current = None

    def _set_subject(self, actor: int, span: Span | None) -> None:
        self.subject = self.phrases.subject = actor
        self.subject_span = span
        self.passive_object = None

    # -- verbs ------------------------------------------------------------------------------------------------------
    def _verb(self) -> bool:
        token = self.phrases.tokens[self.at]
        if "negation" in token.tags:
            self.flags.add("negated")
            self.at += 1
            return True
        if "auxiliary" in token.tags and not self._has_amount():
            self.flags.add({"have": "perfect"}.get(token.tags["auxiliary"], "modal"))
            self.at += 1
            return True
        if ("be" in token.tags or self._contracted_be(token)) and "verb" not in token.tags:
            self.flags.add("be")
            self.at += 1
            if not (self.phrases.tokens[self.at].tags.keys() & {"verb", "negation", "adverb", "auxiliary"}):
                self._open("be", self.at - 1)
            return True
        verb = token.tags.get("verb")
        if verb is None:
            return False
        return self._light(verb, token) or self._main_verb(verb, token)

    def _contracted_be(self, token: Token) -> bool:
        return "genitive" in token.tags and self.at > 0 and self.phrases.tag(self.at - 1, "pronoun") is not None

    def _has_amount(self) -> bool:
        """Whether "has" is a full verb here: "has 12 m to go to the stop line", "has a speed of 8 m/s"."""
        if self._tag("auxiliary") != "have":
            return False
        after = self.phrases.tokens[self.at + 1]
        if after.quantity is not None or self.phrases.measured(self.at + 1) is not None:
            self._open("be", self.at)
            self.at += 1
            return True
        return False

    def _light(self, verb: str, token: Token) -> bool:
        """Read verbs that only colour the next one: begins to, wants to, fails to."""
        following = self.phrases.tokens[self.at + 1]
        to_verb = self._tag("link", 1) == "to" and self.phrases.tag(self.at + 2, "verb") is not None
        flag = {"begin": "begins", "want": "wanted", "need": "modal", "fail": "negated"}.get(verb)
        if flag and to_verb:
            self.flags.add(flag)
            self.at += 2
            return True
        if verb == "begin" and "ing" in following.forms:
            self.flags.add("begins")
            self.at += 1
            return True
        if verb in ("begin", "want", "make", "complete", "use") and self._turn_noun(verb):
            return True
        if verb == "begin" and self.current is None and not self.flags - {"initial", "be", "modal"}:
            self.flags.add("initial")
            self._open("be", self.at)
            self.at += 1
            return True
        if verb == "come" and self._stop_noun_at(self.at + 1):
            return False
        return False

    def _turn_noun(self, verb: str) -> bool:
        """Read "makes a left turn", "begins its turn", "completes the left turn"."""
        start, at = self.at, self.at + 1
        owner = self.phrases.possessor(at)
        if owner is not None:
            if owner[0] != self.subject:
                return False
            at = owner[1]
        else:
            at = self.phrases.skip_determiner(at)
        direction = self.phrases.tag(at, "direction")
        at += direction is not None
        noun = self.phrases.tag(at, "event_noun")
        if noun != "turn" and not (verb == "make" and direction in ("left", "right")):
            return False
        if noun is not None:
            at += 1
        if verb == "begin":
            self.flags.add("begins")
        if verb == "want":
            self.flags.add("wanted")
        event = self._open("complete" if verb == "complete" else "turn", start)
        event.direction = direction
        self.at = at
        self._grow()
        return True

    def _stop_noun_at(self, at: int) -> int | None:
        """Return the position after "to a complete stop", or None."""
        if self.phrases.tag(at, "link") == "to" or self.phrases.tag(at, "preposition") == "to":
            at = self.phrases.skip_determiner(at + 1)
        elif self.phrases.tag(at, "pronoun") and self.phrases.tokens[at].text.lower() == "itself":
            return self._stop_noun_at(at + 1)
        else:
            return None
        return at + 1 if self.phrases.tag(at, "stop_noun") else None

    def _main_verb(self, verb: str, token: Token) -> bool:
        start = self.at
        if verb in ("begin", "want", "need", "fail", "make", "use"):
            return False
        end = self.at + 1
        if verb == "come":
            stop = self._stop_noun_at(end)
            if stop is None:
                if self._tag("verb") == "come" and (self.phrases.heading(end) or self.phrases.area(end)):
                    verb = "drive"
                else:
                    return False
            else:
                verb, end = "stop", stop
        if verb == "complete" or "base" in token.forms and not self._base_form_fits():
            return False
        passive = "be" in self.flags and "ed" in token.forms and "ing" not in token.forms
        if passive and verb in MOVES and self.passive_object is None:
            return False
        if self.passive_object is not None and verb not in MOVES:
            return False
        event = self._open(verb, start)
        event.gerund = "ing" in token.forms
        if event.landmark is None and verb in MOVES:
            end = self._object_place(event, end)
        if verb == "stop":
            event.to_stop = True
        self.at = end
        self._grow()
        return True

    def _base_form_fits(self) -> bool:
        """Whether a bare infinitive can stand here: after "to", "will", "does not", or as an order ("Brake ...")."""
        return True

    def _object_place(self, event: Event, at: int) -> int:
        found = self.phrases.landmark(at)
        if found is not None and event.verb == "leave" and found[3]:
            return at  # "leaves the driveway": an area, read as an adjunct
        if found is None and event.verb in ("reach", "pass") and self.phrases.tag(at, "preposition") in ("at", "in"):
            found = self.phrases.landmark(at + 1)
        if (
            found is None
            and self.phrases.tag(at, "pronoun")
            and self.phrases.last_landmark
            and event.verb != "approach"
        ):
            event.landmark = self.phrases.last_landmark
            return at + 1
        if found is None:
            return at
        event.landmark = "turn_start" if found[0] == "mouth" else found[0]
        if found[2] is not None and found[2] != event.actor:
            raise self.phrases.refuse("this is another vehicle's place", self.phrases.span(at, found[1]))
        return found[1]

    def _open(self, verb: str, start: int) -> Event:
        """Begin a new event for the current subject with the links and flags gathered so far."""
        tokens = self.phrases.tokens
        span = tokens[start].span
        if self.subject_span is not None:
            span = self.subject_span.union(span)
        event = Event(verb, self.subject, span, self.sentence, self.links)
        event.negated = "negated" in self.flags
        event.begins = "begins" in self.flags
        event.wanted = "wanted" in self.flags
        event.perfect = "perfect" in self.flags
        event.initial = "initial" in self.flags or self.label == "start"
        if self.passive_object is not None:
            event.landmark, event.actor, self.passive_object = self.passive_object, None, None
        event.relations, self.pending_relations = self.pending_relations, []
        if self.pending_heading is not None:
            event.headings.append(self.pending_heading)
            self.pending_heading = None
        self.links, self.flags, self.subject_span = [], set(), None
        self.events.append(event)
        self.current = event
        return event

    def _grow(self) -> None:
        """Extend the current event's span to the last token read."""
        if self.current is not None:
            self.current.span = self.current.span.union(self.phrases.tokens[self.at - 1].span)

    # -- adjuncts ---------------------------------------------------------------------------------------------------
    def _host(self) -> Event | None:
        """Return the event that an adjunct belongs to; a subject without a verb gets a verbless statement."""
        if self.current is None or (self.links and self.subject_span is not None):
            if self.subject is None:
                return None
            return self._open("be", self.at)
        if [link for link in self.links if link != "comma"] == ["and"] and self.current.verb == "be":
            self.links = []  # "is on the road and 30 m behind the stop line"
        self.links = [link for link in self.links if link != "comma"]
        return self.current if not self.links else self._open("be", self.at)

    def _adjunct(self) -> bool:
        return self._amount_adjunct() or self._stop_adjunct() or self._place_adjunct() or self._way_adjunct()

    def _amount_adjunct(self) -> bool:
        at = self.at
        preposition = self.phrases.tag(at, "preposition")
        if preposition in ("at", "with", "to", "for", "by") or self.phrases.tag(at, "link") == "to":
            at += 1
        measured = self.phrases.measured(at)
        if measured is not None and measured[0] in ("rate", "speed"):
            quantity, end = measured[1], measured[2]
        else:
            while self.phrases.tag(at, "adverb") in ("about", "exact"):
                at += 1
            quantity, end = self.phrases.tokens[at].quantity, at + 1
        if quantity is None or (quantity.dimension in ("length", "time") and preposition != "for"):
            return False
        host = self._host()
        if host is None:
            return False
        to = preposition == "to" or self.phrases.tokens[self.at].text.lower() == "to"
        slot = {"speed": "to_speed" if to else "speed", "acceleration": "rate", "time": "duration"}.get(
            quantity.dimension
        )
        if slot is None or getattr(host, slot) is not None:
            return False
        setattr(host, slot, quantity)
        self.at = end
        self._grow()
        return True

    def _stop_adjunct(self) -> bool:
        end = self._stop_noun_at(self.at)
        if end is None or self.current is None or self.current.verb not in ("brake", "stop"):
            return False
        self.current.to_stop = True
        self.at = end
        self._grow()
        return True

    def _place_adjunct(self) -> bool:
        if self.current is not None and self.current.verb in ("pass", "complete") and self._tag("link") == "before":
            if self.phrases.tokens[self.at].quantity is None:
                return False
        found = self.phrases.place(self.at)
        if found is None:
            return False
        place, end = found
        host = self._host()
        if host is None:
            return False
        host.places.append(place)
        self.at = end
        self._grow()
        return True

    def _way_adjunct(self) -> bool:
        """Read areas, headings and directions."""
        if area := self.phrases.area(self.at):
            host = self._host()
            if host is None:
                return False
            host.areas.append(area[0])
            self.at = area[1]
            self._grow()
            return True
        if (
            self.current is not None
            and self.current.verb == "leave"
            and (area := self.phrases.area_noun(self.at, "from"))
        ):
            self.current.areas.append(area[0])
            self.at = area[1]
            self._grow()
            return True
        if heading := self.phrases.heading(self.at):
            host = self._host_of_heading(heading[1])
            if host is None:
                return False
            host.headings.append((heading[0], self.phrases.span(self.at, heading[1])))
            self.at = heading[1]
            self._grow()
            return True
        return self._direction()

    def _host_of_heading(self, end: int) -> Event | None:
        if self.links and self.current is not None and self.current.verb in TURNS and "comma" in self.links:
            gerund = "ing" in self.phrases.tokens[self.at].forms
            if gerund and self.links == ["comma"]:  # "turns left, heading east"
                self.links = []
                return self.current
        return self._host()

    def _direction(self) -> bool:
        at = self.at
        if self.phrases.tag(at, "preposition") == "to":
            at = self.phrases.skip_determiner(at + 1)
        elif self.phrases.tag(at, "determiner") and self.phrases.tag(at + 2, "event_noun") == "turn":
            at += 1
        direction = self.phrases.tag(at, "direction")
        if direction is None:
            return False
        if self.phrases.tag(at + 1, "event_noun") == "turn":  # "left turn" without a verb
            if self.current is not None and not self.links:
                return False
            event = self._open("turn", at)
            event.wanted, event.direction = True, direction
            self.at = at + 2
            self._grow()
            return True
        host = self.current
        allowed = TURNS if direction != "straight" else ("drive", "lane_follow", "go", "be")
        if host is None or host.verb not in allowed or host.direction is not None or self.links:
            return False
        host.direction = direction
        self.at = at + 1
        self._grow()
        return True

    def _bare(self) -> bool:
        """Read telegraphic notes: "Ego: driveway, left turn, eastbound"."""
        if "comma" not in self.links or self.subject is None:
            return False
        area = self.phrases.area_noun(self.at, "on")
        if area is None:
            return False
        host = self._host()
        if host is None:
            return False
        host.areas.append(area[0])
        self.at = area[1]
        self._grow()
        return True


def resolve_modes(events: list[Event]) -> None:
    """Decide for the events of one sentence which are conditions, which are bounds in order, and which are told."""
    previous: Event | None = None
    for event in events:
        links = set(event.links)
        if "when" in links:
            event.mode = "when"
        elif "before" in links or "after" in links:
            event.mode = "before" if "before" in links else "after"
        elif previous is not None and _stays_condition(previous, event, links):
            event.mode = previous.mode
        else:
            event.mode = "main"
        previous = event


def _stays_condition(previous: Event, event: Event, links: set[str]) -> bool:
    if "then" in links or "then_label" in links:
        return False
    if not links or links <= {"that", "to"}:
        return previous.mode in ("when", "before", "after") and event.actor == previous.actor
    if previous.mode != "when":
        return False
    if event.verb in STATIVE:
        return bool(event.places or event.ttc or event.speed)
    return event.verb in ("reach", "pass", "enter") and links == {"and"}


__all__ = ["ACTOR_NAMES", "HERO_ID", "ClauseReader", "resolve_modes"]
