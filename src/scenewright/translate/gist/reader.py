"""Reads a free text for its gist: the facts that one scenario needs, wherever and however they are told.

What enters: the text, a map. What leaves: `Gist`: facts as the strict reader makes them, where each stands, and what
was set aside. A text is accepted only where every amount has its part, every way and deed fits, and no denial, bound
or order is left over; words that are not known are set aside, and said to be.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.errors import Span, TranslationError
from scenewright.roads import RoadMap, find_conflict
from scenewright.translate.events import EGO_ID, HERO_ID, Event
from scenewright.translate.facts import Facts
from scenewright.translate.geometry import is_remark
from scenewright.translate.gist.amounts import AmountReader
from scenewright.translate.gist.clauses import cut
from scenewright.translate.gist.dangers import refuse_dangers
from scenewright.translate.gist.deeds import DeedReader
from scenewright.translate.gist.disclaimers import disclaimers
from scenewright.translate.gist.layout import laid_out
from scenewright.translate.gist.leftovers import refuse_left_over
from scenewright.translate.gist.moments import MomentReader
from scenewright.translate.gist.names import find_names
from scenewright.translate.gist.shares import share
from scenewright.translate.gist.story import StoryTeller
from scenewright.translate.gist.strangers import (
    refuse_strange_company,
    refuse_strange_conditions,
    refuse_strange_deeds,
    refuse_strange_places,
    refuse_strange_ways,
    refuse_strangers,
    refuse_third_parties,
)
from scenewright.translate.gist.subjects import give_subjects
from scenewright.translate.gist.ways import Way, WayReader
from scenewright.translate.gist.wishes import fits, one_each, wishes
from scenewright.translate.gist.words import Words
from scenewright.translate.itineraries import Itineraries
from scenewright.translate.tokens import Token

_SHOWN = 60


@dataclass(frozen=True, slots=True)
class Gist:
    """What a text comes to.

    Attributes
    ----------
    facts, events
        As the strict reader makes them; an event for each fact.
    tokens
        What was read, without a title.
    told
        Headings, turns and areas that are told of no vehicle, in titles, with where: one vehicle must fit each.
    titles
        Ways told of no vehicle in a sentence: one vehicle must go all of them.
    meets
        Where it is said that the two ways meet.
    title
        The first line, where it was taken for a title.
    unplaced
        Whose way has to touch the driveway, and where it is spoken of, where nothing else was understood of it.
    assumptions
        What was set aside or taken for granted.
    """

    facts: Facts
    events: list[Event]
    tokens: list[Token]
    told: list[tuple[str, Span]]
    titles: list[list[Way]]
    meets: list[Span]
    title: list[Token]
    unplaced: list[tuple[int, Span]]
    assumptions: tuple[str, ...]


def read_gist(text: str, name: str, road_map: RoadMap) -> Gist:
    """Read a text for its gist.

    Raises
    ------
    TranslationError
        Where something is left over, contradicts something else, or is missing.
    """
    tokens = laid_out(text, name)
    try:
        return _read(Words(text, name, tokens), (), road_map)
    except TranslationError as error:
        title = _title_end(tokens, text)
        if title is None:
            raise
        try:
            return _read(Words(text, name, tokens[title + 1 :]), tuple(tokens[:title]), road_map)
        except TranslationError:
            raise error from None


def names_in(text: str, name: str) -> dict[int, int]:
    """Return who is named where in a text: actors by where their names begin."""
    tokens = laid_out(text, name)
    return {tokens[at].span.start: actor for at, actor in find_names(tokens).actors.items()}


def check_told(gist: Gist, routes: Itineraries, text: str, name: str) -> None:
    """Refuse a title that tells a way which neither vehicle goes, and amounts that the routes do not allow."""
    words = Words(text, name, gist.tokens)
    ways = [
        {route.turn, *route.headings, route.origin_kind, route.destination_kind} for route in (routes.ego, routes.hero)
    ]
    for value, span in gist.told:
        if not any(value in way for way in ways):
            raise words.refuse("neither vehicle does this", span)
    for title in gist.titles:
        if not any(all(fits(route, way) for way in title) for route in (routes.ego, routes.hero)):
            raise words.refuse("neither vehicle does this", title[0].span)
    if gist.meets and find_conflict(routes.ego, routes.hero) is None:
        raise words.refuse("it is said that the ways of the two vehicles meet, but they do not", gist.meets[0])
    if find_conflict(routes.ego, routes.hero) is None and (near := _near_conflict(gist.facts)) is not None:
        raise words.refuse("the ways of the two vehicles have no conflict point", near)
    for actor, span in gist.unplaced:
        if "driveway" not in (routes.of(actor).origin_kind, routes.of(actor).destination_kind):
            raise words.refuse("it is not clear what this vehicle has to do with the driveway", span)
    for phase in gist.facts.phases:
        if phase.place is not None and phase.place.target == "stop_line" and routes.hero.origin_kind != "driveway":
            raise words.refuse("the hero comes to no stop line", phase.place.span)
    for condition in (*gist.facts.initial, *gist.facts.trigger):
        place = condition.place
        if place is None:
            continue
        if place.target == "stop_line" and routes.of(condition.actor).origin_kind != "driveway":
            raise words.refuse("this vehicle comes to no stop line", place.span)
        if isinstance(place.target, int) and not routes.share_approach():
            raise words.refuse("the two vehicles do not follow each other", place.span)


def _near_conflict(facts: Facts) -> Span | None:
    """Return where a conflict point is spoken of."""
    places = [each.place for each in (*facts.initial, *facts.trigger)] + [each.place for each in facts.phases]
    return next((each.span for each in places if each is not None and each.target == "conflict_point"), None)


def _read(words: Words, title: tuple[Token, ...], road_map: RoadMap) -> Gist:
    refuse_dangers(words)
    words.names = find_names(words.tokens)
    words.clauses = cut(words)
    give_subjects(words)
    refuse_strangers(words)
    refuse_strange_ways(words)
    meets = _set_remarks_aside(words)
    measured = AmountReader(words).read()
    share(words, measured)
    acts = DeedReader(words)
    acts.read()
    ways = WayReader(words)
    ways.read()
    ways.ways += [Way("turn", "straight", at, words.tokens[at].span, actor) for actor, at in acts.straight]
    moments = MomentReader(words, measured, acts.deeds)
    moments.read()
    teller = StoryTeller(words, moments, acts.deeds)
    facts = teller.tell()
    facts.wishes = wishes(words, ways, road_map)
    facts.relations = one_each(words, ways.relations)
    facts.mentioned |= {EGO_ID, HERO_ID}
    refuse_strange_deeds(words, teller.trigger_sentence)
    refuse_strange_places(words, acts.deeds, teller.trigger_sentence)
    refuse_strange_conditions(words, max(made.at for made in moments.of("trigger")))
    refuse_strange_company(words, acts.deeds, teller.trigger_sentence)
    refuse_third_parties(words, acts.deeds, teller.trigger_sentence)
    refuse_left_over(words, acts.deeds, teller.trigger_sentence)
    events = [*(said.event for each in facts.wishes.values() for said in each.values()), *teller.events]
    titles: dict[int, list[Way]] = {}
    for way in ways.titles:
        titles.setdefault(next(each.start for each in words.clauses if way.at in each.inside), []).append(way)
    straight = {way.actor for way in ways.ways if way.key == "turn" and way.value == "straight"}
    unplaced = [(actor, span) for actor, span in ways.unplaced if actor not in straight]
    told: list[tuple[str, Span]] = []
    told += [(token.tags[key], token.span) for token in title for key in _told_by(token)]
    events = sorted({id(event): event for event in events}.values(), key=lambda event: event.span.start)
    return Gist(
        facts, events, words.tokens, told, list(titles.values()), meets, [*title], unplaced, _assumptions(words, title)
    )


def _set_remarks_aside(words: Words) -> list[Span]:
    """Set "so their paths cross" aside, and return where it stands: the routes have to fit it."""
    found = []
    for clause in words.clauses:
        if not clause.named and is_remark(words.tokens[clause.start : clause.end]):
            clause.aside = True
            found.append(words.span(clause))
    return found


def _told_by(token: Token) -> list[str]:
    """Return the tags of a title's word that tell a way."""
    area = token.tags.get("area", "lane") != "lane" and "verb" not in token.tags
    return [key for key in ("heading", "direction") if key in token.tags] + (["area"] if area else [])


def _title_end(tokens: list[Token], text: str) -> int | None:
    """Return where a title ends that tells no fact of its own, or None where there is none."""
    ends = (at for at, token in enumerate(tokens) if "end" in token.tags and not token.text.startswith(";"))
    end = next(ends, 0)
    telling = ("quantity", "unsupported", "colon")
    named = end > 2 and tokens[0].tags.get("label") == "none" and "colon" in tokens[1].tags
    if named and not any(token.tags.keys() & {"quantity", "unsupported"} for token in tokens[:end]):
        return end  # "Test: left turn in front of the SUT."
    if not 0 < end < len(tokens) - 2 or any(token.tags.keys() & set(telling) for token in tokens[:end]):
        return None
    line = "\n" in text[tokens[end].span.start : tokens[end + 1].span.start]
    finite = any(
        token.tags.keys() & {"be", "auxiliary"}
        or ("verb" in token.tags and not token.tags.keys() & {"event_noun", "actor_adjective", "label"})
        for token in tokens[:end]
    )
    return end if line or not finite else None


def _assumptions(words: Words, title: tuple[Token, ...]) -> tuple[str, ...]:
    """Return what was set aside, in sentences."""
    said = ["the text was read for its facts, not clause by clause"]
    if words.names.guessed is not None:
        said.append(f"'{words.names.guessed}' is taken for the other vehicle")
    if title:
        span = title[0].span.union(title[-1].span)
        said.append(f"'{_shown(span, words.text)}' is taken for a title")
    said += [f"'{written}' is read as '{read}'" for token in words.tokens for written, read in token.slips]
    for clause in words.clauses:
        if clause.aside:
            said.append(
                f"'{_shown(words.span(clause), words.text)}' is set aside: it tells nothing of the two vehicles"
            )
    said += [
        f"'{_shown(span, words.text)}' is set aside: it says that it changes nothing"
        for span in disclaimers(words.text)
    ]
    aside = {at for clause in words.clauses if clause.aside for at in clause.inside}
    told = {at for at in words.used if words.word(at) == "clock"}  # "5 s clock" was said for "5 s after the start"
    known = {*words.names.actors, *aside, *told}
    strange = [t.text for at, t in enumerate(words.tokens) if "unknown" in t.tags and at not in known]
    if strange := list(dict.fromkeys(each for each in strange if each.isalpha())):
        listed = ", ".join(f"'{word}'" for word in strange)
        said.append(f"not understood and set aside: {listed}")
    return tuple(said)


def _shown(span: Span, text: str) -> str:
    words = " ".join(span.excerpt(text).split())
    return words if len(words) <= _SHOWN else words[:_SHOWN] + "..."
