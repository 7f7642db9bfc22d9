"""`bench translate`: how often texts are read right, refused, or read wrong without a word.

What enters: a set of texts with their meaning, and translators. What leaves: tables for people, JSON for programs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from scenewright.cli.console import print_json, stderr, stdout
from scenewright.cli.faults import told
from scenewright.cli.options import AsJson

if TYPE_CHECKING:
    from scenewright.study.translation import GoldText, Reading, Tally
    from scenewright.translate.model.settings import TranslatorSettings


def translate(
    source: Annotated[
        Path | None, typer.Argument(help="A TOML file of texts with their programs. Default: the set that is shipped.")
    ] = None,
    translators: Annotated[str, typer.Option(help="Translators, commas between: offline, openai:NAME, ...")] = (
        "offline"
    ),
    group: Annotated[str | None, typer.Option(help="Only the texts of this group.")] = None,
    show: Annotated[bool, typer.Option("--show", help="Print every text that was not read right.")] = False,
    record: Annotated[Path | None, typer.Option(help="Keep every exchange with a model in this folder.")] = None,
    replay: Annotated[Path | None, typer.Option(help="Answer from exchanges kept in this folder.")] = None,
    as_json: AsJson = False,
) -> None:
    """Translate texts whose meaning is known; count those read right, refused, and silently wrong."""
    with told(as_json):
        from scenewright.study.translation import read_texts, shipped_texts, tally
        from scenewright.translate.model.settings import TranslatorSettings

        texts = shipped_texts() if source is None else read_texts(source)
        texts = [text for text in texts if group in (None, text.group)]
        settings = TranslatorSettings(record=record, replay=replay)
        results = {name: _readings(texts, name, settings) for name in translators.split(",")}
        if as_json:
            print_json({name: [_plain(reading) for reading in readings] for name, readings in results.items()})
            return
        for name, readings in results.items():
            _print_table(name, tally(readings), readings)
            if show:
                _print_misses(readings)


def _readings(texts: Sequence[GoldText], translator: str, settings: TranslatorSettings) -> list[Reading]:
    from rich.progress import track

    from scenewright.solve.backends.z3_backend import Z3Backend
    from scenewright.study.translation import Asking, measure
    from scenewright.translate.sources import read_scenario

    def answer(text: str) -> Asking:
        program, translation = read_scenario(text, translator, settings=settings)
        return Asking(program, tuple(each.question for each in getattr(translation, "questions", ())))

    readings: Iterator[Reading] = measure(texts, answer, Z3Backend())
    console = stderr()
    return list(track(readings, "translating", len(texts), console=console, disable=not console.is_terminal))


def _plain(reading: Reading) -> dict[str, object]:
    return {
        "id": reading.text.id,
        "group": reading.text.group,
        "outcome": reading.outcome,
        "notes": list(reading.notes),
        "seconds": reading.seconds,
    }


def _print_table(translator: str, tallies: Sequence[Tally], readings: Sequence[Reading]) -> None:
    from rich.table import Table

    from scenewright.study.translation import GOOD, OUTCOMES

    used = [outcome for outcome in OUTCOMES if any(tally.counts[outcome] for tally in tallies)]
    table = Table("group", "texts", *used, "as it should be", title=translator)
    for tally in tallies:
        counts = (str(tally.counts[outcome] or "") for outcome in used)
        table.add_row(tally.group, str(tally.total), *counts, f"{100 * tally.share(*GOOD):.1f} %")
    stdout().print(table)
    times = sorted(reading.seconds for reading in readings)
    if times:
        middle, late = times[len(times) // 2], times[min(len(times) - 1, int(0.99 * len(times)))]
        stdout().print(f"a text takes {1000 * middle:.1f} ms (p50), {1000 * late:.1f} ms (p99)")


def _print_misses(readings: Sequence[Reading]) -> None:
    from scenewright.study.translation import GOOD

    for reading in readings:
        if reading.outcome not in GOOD:
            stdout().print(f"\n{reading.text.id}: {reading.outcome}", style="bold", markup=False, highlight=False)
            stdout().print(reading.text.text, soft_wrap=True, markup=False, highlight=False)
            for note in reading.notes:
                stdout().print(f"  {note}", soft_wrap=True, markup=False, highlight=False)
