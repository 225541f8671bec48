"""Relative phases of flywheels of one speed that cancel their amplitudes as far as possible."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
SWEEPS = 400


def cancel(a: Complex, rng: np.random.Generator, starts: int = 48) -> tuple[Array, float]:
    """Angles psi (m; the first 0) that minimise |sum_k a_k exp(i psi_k)|^2, and the minimum; a: axes x m.

    Each angle in turn is set to its best value for the others, which never increases the sum, from many starts at once;
    Newton's method refines the best.
    """
    m = a.shape[1]
    if m == 1:
        return np.zeros(1), float(np.sum(np.abs(a) ** 2))
    R = a.conj().T @ a
    z = np.exp(1j * rng.uniform(-np.pi, np.pi, (starts, m)))
    before = np.full(starts, np.inf)
    for sweep in range(SWEEPS):
        for k in range(m):
            others = z @ R[k] - z[:, k] * R[k, k]
            size = np.abs(others)
            z[:, k] = np.where(size > 0.0, -others / np.where(size > 0.0, size, 1.0), z[:, k])
        if sweep % 10 == 9:
            now = _powers(a, z)
            if np.all(before - now <= 1e-9 * now):
                break
            before = now
    psi = np.angle(z[int(np.argmin(_powers(a, z)))])
    psi = _newton(a, psi)
    psi = np.angle(np.exp(1j * (psi - psi[0])))
    return psi, power(a, psi)


def power(a: Complex, psi: Array) -> float:
    """|sum_k a_k exp(i psi_k)|^2."""
    return float(np.sum(np.abs(a @ np.exp(1j * psi)) ** 2))


def _powers(a: Complex, z: Complex) -> Array:
    return np.asarray(np.sum(np.abs(z @ a.T) ** 2, axis=1))


def _newton(a: Complex, psi: Array) -> Array:
    """Damped Gauss-Newton steps on the real rows of the sum, as long as they reduce it."""
    damping, now = 1e-6, power(a, psi)
    for _ in range(60):
        terms = a * np.exp(1j * psi)
        total, slopes = terms.sum(axis=1), (1j * terms)[:, 1:]
        rows, r = np.vstack([slopes.real, slopes.imag]), np.concatenate([total.real, total.imag])
        H = rows.T @ rows
        step = np.linalg.solve(H + damping * (np.trace(H) / len(H) + 1e-300) * np.eye(len(H)), -(rows.T @ r))
        tried = psi + np.append(0.0, step)
        then = power(a, tried)
        if then < now:
            psi, now, damping = tried, then, max(damping * 0.1, 1e-14)
        else:
            damping *= 10.0
            if damping > 1e6:
                break
    return psi
