"""Expressions and literals as C text: what is printed is read by C as the tree that the interpreter runs."""

import random
from pathlib import Path
from typing import Any

import cffi
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emit.trees import Trees
from mahovik.core.emit.declaration import prototype
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.literal import hex_literal, real_literal, word_literal
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.statement import Return
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from toolchain.tools import require, run

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)

# All of -Wall -Wextra -Wconversion, less what a random tree cannot help: x < x, w >= 0, 1.0 / 0.0.
FLAGS = (
    *("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion", "-Werror"),
    *("-Wno-tautological-compare", "-Wno-type-limits", "-Wno-overflow", "-Wno-div-by-zero", "-Wno-unused-parameter"),
    *("-ffp-contract=off", "-O1", "-shared", "-fPIC"),
)

HEAD = """#include <stdint.h>
typedef {real} t_real;
typedef uint{width}_t t_word;
static t_word t_bits_of(t_real value) {{ union {{ t_real r; t_word w; }} u; u.r = value; return u.w; }}
static t_real t_real_of(t_word value) {{ union {{ t_real r; t_word w; }} u; u.w = value; return u.r; }}
"""


def build(program: Program, folder: Path) -> tuple[Any, Any]:
    """The foreign-function interface and the library of a compiled program of trees."""
    names, p = Names("t"), program.precision
    statements = Statements(names, Expressions(names, p))
    prototypes = [prototype(f, names) for f in program.functions]
    source = HEAD.format(real=p.name, width=p.width) + "".join(f"{text};\n" for text in prototypes)
    # in one unit, but not inlined: a call of each with arrays that the compiler does not know
    for text, f in zip(prototypes, program.functions, strict=True):
        body = "\n".join(statements.block(f.body, "    "))
        source += f"{text}\n{{\n    (void)t_bits_of; (void)t_real_of; (void)x; (void)w; (void)n;\n{body}\n}}\n"
    (folder / "trees.c").write_text(source)
    run(require("gcc", "gcc"), *FLAGS, folder / "trees.c", "-o", folder / "trees.so")
    ffi = cffi.FFI()
    kinds = f"typedef {p.name} t_real; typedef uint{p.width}_t t_word;"
    ffi.cdef(kinds + "".join(f"{text};" for text in prototypes))
    return ffi, ffi.dlopen(str(folder / "trees.so"))


@PRECISIONS
@pytest.mark.parametrize(("seed", "count"), [(0, 100), pytest.param(1, 400, marks=pytest.mark.slow)])
def test_random_trees_mean_in_c_what_they_mean(precision: Precision, seed: int, count: int, tmp_path: Path) -> None:
    trees = Trees(random.Random(seed), precision)
    program = trees.program(count, 5)
    ffi, library = build(program, tmp_path)
    interpreter = Interpreter(program)
    text = Expressions(Names("t"), precision).text

    def tree_of(function: Function) -> str:
        (statement,) = function.body
        assert isinstance(statement, Return)
        return text(statement.value)

    finite = 0
    for _ in range(20):
        x, w, n = trees.inputs()
        c = (ffi.new("t_real[]", [float(v) for v in x]), ffi.new("t_word[]", w), ffi.new("int[]", n))
        for f in program.functions:
            expected = precision.scalar(interpreter.call(f.name, x, w, n))
            found = precision.scalar(getattr(library, f"t_{f.name}")(*c))
            finite += bool(np.isfinite(expected))
            # every NaN is as good as another: IEEE does not say which one comes out
            same = expected.tobytes() == found.tobytes() or (np.isnan(expected) and np.isnan(found))
            assert same, f"{tree_of(f)}\nx = {x}, w = {w}, n = {n}: {expected!r}, in C {found!r}"
    assert finite > 12 * count  # of 20 inputs a tree


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
