"""E_x, E_u, x(t0) of (13), and the right sides of its rows, as bounds of IPOPT's unknowns and rows."""

from __future__ import annotations

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.ocp.coefficients import Scaled
from mahovik.use.plan.ocp.structure import Structure

VOLUME = 0.1
"""Limit of |det I+| at the nodes, as a part of its smallest value along the start."""


def unknown_bounds(scaled: Scaled, own: Structure, winding: Array, bias: Array, part: float) -> tuple[Array, Array]:
    """Bounds of speeds, accelerations that are controls, bias (around `bias`, 6), and x(t0) of a finite motion."""
    problem, order, N = scaled.problem, scaled.order, own.N
    bounds = problem.motion.bounds
    x_low, x_high = _state_bounds(scaled, own, winding, part)
    u = np.tile(scaled.limits(bounds, "acceleration", part)[: own.controls], own.M)
    widest = np.full(6, np.inf) if bounds.bias is None else np.array(bounds.bias, dtype=np.float64)
    shift_low, shift_high = (np.where(problem.free, sign * widest - bias, 0.0) for sign in (-1.0, 1.0))
    mean = np.full(N, np.inf if "angle" in own.kinds else 0.0)
    low = np.concatenate([x_low.ravel("F"), -u, shift_low, -mean])
    high = np.concatenate([x_high.ravel("F"), u, shift_high, mean])
    if problem.motion.periodic:
        return low, high
    if bounds.start_phi is not None:
        low[:N] = high[:N] = np.array(bounds.start_phi)[order]
    low[N : 2 * N] = high[N : 2 * N] = np.array(bounds.start_phi_dot or (0.0,) * N)[order] / scaled.Omega
    return low, high


def _state_bounds(scaled: Scaled, own: Structure, winding: Array, part: float) -> tuple[Array, Array]:
    """Bounds of x (2N, columns): greatest speeds, and least speeds on the side of the winding."""
    N, columns, bounds = own.N, own.mesh.columns, scaled.problem.motion.bounds
    fastest = scaled.limits(bounds, "speed", part)
    slow, fast = -fastest, fastest.copy()
    if bounds.speed_min is not None:
        least = scaled.limits(bounds, "speed_min", 1.0 / part)
        back = winding[scaled.order] < 0.0
        slow = np.where((least > 0.0) & ~back, least, slow)
        fast = np.where((least > 0.0) & back, -least, fast)
    free = np.full(N, np.inf)
    low, high = (np.tile(np.concatenate(each)[:, None], columns) for each in ((-free, slow), (free, fast)))
    return low, high


def row_bounds(scaled: Scaled, own: Structure, winding: Array, part: float, first: Array) -> tuple[Array, Array]:
    """Bounds of g: zero for (12) and for the collocation, limits for other rows; `first`: g at the start."""
    bounds, turn = scaled.problem.motion.bounds, 2.0 * np.pi * winding[scaled.order]
    low, high = np.zeros(len(first)), np.zeros(len(first))
    for name, kind in (("dependent", "acceleration"), ("torque", "torque"), ("angle", "angle")):
        if name in own.rows:
            limit = scaled.limits(bounds, kind, part)[-6:] if name == "dependent" else scaled.limits(bounds, kind, part)
            high[own.rows[name]] = np.tile(limit, own.M)
            low[own.rows[name]] = -high[own.rows[name]]
    shifted = {"closing": np.concatenate([turn, 0.0 * turn])}  # phi includes its winding, swing does not
    shifted["angle"] = (own.mesh.nodes[:, None] * turn).ravel()
    shifted["mean"] = own.mesh.weights @ own.mesh.nodes * turn
    for name in shifted.keys() & own.rows.keys() if own.periodic else ():
        low[own.rows[name]] += shifted[name]
        high[own.rows[name]] += shifted[name]
    if "volume" in own.rows:
        low[own.rows["volume"]] = VOLUME * first[own.rows["volume"]].min()
        high[own.rows["volume"]] = np.inf
    return low, high
