"""The closed loop: built-in simulator, prediction of the ego, re-solving."""
