"""Tries the offline reader on the texts of the tests: `python tools/try_reader.py`.

Right, default (right where the default of a question is taken), asked, refused, wrong: against what a person reads in
a text. Kept: of the automatic changes of meaning to texts that were taken, how many left everything as it was.
"""

from __future__ import annotations

import sys
import time
from collections import Counter
from pathlib import Path

from scenewright.study.benchmark import benchmark_rows
from scenewright.study.meaning import differences

sys.path[:0] = [
    str(Path(__file__).resolve().parents[1] / "tests" / folder) for folder in ("translate", "translate/read")
]
from changes import changes  # noqa: E402 - the tests' own
from readings import Expected, is_right, of_the_paper, paraphrases, reading_of, to_refuse  # noqa: E402
from test_paper import ORACLE  # noqa: E402 - what a person reads


def main() -> None:
    reading_of("The ego stands.")  # what is loaded once is no part of the time of the first text
    paper = of_the_paper()
    sets: dict[str, list[tuple[str, Expected | None]]] = {
        "paper": [(paper[number], expected) for number, expected in ORACLE.items() if number in paper],
        "many voices": list(paraphrases()),
        "to be refused": [(text, None) for text in to_refuse()],
    }
    for label, entries in sets.items():
        print(label, len(entries), dict(judged(entries)))
    meant: Counter[str] = Counter()
    for row in benchmark_rows():
        program = reading_of(row.description).program
        found = ["not taken"] if program is None else differences(row.program, program)
        meant["right" if all("gap(A0, A1, t0) > 0" in each for each in found) else "wrong"] += 1
    print("benchmark", dict(meant))


def judged(entries: list[tuple[str, Expected | None]]) -> Counter[str]:
    found: Counter[str] = Counter()
    begun = time.perf_counter()
    for text, expected in entries:
        reading = reading_of(text)
        right = expected is not None and is_right(reading, expected)
        kind = reading.kind if reading.program is None else "wrong" if not right else "right"
        found[f"{kind} by default" if right and reading.kind == "default" else kind] += 1
        if reading.program is not None:
            for _, changed in changes(text):
                found["changes"] += 1
                found["kept"] += reading_of(changed).meaning == reading.meaning
    found["us a text"] = round(1e6 * (time.perf_counter() - begun) / max(1, len(entries) + found["changes"]))
    return found


if __name__ == "__main__":
    main()
