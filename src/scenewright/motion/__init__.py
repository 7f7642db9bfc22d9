"""Piecewise-polynomial motion profiles, symbolic and numeric."""
