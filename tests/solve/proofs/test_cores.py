"""What of many things clashes: no more than is needed, and still a clash."""

from __future__ import annotations

import random

import pytest

from scenewright.solve.proofs.cores import needed


@pytest.mark.parametrize("seed", range(20))
def test_what_is_needed_clashes_and_nothing_in_it_can_be_left_out(seed: int) -> None:
    draw = random.Random(seed)
    clashing = [set(draw.sample(range(12), draw.randint(1, 4))) for _ in range(3)]

    def clash(items: list[int]) -> bool:
        return any(each <= set(items) for each in clashing)

    found = needed(range(12), clash)
    assert clash(found)
    assert not any(clash([other for other in found if other != item]) for item in found)


def test_what_does_not_clash_by_itself_is_kept() -> None:
    """Whoever gives up asking says that nothing clashes."""
    assert needed("abc", lambda _: False) == ["a", "b", "c"]
