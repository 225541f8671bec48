"""The compiled routines: the interpreter's bits, any optimisation's bits, and millions of arguments.

References: NumPy's sqrt (an IEEE operation), double for float, and long double for double where it is longer.
"""

from fractions import Fraction

import numpy as np
import pytest

from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from routines.compiled import run
from routines.run import call, call_sincos, neighbours
from routines.test_exponential import exponents

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
NEAR_ZERO = 8 * np.pi


def angles_of_every_kind(precision: Precision, count: int) -> np.ndarray:
    draw = np.random.default_rng(1)
    near = draw.uniform(-NEAR_ZERO, NEAR_ZERO, count)
    eighths = draw.integers(-32, 33, count) * np.pi / 4
    close = eighths * (1 + np.finfo(precision.scalar).eps * draw.integers(-100, 100, count))
    angles = np.concatenate([near, close]).astype(precision.scalar)
    return np.asarray(angles[np.abs(angles) <= NEAR_ZERO])


def points_of_every_kind(precision: Precision, count: int) -> tuple[np.ndarray, np.ndarray]:
    draw = np.random.default_rng(2)
    x, y = draw.normal(size=(2, count)) * np.exp(draw.uniform(-20, 20, (2, count)))
    half = draw.uniform(0.5, 1, count)
    return np.concatenate([y, half * draw.uniform(0.45, 0.55, count)]), np.concatenate([x, half])


def numbers_of_every_size(precision: Precision, count: int) -> np.ndarray:
    draw = np.random.default_rng(3)
    infinity = int(np.array(np.inf, precision.scalar).view(precision.word))
    return draw.integers(0, infinity, count, dtype=precision.word).view(precision.scalar)


def arguments_of_every_kind(precision: Precision, count: int) -> dict[str, tuple[np.ndarray, ...]]:
    """Arguments of each routine by its name, of the element type."""
    angles = [*angles_of_every_kind(precision, count), 0.0, -0.0, 1e-40, precision.max_phase]
    kinds = {
        "sincos": (np.array(angles),),
        "sqrt": (numbers_of_every_size(precision, count),),
        "atan2": points_of_every_kind(precision, count),
        "exp": (np.array([*exponents(precision, count), -1e4, -1e30, -1e-40]),),
    }
    return {name: tuple(a.astype(precision.scalar) for a in arguments) for name, arguments in kinds.items()}


@PRECISIONS
def test_compiled_is_the_interpreter_bit_for_bit(precision: Precision) -> None:
    for name, arguments in arguments_of_every_kind(precision, 700).items():
        compiled = np.array(run(precision, name, *arguments)).T
        rows = list(zip(*arguments, strict=True))
        if name == "sincos":
            interpreted = np.array([call_sincos(precision, x) for (x,) in rows])
        else:
            interpreted = np.array([call(precision, name, *row) for row in rows])
        assert compiled.tobytes() == interpreted.tobytes(), name


@PRECISIONS
@pytest.mark.parametrize("flags", (("-O0",), ("-O3",), ("-Os",)), ids=lambda f: f[0])
def test_optimisation_changes_no_bit(precision: Precision, flags: tuple[str, ...]) -> None:
    """-O3 vectorises the loop over sincos."""
    for name, arguments in arguments_of_every_kind(precision, 50_000).items():
        plain, other = run(precision, name, *arguments), run(precision, name, *arguments, flags=flags)
        assert [a.tobytes() for a in plain] == [a.tobytes() for a in other], name


@PRECISIONS
def test_million_roots(precision: Precision) -> None:
    numbers = numbers_of_every_size(precision, 2_000_000)
    (root,) = run(precision, "sqrt", numbers)
    assert np.array_equal(root, np.sqrt(numbers))


@PRECISIONS
def test_hard_roots(precision: Precision) -> None:
    """Rounded squares of (k + 1/2) units in the last place are the hardest; powers of two, subnormals, zeros."""
    draw, ones = np.random.default_rng(4), 1 << (precision.significand - 1)
    hard: list[float] = [0.0, -0.0, np.finfo(precision.scalar).max, np.finfo(precision.scalar).tiny]
    for k in (*draw.integers(ones, 2 * ones, 1500), ones, 2 * ones - 1):
        square = (Fraction(int(k)) + Fraction(1, 2)) ** 2 / ones**2
        for scale in (1.0, 0.25, 2.0**20):
            hard.extend(neighbours(precision, float(square) * scale, reach=1))
    for exponent in range(2 - precision.bias, precision.bias):
        hard.extend(neighbours(precision, 2.0**exponent, reach=2))
    words = draw.integers(1, ones, 2000, dtype=precision.word)
    numbers = np.concatenate([np.array(hard, precision.scalar), words.view(precision.scalar)])
    (root,) = run(precision, "sqrt", numbers)
    assert root.tobytes() == np.sqrt(numbers).tobytes()
