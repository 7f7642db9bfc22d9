"""Plans the heroes' motion: few discrete choices, and one convex problem a tick."""
