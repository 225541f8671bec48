"""Corners of measured phases: times at which the acceleration of a flywheel jumps, such as where a ramp ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline, make_lsq_spline
from scipy.optimize import minimize_scalar

Array = NDArray[np.float64]

MOST = 8
"""Corners that are looked for in a phase, at most."""

MULTIPLICITY = 4
"""Knots of degree 5 at a corner: phase and speed are continuous there, and the acceleration is not."""

WIDE = 40
"""Samples on either side by which the place of a corner is found."""

JUMP = 0.01
"""Least jump of the acceleration that is a corner, over its largest magnitude."""


def corner_near(t: Array, left: Array, phi: Array, degree: int) -> float | None:
    """Time (s) of the corner that explains the largest residual `left` (rad) of phases best; None near an end."""
    k = int(np.argmax(np.abs(left)))
    own = slice(max(k - WIDE, 0), k + WIDE + 1)
    x, y = t[own], phi[own]
    if k < WIDE or len(x) < 2 * WIDE + 1:
        return None
    inside = float(x[WIDE // 2]), float(x[-WIDE // 2])
    places = np.linspace(*inside, WIDE + 1)
    errors = [_error(x, y, place, degree) for place in places.tolist()]
    best = int(np.argmin(errors))
    around = float(places[max(best - 1, 0)]), float(places[min(best + 1, WIDE)])
    found = minimize_scalar(
        lambda place: _error(x, y, float(place), degree), bounds=around, method="bounded", options={"xatol": 1e-12}
    )
    return float(found.x)


def _error(x: Array, y: Array, place: float, degree: int) -> float:
    """Sum of squares that two polynomials leave that meet at `place`, with one speed."""
    s = np.clip((x - place) / (x[-1] - x[0]), -1.0, 1.0)
    powers = [s**k for k in range(degree + 1)] + [np.maximum(s, 0.0) ** k for k in range(2, degree + 1)]
    columns = np.column_stack(powers)
    found = np.linalg.lstsq(columns, y - y.mean(), rcond=None)[0]
    return float(np.sum((y - y.mean() - columns @ found) ** 2))


def spline_with_corners(t: Array, phi: Array, intervals: int, corners: tuple[float, ...], degree: int) -> BSpline:
    """The spline of least squares with evenly spaced knots but near corners (s). Raises ValueError, LinAlgError."""
    inner = np.linspace(t[0], t[-1], intervals + 1)[1:-1]
    if corners:
        far = np.abs(inner[:, None] - np.array(corners)).min(axis=1) > 0.5 * (t[-1] - t[0]) / intervals
        inner = np.sort(np.concatenate([inner[far], np.repeat(corners, MULTIPLICITY)]))
    knots = np.concatenate([np.full(degree + 1, t[0]), inner, np.full(degree + 1, t[-1])])
    return make_lsq_spline(t, phi, knots, k=degree)


def are_corners(spline: BSpline, corners: tuple[float, ...], t: Array) -> bool:
    """Whether the acceleration of the spline jumps at all corners."""
    rate = spline.derivative(2)
    near = 1e-6 * float(t[-1] - t[0])
    places = np.array(corners)
    jumps = np.abs(rate(places + near) - rate(places - near))
    return bool(np.all(jumps > JUMP * np.abs(rate(t)).max()))
