"""A text is cut into pieces that stand where they say, with one mark for each amount."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from scenewright.program.expressions import ParameterRef
from scenewright.translate.learned.network import load_network
from scenewright.translate.learned.pieces import cut, mark_of
from scenewright.translate.tokens import Quantity, tokenise

VOCABULARY = load_network().vocabulary
WORDS = st.lists(st.text(alphabet="abcdefghijklmnopqrstuvwxyzäéß'-.,;:!?\n ()", min_size=1, max_size=12), max_size=12)


def amounts_of(text: str) -> list[Quantity]:
    return [token.quantity for token in tokenise(text, "text") if token.quantity is not None]


def pieces_by_number() -> dict[int, str]:
    return {number: piece for piece, number in VOCABULARY.items()}


def test_words_are_cut_into_the_longest_pieces_that_are_known() -> None:
    vocabulary = {"[CLS]": 0, "[SEP]": 1, "[UNK]": 2, "drive": 3, "driveway": 4, "##way": 5, "##s": 6}
    assert cut("driveways drive qx Driveway", [], vocabulary).numbers == (0, 4, 6, 3, 2, 4, 1)


def test_an_amount_is_one_mark_whatever_its_value() -> None:
    one, other = "The ego is 12 m behind it.", "The ego is forty-five metres behind it."
    assert cut(one, amounts_of(one), VOCABULARY).numbers == cut(other, amounts_of(other), VOCABULARY).numbers


def test_the_dimension_of_an_amount_is_seen() -> None:
    texts = [f"The ego is {amount} from it." for amount in ("3 m", "3 s", "3 m/s", "3 m/s^2", "gap_m", "gap_s")]
    assert len({cut(text, amounts_of(text), VOCABULARY).numbers[4] for text in texts}) == len(texts)


def test_a_parameter_is_a_mark_and_the_words_of_its_name() -> None:
    text = "It is hero_gap_m behind it."
    pieces = cut(text, amounts_of(text), VOCABULARY)
    (amount,) = amounts_of(text)
    assert isinstance(amount.term, ParameterRef)
    assert pieces.numbers[pieces.marks[0]] == VOCABULARY[mark_of(amount)]
    after = [pieces_by_number()[number] for number in pieces.numbers[pieces.marks[0] + 1 : pieces.marks[0] + 4]]
    assert after == ["hero", "gap", "m"]


@given(WORDS)
def test_every_piece_stands_where_it_says(words: list[str]) -> None:
    text = " ".join(words)
    pieces = cut(text, [], VOCABULARY)
    assert len(pieces.numbers) == len(pieces.spans)
    known = pieces_by_number()
    for number, span in zip(pieces.numbers[1:-1], pieces.spans[1:-1], strict=True):
        piece = known[number].removeprefix("##")
        assert (
            piece == "[UNK]"
            or not piece.isascii()
            or not span.excerpt(text).isascii()
            or piece in span.excerpt(text).lower()
        )
    starts = [span.start for span in pieces.spans]
    assert starts == sorted(starts)
