"""`python -m scenewright` is the command `scenewright`."""

from __future__ import annotations

from scenewright.cli import main

if __name__ == "__main__":
    main()
