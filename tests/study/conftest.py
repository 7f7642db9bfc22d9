from __future__ import annotations

import sys
from pathlib import Path

# `scenarios` and `strategies` are shared by several folders of tests; import mode `importlib` puts none on the path.
sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parent))
