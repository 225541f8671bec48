"""From a programme to the numbers of its tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.lower.programme import Form
from mahovik.core.motion.functions import Angles, Fourier
from mahovik.core.motion.programme import Programme
from mahovik.core.program.types import NamedCount

MOST_HARMONICS = 120
"""Most harmonics of a Fourier table."""

TAIL = {"double": 1e-10, "float": 1e-6}
"""Harmonics are left out as long as their sum is below this part of the largest acceleration, or torque."""

FINE_MEAN = 2.0**20
"""Mean angles of a quintic table are multiples of 1/FINE_MEAN, which a float holds exactly."""

_FINE, _TORQUES = 1024, 256
"""Samples per period for the Fourier coefficients of angles and of torques."""

Array = NDArray[np.float64]
At = Callable[[Array], Angles]
Torques = Callable[[Array], Array]


@dataclass(frozen=True)
class Table:
    """A table's form and numbers, and its exact source: angles (and torques) at times 0..span (M, s)."""

    form: Form
    value: dict[str, Any]
    span: float
    at: At
    torques: Torques | None


def quintic_table(form: Form, at: At, span: float, winding: tuple[int, ...], torques: Torques | None) -> Table:
    """Nodes at equal times."""
    t = np.arange(float(form.rows + (0 if form.cyclic else 1))) * (span / form.rows)
    angles = at(t)
    turn = 2 * np.pi * np.array(winding, dtype=np.float64)
    if form.cyclic:
        phi = _near_zero(angles.phi - (t / span)[:, None] * turn)
        mean = np.round(np.mean(phi, axis=0) * FINE_MEAN) / FINE_MEAN
        phi = phi - mean
        phi_dot = angles.phi_dot - turn / span
    else:
        phi, phi_dot = _in_half_a_turn(angles.phi), angles.phi_dot
    columns = {"phi": phi, "phi_dot": phi_dot, "phi_ddot": angles.phi_ddot}
    if torques is not None:
        columns["tau"] = torques(t)
    value: dict[str, Any] = {"step": span / form.rows, "rate": form.rows / span}
    if form.cyclic:
        value |= _winding(winding, span) | {"mean": list(map(float, mean))}
    value["node"] = [{name: list(map(float, c[i])) for name, c in columns.items()} for i in range(len(t))]
    return Table(form, value, span, at, torques)


def fourier_table(programme: Programme, count: NamedCount, torques: Torques | None, real: str) -> Table:
    """Fourier coefficients of a periodic programme of `count` flywheels, without negligible harmonics."""
    span = programme.span
    mean, cos, sin = _angles(programme)
    order = np.arange(1.0, len(cos) + 1.0)[:, None]
    sizes = order**2 * np.hypot(cos, sin)
    rows = kept = _harmonic_count(sizes, float(np.max(sizes)) * TAIL[real])
    value: dict[str, Any] = {"omega": 2 * np.pi / span, "mean": list(map(float, mean))}
    if torques is not None:
        tau = torques(np.arange(float(_TORQUES)) / _TORQUES * span)
        tau_mean, tau_cos, tau_sin = coefficients(tau)
        rows = max(rows, _harmonic_count(np.hypot(tau_cos, tau_sin), float(np.max(np.abs(tau))) * TAIL[real]))
        value["tau_mean"] = list(map(float, tau_mean))
    rows = max(1, rows)
    cos, sin = (np.where(order <= kept, part, 0.0) for part in (cos, sin))
    form = Form("", "fourier", rows, True, torques is not None, count)
    columns = {"cos": cos, "sin": sin}
    if torques is not None:
        columns |= {"tau_cos": tau_cos, "tau_sin": tau_sin}
    value["harmonic"] = [{name: list(map(float, c[k])) for name, c in columns.items()} for k in range(rows)]
    return Table(form, value | _winding(programme.winding, span), span, programme.at, torques)


def _angles(programme: Programme) -> tuple[Array, Array, Array]:
    """mean, cos, sin of the periodic part of the angles: from the file, padded with zeros, or from samples.

    Coefficients of samples at the level of rounding become zero, since squares of high orders would amplify them.
    """
    if isinstance(programme.course, Fourier):
        parts = (programme.course.cos[:MOST_HARMONICS], programme.course.sin[:MOST_HARMONICS])
        cos, sin = (np.vstack([part, np.zeros((MOST_HARMONICS - len(part), part.shape[1]))]) for part in parts)
        return _near_zero(programme.course.mean[None, :])[0], cos, sin
    x = np.arange(float(_FINE)) / _FINE
    turn = 2 * np.pi * np.array(programme.winding, dtype=np.float64)
    mean, cos, sin = coefficients(_near_zero(programme.at(x * programme.span).phi - x[:, None] * turn))
    sizes = np.hypot(cos, sin)
    real = sizes > 1e-14 * max(1.0, float(np.max(sizes)))
    return mean, np.where(real, cos, 0.0), np.where(real, sin, 0.0)


def coefficients(samples: Array) -> tuple[Array, Array, Array]:
    """mean (N), cos, sin (H, N) of samples (M, N) of a period; H = MOST_HARMONICS."""
    result = np.fft.rfft(samples, axis=0) / len(samples)
    first = result[1 : MOST_HARMONICS + 1]
    return result[0].real, 2 * first.real, -2 * first.imag


def _harmonic_count(sizes: Array, least: float) -> int:
    """Number of harmonics after which the rest sum to less than `least`."""
    tails = np.cumsum(np.max(sizes, axis=1)[::-1])[::-1]
    above = np.flatnonzero(tails > least)
    return int(above[-1]) + 1 if len(above) else 0


def _winding(winding: tuple[int, ...], span: float) -> dict[str, Any]:
    return {"winding": list(winding), "speed": [2 * np.pi * n / span for n in winding]}


def _near_zero(phi: Array) -> Array:
    """Angles without whole turns in the means, so that a float keeps digits for the variation."""
    turns: Array = np.round(np.mean(phi, axis=0) / (2 * np.pi))
    return phi - 2 * np.pi * turns


def _in_half_a_turn(phi: Array) -> Array:
    return phi - 2 * np.pi * np.round(phi / (2 * np.pi))
