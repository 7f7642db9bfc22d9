"""Piecewise-polynomial motion, symbolic and numeric from one source."""
