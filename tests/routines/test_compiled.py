"""The compiled routines: the interpreter's bits, any optimisation's bits, and millions of arguments.

References: NumPy's sqrt (an IEEE operation), double for float, and long double for double where it is longer.
"""

from typing import Any

import numpy as np
import pytest

from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from routines.compiled import run
from routines.run import call, call_sincos
from routines.test_exponential import exponents

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
NEAR_ZERO = 8 * np.pi
SINCOS, ATAN2 = 0.82, 1.6  # measured over 200 million arguments: 0.80 and 1.57
ABSOLUTE = {"double": 1e-16, "float": 6e-8}
LONGER = {"double": np.longdouble, "float": np.float64}


@pytest.fixture
def longer(precision: Precision) -> Any:
    """A type in which NumPy's functions serve as reference."""
    kind: Any = LONGER[precision.name]
    if np.finfo(kind).nmant <= precision.significand + 8:
        pytest.skip("long double is no longer than double here")
    return kind


def error(got: np.ndarray, expected: np.ndarray, precision: Precision) -> float:
    """The largest error in units in the last place."""
    unit = np.spacing(np.abs(expected.astype(precision.scalar)))
    return float(np.max(np.abs(got - expected) / unit))


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
    found = {
        "sincos": (np.array(angles),),
        "sqrt": (numbers_of_every_size(precision, count),),
        "atan2": points_of_every_kind(precision, count),
        "exp": (np.array([*exponents(precision, count), -1e4, -1e30, -1e-40]),),
    }
    return {name: tuple(a.astype(precision.scalar) for a in arguments) for name, arguments in found.items()}


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
def test_million_angles_up_to_eight_pi(precision: Precision, longer: str) -> None:
    angles = angles_of_every_kind(precision, 1_000_000)
    sine, cosine = run(precision, "sincos", angles)
    assert error(sine, np.sin(angles.astype(longer)), precision) <= SINCOS
    assert error(cosine, np.cos(angles.astype(longer)), precision) <= SINCOS


@PRECISIONS
def test_million_angles_of_the_accepted_range(precision: Precision, longer: str) -> None:
    angles = np.random.default_rng(4).uniform(-1, 1, 1_000_000) * precision.max_phase
    angles = angles.astype(precision.scalar)
    sine, cosine = run(precision, "sincos", angles)
    assert np.max(np.abs(sine - np.sin(angles.astype(longer)))) <= ABSOLUTE[precision.name]
    assert np.max(np.abs(cosine - np.cos(angles.astype(longer)))) <= ABSOLUTE[precision.name]


def test_every_float_angle_of_two_binades() -> None:
    """1/2 to 2: both reductions, and the largest reduced angles."""
    for first in range(126 << 23, 128 << 23, 1 << 22):
        angles = np.arange(first, first + (1 << 22), dtype=np.uint32).view(np.float32)
        sine, cosine = run(FLOAT, "sincos", angles)
        assert error(sine, np.sin(angles.astype(np.float64)), FLOAT) <= SINCOS
        assert error(cosine, np.cos(angles.astype(np.float64)), FLOAT) <= SINCOS


@PRECISIONS
def test_million_roots(precision: Precision) -> None:
    numbers = numbers_of_every_size(precision, 2_000_000)
    (root,) = run(precision, "sqrt", numbers)
    assert np.array_equal(root, np.sqrt(numbers))


@PRECISIONS
def test_million_directions(precision: Precision, longer: str) -> None:
    y, x = (v.astype(precision.scalar) for v in points_of_every_kind(precision, 500_000))
    (angle,) = run(precision, "atan2", y, x)
    assert error(angle, np.arctan2(y.astype(longer), x.astype(longer)), precision) <= ATAN2
