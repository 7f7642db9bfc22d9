"""Language models: the prompt, the story that a model replies with, and what is believed of it.

Nothing that a model wrote is executed; a reply is data that is held against the words it quotes.
"""
