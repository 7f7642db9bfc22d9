"""The offline translator: a description of the paper's kind becomes a program, without network or server.

What enters: a description and, optionally, the map it is about. What leaves: a `Translation`: the program, how every
clause was read, and what had to be assumed. It reads clause by clause (`rules`) and has to understand every word: free
prose is refused, with the advice to let a model translate it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from scenewright.errors import MapError, Place, Span, TranslationError, UnknownWordsError
from scenewright.program.types import Program
from scenewright.roads.grounding import ground
from scenewright.translate.itineraries import default_map
from scenewright.translate.rules import read_by_rules
from scenewright.translate.translation import Reading, Translation
from scenewright.translate.unsayable import refuse_unsayable
from scenewright.translate.values import take_values, with_values

if TYPE_CHECKING:
    from scenewright.roads import RoadMap

_ADVICE = "or let a language model read it: --translator PROVIDER:MODEL (scenewright translate --help)"


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
        Where the text is not understood, contradicts itself, or leaves a choice open.

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
        error.fix = f"{error.fix}; {_ADVICE}" if error.fix else _ADVICE
        raise
    _check_on_map(read.program, text, road_map, name)
    return read


def _check_on_map(program: Program, text: str, road_map: RoadMap, name: str) -> None:
    """Refuse a text that speaks of a place which these two routes do not have on this map."""
    try:
        ground(program, road_map)
    except MapError as error:
        whole = Place(name, text, Span(0, len(text)))
        raise TranslationError(
            error.message, place=whole, found=error.found, expected=error.expected, fix=error.fix
        ) from None
