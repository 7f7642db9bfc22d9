"""Solvers behind one protocol; each is found by name and imported when it is used."""
