"""The project as a whole: what the wheel carries, what locks and sources may not say, what a start may import."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
import zipfile
from collections import Counter
from collections.abc import Iterator
from importlib.metadata import entry_points, version
from pathlib import Path

import pytest

import scenewright

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "scenewright"
MODULES = sorted(PACKAGE.rglob("*.py"))
# Here each file has tests of its own: `judge/knots.py` those of `tests/judge/test_knots.py`.
MIRRORED = ("judge", "motion", "program", "roads", "solve")
LOCKS = ("requirements.lock", "requirements-dev.lock")
MODULE_LINES = 500  # the guide is 400; past this a module holds more than one thing
HEAVY = {"z3", "scipy", "shapely", "pyarrow", "matplotlib"}
REGISTRY_ADDRESS = re.compile(r"https?://[^ ]*(/simple(/|\")|/packages/[0-9a-f]{2}/|/-/[^ ]*\.tgz)")
MACHINE_PATH = re.compile(r"(^|[^a-zA-Z0-9_.])/(root|home|work)/[a-z.]")


@pytest.fixture(scope="module")
def pyproject() -> dict[str, dict[str, object]]:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def tracked_texts() -> dict[str, str]:
    """Return the text of every file under version control, by name."""
    if not (ROOT / ".git").exists():
        pytest.skip("not a git checkout")
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    texts = {}
    for name in filter(None, listing.split("\0")):
        path = ROOT / name
        if path.is_file() and b"\0" not in (content := path.read_bytes()):
            texts[name] = content.decode("utf-8", errors="replace")
    return texts


def lines_matching(pattern: re.Pattern[str], texts: dict[str, str]) -> list[str]:
    return [
        f"{name}:{number}: {line[:120]}"
        for name, text in texts.items()
        for number, line in enumerate(text.splitlines(), start=1)
        if pattern.search(line)
    ]


def test_wheel_carries_every_file_of_the_package(tmp_path: Path) -> None:
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)],
        cwd=ROOT,
        check=True,
        capture_output=True,
    )
    (wheel,) = tmp_path.glob("*.whl")
    carried = set(zipfile.ZipFile(wheel).namelist())
    kept = {
        path.relative_to(PACKAGE.parent).as_posix()
        for path in PACKAGE.rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }
    assert "scenewright/py.typed" in carried
    assert sorted(kept - carried) == []


def test_versions_agree() -> None:
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    newest = re.search(r"^## \[(\d[^]]*)\]", changelog, flags=re.MULTILINE)
    assert newest is not None
    assert scenewright.__version__ == version("scenewright") == newest[1]


def test_every_declared_entry_point_loads(pyproject: dict[str, dict[str, object]]) -> None:
    project = pyproject["project"]
    groups = {"console_scripts": project["scripts"], **project.get("entry-points", {})}
    for group, declared in groups.items():
        installed = {point.name: point for point in entry_points(group=group)}
        for name, target in declared.items():
            assert name in installed, f"{group}: {name} is declared but not installed; run `make setup`"
            assert installed[name].value == target
            assert callable(installed[name].load())


@pytest.mark.parametrize("lock", LOCKS)
def test_lock_names_every_dependency_and_no_address(lock: str, pyproject: dict[str, dict[str, object]]) -> None:
    text = (ROOT / lock).read_text(encoding="utf-8")
    pins = re.findall(r"^([a-z0-9.-]+)==\S+.*\\$", text, flags=re.MULTILINE)
    wanted = {
        re.match(r"[A-Za-z0-9-]+", requirement)[0].lower() for requirement in pyproject["project"]["dependencies"]
    }
    assert "://" not in text
    assert sorted(wanted - set(pins)) == []
    assert "hatchling" in pins, "the project is installed without build isolation, so the lock must hold its backend"


def test_locks_agree_on_versions() -> None:
    pinned = [
        set(re.findall(r"^[a-z0-9.-]+==[^\\\n]+", (ROOT / lock).read_text(encoding="utf-8"), flags=re.MULTILINE))
        for lock in LOCKS
    ]
    assert sorted(pinned[0] - pinned[1]) == []


def test_no_registry_address_in_the_repository(tracked_texts: dict[str, str]) -> None:
    assert lines_matching(REGISTRY_ADDRESS, tracked_texts) == []


def test_no_path_of_one_machine_in_the_repository(tracked_texts: dict[str, str]) -> None:
    assert lines_matching(MACHINE_PATH, tracked_texts) == []


@pytest.mark.parametrize("module", MODULES, ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_module_explains_itself_and_stays_readable(module: Path) -> None:
    text = module.read_text(encoding="utf-8")
    assert ast.get_docstring(ast.parse(text)), "a module says what enters, what leaves and what it does not do"
    assert text.count("\n") <= MODULE_LINES


@pytest.mark.parametrize("package", MIRRORED)
def test_every_file_has_tests_of_its_own_name(package: str) -> None:
    files = [path.relative_to(PACKAGE) for path in sorted((PACKAGE / package).rglob("*.py"))]
    wanted = [path.with_name(f"test_{path.name}") for path in files if path.name != "__init__.py"]
    assert wanted
    assert [str(path) for path in wanted if not _has_tests(ROOT / "tests" / path)] == []


def _has_tests(path: Path) -> bool:
    return path.is_file() and any(
        isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
        for node in ast.parse(path.read_text(encoding="utf-8")).body
    )


def test_importing_the_packages_loads_nothing_heavy() -> None:
    names = ["scenewright", *(f"scenewright.{path.parent.name}" for path in sorted(PACKAGE.glob("*/__init__.py")))]
    code = f"import importlib, sys\nfor name in {names!r}: importlib.import_module(name)\nprint(*sys.modules)"
    result = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert sorted(HEAVY & set(result.stdout.split())) == []


def test_a_check_and_a_plan_for_one_hero_load_no_sparse_matrices_nor_another_planner() -> None:
    code = (
        "import sys\nfrom pathlib import Path\nfrom scenewright.orchestrate import Request, orchestrate\n"
        f"text = Path({str(ROOT / 'examples' / 'demo.txt')!r}).read_text()\n"
        "result = orchestrate(Request(text, ego='constant'), until='plan')\n"
        "print(result.status, *sys.modules)"
    )
    result = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    status, *loaded = result.stdout.split()
    assert status == "success"
    assert {"scipy", "pyarrow", "matplotlib", "scenewright.plan.smt"} & set(loaded) == set()


def test_module_level_names_are_bound_once() -> None:
    twice = {}
    for path in sorted((ROOT / "src").rglob("*.py")):
        bound = Counter(_bound(ast.parse(path.read_text(encoding="utf-8"))))
        twice[path.name] = [name for name, count in bound.items() if count > 1]
    assert {name: names for name, names in twice.items() if names} == {}


def _bound(module: ast.Module) -> Iterator[str]:
    for node in module.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Assign):
            yield from (target.id for target in node.targets if isinstance(target, ast.Name))
