"""Judges of sincos, sqrt, atan2, exp and wrap, compiled: Arb on samples, and every float.

Arb computes with error bounds of its own, so it is a judge that cannot be wrong by much: 200 bits here. Floats are
few enough to take all of them, in C, against the double functions of the C library.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import cffi
import math_proof
import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

from mahovik.core.emit.declaration import prototype
from mahovik.core.emit.expression import Expressions
from mahovik.core.emit.names import Names
from mahovik.core.emit.statement import Statements
from mahovik.core.program.function import Function
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.routines import atan2, exponential, sincos, square_root, unwind, wrap
from mahovik.core.routines.exponential import LOWEST

BITS = 200
NEAR = 8 * np.pi
LAST_NEAR = float(np.nextafter(np.float32(NEAR), np.float32(0)))
ABSOLUTE = {"double": 1e-16, "float": 6e-8}
WRAPPED = {"double": 5e-16, "float": 3e-7}
Array = NDArray[Any]

HEAD = """
#include <math.h>
#include <stdint.h>
typedef {real} t_real;
typedef uint{width}_t t_word;
typedef union {{ t_real real; t_word word; }} t_both;
static t_word t_bits_of(t_real value) {{ t_both both; both.real = value; return both.word; }}
static t_real t_real_of(t_word word) {{ t_both both; both.word = word; return both.real; }}
"""
DECLARATIONS = """
void all_sincos({real} *x, {real} *sine, {real} *cosine, int count);
void all_sqrt({real} *x, {real} *root, int count);
void all_atan2({real} *y, {real} *x, {real} *angle, int count);
void all_exp({real} *x, {real} *power, int count);
void all_wrap({real} *x, {real} *angle, int count);
"""
LOOPS = """
void all_sincos(t_real *x, t_real *sine, t_real *cosine, int count)
{ for (int i = 0; i < count; ++i) { t_sincos(x[i], &sine[i], &cosine[i]); } }
void all_sqrt(t_real *x, t_real *root, int count)
{ for (int i = 0; i < count; ++i) { root[i] = t_sqrt(x[i]); } }
void all_atan2(t_real *y, t_real *x, t_real *angle, int count)
{ for (int i = 0; i < count; ++i) { angle[i] = t_atan2(y[i], x[i]); } }
void all_exp(t_real *x, t_real *power, int count)
{ for (int i = 0; i < count; ++i) { power[i] = t_exp(x[i]); } }
void all_wrap(t_real *x, t_real *angle, int count)
{ for (int i = 0; i < count; ++i) { angle[i] = t_wrapped(x[i]); } }
"""
SCAN_DECLARATIONS = """
void scan_sincos(uint32_t first, uint32_t last, double worst[2], float at[2]);
void scan_exp(uint32_t first, uint32_t last, double worst[2], float at[2]);
uint32_t scan_sqrt(uint32_t first, uint32_t last);
"""
# every float of a range of bit patterns; worst: in units of the last place, then absolute
SCANS = """
static void note(double got, double exact, float x, double worst[2], float at[2])
{
    int exponent;
    const double error = fabs(got - exact);
    (void)frexp(exact, &exponent);
    const double unit = ldexp(1.0, exponent < -125 ? -149 : exponent - 24);
    if (error / unit > worst[0]) { worst[0] = error / unit; at[0] = x; }
    if (error > worst[1]) { worst[1] = error; at[1] = x; }
}
void scan_sincos(uint32_t first, uint32_t last, double worst[2], float at[2])
{
    worst[0] = worst[1] = 0.0;
    for (uint32_t word = first; word <= last; ++word) {
        const float x = t_real_of(word);
        float sine, cosine;
        t_sincos(x, &sine, &cosine);
        note((double)sine, sin((double)x), x, worst, at);
        note((double)cosine, cos((double)x), x, worst, at);
    }
}
void scan_exp(uint32_t first, uint32_t last, double worst[2], float at[2])
{
    worst[0] = worst[1] = 0.0;
    for (uint32_t word = first; word <= last; ++word) {
        const float x = t_real_of(word);
        note((double)t_exp(x), exp((double)x), x, worst, at);
    }
}
uint32_t scan_sqrt(uint32_t first, uint32_t last)
{
    uint32_t wrong = 0;
    for (uint32_t word = first; word <= last; ++word) {
        const float x = t_real_of(word);
        if (t_bits_of(t_sqrt(x)) != t_bits_of(sqrtf(x))) { ++wrong; }
    }
    return wrong;
}
"""


def functions(precision: Precision) -> Iterator[Function]:
    """The routines, each after those it calls."""
    yield sincos(precision)
    yield square_root(precision)
    yield atan2(precision)
    yield exponential(precision)
    turned = unwind(precision)
    yield turned
    yield wrap(precision, turned)


@cache
def library(precision: Precision) -> tuple[cffi.FFI, Any]:
    """The routines as C, compiled with a loop around each."""
    names = Names("t")
    statements = Statements(names, Expressions(names, precision))
    kinds = {"real": precision.name, "width": precision.width}
    scans = precision is FLOAT
    parts = [HEAD.format(**kinds)]
    for function in functions(precision):
        body = "\n".join(statements.block(function.body, "    "))
        parts.append(f"{prototype(function, names)}\n{{\n{body}\n}}")
    with tempfile.TemporaryDirectory() as name:
        code, shared = Path(name) / "routines.c", Path(name) / "routines.so"
        code.write_text("\n".join([*parts, LOOPS, SCANS if scans else ""]), encoding="ascii")
        flags = ["-std=c99", "-O2", "-ffp-contract=off", "-fno-math-errno", "-shared", "-fPIC"]
        subprocess.run(["gcc", *flags, str(code), "-o", str(shared), "-lm"], check=True)
        ffi = cffi.FFI()
        ffi.cdef(DECLARATIONS.format(**kinds) + (SCAN_DECLARATIONS if scans else ""))
        return ffi, ffi.dlopen(str(shared))


def run(precision: Precision, name: str, *arguments: Array, results: int = 1) -> list[Array]:
    """Results of a routine for arrays of arguments."""
    ffi, compiled = library(precision)
    given = [np.ascontiguousarray(a, dtype=precision.scalar) for a in arguments]
    found = [np.empty_like(given[0]) for _ in range(results)]
    pointers = [ffi.cast(f"{precision.name} *", a.ctypes.data) for a in (*given, *found)]
    getattr(compiled, f"all_{name}")(*pointers, len(given[0]))
    return found


# ---- samples ----


def neighbours(precision: Precision, values: Sequence[float] | Array, reach: int = 2) -> Array:
    """The machine numbers next to `values` and `reach` more on each side."""
    middle = np.asarray(values, dtype=precision.scalar)
    found = [middle]
    for end in (np.inf, -np.inf):
        x = middle
        for _ in range(reach):
            x = np.nextafter(x, precision.scalar(end))
            found.append(x)
    return np.concatenate(found)


def closest_to_quarter_turns(precision: Precision, largest: float) -> Array:
    """Machine numbers up to `largest` that come closest to a multiple of pi/2, of every exponent (Kahan).

    x = S 2^e is close to k pi/2 where S/k is a convergent of (pi/2)/2^e; multiples of it fill the significand.
    """
    found = set()
    limit = 1 << precision.significand
    for exponent in range(-precision.significand, int(np.log2(largest)) - precision.significand + 2):
        for numerator, _ in math_proof.convergents(exponent, limit):
            for m in {1, 2, 3, (limit - 1) // numerator}:
                found.add(float(m * numerator * Fraction(2) ** exponent))
    return np.array(sorted(x for x in found if 0 < x <= largest))


def angles(precision: Precision, largest: float, count: int, seed: int) -> Array:
    """Dense, of every size, next to multiples of pi/4, closest to those of pi/2, powers of two, subnormals."""
    draw = np.random.default_rng(seed)
    eighths = draw.integers(-int(largest / (np.pi / 4)), int(largest / (np.pi / 4)) + 1, count // 8) * (np.pi / 4)
    tiny = float(np.finfo(precision.scalar).smallest_subnormal)
    powers = 2.0 ** np.arange(1 - precision.bias, np.log2(largest))
    parts = [
        draw.uniform(-largest, largest, count),
        np.exp(draw.uniform(np.log(1e-12), np.log(largest), count // 4)),
        neighbours(precision, eighths),
        neighbours(precision, closest_to_quarter_turns(precision, largest)),
        neighbours(precision, powers, 1),
        draw.integers(1, 1 << 20, 50) * tiny,
        [largest, 0.0],
    ]
    found = np.concatenate([np.asarray(p, dtype=precision.scalar) for p in parts])
    return np.asarray(found[np.abs(found.astype(float)) <= largest])


def numbers(precision: Precision, count: int) -> Array:
    """Numbers of every size, subnormal ones, neighbours of powers of two, and those with roots next to a midpoint."""
    draw = np.random.default_rng(3)
    infinity = int(np.array(np.inf, precision.scalar).view(precision.word))
    bits = precision.significand - 1
    any_size = draw.integers(1, infinity, count, dtype=precision.word).view(precision.scalar)
    small = (draw.integers(1, 1 << bits, count // 8, dtype=precision.word)).view(precision.scalar)
    powers = neighbours(precision, 2.0 ** np.arange(2 - precision.bias, precision.bias), 2)
    k = [int(x) for x in draw.integers(1 << bits, 2 << bits, count // 8)]
    middles = [float((Fraction(2 * i + 1, 2 << bits)) ** 2) for i in (*k, 1 << bits, (2 << bits) - 1)]
    hard = neighbours(precision, np.array([m * s for s in (1.0, 0.25) for m in middles]), 1)
    return np.concatenate([any_size, small, powers, hard])


def points(precision: Precision, count: int) -> tuple[Array, Array]:
    """Directions of every kind: all round, by octant borders, where two cases of the routine meet, very small."""
    draw = np.random.default_rng(4)
    turn, size = draw.uniform(-np.pi, np.pi, count), np.exp(draw.uniform(-20, 20, count))
    x, half = draw.uniform(0.5, 1, count), draw.uniform(0.49, 0.53, count)
    tiny = float(np.finfo(precision.scalar).smallest_subnormal)
    small = draw.integers(-50, 50, (2, count // 50)) * tiny
    border = neighbours(precision, x[: count // 10])
    ys = [size * np.sin(turn), x * half, -x, border, draw.normal(size=count) * size, small[0]]
    xs = [size * np.cos(turn), x, x * half, np.tile(x[: count // 10], 5), draw.normal(size=count), small[1]]
    y_, x_ = (np.concatenate([np.asarray(p, dtype=precision.scalar) for p in v]) for v in (ys, xs))
    return y_, x_


def exponents(precision: Precision, count: int) -> Array:
    """Exponents of the whole range, of every size, beside the borders where k of the reduction changes, the last."""
    draw = np.random.default_rng(6)
    lowest = LOWEST[precision.name]
    borders = -(np.arange(int(-lowest / np.log(2))) + 0.5) * np.log(2)
    small = -np.exp(draw.uniform(np.log(1e-30), np.log(-lowest), count // 2))
    parts = [draw.uniform(lowest, 0, count), small, neighbours(precision, borders), [lowest, 0.0]]
    found = np.concatenate([np.asarray(p, dtype=precision.scalar) for p in parts])
    return np.asarray(found[(found >= lowest) & (found <= 0)])


# ---- judging ----


@dataclass(frozen=True)
class Row:
    """The worst error of a routine over some samples, where, and what it must not exceed."""

    routine: str
    precision: str
    samples: str
    count: int
    worst: float
    unit: str
    at: str
    bound: float

    @property
    def good(self) -> bool:
        return self.worst <= self.bound

    def cells(self) -> list[str]:
        """The row as text."""
        form = {"ulp": ".3f", "wrong": ".0f"}.get(self.unit, ".2e")
        worst, limit = (f"{v} {self.unit}".strip() for v in (f"{self.worst:{form}}", f"{self.bound:g}"))
        return [self.routine, self.precision, self.samples, f"{self.count:,}", worst, self.at, limit]


def unit_of(precision: Precision, exact: arb) -> float:
    """The unit in the last place of the machine number next to a real number."""
    return float(np.spacing(np.abs(precision.scalar(float(exact)))))


def largest_error(
    precision: Precision, arguments: Sequence[Array], got: Array, exact: Callable[..., arb], absolute: bool = False
) -> tuple[float, int]:
    """The largest error, in units of the last place or as it is, and its index."""
    ctx.prec = BITS
    worst, where = -1.0, 0
    for i, result in enumerate(got.tolist()):
        true = exact(*(arb(float(a[i])) for a in arguments))
        error = abs(arb(result) - true)
        size = float((error if absolute else error / unit_of(precision, true)).upper())
        if size > worst:
            worst, where = size, i
    return worst, where


def rows(samples: int) -> Iterator[Row]:
    """Everything that Arb judges."""
    for precision in (DOUBLE, FLOAT):
        name = precision.name
        x = angles(precision, NEAR, samples, 1)
        both = run(precision, "sincos", x, results=2)
        for routine, got, exact in (("sin", both[0], arb.sin), ("cos", both[1], arb.cos)):
            worst, i = largest_error(precision, [x], got, exact)
            yield Row(routine, name, "up to 8 pi", len(x), worst, "ulp", f"x = {x[i]!s}", 1.0)
        x = angles(precision, precision.max_phase, samples, 2)
        both = run(precision, "sincos", x, results=2)
        for routine, got, exact in (("sin", both[0], arb.sin), ("cos", both[1], arb.cos)):
            worst, i = largest_error(precision, [x], got, exact, absolute=True)
            yield Row(
                routine, name, f"up to {precision.max_phase:g}", len(x), worst, "", f"x = {x[i]!s}", ABSOLUTE[name]
            )
        n = numbers(precision, samples)
        (root,) = run(precision, "sqrt", n)
        worst, i = largest_error(precision, [n], root, arb.sqrt)
        yield Row("sqrt", name, "all sizes, midpoints", len(n), worst, "ulp", f"x = {n[i]!s}", 0.5)
        y, x = points(precision, samples)
        (angle,) = run(precision, "atan2", y, x)
        kept = (angle != 0) & np.isfinite(angle) & ((x != 0) | (y != 0))
        y, x, angle = y[kept], x[kept], angle[kept]
        worst, i = largest_error(precision, [y, x], angle, arb.atan2)
        yield Row("atan2", name, "all directions", len(y), worst, "ulp", f"y = {y[i]!s}, x = {x[i]!s}", 2.0)
        x = exponents(precision, samples)
        (power,) = run(precision, "exp", x)
        worst, i = largest_error(precision, [x], power, arb.exp)
        yield Row("exp", name, f"{LOWEST[name]:g} to 0", len(x), worst, "ulp", f"x = {x[i]!s}", 1.0)
        x = angles(precision, precision.max_phase, samples, 5)
        (angle,) = run(precision, "wrap", x)
        turn = np.round((x.astype(float) - angle.astype(float)) / (2 * np.pi))
        worst, i = largest_error(precision, [x, turn], angle, _less_turns, absolute=True)
        yield Row("wrap", name, f"up to {precision.max_phase:g}", len(x), worst, "rad", f"x = {x[i]!s}", WRAPPED[name])


def _less_turns(x: arb, turns: arb) -> arb:
    return x - turns * 2 * arb.pi()


def every_float(first: float, last: float) -> Iterator[Row]:
    """sincos at every float of a range, by the C library's double functions: their error is 1e-8 of these units."""
    ffi, compiled = library(FLOAT)
    begin, end = (int(np.float32(v).view(np.uint32)) for v in (first, last))
    worst, at = ffi.new("double[2]"), ffi.new("float[2]")
    compiled.scan_sincos(begin, end, worst, at)
    words, count = f"every float of {first:g} to {last:.6g}", end - begin + 1
    if last <= NEAR:
        yield Row("sin, cos", "float", words, count, worst[0], "ulp", f"x = {np.float32(at[0])!s}", 1.0)
    yield Row("sin, cos", "float", words, count, worst[1], "", f"x = {np.float32(at[1])!s}", ABSOLUTE["float"])


def every_root(first: float, last: float) -> Row:
    """sqrt at every float of a range, by the instruction of the processor."""
    _, compiled = library(FLOAT)
    begin, end = (int(np.float32(v).view(np.uint32)) for v in (first, last))
    wrong = float(compiled.scan_sqrt(begin, end))
    return Row("sqrt", "float", f"every float of {first:g} to {last:.3g}", end - begin + 1, wrong, "wrong", "", 0.0)


def every_power(first: float, last: float) -> Row:
    """exp at every float from `last` up to `first`, both not positive, by the C library's double function."""
    ffi, compiled = library(FLOAT)
    begin, end = (int(np.float32(abs(v)).view(np.uint32)) | 1 << 31 for v in (first, last))
    worst, at = ffi.new("double[2]"), ffi.new("float[2]")
    compiled.scan_exp(begin, end, worst, at)
    where = f"x = {np.float32(at[0])!s}"
    return Row("exp", "float", f"every float of {last:g} to {first:g}", end - begin + 1, worst[0], "ulp", where, 1.0)
