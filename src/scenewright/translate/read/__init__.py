"""The offline reader: from controlled English, and ordinary variation of it, to a story."""
