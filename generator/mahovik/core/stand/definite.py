"""Least eigenvalue of the full (6 + N) mass matrix over all phases, scaled to unit diagonal.

The matrix is singular exactly where its Schur complement (flywheels eliminated) is: a 6x6 that is a constant
plus one term a flywheel, each of its own phase only. For a fixed direction x every phase can then be minimised
by itself, and for fixed phases x is an eigenvector; the two in turn go down, from many starts, fast at any N.
The answer is the eigenvalue of the full matrix at the worst phases found. Its own code, shared with no derivation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.masses import blocks, cross, inertia_about_origin, placement, transfer
from mahovik.core.stand.model import Carrier, Flywheel, Instrument, Stand

Array = NDArray[np.float64]

_STARTS = 32
_ROUNDS = 20
_POLISH_COUNT = 6
_STEPS = 10
_GRID = 32
_SEED = 1986


def least_eigenvalue(stand: Stand) -> tuple[float, tuple[float, ...]]:
    """Least eigenvalue found, and the phases (rad) where; -inf where a diagonal element is zero or not finite.

    Where a diagonal element nearly vanishes at some phase, scaling to unit diagonal there would hide it: the
    eigenvalue is taken with the diagonal's mean over the phases as well, and the lesser of the two is returned.
    """
    constant, rotors = _fixed_inertia(stand), _Rotors(stand)
    mean = constant + rotors.mean
    diagonal = np.diag(mean)
    at_zero = (0.0,) * len(stand.flywheels)
    if not (diagonal > 0).all() or not np.isfinite(mean).all():
        return -np.inf, at_zero
    scale = 1.0 / np.sqrt(diagonal)
    candidates: list[Array] = [np.zeros(len(stand.flywheels))]
    if stand.flywheels:
        scaling = scale[:, None] * scale[None, :]
        harmonics = rotors.schur * scaling
        if not np.isfinite(harmonics).all():
            return -np.inf, at_zero
        starts = _alternate(constant * scaling, harmonics)
        candidates += list(_polish(constant * scaling, rotors, scale, starts))
    values = [_eigenvalue(constant, rotors, phases, scale) for phases in candidates]
    worst = int(np.argmin(values))
    return values[worst], tuple(float(x) for x in np.mod(candidates[worst], 2 * np.pi))


def condition_of_twists(stand: Stand, S: Array) -> float:
    """Condition of S^T D S, scaled to unit diagonal, D the diagonal of K averaged over phases; inf: hidden by rounding.

    S (6xm): twists of O1 in E1. Whoever solves for a motion along them loses as many digits. What a far centre of mass
    couples is not counted: it is the stand's, whichever twists say the same motions.
    """
    along = (S.T * np.diag(_fixed_inertia(stand) + _Rotors(stand).mean)) @ S
    diagonal = np.diag(along)
    if not (diagonal > 0).all() or not np.isfinite(along).all():
        return np.inf
    values = np.linalg.eigvalsh(along / np.sqrt(np.outer(diagonal, diagonal)))
    return float(values[-1] / values[0]) if values[0] > 1e-15 else np.inf


def _alternate(constant: Array, harmonics: Array) -> Array:
    """Phases (starts, N) of the lowest Schur complements; `harmonics` (N, 5, 6, 6) of 1, cos, sin, cos 2, sin 2."""
    rng = np.random.default_rng(_SEED)
    x = rng.normal(size=(_STARTS, 6))
    grid: Array = np.arange(_GRID, dtype=np.float64) * (2 * np.pi / _GRID)
    table, flat = _basis(grid), harmonics.reshape(-1, 36)
    for _ in range(_ROUNDS):
        quadratic = ((x[:, :, None] * x[:, None, :]).reshape(-1, 36) @ flat.T).reshape(len(x), -1, 5)
        phases = grid[np.argmin(quadratic @ table.T, axis=-1)]
        for _ in range(3):
            phases = phases - _newton_step(quadratic, phases)
        terms = (_basis(phases).reshape(len(x), -1) @ flat).reshape(-1, 6, 6)
        values, vectors = np.linalg.eigh(constant + terms)
        x = vectors[:, :, 0]
    order = np.argsort(values[:, 0])
    return np.asarray(phases[order[:_POLISH_COUNT]], dtype=np.float64)


def _polish(constant: Array, rotors: _Rotors, scale: Array, phases: Array) -> Array:
    """Gauss-Newton on |W_s R^T(phi_s) L^T x|^2: where the least value is zero, alternation only creeps to it.

    The residuals are linear in x, so each step is again an eigenvector, of the sum projected off the phases' columns.
    """
    W, down = rotors.root, np.swapaxes(rotors.mount, 1, 2) * scale
    values, x = _lowest(constant, _residual(W, down, phases, 0))
    for _ in range(_STEPS):
        rows, slopes = _residual(W, down, phases, 0), _residual(W, down, phases, 1)
        a = np.einsum("bnij,bj->bni", slopes, x)
        square = np.einsum("bni,bni->bn", a, a)
        inverse = np.divide(1.0, square, out=np.zeros_like(square), where=square > 1e-12)
        along = np.einsum("bni,bnij->bnj", a, rows) * np.sqrt(inverse)[..., None]
        projected = np.einsum("bnki,bnkj->bij", rows, rows) - np.einsum("bni,bnj->bij", along, along)
        y = np.linalg.eigh(constant + projected)[1][:, :, 0]
        step = np.einsum("bni,bnij,bj->bn", a, rows, y, optimize=True) * inverse
        step *= np.sign(np.einsum("bi,bi->b", x, y))[:, None]
        trial = phases - np.clip(step, -0.5, 0.5)
        trial_values, trial_x = _lowest(constant, _residual(W, down, trial, 0))
        better = trial_values < values
        phases = np.where(better[:, None], trial, phases)
        x = np.where(better[:, None], trial_x, x)
        values = np.where(better, trial_values, values)
    return phases


def _residual(W: Array, down: Array, phases: Array, derivative: int) -> Array:
    """W_s R^T(phi_s) L^T (starts, N, 6, 6), or its derivative by the phase."""
    return np.asarray(W @ np.swapaxes(_turns(phases, derivative), -1, -2) @ down, dtype=np.float64)


def _turns(phases: Array, derivative: int = 0) -> Array:
    """diag(C1, C1) of each phase (..., 6, 6), or its derivative by the phase."""
    c, s = np.cos(phases), np.sin(phases)
    turns = np.zeros((*phases.shape, 6, 6))
    if derivative:
        c, s = -s, c
    for block in (0, 3):
        turns[..., block, block] = 0.0 if derivative else 1.0
        turns[..., block + 1, block + 1] = turns[..., block + 2, block + 2] = c
        turns[..., block + 1, block + 2], turns[..., block + 2, block + 1] = -s, s
    return turns


def _lowest(constant: Array, rows: Array) -> tuple[Array, Array]:
    values, vectors = np.linalg.eigh(constant + np.einsum("bnki,bnkj->bij", rows, rows))
    return values[:, 0], vectors[:, :, 0]


def _basis(phases: Array) -> Array:
    columns = [np.ones_like(phases), np.cos(phases), np.sin(phases), np.cos(2 * phases), np.sin(2 * phases)]
    return np.stack(columns, axis=-1)


def _newton_step(q: Array, phases: Array) -> Array:
    """Newton step to the minimum of a trigonometric polynomial, at most a grid cell; zero where it is flat."""
    c, s = np.cos(phases), np.sin(phases)
    c2, s2 = (c - s) * (c + s), 2 * s * c
    slope = -q[..., 1] * s + q[..., 2] * c - 2 * q[..., 3] * s2 + 2 * q[..., 4] * c2
    bend = -q[..., 1] * c - q[..., 2] * s - 4 * q[..., 3] * c2 - 4 * q[..., 4] * s2
    step = np.divide(slope, bend, out=np.zeros_like(slope), where=bend > 1e-300)
    return np.asarray(np.clip(step, -2 * np.pi / _GRID, 2 * np.pi / _GRID))


def _eigenvalue(constant: Array, rotors: _Rotors, phases: Array, mean_scale: Array) -> float:
    """Least eigenvalue of the full matrix at these phases, at unit diagonal and at unit mean diagonal."""
    full = np.zeros((6 + len(phases), 6 + len(phases)))
    L, Theta = rotors.mount @ _turns(phases), rotors.Theta
    full[:6, :6] = constant + (L @ Theta @ np.swapaxes(L, -1, -2)).sum(axis=0)
    full[:6, 6:] = (L @ Theta[:, :, 3:4])[:, :, 0].T
    full[6:, :6] = full[:6, 6:].T
    full[range(6, len(full)), range(6, len(full))] = Theta[:, 3, 3]
    diagonal = np.diag(full)
    if not (diagonal > 0).all() or not np.isfinite(full).all():
        return -np.inf
    by_diagonal = 1.0 / np.sqrt(diagonal)
    scales = (by_diagonal, np.concatenate([mean_scale, by_diagonal[6:]]))
    return min(_least(full * scale[:, None] * scale[None, :]) for scale in scales)


def _least(scaled: Array) -> float:
    """Least eigenvalue of [[A, B], [B^T, E]], A 6x6: it is that of [[A, R^T], [R, E]] with B^T = Q R, or 1."""
    if len(scaled) <= 12:
        return float(np.linalg.eigvalsh(scaled)[0])
    R: Array = np.asarray(np.linalg.qr(scaled[6:, :6], mode="r"), dtype=np.float64)
    small = np.block([[scaled[:6, :6], R.T], [R, np.eye(6)]])
    return min(1.0, float(np.linalg.eigvalsh(small)[0]))


class _Rotors:
    """The N flywheels, along the first axis: transfer from the frame at phi_s = 0 to E1, spatial inertia, harmonics."""

    def __init__(self, stand: Stand) -> None:
        outer = {instrument.name: transfer(*placement(instrument)) for instrument in stand.instruments}
        mounts = [outer.get(s.mount, np.eye(6)) @ transfer(*placement(s)) for s in stand.flywheels]
        self.mount = np.array(mounts).reshape(-1, 6, 6)
        self.Theta = np.array([_spatial(s) for s in stand.flywheels]).reshape(-1, 6, 6)
        row, diagonal = self.Theta[:, 3], np.diagonal(self.Theta, axis1=1, axis2=2)
        free = self.Theta - (row / row[:, 3:4])[:, :, None] * row[:, None, :]
        size = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
        values, vectors = np.linalg.eigh(free / size[:, :, None] / size[:, None, :])
        # root^T root = free
        self.root = np.sqrt(np.maximum(values, 0.0))[:, :, None] * np.swapaxes(vectors, 1, 2) * size[:, None, :]
        L = self.mount[:, None] @ _SAMPLES
        down = np.swapaxes(L, -1, -2)
        self.mean: Array = (L @ self.Theta[:, None] @ down).mean(axis=1).sum(axis=0)
        # five equidistant samples determine harmonics 0, 1, 2 exactly
        sampled = (L @ free[:, None] @ down).reshape(-1, 5, 36)
        self.schur = np.linalg.solve(_basis(_FIFTHS), sampled).reshape(-1, 5, 6, 6)


_FIFTHS: Array = np.arange(5, dtype=np.float64) * (2 * np.pi / 5)
_SAMPLES = _turns(_FIFTHS)


def _fixed_inertia(stand: Stand) -> Array:
    total = _spatial(stand.carrier)
    for instrument in stand.instruments:
        L = transfer(*placement(instrument))
        total = total + L @ _spatial(instrument) @ L.T
    for added in (stand.carrier.added_mass, *(instrument.added_mass for instrument in stand.instruments)):
        if added is not None:
            total = total + np.array(added)
    return total


def _spatial(body: Carrier | Instrument | Flywheel) -> Array:
    first = body.mass * cross(np.array(body.center_of_mass))
    return blocks(body.mass * np.eye(3), -first, first, inertia_about_origin(body))
