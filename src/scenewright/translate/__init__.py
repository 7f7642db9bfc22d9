"""From a description to a program: the offline translator, the language-model translator, repair."""
