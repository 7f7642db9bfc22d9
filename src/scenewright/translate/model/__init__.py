"""The language-model translator: one prompt, replies that are data, verified and sent back until they hold.

Importing the package costs nothing; `translator` holds the way through, `providers` is imported only to ask a server.
"""
