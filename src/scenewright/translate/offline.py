"""The offline translator: a description in English becomes a program, without network or server.

What enters: a description and, optionally, the map it is about. What leaves: a `Translation`: the program, how every
clause was read, and what had to be assumed. Readers that know rules read it (`rules`). A small network that was trained
on descriptions (`learned`) stands in where they do not know the words, if it is sure, and stands against what they pick
out of a free text where it is sure of something else: then the text is refused.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from scenewright.errors import MapError, Place, Span, TranslationError, UnknownWordsError
from scenewright.program.types import Program
from scenewright.roads.grounding import ground
from scenewright.translate.confidence import Basis
from scenewright.translate.itineraries import default_map
from scenewright.translate.learned.reader import Likely, read_likely
from scenewright.translate.reading_back import read_back
from scenewright.translate.rules import read_by_rules
from scenewright.translate.translation import Reading, Translation, refuse_two_ways
from scenewright.translate.unsayable import refuse_unsayable
from scenewright.translate.values import take_values, with_values

if TYPE_CHECKING:
    from scenewright.roads import RoadMap

# How sure the network has to be. Chosen on texts that it was not trained on: docs/evaluation.md says how.
SURE_ENOUGH_TO_READ = 0.8
SURE_ENOUGH_TO_DOUBT = 0.7
WORTH_A_HINT = 0.3
UNSAYABLE = 0.05  # the probability of being sayable below which what the rules read is refused

_HINT = " - a description like this one may mean, but not surely: "


def translate_offline(text: str, road_map: RoadMap | None = None, name: str = "description") -> Translation:
    """Translate a description without network or model.

    Parameters
    ----------
    text
        The description. Numbers carry units; `snake_case_parameters` end in theirs.
    road_map
        The map it is about; the T intersection that is shipped where None. Its routes decide directions left unsaid.
    name
        What to call the program, and the text in messages.

    Returns
    -------
    Translation
        With spans into `text`.

    Raises
    ------
    TranslationError
        Where neither reader understands the text, where they understand different things, and where it contradicts
        itself or leaves a choice open.

    Examples
    --------
    >>> text = ("Ego is on the driveway exit and wants to turn right. The hero travels westbound along the road. "
    ...         "When the ego is 12 m behind the stop line, the hero brakes to a stop 5 m before the conflict point.")
    >>> [actor.route.headings for actor in translate_offline(text).program.actors]
    [('S', 'W'), ('W',)]
    """
    chosen_map = road_map if road_map is not None else default_map()
    rest, given = take_values(text, name)
    if rest == text:
        return _translated(text, chosen_map, name)
    try:
        read = _translated(rest, chosen_map, name)
    except TranslationError as error:
        if error.place is not None and error.place.text == rest:
            error.place = replace(error.place, text=text)
        raise
    readings = (Reading(each.span, each.span.excerpt(text), str(each), ()) for each in given)
    program = with_values(read.program, given, text, name)
    return replace(read, program=program, readings=(*read.readings, *readings))


def _translated(text: str, road_map: RoadMap, name: str) -> Translation:
    """Translate what is left when the values of parameters are taken out."""
    refuse_unsayable(text, name)
    try:
        read = read_by_rules(text, road_map, name)
    except UnknownWordsError as error:
        likely = read_likely(text, name, road_map)
        if likely is None or likely.probability < SURE_ENOUGH_TO_READ:
            if likely is not None and likely.probability > WORTH_A_HINT:
                error.fix = f"{error.fix or ''}{_HINT}{' '.join(read_back(likely.program))}".strip()
            raise
        return _by_likeness(likely, error, text)
    _check_on_map(read.program, text, road_map, name)
    _doubt(read, text, road_map, name)
    return read


def _by_likeness(likely: Likely, error: UnknownWordsError, text: str) -> Translation:
    """Return what the text means by its likeness to others, and say among the assumptions what rules could not read."""
    basis = Basis.LIKENESS.value
    readings = tuple(
        Reading(part.span, part.span.excerpt(text), part.meaning, part.constraint_ids, basis.value, basis.meaning)
        for part in likely.parts
    )
    sure = f"{min(likely.probability, 0.99):.0%} sure"
    assumed = (
        f"the text was read by its likeness to descriptions whose meaning is known, {sure}: compare the program with "
        f"what was meant ({error.message})"
    )
    return Translation(likely.program, readings, (assumed, *likely.assumptions))


def _check_on_map(program: Program, text: str, road_map: RoadMap, name: str) -> None:
    """Refuse a text that speaks of a place which these two routes do not have on this map."""
    try:
        ground(program, road_map)
    except MapError as error:
        whole = Place(name, text, Span(0, len(text)))
        raise TranslationError(
            error.message, place=whole, found=error.found, expected=error.expected, fix=error.fix
        ) from None


def _doubt(read: Translation, text: str, road_map: RoadMap, name: str) -> None:
    """Refuse what was picked out of a free text where texts like this one mean something else, or nothing sayable."""
    if not read.by_facts:
        return  # the grammar of its clauses accounts for every word of it
    likely = read_likely(text, name, road_map)
    if likely is None:
        return
    if likely.sayable < UNSAYABLE:
        raise TranslationError(
            "this seems to say something that no program can say",
            place=Place(name, text, likely.doubtful),
            found=likely.doubtful.excerpt(text),
            expected="what a program can say: places, times, speeds, one moment, one deed of one other vehicle",
            fix="say only where the two vehicles are, which way they go, when the hero reacts and what it does",
        )
    if likely.probability > SURE_ENOUGH_TO_DOUBT:
        expected = "one meaning by rules and by likeness to other descriptions"
        refuse_two_ways(read.program, likely.program, text, name, expected)
