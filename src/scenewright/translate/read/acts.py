"""What is done and what is so: a turn, a speed or an event that happens is a deed, and some deeds are told twice.

What enters: the clauses of a sentence. What leaves: those that say something, with their deeds; courtesies and what
somebody does not do are given to the narrative.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
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
    for item in items:
        if "for" in item.times and item.subject not in (None, EGO):  # "stands for 4 s"
            lasting(item)
        if (item.subject, item.deed) == (EGO, st.Verb.DRIVE) and item.says_more_than("deed") and not happens:
            item.deed = None  # nobody tells it to: "the ego proceeds west"
    acts = _Acts(story, items, happens, any(each.deed is not None for each in items))
    for item in items:
        acts.take(item)
    return acts.found


@dataclass(slots=True)
class _Acts:
    """The clauses of a sentence while it is found out what is done in them."""

    story: Narrative
    items: list[Clause]
    happens: bool
    acts: bool  # one of them tells a deed
    found: list[Clause] = field(default_factory=list)
    ways: set[int | None] = field(default_factory=set)  # whose way is told besides a deed

    def take(self, item: Clause) -> None:
        """Take a clause: what somebody does not do, what is done, and its way."""
        story, refrains = self.story, item.flags & REFRAINS
        if item.subject is not None and item.flags & (COURTESIES | REFRAINS):
            story.subject = item.subject
        story.courtesies += [(item.subject, each, item.quote) for each in item.flags & COURTESIES]
        always = not self.happens and all(doing.actor != item.subject for doing in story.doings)
        story.refrains += [(item.subject, each, item.quote, always) for each in sorted(refrains)]
        item.flags -= COURTESIES | REFRAINS
        is_way = _is_way(item) and not self._is_meant(item)
        self._refuse_unclear(item, is_way)
        self._find_deed(item, is_way, bool(refrains))
        if item.subject == EGO and "first" in item.flags:
            item.flags -= {"first"}
            story.afterwards.append(partial(story.ego_first, item.quote))  # when all that is done is told
        if self.acts:
            self.ways |= {item.subject} if is_way and item.facts else set()
            story.tell(item)
        self._join(item)

    def _is_of_hero(self, item: Clause) -> bool:
        """Whether what it says may be a deed: it happens, and not to the ego."""
        return self.happens and item.deed is None and item.subject not in (None, EGO)

    def _is_meant(self, item: Clause) -> bool:
        return "wanted" in item.notes or ("relative" in item.notes and self.acts)

    def _before(self, item: Clause) -> Clause:
        """Return the clause before, where it is of the same one."""
        return self.found[-1] if self.found and self.found[-1].subject == item.subject else Clause(item.quote)

    def _refuse_unclear(self, item: Clause, is_way: bool) -> None:
        """Refuse a way or a place beside what is done of which nothing says when that is."""
        before, then = self._before(item), "then" in item.notes
        own = any(each.deed and each.subject == item.subject for each in self.found)
        own |= self.acts and any(each.actor == item.subject for each in self.story.doings)
        leaves = self._is_of_hero(item) and is_way and "origin" in item.notes  # "when ..., the van leaves the driveway"
        inside = "area" in item.notes and (self.happens or own or item.deed != st.Verb.STAND)  # "stops in the driveway"
        both = "kept" in item.flags or {"kept", "first"} <= item.flags | before.flags  # "goes first, keeping its speed"
        both &= item.deed is None and before.deed in ("go first", st.Verb.DRIVE)
        late = (is_way and not self.happens and (own or then)) or (then and item.subject in self.ways)
        turns = item.turns and item.deed is not None and not self._is_meant(item)  # "turns right accelerating to 8 m/s"
        beside = own and item.quote.text.split()[0].endswith("ing")  # "brakes, turning left"
        is_turning = _is_way(item) and {"wanted", "relative"} & item.notes == {"wanted"} and (beside or not self.acts)
        if leaves or inside or both or late or (self.happens and (turns or is_turning)):
            self.story.refuse("it is not clear when or where this is done", item.quote, "say it as a deed of its own")

    def _find_deed(self, item: Clause, is_way: bool, refrains: bool) -> None:
        """Make a deed of a turn, a way, a speed, an event or an order that happens."""
        story, is_of_hero, meant, turns = self.story, self._is_of_hero(item), self._is_meant(item), item.turns
        bare = "turn" not in item.facts and "drives" not in item.notes  # "the car, westbound, brakes"
        own = any(each.deed and each.subject == item.subject for each in self.found)
        aside = self.acts and not (own or "then" in item.notes)
        aside &= bare or "ing" in [each[-3:] for each in item.quote.text.split()]
        if is_of_hero and "event" in item.notes and not (turns or item.says_more_than("facts", "measures")):
            story.tell(item)  # "turns into the driveway"
        drives = "drives" in item.notes and not (self.acts or meant or item.says_more_than())  # "Then it drives"
        goes_on = item.times and any(doing.actor == item.subject for doing in story.doings)
        if is_of_hero and (drives or (is_way and not (turns or aside))):
            story.tell(item)
            item.deed = st.Verb.DRIVE  # "then it goes straight on"
        elif is_of_hero and turns and not meant:
            story.tell_way(item.subject or EGO, item.facts, turns_then=True)
            item.facts, item.deed = {}, "turn"
        elif is_of_hero and not self.acts and (ends := _comes_to(item)):
            item.flags, item.deed = item.flags | ends, st.Verb.DRIVE
        elif is_of_hero and "first" in item.flags and not item.says_more_than("flags"):
            item.flags, item.deed = item.flags - {"first"}, "go first"
        elif "kept" in item.flags and (is_of_hero or goes_on) and not item.says_more_than("flags", "times", "measures"):
            item.deed = st.Verb.DRIVE  # "when ..., it keeps its speed"; "It keeps this speed for 5 s"
        elif is_of_hero and refrains and all(other is item or not other.says_more_than() for other in self.items):
            item.deed = st.Verb.DRIVE  # "when ..., it does not brake"
        elif is_of_hero and item.phase == "begins" and not item.says_more_than("phase"):
            item.phase, item.deed, item.notes = None, st.Verb.DRIVE, item.notes | {"sets off"}  # "it starts driving"
        elif item.phase == "begins" and item.deed is None and item.measures:
            self._start(item, is_of_hero)
        elif is_of_hero and not self.acts and "event" in item.notes and not item.is_event:
            story.refuse("it is not clear when this is so", item.quote)  # "passes it 20 m ahead of the ego"

    def _start(self, item: Clause, is_of_hero: bool) -> None:
        """Take what begins with an amount: somebody drives so fast from then, or is there at the start."""
        item.phase = None
        if is_of_hero and item.measures[0].quantity is st.Quantity.SPEED:  # "starts driving at 8 m/s"
            item.deed, item.flags = st.Verb.DRIVE, item.flags | {"to"}
            item.notes |= set() if item.facts else {"sets off"}
            item.facts = {} if item.facts.get("turn") == "straight" else item.facts
        elif any(each.deed is not None and each.subject == item.subject for each in self.items):
            self.story.refuse("it is not clear what starts there", item.quote, "say it in front of what is done")
        else:  # "starts 40 m before the stop line"
            item.flags.add("start")

    def _join(self, item: Clause) -> None:
        """Keep a clause, as one with that before it where both are of one deed."""
        before = self._before(item)
        beside = "then" not in item.notes and [each[-3:] for each in item.quote.text.split()[:1]] == ["ing"]
        passes = item.is_event and before.rests  # "brakes to a stop, passing the stop line"
        if beside and before.deed and (passes or item.deed in CHANGES or (item.deed and before.deed == "turn")):
            if before.deed != st.Verb.DRIVE or before.says_more_than("deed"):  # "turns left, accelerating at 2 m/s^2"
                told = "it is not clear whether this is done then or meanwhile"
                self.story.refuse(told, item.quote, "say 'then', or 'while'")
            item.notes |= self.found.pop().notes & {"sets off"}  # "pulls out, accelerating to 8 m/s"
            before = Clause(item.quote)
        if item.deed == "stop" and "comes" in before.notes and not item.measures:  # "drives to the line and stops"
            if before.says_more_than("deed", "measures"):
                self.story.refuse("it is not clear where it stops", item.quote, "say it: 'stops at ...'")
            item.measures, before = self.found.pop().measures, Clause(item.quote)
        brakes, halts = before.deed == st.Verb.BRAKE, before.rests
        if brakes:  # "brakes and stands 5 m before"
            let_stand(item, "stop")
        # Who stands passes nothing, and what has an end of its own does not end there: that comes after it.
        over = halts or before.deed == st.Verb.STAND or (brakes and "then" in item.notes)
        over |= before.deed is not None and bool(before.measures or "for" in before.times)
        more = before.says_more_than("deed", "phase", "rates", "measures", "times", "begins", "flags")
        more |= bool(before.flags - {"standstill"} or "later" in item.times) or (halts and "for" in before.times)
        more |= "event" in before.notes  # "brakes, passes the stop line and stops"
        if before.deed is not None and not over and item.is_event:
            before.measures, before.notes = item.measures, before.notes | item.notes | {"does"}
        elif (brakes or halts) and item.deed == "stop" and not more:  # it is told twice
            self.found[-1] = item
            _take_all(item, before)
        elif item.says_more_than():
            if (over or self._is_of_hero(item)) and item.is_event:
                _pass(item)
            self.found.append(item)
            comes = [each for each in item.measures if st.is_event(each)]
            if "to" in item.flags and "event" in item.notes and comes and item.deed in CHANGES:
                # "It speeds up to 14 m/s so that it passes the stop line": not just there.
                item.measures = [each for each in item.measures if each not in comes]
                item.notes -= {"event"}
                self.found.append(Clause(item.quote, item.subject, st.Verb.DRIVE, measures=comes, notes={"event"}))


def _take_all(clause: Clause, before: Clause) -> None:
    """Take the amounts of a clause that tells the same: who "brakes for 3 s and stops" brakes so long."""
    clause.measures[:0], clause.rates[:0], clause.begins[:0] = before.measures, before.rates, before.begins
    for name, several in before.times.items():
        clause.times.setdefault("in" if name == "for" else name, [])[:0] = several
    clause.agree()


def _pass(clause: Clause) -> None:
    """Let an event be a deed: somebody drives to a place, or turns."""
    starts = [each.place for each in clause.measures] == [st.Place("turn_start")]
    turns = "turns" in clause.quote.text.lower().split()
    clause.deed = st.Verb.DRIVE
    if starts or turns:  # "then it turns"
        clause.measures, clause.deed = [], "turn"
    if starts and not turns:  # what is told of when is of that, not of when it has turned
        clause.phase, clause.notes = "begins", clause.notes - {"event"}


def _is_way(clause: Clause) -> bool:
    return bool(clause.facts) and not clause.says_more_than("facts")


def _comes_to(clause: Clause) -> set[str]:
    """Return to what somebody comes that drives past a place, or passes it at a speed; nothing where it does not."""
    places = [each for each in clause.measures if each.quantity is st.Quantity.PLACE]
    speeds = [each for each in clause.measures if each.quantity is st.Quantity.SPEED]
    passes = bool(speeds) and "event" in clause.notes and all(map(st.is_event, places))
    past = "drives" in clause.notes and all(each.op == ">" or each.opposite for each in places)
    told = not places or len(places) + len(speeds) != len(clause.measures) or clause.says_more_than("measures")
    return set() if told or not (passes or past) else {"to there", *(["to"] if speeds else [])}


def let_stand(clause: Clause, deed: str) -> None:
    """Let that somebody stands be a deed, where it is said and no other is."""
    stands = st.standstill(clause.subject or EGO)
    if clause.deed is None and stands in clause.measures:
        clause.deed, clause.measures = deed, [each for each in clause.measures if each != stands]


def lasting(clause: Clause) -> None:
    """Let what lasts until something be a deed: "it stands until ...", "it drives at 8 m/s until ..."."""
    let_stand(clause, st.Verb.STAND)
    if clause.deed is None and ("drives" in clause.notes or "kept" in clause.flags):
        clause.deed = st.Verb.DRIVE


def shares_of(story: Narrative, clause: Clause) -> tuple[list[st.Measure], list[st.Measure], list[st.Measure]]:
    """Return what a deed's own clause says of its beginning, of the deed throughout, and of its end."""
    rests = clause.rests
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
