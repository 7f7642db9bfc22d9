"""Most tests below this folder are about the readers that know rules: the learned reader keeps out of them.

Where it is tested, it stands in and doubts as it does for everybody.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from scenewright.translate import offline
from scenewright.translate.learned.reader import read_likely

WITH_THE_LEARNED_READER = ("learned", "test_texts_of_authors")


@pytest.fixture(autouse=True, scope="module")
def rules_alone(request: pytest.FixtureRequest) -> Iterator[None]:
    path = request.node.path
    if {path.stem, path.parent.name} & set(WITH_THE_LEARNED_READER):
        yield
        return
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(offline, "read_likely", lambda *_: None)
        yield


@pytest.fixture
def with_the_learned_reader(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(offline, "read_likely", read_likely)
