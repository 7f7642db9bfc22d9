"""The network: a few layers of a transformer in numpy, with one answer for each question and one for each amount.

What enters: word pieces. What leaves: a probability for every possible answer, and how much each piece counted. The
weights are kept in eight bits. It knows nothing of traffic: what the answers mean stands beside the weights.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scenewright.translate.learned.pieces import Pieces

Floats = NDArray[np.float32]
_WEIGHTS = "weights.npz"
_EPSILON = np.float32(1e-12)  # BERT's, in its norms


@dataclass(frozen=True, slots=True)
class Answers:
    """What the network makes of a text.

    Attributes
    ----------
    likely
        The probability of each answer, by question.
    counted
        How much each piece counted for the answer, by question; sums to 1.
    amounts
        The probability of each part that an amount may have, shape (amounts, parts).
    """

    likely: dict[str, Floats]
    counted: dict[str, Floats]
    amounts: Floats


@dataclass(frozen=True, slots=True)
class Network:
    """The weights by name, and what the answers mean."""

    weights: dict[str, Floats]
    embedded: tuple[NDArray[np.int8], Floats]  # a row for each piece of the vocabulary, and its scale
    vocabulary: dict[str, int]
    layers: int
    heads: int
    questions: tuple[str, ...]
    meanings: dict[str, Any]
    most_pieces: int

    def answer(self, pieces: Pieces) -> Answers:
        """Read a text of at most `most_pieces` pieces."""
        rows, scales = self.embedded
        numbers = list(pieces.numbers)
        state = rows[numbers] * scales[numbers, None] + self.weights["pos"][: len(numbers)]
        state = self._normed(state, "ne")
        for layer in range(self.layers):
            state = self._through(state, f"layers.{layer}")
        counted = _softmax((state @ self.weights["pool.weight"] + self.weights["pool.bias"]).T)
        pooled = counted @ state
        likely = {
            question: _softmax(self._linear(np.concatenate([pooled[at], state[0]]), f"heads.{question}"))
            for at, question in enumerate(self.questions)
        }
        amounts = _softmax(self._linear(state[list(pieces.marks)], "slot"))
        return Answers(likely, dict(zip(self.questions, counted, strict=True)), amounts)

    def _through(self, state: Floats, layer: str) -> Floats:
        """Return the state after one layer: every piece looks at every other one, then thinks for itself."""
        length, width = state.shape
        each = self._linear(state, f"{layer}.qkv").reshape(length, 3, self.heads, width // self.heads)
        query, key, value = each.transpose(1, 2, 0, 3)
        seen = _softmax(query @ key.transpose(0, 2, 1) / np.float32((width // self.heads) ** 0.5)) @ value
        state = self._normed(
            state + self._linear(seen.transpose(1, 0, 2).reshape(length, width), f"{layer}.o"), f"{layer}.n1"
        )
        inner = _gelu(self._linear(state, f"{layer}.f1"))
        return self._normed(state + self._linear(inner, f"{layer}.f2"), f"{layer}.n2")

    def _linear(self, state: Floats, name: str) -> Floats:
        applied: Floats = state @ self.weights[f"{name}.weight"] + self.weights[f"{name}.bias"]
        return applied

    def _normed(self, state: Floats, name: str) -> Floats:
        state = state - state.mean(-1, keepdims=True)
        spread = np.sqrt((state * state).mean(-1, keepdims=True) + _EPSILON)
        normed: Floats = state / spread * self.weights[f"{name}.weight"] + self.weights[f"{name}.bias"]
        return normed


@cache
def load_network() -> Network:
    """Load the weights that are shipped."""
    with (files(__package__) / _WEIGHTS).open("rb") as file, np.load(file) as stored:
        about = json.loads(bytes(stored["about"]).decode())
        weights = {
            name: stored[name].astype(np.float32) * stored[f"{name}/scale"]
            if f"{name}/scale" in stored
            else stored[name]
            for name in stored.files
            if name not in ("about", "emb") and not name.endswith("/scale")
        }
        embedded = stored["emb"], stored["emb/scale"]
    return Network(
        weights, embedded, {piece: at for at, piece in enumerate(about["vocabulary"])}, about["layers"],
        about["heads"], tuple(about["questions"]), about["meanings"], len(weights["pos"]),
    )  # fmt: skip


def _softmax(scores: Floats) -> Floats:
    weights = np.exp(scores - scores.max(-1, keepdims=True))
    likely: Floats = weights / weights.sum(-1, keepdims=True)
    return likely


def _gelu(inner: Floats) -> Floats:
    """Return Hendrycks and Gimpel's GELU by its approximation with tanh, written with exp, which is quicker here."""
    twice = np.float32(-2.0 * (2.0 / np.pi) ** 0.5)
    exponent = inner * inner
    exponent *= twice * np.float32(0.044715)
    exponent += twice
    exponent *= inner
    np.minimum(exponent, np.float32(80.0), out=exponent)  # beyond, exp would overflow, and the quotient is nothing
    np.exp(exponent, out=exponent)
    exponent += 1
    passed: Floats = inner / exponent
    return passed
