"""The page as a file: self-contained, safe against what users write, small, the same every time."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenewright.studio.page import SCRIPTS, embed_json, write_page

HOSTILE = 'The "AV" </script><script>alert(1)</script> <!-- <b>née\u2028\\ ${style} 车辆 12 m & more'


def embedded(page: str) -> Any:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, flags=re.DOTALL)
    assert found is not None
    return json.loads(found[1])


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=12,
)


@given(json_values)
def test_embedded_json_reads_back_and_cannot_leave_its_element(value: Any) -> None:
    text = embed_json(value)
    assert json.loads(text) == value
    assert not re.search(r"[<>&]|[^\x20-\x7e]", text)


def test_not_a_number_is_refused() -> None:
    with pytest.raises(ValueError, match="not JSON compliant"):
        embed_json({"a": float("nan")})


def test_page_is_self_contained_and_small(run_dir: Path) -> None:
    path = write_page(run_dir)
    assert path == run_dir / "index.html"
    page = path.read_text(encoding="utf-8")
    assert len(page) < 1_000_000
    assert not re.search(r"""(src|href)\s*=|@import|url\(|\bfetch\(|XMLHttpRequest""", page)
    addresses = set(re.findall(r"https?://[^\s'\"]+", page))
    assert addresses == {"http://www.w3.org/2000/svg"}, "the name of a namespace is not fetched"


def test_same_run_same_bytes(run_dir: Path) -> None:
    first = write_page(run_dir).read_bytes()
    assert write_page(run_dir).read_bytes() == first


def test_policy_names_the_script_and_the_style_it_carries(run_dir: Path) -> None:
    page = write_page(run_dir).read_text(encoding="utf-8")
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)
    assert policy is not None
    assert "default-src 'none'" in policy[1]
    for pattern in (r"<style>(.*?)</style>", r"<script>(.*?)</script>"):
        content = re.search(pattern, page, flags=re.DOTALL)
        assert content is not None
        digest = base64.b64encode(hashlib.sha256(content[1].encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy[1]


def test_hostile_words_stay_words(run_dir: Path) -> None:
    manifest = json.loads((run_dir / "manifest.json").read_text(encoding="utf-8"))
    manifest |= {"name": HOSTILE, "description": HOSTILE}
    (run_dir / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    (run_dir / "program.scene").unlink()
    page = write_page(run_dir).read_text(encoding="utf-8")
    assert "<script>alert(1)" not in page
    assert page.count("</script>") == 2
    data = embedded(page)
    assert data["name"] == HOSTILE
    assert data["description"] == [{"text": HOSTILE, "ids": []}]


def test_every_script_file_is_used() -> None:
    from importlib.resources import files

    kept = {entry.name for entry in files("scenewright.studio").joinpath("assets").iterdir()}
    assert {name for name in kept if name.endswith(".js")} == set(SCRIPTS)
