"""Scenewright: a sentence in, a judged closed-loop traffic test out.

Read `scenewright.orchestrate` first: it is the whole way from text to verdict in one short file.
"""

__version__ = "0.1.0"
