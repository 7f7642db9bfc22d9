from __future__ import annotations

import sys
from pathlib import Path

# `answering` belongs to these tests alone; import mode `importlib` puts no folder on the path.
sys.path.insert(0, str(Path(__file__).parent))
