"""What is done and what is so: a turn, a speed or an event that happens is a deed, and some deeds are told twice.

What enters: the clauses of a sentence. What leaves: those that say something, with their deeds; courtesies and what
somebody does not do are given to the narrative.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from scenewright.errors import TranslationError
from scenewright.program.types import EGO
from scenewright.translate import story as st
from scenewright.translate.compile import DRIVEN, refused_deed, refused_kind
from scenewright.translate.read.chunks import Chunk
from scenewright.translate.read.clauses import Clause
from scenewright.translate.read.narrative import CHANGES, COURTESIES, REFRAINS, Narrative


def acts_of(story: Narrative, items: list[Clause], happens: bool) -> list[Clause]:
    """Return what is done and what is so: a turn, a speed or an event is a deed where it `happens`.

    What only says why (yields, does not give way) is kept to be checked; a deed and the event at its end are one,
    and so is one that is told twice: "it brakes at 3 m/s^2 and stops at the stop line".
    """
    found: list[Clause] = []
    for item in items:
        if "for" in item.times and item.subject not in (None, EGO):  # "stands for 4 s"
            lasting(item)
        if (item.subject, item.deed) == (EGO, st.Verb.DRIVE) and item.says_more_than("deed") and not happens:
            item.deed = None  # nobody tells it to: "the ego proceeds west"
    acts, ways = any(each.deed is not None for each in items), set[int | None]()
    for item in items:
        story.courtesies += [(item.subject, each, item.quote) for each in item.flags & COURTESIES]
        refrains = item.flags & REFRAINS
        if item.subject is not None and item.flags & (COURTESIES | REFRAINS):
            story.subject = item.subject
        always = not happens and all(doing.actor != item.subject for doing in story.doings)
        story.refrains += [(item.subject, each, item.quote, always) for each in sorted(refrains)]
        item.flags -= COURTESIES | REFRAINS
        is_hero = happens and item.deed is None and item.subject not in (None, EGO)
        goes_on = item.times and any(doing.actor == item.subject for doing in story.doings)
        meant = "wanted" in item.notes or ("relative" in item.notes and acts)
        turns = item.facts.get("turn", "straight") != "straight"
        before = found[-1] if found and found[-1].subject == item.subject else Clause(item.quote)
        is_bare = bool(item.facts) and not item.says_more_than("facts")
        is_way, is_meant = is_bare and not meant, {"wanted", "relative"} & item.notes == {"wanted"}  # "is turning"
        own, then = any(each.deed and each.subject == item.subject for each in found), "then" in item.notes
        leaves = is_hero and is_way and "origin" in item.notes  # "when ..., the van leaves the driveway"
        inside = "area" in item.notes and (happens or own or item.deed != st.Verb.STAND)  # "stops in the driveway"
        both = "kept" in item.flags or {"kept", "first"} <= item.flags | before.flags  # "goes first, keeping its speed"
        both &= item.deed is None and before.deed in ("go first", st.Verb.DRIVE)
        late = (is_way and not happens and (own or then)) or (then and item.subject in ways)
        late |= happens and turns and item.deed is not None and not meant  # "turns right accelerating to 8 m/s"
        if leaves or inside or both or late or (is_bare and is_meant and happens and not acts):
            story.refuse("it is not clear when or where this is done", item.quote, "say it as a deed of its own")
        bare = "turn" not in item.facts and "drives" not in item.notes  # "the car, westbound, brakes"
        aside = acts and not (own or then) and (bare or "ing" in [each[-3:] for each in item.quote.text.split()])
        if is_hero and "event" in item.notes and not (turns or item.says_more_than("facts", "measures")):
            story.tell(item)  # "turns into the driveway"
        drives = "drives" in item.notes and not (acts or meant or item.says_more_than())  # "Then it drives"
        if is_hero and (drives or (is_way and not (turns or aside))):
            story.tell(item)
            item.deed = st.Verb.DRIVE  # "then it goes straight on"
        elif is_hero and turns and not meant:
            story.tell_way(item.subject or EGO, item.facts, turns_then=True)
            item.facts, item.deed = {}, "turn"
        elif is_hero and not acts and (ends := _comes_to(item)):
            item.flags, item.deed = item.flags | ends, st.Verb.DRIVE
        elif is_hero and "first" in item.flags and not item.says_more_than("flags"):
            item.flags, item.deed = item.flags - {"first"}, "go first"
        elif "kept" in item.flags and (is_hero or goes_on) and not item.says_more_than("flags", "times", "measures"):
            item.deed = st.Verb.DRIVE  # "when ..., it keeps its speed"; "It keeps this speed for 5 s"
        elif is_hero and refrains and all(other is item or not other.says_more_than() for other in items):
            item.deed = st.Verb.DRIVE  # "when ..., it does not brake"
        elif is_hero and item.phase == "begins" and not item.says_more_than("phase"):
            item.phase, item.deed, item.notes = None, st.Verb.DRIVE, item.notes | {"sets off"}  # "it starts driving"
        elif item.phase == "begins" and item.deed is None and item.measures:
            item.phase = None
            if is_hero and item.measures[0].quantity is st.Quantity.SPEED:  # "starts driving at 8 m/s"
                item.deed, item.flags = st.Verb.DRIVE, item.flags | {"to"}
                item.notes |= set() if item.facts else {"sets off"}
                item.facts = {} if item.facts.get("turn") == "straight" else item.facts
            else:  # "starts 40 m before the stop line"
                if any(each.deed is not None and each.subject == item.subject for each in items):
                    story.refuse("it is not clear what starts there", item.quote, "say it in front of what is done")
                item.flags.add("start")
        elif is_hero and not acts and "event" in item.notes and not item.is_event:
            story.refuse("it is not clear when this is so", item.quote)  # "passes it 20 m ahead of the ego"
        if item.subject == EGO and "first" in item.flags:
            item.flags -= {"first"}
            story.afterwards.append(partial(story.ego_first, item.quote))  # when all that is done is told
        if acts:
            ways |= {item.subject} if is_way and item.facts else set()
            story.tell(item)
        beside = item.quote.text.split()[0].endswith("ing") and "then" not in item.notes
        if beside and before.deed and (item.deed in CHANGES or (item.deed and before.deed == "turn")):
            if before.deed != st.Verb.DRIVE or before.says_more_than("deed"):  # "turns left, accelerating at 2 m/s^2"
                told = "it is not clear whether this is done then or meanwhile"
                story.refuse(told, item.quote, "say 'then', or 'while'")
            item.notes |= found.pop().notes & {"sets off"}  # "pulls out, accelerating to 8 m/s"
            before = Clause(item.quote)
        if item.deed == "stop" and "comes" in before.notes and not item.measures:  # "drives to the line and stops"
            if before.says_more_than("deed", "measures"):
                story.refuse("it is not clear where it stops", item.quote, "say it: 'stops at ...'")
            item.measures, before = found.pop().measures, Clause(item.quote)
        rest, brakes = st.standstill(item.subject or EGO), before.deed == st.Verb.BRAKE
        if brakes and item.deed is None and rest in item.measures:  # "brakes and stands 5 m before"
            item.deed, item.measures = "stop", [each for each in item.measures if each != rest]
        twice = (before.deed, item.deed) == (st.Verb.BRAKE, "stop")
        stands = before.deed in ("stop", st.Verb.STAND)  # who stands passes nothing: that comes after it
        if before.deed is not None and not stands and item.is_event and not before.measures:
            before.measures, before.notes = item.measures, before.notes | item.notes
        elif twice and not before.says_more_than("deed", "phase", "rates", "measures", "times", "begins"):
            found[-1], item.rates, item.begins = item, [*before.rates, *item.rates], [*before.begins, *item.begins]
            item.measures = [*before.measures, *item.measures]
            item.times |= {name: [*several, *item.times.get(name, ())] for name, several in before.times.items()}
            item.agree()
        elif item.says_more_than():
            if (is_hero or stands) and item.is_event:
                item.deed, starts = st.Verb.DRIVE, [each.place for each in item.measures] == [st.Place("turn_start")]
                turns = "turns" in item.quote.text.lower().split()
                if starts or turns:  # "then it turns"
                    item.measures, item.deed = [], "turn"
                if starts and not turns:  # what is told of when is of that, not of when it has turned
                    item.phase, item.notes = "begins", item.notes - {"event"}
            found.append(item)
            comes = [each for each in item.measures if st.is_event(each)]
            if "to" in item.flags and "event" in item.notes and comes and item.deed in CHANGES:
                # "It speeds up to 14 m/s so that it passes the stop line": not just there.
                item.measures = [each for each in item.measures if each not in comes]
                item.notes -= {"event"}
                found.append(Clause(item.quote, item.subject, st.Verb.DRIVE, measures=comes, notes={"event"}))
    return found


def _comes_to(clause: Clause) -> set[str]:
    """Return to what somebody comes that drives past a place, or passes it at a speed; nothing where it does not."""
    places = [each for each in clause.measures if each.quantity is st.Quantity.PLACE]
    speeds = [each for each in clause.measures if each.quantity is st.Quantity.SPEED]
    passes = bool(speeds) and "event" in clause.notes and all(map(st.is_event, places))
    past = "drives" in clause.notes and all(each.op == ">" or each.opposite for each in places)
    told = not places or len(places) + len(speeds) != len(clause.measures) or clause.says_more_than("measures")
    return set() if told or not (passes or past) else {"to there", *(["to"] if speeds else [])}


def lasting(clause: Clause) -> None:
    """Let what lasts until something be a deed: "it stands until ...", "it drives at 8 m/s until ..."."""
    stands = st.standstill(clause.subject or EGO)
    if clause.deed is None and stands in clause.measures:
        clause.deed, clause.measures = st.Verb.STAND, [each for each in clause.measures if each != stands]
    elif clause.deed is None and ("drives" in clause.notes or "kept" in clause.flags):
        clause.deed = st.Verb.DRIVE


def shares_of(story: Narrative, clause: Clause) -> tuple[list[st.Measure], list[st.Measure], list[st.Measure]]:
    """Return what a deed's own clause says of its beginning, of the deed throughout, and of its end."""
    rests = clause.deed == "stop" or "standstill" in clause.flags
    begins, held, ends = [*clause.begins], list[st.Measure](), [st.standstill(clause.subject or EGO)] * rests
    for measure in clause.measures:
        fast = measure.quantity is st.Quantity.SPEED
        if rests and measure.quantity is st.Quantity.ARRIVAL:
            story.refuse("who stands has no time to arrival", clause.quote, "say where it stands, in metres")
        if fast and clause.deed == st.Verb.DRIVE and clause.rates and measure.op in ("<", "<="):
            story.refuse("it is not clear whether it is to be so fast", measure.quote, "say 'speeds up to ...'")
        if fast and "to" not in clause.flags and clause.deed != st.Verb.DRIVE:
            story.refuse("it is not clear when it is so fast")
        ends_there = rests or bool(clause.flags & {"to", "to there"}) or st.is_event(measure)
        starts = clause.phase == "begins" or "sets off" in clause.notes
        at_it = st.is_event(measure) and not (rests or clause.notes & {"event", "comes"})  # "accelerates at the line"
        if starts and not rests and measure.quantity is st.Quantity.PLACE and "event" not in clause.notes:
            ends_there = "comes" in clause.notes and st.is_event(measure)  # "begins to brake to 4 m/s 30 m before it"
        onwards = clause.deed in (st.Verb.DRIVE, st.Verb.SPEED_UP)
        ends_there |= onwards and (measure.opposite or measure.op == ">")  # "continues past it"
        timed = measure.quantity in (st.Quantity.HEADWAY, st.Quantity.COLLISION) and "to there" not in clause.flags
        stays = clause.deed == st.Verb.STAND or timed or not (ends_there or fast)
        text, at = story.text, measure.quote or clause.quote
        aside = text[: at.start].rstrip().endswith(",") and "," in text[at.end : clause.quote.end]
        apart = measure.quantity in (st.Quantity.GAP, st.Quantity.FREE_SPACE) and "distance" in clause.notes
        is_open = at_it and not starts and "to" not in clause.flags and clause.deed in (st.Verb.DRIVE, *CHANGES)
        if is_open or (rests and (aside or apart or "between" in clause.notes)):
            brakes = ["where it begins to brake", "where it stands"]  # "brakes, 8 m before it, to standstill"
            here = ["where this begins", "where this ends"] if is_open else brakes
            stays = story.ask(f"where {at.start}", f"What is '{at.text}'?", here, None, at) == here[0]
        (held if fast and "to" not in clause.flags else begins if stays else ends).append(measure)
    return begins, held, ends


def unknown_to_programs(chunks: Sequence[Chunk]) -> TranslationError | None:
    """Return the error that names what no program can say: where a sentence has that, it is why it is not read."""
    for chunk in chunks:
        if chunk.kind == "actor" and chunk.value not in (*DRIVEN, "ego", "hero"):
            return refused_kind(chunk.value, chunk.quote)
        if chunk.kind == "deed" and chunk.value not in (*st.Verb, "stop"):
            return refused_deed(chunk.text.lower(), chunk.quote)
    return None
