"""Beyond the paper: two cars, each with a trigger of its own. The lead brakes, and later an oncoming car turns left.

Shows more than one orchestrated actor: the trigger of each is a knot that it shares with the ego.
"""

from scenewright.program.builder import Scenario, conflict_point, stop_line


def build() -> Scenario:
    """Return the scenario."""
    scene = Scenario("lead turns off, then an oncoming car yields", map="t_intersection")
    ego = scene.ego("W", sketch="t0 go t1 go t2 go t3")
    lead = scene.actor("lead", "W", sketch="t0 go t1 dec t2")
    oncoming = scene.actor("oncoming", "E", "N", sketch="t0 go t1 dec t2")

    scene.require(ego.time("t1") == lead.time("t1"), id="first_trigger")
    scene.require(ego.gap_to(lead, "t1") == 30, id="gap_to_lead")
    scene.require(ego.x("t1") == stop_line - 120, id="ego_at_first_trigger")
    scene.require(lead.a("dec") == -1.5, id="lead_brakes")
    scene.require(lead.v("t2") >= 5, id="lead_goes_on")

    scene.require(ego.time("t2") == oncoming.time("t1"), id="second_trigger")
    scene.require(ego.x("t2") == stop_line - 40, id="ego_at_second_trigger")
    scene.require(oncoming.x("t1") == conflict_point.of(oncoming) - 30, id="oncoming_at_second_trigger")
    scene.require(oncoming.x("t2") == conflict_point.of(oncoming) - 6, id="oncoming_stops_here")
    scene.require(oncoming.v("t2") == 0, id="oncoming_stands")
    return scene


if __name__ == "__main__":
    print(build().text(), end="")
