"""Wrong replies, made from right ones: one slot is exchanged for another of its kind, as by misreading."""

from __future__ import annotations

import copy
import random
from collections.abc import Callable, Iterator
from typing import Any

from scenewright.translate.phrases import PLACES
from scenewright.translate.story import Verb
from scenewright.units import UNITS

Reply = dict[str, Any]
OPERATORS = ("==", ">=", "<=", ">", "<")
AMOUNTS_AND_ORDERS = ("number", "unit", "parameter", "parameter with words", "two amounts", "order")


def _nodes(node: Any, test: Callable[[Reply], bool]) -> Iterator[Reply]:
    if isinstance(node, dict):
        if test(node):
            yield node
        for each in node.values():
            yield from _nodes(each, test)
    elif isinstance(node, list):
        for each in node:
            yield from _nodes(each, test)


def amounts_in(story: Reply) -> list[Reply]:
    return list(_nodes(story, lambda node: "unit" in node and "value" in node))


def measures_in(story: Reply) -> list[Reply]:
    return list(_nodes(story, lambda node: "quantity" in node))


def _ways_in(story: Reply) -> list[Reply]:
    return [each["way"] for each in story["actors"]]


def _same(one: Reply, other: Reply) -> bool:
    return all(one.get(slot) == other.get(slot) for slot in ("value", "unit", "name"))


def corruptions(reply: Reply, seed: int = 0) -> Iterator[tuple[str, Reply]]:
    """Yield kinds of faults with replies that have one: in every slot, one exchange by chance."""
    pick = random.Random(seed)

    def changed(kind: str, find: Callable[[Reply], list[Reply]], place: int, new: dict[str, Any]) -> tuple[str, Reply]:
        wrong = copy.deepcopy(reply)
        find(wrong["story"])[place].update(new)
        return kind, wrong

    story = reply["story"]
    names = [actor["name"] for actor in story["actors"]]
    amounts = amounts_in(story)
    for place, amount in enumerate(amounts):
        dimension = UNITS[amount["unit"]].dimension
        if amount.get("name") is None and amount["value"] != "0":
            number = str(float(amount["value"]) + pick.choice((1, 2, 10))) if "/" not in amount["value"] else "7"
            yield changed("number", amounts_in, place, {"value": number})
            units = [each for each in UNITS if UNITS[each].dimension == dimension and each != amount["unit"]]
            yield changed("unit", amounts_in, place, {"unit": pick.choice(units)})
        alike = [each for each in amounts if UNITS[each["unit"]].dimension == dimension]
        others = [each for each in alike if not _same(each, amount)]
        named = [each for each in others if each.get("name") and amount.get("name")]
        if named:
            other = pick.choice(named)
            yield changed("parameter", amounts_in, place, {"name": other["name"], "unit": other["unit"]})
            yield changed("parameter with words", amounts_in, place, copy.deepcopy(other))
        if others:
            other = pick.choice(others)
            wrong = copy.deepcopy(reply)
            found = amounts_in(wrong["story"])
            number = next(index for index, each in enumerate(amounts) if each is other)
            one, two = copy.deepcopy(found[place]), copy.deepcopy(found[number])
            found[place].update(two)
            found[number].update(one)
            yield "two amounts", wrong
    for place, measure in enumerate(measures_in(story)):
        others = [name for name in names if name not in (measure["actor"], measure.get("other"))]
        if others:
            yield changed("actor", measures_in, place, {"actor": pick.choice(others)})
        if measure.get("other"):
            turned = {"actor": measure["other"], "other": measure["actor"]}
            yield changed("actor and other", measures_in, place, turned)
        if measure.get("place"):
            name = pick.choice([each for each in PLACES if each != measure["place"]["name"]])
            yield changed("place", measures_in, place, {"place": {**measure["place"], "name": name}})
        if measure["quantity"] in ("place", "acceleration") and measure.get("amount"):
            yield changed("opposite", measures_in, place, {"opposite": not measure.get("opposite", False)})
        op = pick.choice([each for each in OPERATORS if each != measure["op"]])
        yield changed("operator", measures_in, place, {"op": op})
        own = (measure.get("amount") or measure)["words"]
        moved = [each["words"] for each in measures_in(story) if own not in each["words"]]
        if moved:
            yield changed("quote", measures_in, place, {"words": pick.choice(moved)})
    for place, order in enumerate(story.get("orders", ())):
        turned = {"first": order["second"], "second": order["first"]}
        yield changed("order", lambda story: list(story["orders"]), place, turned)
    for place, deed in enumerate(story.get("deeds", ())):
        verb = pick.choice([each for each in Verb if each != deed["verb"]])
        yield changed("deed", lambda story: list(story["deeds"]), place, {"verb": verb})
        others = [name for name in names if name != deed["actor"]]
        yield changed("doer", lambda story: list(story["deeds"]), place, {"actor": pick.choice(others)})
    for place, actor in enumerate(story["actors"]):
        way = actor["way"]
        for slot, values in (
            ("heading", "NESW"),
            ("turn", ("left", "right", "straight")),
            ("origin", ("road", "driveway")),
        ):
            if way.get(slot):
                new = pick.choice([each for each in values if each != way[slot]])
                yield changed(slot, _ways_in, place, {slot: new})
        for relation in actor.get("relations", ()):
            new = pick.choice(
                [each for each in ("ahead", "behind", "oncoming", "from the left") if each != relation["kind"]]
            )
            wrong = copy.deepcopy(reply)
            wrong["story"]["actors"][place]["relations"][0]["kind"] = new
            yield "relation", wrong
