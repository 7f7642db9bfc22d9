"""Descriptions that these tests say again and again."""

from __future__ import annotations

from scenewright.cli.app import SENTENCE

OPEN_SENTENCE = SENTENCE.replace("25 m", "ego_gap_m")
IMPOSSIBLE = (
    "The ego drives westbound. An oncoming hero turns left into the driveway. When the ego is 25 m before the "
    "conflict point and the hero is 30 m before the conflict point at 200 km/h, the hero decelerates to a complete "
    "stop 8 m before the conflict point."
)

__all__ = ["IMPOSSIBLE", "OPEN_SENTENCE", "SENTENCE"]
