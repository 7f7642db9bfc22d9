from __future__ import annotations

import sys
from pathlib import Path

# `small_programs` is a helper of these tests alone, `scenarios` and `strategies` are shared by several folders; import
# mode `importlib` puts none on the path.
sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1])]
