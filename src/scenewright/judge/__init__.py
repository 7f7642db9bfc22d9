"""Conditions measured over traces, margins, verdict."""
