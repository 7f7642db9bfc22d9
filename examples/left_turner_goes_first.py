"""An oncoming car turns left across the ego's way: the same program that the text form gives, written in Python.

Shows states and landmarks as Python expressions, an open parameter with a range, and an outcome as an order of moments.
"""

from scenewright.program.builder import Scenario, conflict_point, stop_line


def build() -> Scenario:
    """Return the scenario."""
    scene = Scenario("left turner goes first", map="t_intersection")
    ego = scene.ego("W", sketch="t0 go t1 go t2")
    hero = scene.actor("hero", "E", "N", sketch="t0 go t1 acc t2")
    ego_distance = scene.parameter("ego_distance_m", low=25, high=60)

    # Trigger: both are where they should be, at one and the same moment.
    scene.require(ego.time("t1") == hero.time("t1"), id="same_moment")
    scene.require(ego.x("t1") == stop_line - ego_distance, id="ego_place")
    scene.require(hero.x("t1") == conflict_point - 15, id="hero_place")

    # What the hero does: it passes the conflict point before the ego gets there.
    scene.require(hero.x("t2") == conflict_point, id="hero_passes")
    scene.require(ego.x("t2") == conflict_point, id="ego_passes")
    scene.require(hero.time("t2") < ego.time("t2"), id="hero_first")
    return scene


if __name__ == "__main__":
    print(build().text(), end="")
