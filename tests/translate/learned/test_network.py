"""The network computes what its definition says: checked against one piece at a time, in plain Python."""

from __future__ import annotations

import math

import numpy as np
import pytest

from scenewright.errors import Span
from scenewright.translate.learned.network import Answers, Network, load_network
from scenewright.translate.learned.pieces import Pieces

WIDTH, HEADS, LAYERS, INNER, PIECES = 12, 3, 2, 20, 30
QUESTIONS = ("way", "sayable")


def random_network(seed: int) -> Network:
    chance = np.random.default_rng(seed)

    def some(*shape: int) -> np.ndarray:
        return chance.normal(0, 0.5, shape).astype(np.float32)

    weights = {"pos": some(PIECES, WIDTH), "slot.weight": some(WIDTH, 4), "slot.bias": some(4)}
    weights |= {"pool.weight": some(WIDTH, len(QUESTIONS)), "pool.bias": some(len(QUESTIONS))}
    for question in QUESTIONS:
        weights |= {f"heads.{question}.weight": some(2 * WIDTH, 3), f"heads.{question}.bias": some(3)}
    shapes = {"qkv": (WIDTH, 3 * WIDTH), "o": (WIDTH, WIDTH), "f1": (WIDTH, INNER), "f2": (INNER, WIDTH)}
    for layer in range(LAYERS):
        for name, shape in shapes.items():
            weights |= {f"layers.{layer}.{name}.weight": some(*shape), f"layers.{layer}.{name}.bias": some(shape[1])}
    for norm in ("ne", *(f"layers.{layer}.{name}" for layer in range(LAYERS) for name in ("n1", "n2"))):
        weights |= {f"{norm}.weight": some(WIDTH), f"{norm}.bias": some(WIDTH)}
    embedded = chance.integers(-127, 128, (9, WIDTH)).astype(np.int8), np.abs(some(9)) / 100
    return Network(weights, embedded, {}, LAYERS, HEADS, QUESTIONS, {}, PIECES)


def softmax(scores: list[float]) -> list[float]:
    weights = [math.exp(score - max(scores)) for score in scores]
    return [weight / sum(weights) for weight in weights]


def gelu(x: float) -> float:
    return 0.5 * x * (1 + math.tanh(math.sqrt(2 / math.pi) * (x + 0.044715 * x**3)))


def one_by_one(network: Network, pieces: Pieces) -> tuple[dict[str, list[float]], list[list[float]]]:
    """Compute the same with lists of numbers."""
    held = {name: value.astype(float).tolist() for name, value in network.weights.items()}

    def linear(vector: list[float], name: str) -> list[float]:
        columns = zip(*held[f"{name}.weight"], strict=True)
        return [sum(a * b for a, b in zip(vector, column, strict=True)) + bias
                for column, bias in zip(columns, held[f"{name}.bias"], strict=True)]  # fmt: skip

    def normed(vector: list[float], name: str) -> list[float]:
        mean = sum(vector) / len(vector)
        spread = math.sqrt(sum((each - mean) ** 2 for each in vector) / len(vector) + 1e-12)
        scaled = zip(vector, held[f"{name}.weight"], held[f"{name}.bias"], strict=True)
        return [(each - mean) / spread * weight + bias for each, weight, bias in scaled]

    rows, scales = network.embedded
    states = [
        normed(
            [
                float(row) * float(scales[number]) + place
                for row, place in zip(rows[number], held["pos"][at], strict=True)
            ],
            "ne",
        )
        for at, number in enumerate(pieces.numbers)
    ]
    size = WIDTH // HEADS
    for layer in range(LAYERS):
        name = f"layers.{layer}"
        asked = [linear(state, f"{name}.qkv") for state in states]
        seen = [[0.0] * WIDTH for _ in states]
        for head in range(HEADS):
            part = slice(head * size, (head + 1) * size)
            for at, mine in enumerate(asked):
                query = mine[:WIDTH][part]
                keys = [other[WIDTH : 2 * WIDTH][part] for other in asked]
                scores = [sum(a * b for a, b in zip(query, key, strict=True)) / math.sqrt(size) for key in keys]
                for share, other in zip(softmax(scores), asked, strict=True):
                    for place, value in zip(range(part.start, part.stop), other[2 * WIDTH :][part], strict=True):
                        seen[at][place] += share * value
        states = [normed([a + b for a, b in zip(state, linear(looked, f"{name}.o"), strict=True)], f"{name}.n1")
                  for state, looked in zip(states, seen, strict=True)]  # fmt: skip
        inner = [[gelu(x) for x in linear(state, f"{name}.f1")] for state in states]
        states = [normed([a + b for a, b in zip(state, linear(each, f"{name}.f2"), strict=True)], f"{name}.n2")
                  for state, each in zip(states, inner, strict=True)]  # fmt: skip
    answers = {}
    for at, question in enumerate(QUESTIONS):
        shares = softmax([linear(state, "pool")[at] for state in states])
        pooled = [
            sum(share * state[place] for share, state in zip(shares, states, strict=True)) for place in range(WIDTH)
        ]
        answers[question] = softmax(linear(pooled + states[0], f"heads.{question}"))
    return answers, [softmax(linear(states[mark], "slot")) for mark in pieces.marks]


@pytest.mark.parametrize("seed", range(3))
def test_it_is_the_same_one_by_one(seed: int) -> None:
    network = random_network(seed)
    numbers = tuple(int(number) for number in np.random.default_rng(seed).integers(0, 9, 7))
    pieces = Pieces(numbers, (2, 5), (Span(0, 0),) * 7)
    computed = network.answer(pieces)
    answers, amounts = one_by_one(network, pieces)
    for question in QUESTIONS:
        assert computed.likely[question].tolist() == pytest.approx(answers[question], abs=1e-4)
    for row, expected in zip(computed.amounts.tolist(), amounts, strict=True):
        assert row == pytest.approx(expected, abs=1e-4)


def answers_of(numbers: tuple[int, ...]) -> Answers:
    return load_network().answer(Pieces(numbers, (1,), (Span(0, 0),) * len(numbers)))


def test_the_shipped_weights_give_probabilities() -> None:
    network = load_network()
    chance = np.random.default_rng(5)
    answers = answers_of(
        tuple(int(number) for number in chance.integers(0, len(network.vocabulary), network.most_pieces))
    )
    for each in (*answers.likely.values(), *answers.counted.values(), *answers.amounts):
        assert float(each.sum()) == pytest.approx(1, abs=1e-4)
        assert float(each.min()) >= 0
