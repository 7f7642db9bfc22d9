"""A policy of one's own: two methods, nothing to inherit. `scenewright run ... --ego examples/timid.py:Timid`."""


class Timid:
    """Keeps 8 m/s, and brakes while another car is within 15 m."""

    def __init__(self, keep_mps: float = 8.0) -> None:
        self.keep_mps = keep_mps

    def reset(self, start) -> None:
        """Nothing to remember."""

    def step(self, observation, dt_s: float) -> float:
        """Return an acceleration in m/s^2."""
        ego = observation.ego
        near = [o for o in observation.others if abs(o.x_m - ego.x_m) + abs(o.y_m - ego.y_m) < 15.0]
        return -3.0 if near and ego.speed_mps > 0.0 else 0.5 * (self.keep_mps - ego.speed_mps)
