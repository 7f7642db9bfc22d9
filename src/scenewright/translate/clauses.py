"""Reads tagged tokens clause by clause into events; a token that finds no place in any event makes it refuse the text.

What enters: tokens. What leaves: events in reading order, each with its mode (see `modes`). What the events mean for a
program is decided by `interpret`.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import HERO_ID, Event
from scenewright.translate.modes import resolve_modes
from scenewright.translate.onsets import OnsetReader
from scenewright.translate.references import NounPhrase

_MOST_READERS = 8  # that may read one token after the other without a step on
_RANKS = ("lead", "rear")
_UNSUPPORTED_FIX = "leave it out: the offline translator knows two vehicles that drive along their lanes"


@dataclass(slots=True)
class ClauseReader(OnsetReader):
    """Reads a whole description."""

    def read(self) -> list[Event]:
        """Read all tokens."""
        self._refuse_unsupported()
        stood = 0
        while self.at < len(self.phrases.tokens):
            before = self.at
            self.phrases.leader = self._told_ahead()
            if not self._step() or stood > _MOST_READERS:
                raise self._stuck()
            stood = stood + 1 if self.at == before else 0
        return self.events

    def _told_ahead(self) -> int | None:
        """Return who was told to be ahead of the other in its lane, where this sentence spoke of the other vehicle."""
        spoken = any(e.sentence == self.sentence and e.actor not in (None, self.subject) for e in self.events)
        if self.subject is None or not spoken:
            return None
        told = {actor if word == "lead" else 1 - actor for word, actor, _ in self.phrases.described if word in _RANKS}
        for event in self.events:
            told |= {event.actor} if event.in_front and event.actor is not None else set()
            for place in event.places:
                if isinstance(place.target, int) and event.actor is not None and place.relation in ("ahead", "behind"):
                    told.add(event.actor if place.relation == "ahead" else place.target)
        return told.pop() if len(told) == 1 else None

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

    def _step(self) -> bool:
        return (
            self._stop()
            or self._label()
            or self._parenthesis()
            or self._comma()
            or self._onset()
            or self._deed()
            or self._deed_predicate()
            or self._noted_deed()
            or self._expected_deed()
            or self._no_deed()
            or self._state_of_turn()
            or self._after_a_while()
            or self._this_lets()
            or self._frame()
            or self._likewise()
            or self._adverb()
            or self._nominal_turn()
            or self._existence()
            or self._shares()
            or self._measure()
            or self._front()
            or self._place_before_clause()
            or self._apposition()
            or self._both()
            or self._intention()
            or self._adjunct()
            or self._for_which()
            or self._link()
            or self._command()
            or self._verb()
            or self._who()
            or self._bare()
        )

    def _stop(self) -> bool:
        if self._tag("end") is None:
            return False
        self._check_subject_used()
        if self.interrupted is not None:
            raise self.phrases.refuse(
                "nothing is said about this vehicle here", self.interrupted[1], "a verb after what interrupts it"
            )
        left_over = [link for link in self.links if link not in ("comma", "then", "moment")]
        if left_over or self.flags - {"initial"} or self.passive_object:
            raise self._stuck_before("this sentence is not finished")
        resolve_modes([event for event in self.events if event.sentence == self.sentence])
        both = bool(self.events) and self.events[-1].both
        self._spread()
        main = [e for e in self.events if e.sentence == self.sentence and e.mode == "main" and e.actor is not None]
        if main:
            self.main_subject = HERO_ID if self._acts_beside_asides(main) else main[-1].actor
        self.main_subject = None if both else self.main_subject
        self.subject = self.phrases.subject = self.main_subject
        self.pair, self.reduced, self.pronouns = False, None, 0
        self.subject_span = self.current = None
        self.links, self.flags, self.label, self.opening = [], set(), None, None
        self.pending_heading = None
        self.sentence += 1
        self.at += 1
        return True

    def _label(self) -> bool:
        if self._tag("label") and self._tag("colon", 1):
            self.label = self._tag("label")
            self.at += 2
            if self.label == "main" and "base" in self.phrases.tokens[self.at].forms:
                self._set_subject(HERO_ID, None)  # "Command: brake, ..." is for the hero: nobody commands the ego
            self.links.append({"when": "when", "main": "then_label"}.get(self.label or "main", "comma"))
            return True
        whose = (
            self.phrases.noun_phrase(self.at + 2)
            if self._tag("label") and self._tag("preposition", 1) == "of"
            else None
        )
        if (
            whose is not None and self.phrases.tag(whose.end, "colon") and self.current is None
        ):  # "Reaction of the van:"
            self.label = self._tag("label")
            self.links.append({"when": "when", "main": "then_label"}.get(self.label or "main", "comma"))
            self._take_subject(whose)
            self.at += 1
            return True
        if self._tag("colon"):
            here = [event for event in self.events if event.sentence == self.sentence]
            states = all(e.verb in ("be", "sit", "ttc") and (e.places or e.ttc) and not e.initial for e in here)
            if here and states and self.label is None and not any("when" in e.links for e in here):
                here[0].links.insert(0, "when")  # "Ego 12 m from the stop line: the hero stops"
                for event in here[1:]:
                    event.links.append("and")
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
        at_once = self.phrases.tokens[self.at].text.lower() in ("immediately", "directly") and self._tag("verb", 1)
        if adverb is None or (adverb in ("just", "about", "exact") and not at_once):
            return False
        if adverb == "initially":
            self._mark_initial()
        elif adverb == "steady":
            if self.current is None or self.links:
                return False
            self.current.notes.append("steady")
        elif adverb == "first" and "comma" in self.links and self.phrases.verb(self.at + 1, "brake", "stop", "yield"):
            pass  # "..., first stops, then goes"
        elif adverb == "first":
            if self.current is None or self.current.verb not in (
                "go",
                "pass",
                "accelerate",
                "keep",
                "complete",
                "turn",
                "reach",
                "enter",
            ):
                sequence = self.subject_span is not None and self.phrases.verb(self.at + 1, "brake", "stop", "yield")
                if not sequence and (self.links or self.current is not None):
                    return False
            else:
                self.current.first = True
                self.current.span = self.current.span.union(self.phrases.tokens[self.at].span)
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

    def _link(self) -> bool:
        link = self._tag("link")
        if link is None:
            return False
        after = self.at + 1
        if link in ("before", "after"):
            return self._order(link)
        bare = self.subject_span is not None and self.links == ["comma"] and self.current is None and not self.pair
        if link == "when" and bare and self.interrupted is None and self.subject is not None:
            assert self.subject_span is not None
            self.interrupted, self.subject_span, self.links = (self.subject, self.subject_span), None, []
        word = self.phrases.tokens[self.at].text.lower()
        if word == "to" and not self.phrases.tag(after, "verb"):
            return False
        if link == "until" and self.phrases.tag(after, "landmark"):
            return False
        if word.startswith("by the time"):
            self.links.append("by_then")
            if any(e.sentence == self.sentence for e in self.events):
                link = "before"  # "is through by the time the ego begins to turn"
        if link == "only" and self.phrases.tag(after, "link") not in ("when", "after", "then"):
            only_then = self._only_later(after)
            self.at += only_then
            return only_then
        if link == "there" and self._rests_there(after):
            self.at = after
            return True
        if link == "there":
            still = self.current is not None and self.current.verb in ("wait", "stop", "brake", "yield", "keep")
            self.at += still and not self.links
            return still and not self.links
        if self.phrases.tokens[self.at].text.lower() in ("with", "as well as", "plus"):
            if self.phrases.noun_phrase(after) is None and self.phrases.tag(after, "pair") is None:
                return False
            link = "when" if self.phrases.tokens[self.at].text.lower() == "with" else "and"
            self.links += ["with"] if link == "when" else []
        if link == "by":
            phrase = self.phrases.noun_phrase(after)
            if phrase is not None:
                return self._agent(phrase)
            if "ing" not in self.phrases.tokens[after].forms:
                return False
        if link == "that" and self.current is None and self.subject_span is None:
            return False
        if link == "that" and not self._turn_to_object():
            self._check_who_is_meant()
        self.links.append(link)
        self.at = after
        if link == "then" and self.phrases.noun_phrase(after) is None:
            self._back_to_main_clause()
        return True

    def _back_to_main_clause(self) -> None:
        """Let "it waits until the ego has passed, then continues" go on with who waits."""
        here = [event for event in self.events if event.sentence == self.sentence]
        main = [event for event in here if not set(event.links) & {"when", "until", "before", "after", "that"}]
        if not main or self.subject_span is not None or here[-1] is main[-1] or main[-1].actor is None:
            return
        if self.subject != main[-1].actor and main[-1].actor == HERO_ID:
            self._set_subject(main[-1].actor, None)

    def _order(self, link: str) -> bool:
        """Read "before": a clause, or "before the ego" alone."""
        phrase = self.phrases.noun_phrase(self.at + 1)
        after = self.phrases.tokens[self.at + 1]
        if self._before_a_turn(link):
            return True
        if phrase is None:
            if "ing" in after.forms or self._passive_follows(self.at + 1):
                self.links.append(link)
                self.at += 1
                return True
            return False
        token = self.phrases.tokens[phrase.end]
        elliptic = token.tags.get("auxiliary") in ("do", "have") or "be" in token.tags
        elliptic = elliptic and bool(self.phrases.tokens[phrase.end + 1].tags.keys() & {"end", "comma"})
        self._arrival(elliptic or not token.tags.keys() & {"verb", "be", "auxiliary", "negation"})
        if token.tags.keys() & {"verb", "be", "auxiliary", "negation"} and not elliptic:
            self.links.append(link)
            self.at += 1
            return True
        if self.phrases.tag(phrase.end, "genitive") is not None or self.current is None:
            return False
        if self.current.verb not in (
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
        other = self.phrases.resolve(phrase)
        if link == "after":
            self.current.after_actor = other
        else:
            self.current.than_actor = other
        self.at = phrase.end + elliptic
        self._grow()
        return True

    def _before_a_turn(self, link: str) -> bool:
        """Read "before the ego's turn"."""
        owner = self.phrases.possessor(self.at + 1) if link == "before" and self.current is not None else None
        if owner is None or self.phrases.tag(owner[1], "event_noun") != "turn":
            return False
        if self.phrases.tokens[owner[1] + 1].tags.keys() & {"be", "auxiliary", "verb"}:
            return False
        start = self.at + 1
        self.links.append(link)
        self._set_subject(owner[0], self.phrases.span(start, owner[1]))
        event = self._open("turn", start)
        event.begins = True
        self.at = owner[1] + 1
        self._grow()
        return True

    def _who(self) -> bool:
        owned = self._tag("possessive") and self._tag("event_noun", 1)
        if (
            owned
            or self._tag("landmark")
            or (self._tag("determiner") and (self._tag("landmark", 1) or self._tag("event_noun", 1)))
        ):
            return self._passive_subject()
        phrase = self.phrases.noun_phrase(self.at)
        if phrase is None:
            return False
        if self.phrases.tag(phrase.end, "genitive") is not None and not self.phrases.short_be(phrase.end):
            return False
        self.pronouns += phrase.kind == "pronoun"
        if self.phrases.tag(phrase.end, "label") and self.phrases.tag(phrase.end + 1, "colon"):  # "Hero action: ..."
            self.label = self.phrases.tag(phrase.end, "label")
            self.links.append({"when": "when", "main": "then_label"}.get(self.label or "main", "comma"))
            self._take_subject(phrase)
            self.at += 2
            return True
        if self.phrases.tag(phrase.end, "aspect") and self.phrases.tag(phrase.end + 1, "colon"):  # "Ego state: ..."
            self.links.append("comma")
            self._take_subject(phrase)
            self.at += 2
            return True
        if self.current is not None and not self.links and not self._clause_follows(phrase):
            return self._object(phrase)
        if phrase.kind == "pronoun" and self._may_be_either(phrase):
            raise self.phrases.refuse("it is not clear which vehicle is meant", phrase.span, fix="name the vehicle")
        if phrase.kind == "pronoun" and self._means_the_hero(phrase):
            self.phrases.assume(
                f"'{phrase.span.excerpt(self.phrases.text)}' is the hero: the ego is driven by its own policy"
            )
            self.phrases.subject = HERO_ID
        absolute = self.current is None and self.phrases.tokens[phrase.end].text.lower() in ("being", "having")
        self._take_subject(phrase)
        if self.phrases.tokens[self.at].text.lower() in ("itself", "himself", "herself"):
            self.at += 1
        if absolute and not self.links and self._amount_before_comma():
            self.links.append("when")  # "The ego being 30 m from the stop line, the hero brakes"
        return True

    def _clause_follows(self, phrase: NounPhrase) -> bool:
        """Whether a new clause begins without a comma: "when the ego is at the stop line the hero brakes"."""
        token = self.phrases.tokens[phrase.end]
        finite = "be" in token.tags or "auxiliary" in token.tags or bool(token.forms & {"s", "ed"})
        if finite and self.current is not None and self.current.verb != "yield":
            self.links.append("comma")
            return True
        return False
