"""Sines and cosines of unbalance: arrays have the bits of single numbers, which have 40 digits behind them."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from mahovik.core.stand import polar as module
from mahovik.core.stand.polar import polar

Array = NDArray[np.float64]


def one_by_one(length: Any, angle: Any, divisor: Any) -> tuple[Array, Array]:
    found = [
        polar(float(a), float(b), float(c))
        for a, b, c in np.broadcast(np.asarray(length), np.asarray(angle), np.asarray(divisor))
    ]
    return np.array([x for x, _ in found]), np.array([y for _, y in found])


def arguments(n: int) -> dict[str, tuple[Any, Any, Any]]:
    rng = np.random.default_rng(3)
    lengths, angles, masses = 10.0 ** rng.uniform(-12, 2, n), rng.uniform(-50, 50, n), 10.0 ** rng.uniform(-3, 4, n)
    quarters = np.pi / 2 * rng.integers(-40, 40, n)
    return {
        "all": (lengths, angles, masses),
        "one angle": (lengths, 0.7, masses),
        "one angle near a zero": (lengths, np.pi / 2, 2.0),
        "one length": (-1e-3, angles, 1.0),
        "near zeros": (lengths, quarters, masses),
        "far away": (lengths, angles * 1e5, masses),
        "no length": (np.zeros(n), angles, masses),
        "tiny": (lengths * 1e-300, angles, masses),
    }


@pytest.mark.parametrize("case", arguments(1))
def test_arrays_have_the_bits_of_single_numbers(case: str) -> None:
    given = arguments(300)[case]
    for found, expected in zip(polar(*given), one_by_one(*given), strict=True):
        assert expected.tobytes() == np.asarray(found).tobytes()


def test_few_numbers_need_all_digits(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_exact", lambda *_: pytest.fail("asked for 40 digits"))
    polar(*arguments(300)["all"])
