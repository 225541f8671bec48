"""Accuracy of following after settling: each coordinate about its mean, harmonics of the error, a total.

A stand that differs from its file hangs at a slightly different mean pose. Flywheels cannot correct that: they have no
mean wrench. So the error is that of the motion about its mean, and the mean is reported separately.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.motion.servo import COORDINATES
from mahovik.errors import CheckError
from mahovik.proof.verify.programme.along import twist
from mahovik.proof.verify.programme.scale import Scale, scale_of
from mahovik.use.control.record import Record
from mahovik.use.plan.array import Array

HARMONICS = 6
"""Harmonics of the error, at least; more if the motion has more."""

STILL = 1e-9
"""m, rad: a coordinate with a smaller amplitude is held still."""


@dataclass(frozen=True, eq=False)
class Following:
    """Errors over the last `periods` whole periods of a run (all in m and rad).

    amplitude  (6): of the required motion about its mean
    peak, rms  (6): of the error about its mean
    mean       (6): of the error
    harmonics  (K, 6): amplitudes of the error at harmonics 1..K of the programme
    share, share_rms   largest and root mean square of the error of all six together, by the inertia's norm, as shares
               of the largest of the motion: no choice of units or axes changes them (proof/verify/programme/scale.py)
    apart      (N): largest distance of the flywheels from the programme, rad
    """

    periods: int
    amplitude: Array
    peak: Array
    rms: Array
    mean: Array
    harmonics: Array
    share: float
    share_rms: float
    apart: Array

    def shares(self) -> list[float | None]:
        """Peak errors over each coordinate's own amplitude; None for one that is held still."""
        return [float(p / a) if a > STILL else None for p, a in zip(self.peak, self.amplitude, strict=True)]

    def as_json(self) -> Mapping[str, Any]:
        """The object for `--json`, in SI."""
        coordinates = {
            name: {
                "amplitude": float(self.amplitude[i]),
                "peak": float(self.peak[i]),
                "rms": float(self.rms[i]),
                "mean": float(self.mean[i]),
                "share": self.shares()[i],
                "harmonics": self.harmonics[:, i].tolist(),
            }
            for i, name in enumerate(COORDINATES)
        }
        return {
            "periods": self.periods,
            "error": self.share,
            "error_rms": self.share_rms,
            "coordinates": coordinates,
            "flywheels_apart": self.apart.tolist(),
        }


def following(record: Record, periods: int) -> Following:
    """Errors of a run. Raises CheckError if it is shorter than `periods` periods of the programme."""
    wanted = record.wanted
    span, step = wanted.motion.span, float(record.t[1] - record.t[0]) if len(record.t) > 1 else np.inf
    rows = round(periods * span / step)
    if rows >= len(record.t):
        raise CheckError(f"the run ended at t = {record.t[-1] if len(record.t) else 0:.6g} s, before {periods} periods")
    last = slice(len(record.t) - 1 - rows, len(record.t) - 1)
    q, required = record.q[last], record.required[last]
    error = q - required
    K = max(HARMONICS, *wanted.motion.harmonics, 1)
    terms = _waves(record.t[last] / span, min(K, max(1, round(span / step) // 2 - 1)))
    found = np.linalg.lstsq(terms, error, rcond=None)[0]  # samples need not divide a period
    error, mean = error - found[0], found[0]
    about = required - np.linalg.lstsq(terms, required, rcond=None)[0][0]
    scale = scale_of(wanted.stand, wanted.motion, wanted.exact)
    shares = _of(scale, record, required, error)
    return Following(
        periods=periods,
        amplitude=np.abs(about).max(axis=0),
        peak=np.abs(error).max(axis=0),
        rms=np.sqrt(np.mean(error**2, axis=0)),
        mean=mean,
        harmonics=np.hypot(found[1::2], found[2::2]),
        share=float(shares.max()),
        share_rms=float(np.sqrt(np.mean(shares**2))),
        apart=np.abs(record.apart[last]).max(axis=0),
    )


def error_course(record: Record) -> tuple[Array, Array]:
    """Middles of the periods of a run (s), and the relative error of each about its mean: convergence of a trim."""
    span, step = record.wanted.motion.span, float(record.t[1] - record.t[0])
    rows = round(span / step)
    scale = scale_of(record.wanted.stand, record.wanted.motion, record.wanted.exact)
    times, values = [], []
    for begin in range(0, len(record.t) - rows, rows):
        part = slice(begin, begin + rows)
        error = record.q[part] - record.required[part]
        values.append(float(_of(scale, record, record.required[part], error - error.mean(axis=0)).max()))
        times.append(float(record.t[begin] + span / 2.0))
    return np.array(times), np.array(values)


def _of(scale: Scale, record: Record, required: Array, error: Array) -> Array:
    stand = record.wanted.stand
    return np.array([scale.of_displacement(twist(stand, q, e)) for q, e in zip(required, error, strict=True)])


def _waves(turns: Array, K: int) -> Array:
    """1, cos, sin, cos 2, ... (M, 2 K + 1) of the programme's phase in turns (M)."""
    a = 2.0 * np.pi * np.outer(turns % 1.0, np.arange(1, K + 1))
    found = np.ones((len(turns), 2 * K + 1))
    found[:, 1::2], found[:, 2::2] = np.cos(a), np.sin(a)
    return found
