"""When a sentence is: the words in front of it that say so, and the moment that they lead to.

What enters: the chunks of a sentence, and what was told before. What leaves: `Leads`, and moments of the narrative.
What happens at these is none of its business.
"""

from __future__ import annotations

from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field

from scenewright.translate import story as st
from scenewright.translate.phrases import DOES
from scenewright.translate.read.chunks import Chunk
from scenewright.translate.read.clauses import OPERATORS, PEOPLE, Clause
from scenewright.translate.read.narrative import CHANGES, Doing, Narrative

_WORDS = ("then", "then left", "then right", "at once", "later", "meanwhile", "start", "same time")
Delay = tuple[st.Operator, st.Amount]


@dataclass(slots=True)
class Leads:
    """What says when a sentence is: words, after which turn, how much later; and the chunks that are left of it."""

    chunks: list[Chunk]
    words: set[str] = field(default_factory=set)
    turned: str = ""
    delay: Delay | None = None


def leads_of(story: Narrative, chunks: Sequence[Chunk]) -> Leads:
    """Take what says when a sentence is, at its front or behind its subject: ``then``, ``initially``, ``2 s later``."""
    found = Leads([])
    found.delay, chunks = _delay_of(chunks)
    found.words |= {"then"} if found.delay is not None else set()
    joined = any(chunk.value == "if" for chunk in chunks)  # its "then" is another
    for chunk in chunks:
        kept = found.chunks
        free = not kept or (not joined and kept[-1].kind in ("be", "mood", *PEOPLE) and chunk.value != "start")
        if chunk.kind == "link" and chunk.value in _WORDS and free:
            word, _, turned = chunk.value.partition("then ")
            if turned and found.turned not in ("", turned):
                story.refuse("two turns are told at once", chunk.quote)
            found.turned = found.turned or turned
            found.words.add(word or "then")
        elif kept or chunk.kind != "comma":
            kept.append(chunk)
    return found


def _delay_of(chunks: Sequence[Chunk]) -> tuple[Delay | None, Sequence[Chunk]]:
    """Take "2 s later", "2 s after that" and "after 2 s" off the front."""
    first = [each for each in chunks[:4] if each.kind != "comma"]
    kinds = [(each.kind, each.value) for each in first] + [("", "")] * 3
    bound = OPERATORS.get(kinds[0][1]) if kinds[0][0] == "bound" else None
    at = 1 if bound else 0
    if kinds[at][0] == "amount" and kinds[at + 1] in (("link", "later"), ("link", "then")):
        amount, taken = first[at].amount, first[: at + 2]
    elif kinds[0] == ("side", "after") and kinds[1][0] == "amount" and kinds[2][0] in PEOPLE:
        amount, taken = first[1].amount, first[:2]
    else:
        return None, chunks
    if amount is None or amount.dimension != "time":
        return None, chunks
    return (bound or "==", amount), [each for each in chunks if each not in taken]


def same_time(story: Narrative, pending: int | None) -> int | None:
    """Return the moment of what was told last: the one that waits for what happens, or when a deed began."""
    if pending is not None:
        return pending
    return story.doings[-1].begins if story.doings else None


def told_before(story: Narrative, clause: Clause) -> Doing | None:
    """Return the deed that a clause tells once more: nobody brakes, then brakes, unless a word says so."""
    own = next((each for each in reversed(story.doings) if each.actor == clause.subject), None)
    verb = st.Verb.BRAKE if clause.deed == "stop" else clause.deed
    return own if own is not None and own.verb == verb and verb in CHANGES and clause.ordinal == 0 else None


def moment_led_to(
    story: Narrative,
    clause: Clause,
    words: AbstractSet[str],
    delay: Delay | None,
    pending: int | None,
    is_tied: bool,
) -> int | None:
    """Return the moment at which a deed begins as the words in front of it say; None where it follows its own last.

    Who acts after somebody else did, and is not tied to that by a word, would be at it from the start.
    """
    last = story.doings[-1] if story.doings else None
    if "same time" in words:
        if last is None:
            story.refuse("it is not clear at the same time as what", fix="begin it with 'When ...,'")
        return last.begins
    acts = any(each.actor == clause.subject for each in story.doings)
    is_new = last is not None and not acts and not is_tied
    if delay is not None or ("then" in words and is_new):
        after = pending if pending is not None else _after(story, last, clause, delay is not None)
        op, margin = delay or (">", None)
        moment = story.new_moment()
        story.orders.append(st.Order(after, moment, op, margin, story.quote))
        return moment
    if is_new and clause.deed in (*CHANGES, "stop") and "start" not in words:
        fix = "begin it with 'When ...,', 'At the same time,' or 'Then'"
        story.refuse("it is not clear when this is done", fix=fix)
    return None


def _after(story: Narrative, last: Doing | None, clause: Clause, is_delayed: bool) -> int:
    """Return the moment that "then" and "2 s later" count from: the end of a deed, or its beginning."""
    if last is None:
        return st.START
    if last.ends is None and not last.rests:
        return last.begins
    if last.actor == clause.subject and not is_delayed:
        return story.finish(last)
    name, (_, begin, finish) = story.actor(last.actor).name, DOES.get(last.verb, ("", last.verb, last.verb))
    ways = [f"after {name} finishes {finish}", f"after {name} begins to {begin}"]
    # How much later somebody else reacts is told from what it may see first.
    usual = ways[is_delayed and last.actor != clause.subject]
    asked = f"When is this: {story.quote.text}"
    told = story.ask(f"then {story.quote.start}", asked, ways, ways.index(usual), story.quote)
    return story.finish(last) if told == ways[0] else last.begins
