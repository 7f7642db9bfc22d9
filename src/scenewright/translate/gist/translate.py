from scenewright.translate.gist.reader import check_told, read_gist
from scenewright.translate.gist.words import Words
from scenewright.translate.itineraries import choose_routes, default_map
from scenewright.translate.assemble import Assembler
from scenewright.translate.offline import _all_amounts_used, _complete
def translate_gist(text, road_map=None, name="description"):
    chosen = road_map or default_map()
    g = read_gist(text, name, chosen)
    _complete(g.facts, text, name)
    routes = choose_routes(g.facts, chosen, text, name)
    check_told(g, routes, Words(text, name, g.tokens))
    assembler = Assembler(g.facts, routes, text, name)
    program = assembler.program(chosen.name)
    _all_amounts_used(program, g.tokens, text, name)
    return program
