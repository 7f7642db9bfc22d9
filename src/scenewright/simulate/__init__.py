"""The closed loop: how a run begins, the built-in simulator, what a run leaves behind."""
