"""Motion of points fixed on the carrier along a course in the chart about rest, and its harmonics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.use.study.linear.points import Place

Array = NDArray[np.float64]
Spectrum = NDArray[np.complex128]

QUANTITIES = ("displacement", "velocity", "acceleration")
UNITS = {"displacement": "m", "velocity": "m/s", "acceleration": "m/s2"}


@dataclass(frozen=True, eq=False)
class PointMotion:
    """Motion of one point at M uniform nodes (M, 3 each), from its place at rest, in E0, on its axes at rest."""

    displacement: Array
    velocity: Array
    acceleration: Array

    def harmonics(self, quantity: str) -> Spectrum:
        """(H + 1, 3) complex amplitudes a_k: the quantity is the real part of sum a_k exp(i k base t)."""
        values: Array = getattr(self, quantity)
        spectrum = np.fft.rfft(values, axis=0) * (2.0 / len(values))
        spectrum[0] /= 2.0
        return np.asarray(spectrum)


def point_motion(place: Place, y: Array, V_dot: Array) -> PointMotion:
    """Motion of a point from states y (M, 12) in the chart about rest and V* (M, 6)."""
    turned = Rotation.from_rotvec(y[:, 3:6])
    origin, v, omega = np.tile(place.origin, (len(y), 1)), y[:, 6:9], y[:, 9:]
    displacement = y[:, :3] + turned.apply(origin) - origin
    velocity = v + np.cross(omega, origin)
    acceleration = V_dot[:, :3] + np.cross(omega, velocity) + np.cross(V_dot[:, 3:], origin)
    return PointMotion(
        displacement @ place.axes, turned.apply(velocity) @ place.axes, turned.apply(acceleration) @ place.axes
    )


def rms(amplitudes: Spectrum, frequencies: Array, band: tuple[float, float] | None = None) -> Array:
    """Root of the mean square (3) of harmonics (H + 1, 3) above zero, or of those in a band (Hz, ends included)."""
    low, high = band or (0.0, np.inf)
    kept = (frequencies >= low * (1 - 1e-9)) & (frequencies <= high * (1 + 1e-9)) & (frequencies > 0.0)
    return np.asarray(np.sqrt((np.abs(amplitudes[kept]) ** 2).sum(axis=0) / 2.0))
