"""Literals read back to the same bits, in Python and in C."""

import struct

import cffi
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.core.emit.literal import real_literal, word_literal
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from toolchain.tools import require, run

DOUBLES = st.floats(allow_nan=False, allow_infinity=False)
LARGEST_BITS = 0x7F7FFFFF
"""Bits of the largest float: those of every finite one but for its sign."""


def from_bits(magnitude: int, negative: bool) -> float:
    """The float of these bits."""
    (value,) = struct.unpack("<f", struct.pack("<I", magnitude | negative << 31))
    return float(value)


FLOATS = st.builds(from_bits, st.integers(0, LARGEST_BITS), st.booleans())
"""Every finite float; hypothesis' own of this width filter what they draw, now and then too much."""
EDGES = (0.0, -0.0, 1.0, 0.1, 1e22, 1e23, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 9007199254740993.0)
FLOAT_EDGES = (0.0, -0.0, 1.0, 0.1, 1e10, 16777216.0, 1e-45, 1.1754943508222875e-38, 3.4028234663852886e38)


def same(a: float, b: float, code: str) -> bool:
    """Equal bits."""
    return struct.pack(code, a) == struct.pack(code, b)


@given(DOUBLES)
def test_double_literals_read_back(value: float) -> None:
    text = real_literal(value, DOUBLE)
    assert same(float(text), value, "<d")
    assert "." in text  # 1 would be an int
    assert len(text) <= 24  # 17 digits, sign, point, e-308


@given(FLOATS)
def test_float_literals_read_back(value: float) -> None:
    text = real_literal(value, FLOAT)
    assert text.endswith("F")
    assert "." in text
    assert len(text) <= 16  # 9 digits, sign, point, e-38, F
    assert same(float(text[:-1]), value, "<f")


@given(st.floats(-3e38, 3e38))
def test_a_literal_of_a_float_program_is_the_nearest_float(value: float) -> None:
    assert same(float(real_literal(value, FLOAT)[:-1]), value, "<f")


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
@pytest.mark.parametrize("precision", [DOUBLE, FLOAT])
def test_what_is_no_number_has_no_literal(value: float, precision: Precision) -> None:
    with pytest.raises(ValueError, match="has no literal"):
        real_literal(value, precision)


def test_a_double_beyond_float_has_no_float_literal() -> None:
    with np.errstate(over="ignore"), pytest.raises(ValueError, match="has no literal in float"):
        real_literal(1e39, FLOAT)


@pytest.mark.parametrize(
    ("precision", "numbers", "edges"),
    [(DOUBLE, DOUBLES, EDGES), (FLOAT, FLOATS, FLOAT_EDGES)],
    ids=["double", "float"],
)
def test_c_reads_the_same_bits(
    precision: Precision,
    numbers: st.SearchStrategy[float],
    edges: tuple[float, ...],
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    folder = tmp_path_factory.mktemp("literals")
    code = "<d" if precision is DOUBLE else "<f"

    @settings(max_examples=6, deadline=None)
    @given(st.lists(numbers, min_size=20, max_size=100))
    def check(values: list[float]) -> None:
        values = [*edges, *values]
        text = ",\n".join(real_literal(v, precision) for v in values)
        (folder / "literals.c").write_text(f"const {precision.name} literals[] = {{ {text} }};\n")
        flags = ("-std=c99", "-Wall", "-Wpedantic", "-Wconversion", "-Werror", "-shared", "-fPIC")
        library = folder / f"literals{len(list(folder.iterdir()))}.so"  # a loaded file is not read again
        run(require("gcc", "gcc"), *flags, folder / "literals.c", "-o", library)
        ffi = cffi.FFI()
        ffi.cdef(f"extern {precision.name} literals[];")
        found = ffi.dlopen(str(library)).literals
        assert [v for i, v in enumerate(values) if not same(v, found[i], code)] == []

    check()


@given(st.integers(0, 2**64 - 1))
def test_word_literals_read_back(value: int) -> None:
    text = word_literal(value)
    assert text.endswith("u")
    assert int(text[:-1], 0) == value
