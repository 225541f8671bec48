"""Literals in C are read back to the same bits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.emit.literal import hex_literal, real_literal, word_literal
from mahovik.core.program.types import DOUBLE, FLOAT, Precision

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)


@PRECISIONS
@given(st.integers(0, 2**64 - 1))
def test_real_literals_read_back(precision: Precision, drawn: int) -> None:
    value = precision.word(drawn % (1 << precision.width)).view(precision.scalar)
    if not np.isfinite(value):
        with pytest.raises(ValueError, match="has no literal"):
            real_literal(float(value), precision)
        return
    text = real_literal(float(value), precision)
    assert "." in text and text.endswith("F") == (precision is FLOAT)
    assert precision.scalar(text.rstrip("F")).tobytes() == value.tobytes()
    back = precision.scalar(float.fromhex(hex_literal(float(value), precision).rstrip("F")))
    assert back.tobytes() == value.tobytes()


def test_a_double_beyond_float_has_no_float_literal() -> None:
    with np.errstate(over="ignore"), pytest.raises(ValueError, match="has no literal in float"):
        real_literal(1e39, FLOAT)


@given(st.integers(0, 2**64 - 1))
def test_word_literals_read_back(value: int) -> None:
    text = word_literal(value)
    assert text.endswith("u")
    assert int(text[:-1], 0) == value
