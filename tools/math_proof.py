"""Bounds that are proven, not measured: of the polynomials over their whole range, and of rounding in sincos.

Approximation. The difference of a polynomial and the Taylor series of its function, the rest of which is bounded, is a
polynomial with small coefficients: Arb evaluates it over many small intervals of z = r^2, which cover the range.

Rounding. Each operation of `routines/sincos` after the reduction is followed with a bound of its result's magnitude
and one of its error: that of its operands, and half a unit in the last place of the largest result. Over intervals of
r so short that these are close to what they bound. 1 - z/2 rounded and what it lost are exact together (Dekker), and
so is r_hi - r_tail by construction; nothing else is assumed but rounding to nearest.

Reduction. The machine numbers closest to a multiple of pi/2 come from continued fractions: so no |x| <= 8 pi has a
smaller reduced angle than the least of these, and what the reduction loses is small beside it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from flint import arb, arb_poly, ctx, fmpq

from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.routines.arc_tangent import POLYNOMIALS as ARC_TANGENT
from mahovik.core.routines.exponential import POLYNOMIALS as EXPONENTIAL
from mahovik.core.routines.real_constants import PI
from mahovik.core.routines.sincos import POLYNOMIALS as SINCOS
from mahovik.core.routines.sincos import SMALL_TURNS, half_pi_parts

BITS = 300
REDUCED = 0.7855  # |r| after reduction: pi/4, and a little where x (2/pi) is rounded to the wrong side of a tie
HALF_LN_2 = 0.3466  # |r| after reduction by ln 2, with the same margin
PIECES = 400
MOST_TURNS = 16  # quarter turns up to 8 pi
BELOW_ONE = 1 - 1e-9
TAYLOR = 30  # terms; the first left out is bounded below


@dataclass(frozen=True)
class Row:
    """A proven bound and what it must not exceed."""

    what: str
    precision: str
    bound: float
    unit: str
    most: float

    @property
    def good(self) -> bool:
        return self.bound <= self.most

    def cells(self) -> list[str]:
        """The row as text."""
        digits = f"{self.bound:.3f} ulp" if self.unit == "ulp" else f"{self.bound:.2e}"
        return [self.what, self.precision, digits, f"{self.most:.3g} {self.unit}".strip()]


def machine(value: float, precision: Precision) -> fmpq:
    """A literal as the machine number that it is."""
    exact = Fraction(float(precision.scalar(value)))
    return fmpq(exact.numerator, exact.denominator)


def difference(coefficients: Sequence[float], taylor: Sequence[fmpq], precision: Precision) -> list[arb]:
    """Coefficients in z of the polynomial less the series."""
    given = [machine(c, precision) for c in coefficients] + [fmpq(0)] * (len(taylor) - len(coefficients))
    return [arb(c) - arb(t) for c, t in zip(given, taylor, strict=True)]


def largest_value(coefficients: Sequence[arb], low: arb, high: arb) -> arb:
    """A bound of |polynomial| between two numbers: expanded about the middle, where its terms are small."""
    half = (high - low) / 2
    about = arb_poly(list(coefficients))(arb_poly([(low + high) / 2, 1]))
    return sum((abs(c) * half**k for k, c in enumerate(about.coeffs())), arb(0))


def pieces(span: float) -> Iterator[tuple[arb, arb]]:
    """Intervals of z that cover 0 to span^2."""
    width = arb(span) ** 2 / PIECES
    for k in range(PIECES):
        yield width * k, width * (k + 1)


@cache
def approximation(name: str, precision: Precision) -> float:
    """Largest error: relative of sines and arc tangent, absolute of cosines."""
    ctx.prec = BITS
    fits, powers = SINCOS[precision.name], EXPONENTIAL[precision.name]
    signs = [(-1) ** (k + 1) for k in range(TAYLOR)]
    if name == "sine":  # r^3 S(z): over sin r, at least 0.9 r
        series = [fmpq(s, math.factorial(2 * k + 3)) for k, s in enumerate(signs)]
        gap, span = difference(fits.sine, series, precision), REDUCED
        rest = arb(1) / math.factorial(2 * TAYLOR + 3)
    elif name == "cosine":  # z^2 C(z), absolute
        series = [fmpq(-s, math.factorial(2 * k + 4)) for k, s in enumerate(signs)]
        gap, span = difference(fits.cosine, series, precision), REDUCED
        rest = arb(1) / math.factorial(2 * TAYLOR + 4)
    elif name == "hyperbolic sine":  # r^3 S(z): over sinh r, the rest a geometric series
        series = [fmpq(1, math.factorial(2 * k + 3)) for k in range(TAYLOR)]
        gap, span = difference(powers.sine, series, precision), HALF_LN_2
        rest = arb(2) / math.factorial(2 * TAYLOR + 3)
    elif name == "hyperbolic cosine":  # z^2 C(z), absolute
        series = [fmpq(1, math.factorial(2 * k + 4)) for k in range(TAYLOR)]
        gap, span = difference(powers.cosine, series, precision), HALF_LN_2
        rest = arb(2) / math.factorial(2 * TAYLOR + 4)
    else:  # t^3 A(z): z <= 1/4, the series alternates, its rest is below its first term left out
        terms = 2 * TAYLOR
        series = [fmpq((-1) ** (k + 1), 2 * k + 3) for k in range(terms)]
        gap, span = difference(ARC_TANGENT[precision.name].coefficients, series, precision), 0.5
        rest = arb(1) / 4**terms
    worst = arb(0)
    for low, high in pieces(span):
        error = high * (largest_value(gap, low, high) + rest)
        if name in ("cosine", "hyperbolic cosine"):
            error = error * high
        elif name != "hyperbolic sine":  # r / sin r and t / atan t rise with r; r / sinh r is below 1
            r = high.sqrt()
            error = error * r / (r.sin() if name == "sine" else r.atan())
        worst = max(worst, error.upper())
    return float(worst)


# ---- rounding ----


@dataclass(frozen=True)
class Term:
    """A computed number: bounds of its magnitude, and of its distance from what it stands for."""

    size: float
    error: float


def half_unit(size: float, precision: Precision) -> float:
    """Half a unit in the last place of numbers up to `size`."""
    return 0.5 * float(last_place(size, precision))


def last_place(size: float, precision: Precision) -> float:
    """The unit in the last place of `size`, no subnormals."""
    exponent = 0
    while 2.0 ** (exponent + 1) <= size:
        exponent += 1
    while 2.0**exponent > size:
        exponent -= 1
    return float(2.0 ** (exponent - precision.significand + 1))


class Follower:
    """Rounded products and sums of terms. Sums of bounds are made a little larger than they are computed."""

    slack = 1 + 1e-12

    def __init__(self, precision: Precision) -> None:
        self.precision = precision

    def round_up(self, size: float, error: float) -> Term:
        size = size * self.slack
        return Term(size + half_unit(size, self.precision), (error + half_unit(size, self.precision)) * self.slack)

    def product(self, a: Term, b: Term) -> Term:
        error = a.size * b.error + b.size * a.error + a.error * b.error
        return self.round_up(a.size * b.size, error)

    def total(self, a: Term, b: Term) -> Term:
        return self.round_up(a.size + b.size, a.error + b.error)

    def polynomial(self, coefficients: Sequence[float], z: Term, least: float) -> Term:
        """Horner; `least` is the least z. Signs alternate and sizes fall: a sum is no larger than its constant."""
        found = Term(abs(coefficients[-1]), 0.0)
        for c in reversed(coefficients[:-1]):
            step = self.product(z, found)
            assert step.size < abs(c), "a step has the other sign and is smaller than the constant"
            found = self.round_up(abs(c), step.error)
        first, second, third = (abs(c) for c in coefficients[:3])
        size = first - least * (second - z.size * third) + found.error
        return Term(size * self.slack, found.error)


def rounding(low: float, high: float, precision: Precision, sine: bool, tail: Term) -> float:
    """Absolute error of sin_r or cos_r for low <= |r| < high and a tail."""
    f = Follower(precision)
    fits = SINCOS[precision.name]
    r = Term(high, 0.0)
    z, least = f.round_up(high * high, 0.0), low * low * BELOW_ONE
    if sine:
        cube = f.product(f.product(z, r), f.polynomial(fits.sine, z, least))
        slope = f.product(Term(1.0, half_unit(BELOW_ONE, precision) + high**4 / 24), tail)
        small = f.total(cube, slope)
        truncated = tail.size**2 * high  # sin(r_hi - r_tail) to first order in r_tail
        truncated += approximation("sine", precision) * high
        most = math.sin(high)
    else:
        fit = f.product(f.product(z, z), f.polynomial(fits.cosine, z, least))
        small = f.total(fit, f.product(r, tail))
        lost = Term(half_unit(BELOW_ONE, precision), z.error / 2)  # of 1 - z/2: exact, but for the error of z itself
        small = f.total(lost, small)
        truncated = tail.size**2 + tail.size * high**3 / 6 + approximation("cosine", precision)
        most = BELOW_ONE
    final = half_unit(most * (1 - 1e-9), precision)
    return (final + small.error + truncated) * f.slack


def tail_of(high: float, precision: Precision, turns: int) -> Term:
    """r_tail after this many quarter turns: the rounding of r_hi, and the third part; with what the reduction loses."""
    _, second, third = (abs(p) for p in half_pi_parts(precision))
    size = half_unit(high, precision) + turns * third
    missing = float(abs(PI / 2 - sum(map(Fraction, half_pi_parts(precision)))))
    error = half_unit(size, precision) + half_unit(turns * third, precision) + turns * missing
    if turns >= 1 << SMALL_TURNS:
        error += half_unit(turns * second, precision)  # else this product is exact
    return Term(size, error)


def borders(precision: Precision) -> list[float]:
    """Numbers of 0 to REDUCED between which neither r nor sin r crosses a power of two, each interval short."""
    lowest = -precision.significand - 12
    powers = [2.0**-k for k in range(1, -lowest)]
    coarse = sorted({REDUCED, least_reduced(precision), *powers, *(math.asin(p) for p in powers)})
    found = [coarse[0]]
    for low, high in itertools.pairwise(coarse):
        found += [low + (high - low) * k / 64 for k in range(1, 64)] + [high]
    return found


@cache
def small_angle_error(precision: Precision, sine: bool) -> float:
    """Units in the last place, |x| <= 8 pi. Below the first border r^3 is nothing beside a unit of r: half a unit."""
    worst = 0.0
    for low, high in itertools.pairwise(borders(precision)):
        off = high > least_reduced(precision)  # closer to a multiple of pi/2 there is only 0, where k = 0
        tail = tail_of(high, precision, MOST_TURNS) if off else Term(0.0, 0.0)
        least = math.sin(low) * (1 + 1e-9) if sine else math.cos(high)
        worst = max(worst, rounding(low, high, precision, sine, tail) / last_place(least, precision))
    return worst


@cache
def anywhere(precision: Precision, sine: bool) -> float:
    """Absolute, over the whole accepted range."""
    turns = int(precision.max_phase / (math.pi / 2)) + 1
    pairs = list(itertools.pairwise(borders(precision)))
    return max(rounding(low, high, precision, sine, tail_of(high, precision, turns)) for low, high in pairs)


# ---- reduction ----


def convergents(exponent: int, limit: int) -> Iterator[tuple[int, int]]:
    """p/q of the continued fraction of (pi/2)/2^exponent, p below a limit."""
    value = PI / 2 / Fraction(2) ** exponent
    p0, q0, p1, q1 = 0, 1, 1, 0
    while True:
        whole = value.numerator // value.denominator
        p0, q0, p1, q1 = p1, q1, whole * p1 + p0, whole * q1 + q0
        if p1 >= limit:
            return
        if p1:
            yield p1, q1
        value = 1 / (value - whole)


@cache
def least_reduced(precision: Precision) -> float:
    """No machine number up to 8 pi is closer to a multiple of pi/2 but 0: convergents are the best approximations."""
    limit = 1 << precision.significand
    least = Fraction(1)
    for exponent in range(-precision.significand, 5 - precision.significand + 1):
        for p, q in convergents(exponent, limit):
            least = min(least, abs(p * Fraction(2) ** exponent - q * PI / 2))
    return float(least) * 0.999


def rows(precisions: Sequence[Precision] = (DOUBLE, FLOAT)) -> Iterator[Row]:
    """All that is proven."""
    for precision in precisions:
        name = precision.name
        unit = precision.epsilon
        for what, words, most in (
            ("sine", "polynomial of the sine, relative", 0.04 * unit),
            ("cosine", "polynomial of the cosine, absolute", 0.04 * unit),
            ("arc tangent", "polynomial of the arc tangent, relative", 0.1 * unit),
            ("hyperbolic sine", "polynomial of the hyperbolic sine, relative", 0.04 * unit),
            ("hyperbolic cosine", "polynomial of the hyperbolic cosine, absolute", 0.04 * unit),
        ):
            yield Row(words, name, approximation(what, precision), "", most)
        for sine in (True, False):
            words = "sine and cosine by the polynomial of the " + ("sine" if sine else "cosine")
            yield Row(f"{words}, up to 8 pi", name, small_angle_error(precision, sine), "ulp", 1.0)
            most = {"double": 1e-16, "float": 6e-8}[name]
            yield Row(f"{words}, up to {precision.max_phase:g}", name, anywhere(precision, sine), "", most)


if __name__ == "__main__":
    for row in rows():
        print(*row.cells(), sep=" | ")
