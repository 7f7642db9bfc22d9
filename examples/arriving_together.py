"""Beyond the paper: a family of scenarios from one function. Both cars are the same time away from the conflict point.

Shows times to arrival (distance over speed) on both sides, what Python adds (loops, functions), and `junction_start`.
"""

from scenewright.program.builder import Scenario, conflict_point, junction_start

ARRIVALS_S = (2.5, 3.0, 3.5, 4.0)


def build(arrival_s: float = 3.0) -> Scenario:
    """Return the scenario in which ego and hero are `arrival_s` away from the conflict point when the hero brakes."""
    scene = Scenario(f"arriving together in {arrival_s:g} s", map="t_intersection")
    ego = scene.ego("W", sketch="t0 go t1 go t2")
    hero = scene.actor("hero", "E", "N", sketch="t0 go t1 dec t2")
    scene.require(ego.time("t1") == hero.time("t1"), id="same_moment")
    scene.require(ego.tta(conflict_point, "t1") == arrival_s, id="ego_arrival")
    scene.require(hero.tta(conflict_point, "t1") == arrival_s, id="hero_arrival")
    scene.require(hero.x("t2") <= junction_start + 4, id="stops_early")
    scene.require(hero.x("t2") >= junction_start, id="stops_at_the_junction")
    scene.require(hero.v("t2") == 0, id="stands")
    return scene


if __name__ == "__main__":
    for seconds in ARRIVALS_S:
        print(build(seconds).text())
