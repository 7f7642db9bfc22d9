"""A second reader for free texts: it looks for the facts that a scenario needs, and sets aside what tells none.

Where `offline` reads every clause by its grammar, this reader looks for names, amounts, ways and deeds, and asks that
they make one whole scenario: every amount used once, every way and every deed consistent, nothing denied or bounded
left over.
"""
