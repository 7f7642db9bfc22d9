"""Plans the heroes' motion: few discrete choices, and a few convex problems a tick."""
