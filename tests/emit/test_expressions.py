"""Expressions as C text: what is printed is read by C as the tree that the interpreter runs."""

import random
from pathlib import Path
from typing import Any

import cffi
import numpy as np
import pytest

from emit.trees import Trees
from mahovik.core.emit.declaration import prototype
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.program.build import Body
from mahovik.core.program.expression import (
    Expr,
    Negate,
    Not,
    Variable,
    and_,
    compare,
    equal,
    or_,
    real,
    real_of_bits,
    select,
    word,
)
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.statement import Return
from mahovik.core.program.types import DOUBLE, FLOAT, Kind, Precision
from toolchain.quick import quick
from toolchain.tools import require, run

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


@pytest.mark.slow
@pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
@pytest.mark.parametrize("seed", quick(1, range(3)))
def test_random_trees_mean_in_c_what_they_mean(precision: Precision, seed: int, tmp_path: Path) -> None:
    trees = Trees(random.Random(seed), precision)
    program = trees.program(400, 5)
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
    assert finite > 5000  # of 8000


A, B, C = (Variable(name, Kind.REAL).place for name in "abc")
U, V, W = (Variable(name, Kind.WORD).place for name in "uvw")
I, J = (Variable(name, Kind.INT).place for name in "ij")


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (A - (B - C), "a - (b - c)"),
        ((A - B) - C, "a - b - c"),
        (A + (B + C), "a + (b + c)"),
        (A / (B * C), "a / (b * c)"),
        (A * (B / C), "a * (b / c)"),
        (A / B / C, "a / b / c"),
        ((A + B) * C, "(a + b) * c"),
        (A + B * C, "a + b * c"),
        (Negate(-A), "-(-a)"),
        (-(A * B), "-(a * b)"),
        ((-A) * B, "-a * b"),
        (A - -B, "a - -b"),
        (-real(-0.5), "-(-0.5)"),
        (A - real(-0.5), "a - -0.5"),
        (-(A + B), "-(a + b)"),
        ((U & V) | W, "(u & v) | w"),
        (U & (V | W), "u & (v | w)"),
        (U ^ (V & W), "u ^ (v & w)"),
        ((U + V) & W, "(u + v) & w"),
        ((U << 3) + V, "(u << 3u) + v"),
        (U << (V + 3), "u << (v + 3u)"),
        (equal(U & V, W), "(u & v) == w"),
        (Not(A < B), "!(a < b)"),
        (and_(A < B, or_(B < C, C < A)), "a < b && (b < c || c < a)"),
        (or_(and_(A < B, B < C), C < A), "(a < b && b < c) || c < a"),
        (select(A < B, A, B) + C, "((a < b) ? a : b) + c"),
        (select(A < B, select(B < C, A, B), C), "(a < b) ? ((b < c) ? a : b) : c"),
        (compare("<", I + J, J * 2), "i + j < j * 2"),
    ],
)
def test_parentheses(tree: Expr, text: str) -> None:
    assert Expressions(Names("t"), DOUBLE).text(tree) == text


@pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
def test_small_word_literals_have_the_whole_width(precision: Precision, tmp_path: Path) -> None:
    """`1u << 40u` is an unsigned int in C: the program means a word."""
    trees = Trees(random.Random(0), precision)
    high = word(precision.width - 1)
    cases = {
        word(1) << high: 1 << (precision.width - 1),
        (word(3) - word(5)) >> word(1): ((1 << precision.width) - 2) >> 1,
        -word(1): (1 << precision.width) - 1,
        select(trees.n.place[0] < 9, word(1), word(2)) << high: 1 << (precision.width - 1),
    }
    functions = []
    for k, tree in enumerate(cases):
        body = Body()
        body.ret(real_of_bits(tree))
        arguments = (trees.x, trees.w, trees.n)
        functions.append(Function(f"f{k}", "A tree.", arguments, body.statements, returns=Kind.REAL, public=True))
    program = Program("t", precision, (), (), tuple(functions))
    ffi, library = build(program, tmp_path)
    interpreter = Interpreter(program)
    x, w, n = trees.inputs()
    c = (ffi.new("t_real[]", [float(v) for v in x]), ffi.new("t_word[]", w), ffi.new("int[]", n))
    for f, value in zip(program.functions, cases.values(), strict=True):
        assert int(precision.scalar(interpreter.call(f.name, x, w, n)).view(precision.word)) == value
        assert int(precision.scalar(getattr(library, f"t_{f.name}")(*c)).view(precision.word)) == value
