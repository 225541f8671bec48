"""Motion of flywheels from their phases or speeds: phi, phi', phi'' by one spline, never by differences.

The least-squares spline of degree 5 has a knot each 1/(2 bandwidth) s; its derivatives are exact. `modulate` is the
other way: integrals over windows, in which no derivative of data is left.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import make_lsq_spline

from mahovik.use.measured.recording import Array, Recording

DEGREE = 5
BANDWIDTH = 10.0
"""Hz of the motion of a flywheel that the spline follows by default."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Motion of the flywheels of a stand: phi, phi', phi'' (T, N) in rad, rad/s, rad/s2.

    Zero where nothing was measured, and NaN outside the data of a flywheel; `measured` (N,): which have data.
    """

    phi: Array
    phi_dot: Array
    phi_ddot: Array
    measured: tuple[bool, ...]


def flywheel_motion(recording: Recording, names: tuple[str, ...], bandwidth: float = BANDWIDTH) -> Motion:
    """Motion of the flywheels of these names at the times of a recording.

    From the phase if there is one, else from the integral of the speed, with phase zero at the first sample.
    """
    t = recording.t
    found = np.zeros((3, len(t), len(names)))
    measured = []
    for k, name in enumerate(names):
        phase, speed = recording.find(name, "phase"), recording.find(name, "speed")
        channel = phase or speed
        measured.append(channel is not None)
        if channel is None:
            continue
        kept = np.isfinite(channel.values)
        first = 0 if phase is not None else 1
        spline = _spline(t[kept], channel.values[kept], bandwidth)
        outside = (t < t[kept][0]) | (t > t[kept][-1])
        for order in range(first, 3):
            values = spline.derivative(order - first)(t) if order > first else spline(t)
            found[order, :, k] = np.where(outside, np.nan, values)
        if first:
            found[0, :, k] = np.where(outside, np.nan, spline.antiderivative()(t))
    return Motion(found[0], found[1], found[2], tuple(measured))


def _spline(t: Array, values: Array, bandwidth: float):  # type: ignore[no-untyped-def]
    """Least-squares spline; between knots are two samples and more."""
    degree = min(DEGREE, len(t) - 1)
    wanted = np.arange(t[0], t[-1], 0.5 / bandwidth)[1:]
    places = np.unique(np.searchsorted(t, wanted))
    places = places[(places > degree) & (places < len(t) - degree - 1)]
    if len(places):
        far = np.concatenate([[True], np.diff(places) >= 2])
        places = places[far]
    inner = t[places]
    knots = np.concatenate([[t[0]] * (degree + 1), inner, [t[-1]] * (degree + 1)])
    return make_lsq_spline(t, values, knots, k=degree)


def modulate(t: Array, values: Array, length: float, derivative: int = 0, power: int = 4) -> Array:
    """(W, ...) Integrals of a derivative of values (T, ...) times a window, over windows that overlap by half.

    By parts: integral psi x^(n) dt = (-1)^n integral psi^(n) x dt, with psi = (4 s (1 - s))^power of s from 0 to 1 in
    a window of `length` s, whose derivatives below `power` vanish at its ends. Windows with NaN are NaN.
    """
    bump = Polynomial([0.0, 4.0, -4.0]) ** power
    factor = (-1.0) ** derivative / length**derivative
    psi = bump.deriv(derivative) if derivative else bump
    rows = []
    for start in np.arange(t[0], t[-1] - length * (1.0 - 1e-9), 0.5 * length):
        inside = (t >= start - 1e-12) & (t <= start + length + 1e-12)
        s = np.clip((t[inside] - start) / length, 0.0, 1.0)
        weight = factor * psi(s)
        shape = (-1,) + (1,) * (values.ndim - 1)
        rows.append(np.trapezoid(weight.reshape(shape) * values[inside], t[inside], axis=0))
    return np.array(rows).reshape(len(rows), *values.shape[1:])
