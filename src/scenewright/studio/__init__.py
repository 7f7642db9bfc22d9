"""Run pages for people to look at.

What enters: a run directory. What leaves: a self-contained web page (`page.write_page`). It judges nothing.
"""
