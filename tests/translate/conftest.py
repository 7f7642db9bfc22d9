"""Most tests below this folder are about the readers that know rules: the learned reader keeps out of them.

Where it is tested, it stands in and doubts as it does for everybody.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from scenewright.translate import offline

WITH_THE_LEARNED_READER = ("learned", "test_texts_of_authors", "test_kept_aside")


@pytest.fixture(autouse=True, scope="module")
def rules_alone(request: pytest.FixtureRequest) -> Iterator[None]:
    if any(name in str(request.node.path) for name in WITH_THE_LEARNED_READER):
        yield
        return
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(offline, "read_likely", lambda *_: None)
        yield
