"""The same request gives the same bytes of trace, in another process too; another seed gives others."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from stories import STORIES

CODE = """
import sys
from pathlib import Path
from scenewright.orchestrate import orchestrate
from scenewright.request import Request
out, text = Path(sys.argv[1]), sys.stdin.read()
for ego in sys.argv[2:]:
    name, seed = ego.split("/")
    orchestrate(Request(text, ego=name, seed=int(seed), out=out / f"{name}-{seed}", explain="nothing", replan_hz=2.0))
"""


def drive(out: Path, hash_seed: str, *egos: str) -> dict[str, bytes]:
    """Drive egos, each ``NAME/SEED``, in a process of its own and return their traces."""
    subprocess.run(
        [sys.executable, "-c", CODE, str(out), *egos],
        input=STORIES["yields, distance"],
        text=True,
        check=True,
        env={**os.environ, "PYTHONHASHSEED": hash_seed},
    )
    return {ego: (out / ego.replace("/", "-") / "trace.parquet").read_bytes() for ego in egos}


def test_same_seed_same_bytes_in_any_process(tmp_path: Path) -> None:
    first = drive(tmp_path / "1", "1", "noisy/7", "noisy/8", "idm/7", "stop-and-go/7")
    second = drive(tmp_path / "2", "4321", "stop-and-go/7", "idm/8", "noisy/7")
    assert first["noisy/7"] == second["noisy/7"]
    assert first["stop-and-go/7"] == second["stop-and-go/7"]
    assert first["noisy/7"] != first["noisy/8"]
    assert first["idm/7"] == second["idm/8"], "one that leaves nothing to chance drives alike with every seed"
