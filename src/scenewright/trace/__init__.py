"""States over time: the model of a trace, and its file."""
