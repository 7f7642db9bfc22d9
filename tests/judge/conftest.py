from __future__ import annotations

import sys
from pathlib import Path

# `plays` is a helper of these tests alone; import mode `importlib` does not put their folder on the path.
sys.path.insert(0, str(Path(__file__).parent))
