"""How Sphinx builds the documentation: MyST pages, nothing fetched from anywhere."""

from importlib.metadata import version as installed_version

project = "Scenewright"
author = "The Scenewright authors"
copyright = "The Scenewright authors"
version = release = installed_version("scenewright")

extensions = ["myst_parser"]
# No formula markup: it would be laid out by a script that the reader's browser fetches from the network.
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]
nitpicky = True

html_theme = "furo"
html_title = f"Scenewright {release}"
html_copy_source = False
html_show_sphinx = False
