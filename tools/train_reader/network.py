"""The network as PyTorch trains it; `scenewright.translate.learned.network` computes the same in numpy.

What enters: numbers of pieces. What leaves: a score for every answer to every question, and for every part that each
piece, if it is an amount, may have. It begins with the weights of a general model of English.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path

import torch
from torch import Tensor, nn
from torch.nn import functional

WIDTH, HEADS, INNER = 384, 12, 1536  # those of all-MiniLM-L6-v2


class Layer(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.qkv, self.o = nn.Linear(WIDTH, 3 * WIDTH), nn.Linear(WIDTH, WIDTH)
        self.f1, self.f2 = nn.Linear(WIDTH, INNER), nn.Linear(INNER, WIDTH)
        self.n1, self.n2 = nn.LayerNorm(WIDTH, eps=1e-12), nn.LayerNorm(WIDTH, eps=1e-12)
        self.drop = nn.Dropout(0.1)

    def forward(self, state: Tensor, seen: Tensor) -> Tensor:
        texts, length, _ = state.shape
        query, key, value = self.qkv(state).view(texts, length, 3, HEADS, -1).permute(2, 0, 3, 1, 4)
        looked = functional.scaled_dot_product_attention(query, key, value, attn_mask=seen[:, None, None, :])
        state = self.n1(state + self.drop(self.o(looked.transpose(1, 2).reshape(texts, length, WIDTH))))
        return self.n2(state + self.drop(self.f2(functional.gelu(self.f1(state), approximate="tanh"))))


class Reader(nn.Module):
    def __init__(self, pieces: int, layers: int, answers: dict[str, int], parts: int) -> None:
        super().__init__()
        self.emb, self.pos, self.ne = (
            nn.Embedding(pieces, WIDTH),
            nn.Embedding(512, WIDTH),
            nn.LayerNorm(WIDTH, eps=1e-12),
        )
        self.layers = nn.ModuleList(Layer() for _ in range(layers))
        self.questions = list(answers)
        self.pool = nn.Linear(WIDTH, len(answers))
        self.heads = nn.ModuleDict({question: nn.Linear(2 * WIDTH, count) for question, count in answers.items()})
        self.slot = nn.Linear(WIDTH, parts)
        self.drop = nn.Dropout(0.1)

    def forward(self, numbers: Tensor, seen: Tensor) -> tuple[dict[str, Tensor], Tensor]:
        state = self.drop(self.ne(self.emb(numbers) + self.pos.weight[: numbers.shape[1]]))
        for layer in self.layers:
            state = layer(state, seen)
        counted = self.pool(state).masked_fill(~seen[:, :, None], -1e9).softmax(1)
        pooled = torch.einsum("tpq,tpw->tqw", counted, state)
        scores = {
            question: self.heads[question](torch.cat([pooled[:, at], state[:, 0]], -1))
            for at, question in enumerate(self.questions)
        }
        return scores, self.slot(state)

    @torch.no_grad()
    def begin_with(self, stored: dict[str, Tensor], kept: list[int]) -> None:
        """Take the general model's weights."""
        self.emb.weight.copy_(stored["embeddings.word_embeddings.weight"][kept])
        kind = stored["embeddings.token_type_embeddings.weight"][0]
        self.pos.weight.copy_(stored["embeddings.position_embeddings.weight"] + kind)
        for end in ("weight", "bias"):
            getattr(self.ne, end).copy_(stored[f"embeddings.LayerNorm.{end}"])
            for at, layer in enumerate(self.layers):
                base = f"encoder.layer.{at}"
                names = (f"{base}.attention.self.{name}.{end}" for name in ("query", "key", "value"))
                getattr(layer.qkv, end).copy_(torch.cat([stored[name] for name in names]))
                for part, name in (
                    (layer.o, "attention.output.dense"), (layer.n1, "attention.output.LayerNorm"),
                    (layer.f1, "intermediate.dense"), (layer.f2, "output.dense"), (layer.n2, "output.LayerNorm"),
                ):  # fmt: skip
                    getattr(part, end).copy_(stored[f"{base}.{name}.{end}"])


def stored_weights(path: Path) -> dict[str, Tensor]:
    """Read a file of the safetensors format: the length of its head, the head, the numbers."""
    raw = path.read_bytes()
    length = struct.unpack("<Q", raw[:8])[0]
    head = json.loads(raw[8 : 8 + length])
    head.pop("__metadata__", None)
    return {
        name: torch.frombuffer(
            bytearray(raw[8 + length :][slice(*about["data_offsets"])]), dtype=torch.float32
        ).reshape(about["shape"])
        for name, about in head.items()
        if about["dtype"] == "F32"
    }
