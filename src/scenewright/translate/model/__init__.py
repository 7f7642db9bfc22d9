"""Language models: the prompt, the story that a model replies with, and what is believed of it."""
