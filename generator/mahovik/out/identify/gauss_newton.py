"""Gauss-Newton with step halving and a robust loss by reweighting; rows are reduced by QR before they are solved."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Loss = Literal["linear", "soft_l1", "huber"]

LOSSES: tuple[Loss, ...] = ("linear", "soft_l1", "huber")

ENOUGH = 1e-10
"""A step that promises less than this share of the cost ends the search."""

PASSES, SHIFT = 3, 1e-13
"""Passes of the QR factorisation, and the shift of its first Gram matrix, of the trace."""

STEPS, HALVINGS = 40, 12
"""Most steps, and most halvings of one."""


def weights_of(residuals: Array, loss: Loss) -> Array:
    """Weights of squares with which least squares has the gradient of a robust loss, whose scale is 1."""
    if loss == "linear":
        return np.ones(len(residuals))
    if loss == "huber":
        return np.asarray(1.0 / np.maximum(1.0, np.abs(residuals)))
    return np.asarray(1.0 / np.sqrt(1.0 + residuals**2))


def cost_of(residuals: Array, loss: Loss) -> float:
    """Sum of the loss; infinite if a residual is not finite."""
    if not np.isfinite(residuals).all():
        return float("inf")
    if loss == "linear":
        return float(residuals @ residuals)
    if loss == "huber":
        size = np.abs(residuals)
        return float(np.where(size <= 1.0, size**2, 2.0 * size - 1.0).sum())
    return float(2.0 * (np.sqrt(1.0 + residuals**2) - 1.0).sum())


def triangle_of(J: Array, residuals: Array) -> Array:
    """Triangular factor (p + 1, p + 1) of [J r], by one pass: a step that is a little off is mended by the next."""
    return triangle(np.column_stack([J, residuals]), 1)


def triangle(matrix: Array, passes: int = PASSES) -> Array:
    """Triangular factor R (p, p) of a tall matrix (n, p), R^T R = matrix^T matrix, by shifted Cholesky QR.

    As accurate as Householder's; its work is matrix products. (Fukaya et al., Shifted Cholesky QR, 2020.)
    """
    size = np.sqrt(np.einsum("ij,ij->j", matrix, matrix))
    size[size == 0.0] = 1.0
    found, rest = np.diag(size), matrix / size
    identity = np.eye(matrix.shape[1])
    for k in range(passes):
        gram = rest.T @ rest
        shift = SHIFT if k == 0 else np.finfo(float).eps
        R = np.linalg.cholesky(gram + shift * max(float(np.trace(gram)), 1e-300) * identity).T
        found = R @ found
        if k < passes - 1:
            rest = rest @ np.linalg.inv(R)
    return np.asarray(found)


def minimise(
    residuals: Callable[[Array], Array],
    jacobian: Callable[[Array, bool], Array],
    z: Array,
    loss: Loss = "linear",
) -> Array:
    """The z of least loss, from z on. `jacobian(z, exact)` may return derivatives of a z nearby unless exact.

    Where old derivatives promise or gain nothing more, exact ones are tried; then the search ends.
    """
    now = residuals(z)
    cost, exact = cost_of(now, loss), False
    for _ in range(STEPS):
        J = jacobian(z, exact)
        root = np.sqrt(weights_of(now, loss))
        R = triangle_of(J * root[:, None], now * root)
        step = -np.linalg.lstsq(R[:-1, :-1], R[:-1, -1], rcond=None)[0]
        promised = float(R[:-1, -1] @ R[:-1, -1])
        if promised <= ENOUGH * cost:
            if exact:
                return z
            exact = True
            continue
        for k in range(HALVINGS):
            ahead = z + step * 0.5**k
            then = residuals(ahead)
            after = cost_of(then, loss)
            if after < cost:
                break
        else:
            if exact:
                return z
            exact = True
            continue
        gain, was_exact = cost - after, exact
        z, now, cost, exact = ahead, then, after, False
        if gain <= ENOUGH * cost:
            if was_exact:
                return z
            exact = True
    return z
