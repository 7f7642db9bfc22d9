"""prototype"""



from scenewright.errors import TranslationError
from scenewright.translate.assemble import Assembler
from scenewright.translate.gist.layout import laid_out
from scenewright.translate.gist.reader import GistReader
from scenewright.translate.itineraries import choose_routes, default_map
from scenewright.translate.offline import _all_amounts_used, _complete


def translate_gist(text, road_map=None, name="description"):
    chosen = road_map or default_map()
    tokens = laid_out(text, name)
    try:
        return _read(tokens, text, chosen, name)
    except TranslationError as error:
        rest = _without_title(tokens, text)
        if rest is None:
            raise
        try:
            return _read(rest[1], text, chosen, name, rest[0])
        except TranslationError:
            raise error from None


def _without_title(tokens, text):
    end = next((at for at, token in enumerate(tokens) if "end" in token.tags and not token.text.startswith(";")), None)
    if end is None or end >= len(tokens) - 2 or end == 0:
        return None
    title = tokens[:end]
    finite = any(t.tags.keys() & {"be", "auxiliary", "quantity"} or ("verb" in t.tags and not t.tags.keys() & {"event_noun", "actor_adjective", "label"}) for t in title)
    line = "\n" in text[tokens[end].span.start : tokens[end + 1].span.start]
    if finite and not line:
        return None
    if any("quantity" in t.tags for t in title):
        return None
    return title, tokens[end + 1 :]


def _read(tokens, text, chosen, name, title=()):
    reader = GistReader(tokens, text, name, chosen)
    facts = reader.read()
    _complete(facts, text, name)
    routes = choose_routes(facts, chosen, text, name)
    for c in (*facts.initial, *facts.trigger):
        if c.place is not None and c.place.target == "stop_line" and routes.of(c.actor).origin_kind != "driveway":
            raise TranslationError("this vehicle has no stop line", found="stop line")
        gap = c.ttc is not None or c.place is not None and isinstance(c.place.target, int)
        if gap and not routes.share_approach() and c.ttc is None:
            raise TranslationError("the two vehicles do not follow each other", found="gap")
    told = [w.value for w in reader.titles]
    told += [t.tags[k] for t in title for k in ("heading", "direction", "area") if t.tags.get(k, "lane") != "lane" and not ("verb" in t.tags and k == "area")]
    for value in told:
        if not any(value == r.turn or value in r.headings or value in (r.origin_kind, r.destination_kind) for r in (routes.ego, routes.hero)):
            raise TranslationError("neither vehicle does this", found=value)
    assembler = Assembler(facts, routes, text, name)
    program = assembler.program(chosen.name)
    _all_amounts_used(program, tokens, text, name)
    return program
