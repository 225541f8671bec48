"""Routines as C: printed, compiled with a loop around each, and called with whole arrays."""

import shutil
import subprocess
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import cffi
import numpy as np

from mahovik.core.emit.declaration import prototype
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.program.types import Precision
from mahovik.core.routines import atan2, exponential, sincos, square_root
from mahovik.core.routines.real_constants import rounder
from toolchain.tools import require

FLAGS = ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wfloat-equal", "-Wshadow", "-Werror")
# Nothing may be left for libm or libc to supply.
ALONE = ("-nostdlib", "-Wl,--no-undefined")

HEAD = """
#include <stdint.h>
typedef {real} t_real;
#define T_ROUNDER ((t_real){rounder!r})
typedef uint{width}_t t_word;
typedef union {{ t_real real; t_word word; }} t_both;
static t_word t_bits_of(t_real value) {{ t_both both; both.real = value; return both.word; }}
static t_real t_real_of(t_word word) {{ t_both both; both.word = word; return both.real; }}
"""

DECLARATIONS = """
void all_sincos(const {real} *restrict x, {real} *restrict sine, {real} *restrict cosine, int count);
void all_sqrt(const {real} *restrict x, {real} *restrict root, int count);
void all_atan2(const {real} *restrict y, const {real} *restrict x, {real} *restrict angle, int count);
void all_exp(const {real} *restrict x, {real} *restrict power, int count);
"""

LOOPS = """
void all_sincos(const t_real *restrict x, t_real *restrict sine, t_real *restrict cosine, int count)
{ for (int i = 0; i < count; ++i) { t_sincos(x[i], &sine[i], &cosine[i]); } }
void all_sqrt(const t_real *restrict x, t_real *restrict root, int count)
{ for (int i = 0; i < count; ++i) { root[i] = t_sqrt(x[i]); } }
void all_atan2(const t_real *restrict y, const t_real *restrict x, t_real *restrict angle, int count)
{ for (int i = 0; i < count; ++i) { angle[i] = t_atan2(y[i], x[i]); } }
void all_exp(const t_real *restrict x, t_real *restrict power, int count)
{ for (int i = 0; i < count; ++i) { power[i] = t_exp(x[i]); } }
"""


def source(precision: Precision) -> str:
    """C text of the routines."""
    names = Names("t")
    statements = Statements(names, Expressions(names, precision))
    kinds = {"real": precision.name, "width": precision.width, "rounder": float(rounder(precision))}
    parts = [HEAD.format(**kinds)]
    for make in (sincos, square_root, atan2, exponential):
        function = make(precision)
        body = "\n".join(statements.function(function))
        parts.append(f"{prototype(function, names)}\n{{\n{body}\n}}")
    return "\n".join([*parts, DECLARATIONS.format(**kinds), LOOPS])


@cache
def library(precision: Precision, *flags: str) -> tuple[Any, Any]:
    """(cffi, compiled library); skips where there is no compiler."""
    compiler = shutil.which("gcc") or shutil.which("clang") or require("gcc", "gcc")
    folder = Path(mkdtemp())
    try:
        code, shared = folder / "routines.c", folder / "routines.so"
        code.write_text(source(precision))
        command: list[str | Path] = [
            compiler,
            *FLAGS,
            *ALONE,
            "-ffp-contract=off",
            *flags,
            "-shared",
            "-fPIC",
            code,
            "-o",
            shared,
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        ffi = cffi.FFI()
        ffi.cdef(DECLARATIONS.format(real=precision.name).replace("restrict ", ""))
        return ffi, ffi.dlopen(str(shared))
    finally:
        shutil.rmtree(folder)  # a loaded library stays loaded


def run(precision: Precision, name: str, *arguments: Any, flags: tuple[str, ...] = ("-O2",)) -> list[np.ndarray]:
    """Results of a routine for arrays of arguments: a list of arrays."""
    ffi, compiled = library(precision, *flags)
    values = [np.ascontiguousarray(a, dtype=precision.scalar) for a in arguments]
    results = [np.empty_like(values[0]) for _ in range(2 if name == "sincos" else 1)]
    pointers = [ffi.cast(f"{precision.name} *", a.ctypes.data) for a in (*values, *results)]
    getattr(compiled, f"all_{name}")(*pointers, len(values[0]))
    return results
