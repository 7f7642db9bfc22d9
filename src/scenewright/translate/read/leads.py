"""When a sentence is: the words in front of it that say so, the moment that they lead to, and how long that lasts.

What enters: the chunks of a sentence, and what was told before. What leaves: `Leads`, moments of the narrative, and
what is asked of when something is. What happens then is none of its business.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, field, replace
from itertools import zip_longest

from scenewright.translate import story as st
from scenewright.translate.phrases import DOES
from scenewright.translate.read.chunks import Chunk
from scenewright.translate.read.clauses import OPERATORS, PEOPLE, Clause
from scenewright.translate.read.items import Margin, Segment, items_of, margins_of
from scenewright.translate.read.narrative import CHANGES, Doing, Narrative

_WORDS = ("then", "at once", "later", "meanwhile", "start", "same time")
_TURNS = ("turn", "turn left", "turn right")
_LATER = {"then", "later"}


@dataclass(slots=True)
class Leads:
    """What says when a sentence is: words, after which deed of its own, how much later; and the chunks left of it."""

    chunks: list[Chunk]
    words: set[str] = field(default_factory=set)
    own: str = ""
    delay: Margin | None = None
    pending: int | None = None  # a moment that was told just before, and nobody did anything at it
    moment: int | None = None  # that the sentence tells itself
    is_of_last: bool = False  # that moment stands behind what is done: it is of the last deed

    def moment_of(self, story: Narrative, when: list[Clause]) -> int:
        """Return the moment that a sentence tells: one, for all that is said of it."""
        if self.moment is None:
            self.moment = story.moment(when)
        return self.moment


def leads_of(story: Narrative, chunks: Sequence[Chunk], words: Set[str] = frozenset()) -> Leads:
    """Take what says when a sentence is, at its front or behind its subject: ``then``, ``initially``, ``2 s later``."""
    delay, chunks = _delay_of(chunks)
    found = Leads([], {*words, *(["then"] if delay is not None else [])}, "", delay)
    joined = any(chunk.value == "if" for chunk in chunks)  # its "then" is another
    for chunk, following in zip_longest(chunks, chunks[1:]):
        kept = found.chunks
        one = not joined and all(each.kind not in ("comma", "joint", "deed") for each in kept)
        free = not kept or (one and kept[-1].kind in ("be", "mood", *PEOPLE) and chunk.value != "start")
        word, _, own = chunk.value.partition("then ")
        # "After braking to 5 m/s" says more than that it did.
        whole = own in ("", *_TURNS) or (following is not None and following.kind in ("comma", *PEOPLE))
        if chunk.kind == "link" and (own or word in _WORDS) and free and whole:
            if own and found.own not in ("", own):
                story.refuse("two deeds are told at once", chunk.quote)
            found.own = found.own or own
            found.words.add(word or "then")
            found.words |= {"that"} if chunk.text.lower().startswith(("at that", "at this")) else set()
        elif kept or chunk.kind != "comma":
            kept.append(chunk)
    return found


def _delay_of(chunks: Sequence[Chunk]) -> tuple[Margin | None, Sequence[Chunk]]:
    """Take "2 s later", "2 s after that" and "after 2 s" off the front."""
    first = [each for each in chunks[:4] if each.kind != "comma"]
    kinds = [(each.kind, each.value) for each in first] + [("", "")] * 3
    bound = OPERATORS.get(kinds[0][1]) if kinds[0][0] == "bound" else None
    at = 1 if bound else 0
    (kind, value), amount, taken = kinds[at + 1], None, first
    if kinds[at][0] == "amount" and kind == "link" and (value == "later" or value.startswith("then")):
        amount, taken = first[at].amount, first[: at + 2]
    elif kinds[0] == ("side", "after") and kinds[1][0] == "amount" and kinds[2][0] in PEOPLE:
        amount, taken = first[1].amount, first[:2]
    if amount is None or amount.dimension != "time":
        return None, chunks
    return (bound or "==", amount), [each for each in chunks if each not in taken]


def same_time(story: Narrative, words: Set[str]) -> int | None:
    """Return the moment of the deed that was told last, if any was: its beginning, or its end ("that")."""
    if not story.doings:
        return None
    last = story.doings[-1]
    if "that" in words and (last.ends is not None or last.rests):
        name, (_, begin, finish) = story.actor(last.actor).name, DOES[last.verb]
        ways = [f"when {name} begins to {begin}", f"when {name} finishes {finish}"]
        if not story.is_first("moment", "When is this", ways, story.quote):
            return story.finish(last)
    return last.begins


def told_before(story: Narrative, clause: Clause) -> Doing | None:
    """Return the deed that a clause tells once more: nobody brakes, then brakes, unless a word says so."""
    own = story.last_of(clause.subject)
    verb = st.Verb.BRAKE if clause.deed == "stop" else clause.deed
    if own is None or clause.ordinal:
        return None
    closed = own.verb == st.Verb.DRIVE and own.ends is not None and own.begins != st.START
    if (own.turns or closed) and verb in CHANGES and not clause.says_more_than("deed", "rates"):
        ways = ["after its turn", "while it turns"] if own.turns else ["after that", "meanwhile"]
        if not story.is_first("turn", "When is this", ways, clause.quote):
            own.verb = verb or own.verb
            return own
    is_open = own.ends is None and not own.rests and own.verb in (st.Verb.DRIVE, st.Verb.SPEED_UP)
    passes = verb == st.Verb.DRIVE and "event" in clause.notes and is_open  # "speeds up. It passes it before the ego"
    return own if passes or (own.verb == verb and verb in CHANGES) else None


def moment_led_to(story: Narrative, clause: Clause, leads: Leads, is_tied: bool) -> int | None:
    """Return the moment at which a deed begins as the words in front of it say; None where it follows its own last.

    Who acts after somebody else did, and is not tied to that by a word, would be at it from the start.
    """
    last, words, delay = story.doings[-1] if story.doings else None, leads.words, leads.delay
    if "same time" in words:
        if last is None:
            story.refuse("it is not clear at the same time as what", fix="begin it with 'When ...,'")
        return same_time(story, words)
    own = story.last_of(clause.subject)
    if "meanwhile" in words and own is not None and own is last:
        story.refuse("two deeds at one time are told of one")
    stops = own is not None and (own.rests or own.verb == st.Verb.STAND or own.ends is not None)
    did = own is not None and (stops if leads.own == "stop" else own.verb == leads.own)
    if leads.own and not (did or leads.own in _TURNS):
        story.refuse("it was not told that it did this before")
    is_new = (last is not None or story.since is not None) and own is None and not is_tied
    follows = (last is not own or story.since is not None) and not leads.own
    if delay is not None or (words & _LATER and follows):
        told = None if leads.own else story.since if leads.pending is None else leads.pending
        after = _after(story, own if leads.own else last, clause, leads) if told is None else told
        if after is None:
            return None
        moment = story.new_moment()
        for op, margin in margins_of([delay] if delay else []) or [(">", None)]:
            story.orders.append(st.Order(after, moment, op, margin, story.quote))
        return moment
    if is_new and clause.deed in (*CHANGES, "stop") and "start" not in words:
        fix = "begin it with 'When ...,', 'At the same time,' or 'Then'"
        story.refuse("it is not clear when this is done", fix=fix)
    return None


def _after(story: Narrative, last: Doing | None, clause: Clause, leads: Leads) -> int | None:
    """Return the moment that "then" and "2 s later" count from: the end of a deed, or its beginning; None: its own."""
    if last is None:
        return st.START
    if last.actor == clause.subject and (leads.own or leads.delay is None):
        return story.finish(last)
    ways: dict[str, tuple[Doing, bool]] = {}  # the deed, and whether its end
    if last.ends is not None or last.rests or last.lasts:
        ways[f"after {story.actor(last.actor).name} finishes {DOES[last.verb][2]}"] = last, True
    ways[f"after {story.actor(last.actor).name} begins to {DOES[last.verb][1]}"] = last, False
    # How much later somebody else reacts is told from what it may see first.
    default = len(ways) - 1 if leads.delay is not None and last.actor != clause.subject and not last.lasts else 0
    own = story.last_of(clause.subject)
    if own is not None and own is not last:
        ways[f"after {story.actor(own.actor).name} finishes {DOES[own.verb][2]}, whatever others do"] = own, True
    if len(ways) > 1:
        asked = f"When is this: {story.quote.text}"
        told = story.ask(f"then {story.quote.start}", asked, [*ways], default, story.quote)
    deed, is_end = ways[told if len(ways) > 1 else next(iter(ways))]
    if deed is own and own is not last and leads.delay is None:
        return None
    return story.finish(deed) if is_end else deed.begins


def told_moment(story: Narrative, segment: Segment) -> list[Clause]:
    """Return what is so at a moment; as soon as it is so a bound is just reached, and who has passed just passes."""
    when = items_of(story, segment.chunks)
    if not segment.is_sharp:
        return when
    told = [each for clause in when for each in clause.measures]
    sides = {st.not_beyond(each) for each in told}  # "less than 12 m before it" says it besides
    measures = [each for each in told if each not in sides]
    if any(clause.joined for clause in when):
        story.refuse("it is not clear which of these comes to be so then", fix="say a sentence for each")
    for clause in when:
        clause.notes -= {"has"}
    if all(each.op != "==" for each in measures):
        if len(measures) > 1:
            story.refuse("it is not clear which of these comes to be so then", fix="say one exactly, as in '20 m'")
        for clause in when:
            clause.measures = [replace(each, op="==") for each in clause.measures if each in measures]
    return when


def all_the_while(story: Narrative, when: list[Clause]) -> list[st.Condition]:
    """Return what is so all the while: "While the ego stands, ..."; what is exact is so at a moment."""
    moving = list[st.Condition]()
    for clause in when:
        if clause.deed is not None:
            story.assumptions.append(f"'{clause.quote.text}' is from when that begins")
        moving += [each for each in clause.conditions if not isinstance(each, st.Measure) or each.op != "=="
                   or each == st.standstill(each.actor)]  # fmt: skip
    if any(clause.is_event for clause in when):
        story.refuse("it is not clear how long this is so", fix="say from when until when, or 'When ...'")
    ways = ["all the while", "when it begins"]
    return moving if moving and story.is_first("while", "How long is this so", ways, story.quote) else []


def is_of_who_acts(story: Narrative, main: Sequence[Chunk], tail: Sequence[Chunk]) -> bool:
    """Whether what stands behind a moment is of who acts: how it does that is; another deed is asked about.

    Who brakes may well stop. Who comes to a stop passes nothing then, so that is of another, or of another time.
    """
    does = next((each for each in tail if each.kind in ("deed", "event", "standstill") or each.value == "stands"), None)
    brakes = any(each.value == st.Verb.BRAKE for each in main)
    if does is None or (brakes and does.value in ("stop", "standstill", "stands")):
        return True
    stops = any(each.kind == "standstill" or each.value == "stop" for each in main)
    ways = ["of who acts", "of whom the moment is"]
    asked = f"Of whom is '{does.text}': {story.quote.text}"
    passes = stops and does.kind == "event"
    return not passes and story.ask(f"whose {does.start}", asked, ways, 0, does.quote) == ways[0]
