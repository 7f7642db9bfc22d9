"""Naming a policy: ours, a user's, a package's; and what is said where that fails."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from scenewright.drive import loading
from scenewright.drive.loading import BUILT_IN, load_policy, policy_descriptions
from scenewright.drive.protocol import EgoPolicy
from scenewright.errors import PolicyError

MINE = """
from pathlib import Path
from typing import Literal

class Mine:
    def __init__(
        self, keep_mps: float = 8.0, count: int = 3, loud: bool = False, label="x", target: "float | None" = None
    ):
        self.got = (keep_mps, count, loud, label, target)
    def reset(self, start): pass
    def step(self, observation, dt_s): return 0.0

class Chooses(Mine):
    def __init__(
        self, mode: Literal["soft", "hard"] = "soft", steps: Literal[1, 2] | None = None, at: Path = Path("x")
    ):
        self.got = (mode, steps, at)

class Needy(Mine):
    def __init__(self, keep_mps: float): raise ValueError(f"no {keep_mps}")

class Leaves(Mine):
    def __init__(self): raise SystemExit(3)

class NotYet(Mine):
    @property
    def step(self): raise KeyError("model")

class NotAPolicy: pass
constant = 3
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "my_policy_here.py").write_text(MINE, encoding="utf-8")
    (tmp_path / "broken_policy_here.py").write_text("import no_such_module_at_all\n", encoding="utf-8")
    (tmp_path / "faulty_policy_here.py").write_text("def (:\n", encoding="utf-8")
    yield tmp_path
    for name in ("my_policy_here", "broken_policy_here", "faulty_policy_here"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("name", sorted(BUILT_IN))
def test_every_policy_of_ours_loads_and_is_one(name: str) -> None:
    policy, called, options = load_policy(name)
    assert isinstance(policy, EgoPolicy)
    assert (called, options) == (name, {})
    assert policy_descriptions()[name]


def test_options_reach_the_policy() -> None:
    policy, name, options = load_policy(" idm : speed_mps=11.5, patience_s=3 ")
    assert name == "idm"
    assert options == {"speed_mps": 11.5, "patience_s": 3.0}
    assert isinstance(options["patience_s"], float)
    assert (policy.speed_mps, policy.patience_s) == (11.5, 3.0)
    assert load_policy("idm:speed_mps=none").options == {"speed_mps": None}


def test_a_users_class_loads_from_the_current_folder(folder: Path) -> None:
    spec = "my_policy_here:Mine:keep_mps=6,count=4,loud=yes,label=a b,target=2"
    policy, name, options = load_policy(spec)
    assert name == "my_policy_here:Mine"
    assert policy.got == (6.0, 4, True, "a b", 2.0)
    assert list(options) == ["keep_mps", "count", "loud", "label", "target"]


def test_a_users_class_loads_from_a_file(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "policy_in_a_file.py"
    elsewhere.write_text(MINE, encoding="utf-8")
    assert load_policy(f"{elsewhere}:Mine").policy.got[0] == 8.0


def test_an_option_may_be_one_of_few(folder: Path) -> None:
    policy, _, options = load_policy("my_policy_here:Chooses:mode=hard,steps=2")
    assert policy.got[:2] == ("hard", 2)
    assert options == {"mode": "hard", "steps": 2}
    assert load_policy("my_policy_here:Chooses:steps=none").policy.got[1] is None
    with pytest.raises(PolicyError) as caught:
        load_policy("my_policy_here:Chooses:mode=medium")
    assert (caught.value.expected, caught.value.fix) == ("soft or hard", "write mode=soft, for instance")


def test_files_of_one_name_are_two_and_may_be_called_like_any_module(folder: Path) -> None:
    for keep_mps, file in ((6.0, folder / "one" / "types.py"), (11.0, folder / "other" / "types.py")):
        file.parent.mkdir()
        file.write_text(MINE.replace("keep_mps: float = 8.0", f"keep_mps: float = {keep_mps}"), encoding="utf-8")
    assert load_policy("one/types.py:Mine").policy.got[0] == 6.0
    assert load_policy("other/types.py:Mine").policy.got[0] == 11.0


def test_a_policy_of_a_package_loads(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sys.path.insert(0, str(folder))
    points = [EntryPoint("fancy", "my_policy_here:Mine", loading.GROUP), EntryPoint("dead", "no_such:X", loading.GROUP)]
    monkeypatch.setattr(loading, "entry_points", lambda group: [point for point in points if point.group == group])
    assert load_policy("fancy:count=5").policy.got[1] == 5
    assert "fancy" in policy_descriptions()
    with pytest.raises(PolicyError, match="'dead' cannot be imported"):
        load_policy("dead")


FAULTS = [
    ("imd", "there is no such ego policy", "did you mean 'idm'?"),
    ("IDM", "there is no such ego policy", "did you mean 'idm'?"),
    ("", "there is no such ego policy", "take one of these"),
    ("idm:speed=3", "'idm' has no option 'speed'", "did you mean 'speed_mps'?"),
    ("idm:speed_mps", "not of the form name=value", "write idm:speed_mps=VALUE"),
    ("idm:speed_mps=fast", "'speed_mps' of 'idm' has the wrong type", "write speed_mps=1.5"),
    ("idm:speed_mps=nan", "'speed_mps' of 'idm' has the wrong type", "write speed_mps=1.5"),
    ("idm:speed_mps=1,speed_mps=2", "given twice", "give it once"),
    ("idm:accel_mpss=0", "'accel_mpss' of 'idm' is out of range", "larger"),
    ("idm:patience_s=-1", "'patience_s' of 'idm' is out of range", "larger"),
    ("delayed:delay_s=9", "'delay_s' of 'delayed' is out of range", "smaller"),
    ("constant:speed_mps=-2", "'speed_mps' of 'constant' is out of range", "larger"),
    ("no_such_module:Mine", "there is no module 'no_such_module'", "check the name"),
    ("my_polic_here:Mine", "there is no module 'my_polic_here'", "did you mean 'my_policy_here'?"),
    ("my_policy_here:mine", "has no class 'mine'", "did you mean 'Mine'?"),
    ("my_policy_here:constant", "has no class 'constant'", "check the name"),
    ("my_policy_here:NotAPolicy", "is not a policy", "add the missing methods"),
    ("my_policy_here:Chooses:at=town", "has the wrong type", "annotate 'at' as a number"),
    ("my_policy_here:Leaves", "cannot be built", "check the options"),
    ("my_policy_here:NotYet", "cannot be built", "check the options"),
    ("nowhere/my_policy.py:Mine", "there is no module 'my_policy'", "check the name"),
    ("faulty_policy_here.py:Mine", "cannot be imported", "make `python faulty_policy_here.py` work first"),
    ("my_policy_here:Needy", "cannot be built", "check the options"),
    ("my_policy_here:Needy:keep_mps=2", "cannot be built", "check the options"),
    ("my_policy_here:Mine:count=1.5", "'count' of 'my_policy_here:Mine' has the wrong type", "write count=1"),
    ("my_policy_here:Mine:loud=maybe", "'loud' of 'my_policy_here:Mine' has the wrong type", "write loud=true"),
    ("broken_policy_here:Mine", "cannot be imported", "work first"),
    ("faulty_policy_here:Mine", "cannot be imported", "work first"),
]


@pytest.mark.parametrize(("spec", "message", "fix"), FAULTS, ids=[repr(spec) for spec, _, _ in FAULTS])
def test_faults_say_what_to_do(folder: Path, spec: str, message: str, fix: str) -> None:
    with pytest.raises(PolicyError) as caught:
        load_policy(spec)
    assert message in caught.value.message
    assert fix in (caught.value.fix or "")


def test_an_unknown_option_lists_what_there_is() -> None:
    with pytest.raises(PolicyError) as caught:
        load_policy("constant:x=1")
    assert caught.value.expected == "speed_mps (number or none)"


def test_listing_policies_imports_none() -> None:
    code = (
        "import sys; from scenewright.drive import policy_descriptions; policy_descriptions();"
        "print([m for m in sys.modules if m.startswith(('scenewright.drive.idm', 'scenewright.roads', 'numpy'))])"
    )
    result = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert result.stdout.strip() == "[]"


@pytest.mark.parametrize("module", ["protocol", "loading", "boxes", "speeds"])
def test_examples_in_docstrings_run(module: str) -> None:
    import doctest
    from importlib import import_module

    results = doctest.testmod(import_module(f"scenewright.drive.{module}"))
    assert results.attempted > 0
    assert results.failed == 0
