"""The solver: its triangular factor against Householder's, and fits whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import least_squares

from mahovik.out.identify.gauss_newton import LOSSES, Loss, minimise, triangle


@pytest.mark.parametrize("condition", [1.0, 1e6, 1e10])
def test_triangle_has_the_singular_values_of_the_matrix(condition: float) -> None:
    rng = np.random.default_rng(1)
    Q, _ = np.linalg.qr(rng.normal(size=(3000, 12)))
    V, _ = np.linalg.qr(rng.normal(size=(12, 12)))
    A = (Q * np.geomspace(1.0, 1.0 / condition, 12)) @ V
    found = np.linalg.svd(triangle(A), compute_uv=False)
    assert np.allclose(found, np.linalg.svd(A, compute_uv=False), rtol=1e-6, atol=1e-14)


def test_triangle_of_columns_that_depend_on_one_another_has_small_singular_values() -> None:
    A = np.random.default_rng(2).normal(size=(500, 3))
    found = np.linalg.svd(triangle(np.column_stack([A, A[:, 0] - A[:, 1], np.zeros(500)])), compute_uv=False)
    assert (found[3:] < 1e-6 * found[0]).all() and found[2] > 0.1 * found[0]


@pytest.mark.parametrize("loss", LOSSES)
def test_the_least_loss_is_that_of_scipy(loss: Loss) -> None:
    rng = np.random.default_rng(3)
    t = np.linspace(0.0, 2.0, 80)
    y = 2.0 * np.exp(-0.8 * t) + 0.01 * rng.normal(size=80)
    y[::10] += 1.0

    def residuals(z: np.ndarray) -> np.ndarray:
        return np.asarray((z[0] * np.exp(-z[1] * t) - y) / 0.05)

    def jacobian(z: np.ndarray, _exact: bool = True) -> np.ndarray:
        decay = np.exp(-z[1] * t)
        return np.column_stack([decay, -z[0] * t * decay]) / 0.05

    expected = least_squares(residuals, [1.0, 0.1], jacobian, loss=loss, xtol=1e-12, ftol=1e-14, gtol=1e-12).x
    assert np.allclose(minimise(residuals, jacobian, np.array([1.0, 0.1]), loss), expected, rtol=1e-4)


def test_old_derivatives_do_not_end_the_search() -> None:
    """Residuals are large at the end: the gradient by derivatives of a place nearby is another."""

    def residuals(z: np.ndarray) -> np.ndarray:
        return np.array([z[0] ** 2 + 1.0, 5.0 * (z[0] - 1.0), 2.0 * np.sin(3.0 * z[0])])

    def derivatives(z: np.ndarray) -> np.ndarray:
        return np.array([[2.0 * z[0]], [5.0], [6.0 * np.cos(3.0 * z[0])]])

    kept: list[np.ndarray] = []

    def jacobian(z: np.ndarray, exact: bool) -> np.ndarray:
        if exact or not kept:
            kept[:] = [derivatives(z)]
        return kept[0]

    z = minimise(residuals, jacobian, np.array([0.9]))
    assert abs(float((derivatives(z).T @ residuals(z))[0])) < 1e-4 * float(
        np.abs(derivatives(z)[:, 0]) @ np.abs(residuals(z))
    )
