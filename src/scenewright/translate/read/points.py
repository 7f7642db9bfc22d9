"""Moments that a text names, what it tells of the order of two of them, and what holds from one until another.

What enters: chunks that name moments. What leaves: moments, orders and holds of the narrative. Whose deeds begin and
end there is told elsewhere.
"""

from __future__ import annotations

from scenewright.translate import story as st
from scenewright.translate.read.chunks import Chunk
from scenewright.translate.read.items import ORDERS, Segment, items_of
from scenewright.translate.read.narrative import Narrative

HOW: dict[str, st.How] = {"always": "always", "never": "never", "at some time": "at some time"}


def event_of(story: Narrative, chunks: list[Chunk]) -> int:
    """Return the moment of the one event that chunks tell."""
    items = items_of(story, chunks)
    if any("said" not in each.notes for each in items):  # "before the ego, at 12 m/s"
        told = story.text[chunks[0].start : chunks[-1].end]
        story.refuse("it is not clear of whom this is", st.Quote(chunks[0].start, chunks[-1].end, told))
    more = [each for item in items for each in item.measures if not st.is_event(each) and each.op == "=="]
    comes = [each for item in items for each in item.measures if st.is_event(each)]
    speeds = [each for each in more if each != st.standstill(each.actor)]
    if len(items) != 1 or items[0].times or (comes and speeds):  # "before the ego begins to turn, at 5 m/s"
        story.refuse("this is not one event")
    return story.event(items[0])


def point_of(story: Narrative, chunks: list[Chunk]) -> st.Point:
    """Return what "2 s before the hero begins to brake" tells."""
    offset, earlier = None, False
    if len(chunks) > 1 and chunks[0].kind == "amount" and chunks[1].value in ("before", "after"):
        offset, earlier = chunks[0].amount, chunks[1].value == "before"
        chunks = chunks[2:]
    at_start = [chunk.value for chunk in chunks] == ["the start"]
    return st.Point(st.START if at_start else event_of(story, chunks), offset, earlier)


def put_in_order(story: Narrative, moment: int, rest: list[Segment]) -> None:
    """Take what comes before or after a moment."""
    for segment in rest:
        if segment.link not in ORDERS:
            story.refuse("it is not clear before or after what")
        other = event_of(story, segment.chunks)
        first, second = (other, moment) if segment.link in ("after", "no earlier than") else (moment, other)
        if first == second:
            story.refuse("one and the same is told to be before itself")
        if st.START in (first, second):
            story.refuse("this is told of what is so from the start: nothing was before that")
        for op, margin in segment.margins or [(">=" if segment.link.startswith("no ") else ">", None)]:
            story.orders.append(st.Order(first, second, op, margin, story.quote))


def read_hold(story: Narrative, chunks: list[Chunk], how: Chunk) -> None:
    """Read ``From ... until ..., always: ...``."""
    at, links = chunks.index(how), [chunk.value for chunk in chunks]
    if links[0] != "from" or "until" not in links[:at]:
        fix = "From the start until ..., never: ..."
        story.refuse(f"'{how.text}' needs a time from which and until which", fix=fix)
    until = links.index("until")
    start = point_of(story, chunks[1:until])
    end = point_of(story, [each for each in chunks[until + 1 : at] if each.kind != "comma"])
    items = items_of(story, [each for each in chunks[at + 1 :] if each.text != ":"])
    conditions = story.conditions(items)
    if len(items) != 1 or not conditions:
        story.refuse("one condition holds all the while", fix="write a sentence for each")
    condition = conditions[0] if len(conditions) == 1 else st.Compound("and", tuple(conditions))
    story.holds.append(st.Hold(HOW[how.value], start, end, condition, story.quote))


def read_ego_order(story: Narrative, chunks: list[Chunk]) -> None:
    """Read ``In the ego's order: ..., then ...``."""
    if story.ego is not None:
        story.refuse("the ego's order is told twice")
    events: list[list[Chunk]] = [[]]
    for chunk in chunks[1:]:
        if chunk.value == "then":
            events.append([])
        elif chunk.kind not in ("comma", "nothing"):
            events[-1].append(chunk)
    story.ego = tuple(event_of(story, chunks) for chunks in events if chunks)
