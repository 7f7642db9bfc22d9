"""The closed loop: built-in simulator, replanner, prediction."""
