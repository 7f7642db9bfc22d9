"""Every change of meaning changes the program, becomes a question or is refused: none keeps the old one."""

from __future__ import annotations

from changes import changes
from readings import all_texts, reading_of

EVERY = 8  # of so many changes one is tried here, beginning with another for each text; `tools/try_reader.py` tries all
# A hero that drives west ahead of the ego says where the ego drives, and the other way round: nothing is changed.
SAME = ("Create a scenario where the ego goes west on the road and the lead car brakes",)


def test_no_change_keeps_the_meaning() -> None:
    tried = 0
    for number, text in enumerate(all_texts()):
        base = reading_of(text)
        if base.program is None or text.startswith(SAME):
            continue
        for what, changed in list(changes(text))[number % EVERY :: EVERY]:
            tried += 1
            assert reading_of(changed).meaning != base.meaning, f"{what}\n{changed}"
    assert tried > 750
