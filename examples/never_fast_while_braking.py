"""Beyond the paper: what must hold throughout a stretch, not only at a knot.

Shows `never` and `always` over intervals of knots, conditions joined with ``&`` and ``|``, and a speed in km/h.
"""

from scenewright.program.builder import Scenario, always, conflict_point, never, si, stop_line


def build() -> Scenario:
    """Return the scenario."""
    scene = Scenario("slow left turner stops short", map="t_intersection")
    ego = scene.ego("W", sketch="t0 go t1 go t2")
    hero = scene.actor("hero", "E", "N", sketch="t0 go t1 dec t2")
    start, trigger, rest = hero.time("t0"), hero.time("t1"), hero.time("t2")

    scene.require(ego.time("t1") == trigger, id="same_moment")
    scene.require(ego.x("t1") == stop_line - 30, id="ego_place")
    scene.require(hero.x("t1") == conflict_point - 25, id="hero_place")
    scene.require(hero.x("t2") == conflict_point - 6, id="stop_place")
    scene.require(hero.v("t2") == 0, id="stands")

    scene.require(never(start, trigger, hero.v() > si(40, "km/h")), id="never_fast")
    scene.require(always(trigger, rest, (hero.a() <= -0.8) & (hero.a() >= -5)), id="brakes_evenly")
    scene.require((hero.v("t1") >= 4) | (ego.v("t1") <= 10), id="one_of_two")
    return scene


if __name__ == "__main__":
    print(build().text(), end="")
